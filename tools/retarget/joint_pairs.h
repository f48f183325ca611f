// SPDX-License-Identifier: MIT
//
// Pairs the joints of two skeletons, by parts and names or by a table. Knows clips and the names of rigs.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/rig/body_parts.h"

namespace swivel::tools {

// A part of both bodies, or a pair of other joints. A list is empty if a skeleton lacks the part.
struct PairedPart {
    std::string name;  // of body_parts(); empty: two joints paired by name or by a table
    std::vector<int> source, target;

    bool is_paired() const { return !source.empty() && !target.empty(); }
};
using JointPairs = std::vector<PairedPart>;

// A body and its parts, of body_parts().
struct PartedBody {
    const formats::Clip& clip;
    std::vector<BodyPart> parts;
};

// Pairs the parts of both, and then joints outside of parts with the same name, or of the same bone of a finger, on
// hands of two fingers or more. Names are compared by plain(); only bones count, and only names that are unique in each
// skeleton.
JointPairs pair_joints(const PartedBody& source, const PartedBody& target);

// The same from a table with columns part, source and target. Rows of one part list its joints from the hips outwards;
// its lists may differ in length, and cells may be empty. A row without a part pairs its two joints. Joints are given
// by name, path or number. Throws InputError, naming the line, as for_each_row() does, and for
// - other columns, and parts that are none of part_names();
// - joints that do not exist or are not unique, and a joint that is given twice.
JointPairs read_joint_map(const std::filesystem::path& path, const formats::Clip& source, const formats::Clip& target);

// Writes such a table; bones without a partner are rows with an empty cell. can_key: whether the target's file can
// store a joint's rotation; bones for which it cannot are left out. Throws InputError on writing.
void write_joint_map(const std::filesystem::path& path, const JointPairs& pairs, const formats::Clip& source,
                     const formats::Clip& target, const std::function<bool(int)>& can_key);

// The parts of one body.
enum class BodySide { source, target };
std::vector<BodyPart> parts_of(const JointPairs& pairs, BodySide side);

// The bones of that body's clip without a partner.
std::vector<int> unpaired_bones(const JointPairs& pairs, const formats::Clip& clip, BodySide side);

}  // namespace swivel::tools
