// SPDX-License-Identifier: MIT
//
// The limbs of a clip's skeleton: found by joint names or named by the user, and bound for the solver. Knows clips and
// the public interface; no file format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/formats/clip.h"
#include "tools/swivel/limb_joints.h"

namespace swivel::tools {

struct Limb {
    formats::LimbName name;
    LimbJoints joints{-1, -1, -1};  // shoulder, elbow and wrist, or hip, knee and ankle
    BoundLimb bound{};
    Eigen::Vector3d hinge = Eigen::Vector3d::Zero();  // in the upper joint's frame
    std::string hinge_source;                         // how it was chosen, for people

    int upper() const { return joints[0]; }
    int lower() const { return joints[1]; }
    int end() const { return joints[2]; }
};

// Which limbs to solve. Names are "SHOULDER,ELBOW,WRIST" or "HIP,KNEE,ANKLE", joints by name or path, at most two of
// each kind; a leading "left:" or "right:" sets the side, else the names tell it, else the first is left.
struct LimbChoice {
    std::string kinds;                    // arms, legs or all; empty: those named, or the arms if none is
    std::vector<std::string> arms, legs;  // of a kind without names those are taken that have names in use for it
};

// The limbs chosen, bound, arms first. Throws InputError naming the file and what is missing: a kind without limbs, an
// unknown or ambiguous joint, joints that are not parent and child, a bone of no length, two limbs of a kind on one
// side, a joint in two limbs. choice: names of no kind that kinds leaves out.
std::vector<Limb> find_limbs(const formats::Clip& clip, const std::filesystem::path& file, const LimbChoice& choice);

}  // namespace swivel::tools
