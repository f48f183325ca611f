// SPDX-License-Identifier: MIT
//
// The figure's own skin, for the page.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tools/swivel/crowd_job.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

struct PageSkin {
    std::string glb;         // as formats::figure_glb() makes it
    std::vector<int> nodes;  // of each joint that is drawn, by the file's own number
    // Of each frame and each such joint: its rotation in the world, x, y, z, w, and its scale, below 0 in a mirror.
    std::vector<float> turns;
    // The necks' joints and the head's, among those that are drawn, and where the face is in the last one's axes.
    // Empty: no head is drawn.
    std::vector<std::size_t> head;
    std::array<double, 3> face{0, 0, 1};
};

// What a file's meshes are drawn from, for the clip that the job performs; nothing for a file without meshes.
std::optional<PageSkin> page_skin(const MotionFile& file, const CrowdJob& job);

}  // namespace swivel::tools
