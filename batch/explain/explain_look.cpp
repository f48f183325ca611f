// SPDX-License-Identifier: MIT
//
// No row tells how far a joint turned, or how the root is turned. If flags leave several causes, the solved line of
// sight decides. Degrees are for people. Trigonometry is allowed here, because no solve sees it.
#include "batch/explain/explain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "batch/explain/bad_value.h"
#include "batch/query/limb_value.h"
#include "core/conformal.h"

namespace swivel {

namespace {

struct LookOfBody {
    const swivel_crowd& crowd;
    const Group& group;
    std::uint32_t limb;
    LimbValue sight{group, limb, SWIVEL_SIGHT}, turns{group, limb, SWIVEL_LOOK_TURNS},
        target{group, limb, SWIVEL_LOOK_TARGET};
    const LookRules& rules = group.plan.look;
    const GroupJoints& joints = group.plan.joints;
    double weight = LimbValue(group, limb, SWIVEL_LOOK_WEIGHT)[0];
    std::uint32_t flags = flags_of(group, limb);
    std::uint32_t notes = crowd.pose_notes.load(std::memory_order_relaxed);
    Vector<double> axis = vector(sight[3], sight[4], sight[5]),
                   to = vector(target[0] - sight[0], target[1] - sight[1], target[2] - sight[2]);

    bool has_target() const { return !std::isnan(target.length(0, 3)); }
    bool is_anew() const { return turns[0] == 0; }
    double distance() const { return std::sqrt(len2(to)); }
    // The angle from the line of sight to its target, radians.
    double missed() const { return std::atan2(std::sqrt(len2(cross(axis, to))), scalar_product(axis, to)); }
    // The angle that rounding of places and directions may cause.
    double rounding() const
    {
        return 1e-5 + 1e-6 * (sight.length(0, 3) + target.length(0, 3)) / std::max(distance(), 1e-30);
    }
    // Whether the last solve had another target, as far as its flags tell.
    bool has_changed() const
    {
        if (flags & SWIVEL_REACHED) return !has_target() || missed() > 1e-4 + rounding();
        return has_target() && missed() < 1e-4 - rounding();
    }

