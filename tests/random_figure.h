#pragma once
// SPDX-License-Identifier: MIT
// Random figures as glTF files, of which everything that matters to a solver is known. They have the same four limbs,
// under any names, joint axes, scales and mirrors, with or without joints in between that twist. The limbs are straight
// or bent at rest, and move at random.

#include <Eigen/Geometry>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "tests/gltf_closure.h"
#include "tests/gltf_rig.h"

namespace swivel::test {

struct FigureNames {
    const char* habit;
    std::array<const char*, 3> arm, leg;  // * is the side
    const char *left, *right;
};

// As some exporters spell them; tests/test_limb_joints.cpp has all.
const std::vector<FigureNames>& figure_names();

struct FigureWish {
    bool random_axes = true, moves = true, bent = true, toes = true;
    double twist_bones = 0, scales = 0, mirrors = 0, uneven = 0;  // how likely each is, where it may be
    double uneven_by = 0.2;
};

struct Figure {
    GltfRig rig;
    std::array<LimbNodes, 4> limbs{};        // left arm, right arm, left leg, right leg
    std::array<double, 4> upper{}, lower{};  // lengths in the world
    Eigen::Vector3d front;                   // which way it faces in the world
    bool is_mirrored = false;                // its trunk is
    std::array<double, 4> bend{};            // of elbows and knees at rest, radians
};

// random: what the figure is made of.
Figure random_figure(std::mt19937& random, const FigureWish& wish, const FigureNames& names);

}  // namespace swivel::test
