// SPDX-License-Identifier: MIT
//
// The promise: all positions that a solve takes or tells hold for the root as it is given, in the world or, with a root
// in doubles, from that root. The shift is in them already; the pose alone hangs on the shifted root. All is checked by
// forward kinematics of Eigen's, in double, for shifts of decimetres.
#include <catch2/catch.hpp>

#include <algorithm>

#include "tests/looking_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::size_t kBodies = 40;
constexpr double kOff = 2e-5;  // that floats may be off; the shortest shift is 0.15
constexpr std::uint32_t kLimbs = 4;

// The head, the last joint, has no limb below it.
BodySkeleton with_head(Random& random)
{
    BodySkeleton skeleton = random_body_skeleton(random, {3, kLimbs, 0, false});
    skeleton.parents.push_back(0);
    skeleton.rotations.push_back({0, 0, 0, 1});
    skeleton.translations.push_back({0.1f, 0.2f, 0});
    return skeleton;
}
std::vector<Body> bodies_of(Random& random, const BodySkeleton& skeleton)
{
    std::vector<Body> bodies;
    for (std::size_t n = 0; n < kBodies; ++n) {
        bodies.push_back(random_body(random, skeleton, {.roots = true, .max_bend = 2}));
        bodies.back().root_scale = static_cast<float>(random.spread(0.5, 2));
    }
    return bodies;
}

// Where parts of one body belong, from its root as it is given.
struct Wanted {
    float shift;
    Vector3d by;           // the shift in the world
    Vector3d foot, level;  // the foot on its ground, and at the height of the root
    Vector3d hand, pole, sight;
    Held prop, left, right;
};

// Bodies that are shifted by what they wish. A foot stands on ground, a hand is at its target, two hold a prop, and the
// head looks.
struct ShiftedBodies : PosedBodies {
    enum Group : std::uint32_t { shift, leg, hand, prop, left, right, look };
    std::vector<Wanted> wanted;

