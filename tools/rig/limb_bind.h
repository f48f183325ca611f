// SPDX-License-Identifier: MIT
//
// One limb's joints made into what the solver takes: bones, lengths, bend, scale and mirror from the rest pose. Knows
// clips and the public interface.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/formats/clip.h"
#include "tools/rig/cannot_bind.h"
#include "tools/rig/figure_front.h"
#include "tools/rig/limb_chain.h"
#include "tools/rig/limb_joints.h"

namespace swivel::tools {

struct Limb {
    formats::LimbName name;
    LimbJoints joints{-1, -1, -1};  // shoulder, elbow and wrist, or hip, knee and ankle
    LimbChain chain;                // these and what lies between
    std::string habit;              // whose names these are, or where the user gave them; for people
    swivel_binding bound{};         // lengths at rest, in the world
    Eigen::Vector3d upper_bone = Eigen::Vector3d::Zero();  // its direction at rest, in the upper joint's axes
    Eigen::Vector3d lower_bone = Eigen::Vector3d::Zero();  // the same of the lower bone, in the lower joint's
    Eigen::Vector3d bend = Eigen::Vector3d::Zero();        // where flexion carries the lower bone, in the upper
                                                           // joint's axes, unit
    std::string bend_source;                               // how it was chosen, for people
    double scale = 1;                                      // world lengths for one of the upper joint's parent, at rest
    bool mirrored = false;  // that parent is mirrored in the world: the limb is solved in the mirror image
    Eigen::Matrix3d axes_w = Eigen::Matrix3d::Zero();  // columns: the arm frame's x, y and z at rest, in the world
    std::vector<int> side_twists;                      // twist bones that hang on the limb: they follow as they did

    int upper() const { return joints[0]; }
    int lower() const { return joints[1]; }
    int end() const { return joints[2]; }
};

// A rotation as the solver has it, x, y, z, w, made unit.
inline Eigen::Quaterniond quaternion(std::span<const float, 4> q)
{
    return Eigen::Quaterniond(double{q[3]}, double{q[0]}, double{q[1]}, double{q[2]}).normalized();
}

// A bend given by the user in a crowd file; or, under the key that files of 0.1 have, `hinge`, the axis that flexion
// turns about the opposite of.
struct GivenBend {
    formats::LimbName limb;
    Eigen::Vector3d direction;  // in the upper joint's axes, unit
    std::string key, file;      // "limb.left_arm.bend"; for people
};

// What bind() takes: the limb at rest, its lengths in its upper joint's parent's axes (times Limb::scale they are the
// world's). bend: in the upper joint's axes.
swivel_chain rest_chain(const formats::Clip& clip, const LimbChain& chain, const Eigen::Vector3d& bend);

// The limb of these joints, bound. joints: as is_chain() says; front: see figure_front(). Throws CannotBind for a bone
// of no length, a scale that is uneven or nothing (at rest or in any frame) at, between or above the joints, a mirror
// there that a frame has and the rest pose has not, or the other way round, a bend that is given along the upper bone
// or as a hinge, or one that is not given and that choose_hinge() cannot tell.
Limb bind_limb(const formats::Clip& clip, formats::LimbName name, const LimbJoints& joints, const Front& front,
               std::span<const GivenBend> bends);

// Throws CannotBind where joints between two of the limb's, and not at the place of either, are no parts of that bone:
// a twist or roll bone by name that turns what hangs on it by more than 15 degrees in a frame; others and roll bones
// off the line between the two by more than a tenth of its length at rest, or all together turning the bone by more
// than 15 degrees. A roll bone, or one called a copy ("thigh.L.001"), that does not divide the bone evenly may be the
// joint that the bone turns in: it must show that it is none as a twist bone does, in a clip of two frames or more in
// which the joint that the bone starts at turns the bone by more than 15 degrees.
void require_parts_between(const formats::Clip& clip, const Limb& limb);

}  // namespace swivel::tools
