// SPDX-License-Identifier: MIT
//
// The promise: a look goes smoothly. No joint turns far for a target that moves little; behind and very near it fades;
// its line of sight turns at its rate. Checked with angles.
#include <catch2/catch.hpp>

#include <cstring>
#include <numbers>

#include "tests/upright_bodies.h"

using namespace swivel;
using namespace swivel::test;

TEST_CASE("no joint turns by more than four degrees while the target circles the head by one")
{
    constexpr std::size_t kSteps = 1440;
    const Upright of;
    UprightCrowd bodies(of, kSteps);
    double most = 0;
    for (const double distance : {0.4, 0.7, 1.5, 5.0})
        for (const double height : {-0.6, -0.2, 0.0, 0.3})
            for (const bool is_upright : {false, true}) {  // the circle
                std::vector<Float3> targets;
                for (std::size_t n = 0; n < kSteps; ++n) {
                    const double angle = 2 * std::numbers::pi * static_cast<double>(n) / kSteps;
                    const Vector3d around = is_upright ? Vector3d(height, std::sin(angle), std::cos(angle))
                                                       : Vector3d(std::sin(angle), height, std::cos(angle));
                    targets.push_back(floats(Vector3d(of.eye() + distance * around)));
                }
                bodies.reset();
                bodies.solve(targets);
                for (std::size_t n = 0; n < kSteps; ++n)
                    for (std::size_t joint = 0; joint < 4; ++joint)
                        most = std::max(most, quat(bodies.rotations[n][joint])
                                                  .angularDistance(quat(bodies.rotations[(n + 1) % kSteps][joint])));
            }
    INFO("degrees a degree: " << most * kSteps / (2 * std::numbers::pi));
    CHECK(most * kSteps / (2 * std::numbers::pi) <= 4);
}

TEST_CASE("a target straight behind, no weight and no target keep the incoming bits")
{
    const Upright of;
    UprightCrowd bodies(of, 48), before(of, 48);
    Random random{1};
    std::vector<Float3> targets;
    std::vector<float> weights;
    for (std::size_t n = 0; n < 48; ++n) {
        for (Float4& q : bodies.rotations[n])
            q = floats(Quaterniond(Eigen::AngleAxisd(n % 3 == 2 ? 0 : 0.3 * random.unit(), random.direction())));
        targets.push_back(n % 3 == 0
                              ? kNoPlace
                              : floats(Vector3d(of.eye() + random.spread(0.1, 9) * (n % 3 == 1 ? random.direction()
                                                                                               : Vector3d(0, 0, -1)))));
        weights.push_back(n % 3 == 1 ? 0.0f : 1.0f);
    }
    before.rotations = bodies.rotations;
    bodies.crowd.write(SWIVEL_LOOK_WEIGHT, 0, std::span(weights));
    bodies.solve(targets);
    CHECK(std::memcmp(bodies.rotations.data(), before.rotations.data(), 48 * sizeof before.rotations[0]) == 0);
    for (std::size_t n = 0; n < 48; ++n) CHECK(std::fabs(bodies.line(n).norm() - 1) <= 1e-6);
    for (std::uint32_t n = 0; n < 48; ++n)
        CHECK((bodies.flags(n) & ~(n % 3 == 1 ? SWIVEL_FADED : 0)) == (n % 3 == 2 ? SWIVEL_FADED : 0));
}

