// SPDX-License-Identifier: MIT
#include "batch/rig.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "batch/status.h"
#include "core/frame_rotor.h"
#include "core/solve_arm.h"

namespace swivel {

namespace {

Vector<double> vector_of(const float (&v)[3]) { return vector<double>(v[0], v[1], v[2]); }
Rotor<double> rotor_of(const float (&q)[4]) { return rotor<double>(q[0], q[1], q[2], q[3]); }

bool is_usable(const Rotor<double>& q) { return len2(q) >= 1e-18 && len2(q) <= 1e18; }
bool is_usable_bone(const Vector<double>& v) { return len2(v) >= kTiny2 && len2(v) <= kHuge2; }

void store(const Rotor<double>& q, float (&to)[4])
{
    const Rotor<double> unit = hemisphere(normalise(q));
    to[0] = static_cast<float>(unit.at<kI>());
    to[1] = static_cast<float>(unit.at<kJ>());
    to[2] = static_cast<float>(unit.at<kK>());
    to[3] = static_cast<float>(unit.at<kScalar>());
}

// cos 10 degrees. A rest pose that is bent by less shows noise, and not where the limb bends to.
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

}  // namespace

swivel_status bind(const swivel_chain& chain, swivel_binding& binding)
{
    const Rotor<double> shoulder = rotor_of(chain.shoulder_rotation), elbow = rotor_of(chain.elbow_rotation),
                        wrist = rotor_of(chain.wrist_rotation);
    if (!is_usable(shoulder) || !is_usable(elbow) || !is_usable(wrist))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "swivel_bind: a rest rotation is zero or not finite; give quaternions x, y, z, w");
    const Vector<double> upper = vector_of(chain.elbow_offset), fore = vector_of(chain.wrist_offset);
    if (!is_usable_bone(upper) || !is_usable_bone(fore))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "swivel_bind: the %s has no direction; offsets must have a length in 1e-15..1e15",
                    is_usable_bone(upper) ? "forearm" : "upper arm");

    const Rotor<double> elbow_unit = normalise(elbow);
    const Vector<double> fore_s = sandwich(elbow_unit, fore);  // in the shoulder joint's frame
    const Vector<double> given = vector_of(chain.bend);
    if (!(len2(given) <= kHuge2))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "swivel_bind: the bend is not finite or longer than 1e15; give a direction or zeros");
    const bool is_given = len2(given) >= kTiny2;
    if (!is_given && scalar_product(upper, fore_s) >= kBent * std::sqrt(len2(upper) * len2(fore_s)))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "swivel_bind: the rest pose is straight within 10 degrees, so it does not show where the limb "
                    "bends to; give the bend");
    const Vector<double> bend = is_given ? given : fore_s;
    if (is_along(bend, upper))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "swivel_bind: the %s lies along the upper arm; give the direction that flexion carries the "
                    "forearm towards",
                    is_given ? "bend" : "forearm");
    // Flexion turns from the upper arm, e3, towards the bend, e2: about -e1.
    const Vector<double> hinge = cross(bend, upper);
    if (is_along(hinge, fore_s))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "swivel_bind: the forearm at rest lies along the axis that the bend turns it about; give another "
                    "bend");

    const Rotor<double> upper_from_arm = align(upper, hinge);
    const Rotor<double> fore_from_arm = align(fore, sandwich(~elbow_unit, hinge));
    store(shoulder * upper_from_arm, binding.parent_from_arm);
    store(upper_from_arm, binding.upper_from_arm);
    store(fore_from_arm, binding.fore_from_arm);
    store(shoulder, binding.shoulder_rest);
    store(elbow, binding.elbow_rest);
    store(wrist, binding.wrist_rest);
    binding.lengths[0] = static_cast<float>(std::sqrt(len2(upper)));
    binding.lengths[1] = static_cast<float>(std::sqrt(len2(fore)));
    return SWIVEL_OK;
}

bool is_binding(const swivel_binding& b)
{
    for (const auto* q :
         {&b.parent_from_arm, &b.upper_from_arm, &b.fore_from_arm, &b.shoulder_rest, &b.elbow_rest, &b.wrist_rest}) {
        const Rotor<double> unit = rotor<double>((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
        if (!(std::fabs(len2(unit) - 1) <= 1e-5)) return false;  // ten times what rounding to floats leaves
    }
    return true;
}

swivel_status arm_axis(const swivel_binding& binding, const float (&parent_rotation)[4], const double (&direction)[3],
                       double (&axis)[3])
{
    const Rotor<double> parent = rotor_of(parent_rotation);
    const Vector<double> wanted = vector<double>(direction[0], direction[1], direction[2]);
    if (!is_binding(binding))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "swivel_arm_axis: the binding holds a quaternion not of unit length; make it with swivel_bind()");
    if (!is_usable(parent))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "swivel_arm_axis: the parent's rotation is zero or not finite; give a quaternion x, y, z, w");
    if (!is_usable_bone(wanted))
        return fail(SWIVEL_INVALID_ARGUMENT, "swivel_arm_axis: direction (%g, %g, %g) is not 1e-15..1e15 long",
                    direction[0], direction[1], direction[2]);
    const Rotor<double> world_from_arm = normalise(parent) * normalise(rotor_of(binding.parent_from_arm));
    const Vector<double> in_arm = normalise(sandwich(~world_from_arm, wanted));
    std::copy(std::begin(in_arm.c), std::end(in_arm.c), axis);
    return SWIVEL_OK;
}

}  // namespace swivel
