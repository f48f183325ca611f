// SPDX-License-Identifier: MIT
#include <cmath>

#include "batch/explain/compare.h"

namespace swivel {

namespace {

constexpr Mistake kJointsWFirst{
    [](Reading& how) { how.joints_w_first = true; },
    "The pose's joint rotations are stored as w, x, y, z, but swivel takes x, y, z, w. Reorder them."};
constexpr Mistake kRootWFirst{
    [](Reading& how) { how.root_w_first = true; },
    "The pose's root_rotation is stored as w, x, y, z, but swivel takes x, y, z, w. Reorder it."};
constexpr Mistake kAllWFirst{[](Reading& how) { how.joints_w_first = how.root_w_first = true; },
                             "The pose's rotations, root_rotation among them, are stored as w, x, y, z, but swivel "
                             "takes x, y, z, w. Reorder them."};
constexpr Mistake kJointsInverse{
    [](Reading& how) { how.joints_inverse = true; },
    "The pose's joint rotations are the inverse ones: conjugates. Negate x, y and z of each."};
constexpr Mistake kRootInverse{[](Reading& how) { how.root_inverse = true; },
                               "The pose's root_rotation is the inverse one: a conjugate. Negate its x, y and z."};
constexpr Mistake kAllInverse{
    [](Reading& how) { how.joints_inverse = how.root_inverse = true; },
    "The pose's rotations, root_rotation among them, are the inverse ones: conjugates. Negate x, y and z of each."};
constexpr Mistake kTransposed{[](Reading& how) { how.joints_inverse = true; },
                              "The 3 x 3 part of the pose's matrices is transposed, so rows are where columns must be. "
                              "Transpose it, but leave the translation."};
constexpr Mistake kInBody{
    [](Reading& how) { how.space = SWIVEL_IN_BODY; },
    "The pose's joints are relative to the root, but its space is SWIVEL_LOCAL. Give SWIVEL_IN_BODY."};
constexpr Mistake kLocal{
    [](Reading& how) { how.space = SWIVEL_LOCAL; },
    "The pose's joints are relative to their parents, but its space is SWIVEL_IN_BODY. Give SWIVEL_LOCAL."};

// Quaternions of joints, of the root, or else of both.
void guess_quaternions(Causes& causes, const Mistake& joints, const Mistake& root, const Mistake& all)
{
    const bool has_joints = has_quaternions(causes.limb), has_root = causes.limb.pose.root_rotation.data;
    bool is_found = causes.guess(has_joints, joints);
    is_found |= causes.guess(has_root, root);
    causes.guess(has_joints && has_root && !is_found, all);
}

// Whether matrices of 12 floats are likely 16 by columns: no matrix of the chain fits the form.
bool may_be_columns(const ComparedLimb& limb)
{
    for (const std::uint32_t joint : limb.joints.at)
        for (std::uint32_t at = joint; at != 0; at = limb.body.parent(at))
            if (!limb.body.may_be_columns(at)) return false;
    return true;
}
void guess_other_form(Causes& causes, swivel_pose_form form)
{
    constexpr const char* names[] = {"SWIVEL_ROTATIONS", "SWIVEL_MATRIX_ROWS", "SWIVEL_MATRIX_COLUMNS",
                                     "SWIVEL_MATRIX_COLUMNS3"};
    const ComparedLimb& limb = causes.limb;
    if (has_quaternions(limb) || form == limb.pose.form) return;
    if (form == SWIVEL_MATRIX_COLUMNS && !may_be_columns(limb)) return;
    Reading how = limb.as_given;
    how.form = form;
    if (const LimbPlaces ours = limb.places(limb.joints, how); limb.agrees(ours))
        causes.add(ours).add(
            "The pose's matrices are stored as %s, but its form is %s. Rows are taken for columns. Give %s.",
            names[form], names[limb.pose.form], names[form]);
}

// Whether a reading has the limb where the caller has it, but for the shoulder's place.
bool has_bones_alike(const ComparedLimb& limb, const Reading& how)
{
    const LimbPlaces ours = limb.places(limb.joints, how);
    const Vector<double> shift = limb.theirs.at[0] - ours.at[0];
    return limb.agrees(moved(ours, [&](const Vector<double>& v) { return v + shift; }));
}

}  // namespace

void guess_rotations(Causes& causes)
{
    guess_quaternions(causes, kJointsWFirst, kRootWFirst, kAllWFirst);
    guess_quaternions(causes, kJointsInverse, kRootInverse, kAllInverse);
    causes.guess(!has_quaternions(causes.limb), kTransposed);
    for (const swivel_pose_form form : {SWIVEL_MATRIX_ROWS, SWIVEL_MATRIX_COLUMNS, SWIVEL_MATRIX_COLUMNS3})
        guess_other_form(causes, form);
    causes.guess(true, causes.limb.pose.space == SWIVEL_LOCAL ? kInBody : kLocal);
}

bool guess_turns_in_body(Causes& causes)
{
    const ComparedLimb& limb = causes.limb;
    const bool is_of_quaternions = has_quaternions(limb);
    Reading at_rest = limb.as_given;
    at_rest.at_rest = true;
    if (limb.pose.space != SWIVEL_IN_BODY || (is_of_quaternions && !limb.pose.translations.data) ||
        has_bones_alike(limb, at_rest))
        return false;
    const auto explains = [&](const Mistake& mistake) {
        Reading how = at_rest;
        mistake.make(how);
        return has_bones_alike(limb, how);
    };
    const Mistake* const inverse = is_of_quaternions ? &kJointsInverse : &kTransposed;
    const Mistake* const found = explains(*inverse)                             ? inverse
                                 : is_of_quaternions && explains(kJointsWFirst) ? &kJointsWFirst
                                                                                : nullptr;
    if (!found) return false;
    ++causes.count;
    causes.text.add("The places agree, but the bones do not lie along them as the joints are turned. %s",
                    found->sentence);
    return true;
}

bool guess_strides(Causes& causes)
{
    const PosedBody& body = causes.limb.body;
    for (const std::uint32_t joint : causes.limb.joints.at)
        for (std::uint32_t at = joint; at != 0; at = body.parent(at)) {
            const double size = body.rotation_length(at);
            if (std::fabs(size - 1) <= 0.05) continue;
            causes.text.add(
                "The rotation of joint %u is a quaternion of length %.3g. Rotations have length 1, so the pose is read "
                "at the wrong places: look at its strides and offsets.",
                body.skeleton_joint(at), size);
            return true;
        }
    return false;
}

}  // namespace swivel
