// SPDX-License-Identifier: MIT
#include "tools/rig/limb_hinge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/rig/cannot_bind.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;
using formats::LimbKind;
using formats::LimbName;

// In degrees, of a rest pose: more than rounding leaves, enough to speak against the front that shoulders or hips tell,
// more than modelling leaves by chance, and more than any knee or elbow bends the wrong way (pressed through,
// knock-kneed, carried off the body).
constexpr double kBarelyBent = 0.5, kSpeaksAgainst = 2, kBent = 5, kSurelyBent = 20;

// The axis that two bones given in one space are bent about, as long as the bend's sine.
Vector3d axis_of(const Vector3d& upper, const Vector3d& lower) { return lower.normalized().cross(upper.normalized()); }

// At rest; 0 for a limb that is folded by more than 175 degrees, which tells its axis no better than a straight one.
double bend_degrees(const ChainPose& rest)
{
    const double bend = degrees_between(rest.turn[0] * rest.upper_bone(), rest.turn[1] * rest.lower_bone());
    return bend > 175 ? 0 : bend;
}

// That of a pose in the upper joint's axes, the upper bone laid where it is at rest.
Vector3d axis_of(const ChainPose& pose, const Vector3d& rest_bone)
{
    const Vector3d upper = pose.upper_bone(), lower = pose.turn[0].conjugate() * (pose.turn[1] * pose.lower_bone());
    return aim(rest_bone, upper).conjugate() * axis_of(upper, lower);
}

Hinge rest_hinge(const ChainPose& rest)
{
    return {axis_of(rest, rest.upper_bone().normalized()).normalized(),
            fmt::format("bend of the rest pose, {:.1f} degrees", bend_degrees(rest))};
}

// The mean of the frames' axes, each as long as its bend's sine; nothing for a clip that hardly bends the limb, or to
// both sides, or not otherwise than at rest.
std::optional<Vector3d> mean_axis(const Clip& clip, const LimbChain& chain, const ChainPose& rest)
{
    if (clip.frame_count < 2) return std::nullopt;  // one pose is no motion
    constexpr double kOneDegree = 0.02;             // its sine, about
    const Vector3d rest_bone = rest.upper_bone().normalized(), at_rest = axis_of(rest, rest_bone);
    Vector3d sum = Vector3d::Zero();
    double weight = 0, farthest = 0;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Vector3d axis = axis_of(chain_pose(clip, frame, chain), rest_bone);
        if (!axis.allFinite()) continue;
        sum += axis;
        weight += axis.norm();
        farthest = std::max(farthest, (axis - at_rest).norm());
    }
    const bool is_clear = farthest > kOneDegree && weight > kOneDegree * static_cast<double>(clip.frame_count) &&
                          sum.norm() > 0.5 * weight;  // half: the axes must agree, not cancel
    return is_clear ? std::optional(Vector3d(sum / static_cast<double>(clip.frame_count))) : std::nullopt;
}

// How elbows and knees bend.
struct TableBend {
    Vector3d axis;      // in the upper joint's axes, unit: the hinge
    std::string words;  // "elbows bend forwards"
};

// Whether it is known how a straight limb bends that points there. It is not where it depends on the way there how the
// limb is turned about its own bone: for legs more than 60 degrees off hanging; for arms within 45 degrees of overhead,
// where the elbow bends forwards if they were raised by the side and backwards if by the front, and for those whose
// elbow would bend, after a swing from hanging, more than 60 degrees off forwards or off where it does after a swing
// out of a T-pose.
bool table_knows(LimbName limb, const Vector3d& upper_w, const Front& front)
{
    if (limb.kind == LimbKind::leg) return degrees_between(upper_w, -front.up) <= 60;
    if (degrees_between(upper_w, front.up) < 45) return false;
    const Vector3d left = front.up.cross(front.forwards),
                   own_side = limb.side == formats::Side::left ? left : Vector3d(-left);
    // More than crosses a body: below a mirror left and right may be exchanged.
    const Vector3d out = degrees_between(upper_w, own_side) > 120 ? Vector3d(-own_side) : own_side;
    const auto swung_from = [&](const Vector3d& start) -> Vector3d { return aim(start, upper_w) * front.forwards; };
    const Vector3d from_hanging = swung_from(-front.up);
    const Vector3d forwards = front.forwards - front.forwards.dot(upper_w) * upper_w;
    return degrees_between(from_hanging, forwards) <= 60 && degrees_between(from_hanging, swung_from(out)) <= 60;
}

std::optional<TableBend> bend_by_table(LimbName limb, const ChainPose& rest, const JointPose& parent_w,
                                       const Front& front)
{
    const auto seen = [&](const Vector3d& v) { return parent_w.mirrored ? formats::mirrored(v) : v; };
    const Vector3d upper = rest.upper_bone().normalized(), upper_w = parent_w.rotation * seen(rest.turn[0] * upper);
    if (!table_knows(limb, upper_w, front)) return std::nullopt;
    const bool is_arm = limb.kind == LimbKind::arm;
    const Vector3d flexion_w = is_arm ? front.forwards : Vector3d(-front.forwards);
    const Vector3d flexion = rest.turn[0].conjugate() * seen(parent_w.rotation.conjugate() * flexion_w);
    return TableBend{flexion.cross(upper).normalized(), is_arm ? "elbows bend forwards" : "knees bend backwards"};
}

// What to do where nothing tells a limb's hinge.
std::string advice_for(LimbName limb)
{
    return fmt::format("use a clip that bends it, or give limb.{}.bend in a crowd file", limb_word(limb));
}

