// SPDX-License-Identifier: MIT
//
// The real figures and clips that tests go through, where a machine keeps them.
#pragma once

#include <cstdlib>

#include "tests/run_program.h"
#include "tests/test_data.h"

namespace swivel::test {

// A figure, of which all animations come back, and what tells the bend of arms and of legs.
struct SharedFigure {
    std::string name;
    int animations;  // 0: it has none
    std::size_t limbs;
    std::string arms_by, legs_by;
    Words options = {};
};
inline const std::vector<SharedFigure> kSharedFigures = {
    {"RobotExpressive.glb", 14, 2, "rest pose", ""},  // its feet hang on its root
    {"m2m_human_ymca.glb", 1, 4, "clip", "toes"},
    {"m2m_human_skeleton_tpose.glb", 1, 4, "toes", "toes"},
    {"m2m_human_male.glb", 0, 4, "toes", "rest pose"},
    {"cesium_man.gltf",
     1,
     4,
     "rest pose",
     "rest pose",
     {"--arm", "left:#16,#17,#18", "--arm", "right:#13,#14,#15", "--leg", "left:#7,#8,#9", "--leg", "right:#3,#4,#5"}},
};
// Each has four limbs.
inline constexpr const char* kSharedClips[] = {"cmu_01_01_forward_jump.bvh", "cmu_02_01_walk.bvh",
                                               "cmu_05_06_dance.bvh"};

// A real file, or an empty path where this machine keeps none; a folder that was named must have it.
inline fs::path find_or_warn(const std::string& name)
{
    const fs::path path = find_data(name);
    if (!path.empty()) return path;
    INFO(name << " is in none of the folders of tests/test_data.h");
    REQUIRE(std::getenv("SWIVEL_TEST_DATA") == nullptr);
    WARN("not judged: " << name << ", which this machine has not");
    return path;
}

}  // namespace swivel::test
