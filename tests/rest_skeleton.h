// SPDX-License-Identifier: MIT
//
// Random skeletons in which an arm is hidden, joints in any order, and where their joints are in the world: forward
// kinematics over all joints, by Eigen in double. Knows nothing of arm frames.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "tests/test_whole_limb.h"

namespace swivel::test {

struct RestSkeleton {
    std::vector<std::int32_t> parents;
    std::vector<Float4> rotations;  // of any length
    std::vector<Float3> translations;
    std::uint32_t shoulder = 0, elbow = 0, wrist = 0;
    std::vector<std::uint32_t> twist_bones, between;
    Float3 bend{};

    std::uint32_t size() const { return static_cast<std::uint32_t>(parents.size()); }
    std::uint32_t add(std::uint32_t parent, const Float4& rotation, const Float3& translation)
    {
        parents.push_back(static_cast<std::int32_t>(parent));
        rotations.push_back(rotation);
        translations.push_back(translation);
        return size() - 1;
    }
    swivel_skeleton view() const { return view_of(*this); }
    swivel_limb_joints joints() const
    {
        swivel_limb_joints joints = swivel_default_limb_joints(shoulder, elbow, wrist);
        joints.twist_bones = twist_bones.data();
        joints.twist_bone_count = static_cast<std::uint32_t>(twist_bones.size());
        std::ranges::copy(bend, joints.bend);
        return joints;
    }
    swivel_binding bound() const { return bind(view(), joints()); }
};

// The local rotations of all joints.
using Locals = std::vector<Quaterniond>;
inline Locals rest_locals(const RestSkeleton& skeleton)
{
    Locals locals;
    for (const Float4& q : skeleton.rotations) locals.push_back(quat(q).normalized());
    return locals;
}

struct JointPlace {
    Quaterniond rotation;
    Vector3d position;
};
// From its root on, which stands in `world`.
inline JointPlace place_of(const RestSkeleton& skeleton, const Locals& locals, const Parent& world, std::uint32_t joint)
{
    const std::int32_t parent = skeleton.parents[joint];
    const JointPlace above = parent < 0 ? JointPlace{world.rotation, world.position}
                                        : place_of(skeleton, locals, world, static_cast<std::uint32_t>(parent));
    return {above.rotation * locals[joint],
            above.position + world.scale * (above.rotation * vec(skeleton.translations[joint]))};
}
inline JointPlace place_of_parent(const RestSkeleton& skeleton, const Locals& locals, const Parent& world,
                                  std::uint32_t joint)
{
    const std::int32_t parent = skeleton.parents[joint];
    return parent < 0 ? JointPlace{world.rotation, world.position}
                      : place_of(skeleton, locals, world, static_cast<std::uint32_t>(parent));
}

// How many joints lie above the shoulder, and between those of the limb.
struct Between {
    std::uint32_t above, upper, fore;
};

inline Float4 random_turn(Random& random)
{
    return floats(Quaterniond(random.spread(0.1, 10) * random.rotation().coeffs()));
}
inline Float3 random_step(Random& random) { return floats(random.vector(0.2, 1)); }

// Every joint gets another index.
inline void shuffle(Random& random, RestSkeleton& skeleton)
{
    std::vector<std::uint32_t> place(skeleton.size());
    std::iota(place.begin(), place.end(), 0u);
    for (std::uint32_t n = skeleton.size(); n > 1; --n) std::swap(place[n - 1], place[random.below(n)]);
    RestSkeleton moved = skeleton;
    for (std::uint32_t n = 0; n < skeleton.size(); ++n) {
        const std::int32_t parent = skeleton.parents[n];
        moved.parents[place[n]] =
            parent < 0 ? -1 : static_cast<std::int32_t>(place[static_cast<std::uint32_t>(parent)]);
        moved.rotations[place[n]] = skeleton.rotations[n];
        moved.translations[place[n]] = skeleton.translations[n];
    }
    for (std::uint32_t* const joint : {&moved.shoulder, &moved.elbow, &moved.wrist}) *joint = place[*joint];
    for (std::uint32_t& joint : moved.twist_bones) joint = place[joint];
    for (std::uint32_t& joint : moved.between) joint = place[joint];
    skeleton = moved;
}

// Lays the forearm along the upper arm.
inline void straighten(Random& random, RestSkeleton& skeleton)
{
    const Locals locals = rest_locals(skeleton);
    const Parent world{Vector3d::Zero(), Quaterniond::Identity(), 1};
    const JointPlace elbow = place_of(skeleton, locals, world, skeleton.elbow);
    const Vector3d upper = elbow.position - place_of(skeleton, locals, world, skeleton.shoulder).position;
    skeleton.translations[skeleton.wrist] =
        floats(Vector3d(elbow.rotation.conjugate() * (random.between(0.2, 1) * upper.normalized())));
}

inline RestSkeleton random_skeleton(Random& random, const Between& between, std::uint32_t twist_bone_count)
{
    RestSkeleton s;
    std::uint32_t last = ~0u;
    const auto add = [&] { return last = s.add(last, random_turn(random), random_step(random)); };
    const auto add_between = [&](std::uint32_t count) {
        for (; count > 0; --count) s.between.push_back(add());
    };
    for (std::uint32_t n = 0; n < between.above; ++n) add();
    s.shoulder = add();
    add_between(between.upper);
    s.elbow = add();
    std::vector<std::uint32_t> carriers = {s.elbow};
    add_between(between.fore);
    carriers.insert(carriers.end(), s.between.end() - between.fore, s.between.end());
    s.wrist = add();
    if (between.fore == 0 && random.below(3) == 0) straighten(random, s);

    // Twist bones below any of the forearm's joints, on a line beside the bone; some below a joint of their own.
    const Locals locals = rest_locals(s);
    const Parent world{Vector3d::Zero(), Quaterniond::Identity(), 1};
    const JointPlace elbow = place_of(s, locals, world, s.elbow);
    const Vector3d fore = place_of(s, locals, world, s.wrist).position - elbow.position;
    for (std::uint32_t n = 0; n < twist_bone_count; ++n) {
        const std::uint32_t carrier = carriers[random.below(static_cast<std::uint32_t>(carriers.size()))];
        const JointPlace from = place_of(s, locals, world, carrier);
        const Vector3d at = elbow.position + (n + 1.0) / (twist_bone_count + 1) * fore + 0.1 * random.across(fore);
        const Vector3d step = from.rotation.conjugate() * (at - from.position);
        last = carrier;
        if (random.below(3) == 0) s.between.push_back(last = s.add(carrier, {0, 0, 0, 2}, {0, 0, 0}));
        s.twist_bones.push_back(last = s.add(last, random_turn(random), floats(step)));
    }
    // Others, which nobody may look at.
    for (const std::uint32_t joint : {s.shoulder, s.elbow, s.wrist, s.twist_bones.empty() ? s.wrist : s.twist_bones[0]})
        s.add(s.add(joint, {0, 0, 0, 0}, {NAN, 0, 0}), {NAN, 0, 0, 0}, {INFINITY, 0, 0});

    const JointPlace shoulder = place_of(s, locals, world, s.shoulder);
    const Vector3d upper = elbow.position - shoulder.position;
    s.bend = floats(
        Vector3d(shoulder.rotation.conjugate() * (random.across(upper) + random.between(-1, 1) * upper.normalized())));
    shuffle(random, s);
    return s;
}

}  // namespace swivel::test
