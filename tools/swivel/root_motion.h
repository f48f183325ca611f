// SPDX-License-Identifier: MIT
//
// `--root-motion`: a body's way over the ground and its heading, on a joint `root` of their own above the hips, as game
// engines want them. No joint below moves in the world.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/formats/joint_keys.h"

namespace swivel::tools {

// Whose way it is, and who carries it.
struct MovedBody {
    int carrier;                                                 // the joint whose keys move the body
    int hips;                                                    // the one that tells place and heading: it, or below
    Eigen::Vector3d up_w;                                        // an axis of the world
    std::function<double(const Eigen::Vector3d&)> floor_height;  // along up, at a place in the world
};

// The joint right above the carrier, if that is called root and has no scale; it then takes the motion. Else -1: a new
// one does. Throws InputError, naming `file`, if another joint has the name, in any case.
int root_joint(const formats::Clip& clip, int carrier, const std::string& file);

// New keys of root and carrier, one for each frame. To outlive what add_to() and added() return.
class RootMotion {
public:
    // clip: as it is to look. root: of root_joint().
    RootMotion(const formats::Clip& clip, int root, const MovedBody& body);

    // Puts the keys in place of those that the joints have, if any.
    void add_to(std::vector<formats::JointKeys>& keys) const;
    // The new joint, if it is one.
    std::optional<formats::NewJoint> added() const;

private:
    int root_, carrier_;
    std::vector<Eigen::Quaterniond> root_rotation_, rotation_;
    std::vector<Eigen::Vector3d> root_place_, place_;
};

// Whether a figure rests with its feet on the ground at height 0: an ankle is within 0.3 of the leg's height of it.
bool rests_on_ground(const formats::Clip& clip, int thigh, int ankle, const Eigen::Vector3d& up_w);

}  // namespace swivel::tools
