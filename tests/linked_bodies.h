// SPDX-License-Identifier: MIT
//
// A crowd of random bodies whose limbs hold each other's hands, or a prop. And where hands and props belong, by Eigen
// in double.
#pragma once

#include <optional>

#include "tests/body_crowd.h"
#include "tests/nearest_in_balls.h"
#include "tests/test_crowd.h"

namespace swivel::test {

// A rotation and a place from the root's.
struct Held {
    Quaterniond rotation;
    Vector3d place;

    Held operator*(const Held& in) const { return {rotation * in.rotation, place + rotation * in.place}; }
    Held inverse() const { return {rotation.conjugate(), -(rotation.conjugate() * place)}; }
};
using Float7 = std::array<float, 7>;
inline Held held(const Float7& v) { return {Quaterniond(v[6], v[3], v[4], v[5]).normalized(), {v[0], v[1], v[2]}}; }
inline Float7 floats(const Held& of)
{
    const Float3 v = floats(of.place);
    const Float4 q = floats(of.rotation);
    return {v[0], v[1], v[2], q[0], q[1], q[2], q[3]};
}

// An input of all bodies.
struct LinkedInput {
    std::uint32_t group;
    swivel_field field;
    std::size_t size;  // numbers of a body
    std::vector<float> numbers;

    template <class Value>
    Value of(std::size_t body) const
    {
        Value value;
        std::memcpy(&value, &numbers[body * size], sizeof value);
        return value;
    }
    float* at(std::size_t body) { return &numbers[body * size]; }
    template <class Value>
    void write(std::size_t body, const Value& value)
    {
        std::memcpy(at(body), &value, sizeof value);
    }
};

inline constexpr std::uint32_t kNoLimbHere = ~0u;
inline constexpr Float3 kNoPlace = {kNan, kNan, kNan};
inline constexpr Float4 kNoTurn = {kNan, kNan, kNan, kNan};

struct LinkedBodies {
    BodySkeleton skeleton;
    std::vector<swivel_limb_joints> joints;  // of each limb
    std::vector<swivel_group_def> groups;
    std::vector<std::uint32_t> limb_of;  // of each group
    std::vector<Body> bodies;
    std::vector<LinkedInput> inputs;
    PoseLayout layout;
    float time = 0.02f;  // of groups that are FIT

    LinkedBodies(Random& random, const SkeletonWish& wish, std::size_t body_count, const PoseLayout& of,
                 double most_bend = 3.1)
        : layout(of)
    {
        skeleton = random_body_skeleton(random, wish);
        for (std::size_t n = 0; n < skeleton.limbs.size(); ++n) joints.push_back(skeleton.joints(n));
        for (std::size_t n = 0; n < body_count; ++n)
            bodies.push_back(random_body(random, skeleton, {of.translates, of.scales, of.roots, most_bend}));
    }
    std::uint32_t add_limb(std::uint32_t limb, swivel_features features, std::uint32_t link = 0)
    {
        groups.push_back(body_group(joints[limb], features));
        groups.back().link = link;
        limb_of.push_back(limb);
        return static_cast<std::uint32_t>(groups.size() - 1);
    }
    std::uint32_t add(const swivel_group_def& no_limb)
    {
        groups.push_back(no_limb);
        limb_of.push_back(kNoLimbHere);
        return static_cast<std::uint32_t>(groups.size() - 1);
    }
    bool has(std::uint32_t group, swivel_features feature) const { return groups[group].features & feature; }

    // Gives an input the values that make(body) makes.
    template <class Make>
    void give(std::uint32_t group, swivel_field field, const Make& make)
    {
        using Value = decltype(make(std::size_t{}));
        LinkedInput& input = inputs.emplace_back(LinkedInput{group, field, sizeof(Value) / sizeof(float), {}});
        input.numbers.resize(input.size * bodies.size());
        for (std::size_t n = 0; n < bodies.size(); ++n) {
            const Value value = make(n);
            std::memcpy(input.at(n), &value, sizeof value);
        }
    }
    const LinkedInput* find(std::uint32_t group, swivel_field field) const
    {
        for (const LinkedInput& input : inputs)
            if (input.group == group && input.field == field) return &input;
        return nullptr;
    }
    LinkedInput* find(std::uint32_t group, swivel_field field)
    {
        return const_cast<LinkedInput*>(static_cast<const LinkedBodies*>(this)->find(group, field));
    }
    template <class Value>
    Value value(std::uint32_t group, swivel_field field, std::size_t body, const Value& otherwise) const
    {
        const LinkedInput* const input = find(group, field);
        return input ? input->of<Value>(body) : otherwise;
    }
    std::uint32_t body_count() const { return static_cast<std::uint32_t>(bodies.size()); }
    Crowd crowd() const
    {
        Crowd made(skeleton.view(), body_count(), groups);
        for (const LinkedInput& input : inputs)
            check(swivel_write(made.get(), input.field, input.group, 0, body_count(),
                               {input.numbers.data(), input.size * sizeof(float)}));
        return made;
    }
    swivel_pose view(PoseBuffer& poses) const
    {
        swivel_pose pose = poses.view();
        pose.time = {&time, 0};
        return pose;
    }
};

struct SolvedLinks {
    const LinkedBodies& of;
    Crowd crowd;
    PoseBuffer poses;

