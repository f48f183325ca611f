// SPDX-License-Identifier: MIT
//
// The promise: a chain of joints turns so that its line of sight meets the target, where the last cone allows it. Each
// joint turns by its share, and no further than its cone. Limbs below are solved from where they are then. A look goes
// smoothly: no joint turns far for a target that moves little; behind and very near it fades; its line of sight turns
// at its rate. All is checked by forward kinematics of Eigen's, with angles.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include <cstring>
#include <numbers>

#include "tests/looking_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// `tools/test --full bodies` makes a million: RC_PARAMS=max_success=6000.
constexpr std::size_t kLookingBodies = 200;

struct LookCounts {
    int bodies = 0, sees = 0, held = 0, faded = 0, reached = 0, told = 0;
};

struct LookStage {
    const LookingBodies& of;
    bool has_limbs;  // else the looks alone are solved, and limbs come along as they are
    SolvedBodies solved;

    LookStage(const LookingBodies& bodies, bool limbs)
        : of(bodies), has_limbs(limbs), solved(bodies, limbs ? std::vector<std::uint32_t>{} : bodies.looks)
    {
    }

    // By how much a joint's place may be off: each rotation above it is rounded, which moves it by its distance from
    // there.
    double off(const SolvedBody& body, std::uint32_t joint) const
    {
        const Vector3d place = body.came[joint].place;
        double levers = place.norm();
        for (std::int32_t at = of.skeleton.parents[joint]; at >= 0;
             at = of.skeleton.parents[static_cast<std::size_t>(at)])
            levers += (place - body.came[static_cast<std::size_t>(at)].place).norm();
        return 2e-7 * levers + 1e-7 * vec(of.bodies[body.n].root_position).norm();
    }
    void check_look(const SolvedBody& body, std::uint32_t group, LookCounts& counts) const
    {
        const TurnedChain chain{body, of.look_def(group)};
        const std::uint32_t flags = solved.flags(group, body.n);
        const Vector3d target =
            vec(of.value(group, SWIVEL_LOOK_TARGET, body.n, kNoPlace)) - vec(of.bodies[body.n].root_position);
        const Vector3d eye = chain.eye_after(chain.last() + 1), axis = chain.axis_after(chain.last() + 1);
        const double off_place = off(body, chain.look.joints[chain.last()]), distance = (target - eye).norm(),
                     rounding = 2e-6 + off_place / distance;
        RC_ASSERT((eye - chain.eye(chain.is(chain.last()))).norm() <= 4 * off_place);
        const Float6 sight = solved.result<Float6>(SWIVEL_SIGHT, group, body.n);
        RC_ASSERT((Vector3d(sight[0], sight[1], sight[2]) - vec(of.bodies[body.n].root_position) - eye).norm() <=
                  8 * off_place);
        RC_ASSERT(angle_between({sight[3], sight[4], sight[5]}, axis) <= 3e-6);
        for (std::uint32_t n = 0; n <= chain.last(); ++n) {
            const double max = std::acos(double{chain.look.cos_max[n]});
            RC_ASSERT(angle_of(chain.own_turn(n)) <= max + 2e-6);
        }
        const double miss = angle_between(axis, target - eye);
        if (flags & SWIVEL_REACHED) RC_ASSERT(miss <= 1e-4 + rounding);
        // With the whole weight, only the last cone keeps it from the target.
        const double last_turn = angle_of(chain.own_turn(chain.last())),
                     last_max = std::acos(double{chain.look.cos_max[chain.last()]});
        const bool is_whole = !(flags & SWIVEL_FADED), last_is_free = last_turn < last_max - 1e-5;
        const Vector3d pivot = chain.is(chain.last()).place;
        const bool is_ahead = (target - pivot).norm() > (eye - pivot).norm() + 10 * off_place;
        if (is_whole && last_is_free && is_ahead) {
            RC_ASSERT(miss <= rounding);
            // The flag is of 1e-4 rad, as floats have it: for a target on the very eye they may not tell.
            if (rounding <= 5e-5) RC_ASSERT(flags & SWIVEL_REACHED);
        }
        if (is_whole) check_shares(chain, target, off_place);
        check_fade(chain, target, is_whole, last_is_free, off_place);
        counts.sees += (flags & SWIVEL_REACHED) != 0, counts.held += (flags & SWIVEL_LIMITED_LOOK) != 0;
        counts.faded += !is_whole;
        ++counts.bodies;
    }
    // Joints before the last turn by their share of the angle that is left, about the axis of the shortest turn. The
    // eye may pass very near the target on its way, where rounding of places counts most.
    static void check_shares(const TurnedChain& chain, const Vector3d& target, double off_place)
    {
        double left = 0;
        for (std::uint32_t n = 0; n <= chain.last(); ++n) left += double{chain.look.share[n]};
        for (std::uint32_t n = 0; n < chain.last(); ++n) {
            const double share = chain.look.share[n] / left;
            left -= double{chain.look.share[n]};
            const Vector3d axis = chain.axis_after(n), to = target - chain.eye_after(n);
            const double angle = angle_between(axis, to), max = std::acos(double{chain.look.cos_max[n]}),
                         rounding = 2e-6 + off_place / to.norm();
            const Quaterniond turn = chain.own_turn(n);
            RC_ASSERT(std::fabs(angle_of(turn) - std::min(share * angle, max)) <= 1.1e-3 + rounding);
            if (angle > 0.05 && angle < 3.1 && angle_of(turn) > 0.01)
                RC_ASSERT(angle_between(turn.w() < 0 ? Vector3d(-turn.vec()) : Vector3d(turn.vec()), axis.cross(to)) <=
                          (1e-5 + 4 * rounding) / (std::sin(angle) * angle_of(turn)));
        }
    }
    // Behind by the cosine of the angle, and very near by the distance. Where one joint turns about the eye, the line
    // turns by so much of the whole.
    static void check_fade(const TurnedChain& chain, const Vector3d& target, bool is_whole, bool is_free,
                           double off_place)
    {
        const Vector3d to = target - chain.eye_after(0), axis = chain.axis_after(0);
        const double angle = angle_between(axis, to), none = chain.look.cos_none,
                     ahead = (std::cos(angle) - none) / (double{chain.look.cos_full} - none),
                     far = to.norm() / (double{chain.look.fade_distance} * chain.was(chain.last()).scale);
        const auto smooth = [](double x) { return x <= 0 ? 0 : x >= 1 ? 1 : x * x * (3 - 2 * x); };
        if (std::fabs(std::min(ahead, far) - 1) > 1e-3) RC_ASSERT(is_whole == (std::min(ahead, far) > 1));
        if (chain.last() > 0 || !is_free || vec(chain.look.eye).norm() > 0) return;
        const double turned = angle_between(axis, chain.axis_after(1)), wanted = smooth(ahead) * smooth(far) * angle;
        RC_ASSERT(std::fabs(turned - wanted) <= 1.1e-3 + 1e-6 / to.norm() + off_place / to.norm());
    }
    void check_limbs(const SolvedBody& body, LookCounts& counts) const
    {
        for (std::uint32_t g = 0; g < of.groups.size(); ++g) {
            if (of.limb_of[g] == kNoLimbHere || !(solved.flags(g, body.n) & SWIVEL_REACHED)) continue;
            if (of.value(g, SWIVEL_WEIGHTS, body.n, Float3{})[0] == 0) continue;
            const Vector3d target =
                vec(of.value(g, SWIVEL_TARGET, body.n, kNoPlace)) - vec(of.bodies[body.n].root_position);
            const Held hand = body.hand(g);
            RC_ASSERT((hand.place - target).norm() <=
                      body.bound(g) + 1e-6 * (target.norm() + vec(of.bodies[body.n].root_position).norm()));
            RC_ASSERT(hand.rotation.angularDistance(quat(of.value(g, SWIVEL_HAND, body.n, Float4{})).normalized()) <=
                      1e-5);
            ++counts.reached;
        }
    }
    // All that nothing turns keeps its local rotation.
    void check_others(const SolvedBody& body) const
    {
        const Body now = solved.poses.read(body.n, body.incoming);
        std::vector<bool> turns(of.skeleton.size());
        for (const std::uint32_t g : of.looks) {
            const swivel_look_def& look = of.look_def(g);
            for (std::uint32_t n = 0; n < look.joint_count; ++n) turns[look.joints[n]] = true;
        }
        for (std::uint32_t g = 0; g < of.groups.size(); ++g) {
            if (!has_limbs || of.limb_of[g] == kNoLimbHere) continue;
            if (of.value(g, SWIVEL_WEIGHTS, body.n, Float3{})[0] == 0) continue;
            for (const std::uint32_t joint : {body.joints(g).shoulder, body.joints(g).elbow, body.joints(g).wrist})
                turns[joint] = true;
        }
        for (std::uint32_t joint = 0; joint < of.skeleton.size(); ++joint)
            if (!turns[joint])
                RC_ASSERT(quat(now.rotations[joint])
                              .normalized()
                              .angularDistance(quat(body.incoming.rotations[joint]).normalized()) <=
                          (of.is_in_body ? 3e-6 : 1e-6));
    }
    // The solve says where joints are, in the body's space.
    void check_told(const SolvedBody& body, LookCounts& counts) const
    {
        const Quaterniond root = quat(body.incoming.root_rotation).normalized();
        const double scale = body.incoming.root_scale;
        for (std::uint32_t joint = 0; joint < of.skeleton.size(); ++joint) {
            const std::size_t at = body.n * of.skeleton.size() + joint;
            if (solved.joint_rotations[at] == Float4{}) continue;  // no group needs it
            RC_ASSERT((root * quat(solved.joint_rotations[at])).angularDistance(body.solved[joint].rotation) <= 5e-6);
            RC_ASSERT((scale * (root * vec(solved.joint_positions[at])) - body.solved[joint].place).norm() <=
                      3e-6 * (scale + way_to(of.skeleton, body.came, joint)));
            ++counts.told;
        }
    }
};

