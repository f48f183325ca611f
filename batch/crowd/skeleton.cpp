// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <span>

#include "batch/crowd/rig.h"
#include "batch/crowd/streams.h"
#include "batch/refusal/status.h"
#include "core/arm.h"

namespace swivel {

namespace {

// A joint of the limb, and its name in messages.
struct Part {
    char name[24];
    std::uint32_t joint;
};
constexpr std::uint32_t kShoulder = 0, kElbow = 1, kWrist = 2, kFirstTwistBone = 3;

struct Parts {
    Part part[kFirstTwistBone + SWIVEL_MAX_TWIST_BONES];
    std::uint32_t count = 0;

    void add(const Part& each) { part[count++] = each; }
    std::span<const Part> from(std::uint32_t first) const { return std::span(part, count).subspan(first); }
};
const Part* find(std::span<const Part> parts, std::uint32_t joint)
{
    for (const Part& each : parts)
        if (each.joint == joint) return &each;
    return nullptr;
}

swivel_status check_values(const char* name, const swivel_in& values, std::size_t bytes)
{
    if (!values.data) return refuse("swivel_bind_joints: the skeleton's %s are null", name);
    if (values.stride < bytes)
        return refuse("swivel_bind_joints: the skeleton's %s have stride %zu, which is smaller than a value, %zu bytes",
                      name, values.stride, bytes);
    return SWIVEL_OK;
}
swivel_status check_skeleton(const swivel_skeleton& skeleton)
{
    swivel_status status = check_values("parents", skeleton.parents, sizeof(std::int32_t));
    if (status == SWIVEL_OK) status = check_values("translations", skeleton.translations, 3 * sizeof(float));
    if (status == SWIVEL_OK && skeleton.rotations.data)
        status = check_values("rotations", skeleton.rotations, 4 * sizeof(float));
    return status;
}

swivel_status name_parts(const swivel_limb_joints& joints, Parts& parts)
{
    if (joints.twist_bone_count > SWIVEL_MAX_TWIST_BONES)
        return refuse("swivel_bind_joints: there are %u twist bones; a limb has at most %d", joints.twist_bone_count,
                      SWIVEL_MAX_TWIST_BONES);
    if (joints.twist_bone_count > 0 && !joints.twist_bones) return refuse("swivel_bind_joints: twist_bones is null");
    parts.add({"the shoulder", joints.shoulder});
    parts.add({"the elbow", joints.elbow});
    parts.add({"the wrist", joints.wrist});
    for (std::uint32_t n = 0; n < joints.twist_bone_count; ++n) {
        Part bone{{}, joints.twist_bones[n]};
        std::snprintf(bone.name, sizeof bone.name, "twist bone %u", n);
        if (const Part* const same = find(parts.from(0), bone.joint))
            return refuse("swivel_bind_joints: %s and %s are both joint %u; name each once", same->name, bone.name,
                          bone.joint);
        parts.add(bone);
    }
    return SWIVEL_OK;
}

swivel_status read_rotation(const swivel_skeleton& skeleton, std::uint32_t joint, Rotor<double>& rotation)
{
    rotation = rotor(0.0, 0.0, 0.0, 1.0);
    if (!skeleton.rotations.data) return SWIVEL_OK;
    const auto q = value_at<std::array<float, 4>>(skeleton.rotations, joint);
    rotation = rotor<double>(q[0], q[1], q[2], q[3]);
    if (is_orientation(rotation)) return SWIVEL_OK;
    return refuse("swivel_bind_joints: joint %u's rest rotation is zero or not finite; give a quaternion x, y, z, w",
                  joint);
}
swivel_status read_place(const swivel_skeleton& skeleton, std::uint32_t joint, Vector<double>& place)
{
    const auto v = value_at<std::array<float, 3>>(skeleton.translations, joint);
    place = vector<double>(v[0], v[1], v[2]);
    if (len2(place) <= kHuge2) return SWIVEL_OK;
    return refuse("swivel_bind_joints: joint %u's translation is not finite or longer than 1e15; give 3 floats", joint);
}

// Reads a part below another one, with the rigid joints between them, none of which may be a part.
swivel_status rest_below(const swivel_skeleton& skeleton, const Part& part, const Part& above,
                         std::span<const Part> turning, RestJoint& rest)
{
    if (const swivel_status status = read_joint(skeleton, part.joint, rest); status != SWIVEL_OK) return status;
    for (std::uint32_t joint = part.joint;;) {
        const std::int32_t parent = parent_of(skeleton, joint);
        if (parent == -1)
            return refuse("swivel_bind_joints: %s, joint %u, is not below %s, joint %u", part.name, part.joint,
                          above.name, above.joint);
        joint = static_cast<std::uint32_t>(parent);
        if (joint == above.joint) return SWIVEL_OK;
        if (const Part* const other = find(turning, joint))
            return refuse(
                "swivel_bind_joints: %s, joint %u, hangs below %s, joint %u, and would turn with it; name only joints "
                "that hang beside each other",
                part.name, part.joint, other->name, other->joint);
        RestJoint between;
        if (const swivel_status status = read_joint(skeleton, joint, between); status != SWIVEL_OK) return status;
        const Rotor<double> unit = normalise(between.rotation);
        rest.between = rest.between ? unit * *rest.between : unit;
        rest.place = between.place + sandwich(unit, rest.place);
    }
}

// Twist bone i takes a larger share than the one before, so it may not lie nearer to the elbow, within a thousandth.
swivel_status check_order(const Parts& parts, const RestLimb& limb)
{
    const Vector<double>& fore = limb.wrist.place;
    for (std::uint32_t n = 1; n < limb.twist_bone_count; ++n) {
        const Vector<double> way = limb.twist_bones[n].place - limb.twist_bones[n - 1].place;
        if (scalar_product(way, fore) < -1e-3 * len2(fore))
            return refuse(
                "swivel_bind_joints: %s, joint %u, is nearer to the elbow than %s, joint %u; list them from elbow to "
                "wrist",
                parts.part[kFirstTwistBone + n].name, parts.part[kFirstTwistBone + n].joint,
                parts.part[kFirstTwistBone + n - 1].name, parts.part[kFirstTwistBone + n - 1].joint);
    }
    return SWIVEL_OK;
}

}  // namespace

std::int32_t parent_of(const swivel_skeleton& skeleton, std::uint32_t joint)
{
    return value_at<std::int32_t>(skeleton.parents, joint);
}

swivel_status check_parents(const swivel_skeleton& skeleton, const char* name, std::uint32_t first_joint)
{
    if (first_joint >= skeleton.joint_count)
        return refuse("swivel_bind_joints: %s is joint %u, but the skeleton has %u joints", name, first_joint,
                      skeleton.joint_count);
    std::uint32_t joint = first_joint;
    for (std::uint32_t seen = 0; seen < skeleton.joint_count; ++seen) {
        const std::int32_t parent = parent_of(skeleton, joint);
        if (parent == -1) return SWIVEL_OK;
        if (parent < -1 || static_cast<std::uint32_t>(parent) >= skeleton.joint_count)
            return refuse("swivel_bind_joints: joint %u's parent is %d; give -1 for a root, or one of the %u joints",
                          joint, parent, skeleton.joint_count);
        joint = static_cast<std::uint32_t>(parent);
    }
    return refuse("swivel_bind_joints: the parents of %s, joint %u, go round in a circle; a root's parent is -1", name,
                  first_joint);
}

swivel_status read_joint(const swivel_skeleton& skeleton, std::uint32_t joint, RestJoint& rest)
{
    rest = {};
    const swivel_status status = read_rotation(skeleton, joint, rest.rotation);
    return status == SWIVEL_OK ? read_place(skeleton, joint, rest.place) : status;
}

swivel_status rest_limb(const swivel_skeleton& skeleton, const swivel_limb_joints& joints, RestLimb& limb)
{
    limb = {};
    Parts parts;
    swivel_status status = check_skeleton(skeleton);
    if (status == SWIVEL_OK) status = name_parts(joints, parts);
    for (std::uint32_t n = 0; n < parts.count && status == SWIVEL_OK; ++n)
        status = check_parents(skeleton, parts.part[n].name, parts.part[n].joint);
    if (status != SWIVEL_OK) return status;

    const Part *const shoulder = parts.part + kShoulder, *const elbow = parts.part + kElbow;
    limb.bend = vector<double>(joints.bend[0], joints.bend[1], joints.bend[2]);
    limb.twist_bone_count = joints.twist_bone_count;
    status = read_rotation(skeleton, shoulder->joint, limb.shoulder.rotation);
    if (status == SWIVEL_OK) status = rest_below(skeleton, *elbow, *shoulder, {}, limb.elbow);
    for (std::uint32_t n = kWrist; n < parts.count && status == SWIVEL_OK; ++n)
        status = rest_below(skeleton, parts.part[n], *elbow, parts.from(kWrist),
                            n == kWrist ? limb.wrist : limb.twist_bones[n - kFirstTwistBone]);
    return status == SWIVEL_OK ? check_order(parts, limb) : status;
}

}  // namespace swivel