// Why the table is silent.
std::string points_anywhere(LimbName limb)
{
    return limb.kind == LimbKind::arm ? "the arm points ahead, behind or overhead, where straight ones bend either way"
                                      : "the leg does not hang, so that its knee may bend any way";
}

// What a limb tells itself, whatever the figure faces.
std::optional<Hinge> own_hinge(const Clip& clip, const LimbChain& chain, const ChainPose& rest)
{
    const Vector3d upper = rest.upper_bone().normalized();
    const Vector3d axis = axis_of(rest, upper);
    const std::optional<Vector3d> mean = mean_axis(clip, chain, rest);
    // Knock-knees, or a forearm that hangs, bend at rest across what the clip does; knees pressed through, against it.
    const bool is_sure = bend_degrees(rest) > kSurelyBent;
    const double more = mean ? mean->norm() / axis.norm() : 0, off = mean ? degrees_between(*mean, axis) : 0;
    const bool clip_differs = (off > 30 && more > 2) || (is_sure ? off > 120 && more > 1 : off > 60);
    if ((is_sure || (mean && bend_degrees(rest) > kBent)) && !clip_differs) return rest_hinge(rest);
    if (mean) return Hinge{mean->normalized(), "mean bend of the clip"};
    return std::nullopt;
}

}  // namespace

Vector3d bend_of_hinge(const Vector3d& upper_bone, const Vector3d& axis) { return upper_bone.cross(axis).normalized(); }

std::string toml_row(const Vector3d& v)
{
    const Vector3d shown = to_three_decimals(v);
    return fmt::format("[{:.3f}, {:.3f}, {:.3f}]", shown.x(), shown.y(), shown.z());
}

std::string doubt_by_bends(const Clip& clip, const std::array<std::optional<LimbJoints>, 4>& joints, const Front& front)
{
    const std::vector<JointPose> rest_w = formats::rest_pose(clip);
    bool is_confirmed = front.is_by_named_toes || !front.is_told;  // an exchange of left and right turns neither
    double most_bent = kSpeaksAgainst;                             // of the limbs that tell no hinge themselves
    std::string against;                                           // what that one says
    for (std::size_t n = 0; n < joints.size(); ++n) {
        if (!joints[n]) continue;
        const LimbName name = formats::kLimbNames[n];
        const LimbChain chain = chain_of(clip, *joints[n]);
        const ChainPose rest = rest_pose(clip, chain);
        const int parent = formats::joint_at(clip, chain.upper()).parent;
        const JointPose parent_w = parent < 0 ? JointPose() : rest_w[static_cast<std::size_t>(parent)];
        const std::optional<TableBend> table = bend_by_table(name, rest, parent_w, front);
        if (!table) continue;
        const std::string said =
            fmt::format("the {} does not bend as in a figure that faces by {}", plain_name(name), front.source);
        if (const std::optional<Hinge> own = own_hinge(clip, chain, rest)) {
            const double off = degrees_between(own->axis, table->axis);
            // Shoulders turn elbows about more than hips do knees.
            if (off > (name.kind == LimbKind::arm ? 120 : 90)) return said;
            is_confirmed = is_confirmed || off < 60;
        } else if (bend_degrees(rest) > most_bent) {
            most_bent = bend_degrees(rest);
            const Vector3d axis = axis_of(rest, rest.upper_bone().normalized());
            against = degrees_between(axis, table->axis) > 120 ? said : "";  // all but the other way round
        }
    }
    return is_confirmed ? "" : against;
}

Hinge choose_hinge(const Clip& clip, LimbName limb, const LimbChain& chain, const ChainPose& rest,
                   const JointPose& parent_w, const Front& front)
{
    if (const std::optional<Hinge> own = own_hinge(clip, chain, rest)) return *own;
    const Vector3d axis = axis_of(rest, rest.upper_bone().normalized());
    const std::optional<TableBend> table = bend_by_table(limb, rest, parent_w, front);
    const double bend_deg = bend_degrees(rest), off = table ? degrees_between(axis, table->axis) : 0;
    const bool is_doubted = !front.doubt.empty() && (bend_deg <= kBent || !front.is_told);
    if (is_doubted || !table)
        throw CannotBind(
            (bend_deg > kBent
                 ? fmt::format("at rest it bends by {:.1f} degrees, too little to tell its way, no clip tells",
                               bend_deg)
                 : "neither rest pose nor clip tells which way it bends") +
                ", and " + (is_doubted ? front.doubt : points_anywhere(limb)),
            advice_for(limb));
    const auto row = [&](const Vector3d& of) { return toml_row(bend_of_hinge(rest.upper_bone(), of)); };
    if (bend_deg > kBent && off > 60)
        throw CannotBind(
            fmt::format("at rest it bends by {:.1f} degrees, {:.0f} degrees off the way that {}, facing by "
                        "{}, and no clip tells which holds",
                        bend_deg, off, table->words, front.source),
            advice_for(limb) + fmt::format(": {} as at rest, {} as {}", row(axis), row(table->axis), table->words));
    if (bend_deg > kBent) return rest_hinge(rest);
    if (bend_deg > kBarelyBent && off < 45)
        return {axis.normalized(), fmt::format("slight bend of the rest pose, {:.1f} degrees", bend_deg)};
    const char* why = bend_deg > kBarelyBent ? "as the rest pose bends otherwise and too little to tell"
                                             : "as neither rest pose nor clip tells";
    return {table->axis, fmt::format("{}, facing by {}, {}", table->words, front.source, why)};
}

}  // namespace swivel::tools