    // Suspects a very far target to be in centimetres or from another origin.
    void doubt_distance(Text& text) const
    {
        double chain = 0;
        std::uint32_t at = joint_at(crowd, joints.turned[joints.turned_count - 1].row);
        for (; at != 0; at = joint_at(crowd, crowd.joints[at].parent)) {
            const float(&v)[3] = crowd.joints[at].translation;
            chain += std::sqrt(len2(vector<double>(v[0], v[1], v[2])));
        }
        if (chain > 0 && distance() > 1e4 * chain)
            text.add(
                "Warning: its target is %.3g away, more than ten thousand times as far as the last joint is from the "
                "root. Is it in another unit, or from another origin? ",
                distance());
    }
    void explain_bad(Text& text) const
    {
        std::array<char, 128> words;  // the chain is the last joint and joints above it
        Text(words).add("a rotation, place or scale of joint %u, of one above or of the root", last_joint());
        text.add("Bad input: ");
        if (!explain_bad_in_body(group, limb, text))
            explain_bad_pose(crowd, (rules.rate > 0 ? kTimeOfPose : 0u) | kWeightOfPose | kJointsOfPose, words.data(),
                             text);
        text.add(". The chain keeps its incoming pose.");
    }
    void explain_nothing(Text& text) const
    {
        text.add("It has nothing to look at");
        explain_way_back(text);
    }
    void explain_way_back(Text& text) const
    {
        if (flags & SWIVEL_LIMITED_STEP)
            text.add(", and the chain is on its way back to its incoming pose, by %.3g degrees a second.",
                     in_degrees(double{rules.rate}));
        else
            text.add(", so the chain has its incoming pose.");
    }
    void explain_miss(Text& text) const
    {
        text.add("The line of sight misses its target by %.3g degrees.", in_degrees(missed()));
        const bool is_whole = weight == 1 && !(flags & SWIVEL_FADED);
        if (weight == 0) text.add(" Its weight is 0");
        if (weight == 0) return explain_way_back(text);
        if (weight < 1) text.add(" With a weight of %.3g it takes a part of the turn.", weight);
        if (flags & SWIVEL_FADED) explain_fade(text);
        if (flags & SWIVEL_LIMITED_STEP) explain_rate(is_whole && !(flags & SWIVEL_LIMITED_LOOK), text);
        if (flags & SWIVEL_LIMITED_LOOK) explain_cone(is_whole, text);
        if (!is_whole || flags & (SWIVEL_LIMITED_STEP | SWIVEL_LIMITED_LOOK)) return;
        if (!(notes & kHasWeight))
            explain_nearness(text);
        else if (may_be_too_near())
            text.add(
                " Either the target is nearer to joint %u than the line of sight comes, or the pose has a weight below "
                "1.",
                last_joint());
        else
            text.add(" The pose has a weight below 1.");
    }

private:
    std::uint32_t last_joint() const { return joints.turned[joints.turned_count - 1].skeleton_joint; }
    Vector<double> eye() const { return vector<double>(rules.eye[0], rules.eye[1], rules.eye[2]); }
    Vector<double> ahead() const { return vector<double>(rules.axis[0], rules.axis[1], rules.axis[2]); }
    // The scale of the last joint, where it is known. If joints have no scales of their own, it is the root's, which a
    // limb with a record has, unless its pose was bad.
    std::optional<double> scale() const
    {
        if (notes & kHasJointScales) return std::nullopt;
        if (!(notes & kHasRootScale)) return 1;
        for (std::uint32_t g = 0; g < crowd.group_count; ++g)
            if (crowd.groups[g].features & SWIVEL_WITH_RECORD)
                if (const double found = LimbValue(crowd.groups[g], limb, SWIVEL_RECORD)[kRecordScale]; found > 0)
                    return found;
        return std::nullopt;
    }
    // Whether the target may be nearer to the last joint than the line of sight comes. Then that joint has turned the
    // line's nearest point to the target, which so lies between the two. Holds where the scale is not known.
    bool may_be_too_near() const
    {
        const std::optional<double> unit = scale();
        if (!unit) return true;
        const double along = *unit * scalar_product(eye(), ahead()),
                     across = *unit * std::sqrt(len2(cross(eye(), ahead()))),
                     seen = 1e-3 * across + rounding() * distance();
        const Vector<double> from_nearest = to + along * axis;
        return std::fabs(scalar_product(from_nearest, axis)) <= seen && std::sqrt(len2(from_nearest)) <= across + seen;
    }
    void explain_nearness(Text& text) const
    {
        text.add(" The target is nearer to joint %u than the line of sight comes: it is %.4g from the eye.",
                 last_joint(), distance());
    }
    // Whether nearness may have faded the look. The look judged the distance before the turn, and the distance that is
    // known is the one after it. An eye ahead of its joint comes nearer to the target as the chain turns there, so a
    // target that is far by now was so before. A target that is near by now may have been far, and behind.
    bool may_have_been_near() const
    {
        if (rules.fade.distance == 0) return false;
        const std::optional<double> unit = scale();
        return !unit || flags & SWIVEL_LIMITED_STEP || scalar_product(eye(), ahead()) < 0 ||
               distance() < *unit * double{rules.fade.distance};
    }
    void explain_fade(Text& text) const
    {
        const double cos_full = double{rules.fade.cos_none} + 1 / double{rules.fade.per_cos},
                     full = in_degrees(std::acos(std::clamp(cos_full, -1.0, 1.0))),
                     none = in_degrees(std::acos(std::clamp(double{rules.fade.cos_none}, -1.0, 1.0)));
        const bool is_followed = !(flags & SWIVEL_LIMITED_STEP);
        if (is_followed && in_degrees(missed()) >= none + 0.01)
            text.add(" The target is behind, more than %.4g degrees from the incoming line, so the look has faded out.",
                     none);
        else if (may_have_been_near())
            text.add(
                " The look fades, because its target was nearer to the eye than %.3g of the last joint's unit, or "
                "behind, more than %.4g degrees from the incoming line. By now it is %.4g away.",
                double{rules.fade.distance}, full, distance());
        else
            text.add(" The target is behind, more than %.4g degrees from the incoming line, so the look fades.", full);
    }
    void explain_rate(bool is_alone, Text& text) const
    {
        text.add(" Its rate of %.4g degrees a second holds it back", in_degrees(double{rules.rate}));
        if (is_alone) text.add(" by %.3g degrees", in_degrees(missed()));
        text.add(".");
    }
    // is_whole: the last joint was to take all that was left.
    void explain_cone(bool is_whole, Text& text) const
    {
        const std::uint32_t count = joints.turned_count;
        const LookJoint& last = rules.joint[count - 1];
        const double max = in_degrees(2 * std::atan2(double{last.sin_half_max}, double{last.cos_half_max}));
        const bool is_last = count == 1 || (is_whole && !(flags & SWIVEL_LIMITED_STEP)),
                   is_near = count > 1 && is_last && may_be_too_near();
        if (is_last && !is_near)
            return text.add(" The cone of joint %u, %.4g degrees, holds it back.", last_joint(), max);
        text.add(" A cone holds a joint of the chain back.");
        if (is_near && scale())
            explain_nearness(text);
        else if (is_near)
            text.add(" The target may also be nearer to joint %u than the line of sight comes.", last_joint());
    }
};

}  // namespace

void explain_look(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text)
{
    const LookOfBody look{crowd, group, limb};
    if (look.flags & SWIVEL_BAD_INPUT || is_bad_in_body(group, limb)) return look.explain_bad(text);
    if (look.is_anew()) return text.add("It was never solved, or was reset: it begins at its next target.");
    if (look.has_changed()) text.add("Its target changed since it was solved. ");
    if (!look.has_target()) return look.explain_nothing(text);
    if (look.has_changed())
        return text.add("The line of sight is %.3g degrees off the new one.", in_degrees(look.missed()));
    look.doubt_distance(text);
    if (!(look.flags & SWIVEL_REACHED)) return look.explain_miss(text);
    text.add("The line of sight meets its target, %.4g from the eye.", look.distance());
    if (look.flags & SWIVEL_LIMITED_LOOK)
        text.add(" A cone holds a joint of the chain back, and those after it make up for that.");
}

}  // namespace swivel
