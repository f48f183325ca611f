// SPDX-License-Identifier: MIT
//
// The promise: a job for some groups turns no joint of others, and says where those are. That bodies and groups which a
// job chooses get the bits of a solve of all, and no other byte is touched, is test_bits.cpp's and the test
// `interface`'s.
#include <catch2/catch.hpp>

#include "tests/body_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

}  // namespace

TEST_CASE("joints of a group that is not named are where they come")
{
    constexpr std::uint32_t kBodies = 40;
    Random random{13};
    const BodySkeleton skeleton = random_body_skeleton(random, {5, 3, 1, false});
    std::vector<Body> bodies;
    for (std::uint32_t n = 0; n < kBodies; ++n) bodies.push_back(random_body(random, skeleton, {true, true, true}));
    BodyGoals goals(skeleton.limbs.size());
    for (std::size_t limb = 0; limb < goals.size(); ++limb)
        for (const Body& body : bodies) goals[limb].push_back(random_goal(random, skeleton, body, limb));
    Crowd crowd = body_crowd(skeleton, SWIVEL_WITH_HAND, kBodies);
    write_goals(crowd, goals);

    PoseLayout layout{.translates = true, .scales = true, .roots = true};
    layout.in_body = GENERATE(true, false) ? &skeleton : nullptr;
    PoseBuffer poses(layout, bodies);
    std::vector<Float3> places(kBodies * poses.joint_count);
    std::vector<Float4> rotations(places.size());
    swivel_pose pose = poses.view();
    pose.joint_places = {places.data(), poses.joint_count * sizeof(Float3), sizeof(Float3), nullptr};
    pose.joint_rotations = {rotations.data(), poses.joint_count * sizeof(Float4), sizeof(Float4), nullptr};
    crowd.solve({.groups = {0u, 2u}, .pose = &pose});
    for (std::uint32_t n = 0; n < kBodies; ++n) {
        Body body = poses.read(n, bodies[n]);
        body.root_rotation = {0, 0, 0, 1}, body.root_scale = 1;
        const std::vector<JointAt> at = joints_at(skeleton, body);
        for (const BodyLimbJoints& limb : skeleton.limbs) {
            const std::size_t wrist = n * poses.joint_count + limb.wrist;
            REQUIRE((vec(places[wrist]) - at[limb.wrist].place).norm() <= 1e-5);
            REQUIRE(std::fabs(quat(rotations[wrist]).norm() - 1) <= 1e-5);
            REQUIRE(quat(rotations[wrist]).angularDistance(at[limb.wrist].rotation) <= 1e-5);
        }
    }
}
