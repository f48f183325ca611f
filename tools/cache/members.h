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

#include "members.inc"  // kSourceMembers of a goal_source, kCharacterMembers of a goal_character

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
