#pragma once
// SPDX-License-Identifier: MIT
// A made-up figure of which everything that tells a bend is known: it faces +z, stands along +y and has its left at +x.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tests/gltf_closure.h"
#include "tests/rig_report.h"

namespace swivel::test {

// Of left arm, right arm, left leg and right leg, in degrees as elbows and knees bend; below 0: pressed through.
using Bends = std::array<double, 4>;

// A joint halfway down the left upper arm, that turns about `axis` in the clip's second frame.
struct Between {
    std::string name;
    Eigen::Vector3d axis;
    double degrees;
};

struct Body {
    std::array<std::string, 3> arm = {"*Arm", "*ForeArm", "*Hand"}, leg = {"*UpLeg", "*Leg", "*Foot"};  // *: the side
    std::string left = "Left", right = "Right", toe = "*Toe";
    std::vector<std::size_t> limbs = {0, 1, 2, 3};                             // those that it has
    double left_at = 1;                                                        // -1: what is called left is at -x
    Eigen::Vector3d arm_bone = {0.3, 0, 0}, leg_bone = {0, -0.45, 0};          // on the left
    Bends rest = {};                                                           // in the rest pose
    std::vector<Bends> clip = {};                                              // in each frame; empty: no clip
    Bends aside = {};                                                          // by which the clip's axes are turned
                                                                               // about the upper bones from rest's
    std::optional<Eigen::Vector3d> toe_step = Eigen::Vector3d(0, -0.05, 0.1);  // from the foot, on the left
    Eigen::Vector3d scale = {1, 1, 1};                                         // of what is above the figure
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();                  // of the figure
    std::optional<Between> between = {};
    double vrm = 0;  // 0.1 or 1: the file says its limbs as VRM of that version does
};

// The nodes of a body's limbs; -1 for those that it has not.
using BodyNodes = std::array<LimbNodes, 4>;

BodyNodes add_body(GltfRig& rig, const Body& body);

GltfRig rig_of(const Body& body);

inline const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kY = Eigen::Vector3d::UnitY(),
                             kZ = Eigen::Vector3d::UnitZ();
inline constexpr std::array<const char*, 4> kLimbs = {"left_arm", "right_arm", "left_leg", "right_leg"};

}  // namespace swivel::test
