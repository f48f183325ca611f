// SPDX-License-Identifier: MIT
//
// Members of the structures of goals.h as arrays: a cache keeps each member by itself, side by side for all structures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "tools/crowd/goals.h"

namespace swivel::tools {

// A member with count numbers of a Zarr type, such as <f8.
struct Member {
    const char* name;
    const char* type;
    std::size_t offset, count;
    const char* meaning;

    std::size_t bytes() const { return count * static_cast<std::size_t>(type[2] - '0'); }
};

constexpr Member kSourceMembers[] = {
    {"elbow", "<f8", offsetof(goal_source, elbow), 3, "elbow from the shoulder, world axes, the clip's unit"},
    {"wrist", "<f8", offsetof(goal_source, wrist), 3, "wrist from the shoulder, world axes, the clip's unit"},
    {"hand", "<f8", offsetof(goal_source, hand), 4, "world rotation of the hand, x y z w"},
    {"lengths", "<f8", offsetof(goal_source, lengths), 2, "upper arm and forearm, the clip's unit"},
    {"origin", "<f8", offsetof(goal_source, origin), 3, "the shoulder in the world, the clip's unit"},
    {"root", "<f8", offsetof(goal_source, root), 3, "where the pose hangs, in the world, the clip's unit"},
    {"parent", "<f4", offsetof(goal_source, parent), 4, "world rotation of the shoulder's parent joint, x y z w"},
    {"shoulder", "<f4", offsetof(goal_source, shoulder), 4, "the clip's own local rotation, x y z w"},
    {"elbow_local", "<f4", offsetof(goal_source, elbow_local), 4, "the clip's own local rotation, x y z w"},
    {"wrist_local", "<f4", offsetof(goal_source, wrist_local), 4, "the clip's own local rotation, x y z w"},
    {"contact", "<f4", offsetof(goal_source, contact), 1, "1 while the foot is on the ground"},
    {"carried", "<f8", offsetof(goal_source, carried), 3, "from the shoulder, the wrist of who carries a box"},
    {"carries", "<u4", offsetof(goal_source, carries), 1, "1: the arm of who carries a box follows carried"},
    {"stand", "<u4", offsetof(goal_source, stride.stand), 1,
     "middle frame of the stand that the foot is in or comes from"},
    {"leaves", "<u4", offsetof(goal_source, stride.leaves), 1, "frame after that stand; 0: the limb never stands"},
    {"lands", "<u4", offsetof(goal_source, stride.lands), 1, "first frame of the next stand"},
    {"next", "<u4", offsetof(goal_source, stride.next), 1, "middle frame of the next stand"}};

constexpr Member kCharacterMembers[] = {
    {"size", "<f8", offsetof(goal_character, size), 1, "factor of all lengths, also of the way it goes"},
    {"place", "<f8", offsetof(goal_character, place), 3, "in the world, of the clip's origin; the clip's unit"},
    {"start", "<u4", offsetof(goal_character, start), 1, "frame of its clip that it starts at"},
    {"wish", "<f4", offsetof(goal_character, wish), 1, "the shift where no leg asks for another; below 0 is lower"},
    {"first", "<u4", offsetof(goal_character, first), 1, "first frame of its clip"},
    {"count", "<u4", offsetof(goal_character, count), 1, "frames of its clip, which it plays round and round"},
    {"carries", "<u4", offsetof(goal_character, carries), 1, "1: it carries a box"}};

// The member of all structures, side by side, and zeros up to that many rows.
template <class Struct>
std::vector<std::byte> gathered(std::span<const Struct> from, const Member& member, std::size_t rows)
{
    std::vector<std::byte> out(rows * member.bytes());
    for (std::size_t n = 0; n < from.size(); ++n)
        std::memcpy(&out[n * member.bytes()], reinterpret_cast<const std::byte*>(&from[n]) + member.offset,
                    member.bytes());
    return out;
}

// The way back, for as many structures as there are.
template <class Struct>
void scatter(std::span<const std::byte> from, const Member& member, std::span<Struct> to)
{
    for (std::size_t n = 0; n < to.size(); ++n)
        std::memcpy(reinterpret_cast<std::byte*>(&to[n]) + member.offset, &from[n * member.bytes()], member.bytes());
}

}  // namespace swivel::tools