// By how much the head stands turned, in its own frame as it came.
Quaterniond added(const std::array<Float4, 4>& came, const std::array<Float4, 4>& now)
{
    Quaterniond before = Quaterniond::Identity(), after = before;
    for (std::size_t joint = 0; joint < 4; ++joint)
        before = before * quat(came[joint]), after = after * quat(now[joint]).normalized();
    return before.normalized().conjugate() * after;
}

}  // namespace

TEST_CASE("a chain looks at its target, each joint by its share and within its cone")
{
    LookCounts counts;
    CHECK(rc::check("by forward kinematics", [&](std::uint64_t seed) {
        Random random{seed};
        LookingBodies bodies(random, kLookingBodies, random_layout(random));
        if (random.below(3) == 0) bodies.put_in_body_space();
        const LookStage stage(bodies, random.below(5) > 0);
        for (std::size_t n = 0; n < kLookingBodies; ++n) {
            const SolvedBody body(stage.solved, n);
            for (const std::uint32_t group : bodies.looks) stage.check_look(body, group, counts);
            if (stage.has_limbs) stage.check_limbs(body, counts);
            stage.check_others(body);
            stage.check_told(body, counts);
        }
    }));
    CAPTURE(counts.bodies, counts.sees, counts.held, counts.faded, counts.reached, counts.told);
    CHECK(counts.sees > counts.bodies / 10);
    CHECK(counts.held > counts.bodies / 10);
    CHECK(counts.faded > counts.bodies / 10);
    CHECK(counts.reached > counts.bodies / 10);
    CHECK(counts.told > counts.bodies);
}

