// SPDX-License-Identifier: MIT
#include "batch/explain/bad_pose.h"

#include <cstdint>

namespace swivel {

void explain_bad_pose(const swivel_crowd& crowd, unsigned parts, const char* joints, Text& text)
{
    const std::uint32_t notes = crowd.pose_notes.load(std::memory_order_relaxed);
    if (notes & kTimeIsGood) parts &= ~unsigned{kTimeOfPose};
    if (!(notes & kHasSupport)) parts &= ~unsigned{kSupportOfPose};
    if (!(notes & kHasWeight)) parts &= ~unsigned{kWeightOfPose};
    if (parts & kTimeOfPose && notes & kTimeIsBad) parts = kTimeOfPose;
    const struct {
        PosePart part;
        const char* words;
    } names[] = {{kTimeOfPose, "its time"},
                 {kRootOfPose, "the root's place, rotation or scale"},
                 {kSupportOfPose, "its support"},
                 {kWeightOfPose, "its weight"},
                 {kJointsOfPose, joints}};
    if (parts == 0) return text.add("an input that has been written since");
    text.add("in the pose, ");
    bool is_first = true;
    for (const auto& each : names) {
        if (!(parts & each.part)) continue;
        parts &= ~unsigned{each.part};
        text.add("%s%s", is_first ? "" : parts == 0 ? ", or " : ", ", each.words);
        is_first = false;
    }
    text.add(" was not a number or out of its range, unless an input has been written since");
}

}  // namespace swivel
