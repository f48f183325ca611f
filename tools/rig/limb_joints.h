// SPDX-License-Identifier: MIT
//
// Finds the joints of arms and legs in a skeleton: by the file's own data, or else by names. Knows clips alone.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tools/formats/clip.h"
#include "tools/formats/limb_name.h"

namespace swivel::tools {

// Shoulder, elbow and wrist, or hip, knee and ankle: joints of a clip.
using LimbJoints = std::array<int, 3>;

// The joints of the four limbs as far as they are known, in the order of formats::kLimbNames.
using KnownLimbs = std::array<std::optional<LimbJoints>, 4>;

// A limb's joints, or why there are none.
struct FoundJoints {
    std::optional<LimbJoints> joints;
    std::string from;     // the source of these names, for people: "Unreal, Mesh2Motion", "--arm"
    std::string problem;  // without joints: one line; empty if no name speaks of such a limb
    std::string advice;   // what to do, for after a semicolon; empty: name joints
};

// Why a limb is not solved. what() is one line that leaves out the file; advice is as above.
struct CannotBind : std::runtime_error {
    CannotBind(const std::string& cause, std::string what_to_do)
        : std::runtime_error(cause), advice(std::move(what_to_do))
    {
    }
    std::string advice;
};

// The joints of the four limbs, in the order of formats::kLimbNames. A file that says which joints are a limb's is
// believed (Clip::human_bones). Otherwise the table of names decides: a row fits if its three names are borne by joints
// above one another, bones before other nodes, one of them a bone. The first row that fits counts. Further limbs of
// that row, and limbs of other rows that share no joint with it, are candidates, too; more than one candidate is a
// problem that lists them. No joint between the three may have a name that the table knows for the upper or lower joint
// of such a limb, because it would be that joint. Where figures repeat each other, the first is searched. Takes memory
// and time in proportion to the joints.
std::array<FoundJoints, 4> joints_by_file(const formats::Clip& clip);

// True if `top` is above the other joint.
bool is_above(const formats::Clip& clip, int top, int joint);

// True if each is above the next.
bool is_chain(const formats::Clip& clip, const LimbJoints& joints);

// The joint that both hang on, or one of the two that the other hangs on; -1 if there is none.
int fork_of(const formats::Clip& clip, int a, int b);

// The toes of a foot: the joint that the file says is (VRM), or those right below the foot that are called toe or ball.
// Without any, those called foot: they are below a joint that ends the leg and is itself called ankle, say.
std::vector<int> toes_of(const formats::Clip& clip, formats::Side side, int foot);

// The first joint of `a` that is in `b`, too; -1 if there is none.
int shared_joint(std::span<const int> a, std::span<const int> b);

}  // namespace swivel::tools
