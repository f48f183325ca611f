#pragma once
// SPDX-License-Identifier: MIT
// Crowds as a fuzzer's bytes say: features that go together, groups, bindings, inputs from ordinary to absurd, and
// bodies.

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "swivel/swivel_bodies.h"
#include "swivel/swivel_regions.h"
#include "tests/fuzz/bytes.h"

namespace swivel::fuzz {

// Features that go together, and how many twist bones go with them.
struct LimbFeatures {
    swivel_features features = 0;
    std::uint32_t twist_bones = 0;
};
// Those of free limbs, or of bodies' limbs.
LimbFeatures features_of(Bytes& bytes, swivel_kind kind);
// The feature that a bit stands for in seeds; for others one that does not exist.
swivel_features feature_of_bit(std::uint32_t bit);

// A region for a limb that has the feature: of cones, a polygon and forbidden cones. Null without the feature.
const swivel_region* region_of(Bytes& bytes, swivel_features features);

// Groups of free limbs. Each has features and a sound binding of its own, and 1 to max_limbs limbs.
std::vector<swivel_limb_def> limb_defs_of(Bytes& bytes, std::uint32_t max_limbs);

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
// The same in a caller's array, of any alignment: `count` numbers of number_bytes. Doubles are wide times as large.
void put_value(Random& random, swivel_field field, std::uint32_t kind, std::size_t count, char* at,
               std::size_t number_bytes = sizeof(float), double wide = 1);
// Three doubles far from 0, or of any bits.
void put_place(Random& random, bool any_bits, char* at);

// What the library says of a field; all is 0 for one that there is not.
swivel_field_info described(swivel_field field);

// Writes all inputs of all limbs, padding too: a kind and a seed a field and group, then single numbers here and there.
void fill_inputs(Bytes& bytes, swivel_crowd& crowd);

// A group of bodies. It has a definition of each kind, of which that of its own kind counts: so a byte that spoils one
// means the same whatever the kind is.
struct BodyGroup {
    swivel_kind kind = SWIVEL_KIND_BODY_LIMB;
    swivel_body_limb_def limb = swivel_default_body_limb_def(nullptr);
    swivel_look_def look = swivel_default_look_def();
    swivel_prop_def prop = swivel_default_prop_def();
    swivel_shift_def shift = swivel_default_shift_def();
    std::uint32_t definition_count = 1;  // that def() points to

    bool has(swivel_features features) const
    {
        return kind == SWIVEL_KIND_BODY_LIMB && (limb.features & features) != 0;
    }
    bool keeps_pose() const { return kind != SWIVEL_KIND_BODY_LIMB || limb.on_bad_input == SWIVEL_KEEP_POSE; }
    swivel_group_def def() const;  // it points to parts of this
};

// Bodies: a skeleton with limbs beside each other, which may hold each other or things, and the same spoilt in some
// places.
struct BodyDef {
    std::vector<std::int32_t> parents = {};
    std::vector<float> rotations = {}, translations = {};
    std::vector<swivel_limb_joints> joints = {};  // of each group that is a limb; they come first
    std::vector<std::vector<std::uint32_t>> twist_bones = {};
    swivel_skeleton skeleton = swivel_default_skeleton();
    std::vector<BodyGroup> groups = {};
    std::vector<swivel_group_def> defs = {};  // that crowd_def() points to
    std::uint32_t body_count = 0;
    std::array<float, 3> up = {0, 1, 0};
    bool is_sound = true;

    BodyDef(Bytes& bytes, std::uint32_t max_bodies);
    BodyDef(const BodyDef&) = delete;  // its parts point to each other

    std::uint32_t joint_count() const { return static_cast<std::uint32_t>(parents.size()); }
    // A def of that many bodies, which views this.
    swivel_crowd_def crowd_def(std::uint32_t bodies);
    // These are of a crowd that could be made. Whether a group's limb has the joint, or one below it.
    bool is_needed(std::uint32_t joint) const;
    // The joints that a group's limb turns, and those with what is below them.
    std::vector<std::uint32_t> turned_joints(std::uint32_t group) const;
    std::vector<std::uint32_t> moved_joints(std::uint32_t group) const;
    // Whether a solve of any pose may look at a joint.
    bool is_seen(std::uint32_t joint) const;

private:
    swivel_limb_joints limb_of(std::uint32_t group) const;  // as far as its size says
    std::int32_t add(Random& random, std::int32_t parent);
    bool is_above(std::uint32_t joint, std::uint32_t below) const;
    void take_limb(Bytes& bytes, Random& random, std::uint32_t trunk, const LimbFeatures& features);
    void add_shift();
    void take_links(Bytes& bytes, std::uint32_t trunk);
    void link_to_prop(Bytes& bytes, std::uint32_t trunk, BodyGroup& group);
    void take_looks(Bytes& bytes, std::uint32_t trunk);
    void add_look(Bytes& bytes, const std::uint32_t* joints, std::size_t count);
    void take_constants(Bytes& bytes);
    struct Words {
        void* begin;
        std::size_t count;
    };
    void spoil_word(Bytes& bytes, std::initializer_list<Words> parts) const;
    void spoil(Bytes& bytes);
};

}  // namespace swivel::fuzz