TEST_CASE("a line of sight meets its target to a millionth of a radian, also one nearly behind")
{
    constexpr std::uint32_t kCount = 20000;
    const bool is_one = GENERATE(true, false), is_behind = GENERATE(true, false);
    Upright upright;
    swivel_look_def& look = upright.look;
    std::fill_n(look.cos_max, 4, -1.0f);
    if (is_one) look.joint_count = 1, look.joints[0] = 3;
    look.cos_full = -0.998f, look.cos_none = -1, look.fade_distance = 0;
    UprightCrowd bodies(upright, kCount);
    Random random{7};
    std::vector<Float3> targets;
    for (std::uint32_t n = 0; n < kCount; ++n) {
        const Vector3d line = is_behind ? Vector3d(Vector3d(0, 0, -1) + random.spread(1e-7, 0.3) * random.direction())
                                        : random.direction();
        targets.push_back(floats(Vector3d(upright.eye() + random.spread(1.2, 20) * line)));
        for (Float4& q : bodies.rotations[n])
            if (!is_behind) q = floats(Quaterniond(Eigen::AngleAxisd(0.5 * random.unit(), random.direction())));
    }
    bodies.solve(targets);
    double worst = 0;
    for (std::uint32_t n = 0; n < kCount; ++n) {
        if (bodies.flags(n) & SWIVEL_FADED) continue;
        const auto [eye, axis] = bodies.sight(upright, n);
        worst = std::max(worst, angle_between(axis, vec(targets[n]) - eye));
    }
    INFO("radians: " << worst);
    CHECK(worst > 0);
    CHECK(worst <= 1e-6);
}

