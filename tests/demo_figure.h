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

// The motion below a joint that mirrors x.
inline formats::Clip in_mirror(const formats::Clip& clip)
{
    formats::Clip mirrored = clip;
    formats::Joint armature;
    armature.name = "Armature";
    armature.rest_scale = {-1, 1, 1};
    for (formats::Joint& joint : mirrored.joints) ++joint.parent;
    mirrored.joints.insert(mirrored.joints.begin(), armature);
    mirrored.rotation.clear();
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        mirrored.rotation.push_back(Eigen::Quaterniond::Identity());
        for (std::size_t n = 0; n < clip.joints.size(); ++n)
            mirrored.rotation.push_back(clip.rotation[frame * clip.joints.size() + n]);
    }
    return mirrored;
}

}  // namespace swivel::test
