// SPDX-License-Identifier: MIT
//
// The joints of arms and legs in a skeleton, and how joints lie above each other. Knows clips alone.
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
// Why there are none.
inline FoundJoints no_joints(std::string problem, std::string advice = {})
{
    return {{}, {}, std::move(problem), std::move(advice)};
}

// Why a limb is not solved. what() is one line that leaves out the file; advice is as above.
struct CannotBind : std::runtime_error {
    CannotBind(const std::string& cause, std::string what_to_do)
        : std::runtime_error(cause), advice(std::move(what_to_do))
    {
    }
    std::string advice;
};

// True if `top` is above the other joint.
bool is_above(const formats::Clip& clip, int top, int joint);

// The joint that has no parent, at or above a joint.
int root_of(const formats::Clip& clip, int joint);

// True if each is above the next.
bool is_chain(const formats::Clip& clip, const LimbJoints& joints);

// VRM's words for a limb's three joints: "leftUpperArm", "leftLowerArm" and "leftHand".
std::array<std::string, 3> vrm_words(formats::LimbName limb);

// The joint that the file itself calls so by VRM's words; -1 if there is none.
int vrm_joint(const formats::Clip& clip, const std::string& word);

// The joint that both hang on, or one of the two that the other hangs on; -1 if there is none.
int fork_of(const formats::Clip& clip, int a, int b);

// The toes of a foot: the joint that the file says is (VRM), or those right below the foot that are called toe or ball.
// Without any, those called foot: they are below a joint that ends the leg and is itself called ankle, say.
std::vector<int> toes_of(const formats::Clip& clip, formats::Side side, int foot);
// The first of these; -1 if there is none.
int toe_of(const formats::Clip& clip, formats::Side side, int foot);

// The first joint of `a` that is in `b`, too; -1 if there is none.
int shared_joint(std::span<const int> a, std::span<const int> b);

}  // namespace swivel::tools
