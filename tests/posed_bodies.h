// SPDX-License-Identifier: MIT
//
// A crowd of bodies with any groups and inputs, solved, and where joints, hands and props are then, by Eigen in double.
// Limbs may hold each other's hands, or a prop.
#pragma once

#include <optional>
#include <string_view>

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
struct BodyInput {
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

struct PosedBodies {
    BodySkeleton skeleton;
    std::vector<swivel_limb_joints> joints;  // of each limb
    std::vector<Definition> groups;
    std::vector<std::uint32_t> limb_of;  // of each group
    std::vector<Body> bodies;
    std::vector<BodyInput> inputs;
    PoseLayout layout;
    bool is_in_body = false;  // poses are in the body's space
    float time = 0.02f;
    std::vector<std::array<double, 3>> far_roots;  // if any, the roots' positions, in doubles

    PosedBodies(Random& random, const SkeletonWish& wish, std::size_t body_count, const PoseLayout& of,
                double max_bend = 3.1)
        : layout(of)
    {
        skeleton = random_body_skeleton(random, wish);
        for (std::size_t n = 0; n < skeleton.limbs.size(); ++n) joints.push_back(skeleton.joints(n));
        for (std::size_t n = 0; n < body_count; ++n)
            bodies.push_back(random_body(random, skeleton, {of.translates, of.scales, of.roots, max_bend}));
    }
    PosedBodies(BodySkeleton of, std::vector<Body> all, const PoseLayout& with)
        : skeleton(std::move(of)), bodies(std::move(all)), layout(with)
    {
        for (std::size_t n = 0; n < skeleton.limbs.size(); ++n) joints.push_back(skeleton.joints(n));
    }
    void put_in_body_space() { layout.translates = layout.scales = is_in_body = true; }
    std::uint32_t add_limb(std::uint32_t limb, swivel_features features, std::uint32_t link = 0)
    {
        swivel_body_limb_def def = body_limb(joints[limb], features);
        def.link = link;
        groups.push_back(def);
        limb_of.push_back(limb);
        return static_cast<std::uint32_t>(groups.size() - 1);
    }
    // All limbs, each in a group of its own.
    void add_limbs(swivel_features features)
    {
        for (std::uint32_t limb = 0; limb < skeleton.limbs.size(); ++limb) add_limb(limb, features);
    }
    std::uint32_t add(const Definition& no_limb)
    {
        groups.push_back(no_limb);
        limb_of.push_back(kNoLimbHere);
        return static_cast<std::uint32_t>(groups.size() - 1);
    }
    swivel_body_limb_def& limb_def(std::uint32_t group) { return std::get<swivel_body_limb_def>(groups[group]); }
    const swivel_body_limb_def& limb_def(std::uint32_t group) const
    {
        return std::get<swivel_body_limb_def>(groups[group]);
    }
    bool is_limb(std::uint32_t group) const { return std::holds_alternative<swivel_body_limb_def>(groups[group]); }
    bool is_prop(std::uint32_t group) const { return std::holds_alternative<swivel_prop_def>(groups[group]); }
    // Whether it is a limb with one of these features.
    bool has(std::uint32_t group, swivel_features some) const
    {
        return is_limb(group) && limb_def(group).features & some;
    }

