#pragma once
// SPDX-License-Identifier: MIT
// New keys for joints of a clip, at the clip's own frames or at new ones. Knows no file.

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <string>

#include "tools/formats/clip.h"

namespace swivel::formats {

// New keys for one joint, one for each frame; an empty list: none of that kind. Borrowed for the call.
struct JointKeys {
    int joint = -1;                                     // index in Clip::joints, at most once a call
    std::span<const Eigen::Quaterniond> rotation = {};  // local, not zero, made unit
    std::span<const Eigen::Vector3d> translation = {};  // local, finite, in place of Joint::offset
};

// A new joint, put between a joint of the clip and that one's parent. At rest it is at its parent's origin and is not
// turned, so nothing moves. The keys of the joint below it are then relative to it.
struct NewJoint {
    std::string name;
    int below = -1;                                     // index in Clip::joints; it needs keys of both kinds, too
    std::span<const Eigen::Quaterniond> rotation = {};  // as those of JointKeys; neither list is empty
    std::span<const Eigen::Vector3d> translation = {};
};

// Frames that replace the clip's own. In all of them a joint rests in each kind of key that it is not given.
struct NewFrames {
    std::size_t count = 0;  // 1 or more
    double frame_time = 0;  // seconds between them, above 0
    std::string name = {};  // of the animation, where the format names it
};

// Throws std::invalid_argument for keys that break these rules. frame_count: of the clip, or of the new frames.
void require_keys(const Clip& clip, std::span<const JointKeys> keys, std::size_t frame_count);

}  // namespace swivel::formats
