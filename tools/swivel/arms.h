// SPDX-License-Identifier: MIT
//
// The arms of a clip's skeleton: found by joint names or named by the user, and bound for the solver. Knows clips and
// the public interface; no file format.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/formats/clip.h"
#include "tools/formats/side.h"

namespace swivel::tools {

struct Arm {
    formats::Side side = formats::Side::left;
    int shoulder = -1, elbow = -1, wrist = -1;  // joints of the clip, each the parent of the next
    BoundLimb limb{};
    Eigen::Vector3d hinge = Eigen::Vector3d::Zero();  // in the shoulder joint's frame
    std::string hinge_source;                         // how it was chosen, for people
};

// The clip's left and right arm, bound: those that wanted names as "SHOULDER,ELBOW,WRIST" (at most two; names or paths;
// a leading "left:" or "right:" sets the side, else the names tell it, else the first is left), or, without wanted,
// those whose names are in use for arms. Throws InputError naming the file and what is missing: no arms, an unknown or
// ambiguous joint, joints that are not parent and child, a bone of no length, two arms on one side.
std::vector<Arm> find_arms(const formats::Clip& clip, const std::filesystem::path& file,
                           std::span<const std::string> wanted);

}  // namespace swivel::tools
