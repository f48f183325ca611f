// SPDX-License-Identifier: MIT
//
// The limbs and parts of the demo's figure, by the names of its joints.
#pragma once

#include <vector>

#include "tools/retarget/joint_pairs.h"

namespace swivel::test {

inline tools::KnownLimbs limbs_of_demo(const formats::Clip& clip)
{
    const auto joint = [&](const char* name) { return formats::find_joints(clip, name).at(0); };
    return {tools::LimbJoints{joint("LeftArm"), joint("LeftForeArm"), joint("LeftHand")},
            tools::LimbJoints{joint("RightArm"), joint("RightForeArm"), joint("RightHand")},
            tools::LimbJoints{joint("LeftUpLeg"), joint("LeftLeg"), joint("LeftFoot")},
            tools::LimbJoints{joint("RightUpLeg"), joint("RightLeg"), joint("RightFoot")}};
}

inline std::vector<tools::BodyPart> parts_of_demo(const formats::Clip& clip)
{
    return tools::body_parts(clip, limbs_of_demo(clip));
}

inline tools::JointPairs demo_pairs(const formats::Clip& source, const formats::Clip& target)
{
    return tools::pair_joints({source, parts_of_demo(source)}, {target, parts_of_demo(target)});
}

}  // namespace swivel::test
