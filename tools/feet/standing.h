// SPDX-License-Identifier: MIT
//
// Prepares legs of a crowd to stand on ground: when the clip's feet are down, and the points of the foot that stand.
#pragma once

#include "tools/crowd/crowd_plan.h"
#include "tools/formats/crowd_file.h"

namespace swivel::tools {

// How a figure stands: upwards in the world, and the joint that carries the body (carrier_of()), or -1.
struct FigureAxes {
    Eigen::Vector3d up_w;
    int carrier;
};
// The frames of its motion file that a clip shows: those from `first` on.
struct FramesInFile {
    std::size_t first;
    std::size_t count;  // of the file
};

// Makes the legs of a crowd stand on the ground that its file has. A foot stands on its toe, or without one on its
// ankle. An effector in the file overrides both. Reads the picture of heights and the table of contacts.
//
// Throws InputError, naming the file's line, for
// - a crowd without legs or with a budget, and a figure that is not upright along Y;
// - clips of uneven frames, that walk in place, or whose feet are never on the ground;
// - a table of contacts beside several clips.
void stand_on_ground(const formats::CrowdFile& file, const formats::Clip& clip, std::span<const Limb> limbs,
                     const FigureAxes& figure, const FramesInFile& frames, CrowdPlan& plan);

}  // namespace swivel::tools