    explicit SolvedLinks(const LinkedBodies& bodies)
        : of(bodies), crowd(bodies.crowd()), poses(bodies.layout, bodies.bodies)
    {
        solve_poses(crowd, of.view(poses));
    }
    template <class Value>
    Value result(swivel_field field, std::uint32_t group, std::size_t body) const
    {
        Value value;
        check(swivel_read(crowd.get(), field, group, static_cast<std::uint32_t>(body), 1, {&value, sizeof value}));
        return value;
    }
    std::uint32_t flags(std::uint32_t group, std::size_t body) const
    {
        return result<std::uint32_t>(SWIVEL_FLAGS, group, body);
    }
    // A frame in the world, as it is from the root.
    Held from_root(swivel_field field, std::uint32_t group, std::size_t body) const
    {
        Held is = held(result<Float7>(field, group, body));
        is.place -= vec(of.bodies[body].root_position);
        return is;
    }
};

// One body: where its joints are, by forward kinematics of Eigen's.
struct LinkedBody {
    const LinkedBodies& of;
    std::size_t n;
    Body was_body;
    std::vector<JointAt> was, is;
    std::vector<double> stretch;  // of each group

    LinkedBody(const SolvedLinks& solved, std::size_t body)
        : of(solved.of),
          n(body),
          was_body(of.bodies[n]),
          was(joints_at(of.skeleton, was_body)),
          is(joints_at(of.skeleton, solved.poses.read(n, was_body)))
    {
        for (std::uint32_t g = 0; g < of.groups.size(); ++g)
            stretch.push_back(of.has(g, SWIVEL_WITH_REACH) ? double{solved.result<float>(SWIVEL_STRETCH, g, body)} : 1);
    }
    const BodyLimbJoints& joints(std::uint32_t group) const { return of.skeleton.limbs[of.limb_of[group]]; }
    // Of the bones' unit.
    double scale(std::uint32_t group) const
    {
        const std::int32_t parent = of.skeleton.parents[joints(group).shoulder];
        return parent < 0 ? double{was_body.root_scale} : was[static_cast<std::size_t>(parent)].scale;
    }
    Held hand(std::uint32_t group) const
    {
        const JointAt &wrist = is[joints(group).wrist], &shoulder = is[joints(group).shoulder];
        return {wrist.rotation, shoulder.place + stretch[group] * (wrist.place - shoulder.place)};
    }
    // The hand with its effector as its place.
    Held point(std::uint32_t group, const Held& hand) const
    {
        const Float3 effector = of.value(group, SWIVEL_EFFECTOR, n, Float3{});
        return {hand.rotation, hand.place + scale(group) * (hand.rotation * vec(effector))};
    }
    Held point(std::uint32_t group) const { return point(group, hand(group)); }
    Held grip(std::uint32_t group) const { return held(of.value(group, SWIVEL_GRIP, n, Float7{})); }
    // Where a limb's point belongs on what it holds, as that is.
    Held wanted(std::uint32_t group, const Held& on) const
    {
        const std::uint32_t link = of.groups[group].link;
        Held in = grip(group);
        if (!of.has(link, SWIVEL_PROP)) in.place *= scale(link);
        return on * in;
    }
    double length(std::uint32_t group) const
    {
        const BodyLimbJoints& limb = joints(group);
        return (was[limb.elbow].place - was[limb.shoulder].place).norm() +
               (was[limb.wrist].place - was[limb.elbow].place).norm();
    }
    // What floats may be off, as they know where the hand is from the root.
    double rounding(std::uint32_t group) const
    {
        const std::uint32_t link = of.groups[group].link;
        const double grip_scale = !of.has(group, SWIVEL_WITH_LINK) || of.has(link, SWIVEL_PROP) ? 1 : scale(link);
        return (of.layout.in_body ? 8e-7 : 3e-7) *
               (way_to(of.skeleton, was, joints(group).wrist) + grip_scale * grip(group).place.norm());
    }
    double bound(std::uint32_t group) const { return 2e-6 * length(group) + rounding(group); }
    std::array<Float4, 3> local(std::uint32_t group, const Body& body) const
    {
        const BodyLimbJoints& limb = joints(group);
        return {body.rotations[limb.shoulder], body.rotations[limb.elbow], body.rotations[limb.wrist]};
    }
};

}  // namespace swivel::test
