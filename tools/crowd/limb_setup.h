// SPDX-License-Identifier: MIT
//
// One limb of every character of a crowd, in the solver's terms alone: what a clip and a crowd file come to, and what a
// cache stores. Knows the public interface and the formula of goals; no clip, no Eigen.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/crowd/goals.h"

namespace swivel::tools {

// A field that has one value for all characters and frames.
struct FixedField {
    swivel_field field;
    std::array<float, 12> value;
};

struct LimbSetup {
    swivel_binding binding = swivel_default_binding();
    swivel_features features;
    swivel_euler_order shoulder_order, wrist_order;
    std::vector<FixedField> fields;
    float priority;
    goal_plan goals;
    std::optional<swivel_region> region;  // with SWIVEL_WITH_REGION

    bool has(swivel_features feature) const { return (features & feature) != 0; }
    unsigned twist_bone_count() const
    {
        return static_cast<unsigned>(features / SWIVEL_WITH_TWIST_BONES % (SWIVEL_MOST_TWIST_BONES + 1));
    }
};

// The bytes behind a binding's size. They are the same on every platform, which the width of the size is not.
inline std::span<char> bytes_behind_size(swivel_binding& binding)
{
    return {reinterpret_cast<char*>(binding.parent_from_arm),
            reinterpret_cast<char*>(binding.twist_from_arm + SWIVEL_MOST_TWIST_BONES)};
}

// The same of a region.
inline std::span<char> bytes_behind_size(swivel_region& region)
{
    return {reinterpret_cast<char*>(&region.cut_count),
            reinterpret_cast<char*>(region.half_space + SWIVEL_MOST_HALF_SPACES)};
}

}  // namespace swivel::tools
