// SPDX-License-Identifier: MIT
//
// Finds limbs' joints by the file's own data, or else by the table of names. Knows clips alone.
#pragma once

#include <array>
#include <vector>

#include "tools/rig/limb_joints.h"

namespace swivel::tools {

// Marks the joints of figures that repeat an earlier one, as in a file of a crowd: below a root of their own, with the
// same names in the same order.
std::vector<bool> repeated_joints(const formats::Clip& clip);

// The joints of the four limbs, in the order of formats::kLimbNames. A file that says which joints are a limb's is
// believed (Clip::human_bones). Otherwise the table of names decides: a row fits if its three names are borne by joints
// above one another, bones before other nodes, one of them a bone. The first row that fits counts. Further limbs of
// that row, and limbs of other rows that share no joint with it, are candidates, too; more than one candidate is a
// problem that lists them. No joint between the three may have a name that the table knows for the upper or lower joint
// of such a limb, because it would be that joint. Where figures repeat each other, the first is searched. Takes memory
// and time in proportion to the joints.
std::array<FoundJoints, 4> joints_by_file(const formats::Clip& clip);

}  // namespace swivel::tools
