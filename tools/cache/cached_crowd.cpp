// SPDX-License-Identifier: MIT
#include "tools/cache/cached_crowd.h"

#include "swivel/swivel.hpp"

namespace swivel::tools {

namespace {

// What a crowd has beside features: characters that look, and twist bones.
constexpr swivel_features kLook = UINT64_C(1) << 63, kTwistBones = UINT64_C(1) << 62;
constexpr swivel_features kOwn = UINT64_C(1) << 61;  // the one feature that the library says the field needs

struct FieldRow {
    swivel_field field;
    swivel_features any_of;  // one of these must be there; 0: the field always is
    const char* meaning;
    std::uint32_t count = 1;  // numbers of a limb, or of a twist bone
    const char* dimension = "";
    bool is_state_alone = false;
};
constexpr FieldRow kFields[] = {
    {SWIVEL_SHOULDER, 0, "local rotation of the shoulder joint, x y z w", 4, "xyzw"},
    {SWIVEL_ELBOW, 0, "local rotation of the elbow joint, x y z w", 4, "xyzw"},
    {SWIVEL_WRIST, SWIVEL_WITH_HAND | kLook, "local rotation of the wrist joint, x y z w", 4, "xyzw"},
    {SWIVEL_FLAGS, 0, "bits of swivel_flag"},
    {SWIVEL_STRETCH, kOwn, "factor of both bone lengths"},
    {SWIVEL_NORMAL, kOwn, "unit normal of the swivel plane, arm frame", 3, "xyz"},
    {SWIVEL_TWIST_BONES, kTwistBones,
     "by how much each twist bone turns from where the clip would have it, about the forearm, x y z w", 4, "xyzw"},
    {SWIVEL_CLAVICLE_ROTATION, kOwn, "turn of the shoulder's parent joint, x y z w", 4, "xyzw"},
    {SWIVEL_PLANT, SWIVEL_WITH_PLANT, "how a foot stands, as SWIVEL_PLANT", 11, "part", true},
    {SWIVEL_SHIFT, SWIVEL_WITH_PELVIS_FIT,
     "the body's, of each limb: as SWIVEL_SHIFT, then how much higher it is than its place says", 4, "part"},
    {SWIVEL_LIFT, SWIVEL_WITH_GROUND, "how the ground lifts and turns a foot, as SWIVEL_LIFT", 9, "part", true},
    {SWIVEL_LOOK_TURNS, kLook, "how a look has turned its joints, as SWIVEL_LOOK_TURNS", 25, "part", true}};

}  // namespace

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
    constexpr std::uint32_t kLimbsInChunk = 65'536;
    const std::uint32_t limbs_in_column = carries_state ? 4'096 : kLimbsInChunk / 4;
    const auto limbs = static_cast<std::uint32_t>(limb_count);
    const std::uint32_t blocks = characters / SWIVEL_LANES + (characters % SWIVEL_LANES > 0);
    const std::uint32_t of_chunk = std::min(blocks, limbs_in_column / limbs / SWIVEL_LANES) * SWIVEL_LANES;
    return {std::clamp(kLimbsInChunk / limbs / of_chunk, 1u, frames), of_chunk};
}

std::size_t ResultField::count() const
{
    std::size_t count = 1;
    for (const std::uint64_t part : parts) count *= part;
    return count;
}

std::vector<ResultField> result_fields(const CachedCrowd& crowd)
{
    swivel_features features = crowd.look ? kLook : 0;
    std::uint32_t twist_bones = 0;
    for (const LimbSetup& limb : setups_of(crowd)) {
        features |= limb.features;
        twist_bones = std::max(twist_bones, limb.twist_bone_count);
    }
    if (twist_bones > 0) features |= kTwistBones;
    std::vector<ResultField> fields;
    for (const FieldRow& row : kFields) {
        const swivel_features any_of = row.any_of == kOwn ? describe(row.field).needs : row.any_of;
        if (any_of != 0 && (features & any_of) == 0) continue;
        fields.push_back({row.field, describe(row.field).name, row.meaning, {}, {}, row.is_state_alone});
        if (row.field == SWIVEL_TWIST_BONES)
            fields.back().parts = {twist_bones}, fields.back().part_dimensions = {"twist_bone"};
        if (row.count == 1) continue;
        fields.back().parts.push_back(row.count);
        fields.back().part_dimensions.emplace_back(row.dimension);
    }
    return fields;
}

}  // namespace swivel::tools