TEST_CASE("no joint turns by more than four degrees while the target circles the head by one")
{
    constexpr std::size_t kSteps = 1440;
    const Upright upright;
    UprightCrowd bodies(upright, kSteps);
    double max = 0;
    for (const double distance : {0.4, 0.7, 1.5, 5.0})
        for (const double height : {-0.6, -0.2, 0.0, 0.3})
            for (const bool is_upright : {false, true}) {  // the circle
                std::vector<Float3> targets;
                for (std::size_t n = 0; n < kSteps; ++n) {
                    const double angle = 2 * std::numbers::pi * static_cast<double>(n) / kSteps;
                    const Vector3d around = is_upright ? Vector3d(height, std::sin(angle), std::cos(angle))
                                                       : Vector3d(std::sin(angle), height, std::cos(angle));
                    targets.push_back(floats(Vector3d(upright.eye() + distance * around)));
                }
                bodies.reset();
                bodies.solve(targets);
                for (std::size_t n = 0; n < kSteps; ++n)
                    for (std::size_t joint = 0; joint < 4; ++joint)
                        max = std::max(max, quat(bodies.rotations[n][joint])
                                                .angularDistance(quat(bodies.rotations[(n + 1) % kSteps][joint])));
            }
    INFO("degrees a degree: " << max * kSteps / (2 * std::numbers::pi));
    CHECK(max * kSteps / (2 * std::numbers::pi) <= 4);
}

