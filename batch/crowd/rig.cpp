// SPDX-License-Identifier: MIT
#include "batch/crowd/rig.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "batch/refusal/sized.h"
#include "batch/refusal/status.h"
#include "core/arm.h"
#include "core/frame_rotor.h"

namespace swivel {

namespace {

Rotor<double> rotor_of(const float (&q)[4]) { return rotor<double>(q[0], q[1], q[2], q[3]); }

// In the arm frame: a limb at rest, and where flexion carries its forearm. The elbow points the other way.
constexpr Vector<double> kLineAtRest = vector(0.0, 0.0, 1.0), kBendAtRest = vector(0.0, 1.0, 0.0);

bool is_usable_bone(const Vector<double>& v) { return len2(v) >= kTiny2 && len2(v) <= kHuge2; }

void store_unit(const Rotor<double>& q, float (&to)[4]) { store(hemisphere(normalise(q)), to); }

// cos 10 degrees. A rest pose with less bend shows noise instead of the bend's direction.
constexpr double kBent = 0.984807753;

// The rotor from the arm frame to a joint's own frame: e3 to the joint's bone, e1 to the hinge's part orthogonal to it.
Rotor<double> align(const Vector<double>& bone, const Vector<double>& hinge)
{
    const Vector<double> axis = normalise(bone);
    return frame_rotor(axis, normalise(hinge - scalar_product(hinge, axis) * axis));
}

bool is_along(const Vector<double>& a, const Vector<double>& b)
{
    return !(len2(cross(a, b)) > 1e-6 * len2(a) * len2(b));  // sin 1e-3, as for poles
}

// The rotor from the arm frame to a joint's parent, given the one to the joint above.
Rotor<double> parent_from(const RestJoint& joint, const Rotor<double>& above_from_arm)
{
    return joint.between ? ~*joint.between * above_from_arm : above_from_arm;
}

// The axis that the elbow turns about, in the shoulder joint's frame, as are the bones and the bend. Flexion turns from
// the upper arm, e3, towards the bend, e2: about -e1, the opposite of this.
swivel_status find_hinge(const Vector<double>& upper, const Vector<double>& fore, const Vector<double>& given,
                         Vector<double>& hinge)
{
    if (!(len2(given) <= kHuge2))
        return refuse("swivel_bind_joints: the bend is not finite or longer than 1e15; give a direction or zeros");
    const bool is_given = len2(given) >= kTiny2;
    if (!is_given && scalar_product(upper, fore) >= kBent * std::sqrt(len2(upper) * len2(fore)))
        return refuse(
            "swivel_bind_joints: the rest pose is straight within 10 degrees, so it does not show where the limb bends "
            "to; give the bend");
    const Vector<double> bend = is_given ? given : fore;
    if (is_along(bend, upper))
        return refuse(
            "swivel_bind_joints: the %s lies along the upper arm; give the direction that flexion carries the forearm "
            "towards",
            is_given ? "bend" : "forearm");
    hinge = cross(bend, upper);
    if (is_along(hinge, fore))
        return refuse(
            "swivel_bind_joints: the forearm at rest lies along the axis that the bend turns it about; give another "
            "bend");
    return SWIVEL_OK;
}

}  // namespace

swivel_status bind(const RestLimb& limb, swivel_binding& to)
{
    const std::size_t size = size_of(&to);
    if (const swivel_status status = check_size<swivel_binding>("binding", size); status != SWIVEL_OK) return status;
    swivel_binding binding = swivel_default_binding();
    const Vector<double>&upper = limb.elbow.place, &fore = limb.wrist.place;
    if (!is_usable_bone(upper) || !is_usable_bone(fore))
        return refuse("swivel_bind_joints: the %s has no direction; it must be 1e-15 to 1e15 long",
                      is_usable_bone(upper) ? "forearm" : "upper arm");
    const Rotor<double> elbow_unit = normalise(limb.elbow.rotation);
    const Rotor<double> elbow_s = limb.elbow.between ? *limb.elbow.between * elbow_unit : elbow_unit;
    Vector<double> hinge;
    if (const swivel_status status = find_hinge(upper, sandwich(elbow_s, fore), limb.bend, hinge); status != SWIVEL_OK)
        return status;

    const Rotor<double> upper_from_arm = align(upper, hinge);
    const Rotor<double> fore_from_arm = align(fore, sandwich(~elbow_s, hinge));
    store_unit(limb.shoulder.rotation * upper_from_arm, binding.parent_from_arm);
    store_unit(upper_from_arm, binding.upper_from_arm);
    store_unit(parent_from(limb.elbow, upper_from_arm), binding.elbow_parent_from_arm);
    store_unit(fore_from_arm, binding.fore_from_arm);
    store_unit(parent_from(limb.wrist, fore_from_arm), binding.wrist_parent_from_arm);
    store_unit(limb.shoulder.rotation, binding.shoulder_rest);
    store_unit(limb.elbow.rotation, binding.elbow_rest);
    store_unit(limb.wrist.rotation, binding.wrist_rest);
    binding.lengths[0] = static_cast<float>(std::sqrt(len2(upper)));
    binding.lengths[1] = static_cast<float>(std::sqrt(len2(fore)));
    binding.twist_bone_count = limb.twist_bone_count;
    for (std::uint32_t n = 0; n < SWIVEL_MAX_TWIST_BONES; ++n) {
        const bool is_known = n < limb.twist_bone_count;
        const Rotor<double> parent = is_known ? parent_from(limb.twist_bones[n], fore_from_arm) : fore_from_arm;
        store_unit(parent, binding.twist_parent_from_arm[n]);
        store_unit(is_known ? ~limb.twist_bones[n].rotation * parent : parent, binding.twist_from_arm[n]);
    }
    binding.size = size;
    std::memcpy(&to, &binding, size);
    return SWIVEL_OK;
}

bool is_binding(const swivel_binding& b)
{
    const auto is_unit = [](const float(&q)[4]) {
        return std::fabs(len2(rotor_of(q)) - 1) <= 1e-5;  // ten times what rounding to floats leaves
    };
    const auto are_unit = [&](const auto& list) { return std::all_of(std::begin(list), std::end(list), is_unit); };
    return is_unit(b.parent_from_arm) && is_unit(b.upper_from_arm) && is_unit(b.elbow_parent_from_arm) &&
           is_unit(b.fore_from_arm) && is_unit(b.wrist_parent_from_arm) && is_unit(b.shoulder_rest) &&
           is_unit(b.elbow_rest) && is_unit(b.wrist_rest) && b.twist_bone_count <= SWIVEL_MAX_TWIST_BONES &&
           are_unit(b.twist_parent_from_arm) && are_unit(b.twist_from_arm);
}

Vector<double> behind_in_arm(const float (&pole_behind)[3], const swivel_binding* binding)
{
    const Vector<double> given = vector<double>(pole_behind[0], pole_behind[1], pole_behind[2]);
    if (!(len2(given) > 0)) return -kBendAtRest;
    return normalise(binding ? sandwich(~rotor_of(binding->parent_from_arm), given) : given);
}

HalfLine half_line(const Vector<double>& behind)
{
    // The mirror that turns `behind` into the limb at rest is its own inverse.
    const Vector<double> mirror = kLineAtRest - behind, at_rest = cross(kBendAtRest, kLineAtRest);
    const Vector<double> normal = at_rest - 2 * scalar_product(mirror, at_rest) / len2(mirror) * mirror;
    HalfLine made;
    for (std::size_t c = 0; c < 3; ++c) {
        made.behind[c] = static_cast<float>(behind.c[c]);
        made.normal[c] = static_cast<float>(normal.c[c]);
    }
    return made;
}

swivel_status check_pole_behind(std::uint32_t group, const float (&pole_behind)[3], const swivel_binding* binding)
{
    const double x = pole_behind[0], y = pole_behind[1], z = pole_behind[2], length2 = x * x + y * y + z * z;
    if (!(length2 <= kHuge2) || (length2 > 0 && length2 < kTiny2))
        return refuse("group %u: pole_behind is %g, %g, %g; give a direction 1e-15 to 1e15 long, or zeros", group, x, y,
                      z);
    const Vector<double> behind = behind_in_arm(pole_behind, binding);
    if (is_along(behind, kLineAtRest) && scalar_product(behind, kLineAtRest) > 0)
        return refuse("group %u: pole_behind lies along the limb at rest; give a direction where its wrist does not go",
                      group);
    return SWIVEL_OK;
}

swivel_status arm_axis(const swivel_binding& binding, const float* parent_rotation, const double* direction,
                       double* axis)
{
    const float* const q = parent_rotation;
    const Rotor<double> parent = rotor<double>(q[0], q[1], q[2], q[3]);
    const Vector<double> wanted = vector<double>(direction[0], direction[1], direction[2]);
    if (!is_binding(binding))
        return refuse(
            "swivel_arm_axis: the binding holds a quaternion not of unit length; make it with swivel_bind_joints()");
    if (!is_orientation(parent))
        return refuse("swivel_arm_axis: the parent's rotation is zero or not finite; give a quaternion x, y, z, w");
    if (!is_usable_bone(wanted))
        return refuse("swivel_arm_axis: direction (%g, %g, %g) is not 1e-15..1e15 long", direction[0], direction[1],
                      direction[2]);
    const Rotor<double> world_from_arm = normalise(parent) * normalise(rotor_of(binding.parent_from_arm));
    const Vector<double> in_arm = normalise(sandwich(~world_from_arm, wanted));
    std::copy(std::begin(in_arm.c), std::end(in_arm.c), axis);
    return SWIVEL_OK;
}

}  // namespace swivel
