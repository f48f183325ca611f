// SPDX-License-Identifier: MIT
//
// Finds a limb's joints by the table of names.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "tools/rig/limb_joints.h"

namespace swivel::tools {

// Marks the joints of figures that repeat an earlier one, as in a file of a crowd: below a root of their own, with the
// same names in the same order.
std::vector<bool> repeated_joints(const formats::Clip& clip);

// A skeleton's joints by their plain names, without those of repeated figures.
struct NamedJoints {
    const formats::Clip& clip;
    std::vector<std::string> names;  // of each joint
    std::unordered_map<std::string, std::vector<int>> bearers;

    explicit NamedJoints(const formats::Clip& skeleton);

    const std::string& name(int joint) const { return names[static_cast<std::size_t>(joint)]; }
    bool is_bone(int joint) const { return joint_at(clip, joint).is_bone; }
    // In the clip's order. Bones alone, where any has that name.
    std::vector<int> named(const std::string& plain_name) const;
};

// See joints_by_file().
FoundJoints joints_by_name(const NamedJoints& joints, formats::LimbName limb);

}  // namespace swivel::tools
