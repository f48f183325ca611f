// SPDX-License-Identifier: MIT
#include "tests/body_crowd.h"

#include <algorithm>
#include <cstring>

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

Body BodySkeleton::rest() const
{
    Body rest;
    rest.rotations = rotations, rest.translations = translations;
    rest.scales.assign(size(), Float3{1, 1, 1});
    return rest;
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
        const std::vector<JointAt> at = joints_at(s, s.rest());
        const Vector3d upper = at[joints.elbow].place - at[joints.shoulder].place;
        const Vector3d fore = at[joints.wrist].place - at[joints.elbow].place;
        Vector3d bend = random.across(upper);
        // A binding whose forearm lies along the hinge is refused.
        while (bend.cross(upper).normalized().cross(fore.normalized()).norm() < 0.01) bend = random.across(upper);
        joints.bend = floats(Vector3d(at[joints.shoulder].rotation.conjugate() * bend));
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
        // The rotation that takes the forearm to where it is bent by just that angle.
        const Vector3d wanted = Eigen::AngleAxisd(random.spread(1e-2, wish.max_bend), axis) * upper;
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
    return joints_at(skeleton, body, {quat(body.root_rotation).normalized(), Vector3d::Zero(), body.root_scale});
}

std::vector<JointAt> joints_at(const BodySkeleton& skeleton, const Body& body, const JointAt& root)
{
    std::vector<JointAt> at(skeleton.size());
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

PoseLayout random_layout(Random& random)
{
    PoseLayout layout;
    layout.form = static_cast<swivel_pose_form>(random.below(SWIVEL_MATRIX_COLUMNS3 + 1));
    layout.translates = layout.scales = layout.form != SWIVEL_ROTATIONS || random.below(2);
    layout.roots = random.below(2);
    return layout;
}

PoseBuffer::PoseBuffer(const PoseLayout& of, std::size_t joints, std::size_t bodies)
    : layout(of),
      joint_count(joints),
      body_stride(joints * (rotation_bytes() + (of.translates ? 12 : 0) + (of.scales ? 12 : 0)) + (of.roots ? 32 : 0) +
                  of.gap),
      bytes(bodies * body_stride, kPattern)
{
}

PoseBuffer::PoseBuffer(const PoseLayout& of, const std::vector<Body>& bodies)
    : PoseBuffer(of, bodies[0].rotations.size(), bodies.size())
{
    for (std::size_t n = 0; n < bodies.size(); ++n) write(n, bodies[n]);
}

std::size_t PoseBuffer::rotation_bytes() const
{
    return layout.form == SWIVEL_ROTATIONS ? 16 : layout.form == SWIVEL_MATRIX_COLUMNS ? 64 : 48;
}
std::size_t PoseBuffer::rotation_at(std::size_t n, std::size_t joint) const
{
    return n * body_stride + joint * rotation_bytes();
}
std::size_t PoseBuffer::translation_at(std::size_t n, std::size_t joint) const
{
    return rotation_at(n, joint_count) + joint * 12;
}
std::size_t PoseBuffer::scale_at(std::size_t n, std::size_t joint) const
{
    return translation_at(n, layout.translates ? joint_count : 0) + joint * 12;
}
std::size_t PoseBuffer::root_at(std::size_t n) const { return scale_at(n, layout.scales ? joint_count : 0); }
std::size_t PoseBuffer::element(int row, int column) const
{
    const int index = layout.form == SWIVEL_MATRIX_ROWS      ? 4 * row + column
                      : layout.form == SWIVEL_MATRIX_COLUMNS ? 4 * column + row
                                                             : 3 * column + row;
    return static_cast<std::size_t>(index) * sizeof(float);
}

void PoseBuffer::write(std::size_t n, const Body& local)
{
    const Body body = layout.in_body ? in_body_space(*layout.in_body, local) : local;
    const auto put = [&](std::size_t at, const auto& value) { std::memcpy(&bytes[at], &value, sizeof value); };
    for (std::size_t joint = 0; joint < joint_count; ++joint) {
        if (layout.form == SWIVEL_ROTATIONS) {
            put(rotation_at(n, joint), body.rotations[joint]);
            if (layout.translates) put(translation_at(n, joint), body.translations[joint]);
            if (layout.scales) put(scale_at(n, joint), body.scales[joint]);
            continue;
        }
        const Eigen::Matrix3d turn = quat(body.rotations[joint]).normalized().toRotationMatrix();
        for (int row = 0; row < 3; ++row) {
            const auto r = static_cast<std::size_t>(row);
            for (int column = 0; column < 3; ++column)
                put(rotation_at(n, joint) + element(row, column),
                    static_cast<float>(turn(row, column) * body.scales[joint][static_cast<std::size_t>(column)]));
            put(rotation_at(n, joint) + element(row, 3), body.translations[joint][r]);
        }
    }
    if (!layout.roots) return;
    put(root_at(n), body.root_position);
    put(root_at(n) + 12, body.root_rotation);
    put(root_at(n) + 28, body.root_scale);
}

Body PoseBuffer::read(std::size_t n, const Body& otherwise) const
{
    Body body = layout.in_body ? in_body_space(*layout.in_body, otherwise) : otherwise;
    for (std::size_t joint = 0; joint < joint_count; ++joint) {
        const unsigned char* const at = &bytes[rotation_at(n, joint)];
        if (layout.form == SWIVEL_ROTATIONS) {
            std::memcpy(&body.rotations[joint], at, sizeof(Float4));
            if (layout.translates)
                std::memcpy(&body.translations[joint], &bytes[translation_at(n, joint)], sizeof(Float3));
            continue;
        }
        const Eigen::Matrix3d turn = matrix(n, joint);
        for (int row = 0; row < 3; ++row)
            std::memcpy(&body.translations[joint][static_cast<std::size_t>(row)], at + element(row, 3), sizeof(float));
        body.rotations[joint] = floats(Quaterniond(Eigen::Matrix3d(turn / turn.col(0).norm())));
    }
    return layout.in_body ? from_body_space(*layout.in_body, body) : body;
}

Eigen::Matrix3d PoseBuffer::matrix(std::size_t n, std::size_t joint) const
{
    Eigen::Matrix3d axes;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) {
            float number;
            std::memcpy(&number, &bytes[rotation_at(n, joint) + element(row, column)], sizeof number);
            axes(row, column) = number;
        }
    return axes;
}

