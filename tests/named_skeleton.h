#pragma once
// SPDX-License-Identifier: MIT
// Skeletons of names alone.

#include <string>
#include <vector>

#include "tools/formats/clip.h"

namespace swivel::test {

using Names = std::vector<std::string>;

// Puts a chain of joints below one; -1: below none. Returns the last of them.
inline int add_chain(formats::Clip& clip, int parent, const Names& names)
{
    for (const std::string& name : names) {
        clip.joints.push_back({name, parent, {1, 0, 0}});
        parent = static_cast<int>(clip.joints.size()) - 1;
        clip.joints.back().number = parent;
    }
    return parent;
}

}  // namespace swivel::test
