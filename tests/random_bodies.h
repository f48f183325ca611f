// SPDX-License-Identifier: MIT
//
// Random bodies: a skeleton with limbs beside each other, any joints in between, and poses of it. And where their
// joints are: forward kinematics over all joints, by Eigen in double. Knows nothing of arm frames.
#pragma once

#include <vector>

#include "tests/test_arm.h"
#include "tests/test_random.h"

namespace swivel::test {

struct BodyLimbJoints {
    std::uint32_t shoulder, elbow, wrist;
    Float3 bend;
    std::vector<std::uint32_t> twist_bones;
};

struct BodySkeleton {
    std::vector<std::int32_t> parents;
    std::vector<Float4> rotations;
    std::vector<Float3> translations;
    std::vector<BodyLimbJoints> limbs;

    std::uint32_t size() const { return static_cast<std::uint32_t>(parents.size()); }
    swivel_skeleton view() const { return view_of(*this); }
    swivel_limb_joints joints(std::size_t limb) const;
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
    double most_bend = 3.1;                                  // of elbows, radians
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

// The same values as they are relative to the root, and back.
Body in_body_space(const BodySkeleton& skeleton, const Body& local);
Body from_body_space(const BodySkeleton& skeleton, const Body& in_body);

// The sum of the offsets from the root to a joint, as they are in the world.
double way_to(const BodySkeleton& skeleton, const std::vector<JointAt>& at, std::uint32_t joint);

}  // namespace swivel::test
