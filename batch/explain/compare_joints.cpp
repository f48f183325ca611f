// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "batch/explain/compare.h"

namespace swivel {

namespace {

void add_joints(const ComparedLimb& limb, const LimbJoints& joints, Text& text)
{
    text.add("%u, %u and %u", limb.body.skeleton_joint(joints.at[0]), limb.body.skeleton_joint(joints.at[1]),
             limb.body.skeleton_joint(joints.at[2]));
}

// Whether the places are those of another group's limb.
bool guess_other_limb(Causes& causes)
{
    const ComparedLimb& limb = causes.limb;
    for (std::uint32_t other = 0; other < limb.crowd.group_count; ++other) {
        if (other == limb.group || limb.crowd.groups[other].features & kNoLimb) continue;
        const LimbJoints joints = limb.joints_of(other);
        const LimbPlaces ours = limb.places(joints, limb.as_given);
        if (!limb.agrees(ours)) continue;
        causes.add(ours).add("Your places are those of group %u's limb, joints ", other);
        add_joints(limb, joints, causes.text);
        causes.text.add(", but group %u has joints ", limb.group);
        add_joints(limb, limb.joints, causes.text);
        causes.text.add(
            ". Left and right may be exchanged. Name the other joints in the group, or give this limb's places.");
        return true;
    }
    return false;
}

// The needed joint that lies at one of the places, the nearest along the chain if several do; 0: none.
std::uint32_t joint_at_place(const ComparedLimb& limb, int part)
{
    const double max = limb.allowed(limb.posed);
    const std::uint32_t own = limb.joints.at[part];
    std::uint32_t found = 0, min = std::numeric_limits<std::uint32_t>::max();
    for (std::uint32_t joint = 1; joint < limb.crowd.joint_count; ++joint) {
        if (!(distance(limb.body.place(joint, limb.as_given), limb.theirs.at[part]) <= max)) continue;
        const std::uint32_t steps = std::max(limb.body.steps_up(own, joint), limb.body.steps_up(joint, own));
        const std::uint32_t far = joint == own ? 0 : steps > 0 ? steps : limb.crowd.joint_count;
        if (far < min) min = far, found = joint;
    }
    return found;
}

// A clavicle for a shoulder, a shoulder for an elbow, and an elbow for a wrist: then no group needs the hand.
void guess_all_high(Causes& causes, const LimbJoints& found)
{
    const ComparedLimb& limb = causes.limb;
    for (int part = 0; part < 2; ++part)
        if (limb.body.steps_up(found.at[part], limb.joints.at[part]) == 0) return;
    const std::uint32_t shoulder = limb.body.skeleton_joint(found.at[0]), elbow = limb.body.skeleton_joint(found.at[1]);
    Text& text = causes.add_unsure();
    text.add("Your shoulder and elbow are joints %u and %u, but the group has joints ", shoulder, elbow);
    add_joints(limb, limb.joints, text);
    text.add(
        ": all three are too high, such as a clavicle for the shoulder. Name joints %u and %u as shoulder and elbow in "
        "the group, and the hand below them as the wrist.",
        shoulder, elbow);
}

void describe_neighbours(const ComparedLimb& limb, const LimbJoints& found, Text& text)
{
    bool is_first = true;
    for (int part = 0; part < 3; ++part) {
        const std::uint32_t joint = found.at[part], own = limb.joints.at[part];
        if (joint == own) continue;
        const std::uint32_t up = limb.body.steps_up(own, joint), down = limb.body.steps_up(joint, own);
        text.add("%s%s", is_first ? "Your place of the " : ", and that of the ", kLimbParts[part]);
        text.add(" is joint %u's", limb.body.skeleton_joint(joint));
        if (up + down > 0) text.add(", %u %s", up + down, up > 0 ? "too high" : "too low");
        text.add("; the group has joint %u", limb.named(part));
        is_first = false;
    }
    text.add(". Give the places of the group's joints, or name the others in the group.");
}
void guess_neighbours(Causes& causes)
{
    const ComparedLimb& limb = causes.limb;
    LimbJoints found;
    for (int part = 0; part < 3; ++part)
        if ((found.at[part] = joint_at_place(limb, part)) == 0) {
            if (part == 2) guess_all_high(causes, found);
            return;
        }
    const LimbPlaces ours = limb.places(found, limb.as_given);
    if (limb.agrees(ours)) describe_neighbours(limb, found, causes.add(ours));
}

}  // namespace

void guess_joints(Causes& causes)
{
    if (!guess_other_limb(causes)) guess_neighbours(causes);
}

}  // namespace swivel
