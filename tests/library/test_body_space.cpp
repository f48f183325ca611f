// SPDX-License-Identifier: MIT
//
// Poses whose joints are all in the body's space, and where a solve says that joints are. What is below a limb's joints
// moves with them: relative to its parent nothing changes. All is checked by Eigen, in double. That goals are met in
// this space, too, is in test_bodies.cpp.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include <cstring>

#include "tests/body_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

PoseLayout random_layout(Random& random, const BodySkeleton* in_body)
{
    PoseLayout layout;
    layout.form = static_cast<swivel_pose_form>(random.below(SWIVEL_MATRIX_COLUMNS3 + 1));
    layout.translates = layout.scales = in_body || layout.form != SWIVEL_ROTATIONS;
    layout.roots = random.below(2);
    layout.in_body = in_body;
    return layout;
}

struct SolvedPoses {
    BodySkeleton skeleton;
    PoseLayout layout;
    std::vector<Body> was, is;
    PoseBuffer poses;
    std::vector<unsigned char> before;
    std::vector<std::vector<Float4>> joint_rotations;
    std::vector<std::vector<Float3>> joint_places;

    // in_body: of the poses. bad: a body that has bad input.
    SolvedPoses(Random& random, bool in_body, std::size_t bad = ~std::size_t{0})
        : skeleton(
              random_body_skeleton(random, {1 + random.below(20), 1 + random.below(4), random.below(3), false, 0, 3})),
          layout(random_layout(random, in_body ? &skeleton : nullptr)),
          was(random_bodies(random)),
          poses(layout, was)
    {
        Crowd crowd = body_crowd(skeleton, SWIVEL_WITH_HAND, static_cast<std::uint32_t>(was.size()));
        BodyGoals goals;
        for (std::size_t limb = 0; limb < skeleton.limbs.size(); ++limb) {
            goals.emplace_back();
            for (const Body& body : was) goals.back().push_back(random_goal(random, skeleton, body, limb));
            if (bad < was.size()) goals.back()[bad].target[1] = std::nanf("");
        }
        write_goals(crowd, goals);
        swivel_pose pose = poses.view();
        if (bad < was.size()) {  // a finger's -0, which no product gives
            constexpr float kMinusZero = -0.0f;
            std::memcpy(&poses.bytes[bad * poses.body_stride + (skeleton.size() - 1) * pose.rotations.joint_stride],
                        &kMinusZero, sizeof kMinusZero);
        }
        before = poses.bytes;
        joint_rotations.assign(was.size(), std::vector<Float4>(skeleton.size()));
        joint_places.assign(was.size(), std::vector<Float3>(skeleton.size()));
        for (std::size_t n = 0; n < was.size(); ++n) is.push_back({});
        std::vector<Float4> all_rotations(was.size() * skeleton.size());
        std::vector<Float3> all_places(all_rotations.size());
        pose.joint_rotations = {all_rotations.data(), skeleton.size() * sizeof(Float4), sizeof(Float4), nullptr};
        pose.joint_places = {all_places.data(), skeleton.size() * sizeof(Float3), sizeof(Float3), nullptr};
        solve_poses(crowd, pose);
        for (std::size_t n = 0; n < was.size(); ++n) {
            is[n] = poses.read(n, was[n]);
            for (std::size_t joint = 0; joint < skeleton.size(); ++joint) {
                joint_rotations[n][joint] = all_rotations[n * skeleton.size() + joint];
                joint_places[n][joint] = all_places[n * skeleton.size() + joint];
            }
        }
    }

    double bound(const std::vector<JointAt>& at, std::size_t body, std::uint32_t joint) const
    {
        double length = 0;
        for (const BodyLimbJoints& limb : skeleton.limbs)
            length = std::max(length, (at[limb.elbow].place - at[limb.shoulder].place).norm() +
                                          (at[limb.wrist].place - at[limb.elbow].place).norm());
        return 2e-6 * length + 5e-7 * (way_to(skeleton, at, joint) + vec(was[body].root_position).norm());
    }

private:
    std::vector<Body> random_bodies(Random& random)
    {
        std::vector<Body> made;
        for (int n = 0; n < 20; ++n)
            made.push_back(random_body(random, skeleton, {layout.translates, layout.scales, layout.roots}));
        return made;
    }
};

bool is_limb_joint(const BodySkeleton& skeleton, std::uint32_t joint)
{
    return std::ranges::any_of(skeleton.limbs, [&](const BodyLimbJoints& limb) {
        return joint == limb.shoulder || joint == limb.elbow || joint == limb.wrist;
    });
}

}  // namespace

