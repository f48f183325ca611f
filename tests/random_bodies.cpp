// SPDX-License-Identifier: MIT
#include "tests/random_bodies.h"

#include <algorithm>

namespace swivel::test {

swivel_limb_joints BodySkeleton::joints(std::size_t limb) const
{
    const BodyLimbJoints& of = limbs[limb];
    swivel_limb_joints joints = swivel_default_limb_joints(of.shoulder, of.elbow, of.wrist);
    std::ranges::copy(of.bend, joints.bend);
    joints.twist_bones = of.twist_bones.data();
    joints.twist_bone_count = static_cast<std::uint32_t>(of.twist_bones.size());
    return joints;
}

bool BodySkeleton::is_above(std::uint32_t joint, std::uint32_t below) const
{
    for (auto at = static_cast<std::int32_t>(below); at >= 0; at = parents[static_cast<std::size_t>(at)])
        if (static_cast<std::uint32_t>(at) == joint) return true;
    return false;
}

namespace {

// Twist bones between elbow and wrist, and fingers.
void add_parts(BodySkeleton& s, const SkeletonWish& wish, BodyLimbJoints& joints)
{
    const auto add = [&](std::uint32_t parent, const Float3& place) {
        s.parents.push_back(static_cast<std::int32_t>(parent));
        s.rotations.push_back(s.rotations[joints.elbow]);
        s.translations.push_back(place);
        return s.size() - 1;
    };
    const Float3 half = floats(Vector3d(0.5 * vec(s.translations[joints.wrist])));
    for (std::uint32_t n = 0; n < wish.twist_bones; ++n) joints.twist_bones.push_back(add(joints.elbow, half));
    for (std::uint32_t n = 0, above = joints.wrist; n < wish.fingers; ++n) above = add(above, {0.03f, 0.01f, 0});
}

}  // namespace

BodySkeleton random_body_skeleton(Random& random, const SkeletonWish& wish)
{
    BodySkeleton s;
    const auto add = [&](std::int32_t parent) {
        s.parents.push_back(parent);
        s.rotations.push_back(floats(random.rotation()));
        s.translations.push_back(floats(random.vector(0.05, 0.3)));
        return static_cast<std::int32_t>(s.size() - 1);
    };
    for (std::uint32_t n = 0; n < wish.trunk; ++n)
        add(n == 0 ? -1 : static_cast<std::int32_t>(wish.is_chain ? n - 1 : random.below(n)));
    for (std::uint32_t limb = 0; limb < wish.limbs; ++limb) {
        const auto below = [&](std::int32_t joint) {
            for (std::uint32_t n = random.below(wish.between + 1); n > 0; --n) joint = add(joint);
            return add(joint);
        };
        BodyLimbJoints joints{};
        const std::int32_t shoulder = add(wish.trunk == 0 ? -1
                                          : wish.is_chain ? static_cast<std::int32_t>(wish.trunk - 1)
                                                          : static_cast<std::int32_t>(random.below(wish.trunk)));
        const std::int32_t elbow = below(shoulder), wrist = below(elbow);
        joints.shoulder = static_cast<std::uint32_t>(shoulder);
        joints.elbow = static_cast<std::uint32_t>(elbow);
        joints.wrist = static_cast<std::uint32_t>(wrist);
        add_parts(s, wish, joints);
        Body rest;
        rest.rotations = s.rotations, rest.translations = s.translations;
        rest.scales.assign(s.size(), Float3{1, 1, 1});
        const std::vector<JointAt> at = joints_at(s, rest);
        const Vector3d upper = at[joints.elbow].place - at[joints.shoulder].place;
        joints.bend = floats(Vector3d(at[joints.shoulder].rotation.conjugate() * random.across(upper)));
        s.limbs.push_back(joints);
    }
    return s;
}

Body random_body(Random& random, const BodySkeleton& skeleton, const BodyWish& wish)
{
    Body body;
    for (std::uint32_t n = 0; n < skeleton.size(); ++n) {
        body.rotations.push_back(floats(random.rotation()));
        body.translations.push_back(wish.translates ? floats(random.vector(0.05, 0.3)) : skeleton.translations[n]);
        const auto scale = static_cast<float>(wish.scales && random.below(4) == 0 ? random.between(0.8, 1.25) : 1);
        body.scales.push_back({scale, scale, scale});
    }
    if (wish.roots) {
        body.root_position = floats(random.vector(0, 3));
        body.root_rotation = floats(random.rotation());
        body.root_scale = static_cast<float>(random.spread(0.1, 10));
    }
    const std::vector<JointAt> at = joints_at(skeleton, body);  // which no other limb's bend changes
    for (const BodyLimbJoints& limb : skeleton.limbs) {
        const Vector3d upper = at[limb.elbow].place - at[limb.shoulder].place,
                       fore = at[limb.wrist].place - at[limb.elbow].place, axis = random.across(upper);
        // What turns the forearm to where it is bent by just that angle.
        const Vector3d wanted = Eigen::AngleAxisd(random.spread(1e-2, wish.most_bend), axis) * upper;
        const Quaterniond turn = turn_between(fore, wanted);
        const auto parent = skeleton.parents[limb.elbow];
        const Quaterniond above = at[static_cast<std::size_t>(parent)].rotation;
        body.rotations[limb.elbow] =
            floats(Quaterniond(above.conjugate() * turn * at[limb.elbow].rotation).normalized());
    }
    return body;
}

std::vector<JointAt> joints_at(const BodySkeleton& skeleton, const Body& body)
{
    std::vector<JointAt> at(skeleton.size());
    const JointAt root{quat(body.root_rotation).normalized(), Vector3d::Zero(), body.root_scale};
    std::vector<bool> is_known(skeleton.size());
    for (std::size_t known = 0; known < skeleton.size();)
        for (std::uint32_t n = 0; n < skeleton.size(); ++n) {
            const std::int32_t parent = skeleton.parents[n];
            if (is_known[n] || (parent >= 0 && !is_known[static_cast<std::size_t>(parent)])) continue;
            const JointAt& above = parent < 0 ? root : at[static_cast<std::size_t>(parent)];
            const double scale = Vector3d(vec(body.scales[n])).mean();
            at[n] = {above.rotation * quat(body.rotations[n]).normalized(),
                     above.place + above.scale * (above.rotation * vec(body.translations[n])), above.scale * scale};
            is_known[n] = true;
            ++known;
        }
    return at;
}

Body in_body_space(const BodySkeleton& skeleton, const Body& local)
{
    Body from_root = local, in_body = local;
    from_root.root_rotation = {0, 0, 0, 1}, from_root.root_scale = 1;
    const std::vector<JointAt> at = joints_at(skeleton, from_root);
    for (std::uint32_t n = 0; n < skeleton.size(); ++n) {
        const auto scale = static_cast<float>(at[n].scale);
        in_body.rotations[n] = floats(at[n].rotation);
        in_body.translations[n] = floats(at[n].place);
        in_body.scales[n] = {scale, scale, scale};
    }
    return in_body;
}

Body from_body_space(const BodySkeleton& skeleton, const Body& in_body)
{
    Body local = in_body;
    for (std::uint32_t n = 0; n < skeleton.size(); ++n) {
        if (skeleton.parents[n] < 0) continue;
        const auto above = static_cast<std::size_t>(skeleton.parents[n]);
        const Quaterniond back = quat(in_body.rotations[above]).normalized().conjugate();
        const double scale = in_body.scales[above][0];
        local.rotations[n] = floats(Quaterniond(back * quat(in_body.rotations[n]).normalized()));
        local.translations[n] =
            floats(Vector3d(back * (vec(in_body.translations[n]) - vec(in_body.translations[above])) / scale));
        for (float& each : local.scales[n]) each = static_cast<float>(each / scale);
    }
    return local;
}

double way_to(const BodySkeleton& skeleton, const std::vector<JointAt>& at, std::uint32_t joint)
{
    double way = 0;
    for (auto n = static_cast<std::int32_t>(joint); n >= 0;) {
        const std::int32_t parent = skeleton.parents[static_cast<std::size_t>(n)];
        const Vector3d from = parent < 0 ? Vector3d::Zero() : at[static_cast<std::size_t>(parent)].place;
        way += (at[static_cast<std::size_t>(n)].place - from).norm();
        n = parent;
    }
    return way;
}

}  // namespace swivel::test
