// SPDX-License-Identifier: MIT
//
// Names of the parts of an arm and of a leg in reports, messages and options.
#pragma once

#include <string>
#include <string_view>

#include "tools/formats/limb_name.h"

namespace swivel::tools {

struct LimbWords {
    std::string_view limb, limbs;
    std::string_view upper_joint, lower_joint, end_joint;  // the three joints
    std::string_view upper, lower, end;                    // the parts that these turn
    std::string_view option, joints;                       // the option for a limb, and its argument
};

inline constexpr LimbWords kArmWords = {"arm",       "arms",    "shoulder", "elbow", "wrist",
                                        "upper arm", "forearm", "hand",     "--arm", "SHOULDER,ELBOW,WRIST"};
inline constexpr LimbWords kLegWords = {"leg",   "legs", "hip",  "knee",  "ankle",
                                        "thigh", "shin", "foot", "--leg", "HIP,KNEE,ANKLE"};

constexpr const LimbWords& words_of(formats::LimbKind kind)
{
    return kind == formats::LimbKind::arm ? kArmWords : kLegWords;
}

// "left arm"
inline std::string plain_name(formats::LimbName name)
{
    return std::string(side_name(name.side)).append(" ").append(kind_name(name.kind));
}

}  // namespace swivel::tools