    ShiftedBodies(Random& random, const BodySkeleton& with, bool has_doubles)
        : PosedBodies(with, bodies_of(random, with), {.roots = true})
    {
        swivel_shift_def shift_def = swivel_default_shift_def();
        shift_def.drop = shift_def.rise = 100;
        swivel_look_def look_def = swivel::look({skeleton.size() - 1});
        look_def.cos_max[0] = -1, look_def.eye[1] = 0.05f, look_def.eye[2] = 0.1f, look_def.rate = 0;
        constexpr swivel_features kHand = SWIVEL_WITH_HAND | SWIVEL_WITH_RECORD,
                                  kLinked = kHand | SWIVEL_WITH_LINK | SWIVEL_POLE_INCOMING;
        add(shift_def);
        add_limb(0, kHand | SWIVEL_POLE_INCOMING | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_PLANT | SWIVEL_WITH_GROUND |
                        SWIVEL_WITH_PELVIS_FIT);
        add_limb(1, kHand | SWIVEL_WITH_HAND_TRANSFORM);
        add(swivel_default_prop_def());
        add_limb(2, kLinked, prop);
        add_limb(3, kLinked, prop);
        add(look_def);
        for (std::size_t n = 0; n < kBodies; ++n) {
            wanted.push_back(random_wanted(random, look_def, n));
            const Vector3d far = vec(bodies[n].root_position) + Vector3d(3e6, 0.25, -5e6);
            if (has_doubles) far_roots.push_back({far.x(), far.y(), far.z()});
        }
        give_wanted();
    }
    Vector3d up(std::size_t n) const { return quat(bodies[n].root_rotation).normalized() * Vector3d::UnitY(); }
    // What positions in rows count from, as it is from the root.
    Vector3d from_root(std::size_t n, const Vector3d& given) const
    {
        return far_roots.empty() ? Vector3d(given - vec(bodies[n].root_position)) : given;
    }

private:
    Float3 given(std::size_t n, const Vector3d& from_root) const
    {
        return floats(far_roots.empty() ? Vector3d(from_root + vec(bodies[n].root_position)) : from_root);
    }
    // A position that a limb's wrist reaches once the body is shifted.
    Vector3d in_reach(Random& random, std::size_t n, std::uint32_t limb, const Vector3d& by) const
    {
        const std::vector<JointAt> at = joints_at(skeleton, bodies[n]);
        const LimbAt size(skeleton, bodies[n], at, skeleton.limbs[limb]);
        const double near = std::fabs(size.upper - size.fore),
                     distance = near + random.between(0.3, 0.7) * (size.length() - near);
        return at[skeleton.limbs[limb].shoulder].place + by + distance * random.direction();
    }
    Wanted random_wanted(Random& random, const swivel_look_def& look_def, std::size_t n) const
    {
        const std::vector<JointAt> at = joints_at(skeleton, bodies[n]);
        Wanted made;
        made.shift = static_cast<float>((n % 2 ? 1 : -1) * random.between(0.15, 0.4));
        made.by = double{made.shift} * up(n);
        made.foot = in_reach(random, n, 0, made.by);
        made.level = made.foot - made.foot.dot(up(n)) * up(n);
        made.hand = in_reach(random, n, 1, made.by);
        const Vector3d shoulder = at[skeleton.limbs[1].shoulder].place + made.by;
        made.pole = shoulder + 0.5 * random.across(made.hand - shoulder);
        made.prop = {random.rotation(), in_reach(random, n, 2, made.by)};
        made.left = {random.rotation(), in_reach(random, n, 2, made.by)};
        made.right = {random.rotation(), in_reach(random, n, 3, made.by)};
        const JointAt& head = at.back();
        const Vector3d eye = head.place + head.rotation * (head.scale * vec(look_def.eye)),
                       axis = head.rotation * Vector3d::UnitZ();
        made.sight = eye + made.by + axis + 0.5 * random.across(axis);
        return made;
    }
    void give_wanted()
    {
        give(shift, SWIVEL_SHIFT_WISH, [&](std::size_t n) { return Float1{wanted[n].shift}; });
        give(leg, SWIVEL_PELVIS_FIT_WEIGHT, [](std::size_t) { return Float1{0}; });
        give(leg, SWIVEL_EFFECTOR, [](std::size_t) { return Float3{0.01f, 0, 0}; });
        give(leg, SWIVEL_TARGET, [&](std::size_t n) { return given(n, wanted[n].level); });
        give(leg, SWIVEL_GROUND, [&](std::size_t n) { return given(n, wanted[n].foot - wanted[n].level); });
        give(leg, SWIVEL_GROUND_NORMAL, [&](std::size_t n) { return floats(up(n)); });
        give(hand, SWIVEL_TARGET, [&](std::size_t n) { return given(n, wanted[n].hand); });
        give(hand, SWIVEL_POLE, [&](std::size_t n) { return given(n, wanted[n].pole); });
        give(prop, SWIVEL_PROP_POSITION, [&](std::size_t n) { return given(n, wanted[n].prop.place); });
        give(prop, SWIVEL_PROP_ROTATION, [&](std::size_t n) { return floats(wanted[n].prop.rotation); });
        give(left, SWIVEL_GRIP, [&](std::size_t n) { return floats(wanted[n].prop.inverse() * wanted[n].left); });
        give(right, SWIVEL_GRIP, [&](std::size_t n) { return floats(wanted[n].prop.inverse() * wanted[n].right); });
        give(look, SWIVEL_LOOK_TARGET, [&](std::size_t n) { return given(n, wanted[n].sight); });
    }
};

// What a solve tells of one body, and where its joints are by forward kinematics, from its root as it is given.
struct ToldBody {
    using B = ShiftedBodies;
    const B& bodies;
    const SolvedBodies& solved;
    SolvedBody body;
    std::size_t n;
    Vector3d by;  // the shift

