#pragma once
// SPDX-License-Identifier: MIT
// Crowds as a fuzzer's bytes say: features that go together, groups, bindings, and inputs from ordinary to absurd.

#include <cstdint>
#include <span>
#include <vector>

#include "swivel/swivel.h"
#include "tests/fuzz/bytes.h"

namespace swivel::fuzz {

// A set of features that go together.
swivel_features features_of(Bytes& bytes);
// The same of bodies' limbs.
swivel_features body_features_of(Bytes& bytes);

// A region for a group that has the feature: of cones, a polygon and forbidden cones.
void give_region(Bytes& bytes, swivel_group_def& group);

// Each group has features and a sound binding of its own, and 1 to most_limbs limbs.
std::vector<swivel_group_def> groups_of(Bytes& bytes, std::uint32_t most_limbs);

// A limb's number in a row of a group.
inline float& number_at(const swivel_rows& rows, std::size_t limb, std::size_t row)
{
    return rows.base[(limb / SWIVEL_LANES * rows.row_count + row) * SWIVEL_LANES + limb % SWIVEL_LANES];
}

// SplitMix64 (Steele, Lea, Flood, 2014): many numbers from a few bytes.
struct Random {
    std::uint64_t state;

    std::uint64_t bits();
    float share();  // -1 to 1
    std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(bits() >> 32) % limit; }
};

// A value of a field, with as many floats as the field has. kind says how hard it is. 0 to 5: as such a field should
// be. 6: with some numbers at which formulas break. 7: any bits.
void make_value(Random& random, swivel_field field, std::uint32_t kind, std::span<float> value);

// Writes all inputs of all limbs, padding too: a kind and a seed a field and group, then single numbers here and there.
void fill_inputs(Bytes& bytes, swivel_crowd& crowd);

}  // namespace swivel::fuzz
