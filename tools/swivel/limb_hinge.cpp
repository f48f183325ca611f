// SPDX-License-Identifier: MIT
#include "tools/swivel/limb_hinge.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tools/swivel/cannot_bind.h"
#include "tools/swivel/limb_words.h"
#include "tools/swivel/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;
using formats::LimbKind;
using formats::LimbName;

constexpr double kDegree = std::numbers::pi / 180;

// In degrees, of a rest pose: more than rounding leaves, more than modelling leaves by chance, and more than any knee
// or elbow bends the wrong way (pressed through, knock-kneed, carried off the body).
constexpr double kSlightlyBent = 2, kBent = 5, kSurelyBent = 20;

// The bend of two bones given in one space: the axis, as long as its sine.
Vector3d bend_of(const Vector3d& upper, const Vector3d& lower) { return lower.normalized().cross(upper.normalized()); }

// At rest; 0 for a limb that is folded by more than 175 degrees, which tells its axis no better than a straight one.
double bend_degrees(const ChainPose& rest)
{
    const double bend = degrees_between(rest.turn[0] * rest.upper_bone(), rest.turn[1] * rest.lower_bone());
    return bend > 175 ? 0 : bend;
}

// Its bend in the upper joint's axes, the upper bone laid where it is at rest.
Vector3d bend_of(const ChainPose& pose, const Vector3d& rest_bone)
{
    const Vector3d upper = pose.upper_bone(), lower = pose.turn[0].conjugate() * (pose.turn[1] * pose.lower_bone());
    return aim(rest_bone, upper).conjugate() * bend_of(upper, lower);
}

Hinge rest_hinge(const ChainPose& rest)
{
    return {bend_of(rest, rest.upper_bone().normalized()).normalized(),
            fmt::format("bend of the rest pose, {:.1f} degrees", bend_degrees(rest))};
}

// The mean of the frames' bends, axes as long as their sines; nothing for a clip that hardly bends the limb, or to both
// sides.
std::optional<Vector3d> mean_bend(const Clip& clip, const LimbChain& chain, const Vector3d& rest_bone)
{
    if (clip.frame_count < 2) return std::nullopt;  // one pose is no motion
    Vector3d sum = Vector3d::Zero();
    double weight = 0;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Vector3d bend = bend_of(chain_pose(clip, frame, chain), rest_bone);
        if (!bend.allFinite()) continue;
        sum += bend;
        weight += bend.norm();
    }
    // 0.02: a mean bend of one degree; half: the bends must agree on an axis, not cancel.
    const bool is_clear = weight > 0.02 * static_cast<double>(clip.frame_count) && sum.norm() > 0.5 * weight;
    return is_clear ? std::optional(Vector3d(sum / static_cast<double>(clip.frame_count))) : std::nullopt;
}

// How elbows and knees bend.
struct TableBend {
    Vector3d axis;      // in the upper joint's axes, unit: the hinge
    std::string words;  // "elbows bend forwards"
};

// Not where a limb points so that nobody can say how it was turned about its own bone on the way there: legs more than
// 60 degrees off hanging; arms within 45 degrees of overhead, and those whose elbow would bend, after a swing from
// hanging, more than 60 degrees off forwards or off where it does after a swing out of a T-pose.
bool table_knows(LimbKind kind, const Vector3d& upper_w, const Front& front)
{
    if (kind == LimbKind::leg) return degrees_between(upper_w, -front.up) <= 60;
    if (degrees_between(upper_w, front.up) < 45) return false;
    const Vector3d left = front.up.cross(front.forwards), out = upper_w.dot(left) < 0 ? Vector3d(-left) : left;
    const auto swung_from = [&](const Vector3d& start) -> Vector3d { return aim(start, upper_w) * front.forwards; };
    const Vector3d from_hanging = swung_from(-front.up),
                   forwards = front.forwards - front.forwards.dot(upper_w) * upper_w;
    return degrees_between(from_hanging, forwards) <= 60 && degrees_between(from_hanging, swung_from(out)) <= 60;
}

std::optional<TableBend> bend_by_table(LimbKind kind, const ChainPose& rest, const JointPose& parent_w,
                                       const Front& front)
{
    const auto seen = [&](const Vector3d& v) { return parent_w.mirrored ? formats::mirrored(v) : v; };
    const Vector3d upper = rest.upper_bone().normalized(), upper_w = parent_w.rotation * seen(rest.turn[0] * upper);
    if (!table_knows(kind, upper_w, front)) return std::nullopt;
    const bool is_arm = kind == LimbKind::arm;
    const Vector3d flexion_w = is_arm ? front.forwards : Vector3d(-front.forwards);
    const Vector3d flexion = rest.turn[0].conjugate() * seen(parent_w.rotation.conjugate() * flexion_w);
    return TableBend{flexion.cross(upper).normalized(), is_arm ? "elbows bend forwards" : "knees bend backwards"};
}

// What to do where nothing tells a limb's hinge.
std::string advice_for(LimbName limb)
{
    return fmt::format("use a clip that bends it, or give limb.{}.hinge in a crowd file", limb_word(limb));
}

