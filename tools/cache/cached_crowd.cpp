// SPDX-License-Identifier: MIT
#include "tools/cache/cached_crowd.h"

#include "swivel/swivel.hpp"

namespace swivel::tools {

bool CachedCrowd::carries_state() const
{
    swivel_features carrying = SWIVEL_WITH_PELVIS_FIT;  // its body's shift
    swivel_field_info info;
    for (std::uint32_t n = 0; swivel_describe_field(n, &info); ++n)
        if (info.kind == SWIVEL_FIELD_CARRIED) carrying |= info.needs;
    return look || std::ranges::any_of(limbs, [&](const CachedLimb& limb) { return limb.setup.has(carrying); });
}

std::vector<LimbSetup> setups_of(const CachedCrowd& crowd)
{
    std::vector<LimbSetup> setups;
    for (const CachedLimb& limb : crowd.limbs) setups.push_back(limb.setup);
    if (crowd.look) setups.push_back(crowd.look->setup);
    return setups;
}

std::vector<std::span<const goal_source>> sources_of(const CachedCrowd& crowd)
{
    std::vector<std::span<const goal_source>> sources;
    for (const CachedLimb& limb : crowd.limbs) sources.push_back(limb.sources);
    if (crowd.look) sources.push_back(crowd.look->sources);
    return sources;
}

ChunkShape chunk_shape(std::uint32_t frames, std::uint32_t characters, std::size_t limb_count, bool carries_state)
{
    constexpr std::uint32_t kLimbsInChunk = 65'536, kLimbsInColumn = 4'096;
    const std::uint64_t blocks = (std::uint64_t{characters} + SWIVEL_LANES - 1) / SWIVEL_LANES;
    const auto max = static_cast<std::uint32_t>(kLimbsInChunk / limb_count);
    const auto max_wide = carries_state ? static_cast<std::uint32_t>(kLimbsInColumn / limb_count) : max / 4;
    const auto of_chunk =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(blocks, max_wide / SWIVEL_LANES)) * SWIVEL_LANES;
    return {std::clamp(max / of_chunk, 1u, frames), of_chunk};
}

std::size_t ResultField::count() const
{
    std::size_t count = 1;
    for (const std::uint64_t part : parts) count *= part;
    return count;
}

std::vector<ResultField> result_fields(const CachedCrowd& crowd)
{
    swivel_features features = 0;
    std::uint32_t twist_bones = 0;
    for (const LimbSetup& limb : setups_of(crowd)) {
        features |= limb.features;
        twist_bones = std::max(twist_bones, limb.twist_bone_count);
    }
    const auto has = [&](swivel_features feature) { return (features & feature) != 0; };
    std::vector<ResultField> fields{
        {SWIVEL_SHOULDER, "shoulder", "local rotation of the shoulder joint, x y z w", {4}, {"xyzw"}},
        {SWIVEL_ELBOW, "elbow", "local rotation of the elbow joint, x y z w", {4}, {"xyzw"}}};
    if (has(SWIVEL_WITH_HAND) || crowd.look)
        fields.push_back({SWIVEL_WRIST, "wrist", "local rotation of the wrist joint, x y z w", {4}, {"xyzw"}});
    fields.push_back({SWIVEL_FLAGS, "flags", "bits of swivel_flag", {}, {}});
    if (has(SWIVEL_WITH_REACH)) fields.push_back({SWIVEL_STRETCH, "stretch", "factor of both bone lengths", {}, {}});
    if (has(describe(SWIVEL_NORMAL).needs))
        fields.push_back({SWIVEL_NORMAL, "normal", "unit normal of the swivel plane, arm frame", {3}, {"xyz"}});
    if (twist_bones > 0)
        fields.push_back(
            {SWIVEL_TWIST_BONES,
             "twist_bones",
             "by how much each twist bone turns from where the clip would have it, about the forearm, x y z w",
             {twist_bones, 4},
             {"twist_bone", "xyzw"}});
    if (has(SWIVEL_WITH_CLAVICLE))
        fields.push_back({SWIVEL_CLAVICLE_ROTATION,
                          "clavicle_rotation",
                          "turn of the shoulder's parent joint, x y z w",
                          {4},
                          {"xyzw"}});
    if (has(SWIVEL_WITH_PLANT))
        fields.push_back({SWIVEL_PLANT, "plant", "how a foot stands, as SWIVEL_PLANT", {11}, {"part"}, true});
    if (has(SWIVEL_WITH_PELVIS_FIT))
        fields.push_back({SWIVEL_SHIFT,
                          "shift",
                          "the body's, of each limb: as SWIVEL_SHIFT, then how much higher it is than its place says",
                          {4},
                          {"part"}});
    if (has(SWIVEL_WITH_GROUND))
        fields.push_back(
            {SWIVEL_LIFT, "lift", "how the ground lifts and turns a foot, as SWIVEL_LIFT", {9}, {"part"}, true});
    if (crowd.look)
        fields.push_back({SWIVEL_LOOK_TURNS,
                          "look_turns",
                          "how a look has turned its joints, as SWIVEL_LOOK_TURNS",
                          {25},
                          {"part"},
                          true});
    return fields;
}

}  // namespace swivel::tools
