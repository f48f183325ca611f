// SPDX-License-Identifier: MIT
//
// The promise: a body's weight takes its share of the turn of each joint. At 1 no bit changes, at 0 the pose keeps its
// bits, while what is carried goes on. Bones keep their lengths in between. Eigen judges, by angles.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/looking_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::size_t kBodies = 40;

PoseLayout any_layout(Random& random)
{
    PoseLayout layout;
    layout.form = static_cast<swivel_pose_form>(random.below(SWIVEL_MATRIX_COLUMNS3 + 1));
    layout.translates = layout.scales = layout.form != SWIVEL_ROTATIONS || random.below(2);
    layout.roots = random.below(2);
    return layout;
}

// Bodies that look at a rate, or limbs alone.
struct WeighedBodies : LookingBodies {
    WeighedBodies(Random& random, bool look_too) : LookingBodies(random, kBodies, any_layout(random))
    {
        if (random.below(2)) layout.translates = layout.scales = true, layout.in_body = &skeleton;
        for (const std::uint32_t group : looks) groups[group].look.rate = 3;
        if (look_too) return;
        for (const std::uint32_t group : looks) find(group, SWIVEL_LOOK_TARGET)->numbers.assign(3 * kBodies, kNan);
    }
};

// Two frames of a crowd with these weights. Poses come in anew in each.
struct Weighed {
    Crowd crowd;
    PoseBuffer poses;

    Weighed(const WeighedBodies& of, const std::vector<float>& weights) : crowd(of.crowd()), poses(of.layout, of.bodies)
    {
        for (int frame = 0; frame < 2; ++frame) {
            poses = PoseBuffer(of.layout, of.bodies);
            swivel_pose pose = of.view(poses);
            if (!weights.empty()) pose.weight = stream(weights);
            for (const std::uint32_t group : of.looks)
                if (frame == 1) turn_targets(of, group);
            crowd.solve({.pose = &pose});
        }
    }

private:
    // So that the look is on its way.
    void turn_targets(const WeighedBodies& of, std::uint32_t group)
    {
        std::vector<Float3> targets(kBodies);
        for (std::size_t n = 0; n < kBodies; ++n) {
            const Float3 first = of.value(group, SWIVEL_LOOK_TARGET, n, kNoPlace);
            const Vector3d root = vec(of.bodies[n].root_position), from = vec(first) - root;
            targets[n] = floats(Vector3d(root + Vector3d(from.z(), from.x(), from.y())));
        }
        crowd.write(SWIVEL_LOOK_TARGET, group, targets);
    }
};

}  // namespace

TEST_CASE("a weight of 1 changes no bit; one of 0 keeps the pose's bits, and what is carried goes on")
{
    rc::prop("bodies with looks and limbs", [](std::uint64_t seed) {
        Random random{seed};
        const WeighedBodies of(random, true);
        const Weighed without(of, {}), all(of, std::vector<float>(kBodies, 1)),
            none(of, std::vector<float>(kBodies, 0));
        RC_ASSERT(all_words(all.crowd) == all_words(without.crowd));
        RC_ASSERT(all.poses.bytes == without.poses.bytes);
        RC_ASSERT(none.poses.bytes == PoseBuffer(of.layout, of.bodies).bytes);
        using Turns = std::array<float, 25>;
        const std::uint32_t first = of.looks.front();  // another goes on from where the first one's part has brought it
        RC_ASSERT(
            (read<Turns>(none.crowd, SWIVEL_LOOK_TURNS, first) == read<Turns>(all.crowd, SWIVEL_LOOK_TURNS, first)));
    });
}

TEST_CASE("joints turn by their share of the way in between, and bones keep their lengths")
{
    int turns = 0;
    rc::prop("looks, or limbs alone", [&](std::uint64_t seed) {
        Random random{seed};
        const bool looks = random.below(2);
        const WeighedBodies of(random, looks);
        std::vector<float> weights;
        for (std::size_t n = 0; n < kBodies; ++n) weights.push_back(static_cast<float>(random.unit()));
        const Weighed all(of, {}), some(of, weights);
        for (std::size_t n = 0; n < kBodies; ++n) {
            const Body &was = of.bodies[n], whole = all.poses.read(n, was), is = some.poses.read(n, was);
            for (std::size_t joint = 0; joint < of.skeleton.size(); ++joint) {
                const Float3 &bone = was.translations[joint], &same = is.translations[joint];
                RC_ASSERT((vec(bone) - vec(same)).norm() <= 2e-5 * (1 + vec(bone).norm()));
                const swivel_look& first = of.groups[of.looks.front()].look;
                const bool is_of_first = std::count(first.joints, first.joints + first.joint_count, joint) > 0;
                if (looks && !is_of_first) continue;  // it was solved from where the look had turned it
                const Quaterniond from = quat(was.rotations[joint]).normalized();
                const double way = from.angularDistance(quat(whole.rotations[joint]).normalized()),
                             part = from.angularDistance(quat(is.rotations[joint]).normalized());
                RC_ASSERT(std::fabs(part - double{weights[n]} * way) <= 1.2e-3);
                turns += way > 0.1;
            }
        }
    });
    CHECK(turns > 1000);
}

TEST_CASE("a weight that is none is bad input of its body")
{
    Random random{3};
    WeighedBodies of(random, true);
    std::vector<float> weights(kBodies, 0.5f);
    weights[7] = 1.5f, weights[9] = kNan, weights[11] = -0.25f;
    const Weighed bodies(of, weights);
    for (std::uint32_t group = 0; group < of.groups.size(); ++group) {
        const std::vector<std::uint32_t> flags = read<std::uint32_t>(bodies.crowd, SWIVEL_FLAGS, group);
        for (std::size_t n = 0; n < kBodies; ++n)
            CHECK((flags[n] == SWIVEL_BAD_INPUT) == (n == 7 || n == 9 || n == 11));
    }
}
