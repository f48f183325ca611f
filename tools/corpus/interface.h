// SPDX-License-Identifier: MIT
//
// Makes the corpus's crowds in the library from recipes, writes their inputs and reads their results.
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
// Calls take(definition) with the definition that create_crowd() uses.
void with_definition(const Recipe& recipe, const LimbCounts& limb_counts,
                     const std::function<void(const swivel_crowd_def& definition)>& take);
LimbCounts limb_counts(const Crowd& crowd);

// The fields that a group has, in the order of enum swivel_field: inputs, which are written, and results, which are
// digested.
std::vector<swivel_field> inputs_of(const Crowd& crowd, std::uint32_t group = 0);
std::vector<swivel_field> results_of(const Crowd& crowd, std::uint32_t group = 0);

// values: as many floats for each limb of the group as the field has rows.
void write_field(Crowd& crowd, swivel_field field, std::uint32_t group, std::span<const float> values);
// The words of a field, limb by limb: one for each row, or for packed recipes the packed words.
std::vector<std::uint32_t> read_field(const Crowd& crowd, const Recipe& recipe, swivel_field field,
                                      std::uint32_t group);

// Clears a limb's carried state.
void reset_limb(Crowd& crowd, std::uint32_t group, std::uint32_t limb);
// Changes the support of a body's limb of one group.
struct Support {
    std::array<double, 3> position;
    std::array<float, 4> rotation;
};
void change_support(Crowd& crowd, std::uint32_t group, std::uint32_t body, const Support& from, const Support& to);

// Calls take(job) with a job that solves all, and brings the poses.
void with_job(Poses& poses, const std::function<void(const Job&)>& take);

}  // namespace swivel::corpus
