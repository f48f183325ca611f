// SPDX-License-Identifier: MIT
//
// Definitions of crowds that are good, and a check that with one thing changed they are refused in one line, which
// names what is wrong. Nothing is made.
#pragma once

#include <catch2/catch.hpp>

#include <cstring>

#include "swivel/swivel_regions.h"
#include "tests/looking_bodies.h"
#include "tests/test_crowd.h"

namespace swivel::test {

template <class Good>
struct Refusal {
    const char* words;
    void (*change)(Good& good);
};

inline void check_refused(const swivel_crowd_def* def, const char* words)
{
    INFO("should say: " << words);
    auto* crowd = reinterpret_cast<swivel_crowd*>(8);
    CHECK_REFUSED(swivel_crowd_create(def, &crowd), SWIVEL_INVALID_ARGUMENT);
    CHECK_THAT(swivel_last_error(), Catch::Contains(words));
    CHECK(crowd == nullptr);
    CHECK_REFUSED(swivel_crowd_bytes(def), 0u);
}
template <class Good, std::size_t count>
void check_refusals(const Refusal<Good> (&refusals)[count])
{
    {
        Good good;
        CHECK(swivel_crowd_bytes(good.definition()) > 0);
    }
    for (const Refusal<Good>& refusal : refusals) {
        Good good;
        refusal.change(good);
        check_refused(good.definition(), refusal.words);
    }
}

// Sets a member to any number, as C allows.
template <class Enum>
void set_number(Enum& value, std::uint32_t number)
{
    std::memcpy(&value, &number, sizeof number);
}

// A good definition of each other kind, for groups that have one too many or that of another kind.
struct OtherKinds {
    const swivel_limb_joints joints = swivel_default_limb_joints(1, 2, 3);
    const swivel_limb_def free_limb = group_of(3);
    const swivel_body_limb_def body_limb = swivel_default_body_limb_def(&joints);
    const swivel_look_def look = swivel::look({0});
    const swivel_prop_def prop = swivel_default_prop_def();
    const swivel_shift_def shift = swivel_default_shift_def();
};

// Two groups of free limbs, the first of which keep to a region.
struct FreeLimbs {
    std::array<swivel_limb_def, 2> limbs = {group_of(3), group_of(4)};
    std::array<swivel_group_def, 2> groups = {c_group(limbs[0]), c_group(limbs[1])};
    swivel_crowd_def def = swivel_default_crowd_def();
    swivel_region region = swivel_default_region();
    OtherKinds other;

    FreeLimbs()
    {
        const swivel_region_cone cone{{0, 0, 1}, 0.5f};
        REQUIRE(swivel_region_add_cones(&region, &cone, 1, 0) == SWIVEL_OK);
        limbs[0].region = &region, limbs[0].features = SWIVEL_WITH_REGION;
        def.groups = groups.data(), def.group_count = 2;
    }
    const swivel_crowd_def* definition() const { return &def; }
};

// A body of joints in a line, with an arm.
struct ArmDef {
    std::array<std::int32_t, 7> parents = {-1, 0, 1, 2, 3, 4, 5};
    std::array<Float3, 7> offsets = {{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}};
    swivel_limb_joints joints[2] = {swivel_default_limb_joints(1, 2, 3), swivel_default_limb_joints(4, 5, 6)};
    std::uint32_t twist_bone = 6;
    std::array<swivel_body_limb_def, 2> limbs;
    std::array<swivel_group_def, 2> groups;
    swivel_skeleton skeleton = swivel_default_skeleton();
    swivel_crowd_def def = swivel_default_crowd_def();
    OtherKinds other;

    ArmDef()
    {
        skeleton.parents = {parents.data(), 4}, skeleton.translations = {offsets.data(), 12}, skeleton.joint_count = 7;
        for (std::size_t n = 0; n < 2; ++n) {
            joints[n].bend[1] = 1, joints[n].twist_bones = &twist_bone;
            limbs[n] = swivel_default_body_limb_def(&joints[n]);
            groups[n] = swivel_default_group_def(), groups[n].body_limb = &limbs[n];
        }
        def.skeleton = &skeleton, def.body_count = 3, def.groups = groups.data(), def.group_count = 1;
    }
    const swivel_crowd_def* definition() const { return &def; }
};

}  // namespace swivel::test
