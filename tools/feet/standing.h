// SPDX-License-Identifier: MIT
//
// What legs of a crowd need to stand on ground: when the clip has their feet down, and which points of the foot stand.
#pragma once

#include "tools/crowd/crowd_plan.h"
#include "tools/formats/crowd_file.h"

namespace swivel::tools {

// How a figure stands: upwards in the world, and the joint that carries the body (carrier_of()), or -1.
struct FigureAxes {
    Eigen::Vector3d up_w;
    int carrier;
};
// Which frames of its motion file a clip shows: those from `first` on.
struct FramesInFile {
    std::size_t first;
    std::size_t count;  // of the file
};

// Makes the legs of a crowd stand on the ground that its file has. A foot stands on its toe, or without one on its
// ankle. An effector that the file gives counts instead. Reads the picture of heights and the table of contacts.
//
// Throws InputError, naming the file's line, for what cannot stand: a crowd without legs, one with a budget, and a
// figure that is not upright along Y. It also does for clips of uneven frames, that walk in place, or whose feet are
// never on the ground, and for a table of contacts beside several clips.
void stand_on_ground(const formats::CrowdFile& file, const formats::Clip& clip, std::span<const Limb> limbs,
                     const FigureAxes& figure, const FramesInFile& frames, CrowdPlan& plan);

}  // namespace swivel::tools