    ToldBody(const B& given, const SolvedBodies& all, std::size_t number, const Vector3d& shifted)
        : bodies(given), solved(all), body(all, number), n(number), by(shifted)
    {
    }
    Vector3d place(std::uint32_t joint) const { return body.solved[joint].place + by; }
    Held hand(std::uint32_t group) const
    {
        const Held hand = body.hand(group);
        return {hand.rotation, hand.place + by};
    }
    Held told(swivel_field field, std::uint32_t group) const
    {
        const Held transform = held(solved.result<Float7>(field, group, n));
        return {transform.rotation, bodies.from_root(n, transform.place)};
    }
    template <class Value>
    Vector3d told_first(swivel_field field, std::uint32_t group) const
    {
        const auto value = solved.result<Value>(field, group, n);
        return bodies.from_root(n, Vector3d(double{value[0]}, double{value[1]}, double{value[2]}));
    }
    bool reached(std::uint32_t group) const { return (solved.flags(group, n) & SWIVEL_REACHED) != 0; }

    void check_hand() const
    {
        const Wanted& wanted = bodies.wanted[n];
        const BodyLimbJoints& joints = body.joints(B::hand);
        REQUIRE(reached(B::hand));
        REQUIRE((place(joints.wrist) - wanted.hand).norm() <= kOff);
        const Vector3d shoulder = place(joints.shoulder), line = wanted.hand - shoulder;
        REQUIRE(angle_between(line.cross(wanted.pole - shoulder), line.cross(place(joints.elbow) - shoulder)) <= 1e-3);
        const Held transform = told(SWIVEL_HAND_TRANSFORM, B::hand);
        REQUIRE((transform.place - place(joints.wrist)).norm() <= kOff);
        REQUIRE(distance(transform.rotation, body.solved[joints.wrist].rotation) <= kOff);
        REQUIRE((told_first<std::array<float, 22>>(SWIVEL_RECORD, B::hand) - shoulder).norm() <= kOff);
        std::array<double, 3> elbow, wrist;
        double residual;
        const auto out = [](auto& value) { return swivel_out{&value, sizeof value}; };
        const auto number = static_cast<std::uint32_t>(n);
        check(swivel_forward(solved.crowd.get(), B::hand, number, 1, out(elbow), out(wrist), {nullptr, 0}));
        check(swivel_residuals(solved.crowd.get(), B::hand, number, 1, out(residual)));
        REQUIRE((bodies.from_root(n, Vector3d(elbow.data())) - place(joints.elbow)).norm() <= kOff);
        REQUIRE((bodies.from_root(n, Vector3d(wrist.data())) - place(joints.wrist)).norm() <= kOff);
        REQUIRE(residual * body.length(B::hand) <= kOff);
    }
    void check_foot() const
    {
        const Wanted& wanted = bodies.wanted[n];
        REQUIRE(reached(B::leg));
        REQUIRE((body.point(B::leg).place + by - wanted.foot).norm() <= kOff);
        REQUIRE((told(SWIVEL_SOLVED_GOAL, B::leg).place - wanted.foot).norm() <= kOff);
        REQUIRE((told_first<Float3>(SWIVEL_PROBE, B::leg) - wanted.foot).norm() <= kOff);
    }
    void check_prop() const
    {
        const Wanted& wanted = bodies.wanted[n];
        REQUIRE(reached(B::prop));
        REQUIRE((told(SWIVEL_PROP_TRANSFORM, B::prop).place - wanted.prop.place).norm() <= kOff);
        const auto check_holder = [&](std::uint32_t group, const Held& at) {
            REQUIRE(reached(group));
            REQUIRE((hand(group).place - at.place).norm() <= kOff);
            REQUIRE((told(SWIVEL_SOLVED_GOAL, group).place - at.place).norm() <= kOff);
        };
        check_holder(B::left, wanted.left);
        check_holder(B::right, wanted.right);
    }
    void check_look() const
    {
        const JointAt& head = body.solved.back();
        const swivel_look_def& look = std::get<swivel_look_def>(bodies.groups[B::look]);
        const Vector3d eye = head.place + by + head.rotation * (head.scale * vec(look.eye));
        REQUIRE(reached(B::look));
        REQUIRE((told_first<Float6>(SWIVEL_SIGHT, B::look) - eye).norm() <= kOff);
        REQUIRE(angle_between(bodies.wanted[n].sight - eye, head.rotation * Vector3d::UnitZ()) <= 1e-4);
    }
    void check_joints() const
    {
        const Quaterniond root = quat(body.incoming.root_rotation).normalized();
        for (std::uint32_t joint = 0; joint < bodies.skeleton.size(); ++joint) {
            const std::size_t at = n * bodies.skeleton.size() + joint;
            if (solved.joint_rotations[at] == Float4{}) continue;  // no group needs it
            const Vector3d in_body = vec(solved.joint_positions[at]);
            REQUIRE((double{body.incoming.root_scale} * (root * in_body) - place(joint)).norm() <= kOff);
        }
    }
};

}  // namespace