TEST_CASE("a target straight behind, no weight and no target keep the incoming bits")
{
    const Upright upright;
    UprightCrowd bodies(upright, 48), before(upright, 48);
    Random random{1};
    std::vector<Float3> targets;
    std::vector<float> weights;
    for (std::size_t n = 0; n < 48; ++n) {
        for (Float4& q : bodies.rotations[n])
            q = floats(Quaterniond(Eigen::AngleAxisd(n % 3 == 2 ? 0 : 0.3 * random.unit(), random.direction())));
        targets.push_back(
            n % 3 == 0 ? kNoPlace
                       : floats(Vector3d(upright.eye() + random.spread(0.1, 9) *
                                                             (n % 3 == 1 ? random.direction() : Vector3d(0, 0, -1)))));
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

TEST_CASE("at any frame rate a line of sight comes to rest on its target, and says so until then")
{
    Upright upright;
    upright.look.rate = 3;
    std::fill_n(upright.look.cos_max, 4, -1.0f);
    Random random{2};
    std::vector<Float3> from, to;
    for (int n = 0; n < 64; ++n) {
        const auto ahead = [&] {
            return floats(Vector3d(upright.eye() +
                                   random.spread(0.5, 5) * (random.direction() + Vector3d(0, 0, 1.2)).normalized()));
        };
        from.push_back(ahead()), to.push_back(n % 8 ? ahead() : kNoPlace);
    }
    for (const float frames : {15.0f, 2400.0f}) {
        UprightCrowd bodies(upright, 64);
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

TEST_CASE("the turn that a look adds changes at the look's rate, whatever its target and weight do")
{
    constexpr std::uint32_t kCount = 256;
    const float rate = GENERATE(1.0f, 6.0f), seconds = GENERATE(1 / 120.0f, 1 / 60.0f, 1 / 30.0f);
    Upright upright;
    upright.look.rate = rate;
    const bool has_cones = GENERATE(true, false);
    if (!has_cones) std::fill_n(upright.look.cos_max, 4, -1.0f);
    UprightCrowd bodies(upright, kCount);
    Random random{5};
    std::vector<Float3> targets(kCount);
    std::vector<Quaterniond> last(kCount);
    std::vector<float> weights(kCount, 1);
    double max = 0, beyond = 0;
    std::size_t at_rate = 0;
    for (int frame = 0; frame < 400; ++frame) {
        for (std::uint32_t n = 0; n < kCount; ++n) {
            // Some targets go round the body, some jump or go, and some weights change.
            const double angle = 3.0 * seconds * frame + n, away = 0.4 + 0.02 * n;
            if (n % 4 == 0) targets[n] = floats(upright.eye() + away * Vector3d(std::sin(angle), 0.1, std::cos(angle)));
            if (n % 4 != 0 && random.below(30) == 0)
                targets[n] =
                    random.below(4) ? floats(upright.eye() + random.spread(0.3, 20) * random.direction()) : kNoPlace;
            if (n % 8 == 3 && random.below(10) == 0) weights[n] = static_cast<float>(random.below(5)) / 4;
            for (std::size_t joint = 0; joint < 4; ++joint)
                bodies.rotations[n][joint] = floats(Quaterniond(
                    Eigen::AngleAxisd(0.1 * std::sin(4.0 * seconds * frame + n), Vector3d::Unit(joint % 3))));
        }
        bodies.crowd.write(SWIVEL_LOOK_WEIGHT, 0, std::span(weights));
        const auto came = bodies.rotations;
        bodies.solve(targets, seconds);
        for (std::uint32_t n = 0; n < kCount; ++n) {
            const Quaterniond turned = added(came[n], bodies.rotations[n]);
            const double turn = turned.angularDistance(last[n]);
            if (frame > 0) max = std::max(max, turn), at_rate += turn > 0.8 * rate * seconds;
            last[n] = turned;
            for (std::size_t joint = 0; joint < 4; ++joint)
                beyond = std::max(beyond, quat(bodies.rotations[n][joint]).angularDistance(quat(came[n][joint])) -
                                              std::acos(double{upright.look.cos_max[joint]}));
        }
    }
    CHECK(beyond <= 1e-5);
    INFO("radians a frame: " << max << ", at the rate: " << at_rate);
    CHECK(max <= rate * seconds + 1e-5);
    CHECK(at_rate > 1000);
}

TEST_CASE("a target at the eye or at the last joint turns nothing, and is no number nowhere")
{
    const bool is_one = GENERATE(true, false);
    Upright upright;
    if (is_one) upright.look.joint_count = 1, upright.look.joints[0] = 3;
    for (const float eye : {0.0f, 0.1f})
        for (const bool at_eye : {true, false}) {
            std::fill_n(upright.look.eye, 3, eye);
            UprightCrowd bodies(upright, 2);
            const Vector3d head(0, 1.57, 0.03), target = head + (at_eye ? eye : 0) * Vector3d::Ones();
            bodies.solve({floats(target), floats(target)});
            CHECK(std::isfinite(bodies.line(0).norm()));
            CHECK(std::isfinite(bodies.line(1).norm()));
            for (const Float4& q : bodies.rotations[1]) CHECK(std::fabs(quat(q).norm() - 1) <= 1e-6);
        }
}

TEST_CASE("where time stands still a line of sight stays, and a reset lets it begin anew")
{
    Upright upright;
    upright.look.rate = 1;
    UprightCrowd bodies(upright, 1);
    bodies.solve({{0, 1.6f, 3}}, 0.1f);
    const Vector3d before = bodies.line(0);
    bodies.reset();
    bodies.solve({{2, 1.6f, 3}}, 0);
    CHECK(angle_between(before, bodies.line(0)) <= 1e-6);
    CHECK((bodies.flags(0) & SWIVEL_LIMITED_STEP));
    using Turns = std::array<float, 25>;
    const auto line = value_of<Turns>(bodies.crowd, SWIVEL_LOOK_TURNS, 0, 0);
    const Vector3d from = upright.eye() - Vector3d(0, 0, 1) * (upright.eye().z() + 5),
                   behind = 2 * upright.eye() - Vector3d(0, 1.6, 3);
    for (const Float3& target : {floats(from), floats(behind), Float3{0, 1.6f, 3}, Float3{1e-7f, 1.6f, 3}, kNoPlace}) {
        bodies.reset();
        bodies.solve({target}, 0);
        CHECK((value_of<Turns>(bodies.crowd, SWIVEL_LOOK_TURNS, 0, 0) == line));
    }
    bodies.crowd.reset(0);
    bodies.reset();
    bodies.solve({{2, 1.6f, 3}}, 0);
    CHECK((bodies.flags(0) & SWIVEL_REACHED));
}
