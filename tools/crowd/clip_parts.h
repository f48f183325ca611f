// SPDX-License-Identifier: MIT
//
// Several clips of one skeleton as one clip, and its parts. Knows clips alone.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tools/formats/clip.h"

namespace swivel::tools {

// Frames of a clip that are played round and round.
struct ClipPart {
    std::size_t first = 0, count = 0;
    std::size_t starts = 0;  // the number of frames that characters may start in; of a loop: one round's
    double pace = 1;         // source frames for each of these
};

// The first difference between two clips' skeletons, for people: "joint 7 is Hand, not Wrist". Empty: none.
std::string difference_of(const formats::Clip& clip, const formats::Clip& other);

// All frames, clip after clip. Skeletons do not differ, frame times neither. Each clip but the first is moved, so that
// `body` begins above where it does in the first, and their floors are one.
formats::Clip joined(std::span<const formats::Clip> clips, int body);

// Parts of a clip, one after the other, each at its own speed: that many of its frames pass in one. Parts become those
// of the new clip. frames: of a loop as it goes on; 0: they are no loops. A round of a loop is a whole number of
// frames, so it may take a little longer. A loop must have frames * speed + starts frames, or more.
formats::Clip paced(const formats::Clip& clip, std::vector<ClipPart>& parts, std::span<const double> speeds,
                    std::size_t frames);

// The frames of one of its parts alone; of an empty part the skeleton alone.
formats::Clip frames_of(const formats::Clip& clip, const ClipPart& part);

// The floor of a clip's first frames, along y: the lower quartile of the lowest joint's height, so that a toe that is
// low now and then does not count.
double floor_of(const formats::Clip& clip, std::size_t frame_count);

}  // namespace swivel::tools