// Why the table is silent.
std::string points_anywhere(LimbName limb)
{
    return limb.kind == LimbKind::arm ? "the arm points ahead, behind or overhead, where straight ones bend either way"
                                      : "the leg does not hang, so that its knee may bend any way";
}

// As a crowd file has it.
std::string row(const Vector3d& v)
{
    const Vector3d shown = to_three_decimals(v);
    return fmt::format("[{:.3f}, {:.3f}, {:.3f}]", shown.x(), shown.y(), shown.z());
}

// What a limb tells itself, whatever the figure faces.
std::optional<Hinge> own_hinge(const Clip& clip, const LimbChain& chain, const ChainPose& rest)
{
    const Vector3d upper = rest.upper_bone().normalized();
    const Vector3d bend = bend_of(rest, upper);
    const std::optional<Vector3d> mean = mean_bend(clip, chain, upper);
    // Knock-knees, or a forearm that hangs, bend at rest across what the clip does; knees pressed through, against it.
    const bool is_sure = bend_degrees(rest) > kSurelyBent;
    const double more = mean ? mean->norm() / bend.norm() : 0, off = mean ? degrees_between(*mean, bend) : 0;
    const bool clip_differs = (off > 30 && more > 2) || (is_sure ? off > 120 && more > 1 : off > 60);
    if ((is_sure || (mean && bend_degrees(rest) > kBent)) && !clip_differs) return rest_hinge(rest);
    if (mean) return Hinge{mean->normalized(), "mean bend of the clip"};
    return std::nullopt;
}

}  // namespace

std::string doubt_by_bends(const Clip& clip, const std::array<std::optional<LimbJoints>, 4>& joints, const Front& front)
{
    const std::vector<JointPose> rest_w = formats::rest_pose(clip);
    for (std::size_t n = 0; n < joints.size(); ++n) {
        if (!joints[n]) continue;
        const LimbName name = formats::kLimbNames[n];
        const LimbChain chain = chain_of(clip, *joints[n]);
        const ChainPose rest = rest_pose(clip, chain);
        const std::optional<Hinge> own = own_hinge(clip, chain, rest);
        const int parent = formats::joint_at(clip, chain.upper()).parent;
        const JointPose parent_w = parent < 0 ? JointPose() : rest_w[static_cast<std::size_t>(parent)];
        const std::optional<TableBend> table = bend_by_table(name.kind, rest, parent_w, front);
        if (!table) continue;
        const auto is_off = [&](const Vector3d& axis, double most) {
            return degrees_between(axis, table->axis) > most;
        };
        // Shoulders turn elbows about more than hips do knees.
        const bool own_is_off = own && is_off(own->axis, name.kind == LimbKind::arm ? 120 : 90);
        const bool slight_is_off = !own && !front.is_by_toes && bend_degrees(rest) > kSlightlyBent &&
                                   is_off(bend_of(rest, rest.upper_bone().normalized()), 120);
        if (own_is_off || slight_is_off)
            return fmt::format("the {} does not bend as in a figure that faces by {}", plain_name(name), front.source);
    }
    return "";
}

Hinge choose_hinge(const Clip& clip, LimbName limb, const LimbChain& chain, const ChainPose& rest,
                   const JointPose& parent_w, const Front& front)
{
    if (const std::optional<Hinge> own = own_hinge(clip, chain, rest)) return *own;
    const Vector3d bend = bend_of(rest, rest.upper_bone().normalized());
    const std::optional<TableBend> table = bend_by_table(limb.kind, rest, parent_w, front);
    const double bend_deg = bend_degrees(rest), off = table ? degrees_between(bend, table->axis) : 0;
    if (bend_deg > kBent && (!table || (!front.doubt.empty() && !front.is_told)))
        throw CannotBind(fmt::format("at rest it bends by {:.1f} degrees, too little to tell its way, no clip tells, "
                                     "and {}",
                                     bend_deg, front.doubt.empty() ? points_anywhere(limb) : front.doubt),
                         advice_for(limb));
    if (bend_deg > kBent && off > 60)
        throw CannotBind(
            fmt::format("at rest it bends by {:.1f} degrees, {:.0f} degrees off the way that {}, facing by "
                        "{}, and no clip tells which holds",
                        bend_deg, off, table->words, front.source),
            advice_for(limb) +
                fmt::format(": {} as at rest, {} as {}", row(bend.normalized()), row(table->axis), table->words));
    if (bend_deg > kBent) return rest_hinge(rest);
    if (!table || !front.doubt.empty())
        throw CannotBind("neither rest pose nor clip tells which way it bends, and " +
                             (front.doubt.empty() ? points_anywhere(limb) : front.doubt),
                         advice_for(limb));
    if (bend_deg > 0.5 && off < 45)
        return {bend.normalized(), fmt::format("slight bend of the rest pose, {:.1f} degrees", bend_deg)};
    const char* why = bend_deg > 0.5 ? "as the rest pose bends otherwise and too little to tell"
                                     : "as neither rest pose nor clip tells";
    return {table->axis, fmt::format("{}, facing by {}, {}", table->words, front.source, why)};
}

}  // namespace swivel::tools
