// SPDX-License-Identifier: MIT
//
// Prepares a clip's crowd for a cache or a page, and the figure's skin for the page.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tools/cache/cached_crowd.h"
#include "tools/crowd/clip_motion.h"
#include "tools/crowd/crowd_plan.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

// The clip's names on the page and in the cache.
struct ClipNames {
    std::string title;  // the motion's file
    std::string clip;   // the animation in it; may be empty
};

// The clip's joints that are drawn: bones, the limbs' own, and those of the plan's look with the one above.
std::vector<std::size_t> drawn_joints(const formats::Clip& clip, std::span<const Limb> limbs, const CrowdPlan& plan);

// The crowd with the drawn joints, all frames of the clip and all characters of the plan.
CachedCrowd cached_clip(const ClipNames& names, const formats::Clip& clip, std::span<const Limb> limbs,
                        const CrowdPlan& plan, const ClipMotion& motion);

// The data from which the page draws a figure's meshes.
struct PageSkin {
    std::string glb;         // as formats::figure_glb() makes it
    std::vector<int> nodes;  // of each joint that is drawn, by the file's own number
    // For each frame and each such joint: its rotation in the world, x, y, z, w, and its scale, below 0 in a mirror.
    std::vector<float> turns;
    // The necks' and the head's places among the drawn joints, and the face in the head's axes. Empty: no head is
    // drawn.
    std::vector<std::size_t> head;
    std::array<double, 3> face{0, 0, 1};
};

// The skin of a file's meshes, for the clip that the job performs; nothing for a file without meshes.
std::optional<PageSkin> page_skin(const MotionFile& file, const CrowdJob& job);

}  // namespace swivel::tools