TEST_CASE("poses in the body's space")
{
    rc::prop("carry along what hangs below limbs", [](std::uint64_t seed) {
        Random random{seed};
        const SolvedPoses solved(random, true);
        for (std::size_t n = 0; n < solved.was.size(); ++n) {
            const BodySkeleton& skeleton = solved.skeleton;
            const std::vector<JointAt> at = joints_at(skeleton, solved.is[n]);
            for (std::uint32_t joint = 0; joint < skeleton.size(); ++joint) {
                const Body &was = solved.was[n], &is = solved.is[n];
                const double scale = at[joint].scale / is.scales[joint][0];
                RC_ASSERT(scale * (vec(is.translations[joint]) - vec(was.translations[joint])).norm() <=
                          solved.bound(at, n, joint));
                if (!is_limb_joint(skeleton, joint))
                    RC_ASSERT(quat(is.rotations[joint])
                                  .normalized()
                                  .angularDistance(quat(was.rotations[joint]).normalized()) <= 5e-6);
            }
        }
    });
    rc::prop("keep their bits where input is bad", [](std::uint64_t seed) {
        Random random{seed};
        const SolvedPoses solved(random, true, 7);
        const auto differ = [&](std::size_t n) {
            const std::size_t stride = solved.poses.body_stride;
            return !std::equal(&solved.before[n * stride], &solved.before[n * stride] + stride,
                               &solved.poses.bytes[n * stride]);
        };
        RC_ASSERT(!differ(7));
        RC_ASSERT(differ(6));
        RC_ASSERT(differ(8));
    });
}

TEST_CASE("where joints are after a solve")
{
    rc::prop("is what forward kinematics of the poses says", [](std::uint64_t seed) {
        Random random{seed};
        const SolvedPoses solved(random, random.below(2));
        const BodySkeleton& skeleton = solved.skeleton;
        for (std::size_t n = 0; n < solved.is.size(); ++n) {
            Body body = solved.is[n];
            body.root_rotation = {0, 0, 0, 1}, body.root_scale = 1;
            const std::vector<JointAt> at = joints_at(skeleton, body);
            for (std::uint32_t joint = 0; joint < skeleton.size(); ++joint) {
                const bool is_needed = std::ranges::any_of(
                    skeleton.limbs, [&](const BodyLimbJoints& limb) { return skeleton.is_above(joint, limb.wrist); });
                const Float4& rotation = solved.joint_rotations[n][joint];
                RC_ASSERT((rotation == Float4{}) != is_needed);
                if (!is_needed) continue;
                RC_ASSERT(rotation[3] >= 0);
                RC_ASSERT(quat(rotation).angularDistance(at[joint].rotation) <= 5e-6);
                RC_ASSERT((vec(solved.joint_places[n][joint]) - at[joint].place).norm() <=
                          2e-6 + solved.bound(at, n, joint));
            }
        }
    });
}

TEST_CASE("matrices that go elsewhere are whole")
{
    Random random{3};
    const BodySkeleton skeleton = random_body_skeleton(random, {3, 2, 1, false});
    std::vector<Body> bodies;
    for (int n = 0; n < 20; ++n) bodies.push_back(random_body(random, skeleton, {true, true, false}));
    PoseLayout layout;
    layout.form = GENERATE(SWIVEL_MATRIX_ROWS, SWIVEL_MATRIX_COLUMNS, SWIVEL_MATRIX_COLUMNS3);
    PoseBuffer in_place(layout, bodies), untouched(layout, bodies);
    layout.gap = in_place.body_stride;  // each body's second half is for its results
    PoseBuffer apart(layout, bodies);
    swivel_pose pose = apart.view();
    std::vector<std::size_t> offsets;
    for (std::size_t joint = 0; joint < skeleton.size(); ++joint)
        offsets.push_back(in_place.body_stride + joint * pose.rotations.joint_stride);
    pose.results = pose.rotations, pose.results.offsets = offsets.data();
    Crowd crowd = body_crowd(skeleton, SWIVEL_WITH_HAND, 20);
    BodyGoals goals(2);
    for (std::size_t limb = 0; limb < 2; ++limb)
        for (const Body& body : bodies) goals[limb].push_back(random_goal(random, skeleton, body, limb));
    write_goals(crowd, goals);
    solve_poses(crowd, in_place.view());
    solve_poses(crowd, pose);
    for (std::size_t n = 0; n < bodies.size(); ++n) {
        const unsigned char *const all = &apart.bytes[n * apart.body_stride], *const solved =
                                                                                  &in_place
                                                                                       .bytes[n * in_place.body_stride];
        REQUIRE(std::equal(all, all + in_place.body_stride, &untouched.bytes[n * untouched.body_stride]));
        for (std::uint32_t joint = 0; joint < skeleton.size(); ++joint) {
            if (!is_limb_joint(skeleton, joint)) continue;
            const std::size_t first = joint * pose.rotations.joint_stride;
            const auto is_same = [&](std::size_t number) {
                return std::memcmp(solved + first + 4 * number, all + offsets[joint] + 4 * number, 4) == 0;
            };
            for (std::size_t row = 0; row < 3; ++row)
                for (std::size_t column = 0; column < 4; ++column)
                    REQUIRE(is_same(layout.form == SWIVEL_MATRIX_ROWS      ? 4 * row + column
                                    : layout.form == SWIVEL_MATRIX_COLUMNS ? 4 * column + row
                                                                           : 3 * column + row));
        }
    }
}
