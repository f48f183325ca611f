// SPDX-License-Identifier: MIT
//
// The textbook solver as people write it on glm: one arm, law of cosines, a frame that looks at the target, axis and
// angle.
#include "rivals.h"

#include <algorithm>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace bench {

namespace {

struct ArmIn {
    glm::vec3 target, pole;
    float upper, fore;
};
struct ArmOut {
    glm::quat shoulder;
    float cos_half, sin_half;
    std::uint32_t flags;
};

ArmOut solve(const ArmIn& arm)
{
    const float wanted = glm::length(arm.target), far = arm.upper + arm.fore, near = std::abs(arm.upper - arm.fore);
    const float d = glm::clamp(wanted, near, far);
    const glm::vec3 u = arm.target / wanted;
    const glm::vec3 n = glm::normalize(glm::cross(u, arm.pole));

    const float l1 = arm.upper, l2 = arm.fore;
    const float flexion = std::acos(glm::clamp((d * d - l1 * l1 - l2 * l2) / (2 * l1 * l2), -1.0f, 1.0f));
    const float lift = std::acos(glm::clamp((l1 * l1 + d * d - l2 * l2) / (2 * l1 * d), -1.0f, 1.0f));

    const glm::quat look = glm::quat_cast(glm::mat3(n, glm::cross(u, n), u));
    ArmOut out;
    out.shoulder = look * glm::angleAxis(lift, glm::vec3(1, 0, 0));
    out.cos_half = std::cos(flexion / 2);
    out.sin_half = std::sin(flexion / 2);
    out.flags = wanted > far ? 8u : wanted < near ? 16u : 1u;
    return out;
}

}  // namespace

struct SingleCrowd {
    std::vector<ArmIn> in;
    std::vector<ArmOut> out;
};

SingleCrowd* make_single(const Arms& arms)
{
    auto* crowd = new SingleCrowd{std::vector<ArmIn>(arms.count()), std::vector<ArmOut>(arms.count())};
    for (std::size_t n = 0; n < arms.count(); ++n)
        crowd->in[n] = {
            {arms[0][n], arms[1][n], arms[2][n]}, {arms[3][n], arms[4][n], arms[5][n]}, arms[6][n], arms[7][n]};
    return crowd;
}
void free_single(SingleCrowd* crowd) { delete crowd; }

void solve_single(SingleCrowd& crowd)
{
    for (std::size_t n = 0; n < crowd.in.size(); ++n) crowd.out[n] = solve(crowd.in[n]);
}

void read_single(const SingleCrowd& crowd, Poses& poses)
{
    for (std::size_t n = 0; n < crowd.out.size(); ++n) {
        const ArmOut& out = crowd.out[n];
        const float values[] = {out.shoulder.x, out.shoulder.y, out.shoulder.z,
                                out.shoulder.w, out.cos_half,   out.sin_half};
        for (std::size_t c = 0; c < 6; ++c) poses[c][n] = values[c];
    }
}

}  // namespace bench
