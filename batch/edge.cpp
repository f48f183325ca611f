// SPDX-License-Identifier: MIT
#include "batch/edge.h"

#include <cmath>
#include <limits>

#include "batch/unpack.h"
#include "core/arm.h"
#include "simd/rows.h"

namespace swivel {

namespace {

struct Reader {
    const swivel_crowd& crowd;
    std::size_t limb;

    double operator()(Field field, std::uint32_t component) const { return lane(field, component); }
    float lane(Field field, std::uint32_t component) const
    {
        if (is_packed(crowd, field)) return unpack_value(crowd, field, limb)[component];
        const float* rows = is_input(field) ? crowd.input : crowd.results;
        const std::uint32_t row_count = is_input(field) ? crowd.input_row_count : crowd.result_row_count;
        return rows[row_offset(limb, row_count, field_first_row(crowd.features, field) + component)];
    }
    Vector<double> vector_of(Field f) const { return vector((*this)(f, 0), (*this)(f, 1), (*this)(f, 2)); }
    Rotor<double> rotor_of(Field f) const
    {
        return normalise(rotor((*this)(f, 0), (*this)(f, 1), (*this)(f, 2), (*this)(f, 3)));
    }
};

Rotor<double> rotor_of(const float (&q)[4]) { return normalise(rotor<double>(q[0], q[1], q[2], q[3])); }

// The bones' lengths in the space of the targets, scaled and stretched.
struct Bones {
    double upper, fore;
};
Bones bones_of(const swivel_crowd& crowd, std::size_t limb)
{
    const Reader read{crowd, limb};
    const double scale = crowd.features & feature::world ? read(Field::parent_scale, 0) : 1.0;
    const double size = crowd.features & feature::reach ? scale * read(Field::stretch, 0) : scale;
    return {size * read(Field::lengths, 0), size * read(Field::lengths, 1)};
}

// The line of the hand that is aimed with, in the space of the targets.
Vector<double> aim_axis(const swivel_crowd& crowd, const Group& group, std::size_t limb, const Rotor<double>& hand)
{
    // A hand that is not solved stays at rest.
    const bool resting = (crowd.features & feature::joints) && !(crowd.features & feature::hand);
    return sandwich(resting ? hand * rotor_of(group.binding.wrist_rest) : hand,
                    Reader{crowd, limb}.vector_of(Field::aim));
}

}  // namespace

LimbPose forward(const swivel_crowd& crowd, const Group& group, std::size_t limb)
{
    const Reader read{crowd, limb};
    const bool world = crowd.features & feature::world, joints = crowd.features & feature::joints;
    const Rotor<double> one = rotor(0.0, 0.0, 0.0, 1.0);

    Vector<double> shoulder = world ? read.vector_of(Field::shoulder_position) : vector(0.0, 0.0, 0.0);
    Rotor<double> parent = world ? read.rotor_of(Field::parent_rotation) : one;
    const double scale = world ? read(Field::parent_scale, 0) : 1.0;
    if (crowd.features & feature::clavicle) {
        const Vector<double> bone = read.vector_of(Field::clavicle);
        const Rotor<double> turn = read.rotor_of(Field::clavicle_turn);
        shoulder = shoulder + scale * sandwich(parent, sandwich(turn, bone) - bone);
        parent = parent * turn;
    }
    // Without SWIVEL_WORLD, targets are in the arm frame itself.
    const Rotor<double> arm_w = joints && world ? parent * rotor_of(group.binding.parent_from_arm) : parent;

    // Its axes, as upper arm and forearm carry them. Joints in between go along with the bone that they are in.
    const ArmRotors arm = arm_rotors(crowd, group, limb);
    const Rotor<double> upper_w = arm_w * arm.shoulder, fore_w = upper_w * arm.elbow;
    const Rotor<double> wrist_parent_w = joints ? fore_w * ~rotor_of(group.binding.wrist_parent_from_arm) : fore_w;
    const Vector<double> e3 = vector(0.0, 0.0, 1.0);
    const Bones bones = bones_of(crowd, limb);
    const Vector<double> elbow_w = shoulder + bones.upper * sandwich(upper_w, e3);
    const Vector<double> wrist_w = elbow_w + bones.fore * sandwich(fore_w, e3);
    const bool with_hand = crowd.features & feature::hand;
    return {shoulder, elbow_w, wrist_w, with_hand ? wrist_parent_w * read.rotor_of(Field::wrist) : wrist_parent_w};
}

ArmRotors arm_rotors(const swivel_crowd& crowd, const Group& group, std::size_t limb)
{
    const Reader read{crowd, limb};
    const bool joints = crowd.features & feature::joints, hand = crowd.features & feature::hand;
    const Rotor<double> one = rotor(0.0, 0.0, 0.0, 1.0);
    const Rotor<double> wrist = hand ? read.rotor_of(Field::wrist) : one;
    if (!joints)
        return {read.rotor_of(Field::shoulder),
                normalise(rotor(-read(Field::elbow, 1), 0.0, 0.0, read(Field::elbow, 0))), hemisphere(wrist)};
    const swivel_binding& b = group.binding;
    const Rotor<double> wrist_parent = rotor_of(b.wrist_parent_from_arm);
    const Rotor<double> hand_from_arm = ~wrist_parent * rotor_of(b.wrist_rest);
    return {~rotor_of(b.parent_from_arm) * read.rotor_of(Field::shoulder) * rotor_of(b.upper_from_arm),
            hemisphere(~rotor_of(b.elbow_parent_from_arm) * read.rotor_of(Field::elbow) * rotor_of(b.fore_from_arm)),
            hand ? hemisphere(~wrist_parent * wrist * ~hand_from_arm) : one};
}

double distance_missed(const swivel_crowd& crowd, const Group& group, std::size_t limb)
{
    const Reader read{crowd, limb};
    if (bit_cast<std::uint32_t>(read.lane(Field::flags, 0)) & SWIVEL_BAD_INPUT)
        return std::numeric_limits<double>::quiet_NaN();
    const double scale = crowd.features & feature::world ? read(Field::parent_scale, 0) : 1.0;
    const LimbPose pose = forward(crowd, group, limb);
    Vector<double> miss = read.vector_of(Field::target) - pose.wrist;
    if (crowd.features & feature::effector) miss = miss - scale * sandwich(pose.hand, read.vector_of(Field::effector));
    if (crowd.features & feature::aim) {  // from the ray
        const Vector<double> axis = normalise(aim_axis(crowd, group, limb, pose.hand));
        miss = miss - std::fmax(scalar_product(miss, axis), 0) * axis;
    }
    return std::sqrt(len2(miss));
}

double residual(const swivel_crowd& crowd, const Group& group, std::size_t limb)
{
    const double missed = distance_missed(crowd, group, limb);
    const Bones bones = bones_of(crowd, limb);
    const double length = bones.upper + bones.fore;
    return length > 0 || std::isnan(missed) ? missed / length : 0;
}

}  // namespace swivel
