// SPDX-License-Identifier: MIT
//
// The corpus's only contact with the library: crowds made, written and read by the corpus's own features, fields and
// flags. When the library renames or reorders any of its own, interface.cpp follows and nothing else does.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/corpus/poses.h"
#include "tools/corpus/recipe.h"

namespace swivel::corpus {

using LimbCounts = std::array<std::uint32_t, kGroupCount>;

// An empty crowd of three groups with bindings of its own, or of bodies, of which each group has a limb.
Crowd create_crowd(const Recipe& recipe, const LimbCounts& limb_counts);
// Calls take(definition) with what create_crowd() makes that crowd of: the library's own definition of a crowd, by a
// pointer that says nothing, because interface.cpp alone names it here.
void with_definition(const Recipe& recipe, const LimbCounts& limb_counts,
                     const std::function<void(const void* definition)>& take);
LimbCounts limb_counts(const Crowd& crowd);

// The fields that a group has, in the order of enum Field: inputs, which are written, and results, which are digested
// in this order.
std::vector<Field> inputs_of(const Crowd& crowd, std::uint32_t group = 0);
std::vector<Field> results_of(const Crowd& crowd, std::uint32_t group = 0);

// Floats of a field's value, or the one word of flags; 0 if the group lacks it.
std::uint32_t component_count(const Crowd& crowd, Field field, std::uint32_t group);

// A group's own numbers of rows: what the fields of a recipe must add up to.
std::uint32_t input_row_count(const Crowd& crowd, std::uint32_t group);
std::uint32_t result_row_count(const Crowd& crowd, std::uint32_t group);

// values: component_count() floats for each limb of the group.
void write_field(Crowd& crowd, Field field, std::uint32_t group, std::span<const float> values);
// The words of a field, limb by limb: its component_count() floats, or what results are packed into with kCompact. Flag
// words have the corpus's bits.
std::vector<std::uint32_t> read_field(const Crowd& crowd, const Recipe& recipe, Field field, std::uint32_t group);

// Clears what a limb carries. The groups after the limbs' are the shift, the prop and the looks, where there are any.
void reset_limb(Crowd& crowd, std::uint32_t group, std::uint32_t limb);
// Changes what a body's limb of one group stands on.
struct Support {
    std::array<double, 3> position;
    std::array<float, 4> rotation;
};
void change_support(Crowd& crowd, std::uint32_t group, std::uint32_t body, const Support& from, const Support& to);
void write_shift_wishes(Crowd& crowd, std::span<const float> wishes);
// The caller's inputs of props, body by body: places, unless they are empty, rotations and shares.
struct PropRows {
    std::vector<float> places, turns, shares;
};
void write_props(Crowd& crowd, const PropRows& props);
// The targets of looks, body by body: places, unless they are empty, and weights.
struct LookRows {
    std::vector<float> targets, weights;
};
void write_looks(Crowd& crowd, const std::array<LookRows, kLookCount>& looks);

// Calls take(job) with a job that solves all, and brings the poses.
void with_job(Poses& poses, const std::function<void(const Job&)>& take);

}  // namespace swivel::corpus
