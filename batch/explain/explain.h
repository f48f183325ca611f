// SPDX-License-Identifier: MIT
//
// Explains a limb's result, in words and numbers, for people. Each part of a limb's solve has its own file. They read
// the rows of the last solve and solve single limbs only.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"
#include "include/swivel/swivel_explain.h"

namespace swivel {

class Probe;

// Adds what swivel_explain() promises. group: one of the crowd's; limb: counted within it.
void explain(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t limb, Text& text);

// explain_doubts.cpp: warnings of valid input that hardly anybody intends: another unit, another origin, a pose solved
// twice. A warning comes before the explanation of the limb.

// Lengths that differ by more than this factor, nearly 2, are suspected to be in different units.
inline constexpr double kOtherUnit = 1.9;
// Adds a warning of the crowd's last solve. Returns whether there is one.
bool doubt_solve(const swivel_crowd& crowd, Text& text);
// Adds warnings of a body's limb that has a record. solved: the limb, solved.
void doubt_limb(const Group& group, std::uint32_t limb, const Probe& solved, Text& text);

// bad_value.cpp: bad inputs that only stages of bodies read, by the bounds in the table of fields. Other fields, and
// those that the group lacks, count as good.
bool is_bad_in_body(const Group& group, std::uint32_t limb, swivel_field field);
// Whether any such input is bad.
bool is_bad_in_body(const Group& group, std::uint32_t limb);
// Names all bad inputs with their values and ranges. Returns whether there are any.
bool explain_bad_in_body(const Group& group, std::uint32_t limb, Text& text);

// Adds an input's name and its numbers, up to the closing bracket. Returns how many are not a number.
std::uint32_t add_numbers(const Group& group, std::uint32_t limb, swivel_field field, Text& text);

// The parts of a pose.
enum PosePart : unsigned {
    kTimeOfPose = 1,
    kRootOfPose = 2,
    kSupportOfPose = 4,
    kWeightOfPose = 8,
    kJointsOfPose = 16
};
// Says which of these parts of the body's pose was bad in the last solve, or may have been if several are left. Crowds
// keep no poses, so it goes by what is known of that one: a time that all bodies share, and values that it did not
// have. Nothing is known after a job that left out bodies or groups. joints: words for kJointsOfPose.
void explain_bad_pose(const swivel_crowd& crowd, unsigned parts, const char* joints, Text& text);

// explain_plant.cpp: why a planted point stands or slides. flags: of the last solve.
void explain_plant(const Group& group, std::uint32_t limb, std::uint32_t flags, Text& text);

// explain_ground.cpp: how the ground lifts the foot of a limb WITH_GROUND, and how it turns it.
void explain_ground(const Group& group, std::uint32_t limb, Text& text);

// explain_limits.cpp: what joint limits and the step did to an elbow. flags_were: of the limb's present pose. flags: of
// the probe's pose, the next solve's.
void explain_limits(Probe& probe, std::uint32_t flags_were, std::uint32_t flags, Text& text);

// explain_hold.cpp: a linked limb's hold, and a prop's place.
void explain_link(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text);
void explain_prop(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text);
// Whether the limb or prop that a limb is linked to has bad input.
bool holds_bad(const swivel_crowd& crowd, const Group& group, std::uint32_t limb);

// explain_look.cpp: whether a look meets its target.
void explain_look(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text);

// explain_shift.cpp: where a body's shift is and where it goes.
void explain_shift(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text);
// Says how far the body's shift still goes, for a limb of a group that fits and is out of reach. Says nothing where
// that is not known, or where the limb does not count for the shift.
void explain_coming_shift(const swivel_crowd& crowd, const Group& fits, std::uint32_t limb, Text& text);

}  // namespace swivel
