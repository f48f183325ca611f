// SPDX-License-Identifier: MIT
//
// Binds one limb's joints for the solver: bones, lengths, bend, scale and mirror from the rest pose. Knows clips and
// the public interface.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/formats/clip.h"
#include "tools/formats/limb_rest.h"
#include "tools/rig/facing.h"
#include "tools/rig/limb_chain.h"
#include "tools/rig/limb_joints.h"

namespace swivel::tools {

struct Limb {
    formats::LimbName name;
    LimbJoints joints{-1, -1, -1};                         // shoulder, elbow and wrist, or hip, knee and ankle
    LimbChain chain;                                       // these and the joints between
    std::string from;                                      // the source of these names, for people; see FoundJoints
    formats::LimbRest rest;                                // in the axes that it is solved in, in the world's unit
    swivel_binding bound = swivel_default_binding();       // of it
    Eigen::Vector3d upper_bone = Eigen::Vector3d::Zero();  // its direction at rest, in the upper joint's axes
    Eigen::Vector3d lower_bone = Eigen::Vector3d::Zero();  // the same of the lower bone, in the lower joint's
    Eigen::Vector3d bend = Eigen::Vector3d::Zero();        // where flexion carries the lower bone, in the upper
                                                           // joint's axes, unit
    std::string bend_source;                               // the bend's source, for people
    std::vector<std::string> notes;                        // notes on the limb for the user
    double scale = 1;                                      // world lengths for one of the upper joint's parent, at rest
    double unevenness = 0;  // uneven scales put the wrist off by at most this share of the limb's length
    bool mirrored = false;  // the upper joint's parent is mirrored: joints are solved in axes whose x is turned over
    Eigen::Matrix3d axes_w = Eigen::Matrix3d::Zero();  // columns: the arm frame's x, y and z at rest, in the world

    int upper() const { return joints[0]; }
    int lower() const { return joints[1]; }
    int end() const { return joints[2]; }

    // Converts a direction or a turn between the joints' own axes and the axes that the limb is solved in, either way.
    template <class Geometry>
    Geometry as_solved(const Geometry& own) const
    {
        return mirrored ? formats::mirrored(own) : own;
    }
};

// A rotation as the solver has it, x, y, z, w, made unit.
inline Eigen::Quaterniond quaternion(std::span<const float, 4> q)
{
    return Eigen::Quaterniond(double{q[3]}, double{q[0]}, double{q[1]}, double{q[2]}).normalized();
}

// A bend given by the user in a crowd file.
struct GivenBend {
    formats::LimbName limb;
    Eigen::Vector3d direction;  // in the upper joint's axes, unit
    std::string key, file;      // "limb.left_arm.bend"; for people
};

// The limb at rest in the clip's own axes, its lengths in those of its upper joint's parent (times Limb::scale they are
// the world's). bend: in the upper joint's axes.
formats::LimbRest limb_rest(const formats::Clip& clip, const LimbChain& chain, const Eigen::Vector3d& bend);
// The library's binding of a limb at rest, as a skeleton of three joints. Throws swivel::Error as bind() does.
swivel_binding binding_of(const formats::LimbRest& rest);

// The limb of these joints, bound. joints: as is_chain() says. At, above and between them it looks at the rest pose and
// at every frame. Throws CannotBind for one of these:
// - a bone of no length;
// - a joint between that moves the next of the three by more than 1e-3 of the bone;
// - scales that are uneven by more than 1e-3, sheared or nothing, and mirrors that come or go;
// - a bend that is given along the upper bone, and one that is not given and that choose_bend() cannot tell.
Limb bind_limb(const formats::Clip& clip, formats::LimbName name, const LimbJoints& joints, const Facing& facing,
               std::span<const GivenBend> bends);

}  // namespace swivel::tools
