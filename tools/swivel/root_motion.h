// SPDX-License-Identifier: MIT
//
// Writes joints that move anew into their file. `--root-motion` puts a body's way over the ground and its heading on a
// joint `root` of their own above the hips, as game engines want them. No joint below moves in the world.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/feet/turn_legs.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

// Whose way it is, and who carries it.
struct MovedBody {
    int root;                                                    // of root_joint()
    int carrier;                                                 // the joint whose keys move the body
    int hips;                                                    // the one that tells place and heading: it, or below
    Eigen::Vector3d up_w;                                        // an axis of the world
    std::function<double(const Eigen::Vector3d&)> floor_height;  // along up, at a place in the world
};

// The joint right above the carrier, if that is called root and has no scale; it then takes the motion. Else -1: a new
// one does. Throws InputError, naming `file`, if the carrier or another joint has the name, in any case.
int root_joint(const formats::Clip& clip, int carrier, const std::string& file);

// Whether a figure rests with its feet on the ground at height 0: an ankle is within 0.3 of the leg's height of it.
bool rests_on_ground(const formats::Clip& clip, int thigh, int ankle, const Eigen::Vector3d& up_w);

// Writes new values of a file's joints. clip: as it is to look with them. frames: replace the file's own. body: its way
// goes to the root; without one it stays where it is.
void write_joints(const std::filesystem::path& out, const MotionFile& file, const formats::Clip& clip,
                  std::vector<TurnedJoint> joints, const std::optional<formats::NewFrames>& frames,
                  const std::optional<MovedBody>& body);

}  // namespace swivel::tools
