// SPDX-License-Identifier: MIT
//
// A retargeted motion judged as a stranger would: beside the source's, limb by limb. Knows clips and rigs.
#pragma once

#include <string>
#include <vector>

#include "tools/retarget/retarget.h"

namespace swivel::tools {

// A line each for people, with the frames.
struct Verdict {
    std::vector<std::string> doubts;  // single frames or limbs: the motion may still be good
    std::vector<std::string> faults;  // garbage

    bool is_good() const { return doubts.empty() && faults.empty(); }
};

// Looks at the solved clip. A fault is a bone of a limb that points over 45 degrees away from the source's, or a goal
// that is missed by half a limb, in a quarter of the frames; in fewer frames both are doubts. So are a goal that is
// missed by 0.05 limb lengths, and a knee or elbow whose fastest turn is above 720 degrees a second and above twice the
// source's.
Verdict verdict_of(const formats::Clip& source, const Retargeted& motion, const JointPairs& pairs);

}  // namespace swivel::tools
