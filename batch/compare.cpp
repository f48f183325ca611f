// SPDX-License-Identifier: MIT
//
// The pose is read as a solve reads it, and then with one mistake after the other. The mistake with which the places
// agree is the cause. A mistake that another one explains better is not tried after it.
#include "batch/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "batch/explain_text.h"
#include "batch/posed_body.h"

namespace swivel {

namespace {

constexpr const char* kNames[3] = {"shoulder", "elbow", "wrist"};
constexpr const char* kForms[] = {"SWIVEL_ROTATIONS", "SWIVEL_MATRIX_ROWS", "SWIVEL_MATRIX_COLUMNS",
                                  "SWIVEL_MATRIX_COLUMNS3"};
constexpr double kShare = 1e-3;  // of the limb's length: as swivel.h says

struct Units {
    double factor;
    const char *small, *large;
};
constexpr Units kUnits[] = {{100, "centimetres", "metres"},     {1000, "millimetres", "metres"},
                            {10, "millimetres", "centimetres"}, {2.54, "centimetres", "inches"},
                            {1 / 0.0254, "inches", "metres"},   {1 / 0.3048, "feet", "metres"},
                            {30.48, "centimetres", "feet"},     {12, "inches", "feet"}};

double distance(const Vector<double>& a, const Vector<double>& b) { return std::sqrt(len2(a - b)); }
double length(const LimbPlaces& limb) { return distance(limb.at[0], limb.at[1]) + distance(limb.at[1], limb.at[2]); }
template <class Move>
LimbPlaces moved(const LimbPlaces& limb, const Move& move)
{
    return {{move(limb.at[0]), move(limb.at[1]), move(limb.at[2])}};
}
LimbPlaces scaled_about(const Vector<double>& centre, double factor, const LimbPlaces& limb)
{
    return moved(limb, [&](const Vector<double>& v) { return centre + factor * (v - centre); });
}

class Comparison {
public:
    Comparison(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t body, const swivel_pose& pose,
               const LimbPlaces& theirs, Text& text)
        : crowd_(crowd), group_(group), pose_(pose), body_(crowd, pose, body), theirs_(theirs), text_(text)
    {
        joints_of(group, joints_);
        posed_ = places(joints_, as_given_);
    }

    bool run()
    {
        if (agrees(posed_) && !guess_turns_in_body()) {
            const double off = worst(posed_);
            text_.add(
                "The pose agrees: it has shoulder, elbow and wrist within %.2g of your places, %.2g of the limb's "
                "length.",
                off, off / length(theirs_));
            return true;
        }
        if (cause_count_ > 0) return false;
        guess_numbers();
        guess_form();
        guess_joints();
        guess_lengths();
        guess_root();
        guess_axes();
        if (cause_count_ == 0) return describe(), false;
        if (cause_count_ == 1)
            text_.add(" With that the three places agree, within %.2g of the limb's length.", best_);
        else
            text_.add(" With each of these the three places agree.");
        return false;
    }

private:
    using Joints = std::uint32_t[3];

    void joints_of(std::uint32_t group, Joints& joints) const
    {
        const BodyLimb& limb = crowd_.groups[group].limb;
        joints[0] = body_.joint_at(limb.shoulder);
        joints[1] = body_.joint_at(limb.elbow);
        joints[2] = body_.joint_at(limb.wrist);
    }
    LimbPlaces places(const Joints& joints, const Reading& how) const
    {
        return {{body_.place(joints[0], how), body_.place(joints[1], how), body_.place(joints[2], how)}};
    }

    double worst(const LimbPlaces& ours) const
    {
        double most = 0;
        for (int n = 0; n < 3; ++n) {
            const double off = distance(ours.at[n], theirs_.at[n]);
            if (!(off <= most)) most = off;  // NaN stays
            if (std::isnan(most)) break;
        }
        return most;
    }
    // How far a place may be off. Floats in the world are rounded, by engines too.
    double allowed(const LimbPlaces& ours) const
    {
        double size2 = 0;
        for (const Vector<double>& v : theirs_.at) size2 = std::max(size2, len2(v));
        const double rounding = pose_.root_is_double ? 0 : 2e-7 * std::sqrt(size2);
        return kShare * std::max(length(ours), length(theirs_)) + rounding;
    }
    bool agrees(const LimbPlaces& ours) const { return worst(ours) <= allowed(ours); }