    // Gives an input the values that make(body) makes.
    template <class Make>
    void give(std::uint32_t group, swivel_field field, const Make& make)
    {
        using Value = decltype(make(std::size_t{}));
        BodyInput& input = inputs.emplace_back(BodyInput{group, field, sizeof(Value) / sizeof(float), {}});
        input.numbers.resize(input.size * bodies.size());
        for (std::size_t n = 0; n < bodies.size(); ++n) {
            const Value value = make(n);
            std::memcpy(input.at(n), &value, sizeof value);
        }
    }
    // Gives a limb the goals that goal_of(body) makes, as far as its group has inputs for them.
    template <class GoalOf>
    void give_goals(std::uint32_t group, const GoalOf& goal_of)
    {
        std::vector<BodyGoal> goals;
        for (std::size_t n = 0; n < bodies.size(); ++n) goals.push_back(goal_of(n));
        give(group, SWIVEL_TARGET, [&](std::size_t n) { return goals[n].target; });
        if (!has(group, SWIVEL_POLE_INCOMING | SWIVEL_POLE_HAND | SWIVEL_POLE_HALF_LINE))
            give(group, SWIVEL_POLE, [&](std::size_t n) { return goals[n].pole; });
        if (has(group, SWIVEL_WITH_HAND)) give(group, SWIVEL_HAND, [&](std::size_t n) { return goals[n].hand; });
    }
    // A goal in reach.
    BodyGoal goal(Random& random, std::uint32_t group, std::size_t n) const
    {
        return random_goal(random, skeleton, bodies[n], limb_of[group]);
    }
    void give_random_goals(Random& random)
    {
        for (std::uint32_t g = 0; g < groups.size(); ++g)
            if (limb_of[g] != kNoLimbHere) give_goals(g, [&](std::size_t n) { return goal(random, g, n); });
    }
    // Gives inputs that a limb's features need beside goals and weights.
    void give_limits(Random& random, std::uint32_t g)
    {
        const auto number = [&](double a, double b) { return static_cast<float>(random.between(a, b)); };
        const auto give_if = [&](swivel_features feature, swivel_field field, const auto& make) {
            if (has(g, feature)) give(g, field, [&](std::size_t) { return make(); });
        };
        const auto any_cone = [&] {
            const Vector3d axis = random.direction();
            return cone({axis.x(), axis.y(), axis.z()}, random.between(0.3, 2));
        };
        const auto give_made = [&](std::string_view function, const auto& make) {
            for (const swivel_field field : every_field())
                if (is_made_by(function, field)) give_if(describe(field).needs, field, make);
        };
        give_made("swivel_cos_sin()", [&] { return cos_sin(random.between(0.1, 3)); });
        give_made("swivel_flexion()", [&] { return flexion(random.between(0, 0.5), random.between(2, 3.1)); });
        give_made("swivel_cone()", any_cone);
        give_if(SWIVEL_WITH_EFFECTOR, SWIVEL_EFFECTOR, [&] { return floats(random.vector(0, 0.1)); });
        give_if(SWIVEL_WITH_CAP, SWIVEL_CAP, [&] { return Float3{number(0, 0.1), number(0.5, 1), 0}; });
        give_if(SWIVEL_WITH_REACH, SWIVEL_REACH, [&] {
            return Float4{number(0, 0.1), number(0, 0.05), number(1, 1.3), number(0, 0.1)};
        });
    }
    const BodyInput* find(std::uint32_t group, swivel_field field) const
    {
        for (const BodyInput& input : inputs)
            if (input.group == group && input.field == field) return &input;
        return nullptr;
    }
    BodyInput* find(std::uint32_t group, swivel_field field)
    {
        return const_cast<BodyInput*>(static_cast<const PosedBodies*>(this)->find(group, field));
    }
    template <class Value>
    Value value(std::uint32_t group, swivel_field field, std::size_t body, const Value& otherwise) const
    {
        const BodyInput* const input = find(group, field);
        return input ? input->of<Value>(body) : otherwise;
    }
    std::uint32_t body_count() const { return static_cast<std::uint32_t>(bodies.size()); }
    Crowd crowd() const
    {
        Crowd made(skeleton.view(), body_count(), groups);
        write(made);
        return made;
    }
    void write(Crowd& to) const
    {
        for (const BodyInput& input : inputs)
            check(swivel_write(to.get(), input.field, input.group, 0, body_count(),
                               {input.numbers.data(), input.size * sizeof(float)}));
    }
    // The poses as they come.
    PoseBuffer incoming() const
    {
        PoseLayout of = layout;
        of.in_body = is_in_body ? &skeleton : nullptr;
        return PoseBuffer(of, bodies);
    }
    swivel_pose view(PoseBuffer& poses) const
    {
        swivel_pose pose = poses.view();
        pose.time = {&time, 0};
        if (far_roots.empty()) return pose;
        pose.root_is_double = 1;
        pose.root_position = {far_roots.data(), sizeof far_roots[0]};
        pose.support_position = {far_roots.data(), 0};  // near all of them
        return pose;
    }
};

struct SolvedBodies {
    const PosedBodies& of;
    std::vector<std::uint32_t> groups;  // that the job names; none: all
    Crowd crowd;
    PoseBuffer poses;
    std::vector<Float4> joint_rotations;  // body after body
    std::vector<Float3> joint_positions;

