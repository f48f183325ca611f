// SPDX-License-Identifier: MIT
//
// Random bodies: a skeleton with limbs beside each other and any joints in between; poses of it, as engines keep them
// in memory; and crowds of them with goals. Eigen finds in double where their joints are, by forward kinematics over
// all joints. It knows nothing of arm frames.
#pragma once

#include <functional>
#include <vector>

#include "swivel/swivel_bodies.hpp"
#include "tests/test_arm.h"
#include "tests/test_random.h"

namespace swivel::test {

struct BodyLimbJoints {
    std::uint32_t shoulder, elbow, wrist;
    Float3 bend;
    std::vector<std::uint32_t> twist_bones;
};

struct Body;
struct BodySkeleton {
    std::vector<std::int32_t> parents;
    std::vector<Float4> rotations;
    std::vector<Float3> translations;
    std::vector<BodyLimbJoints> limbs;

    std::uint32_t size() const { return static_cast<std::uint32_t>(parents.size()); }
    swivel_skeleton view() const { return view_of(*this); }
    swivel_limb_joints joints(std::size_t limb) const;
    Body rest() const;
    // Whether a joint is another or above it.
    bool is_above(std::uint32_t joint, std::uint32_t below) const;
};

struct SkeletonWish {
    std::uint32_t trunk, limbs, between;  // joints of the trunk; limbs; the most joints in between of each bone
    bool is_chain;                        // the trunk is one line of joints
    std::uint32_t twist_bones = 0;        // of each limb, halfway to the wrist
    std::uint32_t fingers = 0;            // joints below each wrist, in a line
};
BodySkeleton random_body_skeleton(Random& random, const SkeletonWish& wish);

// A body: what it has of each joint, and its root.
struct Body {
    std::vector<Float4> rotations;
    std::vector<Float3> translations, scales;
    Float3 root_position{};
    Float4 root_rotation{0, 0, 0, 1};
    float root_scale = 1;
};
struct BodyWish {
    bool translates = false, scales = false, roots = false;  // its own; one joint in four is scaled
    double max_bend = 3.1;                                   // of elbows, radians
};
// Each limb's elbow is bent by 1e-2 to the most bend, to any side.
Body random_body(Random& random, const BodySkeleton& skeleton, const BodyWish& wish);

struct JointAt {
    Quaterniond rotation;
    Vector3d place;
    double scale;
};
// Where all joints of a body are: from the root's place, in the world's directions.
std::vector<JointAt> joints_at(const BodySkeleton& skeleton, const Body& body);
// The same below a root that is anywhere.
std::vector<JointAt> joints_at(const BodySkeleton& skeleton, const Body& body, const JointAt& root);

// The same values as they are relative to the root, and back.
Body in_body_space(const BodySkeleton& skeleton, const Body& local);
Body from_body_space(const BodySkeleton& skeleton, const Body& in_body);

// The sum of the offsets from the root to a joint, as they are in the world.
double way_to(const BodySkeleton& skeleton, const std::vector<JointAt>& at, std::uint32_t joint);

struct PoseLayout {
    swivel_pose_form form = SWIVEL_ROTATIONS;
    bool translates = false, scales = false, roots = false;
    std::size_t gap = 0;                    // bytes after each body
    const BodySkeleton* in_body = nullptr;  // then all is relative to the root
};

PoseLayout random_layout(Random& random);  // of any form

// Bytes between values are a pattern that nobody may change.
struct PoseBuffer {
    PoseLayout layout;
    std::size_t joint_count, body_stride;
    std::vector<unsigned char> bytes;

    PoseBuffer(const PoseLayout& of, std::size_t joints, std::size_t bodies);
    PoseBuffer(const PoseLayout& of, const std::vector<Body>& bodies);

