// SPDX-License-Identifier: MIT
//
// The pose is read as a solve reads it, and then with one mistake after the other. The mistake with which the places
// agree is the cause.
#include "batch/explain/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "batch/explain/compared_limb.h"
#include "batch/explain/explain_doubts.h"

namespace swivel {

namespace {

constexpr const char* kNames[3] = {"shoulder", "elbow", "wrist"};
constexpr const char* kForms[] = {"SWIVEL_ROTATIONS", "SWIVEL_MATRIX_ROWS", "SWIVEL_MATRIX_COLUMNS",
                                  "SWIVEL_MATRIX_COLUMNS3"};

struct Units {
    double factor;
    const char *small, *large;
};
constexpr Units kUnits[] = {{100, "centimetres", "metres"},     {1000, "millimetres", "metres"},
                            {10, "millimetres", "centimetres"}, {2.54, "centimetres", "inches"},
                            {1 / 0.0254, "inches", "metres"},   {1 / 0.3048, "feet", "metres"},
                            {30.48, "centimetres", "feet"},     {12, "inches", "feet"}};

class Comparison {
public:
    Comparison(const ComparedLimb& limb, Text& text) : limb_(limb), text_(text) {}

    // Whether they agree.
    bool run()
    {
        if (limb_.agrees(limb_.posed) && !guess_turns_in_body()) {
            if (doubt()) return false;
            const double off = limb_.worst(limb_.posed);
            text_.add(
                "The pose agrees: it has shoulder, elbow and wrist within %.2g of your places, %.2g of the limb's "
                "length.",
                off, share_of(off));
            return true;
        }
        if (cause_count_ > 0) return false;
        guess_numbers();
        guess_form();
        guess_joints();
        guess_lengths();
        guess_root();
        if (cause_count_ == 0) guess_root_numbers();
        guess_axes();
        if (cause_count_ == 0) guess_no_root();
        if (cause_count_ == 0 && !guess_strides()) describe_difference(limb_, text_);
        if (cause_count_ == 0 || !is_sure_) return false;
        if (cause_count_ == 1)
            text_.add(" With that the three places agree, within %.2g of the limb's length.", off_);
        else
            text_.add(" With each of these the three places agree.");
        return false;
    }

private:
    double share_of(double off) const { return off / std::max(length(limb_.theirs), kTiny); }
    // The text, for one more cause.
    Text& cause(const LimbPlaces& ours)
    {
        if (cause_count_++ > 0) text_.add(" Or: ");
        off_ = share_of(limb_.worst(ours));
        return text_;
    }
    bool guess(const LimbPlaces& ours, const char* sentence)
    {
        if (!limb_.agrees(ours)) return false;
        cause(ours).add("%s", sentence);
        return true;
    }
    template <class Change>
    bool guess(bool is_possible, const Change& change, const char* sentence)
    {
        Reading how = limb_.as_given;
        change(how);
        return is_possible && guess(limb_.places(limb_.joints, how), sentence);
    }
    bool has_quaternions() const { return limb_.pose.form == SWIVEL_ROTATIONS; }
    bool has_root_turn() const { return limb_.pose.root_rotation.data; }

