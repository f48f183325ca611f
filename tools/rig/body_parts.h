// SPDX-License-Identifier: MIT
//
// A body's joints by anatomy, in VRM's words: hips, spine, neck, head, and of each side "leftShoulder" (the
// clavicle), "leftUpperArm", "leftLowerArm", "leftHand", "leftUpperLeg", "leftLowerLeg", "leftFoot" and "leftToes".
// Knows clips alone.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/clip.h"
#include "tools/rig/limb_joints.h"

namespace swivel::tools {

struct BodyPart {
    std::string name;
    std::vector<int> joints;  // from the hips outwards, at least one
};

// The parts that the skeleton has, in the order above, right after left. Hips, head and toes are those that the file
// names so (VRM). Otherwise the hips are where both legs meet, or are called hips or pelvis. The head is a joint above
// the chest: bones come before other nodes, then joints called head before those whose last word is head or that are
// Rigify's, then earlier joints before later ones. Toes are those of toes_of(). All else follows from these and the
// limbs. The spine leads from the hips to where both arms meet, a clavicle from there to its arm, the neck from there
// to the head. given_head: the joint that is the head, if the caller knows it.
std::vector<BodyPart> body_parts(const formats::Clip& clip, const KnownLimbs& limbs,
                                 std::optional<int> given_head = {});

// The joints of the part of that name; empty if there is none.
std::vector<int> joints_of(const std::vector<BodyPart>& parts, std::string_view name);

// The first of these; -1 if there is none.
int first_joint(const std::vector<BodyPart>& parts, std::string_view name);

// The names of all parts, in the order above, the left side's limbs before the right's.
std::vector<std::string> part_names();

// Whether it is one of the three joints of a limb.
bool is_limb_part(const BodyPart& part);

// The parts that are limbs' joints, as the limbs.
KnownLimbs limbs_of(const std::vector<BodyPart>& parts);

}  // namespace swivel::tools
