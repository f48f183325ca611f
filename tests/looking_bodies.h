// SPDX-License-Identifier: MIT
//
// Random bodies that look, with limbs below what turns; and a spine, a neck and a head that look, upright. And how
// their joints have turned, by Eigen in double.
#pragma once

#include <algorithm>
#include <utility>

#include "tests/posed_bodies.h"

namespace swivel::test {

using Float6 = std::array<float, 6>;

// A look of one body: its joints as earlier looks have left them, and as they are.
struct TurnedChain {
    const SolvedBody& body;
    const swivel_look_def& look;
    std::vector<JointAt> before;

    TurnedChain(const SolvedBody& of, const swivel_look_def& with) : body(of), look(with)
    {
        const std::int32_t above = body.bodies.skeleton.parents[look.joints[0]];
        for (std::uint32_t n = 0; n < look.joint_count; ++n) {
            before.push_back(body.came[look.joints[n]]);
            if (above < 0) continue;
            const JointAt &from = body.came[static_cast<std::size_t>(above)],
                          &to = body.solved[static_cast<std::size_t>(above)];
            const Quaterniond turn = to.rotation * from.rotation.conjugate();
            before[n] = {turn * before[n].rotation, to.place + turn * (before[n].place - from.place), before[n].scale};
        }
    }
    std::uint32_t last() const { return look.joint_count - 1; }
    const JointAt& was(std::uint32_t n) const { return before[n]; }
    const JointAt& is(std::uint32_t n) const { return body.solved[look.joints[n]]; }
    // By which a joint of the chain and all below it have turned, in the world.
    Quaterniond turn(std::uint32_t n) const { return is(n).rotation * was(n).rotation.conjugate(); }
    // By which a joint itself has turned, in the world.
    Quaterniond own_turn(std::uint32_t n) const { return n == 0 ? turn(n) : turn(n) * turn(n - 1).conjugate(); }
    Vector3d eye(const JointAt& joint) const { return joint.place + joint.rotation * (joint.scale * vec(eye_of())); }
    Vector3d axis(const JointAt& joint) const { return joint.rotation * vec(axis_of()).normalized(); }
    // The line of sight once the first `count` joints have turned; those after it come along.
    Vector3d eye_after(std::uint32_t count) const
    {
        if (count == 0) return eye(was(last()));
        const std::uint32_t n = count - 1;
        return is(n).place + turn(n) * (eye(was(last())) - was(n).place);
    }
    Vector3d axis_after(std::uint32_t count) const
    {
        return count == 0 ? axis(was(last())) : Vector3d(turn(count - 1) * axis(was(last())));
    }
    Float3 eye_of() const { return {look.eye[0], look.eye[1], look.eye[2]}; }
    Float3 axis_of() const { return {look.axis[0], look.axis[1], look.axis[2]}; }
};

// The way from the root down to a joint's parent.
inline std::vector<std::uint32_t> way_down(const BodySkeleton& skeleton, std::uint32_t joint)
{
    std::vector<std::uint32_t> way;
    for (std::int32_t at = skeleton.parents[joint]; at >= 0; at = skeleton.parents[static_cast<std::size_t>(at)])
        way.insert(way.begin(), static_cast<std::uint32_t>(at));
    return way;
}

inline swivel_look_def random_look(Random& random, std::span<const std::uint32_t> joints)
{
    swivel_look_def look = swivel::look(joints);
    for (std::uint32_t n = 0; n < look.joint_count; ++n) {
        look.share[n] = static_cast<float>(random.below(4) ? random.between(0.1, 3) : 0);
        look.cos_max[n] = static_cast<float>(random.below(2) ? -1 : std::cos(random.between(0.05, 2)));
    }
    look.share[look.joint_count - 1] = static_cast<float>(random.between(0.1, 3));
    const Float3 eye = random.below(3) ? floats(random.vector(0, 0.1)) : Float3{},
                 axis = floats(Vector3d(random.spread(0.1, 10) * random.direction()));
    std::copy(eye.begin(), eye.end(), look.eye);
    std::copy(axis.begin(), axis.end(), look.axis);
    look.fade_distance = 0.02f;
    if (random.below(2)) {
        look.cos_none = static_cast<float>(random.between(-1, -0.3)), look.cos_full = look.cos_none + 0.5f;
        look.fade_distance = static_cast<float>(random.spread(0.02, 1));
    }
    look.rate = 0;
    return look;
}

// Bodies with a look in the trunk, some with another below it, and all limbs of theirs.
struct LookingBodies : PosedBodies {
    std::vector<std::uint32_t> looks;  // groups

