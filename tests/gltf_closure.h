#pragma once
// SPDX-License-Identifier: MIT
// Compares a written glTF file with the one that it was solved from. The plain reading of both gives the places of
// wrists and elbows, and tells whether anything else moved.

#include <array>
#include <string>
#include <vector>

#include "tests/plain_gltf.h"

namespace swivel::test {

// Upper, lower and end joint, as nodes.
using LimbNodes = std::array<int, 3>;

// Worst of all frames and limbs: places in the limb's length, the end joint's orientation as its axes' distance.
struct Closure {
    double end = 0, lower_straight = 0, orientation = 0, others = 0;
    double turn = 0, lower_bent = 0;  // as shares of what is allowed; turns are the joints' against their parents
    std::size_t frames = 0;
};

inline Eigen::Matrix3d plain_axes(const Eigen::Affine3d& pose) { return pose.linear().colwise().normalized(); }

// animation: index in `from`, or -1 (rest) for a file that had none: `to` has one then. Nodes that are no limb's joint
// must have the local transforms they had.
Closure closure(const PlainGltf& from, const PlainGltf& to, int animation, const std::vector<LimbNodes>& limbs);

// Joints are turned as in the clip within swivel.h's bound, 2e-6 + 4e-7 L^2 / (L1 L2 sin b) rad. An elbow misses its
// place by at most this number times the limb's length. All other places, and folded elbows: 1e-5 of that length. For
// an elbow bent by less than 0.02 rad it is 2e-3. The elbow's height over the line from shoulder to wrist is then the
// root of a float's error in the reach; see tests/command/test_clip_back.cpp.
void require_closed(const Closure& worst);

}  // namespace swivel::test