    explicit SolvedBodies(const PosedBodies& bodies, std::vector<std::uint32_t> some = {})
        : SolvedBodies(bodies, bodies.incoming(), std::move(some))
    {
    }
    SolvedBodies(const PosedBodies& bodies, PoseBuffer come, std::vector<std::uint32_t> some = {})
        : of(bodies),
          groups(std::move(some)),
          crowd(bodies.crowd()),
          poses(std::move(come)),
          joint_rotations(bodies.bodies.size() * bodies.skeleton.size()),
          joint_positions(joint_rotations.size())
    {
        solve();
    }
    // Solves the poses that are there.
    void solve()
    {
        swivel_pose pose = of.view(poses);
        const std::size_t count = of.skeleton.size();
        pose.joint_rotations = {joint_rotations.data(), count * sizeof(Float4), sizeof(Float4), nullptr};
        pose.joint_positions = {joint_positions.data(), count * sizeof(Float3), sizeof(Float3), nullptr};
        Job job{.pose = &pose};
        if (!groups.empty()) job.groups = groups;
        crowd.solve(job);
    }
    // Another frame, from the poses that come.
    void solve_next() { poses = of.incoming(), solve(); }
    template <class Value>
    Value result(swivel_field field, std::uint32_t group, std::size_t body) const
    {
        return value_of<Value>(crowd, field, group, static_cast<std::uint32_t>(body));
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
struct SolvedBody {
    const PosedBodies& bodies;
    std::size_t n;
    Body incoming;
    std::vector<JointAt> came, solved;
    std::vector<double> stretch;  // of each group

    SolvedBody(const SolvedBodies& all, std::size_t body)
        : bodies(all.of),
          n(body),
          incoming(bodies.bodies[n]),
          came(joints_at(bodies.skeleton, incoming)),
          solved(joints_at(bodies.skeleton, all.poses.read(n, incoming)))
    {
        for (std::uint32_t g = 0; g < bodies.groups.size(); ++g)
            stretch.push_back(bodies.has(g, SWIVEL_WITH_REACH) ? double{all.result<float>(SWIVEL_STRETCH, g, body)}
                                                               : 1);
    }
    const BodyLimbJoints& joints(std::uint32_t group) const { return bodies.skeleton.limbs[bodies.limb_of[group]]; }
    Vector3d root() const { return vec(incoming.root_position); }
    // The limb as it came, and how far an untouched goal has left it from there, as a share of what is allowed.
    LimbAt limb(std::uint32_t group) const { return LimbAt(bodies.skeleton, incoming, came, joints(group)); }
    double strayed(std::uint32_t group) const { return test::strayed(limb(group), joints(group), came, solved); }
    // By which a joint has turned, in the world.
    Quaterniond turn(std::uint32_t joint) const { return solved[joint].rotation * came[joint].rotation.conjugate(); }
    // The scale of the bones' unit.
    double scale(std::uint32_t group) const
    {
        const std::int32_t parent = bodies.skeleton.parents[joints(group).shoulder];
        return parent < 0 ? double{incoming.root_scale} : came[static_cast<std::size_t>(parent)].scale;
    }
    Held hand(std::uint32_t group) const
    {
        const JointAt &wrist = solved[joints(group).wrist], &shoulder = solved[joints(group).shoulder];
        return {wrist.rotation, shoulder.place + stretch[group] * (wrist.place - shoulder.place)};
    }
    // The hand with its effector as its place.
    Held point(std::uint32_t group, const Held& hand) const
    {
        const Float3 effector = bodies.value(group, SWIVEL_EFFECTOR, n, Float3{});
        return {hand.rotation, hand.place + scale(group) * (hand.rotation * vec(effector))};
    }
    Held point(std::uint32_t group) const { return point(group, hand(group)); }
    Held grip(std::uint32_t group) const { return held(bodies.value(group, SWIVEL_GRIP, n, Float7{})); }
    // Where a limb's point belongs on what it holds, as that is.
    Held wanted(std::uint32_t group, const Held& on) const
    {
        const std::uint32_t link = bodies.limb_def(group).link;
        Held in = grip(group);
        if (!bodies.is_prop(link)) in.place *= scale(link);
        return on * in;
    }
    double length(std::uint32_t group) const { return limb(group).length(); }
    // How far floats may be off, as they know where the hand is from the root.
    double rounding(std::uint32_t group) const
    {
        const std::uint32_t link = bodies.limb_def(group).link;
        const double grip_scale = !bodies.has(group, SWIVEL_WITH_LINK) || bodies.is_prop(link) ? 1 : scale(link);
        return (bodies.is_in_body ? 8e-7 : 3e-7) *
               (way_to(bodies.skeleton, came, joints(group).wrist) + grip_scale * grip(group).place.norm());
    }
    double bound(std::uint32_t group) const { return 2e-6 * length(group) + rounding(group); }
};

// Bodies in which all that holds comes together: two hands on a prop, a hand on one of these, a hand on a free limb's,
// a hand on a prop of a joint, and a leg that shifts the body.
struct HoldingBodies : PosedBodies {
    enum Group : std::uint32_t { prop, left, right, third, free, follower, leg, shift, handle, on_handle };

    HoldingBodies(Random& random, std::size_t body_count, const PoseLayout& of,
                  swivel_on_bad_input on_bad_input = SWIVEL_KEEP_POSE)
        : PosedBodies(random, {3, 7, 1, false}, body_count, of)
    {
        constexpr swivel_features kHand = SWIVEL_WITH_HAND | SWIVEL_WITH_RECORD, kLinked = kHand | SWIVEL_WITH_LINK;
        add(swivel_default_prop_def());
        add_limb(0, kLinked | SWIVEL_POLE_INCOMING, prop);
        add_limb(1, kLinked | SWIVEL_WITH_EFFECTOR | SWIVEL_POLE_INCOMING, prop);
        add_limb(2, kLinked | SWIVEL_HAND_YIELDS | SWIVEL_WITH_EFFECTOR, left);
        add_limb(3, kHand | SWIVEL_WITH_REACH);
        add_limb(4, kLinked | SWIVEL_WITH_CAP | SWIVEL_POLE_INCOMING, free);
        add_limb(5, kHand | SWIVEL_WITH_PELVIS_FIT | SWIVEL_POLE_INCOMING);
        add(swivel_default_shift_def());
        swivel_prop_def on_joint = swivel_default_prop_def();
        on_joint.joint = 1;
        add(on_joint);
        add_limb(6, kLinked | SWIVEL_WITH_WEIGHTS | SWIVEL_POLE_INCOMING, handle);
        for (std::uint32_t g = 0; g < groups.size(); ++g)
            if (is_limb(g)) limb_def(g).on_bad_input = on_bad_input;
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
        give(prop, SWIVEL_HAND_BLEND, [&](std::size_t n) { return Float1{static_cast<float>(n % 4) / 3}; });
        give(prop, SWIVEL_PROP_POSITION,
             [&](std::size_t n) { return n % 5 ? kNoPlace : goal(random, right, n).target; });
        give(prop, SWIVEL_PROP_ROTATION, [&](std::size_t n) { return n % 7 ? kNoTurn : goal(random, right, n).hand; });
    }
    // Nothing is written of a body's prop, which is as its left hand has it.
    void leave_in_hand(std::size_t n)
    {
        find(left, SWIVEL_TARGET)->write(n, kNoPlace), find(prop, SWIVEL_PROP_POSITION)->write(n, kNoPlace);
        find(prop, SWIVEL_HAND_BLEND)->write(n, Float1{0});
    }
};

// Every bit that a solve left of a body: the results of a group, or those of a kind, and of all groups with the pose.
inline std::vector<std::uint32_t> bits_of_group(const Crowd& crowd, std::uint32_t group, std::size_t n,
                                                std::optional<swivel_field_kind> kind = {})
{
    std::vector<std::uint32_t> bits;
    swivel_field_info info;
    for (std::uint32_t i = 0; swivel_describe_field(i, &info); ++i) {
        const std::uint32_t count = swivel_field_row_count(crowd.get(), group, info.field);
        if (info.kind == SWIVEL_FIELD_INPUT || (kind && info.kind != *kind) || count == 0) continue;
        bits.resize(bits.size() + count);
        check(swivel_read(crowd.get(), info.field, group, static_cast<std::uint32_t>(n), 1,
                          {&bits[bits.size() - count], count * sizeof bits[0]}));
    }
    return bits;
}
inline std::vector<std::uint32_t> bits_of_body(const Crowd& crowd, const PoseBuffer& poses, std::size_t n)
{
    std::vector<std::uint32_t> bits;
    for (std::uint32_t g = 0; g < swivel_group_count(crowd.get()); ++g) {
        const std::vector<std::uint32_t> more = bits_of_group(crowd, g, n);
        bits.insert(bits.end(), more.begin(), more.end());
    }
    const unsigned char* const first = &poses.bytes[n * poses.body_stride];
    bits.insert(bits.end(), first, first + poses.body_stride);
    return bits;
}

}  // namespace swivel::test
