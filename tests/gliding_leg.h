// SPDX-License-Identifier: MIT
//
// A body whose one leg is planted while its root glides.
#pragma once

#include <optional>

#include "swivel/swivel_bodies.hpp"
#include "swivel/swivel_explain.hpp"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"

namespace swivel::test {

// A body of one planted leg. Its pose stays as it is while its root glides along x, so where the animation has the foot
// is known without the library.
struct GlidingLeg {
    static constexpr std::array<std::int32_t, 4> kParents = {-1, 0, 1, 2};  // hips, thigh, shin, foot
    static constexpr std::array<Float3, 4> kOffsets = {{{0, 1, 0}, {0.1f, 0, 0}, {0, -0.5f, 0}, {0, -0.4f, 0}}};
    static constexpr double kLength = 0.9;
    static constexpr float kFrame = 0.02f;
    static constexpr swivel_features kPlants = SWIVEL_POLE_INCOMING | SWIVEL_WITH_RECORD | SWIVEL_WITH_PLANT;
    static constexpr swivel_features kStands =
        kPlants | SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_HAND_YIELDS | SWIVEL_WITH_GROUND;

    swivel_limb_joints joints = joints_of_leg();
    std::vector<Definition> groups;
    Crowd crowd;
    std::array<Float4, 4> rotations{};
    Float3 root{}, support{};
    float time = kFrame, scale = 1;
    float stretch = 1;  // of the pose's bones
    bool is_in_place = false;
    bool is_masked = false;         // the job has a mask, with all bodies
    bool has_joint_scales = false;  // of 1
    std::optional<Float4> root_turn;
    std::vector<Vector3d> sent;  // the target of each frame

    explicit GlidingLeg(swivel_features features = kPlants, swivel_plant plant = swivel_default_plant(),
                        swivel_ground ground = swivel_default_ground())
        : groups(groups_of(joints, features, plant, ground)), crowd(skeleton(), 1, groups)
    {
        rotations.fill({0, 0, 0, 1});
        rotations[1] = {-std::sin(0.2f), 0, 0, std::cos(0.2f)};
        rotations[2] = {std::sin(0.4f), 0, 0, std::cos(0.4f)};
    }
    // The ankle as the pose has it, in the world.
    Vector3d animated() const
    {
        const Quaterniond thigh = quat(rotations[1]), shin = thigh * quat(rotations[2]);
        const Vector3d hip(0.1, 1, 0), leg = thigh * Vector3d(0, -0.5, 0) + shin * Vector3d(0, -0.4, 0);
        return vec(root) + double{scale} * (hip + leg);
    }
    void solve()
    {
        std::array<Float4, 4> solved = rotations;
        swivel_pose pose = swivel_default_pose();
        pose.rotations = {rotations.data(), sizeof rotations, sizeof rotations[0], nullptr};
        if (!is_in_place) pose.results = {solved.data(), sizeof solved, sizeof solved[0], nullptr};
        std::array<Float3, 4> places = kOffsets;
        for (Float3& place : places)
            for (float& number : place) number *= stretch;
        if (stretch != 1) pose.translations = {places.data(), sizeof places, sizeof places[0], nullptr};
        pose.root_position = {&root, 0};
        pose.root_scale = {&scale, 0};
        if (root_turn) pose.root_rotation = {&*root_turn, 0};
        Float3 unscaled{1, 1, 1};
        if (has_joint_scales) pose.scales = {unscaled.data(), 0, 0, nullptr};
        pose.support_position = {&support, 0};
        pose.time = {&time, 0};
        const std::uint32_t mask[] = {1};
        Job job{.pose = &pose};
        if (is_masked) job.mask = mask;
        crowd.solve(job);
        if (!(swivel_group_features(crowd.get(), 0) & SWIVEL_WITH_PLANT)) return;
        std::array<float, 7> goal;
        crowd.read(SWIVEL_SOLVED_GOAL, 0, std::span(&goal, 1));
        sent.emplace_back(goal[0], goal[1], goal[2]);
    }
    // Frames in which the root glides along x.
    void glide(float label, double speed, int frames = 1)
    {
        if (swivel_field_row_count(crowd.get(), 0, SWIVEL_CONTACT))
            crowd.write_all(SWIVEL_CONTACT, 0, std::array{label});
        for (int n = 0; n < frames; ++n) {
            root[0] += static_cast<float>(speed * double{time});
            solve();
        }
    }
    std::string text(std::uint32_t group = 0) const { return explain(crowd, group, 0); }
    std::uint32_t flags() const
    {
        std::uint32_t flags = 0;
        crowd.read(SWIVEL_FLAGS, 0, std::span(&flags, 1));
        return flags;
    }

    static swivel_skeleton skeleton()
    {
        swivel_skeleton made = swivel_default_skeleton();
        made.parents = stream(kParents);
        made.translations = stream(kOffsets);
        made.joint_count = 4;
        return made;
    }

private:
    static swivel_limb_joints joints_of_leg()
    {
        swivel_limb_joints made = swivel_default_limb_joints(1, 2, 3);
        made.bend[2] = -1;
        return made;
    }
    static std::vector<Definition> groups_of(const swivel_limb_joints& joints, swivel_features features,
                                             const swivel_plant& plant, const swivel_ground& ground)
    {
        swivel_body_limb_def leg = body_limb(joints, features);
        leg.plant = plant;
        leg.ground = ground;
        std::vector<Definition> groups = {leg};
        if (features & SWIVEL_WITH_PELVIS_FIT) groups.push_back(swivel_default_shift_def());
        return groups;
    }
};

// The default but for one number.
inline swivel_plant plant_with(float swivel_plant::*member, float value)
{
    swivel_plant plant = swivel_default_plant();
    plant.*member = value;
    return plant;
}

}  // namespace swivel::test
