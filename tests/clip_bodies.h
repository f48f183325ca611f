// SPDX-License-Identifier: MIT
//
// A clip as bodies: each frame is one.
#pragma once

#include <algorithm>

#include "tests/body_crowd.h"
#include "tests/gltf_clip.h"
#include "tests/shared_figures.h"
#include "tools/formats/bvh.h"
#include "tools/rig/limbs.h"

namespace swivel::test {

// kinds: "arms", "legs" or "all".
inline std::vector<tools::Limb> limbs_of(const formats::Clip& clip, const Words& options, const char* kinds)
{
    tools::LimbChoice choice;
    choice.kinds = kinds;
    for (std::size_t n = 0; n < options.size(); n += 2)
        (options[n] == "--arm" ? choice.arms : choice.legs)
            .push_back(tools::limb_of_option(options[n + 1], options[n]));
    std::vector<tools::Limb> limbs;
    for (const tools::LimbFinding& found : bind_limbs(clip, choose_joints(clip, {}, choice), choice).findings)
        if (found.limb) limbs.push_back(*found.limb);
    return limbs;
}

// A clip's skeleton, and each of its frames.
struct ClipBodies {
    BodySkeleton skeleton;
    std::vector<Body> frames;

    ClipBodies(const formats::Clip& clip, const Words& options = {}, const char* kinds = "all")
        : frames(clip.frame_count)
    {
        for (const formats::Joint& joint : clip.joints) {
            skeleton.parents.push_back(joint.parent);
            skeleton.rotations.push_back(floats(joint.rest_rotation));
            skeleton.translations.push_back(floats(joint.offset));
        }
        for (const tools::Limb& limb : limbs_of(clip, options, kinds)) {
            const auto joint = [&](std::size_t n) { return static_cast<std::uint32_t>(limb.joints[n]); };
            skeleton.limbs.push_back({joint(0), joint(1), joint(2), floats(limb.bend), {}});
        }
        for (std::size_t frame = 0; frame < frames.size(); ++frame)
            for (std::size_t n = 0; n < clip.joints.size(); ++n) {
                const auto scale = static_cast<float>(local_pose(clip, frame, n).scale);
                frames[frame].rotations.push_back(floats(clip.rotation[frame * clip.joints.size() + n]));
                frames[frame].translations.push_back(floats(local_translation(clip, frame, n)));
                frames[frame].scales.push_back({scale, scale, scale});
            }
    }
};

// Calls judge(name, clip, number of limbs, options) for each clip and animation that people share, where this machine
// has it. Returns whether it has all.
template <class Judge>
bool for_each_shared_clip(const Judge& judge)
{
    bool all = true;
    const auto find = [&](const std::string& name) {
        const fs::path path = find_or_warn(name);
        all = all && !path.empty();
        return path;
    };
    for (const char* name : kSharedClips)
        if (const fs::path path = find(name); !path.empty())
            judge(std::string(name), formats::read_bvh(path).clip, std::size_t{4}, Words{});
    for (const SharedFigure& file : kSharedFigures) {
        const fs::path path = find(file.name);
        for (int n = 0; !path.empty() && n < std::max(file.animations, 1); ++n) {
            formats::GltfChoice choice;
            if (file.animations > 0) choice.animation = std::to_string(n);
            judge(file.name + ", animation " + std::to_string(n), read_clip(path, choice).clip, file.limbs,
                  file.options);
        }
    }
    return all;
}

}  // namespace swivel::test
