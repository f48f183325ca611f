// SPDX-License-Identifier: MIT
//
// Random bodies of every kind that a pose may have, and where one of their limbs is, by Eigen's forward kinematics:
// what tests of swivel_compare() compare with. Poses and places can then be changed as users change them by mistake.
#pragma once

#include <cstring>
#include <functional>

#include "swivel/swivel_explain.hpp"
#include "tests/body_crowd.h"

namespace swivel::test {

using LimbPlaces = std::array<std::array<double, 3>, 3>;

// A kind of rig. Matrices have translations. Bones that stretch are not as long as at rest.
struct RigKind {
    swivel_pose_form form = SWIVEL_ROTATIONS;
    bool in_body = false, translates = false, stretches = false, scales = false;

    bool has_matrices() const { return form != SWIVEL_ROTATIONS; }
};
inline RigKind any_kind(Random& random)
{
    const auto any = [&] { return random.below(2) == 0; };
    RigKind kind;
    if (any()) kind.form = static_cast<swivel_pose_form>(1 + random.below(3));
    kind.in_body = any(), kind.scales = any();
    kind.translates = kind.has_matrices() || any();
    kind.stretches = kind.translates && (kind.has_matrices() || !kind.in_body) && random.below(4) > 0;
    return kind;
}
// Bodies of a crowd, and the pose of one limb that is looked at.
struct Rig {
    BodySkeleton skeleton;
    RigKind kind;
    std::vector<Body> bodies;
    PoseLayout layout;
    PoseBuffer poses;
    Crowd crowd;
    std::uint32_t group, body;
    swivel_pose pose;
    float time = 0.0167f;
    std::vector<std::array<double, 3>> far_roots;  // if they are doubles

    // shows: what the rig must be like.
    Rig(Random& random, bool (*shows)(const RigKind&))
        : skeleton(random_body_skeleton(
              random, {1 + random.below(5), 2 + random.below(2), random.below(3), random.below(2) == 0})),
          kind(kind_that(random, shows)),
          bodies(random_bodies(random)),
          layout{kind.form, kind.translates, kind.scales, true, random.below(60), kind.in_body ? &skeleton : nullptr},
          poses(layout, bodies),
          crowd(body_crowd(skeleton, SWIVEL_POLE_INCOMING, body_count())),
          group(random.below(static_cast<std::uint32_t>(skeleton.limbs.size()))),
          body(random.below(body_count()))
    {
        view_poses();
        if (random.below(3) != 0) return;
        for (const Body& each : bodies)
            far_roots.push_back(numbers(vec(each.root_position) + 1e6 * random.direction()));
        pose.root_is_double = 1;
        pose.root_position = {far_roots.data(), sizeof far_roots[0]};
    }
    Rig(const Rig&) = delete;  // its pose points to itself

    void view_poses()
    {
        far_roots.clear();
        pose = poses.view();
        pose.time = {&time, 0};
    }
    // Makes the crowd anew with another skeleton.
    void bind_to(const BodySkeleton& other) { crowd = body_crowd(other, SWIVEL_POLE_INCOMING, body_count()); }

