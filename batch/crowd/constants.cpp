// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>

#include "batch/crowd/group_def.h"

namespace swivel {

namespace {

// A member's place, its number of floats, and its name.
#define SWIVEL_MEMBER(structure, name)                                            \
    offsetof(GroupDef, structure), offsetof(decltype(GroupDef::structure), name), \
        sizeof(decltype(GroupDef::structure)::name) / sizeof(float), #structure, #name

constexpr float kMaxValue = 1000;  // of lengths in limb lengths, of times and shares
constexpr float kFar = 1e15f;      // of lengths in the caller's unit

// In the order of the header.
constexpr ConstantRow kConstants[] = {
    {SWIVEL_MEMBER(plant, lock_radius), 0, kMaxValue, "limb lengths",
     "a point locks only within this of where it is animated"},
    {SWIVEL_MEMBER(plant, unlock_radius), 0, kMaxValue, "limb lengths",
     "a locked point is released if the animation has it further away; no less than `lock_radius`"},
    {SWIVEL_MEMBER(plant, stop_time), 0, kMaxValue, "s", "a point that locks is at rest after this"},
    {SWIVEL_MEMBER(plant, release_time), 0, kMaxValue, "s", "a released point is with the animation again after this"},
    {SWIVEL_MEMBER(plant, relock_speed), 0, kMaxValue, "limb lengths a second",
     "after a release by distance a slower point locks again; 0: none does"},
    {SWIVEL_MEMBER(plant, anchor_lead), 0, 1, "",
     "0: the anchor is where the point locks; 1: where it would come to rest; 0.5 slides least"},
    {SWIVEL_MEMBER(plant, reset_time), 0, kFar, "s",
     "a body that was not solved for longer than this starts anew; 0: none does"},
    {SWIVEL_MEMBER(plant, speed), 0, kMaxValue, "limb lengths a second",
     "without labels a contact begins below the first, and goes on below the second"},
    {SWIVEL_MEMBER(plant, height), -kMaxValue, kMaxValue, "limb lengths",
     "the same of the height over the root, along `up`"},

    {SWIVEL_MEMBER(ground, heel), -kFar, kFar, "the bones' unit",
     "a point of the sole in the wrist joint's frame; zeros: the wrist itself"},
    {SWIVEL_MEMBER(ground, toe_clearance), 0, kFar, "the bones' unit",
     "distance of the effector from the ground's plane where it stands, along the normal"},
    {SWIVEL_MEMBER(ground, heel_clearance), 0, kFar, "the bones' unit",
     "the same of the heel; 0 for both where both are on the sole"},
    {SWIVEL_MEMBER(ground, cos_max), 0, 1, "", "cosine of the angle that the foot turns at most"},
    {SWIVEL_MEMBER(ground, half_life), 0, kMaxValue, "s", "time in which about half of a lift or a slope is made up"},

    {SWIVEL_MEMBER(shift, drop), 0, kMaxValue, "limb lengths",
     "the most down, in lengths of the first group whose limbs are to reach"},
    {SWIVEL_MEMBER(shift, rise), 0, kMaxValue, "limb lengths", "the most up"},
    {SWIVEL_MEMBER(shift, half_life), 0, kMaxValue, "s", "time in which about half of a distance is made up"},
    {SWIVEL_MEMBER(shift, lookahead), 0, kMaxValue, "s",
     "how long before its time a next target counts; at 0 s it counts whole"},

    {SWIVEL_MEMBER(prop, max_move), 0, kMaxValue, "limb lengths",
     "the most that it moves, in lengths of the first limb linked to it; 0: it stays, as a ladder does"},

    {SWIVEL_MEMBER(look, share), 0, kMaxValue, "",
     "how much a joint takes of the turn that is left, against those after it; the last joint's is more than 0"},
    {SWIVEL_MEMBER(look, cos_max), -1, 1, "", "cosine of the angle that each joint turns at most"},
    {SWIVEL_MEMBER(look, eye), -kFar, kFar, "the last joint's unit",
     "where the line of sight starts, in the last joint's frame"},
    {SWIVEL_MEMBER(look, axis), -kFar, kFar, "",
     "where the line of sight points, in the last joint's frame, of any length but 0"},
    {SWIVEL_MEMBER(look, cos_full), -1, 1, "",
     "cosine of the target's angle to the line of sight from which on the look fades"},
    {SWIVEL_MEMBER(look, cos_none), -1, 1, "",
     "cosine at which it has faded, and the pose stays; at least 0.001 less than `cos_full`"},
    {SWIVEL_MEMBER(look, fade_distance), 0, kFar, "the last joint's unit", "the look also fades nearer than this"},
    {SWIVEL_MEMBER(look, rate), 0, kMaxValue, "radians a second",
     "the most that the line of sight turns; 0: turns are not eased"},
};

#undef SWIVEL_MEMBER

static_assert(std::all_of(std::begin(kConstants), std::end(kConstants),
                          [](const ConstantRow& row) {
                              return !row.is_of_each_joint() || std::string_view(row.structure) == "look";
                          }),
              "this count says that a look has one for each of its joints; give the constant another count");

}  // namespace

std::span<const ConstantRow> constants() { return kConstants; }

const float* values_of(const GroupDef& group, const ConstantRow& row)
{
    return reinterpret_cast<const float*>(reinterpret_cast<const std::byte*>(&group) + row.place + row.offset);
}

}  // namespace swivel
