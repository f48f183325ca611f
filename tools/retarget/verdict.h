// SPDX-License-Identifier: MIT
//
// Judges a retargeted motion beside the source's, limb by limb, as a viewer would. Knows clips and rigs.
#pragma once

#include <string>
#include <vector>

#include "tools/retarget/retarget.h"

namespace swivel::tools {

// The distance of a limb's end from its goal, in limb lengths.
struct GoalMiss {
    double mean = 0, max = 0;
    std::size_t max_frame = 0;
};

// Lines for people, with the frames.
struct Verdict {
    std::vector<GoalMiss> misses;     // of each of Retargeted::limbs
    std::vector<std::string> doubts;  // single frames or limbs: the motion may still be good
    std::vector<std::string> faults;  // garbage

    bool is_good() const { return doubts.empty() && faults.empty(); }
};

// Looks at the solved clip. A fault is, in a quarter of the frames,
// - a bone of a limb, or the trunk, that points over 45 degrees away from the source's;
// - a goal that is missed by half a limb.
// In fewer frames each is a doubt. Doubts are also
// - a goal that is missed by 0.05 limb lengths;
// - a hand or a foot that is deeper in the ground than the source's by 0.03 leg lengths. Hands are not judged where
//   ankles stand in place of toes;
// - a knee or elbow whose fastest turn is above 720 degrees a second and above twice the source's.
Verdict verdict_of(const formats::Clip& source, const Retargeted& motion, const JointPairs& pairs);

}  // namespace swivel::tools
