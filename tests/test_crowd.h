// SPDX-License-Identifier: MIT
//
// What tests of swivel.h's contract share: groups and defs to start from, the whole of a crowd as words, and a check of
// calls that must fail.
#pragma once

#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swivel/swivel.hpp"
#include "tests/three_joints.h"

namespace swivel::test {

// Every field there is, inputs first.
inline std::vector<swivel_field> every_field()
{
    std::vector<swivel_field> fields;
    for (int f = 0; f < SWIVEL_INPUT_END; ++f) fields.push_back(static_cast<swivel_field>(f));
    for (int f = SWIVEL_SHOULDER; f < SWIVEL_RESULT_END; ++f) fields.push_back(static_cast<swivel_field>(f));
    return fields;
}

// Whether the library says of a field that one of its functions makes the values.
inline bool is_made_by(std::string_view function, swivel_field field)
{
    return std::string_view(describe(field).range).find(function) != std::string_view::npos;
}

// The features of arms that nothing more is asked of, and every set of them that a group may have.
inline constexpr swivel_features kEverything = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_POLE_DIRECTION;
inline std::vector<swivel_features> every_plain_set()
{
    std::vector<swivel_features> sets;
    for (const swivel_features world : {swivel_features{0}, SWIVEL_WORLD, SWIVEL_WORLD | SWIVEL_POLE_DIRECTION})
        for (const swivel_features joints : {swivel_features{0}, SWIVEL_JOINTS})
            for (const swivel_features hand : {swivel_features{0}, SWIVEL_WITH_HAND})
                sets.push_back(world | joints | hand);
    return sets;
}

// Features that say where elbows go.
inline constexpr swivel_features kPoleFeatures =
    SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL | SWIVEL_POLE_INCOMING | SWIVEL_POLE_HAND | SWIVEL_POLE_HALF_LINE;
// Whether a set of features has all that they need, and none that they exclude.
inline bool is_whole(swivel_features features)
{
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
        if ((features & info.feature) && ((features & info.needs) != info.needs || (features & info.excludes)))
            return false;
    return true;
}
// These features of free limbs, and every further one that goes with those before it in the library's order, but for
// those that are left out.
inline swivel_features all_beside(swivel_features features, swivel_features left_out)
{
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n) {
        const bool may_be = (info.kinds >> SWIVEL_KIND_LIMB & 1) != 0 && !(info.feature & left_out);
        if (may_be && is_whole(features | info.feature)) features |= info.feature;
    }
    return features;
}

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

inline bool is_one_line(const std::string& text)
{
    return !text.empty() && text.find('\n') == std::string::npos && text.size() < 256;
}

// A failed call leaves one line of its own.
#define CHECK_REFUSED(call, expected)                        \
    do {                                                     \
        swivel_use_isa("no such thing"); /* another line */  \
        const std::string line_before = swivel_last_error(); \
        CHECK((call) == (expected));                         \
        CHECK(is_one_line(swivel_last_error()));             \
        CHECK(swivel_last_error() != line_before);           \
    } while (false)

// One limb's value of a field, and its flags.
template <class Value>
Value value_of(const Crowd& crowd, swivel_field field, std::uint32_t group, std::uint32_t limb)
{
    Value value;
    check(swivel_read(crowd.get(), field, group, limb, 1, {&value, sizeof value}));
    return value;
}
inline std::uint32_t flags_of(const Crowd& crowd, std::uint32_t group, std::uint32_t limb)
{
    return value_of<std::uint32_t>(crowd, SWIVEL_FLAGS, group, limb);
}

// Limbs whose joints are the arm frame, with bones of length 1.
inline swivel_limb_def group_of(std::uint32_t limb_count)
{
    swivel_limb_def made = limbs(limb_count);
    made.binding = arm_frame_joints().bound();
    return made;
}
// The same features for all groups.
inline Crowd crowd_with(swivel_features features, std::vector<swivel_limb_def> groups)
{
    for (swivel_limb_def& group : groups) group.features = features;
    return Crowd(std::vector<Definition>(groups.begin(), groups.end()));
}
inline Crowd crowd_with(swivel_features features, std::span<const swivel_limb_def> groups)
{
    return crowd_with(features, std::vector(groups.begin(), groups.end()));
}

// Groups as C has them. They point to the definitions that they are made of, which must outlive them.
inline swivel_group_def c_group(const swivel_limb_def& limb)
{
    swivel_group_def group = swivel_default_group_def();
    group.limb = &limb;
    return group;
}
swivel_group_def c_group(const swivel_limb_def&&) = delete;
inline std::vector<swivel_group_def> c_groups(std::span<const Definition> definitions)
{
    std::vector<swivel_group_def> groups(definitions.size(), swivel_default_group_def());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        groups[g].limb = std::get_if<swivel_limb_def>(&definitions[g]);
        groups[g].body_limb = std::get_if<swivel_body_limb_def>(&definitions[g]);
        groups[g].look = std::get_if<swivel_look_def>(&definitions[g]);
        groups[g].prop = std::get_if<swivel_prop_def>(&definitions[g]);
        groups[g].shift = std::get_if<swivel_shift_def>(&definitions[g]);
    }
    return groups;
}
inline swivel_crowd_def def_of(const swivel_group_def& group)
{
    swivel_crowd_def def = swivel_default_crowd_def();
    def.group_count = 1;
    def.groups = &group;
    return def;
}

inline std::size_t float_count(const swivel_rows& rows)
{
    return std::size_t{rows.block_count} * rows.row_count * SWIVEL_LANES;
}
// The whole of a crowd's rows.
inline std::vector<std::uint32_t> all_words(const Crowd& crowd)
{
    std::vector<std::uint32_t> words;
    for (std::uint32_t group = 0; group < swivel_group_count(crowd.get()); ++group)
        for (const swivel_rows rows : {swivel_input_rows(crowd.get(), group), swivel_result_rows(crowd.get(), group)}) {
            const std::size_t at = words.size();
            words.resize(at + float_count(rows));
            std::memcpy(words.data() + at, rows.base, float_count(rows) * sizeof(float));
        }
    return words;
}

}  // namespace swivel::test