TEST_CASE("a look fades behind, by the angle's cosine, and very near, by the distance")
{
    constexpr std::uint32_t kCount = 2000;
    Upright of;
    swivel_look& look = of.look.look;
    look.joint_count = 1, look.joints[0] = 3, look.share[0] = 1, look.cos_most[0] = -1, look.fade_distance = 0.3f;
    std::fill_n(look.eye, 3, 0.0f);
    UprightCrowd bodies(of, kCount);
    const Vector3d head(0, 1.57, 0.03), ahead = vec({look.axis[0], look.axis[1], look.axis[2]}).normalized();
    Random random{4};
    std::vector<Float3> targets;
    for (std::uint32_t n = 0; n < kCount; ++n)
        targets.push_back(floats(Vector3d(head + random.spread(0.02, 3) * random.direction())));
    bodies.solve(targets);
    const auto smooth = [](double x) { return x <= 0 ? 0 : x >= 1 ? 1 : x * x * (3 - 2 * x); };
    int between = 0;
    for (std::uint32_t n = 0; n < kCount; ++n) {
        const Vector3d to = vec(targets[n]) - head;
        const double angle = angle_between(ahead, to),
                     behind = smooth((std::cos(angle) - double{look.cos_none}) /
                                     (double{look.cos_full} - double{look.cos_none})),
                     near = smooth(to.norm() / double{look.fade_distance}), weight = behind * near;
        CAPTURE(n, angle, behind, near);
        CHECK(std::fabs(angle_between(ahead, bodies.line(n)) - weight * angle) <= 1.1e-3 + 1e-6 / to.norm());
        CHECK(((bodies.flags(n) & SWIVEL_FADED) != 0) == (weight < 1));
        between += weight > 0.1 && weight < 0.9 && near < 0.9 && behind < 0.9;
    }
    CHECK(between > 20);
}

TEST_CASE("at any frame rate a line of sight comes to rest on its target, and says so until then")
{
    Upright of;
    of.look.look.rate = 3;
    std::fill_n(of.look.look.cos_most, 4, -1.0f);
    Random random{2};
    std::vector<Float3> from, to;
    for (int n = 0; n < 64; ++n) {
        const auto ahead = [&] {
            return floats(
                Vector3d(of.eye() + random.spread(0.5, 5) * (random.direction() + Vector3d(0, 0, 1.2)).normalized()));
        };
        from.push_back(ahead()), to.push_back(n % 8 ? ahead() : kNoPlace);
    }
    for (const float frames : {15.0f, 2400.0f}) {
        UprightCrowd bodies(of, 64);
        bodies.solve(from, 1 / frames);
        for (std::uint32_t n = 0; n < 64; ++n) CHECK((bodies.flags(n) & SWIVEL_REACHED));
        int waits = 0;
        for (int frame = 0; frame < 2 * static_cast<int>(frames); ++frame) {
            bodies.reset();
            bodies.solve(to, 1 / frames);
            for (std::uint32_t n = 0; n < 64; ++n) waits += (bodies.flags(n) & SWIVEL_LIMITED_STEP) != 0;
        }
        CHECK(waits > 64);
        for (std::uint32_t n = 0; n < 64; ++n) {
            CHECK(bodies.flags(n) == (n % 8 ? SWIVEL_REACHED : 0));
            if (n % 8 == 0) CHECK((bodies.rotations[n][3] == Float4{0, 0, 0, 1}));
        }
    }
}

// By how much the head stands turned, in its own frame as it came.
Quaterniond added(const std::array<Float4, 4>& came, const std::array<Float4, 4>& is)
{
    Quaterniond before = Quaterniond::Identity(), after = before;
    for (std::size_t joint = 0; joint < 4; ++joint)
        before = before * quat(came[joint]), after = after * quat(is[joint]).normalized();
    return before.normalized().conjugate() * after;
}