    // The text, for one more cause.
    Text& cause(const LimbPlaces& ours)
    {
        if (cause_count_++ > 0) text_.add(" Or: ");
        best_ = worst(ours) / length(theirs_);
        return text_;
    }
    bool guess(const LimbPlaces& ours, const char* sentence)
    {
        if (!agrees(ours)) return false;
        cause(ours).add("%s", sentence);
        return true;
    }
    template <class Change>
    bool guess(bool is_possible, const Change& change, const char* sentence)
    {
        Reading how = as_given_;
        change(how);
        return is_possible && guess(places(joints_, how), sentence);
    }
    bool has_quaternions() const { return pose_.form == SWIVEL_ROTATIONS; }
    bool has_root_turn() const { return pose_.root_rotation.data; }

    // Quaternions in another order or the other way round, of joints, the root, or both.
    void guess_numbers()
    {
        bool is_found = guess(
            has_quaternions(), [](Reading& how) { how.joints_w_first = true; },
            "The pose's joint rotations are stored as w, x, y, z, but swivel takes x, y, z, w. Reorder them.");
        is_found |= guess(
            has_root_turn(), [](Reading& how) { how.root_w_first = true; },
            "The pose's root_rotation is stored as w, x, y, z, but swivel takes x, y, z, w. Reorder it.");
        guess(
            has_quaternions() && has_root_turn() && !is_found,
            [](Reading& how) { how.joints_w_first = how.root_w_first = true; },
            "The pose's rotations, root_rotation among them, are stored as w, x, y, z, but swivel takes x, y, z, w. "
            "Reorder them.");
        is_found = guess(
            has_quaternions(), [](Reading& how) { how.joints_inverse = true; },
            "The pose's joint rotations are the inverse ones: conjugates. Negate x, y and z of each.");
        is_found |= guess(
            has_root_turn(), [](Reading& how) { how.root_inverse = true; },
            "The pose's root_rotation is the inverse one: a conjugate. Negate its x, y and z.");
        guess(
            has_quaternions() && has_root_turn() && !is_found,
            [](Reading& how) { how.joints_inverse = how.root_inverse = true; },
            "The pose's rotations, root_rotation among them, are the inverse ones: conjugates. Negate x, y and z of "
            "each.");
    }
    // Rows for columns, and local for in the body's space.
    void guess_form()
    {
        guess(
            !has_quaternions(), [](Reading& how) { how.joints_inverse = true; },
            "The 3 x 3 part of the pose's matrices is transposed, so rows are where columns must be. Transpose it, but "
            "leave the translation.");
        for (const swivel_pose_form form : {SWIVEL_MATRIX_ROWS, SWIVEL_MATRIX_COLUMNS, SWIVEL_MATRIX_COLUMNS3})
            guess_other_form(form);
        const bool is_local = pose_.space == SWIVEL_LOCAL;
        guess(
            true, [&](Reading& how) { how.space = is_local ? SWIVEL_IN_BODY : SWIVEL_LOCAL; },
            is_local ? "The pose's joints are relative to the root, but its space is SWIVEL_LOCAL. Give SWIVEL_IN_BODY."
                     : "The pose's joints are relative to their parents, but its space is SWIVEL_IN_BODY. Give "
                       "SWIVEL_LOCAL.");
    }
    void guess_other_form(swivel_pose_form form)
    {
        if (has_quaternions() || form == pose_.form) return;
        if (form == SWIVEL_MATRIX_COLUMNS && !may_be_columns()) return;
        Reading how = as_given_;
        how.form = form;
        if (const LimbPlaces ours = places(joints_, how); agrees(ours))
            cause(ours).add(
                "The pose's matrices are stored as %s, but its form is %s. Rows are taken for columns. Give "
                "%s.",
                kForms[form], kForms[pose_.form], kForms[form]);
    }
    // A form of 12 floats says nothing of 4 more, unless no matrix of the chain can be of that form.
    bool may_be_columns() const
    {
        for (const std::uint32_t joint : joints_)
            for (std::uint32_t at = joint; at != 0; at = body_.parent(at))
                if (!body_.may_be_columns(at)) return false;
        return true;
    }

