// SPDX-License-Identifier: MIT
//
// Names the value of a body's pose that was bad in the last solve. Crowds keep no poses, so it goes by what is known of
// that one: a time that all bodies share, and values that it did not have. Nothing is known after a job that left out
// bodies or groups.
#pragma once

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"

namespace swivel {

// The parts of a pose.
enum PosePart : unsigned {
    kTimeOfPose = 1,
    kRootOfPose = 2,
    kSupportOfPose = 4,
    kWeightOfPose = 8,
    kJointsOfPose = 16
};

// Says which of these parts of the pose was bad, or may have been if several are left. joints: words for kJointsOfPose.
void explain_bad_pose(const swivel_crowd& crowd, unsigned parts, const char* joints, Text& text);

}  // namespace swivel
