// SPDX-License-Identifier: MIT
//
// Finds and names bad inputs that only stages of bodies read, by the bounds in the table of fields, and the parts of a
// body's pose that were bad.
#pragma once

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// Whether an input that only stages of bodies read is bad. Other fields, and those that the group lacks, count as good.
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

}  // namespace swivel