TEST_CASE("the turn that a look adds changes at the look's rate, whatever its target and weight do")
{
    constexpr std::uint32_t kCount = 256;
    const float rate = GENERATE(1.0f, 6.0f), seconds = GENERATE(1 / 120.0f, 1 / 60.0f, 1 / 30.0f);
    Upright of;
    of.look.look.rate = rate;
    const bool has_cones = GENERATE(true, false);
    if (!has_cones) std::fill_n(of.look.look.cos_most, 4, -1.0f);
    UprightCrowd bodies(of, kCount);
    Random random{5};
    std::vector<Float3> targets(kCount);
    std::vector<Quaterniond> was(kCount);
    std::vector<float> weights(kCount, 1);
    double most = 0, beyond = 0;
    std::size_t at_rate = 0;
    for (int frame = 0; frame < 400; ++frame) {
        for (std::uint32_t n = 0; n < kCount; ++n) {
            // Some targets go round the body, some jump or go, and some weights change.
            const double angle = 3.0 * seconds * frame + n, away = 0.4 + 0.02 * n;
            if (n % 4 == 0) targets[n] = floats(of.eye() + away * Vector3d(std::sin(angle), 0.1, std::cos(angle)));
            if (n % 4 != 0 && random.below(30) == 0)
                targets[n] =
                    random.below(4) ? floats(of.eye() + random.spread(0.3, 20) * random.direction()) : kNoPlace;
            if (n % 8 == 3 && random.below(10) == 0) weights[n] = static_cast<float>(random.below(5)) / 4;
            for (std::size_t joint = 0; joint < 4; ++joint)
                bodies.rotations[n][joint] = floats(Quaterniond(
                    Eigen::AngleAxisd(0.1 * std::sin(4.0 * seconds * frame + n), Vector3d::Unit(joint % 3))));
        }
        bodies.crowd.write(SWIVEL_LOOK_WEIGHT, 0, std::span(weights));
        const auto came = bodies.rotations;
        bodies.solve(targets, seconds);
        for (std::uint32_t n = 0; n < kCount; ++n) {
            const Quaterniond is = added(came[n], bodies.rotations[n]);
            const double turn = is.angularDistance(was[n]);
            if (frame > 0) most = std::max(most, turn), at_rate += turn > 0.8 * rate * seconds;
            was[n] = is;
            for (std::size_t joint = 0; joint < 4; ++joint)
                beyond = std::max(beyond, quat(bodies.rotations[n][joint]).angularDistance(quat(came[n][joint])) -
                                              std::acos(double{of.look.look.cos_most[joint]}));
        }
    }
    CHECK(beyond <= 1e-5);
    INFO("radians a frame: " << most << ", at the rate: " << at_rate);
    CHECK(most <= rate * seconds + 1e-5);
    CHECK(at_rate > 1000);
}

TEST_CASE("a target at the eye or at the last joint turns nothing, and is no number nowhere")
{
    const bool is_one = GENERATE(true, false);
    Upright of;
    if (is_one) of.look.look.joint_count = 1, of.look.look.joints[0] = 3;
    for (const float eye : {0.0f, 0.1f})
        for (const bool at_eye : {true, false}) {
            std::fill_n(of.look.look.eye, 3, eye);
            UprightCrowd bodies(of, 2);
            const Vector3d head(0, 1.57, 0.03), target = head + (at_eye ? eye : 0) * Vector3d::Ones();
            bodies.solve({floats(target), floats(target)});
            CHECK(std::isfinite(bodies.line(0).norm()));
            CHECK(std::isfinite(bodies.line(1).norm()));
            for (const Float4& q : bodies.rotations[1]) CHECK(std::fabs(quat(q).norm() - 1) <= 1e-6);
        }
}

TEST_CASE("where time stands still a line of sight stays, and a reset lets it begin anew")
{
    Upright of;
    of.look.look.rate = 1;
    UprightCrowd bodies(of, 1);
    bodies.solve({{0, 1.6f, 3}}, 0.1f);
    const Vector3d was = bodies.line(0);
    bodies.reset();
    bodies.solve({{2, 1.6f, 3}}, 0);
    CHECK(angle_between(was, bodies.line(0)) <= 1e-6);
    CHECK((bodies.flags(0) & SWIVEL_LIMITED_STEP));
    std::array<float, 25> line{}, kept{};
    check(swivel_read(bodies.crowd.get(), SWIVEL_LOOK_TURNS, 0, 0, 1, {&line, sizeof line}));
    const Vector3d from = of.eye() - Vector3d(0, 0, 1) * (of.eye().z() + 5),
                   behind = 2 * of.eye() - Vector3d(0, 1.6, 3);
    for (const Float3& target : {floats(from), floats(behind), Float3{0, 1.6f, 3}, Float3{1e-7f, 1.6f, 3}, kNoPlace}) {
        bodies.reset();
        bodies.solve({target}, 0);
        check(swivel_read(bodies.crowd.get(), SWIVEL_LOOK_TURNS, 0, 0, 1, {&kept, sizeof kept}));
        CHECK((kept == line));
    }
    bodies.crowd.reset(0);
    bodies.reset();
    bodies.solve({{2, 1.6f, 3}}, 0);
    CHECK((bodies.flags(0) & SWIVEL_REACHED));
}
