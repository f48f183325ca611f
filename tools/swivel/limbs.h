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
    Eigen::Vector3d upper_bone = Eigen::Vector3d::Zero();  // its direction at rest, in the upper joint's frame
    Eigen::Vector3d hinge = Eigen::Vector3d::Zero();       // in the same frame
    std::string hinge_source;                              // how it was chosen, for people

    int upper() const { return joints[0]; }
    int lower() const { return joints[1]; }
    int end() const { return joints[2]; }
};

// A limb named by the user.
struct NamedLimb {
    std::string joints;  // "SHOULDER,ELBOW,WRIST" or "HIP,KNEE,ANKLE", by name or path; see LimbChoice
    std::string option;  // where it was named, for messages: "--arm"
};
// A hinge given by the user.
struct GivenHinge {
    formats::LimbName limb;
    Eigen::Vector3d axis;  // in the upper joint's frame, unit
    std::string where;     // for people
};

// Which limbs to solve. At most two of each kind are named; a leading "left:" or "right:" sets the side, else the names
// tell it, else the first is left.
struct LimbChoice {
    std::string kinds;                  // arms, legs or all; empty: those named, or the arms if none is
    std::vector<NamedLimb> arms, legs;  // of a kind without names those are taken that have names in use for it
    std::vector<GivenHinge> hinges;
};

// The limbs chosen, bound, arms first. Throws InputError naming the file and what is missing: a kind without limbs, an
// unknown or ambiguous joint, joints that are not parent and child, a bone of no length, a hinge along the
// bone, two limbs of a kind on one side, a joint in two limbs. choice: names of no kind that kinds leaves out.
std::vector<Limb> find_limbs(const formats::Clip& clip, const std::filesystem::path& file, const LimbChoice& choice);

}  // namespace swivel::tools