TEST_CASE("positions that a solve takes or tells hold for the root as it is given, and have its shift already")
{
    Random random{1};
    ShiftedBodies bodies(random, with_head(random), GENERATE(false, true));
    if (GENERATE(false, true)) bodies.put_in_body_space();
    const SolvedBodies solved(bodies);
    for (std::size_t n = 0; n < kBodies; ++n) {
        const Wanted& wanted = bodies.wanted[n];
        REQUIRE(solved.result<Float3>(SWIVEL_SHIFT, ShiftedBodies::shift, n)[0] == wanted.shift);
        const ToldBody told(bodies, solved, n, wanted.by);
        told.check_hand();
        told.check_foot();
        told.check_prop();
        told.check_look();
        told.check_joints();
    }
    // A job without the shift does not shift the root.
    const SolvedBodies unshifted(bodies, {ShiftedBodies::hand});
    for (std::size_t n = 0; n < kBodies; ++n) {
        const ToldBody told(bodies, unshifted, n, Vector3d::Zero());
        told.check_joints();
        const std::uint32_t wrist = told.body.joints(ShiftedBodies::hand).wrist;
        REQUIRE((told.told(SWIVEL_HAND_TRANSFORM, ShiftedBodies::hand).place - told.place(wrist)).norm() <= kOff);
    }
}

TEST_CASE("the weight of a pose counts for the shift that positions of joints have")
{
    Random random{3};
    const ShiftedBodies bodies(random, with_head(random), false);
    const float weight = GENERATE(0.0f, 0.5f, 1.0f);
    const std::size_t count = bodies.skeleton.size();
    std::vector<Float3> told(kBodies * count, kNoPlace);
    Crowd crowd = bodies.crowd();
    PoseBuffer poses = bodies.incoming();
    swivel_pose pose = bodies.view(poses);
    pose.joint_positions = {told.data(), count * sizeof(Float3), sizeof(Float3), nullptr};
    pose.weight = {&weight, 0};
    crowd.solve({.pose = &pose});
    for (std::size_t n = 0; n < kBodies; ++n) {
        const Body& given = bodies.bodies[n];
        const std::vector<JointAt> solved = joints_at(bodies.skeleton, poses.read(n, given));
        const Quaterniond root = quat(given.root_rotation).normalized();
        for (std::size_t joint = 0; joint < count; ++joint) {
            const Float3& in_body = told[n * count + joint];
            if (std::isnan(in_body[0])) continue;  // no group needs it
            const Vector3d place = solved[joint].place + double{weight} * bodies.wanted[n].by;
            REQUIRE((double{given.root_scale} * (root * vec(in_body)) - place).norm() <= kOff);
        }
    }
}

TEST_CASE("a sample function is asked for positions that hold for the root as it is given")
{
    Random random{2};
    const ShiftedBodies bodies(random, with_head(random), GENERATE(false, true));
    Crowd crowd = bodies.crowd();
    PoseBuffer poses = bodies.incoming();
    const swivel_pose pose = bodies.view(poses);
    std::vector<Float3> places(kBodies, kNoPlace);
    swivel_job job = swivel_default_job();
    job.pose = &pose, job.sample_user = places.data();
    job.sample = [](const swivel_probes* probes, void* user) {
        for (std::uint32_t n = 0; n < probes->count; ++n)
            std::copy_n(probes->places[n], 3, static_cast<Float3*>(user)[probes->bodies[n]].begin());
    };
    check(swivel_solve(crowd.get(), &job));
    for (std::size_t n = 0; n < kBodies; ++n)
        REQUIRE((bodies.from_root(n, vec(places[n])) - bodies.wanted[n].level).norm() <= kOff);
}
