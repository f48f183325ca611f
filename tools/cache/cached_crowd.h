// SPDX-License-Identifier: MIT
//
// What a cache says of its crowd, beside the characters. That is the clip that they perform, the limbs, and how the
// arrays are cut. docs/cache.md has it for readers of the files.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/cache/zarr.h"
#include "tools/crowd/ground.h"
#include "tools/crowd/limb_setup.h"
#include "tools/formats/limb_name.h"

namespace swivel::tools {

// A joint that a picture of the character shows.
struct CachedJoint {
    std::string name;
    int parent;  // among them; -1: none
};

struct CachedLimb {
    formats::LimbName name;
    std::vector<int> joints;  // among the cached ones: shoulder, elbow, wrist
    LimbSetup setup;
    std::vector<goal_source> sources;  // one for each frame of the clip
};

// Heads that look, as a limb: the last one of a character.
struct CachedLook {
    LimbSetup setup;
    std::vector<goal_source> sources;
};

constexpr std::uint32_t kMaxFramesInChunk = 65'536, kMaxCharactersInChunk = 1'048'576;
// Frames and characters that one file of an array holds. Characters: a multiple of SWIVEL_LANES.
struct ChunkShape {
    std::uint32_t frames, characters;
};

struct CachedCrowd {
    std::string title, clip;   // the motion's file, and what it is
    double frame_seconds = 0;  // from frame to frame
    std::uint32_t frame_count = 0, character_count = 0;
    std::uint32_t clip_frames = 0;    // of all clips: each character plays its own round and round
    std::uint32_t budget_blocks = 0;  // of a page; a cache solves all
    std::vector<CachedJoint> joints;
    std::vector<float> positions;  // [frame of the clip][joint][3], in the world
    std::vector<CachedLimb> limbs;
    std::optional<CachedLook> look;
    // Of characters of size 1 that carry a box: its sides, and how far it is ahead of the wrists.
    std::optional<std::array<double, 4>> box;
    std::optional<Ground> ground;    // that legs stand on
    std::vector<std::string> names;  // of all characters, from a table of agents; none: they are counted
    bool has_headings = false;       // characters may be turned
    bool has_given = false;          // goals of one's own
    bool has_poses = true;           // it keeps them; goals give the same poses again on any machine
    ChunkShape chunk{1, 16};
    std::uint64_t goals_digest = 0;  // of all arrays that are written once

    // Of a character, with its look.
    std::size_t limb_count() const { return limbs.size() + (look ? 1 : 0); }
    // Chunks along the frames and along the characters.
    std::uint32_t time_count() const { return (frame_count + chunk.frames - 1) / chunk.frames; }
    std::uint32_t column_count() const { return (character_count + chunk.characters - 1) / chunk.characters; }
    std::uint32_t frames_in(std::uint32_t time) const
    {
        return std::min(chunk.frames, frame_count - time * chunk.frames);
    }
    std::uint32_t characters_in(std::uint32_t column) const
    {
        return std::min(chunk.characters, character_count - column * chunk.characters);
    }
    // The place of a character's limb in arrays [frame][limb][character] of a chunk; all three counted within it.
    std::size_t place(std::size_t frame, std::size_t limb, std::size_t character) const
    {
        return (frame * limb_count() + limb) * chunk.characters + character;
    }
    // Whether a frame's results depend on the frame before.
    bool carries_state() const;
};

// All limbs as GoalCrowd takes them, the look last. Sources live as long as the crowd.
std::vector<LimbSetup> setups_of(const CachedCrowd& crowd);
std::vector<std::span<const goal_source>> sources_of(const CachedCrowd& crowd);

// A chunk of about 64,000 limbs, whatever the memory and the number of machines. A column has up to 16,384 limbs. Where
// state is carried, one machine solves all frames of a column, so it has up to 4,096, and more machines share a crowd.
ChunkShape chunk_shape(std::uint32_t frames, std::uint32_t characters, std::size_t limb_count, bool carries_state);

// One field of the results, as an array has it.
struct ResultField {
    swivel_field field;
    const char* name;
    const char* meaning;
    std::vector<std::uint64_t> parts;          // numbers of a limb
    std::vector<std::string> part_dimensions;  // their names
    bool is_state_alone = false;               // only the next frame needs it

    std::size_t count() const;
};
// The fields that any of the limbs has, in the solver's order. Each number is 4 bytes.
std::vector<ResultField> result_fields(const CachedCrowd& crowd);

}  // namespace swivel::tools