    // Places of other joints: those of another limb, or one too high or too low.
    void guess_joints()
    {
        for (std::uint32_t other = 0; other < crowd_.group_count; ++other) {
            if (other == group_ || crowd_.groups[other].features & kNoLimb) continue;
            Joints joints;
            joints_of(other, joints);
            const LimbPlaces ours = places(joints, as_given_);
            if (!agrees(ours)) continue;
            cause(ours).add("Your places are those of group %u's limb, joints ", other);
            add_joints(joints);
            text_.add(", but group %u has joints ", group_);
            add_joints(joints_);
            text_.add(
                ". Left and right may be exchanged. Name the other joints in the group, or give this limb's "
                "places.");
            return;
        }
        guess_neighbours();
    }
    void add_joints(const Joints& joints)
    {
        text_.add("%u, %u and %u", body_.skeleton_joint(joints[0]), body_.skeleton_joint(joints[1]),
                  body_.skeleton_joint(joints[2]));
    }
    bool is_at(int part, std::uint32_t joint, double most) const
    {
        return distance(body_.place(joint, as_given_), theirs_.at[part]) <= most;
    }
    // The needed joint that lies at one of the places, the nearest along the chain if several do; 0: none.
    std::uint32_t joint_at_place(int part, double most) const
    {
        std::uint32_t found = 0, least = std::numeric_limits<std::uint32_t>::max();
        for (std::uint32_t joint = 1; joint < crowd_.joint_count; ++joint) {
            if (!is_at(part, joint, most)) continue;
            const std::uint32_t own = joints_[part],
                                steps = std::max(body_.steps_up(own, joint), body_.steps_up(joint, own));
            const std::uint32_t far = joint == own ? 0 : steps > 0 ? steps : crowd_.joint_count;
            if (far < least) least = far, found = joint;
        }
        return found;
    }
    void guess_neighbours()
    {
        Joints found;
        for (int part = 0; part < 3; ++part)
            if ((found[part] = joint_at_place(part, allowed(posed_))) == 0) return;
        const LimbPlaces ours = places(found, as_given_);
        if (!agrees(ours)) return;
        cause(ours);
        bool is_first = true;
        for (int part = 0; part < 3; ++part) {
            if (found[part] == joints_[part]) continue;
            const std::uint32_t up = body_.steps_up(joints_[part], found[part]),
                                down = body_.steps_up(found[part], joints_[part]);
            text_.add("%s%s", is_first ? "Your place of the " : ", and that of the ", kNames[part]);
            text_.add(" is joint %u's", body_.skeleton_joint(found[part]));
            if (up + down > 0) text_.add(", %u %s", up + down, up > 0 ? "too high" : "too low");
            text_.add("; the group has joint %u", body_.skeleton_joint(joints_[part]));
            is_first = false;
        }
        text_.add(". Give the places of the group's joints, or name the others in the group.");
    }

    // Lengths in other units, and translations or scales that do not count.
    void guess_lengths()
    {
        const Vector<double> root = body_.root_place(), none = vector(0.0, 0.0, 0.0);
        if (guess(
                pose_.root_scale.data, [](Reading& how) { how.root_scale = 0; },
                "Your places are without root_scale. Leave it out of the pose, or scale the character that you look "
                "at."))
            return;
        guess(
            pose_.root_scale.data, [](Reading& how) { how.root_scale = 2; },
            "Your places have root_scale twice: in its joints and at its root. Leave it out of one.");
        guess(
            pose_.translations.data, [](Reading& how) { how.at_rest = true; },
            "Your places are those of bones as the skeleton rests, but the pose has other translations. Leave these "
            "out, or look at what changes them.");
        guess(
            pose_.scales.data, [](Reading& how) { how.unscaled = true; },
            "Your places are those of joints without the pose's scales. Leave these out, or scale the character that "
            "you look at.");
        const bool is_found = guess_units(none, "the pose", "Give both in one unit.");
        const bool is_away = len2(root) > 0;
        if (!is_found && is_away)
            guess_units(root, "the pose's translations",
                        "Give these in the unit of root_position, or give root_scale.");
        if (!is_found && is_away) guess_root_units(root);
    }
    static const Units* units_of(double factor, bool& is_larger)
    {
        for (const Units& units : kUnits)
            for (const bool larger : {true, false}) {
                const double wanted = larger ? units.factor : 1 / units.factor;
                if (std::fabs(factor - wanted) > 4 * kShare * wanted) continue;
                is_larger = larger;
                return &units;
            }
        return nullptr;
    }
    // Whether the places are those of the pose with all lengths from a centre in another unit.
    bool guess_units(const Vector<double>& centre, const char* what, const char* advice)
    {
        const double factor = factor_about(centre);
        bool is_larger;
        const Units* const units = units_of(factor, is_larger);
        if (!units) return false;
        const LimbPlaces ours = scaled_about(centre, factor, posed_);
        if (!agrees(ours)) return false;
        add_units(cause(ours), *units, is_larger, "Your places", what, advice);
        return true;
    }
    // By how much the places are larger than the pose's, by least squares.
    double factor_about(const Vector<double>& centre) const
    {
        double across = 0, size = 0;
        for (int n = 0; n < 3; ++n) {
            const Vector<double> posed = posed_.at[n] - centre;
            across += scalar_product(theirs_.at[n] - centre, posed);
            size += len2(posed);
        }
        return across / size;
    }
    void guess_root_units(const Vector<double>& root)
    {
        const double factor = scalar_product(theirs_.at[0] - (posed_.at[0] - root), root) / len2(root);
        bool is_larger;
        const Units* const units = units_of(factor, is_larger);
        if (!units) return;
        const LimbPlaces ours = moved(posed_, [&](const Vector<double>& v) { return v + (factor - 1) * root; });
        if (agrees(ours))
            add_units(cause(ours), *units, is_larger, "Your places and the pose's joints", "root_position",
                      "Give it in the same unit.");
    }
    static void add_units(Text& text, const Units& units, bool is_larger, const char* these, const char* those,
                          const char* advice)
    {
        text.add("%s are in another unit than %s, such as %s instead of %s: the factor is %s%g. %s", these, those,
                 is_larger ? units.small : units.large, is_larger ? units.large : units.small, is_larger ? "" : "1 / ",
                 units.factor, advice);
    }

