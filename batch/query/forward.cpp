// SPDX-License-Identifier: MIT
#include "batch/query/forward.h"

#include <cmath>
#include <limits>

#include "batch/query/limb_value.h"

namespace swivel {

namespace {

struct Reader {
    const Group& group;
    std::size_t limb;

    double operator()(swivel_field field, std::uint32_t component) const
    {
        return LimbValue(group, limb, field)[component];
    }
    Vector<double> vector_of(swivel_field field) const { return swivel::vector_of({group, limb, field}); }
    Rotor<double> rotor_of(swivel_field field) const { return normalise(swivel::rotor_of({group, limb, field})); }
};

// The bones' lengths in the space of the targets, scaled and stretched.
struct Bones {
    double upper, fore;
};
Bones bones_of(const Group& group, std::size_t limb)
{
    const Reader read{group, limb};
    const double scale = group.features & SWIVEL_WORLD ? read(SWIVEL_PARENT_SCALE, 0) : 1.0;
    const double size = group.features & SWIVEL_WITH_REACH ? scale * read(SWIVEL_STRETCH, 0) : scale;
    return {size * read(SWIVEL_LENGTHS, 0), size * read(SWIVEL_LENGTHS, 1)};
}

}  // namespace

Vector<double> aim_axis(const Group& group, std::size_t limb, const Rotor<double>& hand)
{
    // A hand that is not solved stays at rest.
    const bool resting = (group.features & SWIVEL_JOINTS) && !(group.features & SWIVEL_WITH_HAND);
    return sandwich(resting ? hand * rotor_of(group.binding.wrist_rest) : hand,
                    Reader{group, limb}.vector_of(SWIVEL_AIM));
}

ArmFrame arm_frame(const Group& group, std::size_t limb, bool with_clavicle)
{
    const Reader read{group, limb};
    const bool world = group.features & SWIVEL_WORLD, joints = group.features & SWIVEL_JOINTS;
    const Rotor<double> one = rotor(0.0, 0.0, 0.0, 1.0);

    Vector<double> shoulder = world ? read.vector_of(SWIVEL_SHOULDER_POSITION) : vector(0.0, 0.0, 0.0);
    Rotor<double> parent = world ? read.rotor_of(SWIVEL_PARENT_ROTATION) : one;
    const double scale = world ? read(SWIVEL_PARENT_SCALE, 0) : 1.0;
    if (with_clavicle && group.features & SWIVEL_WITH_CLAVICLE) {
        const Vector<double> bone = read.vector_of(SWIVEL_CLAVICLE);
        const Rotor<double> turn = read.rotor_of(SWIVEL_CLAVICLE_ROTATION);
        shoulder = shoulder + scale * sandwich(parent, sandwich(turn, bone) - bone);
        parent = parent * turn;
    }
    // Without SWIVEL_WORLD, targets are in the arm frame itself.
    return {shoulder, joints && world ? parent * rotor_of(group.binding.parent_from_arm) : parent, scale};
}

LimbPose forward(const Group& group, std::size_t limb)
{
    const Reader read{group, limb};
    const bool joints = group.features & SWIVEL_JOINTS;
    const ArmFrame frame = arm_frame(group, limb);

    // The arm frame's axes, turned with upper arm and forearm. Joints in between move with their bone.
    const ArmRotors arm = arm_rotors(group, limb);
    const Rotor<double> upper_w = frame.rotation * arm.shoulder, fore_w = upper_w * arm.elbow;
    const Rotor<double> wrist_parent_w = joints ? fore_w * ~rotor_of(group.binding.wrist_parent_from_arm) : fore_w;
    const Vector<double> e3 = vector(0.0, 0.0, 1.0);
    const Bones bones = bones_of(group, limb);
    const Vector<double> elbow_w = frame.shoulder + bones.upper * sandwich(upper_w, e3);
    const Vector<double> wrist_w = elbow_w + bones.fore * sandwich(fore_w, e3);
    const bool with_hand = group.features & SWIVEL_WITH_HAND;
    return {frame.shoulder, elbow_w, wrist_w,
            with_hand ? wrist_parent_w * read.rotor_of(SWIVEL_WRIST) : wrist_parent_w};
}

ArmRotors arm_rotors(const Group& group, std::size_t limb)
{
    const Reader read{group, limb};
    const bool joints = group.features & SWIVEL_JOINTS, hand = group.features & SWIVEL_WITH_HAND;
    const Rotor<double> one = rotor(0.0, 0.0, 0.0, 1.0);
    const Rotor<double> wrist = hand ? read.rotor_of(SWIVEL_WRIST) : one;
    if (!joints)
        return {read.rotor_of(SWIVEL_SHOULDER),
                normalise(rotor(-read(SWIVEL_ELBOW, 1), 0.0, 0.0, read(SWIVEL_ELBOW, 0))), hemisphere(wrist)};
    const swivel_binding& b = group.binding;
    const Rotor<double> wrist_parent = rotor_of(b.wrist_parent_from_arm);
    const Rotor<double> hand_from_arm = ~wrist_parent * rotor_of(b.wrist_rest);
    return {~rotor_of(b.parent_from_arm) * read.rotor_of(SWIVEL_SHOULDER) * rotor_of(b.upper_from_arm),
            hemisphere(~rotor_of(b.elbow_parent_from_arm) * read.rotor_of(SWIVEL_ELBOW) * rotor_of(b.fore_from_arm)),
            hand ? hemisphere(~wrist_parent * wrist * ~hand_from_arm) : one};
}

double distance_missed(const Group& group, std::size_t limb)
{
    const Reader read{group, limb};
    if (flags_of(group, limb) & SWIVEL_BAD_INPUT) return std::numeric_limits<double>::quiet_NaN();
    const double scale = group.features & SWIVEL_WORLD ? read(SWIVEL_PARENT_SCALE, 0) : 1.0;
    const LimbPose pose = forward(group, limb);
    Vector<double> miss = read.vector_of(SWIVEL_TARGET) - pose.wrist;
    if (group.features & SWIVEL_WITH_EFFECTOR)
        miss = miss - scale * sandwich(pose.hand, read.vector_of(SWIVEL_EFFECTOR));
    if (group.features & SWIVEL_WITH_AIM) {  // from the ray
        const Vector<double> axis = normalise(aim_axis(group, limb, pose.hand));
        miss = miss - std::fmax(scalar_product(miss, axis), 0) * axis;
    }
    return std::sqrt(len2(miss));
}

double length_of(const Group& group, std::size_t limb)
{
    const Bones bones = bones_of(group, limb);
    return bones.upper + bones.fore;
}

double residual(const Group& group, std::size_t limb)
{
    const double missed = distance_missed(group, limb), length = length_of(group, limb);
    return length > 0 || std::isnan(missed) ? missed / length : 0;
}

}  // namespace swivel
