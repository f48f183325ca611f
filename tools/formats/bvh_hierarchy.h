#pragma once
// SPDX-License-Identifier: MIT
// The first half of a BVH file: joints, offsets, channels. Private to the reader.

#include "tools/formats/bvh.h"
#include "tools/formats/bvh_scanner.h"

namespace swivel::formats {

// Reads from HIERARCHY through the word MOTION into the joints of `file` and of its clip, and counts the channels.
// Throws InputError for anything malformed. Keeps its own stack, so nesting cannot exhaust the program's.
void read_hierarchy(Scanner& scan, BvhFile& file);

}  // namespace swivel::formats