    LookingBodies(Random& random, std::size_t body_count, const PoseLayout& of)
        : PosedBodies(random, {3 + random.below(5), 2 + random.below(2), random.below(2), true, 0, 2}, body_count, of)
    {
        std::vector<std::uint32_t> way;  // the longest
        for (const BodyLimbJoints& limb : skeleton.limbs)
            if (const std::vector<std::uint32_t> other = way_down(skeleton, limb.shoulder); other.size() > way.size())
                way = other;
        const std::uint32_t lowest = way.back();
        std::erase_if(way, [&](std::uint32_t joint) { return joint != lowest && random.below(4) == 0; });
        if (way.size() > 8) way.resize(8);
        const std::size_t first =
            random.below(2) && way.size() > 1 ? 1 + random.below(std::uint32_t(way.size()) - 1) : way.size();
        const std::span<const std::uint32_t> all(way);
        add_look(random, all.first(first));
        if (first < way.size()) add_look(random, all.subspan(first));
        for (std::uint32_t limb = 0; limb < skeleton.limbs.size(); ++limb) {
            const std::uint32_t group = add_limb(limb, SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING | SWIVEL_WITH_WEIGHTS);
            give(group, SWIVEL_TARGET,
                 [&](std::size_t n) { return random_goal(random, skeleton, bodies[n], limb).target; });
            give(group, SWIVEL_HAND, [&](std::size_t) { return floats(random.rotation()); });
            give(group, SWIVEL_WEIGHTS, [&](std::size_t) {
                const float weight = random.below(2) ? 1.0f : 0.0f;
                return Float3{weight, weight, weight};
            });
        }
    }
    swivel_look_def& look_def(std::uint32_t group) { return std::get<swivel_look_def>(groups[group]); }
    const swivel_look_def& look_def(std::uint32_t group) const { return std::get<swivel_look_def>(groups[group]); }
    void add_look(Random& random, std::span<const std::uint32_t> chain)
    {
        const std::uint32_t group = add(random_look(random, chain));
        looks.push_back(group);
        const std::uint32_t last = chain.back();
        give(group, SWIVEL_LOOK_TARGET, [&](std::size_t n) {
            const std::vector<JointAt> at = joints_at(skeleton, bodies[n]);
            return floats(Vector3d(vec(bodies[n].root_position) + at[last].place +
                                   random.spread(0.2, 20) * at[last].scale * random.direction()));
        });
    }
};

// A spine of two bones, a neck and a head, upright, whose eyes look along z.
struct Upright {
    BodySkeleton skeleton;
    swivel_look_def look = swivel_default_look_def();

    Upright() : Upright({{0, 1, 0}, {0, 0.15f, 0}, {0, 0.3f, 0.02f}, {0, 0.12f, 0.01f}})
    {
        look.joint_count = 4;
        for (std::uint32_t n = 0; n < 4; ++n) look.joints[n] = n;
        const float max[] = {0.97f, 0.94f, 0.8f, 0.5f}, share[] = {1, 1, 2, 4};  // 14, 20, 37 and 60 degrees
        std::copy_n(max, 4, look.cos_max), std::copy_n(share, 4, look.share);
        look.eye[1] = 0.08f, look.eye[2] = 0.1f;
        look.rate = 0;
    }
    // Other bones in a line, with a look that is the caller's.
    explicit Upright(const std::vector<Float3>& offsets)
    {
        for (const Float3& offset : offsets) {
            skeleton.parents.push_back(static_cast<std::int32_t>(skeleton.size()) - 1);
            skeleton.rotations.push_back({0, 0, 0, 1});
            skeleton.translations.push_back(offset);
        }
    }
    Vector3d eye() const { return {0, 1.65, 0.13}; }
};
// The bodies of a crowd of these: where they look, and their joints.
struct UprightCrowd {
    Crowd crowd;
    std::vector<std::array<Float4, 4>> rotations;
    float root_scale = 1;

    UprightCrowd(const Upright& of, std::size_t count)
        : crowd(of.skeleton.view(), static_cast<std::uint32_t>(count), {of.look}), rotations(count)
    {
        reset();
    }
    void reset()
    {
        std::ranges::fill(rotations, std::array<Float4, 4>{{{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}}});
    }
    void solve(const std::vector<Float3>& targets, float time = 0, float weight = 1)
    {
        swivel_pose pose = swivel_default_pose();
        pose.rotations = {rotations.data(), sizeof rotations[0], sizeof(Float4), nullptr};
        pose.time = {&time, 0};
        if (weight != 1) pose.weight = {&weight, 0};
        if (root_scale != 1) pose.root_scale = {&root_scale, 0};
        crowd.write(SWIVEL_LOOK_TARGET, 0, std::span(targets));
        crowd.solve({.pose = &pose});
    }
    // Where the line of sight starts and where it points, by forward kinematics.
    std::pair<Vector3d, Vector3d> sight(const Upright& of, std::size_t n) const
    {
        Quaterniond turn = Quaterniond::Identity();
        Vector3d place = Vector3d::Zero();
        for (std::size_t joint = 0; joint < 4; ++joint) {
            place += turn * vec(of.skeleton.translations[joint]);
            turn = turn * quat(rotations[n][joint]).normalized();
        }
        return {place + turn * vec(of.look.eye), turn * vec(of.look.axis)};
    }
    Vector3d line(std::size_t n) const
    {
        const auto sight = value_of<Float6>(crowd, SWIVEL_SIGHT, 0, static_cast<std::uint32_t>(n));
        return {sight[3], sight[4], sight[5]};
    }
    std::uint32_t flags(std::uint32_t n) const { return flags_of(crowd, 0, n); }
};

}  // namespace swivel::test