    // Mistakes that no place shows, but that a solve would suffer from.
    bool doubt()
    {
        doubt_unit();
        doubt_time();
        doubt_bend();
        return cause_count_ > 0;
    }
    Text& doubtful()
    {
        text_.add("%s ", cause_count_++ > 0 ? "" : "The places agree, but something else is wrong.");
        return text_;
    }
    void doubt_unit()
    {
        Reading how = limb_.as_given;
        how.at_rest = true;
        const double at_rest = length(limb_.places(limb_.joints, how)), posed = length(limb_.posed);
        if (!limb_.body.has_translations(limb_.as_given)) return;
        if (at_rest <= kOtherUnit * posed && kOtherUnit * at_rest >= posed) return;
        doubtful().add(
            "The skeleton's bones are %.4g times as long as the pose's. Lengths that go with the skeleton's, such as "
            "those of swivel_plant, are wrong then. Give the skeleton in the unit of the pose.",
            at_rest / std::max(posed, kTiny));
    }
    void doubt_time()
    {
        const double time = limb_.body.time();
        if (!(time > 1)) return;
        doubtful().add(
            "The pose's time is %g, which are that many seconds since the last solve. If it is in milliseconds, divide "
            "it by 1000.",
            time);
    }
    void doubt_bend()
    {
        constexpr double kStraight = 0.94;  // the cosine of 20 degrees
        const float(&h)[3] = limb_.crowd.groups[limb_.group].limb.hinge;
        const Vector<double> upper = limb_.posed.at[1] - limb_.posed.at[0],
                             fore = limb_.posed.at[2] - limb_.posed.at[1],
                             hinge = turned(limb_.body.rotation(limb_.joints.at[0], limb_.as_given),
                                            vector<double>(h[0], h[1], h[2])),
                             turn = cross(fore, upper);
        const bool is_straight = scalar_product(upper, fore) > kStraight * std::sqrt(len2(upper) * len2(fore));
        if (is_straight || !(scalar_product(hinge, turn) < 0)) return;
        doubtful().add(
            "The elbow, joint %u, is bent by %.3g degrees to the other side than the group's `bend` or its rest pose "
            "says. A bend is the direction that flexion carries the forearm towards, in the shoulder joint's frame.",
            limb_.named(1), in_degrees(std::atan2(std::sqrt(len2(turn)), scalar_product(upper, fore))));
    }
    // Whether a quaternion has no length of about 1, as at wrong strides or offsets.
    bool guess_strides()
    {
        for (const std::uint32_t joint : limb_.joints.at)
            for (std::uint32_t at = joint; at != 0; at = limb_.body.parent(at)) {
                const double size = limb_.body.rotation_length(at);
                if (std::fabs(size - 1) <= 0.05) continue;
                text_.add(
                    "The rotation of joint %u is a quaternion of length %.3g. Rotations have length 1, so the pose is "
                    "read "
                    "at the wrong places: look at its strides and offsets.",
                    limb_.body.skeleton_joint(at), size);
                return true;
            }
        return false;
    }

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
        const bool is_local = limb_.pose.space == SWIVEL_LOCAL;
        guess(
            true, [&](Reading& how) { how.space = is_local ? SWIVEL_IN_BODY : SWIVEL_LOCAL; },
            is_local ? "The pose's joints are relative to the root, but its space is SWIVEL_LOCAL. Give SWIVEL_IN_BODY."
                     : "The pose's joints are relative to their parents, but its space is SWIVEL_IN_BODY. Give "
                       "SWIVEL_LOCAL.");
    }
    void guess_other_form(swivel_pose_form form)
    {
        if (has_quaternions() || form == limb_.pose.form) return;
        if (form == SWIVEL_MATRIX_COLUMNS && !may_be_columns()) return;
        Reading how = limb_.as_given;
        how.form = form;
        if (const LimbPlaces ours = limb_.places(limb_.joints, how); limb_.agrees(ours))
            cause(ours).add(
                "The pose's matrices are stored as %s, but its form is %s. Rows are taken for columns. Give "
                "%s.",
                kForms[form], kForms[limb_.pose.form], kForms[form]);
    }
    // A form of 12 floats says nothing of 4 more, unless no matrix of the chain can be of that form.
    bool may_be_columns() const
    {
        for (const std::uint32_t joint : limb_.joints.at)
            for (std::uint32_t at = joint; at != 0; at = limb_.body.parent(at))
                if (!limb_.body.may_be_columns(at)) return false;
        return true;
    }