    void write(std::size_t n, const Body& body);
    // The body that it holds. Values that its form has none of are taken from `otherwise`.
    Body read(std::size_t n, const Body& otherwise) const;
    Eigen::Matrix3d matrix(std::size_t n, std::size_t joint) const;                  // where its form has matrices
    std::vector<unsigned char> joint_bytes(std::size_t n, std::size_t joint) const;  // of its rotation or matrix
    swivel_pose view();

private:
    static constexpr std::size_t kPattern = 0xa5;
    std::size_t rotation_bytes() const;
    std::size_t rotation_at(std::size_t n, std::size_t joint) const;
    std::size_t translation_at(std::size_t n, std::size_t joint) const;
    std::size_t scale_at(std::size_t n, std::size_t joint) const;
    std::size_t root_at(std::size_t n) const;
    // The bytes from a matrix to its element.
    std::size_t element(int row, int column) const;
};

// A group for each limb, with the same features, as edit(limb) leaves it; and more groups after them.
inline Crowd body_crowd(const BodySkeleton& skeleton, swivel_features features, std::uint32_t body_count,
                        const std::function<void(swivel_body_limb_def&)>& edit = {},
                        const std::vector<Definition>& more = {})
{
    std::vector<swivel_limb_joints> joints;
    for (std::size_t n = 0; n < skeleton.limbs.size(); ++n) joints.push_back(skeleton.joints(n));
    std::vector<Definition> groups;
    for (const swivel_limb_joints& each : joints) {
        swivel_body_limb_def limb = body_limb(each, features);
        if (edit) edit(limb);
        groups.push_back(limb);
    }
    groups.insert(groups.end(), more.begin(), more.end());
    return Crowd(skeleton.view(), body_count, groups);
}

// Where a limb goes.
struct BodyGoal {
    Float3 target, pole;
    Float4 hand;
};

// The limb's own wrist.
BodyGoal own_goal(const BodySkeleton& skeleton, const Body& body, std::size_t limb);
// Any that the limb reaches.
BodyGoal random_goal(Random& random, const BodySkeleton& skeleton, const Body& body, std::size_t limb);

// A limb as it comes.
struct LimbAt {
    double upper, fore, sine, way;  // way: of the joints from the root, and what a float target is off

    LimbAt(const BodySkeleton& skeleton, const Body& body, const std::vector<JointAt>& at, const BodyLimbJoints& limb)
    {
        const Vector3d first = at[limb.elbow].place - at[limb.shoulder].place,
                       second = at[limb.wrist].place - at[limb.elbow].place;
        upper = first.norm(), fore = second.norm();
        sine = first.cross(second).norm() / (upper * fore);
        way = way_to(skeleton, at, limb.wrist) + vec(body.root_position).norm() / 3;  // rounded to 1e-7 of it
    }
    double length() const { return upper + fore; }
    // How far a wrist may be off; and a joint, because floats know the distance to the wrist only so well.
    double wrist_bound() const { return 2e-6 * length() + 3e-7 * way; }
    double joint_bound() const { return 2e-6 + (4e-7 * length() + 3e-7 * way) * length() / (upper * fore * sine); }
};

// How far a limb with an untouched goal is from where it was: the worst share of what is allowed.
inline double strayed(const LimbAt& limb, const BodyLimbJoints& joints, const std::vector<JointAt>& was,
                      const std::vector<JointAt>& is)
{
    double worst = 0;
    const auto keep = [&](double share) { worst = share <= worst ? worst : share; };  // NaN stays
    const auto turned = [&](std::uint32_t joint) { return is[joint].rotation.angularDistance(was[joint].rotation); };
    keep((is[joints.wrist].place - was[joints.wrist].place).norm() / limb.wrist_bound());
    keep(turned(joints.shoulder) / limb.joint_bound());
    keep(turned(joints.elbow) / limb.joint_bound());
    keep(turned(joints.wrist) / 5e-6);
    return worst;
}

inline void solve_poses(Crowd& crowd, const swivel_pose& pose) { crowd.solve({.pose = &pose}); }

}  // namespace swivel::test
