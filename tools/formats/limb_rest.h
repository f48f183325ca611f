// SPDX-License-Identifier: MIT
//
// A limb at rest as plain numbers, made from a clip and stored in a cache. Knows no clip and no solver.
#pragma once

namespace swivel::formats {

// Rotations are x, y, z, w. Each is relative to the joint above, and each offset lies in its frame.
struct LimbRest {
    float shoulder_rotation[4] = {0, 0, 0, 1};
    float elbow_rotation[4] = {0, 0, 0, 1};
    float wrist_rotation[4] = {0, 0, 0, 1};
    float elbow_offset[3] = {0, 0, 0};
    float wrist_offset[3] = {0, 0, 0};
    float bend[3] = {0, 0, 0};  // where flexion carries the forearm, in the shoulder joint's frame
};

}  // namespace swivel::formats