    // Places of other joints: those of another limb, or one too high or too low.
    void guess_joints()
    {
        for (std::uint32_t other = 0; other < limb_.crowd.group_count; ++other) {
            if (other == limb_.group || limb_.crowd.groups[other].features & kNoLimb) continue;
            const LimbJoints joints = limb_.joints_of(other);
            const LimbPlaces ours = limb_.places(joints, limb_.as_given);
            if (!limb_.agrees(ours)) continue;
            cause(ours).add("Your places are those of group %u's limb, joints ", other);
            add_joints(joints);
            text_.add(", but group %u has joints ", limb_.group);
            add_joints(limb_.joints);
            text_.add(
                ". Left and right may be exchanged. Name the other joints in the group, or give this limb's "
                "places.");
            return;
        }
        guess_neighbours();
    }
    void add_joints(const LimbJoints& joints)
    {
        text_.add("%u, %u and %u", limb_.body.skeleton_joint(joints.at[0]), limb_.body.skeleton_joint(joints.at[1]),
                  limb_.body.skeleton_joint(joints.at[2]));
    }
    bool is_at(int part, std::uint32_t joint, double max) const
    {
        return distance(limb_.body.place(joint, limb_.as_given), limb_.theirs.at[part]) <= max;
    }
    // The needed joint that lies at one of the places, the nearest along the chain if several do; 0: none.
    std::uint32_t joint_at_place(int part, double max) const
    {
        std::uint32_t found = 0, min = std::numeric_limits<std::uint32_t>::max();
        for (std::uint32_t joint = 1; joint < limb_.crowd.joint_count; ++joint) {
            if (!is_at(part, joint, max)) continue;
            const std::uint32_t own = limb_.joints.at[part],
                                steps = std::max(limb_.body.steps_up(own, joint), limb_.body.steps_up(joint, own));
            const std::uint32_t far = joint == own ? 0 : steps > 0 ? steps : limb_.crowd.joint_count;
            if (far < min) min = far, found = joint;
        }
        return found;
    }
    void guess_neighbours()
    {
        LimbJoints found;
        for (int part = 0; part < 3; ++part)
            if ((found.at[part] = joint_at_place(part, limb_.allowed(limb_.posed))) == 0) {
                if (part == 2) guess_all_high(found);
                return;
            }
        const LimbPlaces ours = limb_.places(found, limb_.as_given);
        if (!limb_.agrees(ours)) return;
        cause(ours);
        bool is_first = true;
        for (int part = 0; part < 3; ++part) {
            if (found.at[part] == limb_.joints.at[part]) continue;
            const std::uint32_t up = limb_.body.steps_up(limb_.joints.at[part], found.at[part]),
                                down = limb_.body.steps_up(found.at[part], limb_.joints.at[part]);
            text_.add("%s%s", is_first ? "Your place of the " : ", and that of the ", kNames[part]);
            text_.add(" is joint %u's", limb_.body.skeleton_joint(found.at[part]));
            if (up + down > 0) text_.add(", %u %s", up + down, up > 0 ? "too high" : "too low");
            text_.add("; the group has joint %u", limb_.named(part));
            is_first = false;
        }
        text_.add(". Give the places of the group's joints, or name the others in the group.");
    }

    // A clavicle for a shoulder, a shoulder for an elbow, and an elbow for a wrist: then no group needs the hand.
    void guess_all_high(const LimbJoints& found)
    {
        for (int part = 0; part < 2; ++part)
            if (limb_.body.steps_up(found.at[part], limb_.joints.at[part]) == 0) return;
        ++cause_count_, is_sure_ = false;
        text_.add("Your shoulder and elbow are joints %u and %u, but the group has joints ",
                  limb_.body.skeleton_joint(found.at[0]), limb_.body.skeleton_joint(found.at[1]));
        add_joints(limb_.joints);
        text_.add(
            ": all three are too high, such as a clavicle for the shoulder. Name joints %u and %u as shoulder and "
            "elbow "
            "in the group, and the hand below them as the wrist.",
            limb_.body.skeleton_joint(found.at[0]), limb_.body.skeleton_joint(found.at[1]));
    }

