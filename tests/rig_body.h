#pragma once
// SPDX-License-Identifier: MIT
// A made-up figure, and what is in doubt of its front.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/rig_report.h"

namespace swivel::test {

// A figure that faces +z and stands along +y, its limbs straight.
struct Body {
    double shoulders = 0.2, hips = 0.1;  // half the distance of each pair
    Eigen::Vector3d chest = {0, 1.5, 0}, pelvis = {0, 1, 0};
    Eigen::Vector3d left_bone = {0.3, 0, 0}, leg_bone = {0, -0.45, 0};  // of an arm, of a leg
    Eigen::Quaterniond chest_turn = Eigen::Quaterniond::Identity();     // of the shoulders about the chest
    // Joints by name, without side; x is to the side.
    std::vector<std::pair<std::string, Eigen::Vector3d>> on_foot = {};
    std::vector<std::string> limbs = {"LeftArm", "RightArm", "LeftUpLeg", "RightUpLeg"};
    bool one_trunk = true;
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  // of the whole
    Eigen::Vector3d scale = {1, 1, 1};                         // of what is above it
    double elbow = 0, knee = 0;                                // degrees at rest, as elbows and knees bend
    double right_knee = std::nan("");                          // where it is another
    Eigen::Vector3d knee_axis = {1, 0, 0};
    double clip_elbow = 0, clip_knee = 0;  // in the clip's mean, which there is where one of them is not 0
};

GltfRig rig_of(const Body& body);

// What is in doubt of the front, which then no straight limb is bound by; empty where all are bound and it is `front`.
std::string doubt_of(const Body& body, const Eigen::Vector3d& front = Eigen::Vector3d::UnitZ());

Eigen::Quaterniond turned(double degrees, const Eigen::Vector3d& axis);

inline const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kY = Eigen::Vector3d::UnitY(),
                             kZ = Eigen::Vector3d::UnitZ();
inline const std::vector<std::string> kArms = {"LeftArm", "RightArm"}, kLegs = {"LeftUpLeg", "RightUpLeg"};

}  // namespace swivel::test