std::vector<unsigned char> PoseBuffer::joint_bytes(std::size_t n, std::size_t joint) const
{
    const unsigned char* const first = &bytes[rotation_at(n, joint)];
    return {first, first + rotation_bytes()};
}

swivel_pose PoseBuffer::view()
{
    swivel_pose pose = swivel_default_pose();
    pose.form = layout.form;
    pose.space = layout.in_body ? SWIVEL_IN_BODY : SWIVEL_LOCAL;
    pose.rotations = {&bytes[rotation_at(0, 0)], body_stride, rotation_bytes(), nullptr};
    if (layout.form == SWIVEL_ROTATIONS && layout.translates)
        pose.translations = {&bytes[translation_at(0, 0)], body_stride, 12, nullptr};
    if (layout.form == SWIVEL_ROTATIONS && layout.scales)
        pose.scales = {&bytes[scale_at(0, 0)], body_stride, 12, nullptr};
    if (layout.roots) {
        pose.root_position = {&bytes[root_at(0)], body_stride};
        pose.root_rotation = {&bytes[root_at(0) + 12], body_stride};
        pose.root_scale = {&bytes[root_at(0) + 28], body_stride};
    }
    return pose;
}

BodyGoal own_goal(const BodySkeleton& skeleton, const Body& body, std::size_t limb)
{
    const JointAt wrist = joints_at(skeleton, body)[skeleton.limbs[limb].wrist];
    return {floats(Vector3d(vec(body.root_position) + wrist.place)), {0, 0, 1}, floats(wrist.rotation)};
}

BodyGoal random_goal(Random& random, const BodySkeleton& skeleton, const Body& body, std::size_t limb)
{
    const BodyLimbJoints& of = skeleton.limbs[limb];
    const std::vector<JointAt> at = joints_at(skeleton, body);
    const Vector3d shoulder = vec(body.root_position) + at[of.shoulder].place;
    const double upper = (at[of.elbow].place - at[of.shoulder].place).norm(),
                 fore = (at[of.wrist].place - at[of.elbow].place).norm(), near = std::fabs(upper - fore);
    const double distance = near + random.between(0.02, 0.98) * (upper + fore - near);
    return {floats(Vector3d(shoulder + distance * random.direction())),
            floats(Vector3d(shoulder + upper * random.direction())), floats(random.rotation())};
}

}  // namespace swivel::test
