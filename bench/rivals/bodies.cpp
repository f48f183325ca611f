// SPDX-License-Identifier: MIT
#include "bench/rivals/bodies.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace bench {

namespace {

BodyVec cross(const BodyVec& a, const BodyVec& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
BodyQuat product(const BodyQuat& a, const BodyQuat& b)
{
    const BodyVec v = cross({a[0], a[1], a[2]}, {b[0], b[1], b[2]});
    return {a[3] * b[0] + b[3] * a[0] + v[0], a[3] * b[1] + b[3] * a[1] + v[1], a[3] * b[2] + b[3] * a[2] + v[2],
            a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}
BodyQuat quat_of(const float (&q)[4]) { return {q[0], q[1], q[2], q[3]}; }

}  // namespace

BodyVec turned(const BodyQuat& q, const BodyVec& v)
{
    const BodyVec u = {q[0], q[1], q[2]};
    BodyVec t = cross(u, v);
    for (double& x : t) x *= 2;
    const BodyVec second = cross(u, t);
    return {v[0] + q[3] * t[0] + second[0], v[1] + q[3] * t[1] + second[1], v[2] + q[3] * t[2] + second[2]};
}

BodyFrames frames_of(const BodyCharacter& body)
{
    BodyFrames frames;
    auto& [place, turn] = frames;
    for (std::size_t n = 0; n < kBodyJoints; ++n) {
        const std::int32_t parent = kBodyParents[n];
        const auto above = static_cast<std::size_t>(parent < 0 ? 0 : parent);
        const BodyQuat from = parent < 0 ? quat_of(body.root_rotation) : turn[above];
        const BodyVec start =
            parent < 0 ? BodyVec{body.root_place[0], body.root_place[1], body.root_place[2]} : place[above];
        const BodyVec step = turned(from, {kBodyOffsets[n][0], kBodyOffsets[n][1], kBodyOffsets[n][2]});
        for (std::size_t c = 0; c < 3; ++c) place[n][c] = start[c] + step[c];
        turn[n] = product(from, quat_of(body.rotations[n]));
    }
    return frames;
}

std::vector<BodyCharacter> random_bodies(std::size_t count)
{
    std::mt19937 random(1);
    const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    const auto turn = [&](float(&q)[4], double size) {
        double length2 = 1;
        for (int n = 0; n < 3; ++n) q[n] = static_cast<float>(between(-size, size)), length2 += q[n] * q[n];
        q[3] = 1;
        for (float& x : q) x = static_cast<float>(x / std::sqrt(length2));
    };
    std::vector<BodyCharacter> bodies(count);
    for (BodyCharacter& body : bodies) {
        for (auto& q : body.rotations) turn(q, 0.25);
        turn(body.root_rotation, 1);
        for (float& x : body.root_place) x = static_cast<float>(between(-3, 3));
        const auto place = frames_of(body).place;
        for (std::size_t limb = 0; limb < kBodyLimbs; ++limb) {
            // A tenth of a metre from where the limb ends, on the side of its root.
            const BodyVec &last = place[kBodyChains[limb].last], &first = place[kBodyChains[limb].first];
            for (std::size_t c = 0; c < 3; ++c)
                body.goals[limb].target[c] =
                    static_cast<float>(last[c] + 0.2 * (first[c] - last[c]) + between(-0.05, 0.05));
            turn(body.goals[limb].hand, 0.5);
        }
    }
    return bodies;
}

double worst_miss(const std::vector<BodyCharacter>& bodies)
{
    double worst = 0;
    for (const BodyCharacter& body : bodies) {
        const auto place = frames_of(body).place;
        for (std::size_t limb = 0; limb < kBodyLimbs; ++limb) {
            const BodyVec& last = place[kBodyChains[limb].last];
            double miss2 = 0;
            for (std::size_t c = 0; c < 3; ++c) miss2 += std::pow(last[c] - body.goals[limb].target[c], 2);
            worst = std::max(worst, std::sqrt(miss2));
        }
    }
    return worst;
}

}  // namespace bench