    // Lengths in other units, and translations or scales that do not count.
    void guess_lengths()
    {
        const Vector<double> root = limb_.body.root_place(), none = vector(0.0, 0.0, 0.0);
        if (guess(
                limb_.pose.root_scale.data, [](Reading& how) { how.root_scale = 0; },
                "Your places are without root_scale. Leave it out of the pose, or scale the character that you look "
                "at."))
            return;
        guess(
            limb_.pose.root_scale.data, [](Reading& how) { how.root_scale = 2; },
            "Your places have root_scale twice: in its joints and at its root. Leave it out of one.");
        guess(
            limb_.pose.translations.data, [](Reading& how) { how.at_rest = true; },
            "Your places are those of bones as the skeleton rests, but the pose has other translations. Leave these "
            "out, or look at what changes them.");
        guess(
            limb_.pose.scales.data, [](Reading& how) { how.unscaled = true; },
            "Your places are those of joints without the pose's scales. Leave these out, or scale the character that "
            "you look at.");
        const bool is_found = guess_units(none, "the pose", "Give both in one unit.");
        const bool is_away = len2(root) > 0;
        if (!is_found && is_away)
            guess_units(root, limb_.body.has_translations(limb_.as_given) ? "the pose's translations" : "the skeleton",
                        "Give lengths in the unit of root_position, or give root_scale.");
        if (!is_found && is_away) guess_root_units(root);
    }
    static const Units* units_of(double factor, bool& is_larger)
    {
        for (const Units& units : kUnits)
            for (const bool larger : {true, false}) {
                const double wanted = larger ? units.factor : 1 / units.factor;
                if (std::fabs(factor - wanted) > 4e-3 * wanted) continue;
                is_larger = larger;
                return &units;
            }
        return nullptr;
    }
    // Whether the places are those of the pose with all lengths from a centre in another unit.
    bool guess_units(const Vector<double>& centre, const char* what, const char* advice)
    {
        const double factor = limb_.factor_about(centre);
        bool is_larger;
        const Units* const units = units_of(factor, is_larger);
        if (!units) return false;
        const LimbPlaces ours = scaled_about(centre, factor, limb_.posed);
        if (!limb_.agrees(ours)) return false;
        add_units(cause(ours), *units, is_larger, "Your places", what, advice);
        return true;
    }
    void guess_root_units(const Vector<double>& root)
    {
        const double factor = scalar_product(limb_.theirs.at[0] - (limb_.posed.at[0] - root), root) / len2(root);
        bool is_larger;
        const Units* const units = units_of(factor, is_larger);
        if (!units) return;
        const LimbPlaces ours = moved(limb_.posed, [&](const Vector<double>& v) { return v + (factor - 1) * root; });
        if (limb_.agrees(ours))
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

    // A root in floats that is read as doubles, or the other way round.
    void guess_root_numbers()
    {
        const swivel_pose& pose = limb_.pose;
        if (!pose.root_position.data || !(pose.root_is_double || limb_.body.may_have_double_root())) return;
        Reading how = limb_.as_given;
        how.root_in_other_numbers = true;
        const LimbPlaces ours = limb_.places(limb_.joints, how);
        if (!(limb_.worst(ours) <= limb_.allowed(ours) + (pose.root_is_double ? limb_.rounding() : 0))) return;
        cause(ours).add(
            "%s",
            pose.root_is_double
                ? "The pose's root_position is in floats, but root_is_double says doubles. Set root_is_double to 0."
                : "The pose's root_position is in doubles, but it is read as floats. Set root_is_double to 1.");
    }
    // A root that was not given.
    void guess_no_root()
    {
        const swivel_pose& pose = limb_.pose;
        const bool has_place = pose.root_position.data, has_turn = pose.root_rotation.data;
        if ((has_place && has_turn) || !has_same_shape(limb_)) return;
        const Vector<double> way = limb_.theirs.at[0] - limb_.posed.at[0], root = limb_.body.root_place();
        if (!has_place && limb_.agrees(moved(limb_.posed, [&](const Vector<double>& v) { return v + way; })))
            return add_no_root("elsewhere, and the pose gives no root_position. Give it");
        bool is_about_root = true;
        for (int n = 0; n < 3; ++n)
            is_about_root &= std::fabs(distance(limb_.theirs.at[n], root) - distance(limb_.posed.at[n], root)) <=
                             limb_.allowed(limb_.posed);
        if (!has_turn && is_about_root)
            return add_no_root("turned about the root, and the pose gives no root_rotation. Give it");
        if (!has_turn && !has_place)
            add_no_root("elsewhere and turned, and the pose gives neither root_position nor root_rotation. Give them");
    }
    void add_no_root(const char* how)
    {
        ++cause_count_, is_sure_ = false;
        text_.add("Your limb has the shape that the pose gives it. It is %s.", how);
    }

    // A root that does not count, or counts twice.
    void guess_root()
    {
        const bool has_place = limb_.pose.root_position.data, has_scale = limb_.pose.root_scale.data;
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
            int from[3], sign[3];
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
                return vector(axes.sign[0] * v.c[axes.from[0]], axes.sign[1] * v.c[axes.from[1]],
                              axes.sign[2] * v.c[axes.from[2]]);
            };
            if (guess(moved(limb_.posed, turn), axes.sentence)) return;
        }
    }

    // In the body's space places say nothing of rotations. But if bones are as long as at rest, these have to carry
    // them there.
    bool guess_turns_in_body()
    {
        Reading how = limb_.as_given;
        how.at_rest = true;
        if (limb_.pose.space != SWIVEL_IN_BODY || (has_quaternions() && !limb_.pose.translations.data) || carries(how))
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
        const LimbPlaces ours = limb_.places(limb_.joints, how);
        const Vector<double> shift = limb_.theirs.at[0] - ours.at[0];
        return limb_.agrees(moved(ours, [&](const Vector<double>& v) { return v + shift; }));
    }

    const ComparedLimb& limb_;
    Text& text_;
    unsigned cause_count_ = 0;
    bool is_sure_ = true;  // that with the cause the places agree
    double off_ = 0;       // how far the places are off with the cause, in limb lengths
};

}  // namespace

bool compare(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t body, const swivel_pose& pose,
             const LimbPlaces& places, std::span<char> room)
{
    Text text(room);
    const ComparedLimb limb{crowd, group, pose, places, {crowd, pose, body}};
    return Comparison(limb, text).run();
}

}  // namespace swivel