    // A root that does not count, or counts twice.
    void guess_root()
    {
        const bool has_place = pose_.root_position.data, has_scale = pose_.root_scale.data;
        bool is_found = guess(
            has_place, [](Reading& how) { how.root_place = 0; },
            "Your places are without root_position: they are from the root, or the pose's joints have it, too. Give "
            "places in the world, and the root once.");
        is_found |= guess(
            has_place, [](Reading& how) { how.root_place = 2; },
            "Your places have root_position twice. Give places in the world, and the root once.");
        if (has_root_turn() && cause_count_ == 0) {
            is_found |= guess(
                true, [](Reading& how) { how.root_turn = 0; },
                "Your places are without root_rotation: the pose's joints have it, too, or the character that you "
                "look at is not turned. Give it once.");
            is_found |= guess(
                true, [](Reading& how) { how.root_turn = 2; },
                "Your places have root_rotation twice: in the joints and at the root. Give it once.");
        }
        guess(
            !is_found && (has_place + has_root_turn() + has_scale > 1),
            [](Reading& how) { how.root_place = how.root_turn = how.root_scale = 0; },
            "Your places are in the root's frame, not in the world. Give them in the world, or leave the root out of "
            "the pose.");
    }

    // Another handedness, or another axis that points up.
    void guess_axes()
    {
        struct Axes {
            int of[3], sign[3];
            const char* sentence;
        };
        constexpr const char* left =
            "The places are mirrored: one side of the two is left-handed. Give both in right-handed axes.";
        constexpr const char* up =
            "The places have y and z exchanged: one side has y up, the other z. Give both in the same axes.";
        constexpr Axes all[] = {{{0, 1, 2}, {-1, 1, 1}, left}, {{0, 1, 2}, {1, -1, 1}, left},
                                {{0, 1, 2}, {1, 1, -1}, left}, {{0, 2, 1}, {1, 1, 1}, up},
                                {{0, 2, 1}, {1, -1, 1}, up},   {{0, 2, 1}, {1, 1, -1}, up}};
        for (const Axes& axes : all) {
            const auto turn = [&](const Vector<double>& v) {
                return vector(axes.sign[0] * v.c[axes.of[0]], axes.sign[1] * v.c[axes.of[1]],
                              axes.sign[2] * v.c[axes.of[2]]);
            };
            if (guess(moved(posed_, turn), axes.sentence)) return;
        }
    }

