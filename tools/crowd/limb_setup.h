// SPDX-License-Identifier: MIT
//
// One limb of every character of a crowd, in the solver's terms alone: made from a clip and a crowd file, and stored in
// a cache. Knows the public interface and the formula of goals; no clip, no Eigen.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "swivel/swivel_bodies.h"
#include "swivel/swivel_regions.h"
#include "tools/crowd/goals.h"
#include "tools/formats/limb_rest.h"

namespace swivel::tools {

// A field that has one value for all characters and frames.
struct FixedField {
    swivel_field field;
    std::array<float, 12> value;
};

struct LimbSetup {
    formats::LimbRest rest;  // in the clip's unit
    swivel_features features = 0;
    swivel_euler_order shoulder_order = SWIVEL_XYZ, wrist_order = SWIVEL_XYZ;
    std::uint32_t twist_bone_count = 0;
    std::vector<FixedField> fields;
    goal_plan goals{};
    std::optional<swivel_region> region;             // with SWIVEL_WITH_REGION
    swivel_ground ground = swivel_default_ground();  // with SWIVEL_WITH_GROUND
    bool mirrored = false;                           // the joints' axes, as solved, have x turned over
    std::array<float, 3> pole_behind{};              // with SWIVEL_POLE_HALF_LINE: as swivel_body_limb_def's
    // Given for neck and head, which are no limb: the look. Joints are counted from the limb's first, its shoulder.
    std::optional<swivel_look_def> look;

    // A rotation as solved in the joints' own axes.
    std::array<float, 4> own(std::span<const float, 4> q) const
    {
        return {q[0], mirrored ? -q[1] : q[1], mirrored ? -q[2] : q[2], q[3]};
    }
    bool has(swivel_features feature) const { return (features & feature) != 0; }
    // How a limb of a crowd of goals stands, with the constants of goals.h.
    swivel_plant standing_plant() const
    {
        swivel_plant plant = swivel_default_plant();
        plant.anchor_lead = GOAL_ANCHOR_LEAD;
        return plant;
    }
    swivel_ground standing_ground() const
    {
        swivel_ground made = ground;
        made.half_life = GOAL_GROUND_HALF_LIFE;
        return made;
    }
};

// The limbs of a character as one skeleton: joints as GOAL_JOINTS says, each limb's own below a root of its own.
struct LimbSkeleton {
    std::vector<std::int32_t> parents;
    std::vector<std::array<float, 3>> translations;
    std::vector<std::array<float, 4>> rotations;
    struct OfLimb {
        std::uint32_t shoulder;  // the elbow is the next one, then come the wrist and the twist bones
        std::vector<std::uint32_t> twist_bones;
        std::array<float, 3> bend;
    };
    std::vector<OfLimb> limbs;
};
LimbSkeleton skeleton_of(std::span<const LimbSetup> limbs);

// The bytes after a region's size. They are the same on every platform, unlike the size's width.
inline std::span<char> bytes_behind_size(swivel_region& region)
{
    return {reinterpret_cast<char*>(&region.cut_count),
            reinterpret_cast<char*>(region.half_space + SWIVEL_MAX_HALF_SPACES)};
}

}  // namespace swivel::tools