    std::uint32_t body_count() const { return static_cast<std::uint32_t>(bodies.size()); }
    const BodyLimbJoints& limb() const { return skeleton.limbs[group]; }
    std::uint32_t above(std::uint32_t joint) const { return static_cast<std::uint32_t>(skeleton.parents[joint]); }
    Vector3d root() const
    {
        return far_roots.empty() ? Vector3d(vec(bodies[body].root_position)) : Vector3d(far_roots[body].data());
    }
    Quaterniond root_turn() const { return quat(bodies[body].root_rotation).normalized(); }
    double root_scale() const { return double{bodies[body].root_scale}; }
    // In the world.
    Vector3d place(std::uint32_t joint) const { return root() + joints_at(skeleton, bodies[body])[joint].place; }
    LimbPlaces places(std::uint32_t shoulder, std::uint32_t elbow, std::uint32_t wrist) const
    {
        return {numbers(place(shoulder)), numbers(place(elbow)), numbers(place(wrist))};
    }
    LimbPlaces places(const BodyLimbJoints& joints) const
    {
        return places(joints.shoulder, joints.elbow, joints.wrist);
    }
    LimbPlaces places() const { return places(limb()); }
    static std::array<double, 3> numbers(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
    double length() const { return length_of(joints_at(skeleton, bodies[body]), limb()); }
    Comparison compare(const LimbPlaces& at) const
    {
        return swivel::compare(crowd, group, body, pose, at[0], at[1], at[2]);
    }
    Comparison compare() const { return compare(places()); }

    // 1 where an elbow bends just as the limb's bend says, in the shoulder's frame, and -1 the other way.
    double bend_sense(const Body& made, const BodyLimbJoints& limb) const
    {
        Body rest{skeleton.rotations, skeleton.translations, std::vector(skeleton.size(), Float3{1, 1, 1})};
        const std::vector<JointAt> at = joints_at(skeleton, made), at_rest = joints_at(skeleton, rest);
        const Vector3d upper = at[limb.elbow].place - at[limb.shoulder].place,
                       fore = at[limb.wrist].place - at[limb.elbow].place,
                       bone = at_rest[limb.shoulder].rotation.conjugate() *
                              (at_rest[limb.elbow].place - at_rest[limb.shoulder].place);
        return upper.cross(fore).normalized().dot(at[limb.shoulder].rotation * bone.cross(vec(limb.bend)).normalized());
    }

    // Calls change(floats) for each joint's rotation or matrix of all bodies.
    void change_joints(const std::function<void(float*)>& change)
    {
        const std::size_t count = pose.form == SWIVEL_ROTATIONS ? 4 : pose.form == SWIVEL_MATRIX_COLUMNS ? 16 : 12;
        for (std::size_t n = 0; n < bodies.size(); ++n)
            for (std::uint32_t joint = 0; joint < skeleton.size(); ++joint)
                change_at(static_cast<char*>(pose.rotations.data) + n * pose.rotations.body_stride +
                              joint * pose.rotations.joint_stride,
                          count, change);
    }
    void change_roots(const std::function<void(float*)>& change)
    {
        for (std::size_t n = 0; n < bodies.size(); ++n)
            change_at(static_cast<char*>(const_cast<void*>(pose.root_rotation.data)) + n * pose.root_rotation.stride, 4,
                      change);
    }

private:
    static RigKind kind_that(Random& random, bool (*shows)(const RigKind&))
    {
        for (;;)
            if (const RigKind kind = any_kind(random); shows(kind)) return kind;
    }
    static void change_at(char* at, std::size_t count, const std::function<void(float*)>& change)
    {
        float values[16];
        std::memcpy(values, at, count * sizeof(float));
        change(values);
        std::memcpy(at, values, count * sizeof(float));
    }
    static double length_of(const std::vector<JointAt>& at, const BodyLimbJoints& limb)
    {
        return (at[limb.elbow].place - at[limb.shoulder].place).norm() +
               (at[limb.wrist].place - at[limb.elbow].place).norm();
    }
    // Limbs are about as long as at rest, and bend as there. The root's scale is not by chance that of feet to metres,
    // or of inches to centimetres: such a body says nothing.
    bool is_plausible(const Body& made) const
    {
        for (const double unit : {3.28084, 1 / 3.28084, 2.54, 1 / 2.54})
            if (std::fabs(std::log(double{made.root_scale} / unit)) < 0.01) return false;
        Body rest = made;
        rest.translations = skeleton.translations;
        const std::vector<JointAt> at = joints_at(skeleton, made), at_rest = joints_at(skeleton, rest);
        return std::ranges::all_of(skeleton.limbs, [&](const BodyLimbJoints& limb) {
            const double ratio = length_of(at, limb) / length_of(at_rest, limb);
            return ratio > 0.6 && ratio < 1.7 && bend_sense(made, limb) > 0;
        });
    }
    std::vector<Body> random_bodies(Random& random) const
    {
        std::vector<Body> made;
        while (made.size() < 3) {
            made.push_back(random_body(random, skeleton, {kind.translates && kind.stretches, kind.scales, true, 2.5}));
            if (!is_plausible(made.back())) made.pop_back();
        }
        return made;
    }
};

}  // namespace swivel::test