    // In the body's space places say nothing of rotations. But if bones are as long as at rest, these have to carry
    // them there.
    bool guess_turns_in_body()
    {
        Reading how = as_given_;
        how.at_rest = true;
        if (pose_.space != SWIVEL_IN_BODY || (has_quaternions() && !pose_.translations.data) || carries(how))
            return false;
        const auto add = [&](const char* sentence) {
            ++cause_count_;
            text_.add("The places agree, but the bones do not lie along them as the joints are turned. %s", sentence);
        };
        how.joints_inverse = true;
        if (carries(how))
            add(has_quaternions()
                    ? "The pose's joint rotations are the inverse ones: conjugates. Negate x, y and z of each."
                    : "The 3 x 3 part of the pose's matrices is transposed, so rows are where columns must be. "
                      "Transpose "
                      "it, but leave the translation.");
        how.joints_inverse = false, how.joints_w_first = true;
        if (cause_count_ == 0 && has_quaternions() && carries(how))
            add("The pose's joint rotations are stored as w, x, y, z, but swivel takes x, y, z, w. Reorder them.");
        return cause_count_ > 0;
    }
    bool carries(const Reading& how) const
    {
        const LimbPlaces ours = places(joints_, how);
        const Vector<double> shift = theirs_.at[0] - ours.at[0];
        return agrees(moved(ours, [&](const Vector<double>& v) { return v + shift; }));
    }

    // No cause is known: where it begins.
    void describe()
    {
        int part = 0;
        while (part < 2 && distance(posed_.at[part], theirs_.at[part]) <= allowed(posed_)) ++part;
        const std::uint32_t joint = body_.skeleton_joint(joints_[part]);
        const Vector<double> way = theirs_.at[part] - posed_.at[part];
        const double off = std::sqrt(len2(way));
        if (!(off <= std::numeric_limits<double>::max()))
            return text_.add(
                "The pose has no place of the %s, joint %u: a number of it, of a joint above or of the "
                "root is not finite or out of its range. Look at those rotations, translations and scales.",
                kNames[part], joint);
        text_.add(
            "No usual mistake explains it. The first joint that is off is the %s, joint %u: your place is %.4g "
            "from the pose's, in the direction %.3g, %.3g, %.3g of the world. ",
            kNames[part], joint, off, way.c[0] / off, way.c[1] / off, way.c[2] / off);
        if (part == 0) return describe_shoulder();
        const double theirs = distance(theirs_.at[part], theirs_.at[part - 1]),
                     ours = distance(posed_.at[part], posed_.at[part - 1]);
        const char* const bone = part == 1 ? "upper arm" : "forearm";
        if (std::fabs(theirs - ours) > allowed(posed_))
            text_.add(
                "Your %s is %.4g long, the pose's %.4g. Look at the translations and scales between joints %u "
                "and %u; without translations bones are as the skeleton rests.",
                bone, theirs, ours, body_.skeleton_joint(joints_[part - 1]), joint);
        else
            text_.add(
                "The %s is as long as yours, %.4g. Look at the rotations of joint %u and of those between it and "
                "joint %u.",
                bone, theirs, body_.skeleton_joint(joints_[part - 1]), joint);
    }
    void describe_shoulder()
    {
        const Vector<double> way = theirs_.at[0] - posed_.at[0];
        if (agrees(moved(posed_, [&](const Vector<double>& v) { return v + way; })))
            return text_.add("So are the others. Look at root_position, and at the translations above the shoulder.");
        const double factor = factor_about(body_.root_place());
        if (agrees(scaled_about(body_.root_place(), factor, posed_)))
            return text_.add(
                "The places are %.4g times as far from the root as the pose's. Look at root_scale and at "
                "scales above the shoulder.",
                factor);
        text_.add("%s Look at the root, and at the joints above the shoulder.",
                  has_same_shape() ? "The limb's own shape is right, so it is turned as a whole."
                                   : "The limb's own shape is another, too.");
    }
    bool has_same_shape() const
    {
        for (int n = 0; n < 3; ++n) {
            const double theirs = distance(theirs_.at[n], theirs_.at[(n + 1) % 3]),
                         ours = distance(posed_.at[n], posed_.at[(n + 1) % 3]);
            if (!(std::fabs(theirs - ours) <= allowed(posed_))) return false;
        }
        return true;
    }

    const swivel_crowd& crowd_;
    const std::uint32_t group_;
    const swivel_pose& pose_;
    const PosedBody body_;
    const LimbPlaces& theirs_;
    Text& text_;
    const Reading as_given_{pose_};
    Joints joints_;
    LimbPlaces posed_;  // as a solve reads the pose
    unsigned cause_count_ = 0;
    double best_ = 0;  // how far the places are off with the cause, in limb lengths
};

}  // namespace

bool compare(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t body, const swivel_pose& pose,
             const LimbPlaces& places, std::span<char> room)
{
    Text text(room);
    return Comparison(crowd, group, body, pose, places, text).run();
}

}  // namespace swivel
