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
    std::vector<Float4> joint_rotations;  // body after body
    std::vector<Float3> joint_places;

    // groups: of the solve; none: all.
    explicit SolvedLinks(const LinkedBodies& bodies, const std::vector<std::uint32_t>& groups = {})
        : of(bodies),
          crowd(bodies.crowd()),
          poses(bodies.layout, bodies.bodies),
          joint_rotations(bodies.bodies.size() * bodies.skeleton.size()),
          joint_places(joint_rotations.size())
    {
        swivel_pose pose = of.view(poses);
        const std::size_t count = of.skeleton.size();
        pose.joint_rotations = {joint_rotations.data(), count * sizeof(Float4), sizeof(Float4), nullptr};
        pose.joint_places = {joint_places.data(), count * sizeof(Float3), sizeof(Float3), nullptr};
        Job job{.pose = &pose};
        if (!groups.empty()) job.groups = groups;
        crowd.solve(job);
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
    // The scale of the bones' unit.
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
    // How far floats may be off, as they know where the hand is from the root.
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

// Bodies in which all that holds comes together: two hands on a prop, a hand on one of these, a hand on a free limb's,
// a hand on a prop of a joint, and a leg that shifts the body.
struct HoldingBodies : LinkedBodies {
    enum Group : std::uint32_t { prop, left, right, third, free, follower, leg, fit, handle, on_handle };

    HoldingBodies(Random& random, std::size_t body_count, const PoseLayout& of,
                  swivel_on_bad_input on_bad_input = SWIVEL_KEEP_POSE)
        : LinkedBodies(random, {3, 7, 1, false}, body_count, of)
    {
        constexpr swivel_features kHand = SWIVEL_WITH_HAND | SWIVEL_WITH_RECORD, kLinked = kHand | SWIVEL_WITH_LINK;
        add(swivel_default_prop_group_def());
        add_limb(0, kLinked | SWIVEL_POLE_INCOMING, prop);
        add_limb(1, kLinked | SWIVEL_WITH_EFFECTOR | SWIVEL_POLE_INCOMING, prop);
        add_limb(2, kLinked | SWIVEL_HAND_YIELDS | SWIVEL_WITH_EFFECTOR, left);
        add_limb(3, kHand | SWIVEL_WITH_REACH);
        add_limb(4, kLinked | SWIVEL_WITH_CAP | SWIVEL_POLE_INCOMING, free);
        add_limb(5, kHand | SWIVEL_WITH_FIT | SWIVEL_POLE_INCOMING);
        add(swivel_default_fit_group_def());
        add(swivel_default_prop_group_def());
        groups.back().prop.joint = 1;
        add_limb(6, kLinked | SWIVEL_WITH_WEIGHTS | SWIVEL_POLE_INCOMING, handle);
        for (swivel_group_def& group : groups) group.on_bad_input = on_bad_input;
        for (const std::uint32_t g : {free, leg}) {
            give(g, SWIVEL_TARGET, [&](std::size_t n) { return goal(random, g, n).target; });
            give(g, SWIVEL_HAND, [&](std::size_t n) { return goal(random, g, n).hand; });
        }
        for (const std::uint32_t g : {free, third})
            give(g, SWIVEL_POLE, [&](std::size_t n) { return goal(random, g, n).pole; });
        give(left, SWIVEL_TARGET, [&](std::size_t n) { return n % 3 == 0 ? goal(random, left, n).target : kNoPlace; });
        for (const std::uint32_t g : {right, third})
            give(g, SWIVEL_EFFECTOR, [&](std::size_t) { return floats(Vector3d(0.05 * random.direction())); });
        for (const std::uint32_t g : {left, right, third, follower, on_handle})
            give(g, SWIVEL_GRIP, [&](std::size_t) { return floats(Held{random.rotation(), random.vector(0, 0.3)}); });
        give(on_handle, SWIVEL_WEIGHTS, [&](std::size_t n) { return Float3{n % 2 ? 1.0f : 0.5f, 1, 0.5f}; });
        give(prop, SWIVEL_PROP_SHARE, [&](std::size_t n) { return Float1{static_cast<float>(n % 4) / 3}; });
        give(prop, SWIVEL_PROP_PLACE, [&](std::size_t n) { return n % 5 ? kNoPlace : goal(random, right, n).target; });
        give(prop, SWIVEL_PROP_TURN, [&](std::size_t n) { return n % 7 ? kNoTurn : goal(random, right, n).hand; });
    }

private:
    BodyGoal goal(Random& random, std::uint32_t g, std::size_t n) const
    {
        return random_goal(random, skeleton, bodies[n], limb_of[g]);
    }
};

// Every bit that a solve left of a body: its results, and its pose.
inline std::vector<std::uint32_t> bits_of_body(const LinkedBodies& of, const Crowd& crowd, const PoseBuffer& poses,
                                               std::size_t n)
{
    std::vector<std::uint32_t> bits;
    swivel_field_info info;
    for (std::uint32_t g = 0; g < of.groups.size(); ++g)
        for (std::uint32_t i = 0; swivel_describe_field(i, &info); ++i) {
            const std::uint32_t count = swivel_field_row_count(crowd.get(), g, info.field);
            if (info.kind == SWIVEL_FIELD_INPUT || count == 0) continue;
            bits.resize(bits.size() + count);
            check(swivel_read(crowd.get(), info.field, g, static_cast<std::uint32_t>(n), 1,
                              {&bits[bits.size() - count], count * sizeof bits[0]}));
        }
    const unsigned char* const first = &poses.bytes[n * poses.body_stride];
    bits.insert(bits.end(), first, first + poses.body_stride);
    return bits;
}

}  // namespace swivel::test
