// SPDX-License-Identifier: MIT
//
// A clip's crowd as a cache and a page hold it.
#pragma once

#include "tools/cache/cached_crowd.h"
#include "tools/crowd/clip_motion.h"
#include "tools/crowd/crowd_plan.h"

namespace swivel::tools {

// What the page and the cache say of the clip.
struct ClipNames {
    std::string title;  // the motion's file
    std::string clip;   // the animation in it; may be empty
};

// The clip's joints that are drawn: bones, the limbs' own, and those of the plan's look with the one above.
std::vector<std::size_t> drawn_joints(const formats::Clip& clip, std::span<const Limb> limbs, const CrowdPlan& plan);

// Its joints are those that are drawn. All frames of the clip, all characters of the plan.
CachedCrowd cached_clip(const ClipNames& names, const formats::Clip& clip, std::span<const Limb> limbs,
                        const CrowdPlan& plan, const ClipMotion& motion);

}  // namespace swivel::tools
