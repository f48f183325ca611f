#pragma once
// SPDX-License-Identifier: MIT
// Figures as glTF files, of which everything that matters to a solver is known: as a test tells them, or at random.
// They face +z, stand along +y and have their left at +x, before nodes above scale, mirror and turn them. And what
// `swivel rig` reports of them.

#include <nlohmann/json.hpp>

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tests/gltf_rig.h"
#include "tests/plain_gltf.h"
#include "tests/run_command.h"

namespace swivel::test {

inline constexpr double kDegree = std::numbers::pi / 180;

// Of left arm, right arm, left leg and right leg, in degrees as elbows and knees bend; below 0: pressed through.
using Bends = std::array<double, 4>;

// A joint halfway down the left upper arm, that turns about `axis` in the clip's second frame.
struct Between {
    std::string name;
    Eigen::Vector3d axis;
    double degrees;
};

struct Body {
    std::string toe = "Toe";                                           // after the side, which is called Left or Right
    std::vector<std::size_t> limbs = {0, 1, 2, 3};                     // those that it has
    double left_at = 1;                                                // -1: what is called left is at -x
    Eigen::Vector3d arm_bone = {0.3, 0, 0}, leg_bone = {0, -0.45, 0};  // on the left
    Bends rest = {};                                                   // in the rest pose
    std::vector<Bends> clip = {};                                      // in each frame; empty: no clip
    Bends aside = {};                                                  // by which the clip's axes are turned
                                                                       // about the upper bones from rest's
    std::optional<Eigen::Vector3d> toe_step = Eigen::Vector3d(0, -0.05, 0.1);  // from the foot, on the left
    Eigen::Vector3d scale = {1, 1, 1};                                         // of what is above the figure
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();                  // of the figure
    std::optional<Between> between = {};
};

// What is random about a figure.
struct FigureWish {
    bool random_axes = true, moves = true, bent = true, toes = true;
    double twist_bones = 0, scales = 0, mirrors = 0, uneven = 0;  // how likely each is, where it may be
    double uneven_by = 0.2;
};

struct Figure {
    GltfRig rig;
    std::array<LimbNodes, 4> limbs{};        // left arm, right arm, left leg, right leg; -1: it has none
    std::array<double, 4> upper{}, lower{};  // lengths in the world
    Eigen::Vector3d front;                   // which way it faces in the world
    bool is_mirrored = false;                // its trunk is
};

Figure figure_of(const Body& body);
inline GltfRig rig_of(const Body& body) { return figure_of(body).rig; }

// A figure of four limbs with any joint axes, scales and mirrors, with or without joints in between that twist. Limbs
// are straight or bent at rest, and move at random. random: what it is made of.
Figure random_figure(std::mt19937& random, const FigureWish& wish);

inline const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kY = Eigen::Vector3d::UnitY(),
                             kZ = Eigen::Vector3d::UnitZ();
inline constexpr std::array<const char*, 4> kLimbs = {"left_arm", "right_arm", "left_leg", "right_leg"};

// Keys of rotations.
std::vector<float> turns(const Eigen::Vector3d& axis, const std::vector<double>& degrees);

// What the command says in a folder with --json. It must end with this code.
nlohmann::json report_of(const fs::path& folder, Words words, int exit_code = 0);

nlohmann::json rig_report(const GltfRig& rig);

nlohmann::json limb_of(const nlohmann::json& report, const std::string& name);

Eigen::Vector3d vector_of(const nlohmann::json& numbers);

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// Why a limb is not bound; empty where it is.
std::string problem_of(const nlohmann::json& report, const std::string& limb);

}  // namespace swivel::test
