// SPDX-License-Identifier: MIT
//
// The promise: a crowd that cannot be, and a limb that cannot be bound, are refused in one line, which names what is
// wrong. Nothing is made, and nothing changes. Each row is a good definition with one thing changed.
#include <catch2/catch.hpp>

#include <cstring>

#include "tests/looking_bodies.h"
#include "tests/posed_bodies.h"
#include "tests/test_crowd.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

template <class Good>
struct Refusal {
    const char* words;
    void (*change)(Good& good);
};

void check_refused(const swivel_crowd_def* def, const char* words)
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
void set(Enum& value, std::uint32_t number)
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

// Limbs that hold each other and props, in groups as HoldingBodies names them.
struct HoldingDef {
    Random random{4};
    HoldingBodies bodies{random, 3, PoseLayout{}};
    swivel_skeleton skeleton = bodies.skeleton.view();
    std::vector<swivel_group_def> groups;
    swivel_crowd_def def = swivel_default_crowd_def();

    HoldingDef() { def.skeleton = &skeleton, def.body_count = 3; }
    const swivel_crowd_def* definition()
    {
        groups = c_groups(bodies.groups);
        def.groups = groups.data(), def.group_count = static_cast<std::uint32_t>(groups.size());
        return &def;
    }
    swivel_limb_joints& joints(std::uint32_t group) { return bodies.joints[bodies.limb_of[group]]; }
    swivel_body_limb_def& limb(std::uint32_t group) { return bodies.limb_def(group); }
    swivel_prop_def& prop(std::uint32_t group) { return std::get<swivel_prop_def>(bodies.groups[group]); }
    swivel_shift_def& shift() { return std::get<swivel_shift_def>(bodies.groups[HoldingBodies::shift]); }
};
using H = HoldingBodies;

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

// A spine, a neck and a head that look; a second group looks, too, if a row says so.
struct LookDef {
    Upright figure;
    std::array<swivel_look_def, 2> looks = {figure.look, figure.look};
    swivel_look_def& look = looks[0];
    std::array<swivel_group_def, 2> groups = {swivel_default_group_def(), swivel_default_group_def()};
    swivel_skeleton skeleton = figure.skeleton.view();
    swivel_crowd_def def = swivel_default_crowd_def();

    LookDef()
    {
        groups[0].look = &looks[0], groups[1].look = &looks[1];
        def.skeleton = &skeleton, def.body_count = 1, def.groups = groups.data(), def.group_count = 1;
    }
    const swivel_crowd_def* definition() const { return &def; }
};

}  // namespace

TEST_CASE("a crowd of free limbs that cannot be is refused")
{
    check_refused(nullptr, "crowd def is null");
    const FreeLimbs good;
    CHECK_REFUSED(swivel_crowd_create(&good.def, nullptr), SWIVEL_INVALID_ARGUMENT);
    check_refusals<FreeLimbs>({
        {"crowd def has size 0; start from its default", [](auto& d) { d.def.size = 0; }},
        {"build with the header of the library that you link", [](auto& d) { d.def.size += 8; }},
        {"crowd def has size 18446744073709551615", [](auto& d) { d.def.size = ~std::size_t{0}; }},
        {"the first group def has size 0", [](auto& d) { d.groups[0].size = 0; }},
        {"the first group def has size ", [](auto& d) { d.groups[0].size -= 4; }},
        {"build with the header of the library that you link", [](auto& d) { d.groups[0].size += 8; }},
        {"group def 1 has size ", [](auto& d) { d.groups[1].size -= 8; }},
        {"crowd def has no groups; give at least one", [](auto& d) { d.def.group_count = 0; }},
        {"crowd def has no groups; give at least one", [](auto& d) { d.def.groups = nullptr; }},
        {"crowd def has 65 workspaces, 64 are the most", [](auto& d) { d.def.workspace_count = 65; }},
        {"crowd def has 3 bodies, but no skeleton; give it", [](auto& d) { d.def.body_count = 3; }},
        {"one of allocate and release; give both or none",
         [](auto& d) { d.def.allocate = [](std::size_t, std::size_t, void*) -> void* { return nullptr; }; }},
        {"one of allocate and release; give both or none",
         [](auto& d) { d.def.release = [](void*, std::size_t, void*) {}; }},
        {"group 1 has 0 definitions; give one: limb, body_limb, look, prop or shift",
         [](auto& d) { d.groups[1].limb = nullptr; }},
        {"group 1 has 2 definitions; give one", [](auto& d) { d.groups[1].body_limb = &d.other.body_limb; }},
        {"group 0 has 2 definitions; give one", [](auto& d) { d.groups[0].look = &d.other.look; }},
        {"group 0 has 3 definitions; give one",
         [](auto& d) { d.groups[0].prop = &d.other.prop, d.groups[0].shift = &d.other.shift; }},
        {"group 1 is of bodies, but the crowd def has no skeleton; give it",
         [](auto& d) { d.groups[1].limb = nullptr, d.groups[1].body_limb = &d.other.body_limb; }},
        {"group 1 is of bodies, but the crowd def has no skeleton; give it",
         [](auto& d) { d.groups[1].limb = nullptr, d.groups[1].look = &d.other.look; }},
        {"group 1 is of bodies, but the crowd def has no skeleton; give it",
         [](auto& d) { d.groups[1].limb = nullptr, d.groups[1].prop = &d.other.prop; }},
        {"group 1 is of bodies, but the crowd def has no skeleton; give it",
         [](auto& d) { d.groups[1].limb = nullptr, d.groups[1].shift = &d.other.shift; }},
        {"group 0: limb def has size 0; start from its default", [](auto& d) { d.limbs[0].size = 0; }},
        {"group 1: limb def has size ", [](auto& d) { d.limbs[1].size -= 4; }},
        {"build with the header of the library that you link", [](auto& d) { d.limbs[1].size += 8; }},
        {"group 1 has no limbs; give at least one", [](auto& d) { d.limbs[1].limb_count = 0; }},
        // Together 2^32 limbs: counts must not wrap.
        {"more than 2^31 limbs", [](auto& d) { d.limbs[0].limb_count = d.limbs[1].limb_count = 0x80000000u; }},
        {"more than 2^31 limbs", [](auto& d) { d.limbs[0].limb_count = ~0u, d.limbs[1].limb_count = 1; }},
        {"group 1: shoulder_order is 6", [](auto& d) { set(d.limbs[1].shoulder_order, SWIVEL_ZYX + 1); }},
        {"group 0: wrist_order is 7", [](auto& d) { set(d.limbs[0].wrist_order, 7); }},
        {"group 0: on_bad_input is 2", [](auto& d) { set(d.limbs[0].on_bad_input, 2); }},
        {"group 1: twist bones need SWIVEL_WITH_HAND; add it", [](auto& d) { d.limbs[1].twist_bone_count = 1; }},
        {"group 1: twist_bone_count is 8; it is 0 to 7",
         [](auto& d) { d.limbs[1].twist_bone_count = 8, d.limbs[1].features = SWIVEL_WITH_HAND; }},
        {"group 0: twist_bone_count is 4294967295; it is 0 to 7",
         [](auto& d) { d.limbs[0].twist_bone_count = ~0u, d.limbs[0].features |= SWIVEL_WITH_HAND; }},
        {"group 0: SWIVEL_WITH_REGION needs a region; give it", [](auto& d) { d.limbs[0].region = nullptr; }},
        {"group 1: SWIVEL_WITH_REGION needs a region; give it",
         [](auto& d) { d.limbs[1].features = SWIVEL_WITH_REGION; }},
        {"group 0 has a region, but not SWIVEL_WITH_REGION; add it", [](auto& d) { d.limbs[0].features = 0; }},
        {"group 0: the region allows nothing", [](auto& d) { d.region = swivel_default_region(); }},
        {"group 0: half-space 0 of the region needs a unit axis",
         [](auto& d) { d.region.half_space[0].axis[2] = 1.1f; }},
        {"group 0: the region's size is 8", [](auto& d) { d.region.size = 8; }},
    });
}

TEST_CASE("features that no group has, that lack another or that exclude each other are refused")
{
    swivel_features known = 0;
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n) known |= info.feature;
    const auto refuse = [](swivel_features features, const char* words) {
        INFO("features " << features);
        FreeLimbs good;
        good.limbs[1].features = features;
        check_refused(&good.def, words);
    };
    for (int bit = 0; bit < 64; ++bit)  // also those that the library has for itself
        if (const swivel_features feature = UINT64_C(1) << bit; !(feature & known)) {
            refuse(SWIVEL_WITH_HAND | feature, "group 1 asks for unknown features: bits 0x");
            ArmDef bodies;
            bodies.limbs[0].features |= feature;
            check_refused(&bodies.def, "group 0 asks for unknown features: bits 0x");
        }
    for (const swivel_features more : std::initializer_list<swivel_features>{0, SWIVEL_JOINTS, SWIVEL_WITH_HAND})
        refuse(SWIVEL_POLE_DIRECTION | more, "group 1: SWIVEL_POLE_DIRECTION needs SWIVEL_WORLD; add it");
    for (const swivel_features feature : {SWIVEL_WITH_EFFECTOR, SWIVEL_WITH_HAND_CONE, SWIVEL_WITH_FOREARM_TWIST,
                                          SWIVEL_WITH_HAND_TWIST, SWIVEL_WITH_WRIST_BOX})
        refuse(feature, "needs SWIVEL_WITH_HAND; add it");
    for (const swivel_features feature : {SWIVEL_POLE_INCOMING, SWIVEL_WITH_WEIGHTS})
        refuse(feature, "needs SWIVEL_WITH_INCOMING; add it");
    constexpr swivel_features kPoles[] = {SWIVEL_POLE_DIRECTION, SWIVEL_POLE_NORMAL, SWIVEL_POLE_INCOMING,
                                          SWIVEL_POLE_HAND};
    for (const swivel_features a : kPoles)
        for (const swivel_features b : kPoles)
            if (a != b) refuse(a | b | SWIVEL_WORLD | SWIVEL_WITH_INCOMING | SWIVEL_WITH_HAND, "excludes SWIVEL_POLE_");
}

TEST_CASE("a feature that a kind of limb may not have is refused")
{
    constexpr std::uint32_t kFree = 1u << SWIVEL_KIND_LIMB, kOfBody = 1u << SWIVEL_KIND_BODY_LIMB;
    std::vector<std::string> free_alone, of_body_alone;
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n) {
        const std::string name = std::string("SWIVEL_") + info.name;
        INFO(name);
        CHECK((info.kinds == kFree || info.kinds == kOfBody || info.kinds == (kFree | kOfBody)));
        if (info.kinds == kFree) {
            ArmDef good;
            good.limbs[0].features |= info.feature;
            check_refused(&good.def, ("group 0: " + name + " is not for a body's limb; leave it out").c_str());
            free_alone.push_back(info.name);
        }
        if (info.kinds == kOfBody) {
            FreeLimbs good;
            good.limbs[1].features |= info.feature;
            check_refused(&good.def, ("group 1: " + name + " is not for a free limb; leave it out").c_str());
            of_body_alone.push_back(info.name);
        }
    }
    std::ranges::sort(free_alone), std::ranges::sort(of_body_alone);
    CHECK(free_alone == std::vector<std::string>{"JOINTS", "WITH_INCOMING", "WORLD"});
    CHECK(of_body_alone == std::vector<std::string>{"PLANT_BY_MOTION", "WITH_GROUND", "WITH_HAND_TRANSFORM",
                                                    "WITH_LINK", "WITH_NEXT_TARGET", "WITH_PELVIS_FIT", "WITH_PLANT",
                                                    "WITH_PLANT_ROTATION", "WITH_RECORD"});
}

TEST_CASE("a crowd of bodies that cannot be is refused")
{
    check_refusals<ArmDef>({
        {"crowd def has a skeleton, but no bodies", [](auto& d) { d.def.body_count = 0; }},
        {"but no skeleton; give it", [](auto& d) { d.def.skeleton = nullptr; }},
        {"group 0 has 0 definitions; give one", [](auto& d) { d.groups[0].body_limb = nullptr; }},
        {"group 0 has 2 definitions; give one", [](auto& d) { d.groups[0].limb = &d.other.free_limb; }},
        {"group 0 is of free limbs, but the crowd def has a skeleton; give a body_limb, or leave the skeleton out",
         [](auto& d) { d.groups[0].body_limb = nullptr, d.groups[0].limb = &d.other.free_limb; }},
        {"group 0: body limb def has size 0; start from its default", [](auto& d) { d.limbs[0].size = 0; }},
        {"group 0: body limb def has size ", [](auto& d) { d.limbs[0].size -= 4; }},
        {"build with the header of the library that you link", [](auto& d) { d.limbs[0].size += 8; }},
        {"group 0: on_bad_input is 2", [](auto& d) { set(d.limbs[0].on_bad_input, 2); }},
        {"group 0 has a region, but not SWIVEL_WITH_REGION; add it",
         [](auto& d) {
             static const swivel_region region = swivel_default_region();
             d.limbs[0].region = &region;
         }},
        {"group 0 names no joints; give it those of the body's limb", [](auto& d) { d.limbs[0].joints = nullptr; }},
        {"group 0 turns joint 1, which is also joint 1 of group 1",
         [](auto& d) { d.joints[1] = d.joints[0], d.def.group_count = 2; }},
        {"group 0 turns joint 1, which is above joint 4 of group 1", [](auto& d) { d.def.group_count = 2; }},
        {"group 0: the elbow, joint 0, is not below", [](auto& d) { d.joints[0].elbow = 0; }},
        {"group 0: twist bones need SWIVEL_WITH_HAND; add it", [](auto& d) { d.joints[0].twist_bone_count = 1; }},
        {"group 0: there are 8 twist bones; a limb has at most 7",
         [](auto& d) { d.joints[0].twist_bone_count = 8, d.limbs[0].features = SWIVEL_WITH_HAND; }},
        {"group 0: the shoulder, joint 0, has no parent",
         [](auto& d) { d.joints[0].shoulder = 0, d.limbs[0].features |= SWIVEL_WITH_CLAVICLE; }},
        {"joint 6's parent is 900; give -1 for a root", [](auto& d) { d.parents[6] = 900; }},  // no limb needs it
        {"skeleton has size 0", [](auto& d) { d.skeleton.size = 0; }},
        {"skeleton: reserved is not 0", [](auto& d) { d.skeleton.reserved = 1; }},
        {"limb joints has size 0", [](auto& d) { d.joints[0].size = 0; }},
    });
}

TEST_CASE("links and props that cannot be are refused")
{
    check_refusals<HoldingDef>({
        {"group 5 is linked to group 5, which is solved later",
         [](auto& d) { d.limb(H::follower).link = H::follower; }},
        {"group 4 is linked to group 5, which is solved later",
         [](auto& d) { d.limb(H::free).features |= SWIVEL_WITH_LINK, d.limb(H::free).link = H::follower; }},
        {"group 5 is SWIVEL_WITH_LINK, but is linked to none; set its link to a group's number",
         [](auto& d) { d.limb(H::follower).link = UINT32_MAX; }},
        {"group 10, which does not exist; there are 10", [](auto& d) { d.limb(H::follower).link = 10; }},
        {"group 5 is linked to group 7, which is a body's shift and has no hand; link it to a limb or a prop",
         [](auto& d) { d.limb(H::follower).link = H::shift; }},
        {"group 5 is linked to group 10, which is a look and has no hand; link it to a limb or a prop",
         [](auto& d) { d.limb(H::follower).link = d.bodies.add(look({0})); }},
        {"group 5 is linked to group 4, which has no hand; add SWIVEL_WITH_HAND",
         [](auto& d) { d.limb(H::free).features &= ~SWIVEL_WITH_HAND; }},
        {"group 0 is a prop, and 3 limbs are linked to it", [](auto& d) { d.limb(H::on_handle).link = H::prop; }},
        {"group 8 is a prop, and 0 limbs are linked to it", [](auto& d) { d.limb(H::on_handle).link = H::free; }},
        {"moves; link the limbs to that group instead",  // a joint that a limb turns
         [](auto& d) { d.prop(H::handle).joint = static_cast<std::int32_t>(d.joints(H::free).shoulder); }},
        {"moves; link the limbs to that group instead",  // one that hangs below a limb
         [](auto& d) { d.prop(H::handle).joint = static_cast<std::int32_t>(d.joints(H::left).wrist); }},
        {"group 8, prop.joint is -2", [](auto& d) { d.prop(H::handle).joint = -2; }},
        {"group 8, prop.joint is ",
         [](auto& d) { d.prop(H::handle).joint = static_cast<std::int32_t>(d.bodies.skeleton.size()); }},
        {"group 8, prop.joint is 1073741824", [](auto& d) { d.prop(H::handle).joint = 1 << 30; }},
        {"group 0, prop.max_move is -1; it is 0 to 1000", [](auto& d) { d.prop(H::prop).max_move = -1; }},
        {"group 0, prop.max_move is nan", [](auto& d) { d.prop(H::prop).max_move = kNan; }},
        {"group 0, prop.max_move is inf", [](auto& d) { d.prop(H::prop).max_move = kInf; }},
        {"group 0, prop.max_move is 1001", [](auto& d) { d.prop(H::prop).max_move = 1001; }},
        {"group 5: SWIVEL_WITH_LINK excludes SWIVEL_WITH_AIM",
         [](auto& d) { d.limb(H::follower).features = SWIVEL_WITH_LINK | SWIVEL_WITH_HAND | SWIVEL_WITH_AIM; }},
        {"group 5: SWIVEL_WITH_LINK excludes SWIVEL_WITH_PLANT",
         [](auto& d) { d.limb(H::follower).features |= SWIVEL_WITH_PLANT; }},
        {"group 5: SWIVEL_WITH_LINK excludes SWIVEL_WITH_PELVIS_FIT",
         [](auto& d) { d.limb(H::follower).features |= SWIVEL_WITH_PELVIS_FIT; }},
        {"group 5: SWIVEL_WITH_LINK needs", [](auto& d) { d.limb(H::follower).features = SWIVEL_WITH_LINK; }},
        {"group 0: prop def has size 0; start from its default", [](auto& d) { d.prop(H::prop).size = 0; }},
        {"group 8: prop def has size 12; start from its default", [](auto& d) { d.prop(H::handle).size -= 4; }},
        {"build with the header of the library that you link", [](auto& d) { d.prop(H::handle).size += 8; }},
        {"group 7: shift def has size 0; start from its default", [](auto& d) { d.shift().size = 0; }},
        {"group 7: shift def has size 20; start from its default", [](auto& d) { d.shift().size -= 4; }},
        {"build with the header of the library that you link", [](auto& d) { d.shift().size += 8; }},
    });
}

TEST_CASE("a look that cannot be is refused")
{
    check_refusals<LookDef>({
        {"look.joint_count is 0; it is 1 to 8", [](auto& d) { d.look.joint_count = 0; }},
        {"look.joint_count is 9; it is 1 to 8", [](auto& d) { d.look.joint_count = 9; }},
        {"look.joints[2] is 4; the skeleton has 4 joints", [](auto& d) { d.look.joints[2] = 4; }},
        {"look.joints[1], joint 0, is not below the one before, joint 0", [](auto& d) { d.look.joints[1] = 0; }},
        {"look.joints[2], joint 2, is not below the one before, joint 3", [](auto& d) { d.look.joints[1] = 3; }},
        {"look.share[1] is -1; it is 0 to 1000", [](auto& d) { d.look.share[1] = -1; }},
        {"look.share of the last joint is 0; let it be more", [](auto& d) { d.look.share[3] = 0; }},
        {"look.cos_max[1] is nan; it is -1 to 1", [](auto& d) { d.look.cos_max[1] = kNan; }},
        {"look.axis is 0, 0, 0; give an axis", [](auto& d) { d.look.axis[2] = 0; }},
        {"look.eye is 0, 0.08, 1e+16; give a place", [](auto& d) { d.look.eye[2] = 1e16f; }},
        {"look.cos_full is -0.1, look.cos_none -0.1; they are -1 to 1, and cos_full is 0.001 more",
         [](auto& d) { d.look.cos_none = -0.1f; }},
        {"look.fade_distance is -1; it is 0 to", [](auto& d) { d.look.fade_distance = -1; }},
        {"look.rate is -1; it is 0 to 1000", [](auto& d) { d.look.rate = -1; }},
        {"group 0: look def has size 0; start from its default", [](auto& d) { d.look.size = 0; }},
        {"group 0: look def has size ", [](auto& d) { d.look.size -= 4; }},
        {"build with the header of the library that you link", [](auto& d) { d.look.size += 8; }},
        {"group 0 turns joint 0, which is also joint 0 of group 1", [](auto& d) { d.def.group_count = 2; }},
        {"group 1 turns joint 0, which is above joint 3 of group 0; let the look that is above come first",
         [](auto& d) {
             d.def.group_count = 2, d.look.joint_count = 1, d.look.joints[0] = 3, d.looks[1].joint_count = 2;
         }},
    });
    LookDef right;
    right.def.group_count = 2, right.look.joint_count = 2;
    right.looks[1].joint_count = 1, right.looks[1].joints[0] = 3;
    right.look.rate = 1;
    Crowd crowd(right.def);
    swivel_pose pose = swivel_default_pose();
    std::array<Float4, 4> rotations{};
    pose.rotations = {rotations.data(), sizeof rotations, sizeof(Float4), nullptr};
    CHECK_THROWS_WITH(crowd.solve({.pose = &pose}),
                      Catch::Contains("the pose has no time, which plants, shifts and looks"));
}

// ---- bindings

TEST_CASE("results as joints need bindings of unit rotations and of their twist bones, or of bones that are said later")
{
    swivel_limb_def limb = limbs(3, SWIVEL_JOINTS);
    const swivel_group_def group = c_group(limb);
    const swivel_crowd_def def = def_of(group);
    check_refused(&def, "group 0 has no binding; make it with swivel_bind_joints()");
    limb = group_of(3), limb.features = SWIVEL_JOINTS | SWIVEL_WITH_HAND;
    CHECK(swivel_crowd_bytes(&def) > 0);
    swivel_binding& b = limb.binding;
    for (float* const q :
         {b.parent_from_arm, b.upper_from_arm, b.elbow_parent_from_arm, b.fore_from_arm, b.wrist_parent_from_arm,
          b.shoulder_rest, b.elbow_rest, b.wrist_rest, b.twist_parent_from_arm[6], b.twist_from_arm[0]}) {
        for (const float w : {0.0f, 1.001f, kNan}) {
            q[3] = w;
            check_refused(&def, w == 0 && q == b.parent_from_arm ? "has no binding" : "unit");
            CHECK_NOTHROW(crowd_with(0, {limb}));
        }
        q[3] = 1;
    }
    for (const Float2& lengths : {Float2{kNan, kNan}, Float2{0, 1}, Float2{1, 0}, Float2{0, 0}}) {
        std::ranges::copy(lengths, b.lengths);
        if (lengths == Float2{0, 0})
            check_refused(&def, "group 0's binding has bones of length 0");
        else
            CHECK(swivel_crowd_bytes(&def) > 0);
    }
    b = group_of(3).binding;
    for (const std::uint32_t bound : {0u, 2u})  // 0: then twist bones need not be bound
        for (std::uint32_t bones = 0; bones <= 7; ++bones) {
            b.twist_bone_count = bound, limb.twist_bone_count = bones;
            if (bound == 0 || bones == 0 || bones == bound)
                CHECK(swivel_crowd_bytes(&def) > 0);
            else
                check_refused(&def,
                              ("group 0's binding has 2 twist bones, the group " + std::to_string(bones)).c_str());
        }
}

namespace {

// Joints 0 root, 1 shoulder, 2 between, 3 elbow, 4 between, 5 and 6 twist bones, 7 wrist, 8 a finger, 9 another root.
struct Figure {
    std::vector<std::int32_t> parents = {-1, 0, 1, 2, 3, 4, 4, 4, 7, -1};
    std::vector<Float4> rotations = std::vector<Float4>(10, Float4{0, 0, 0, 1});
    std::vector<Float3> translations = {{0, 0, 0}, {0, 1, 0},    {0.1f, 0, 0}, {0.2f, 0, 0}, {0.1f, 0, 0},
                                        {0, 0, 0}, {0.1f, 0, 0}, {0.2f, 0, 0}, {0.1f, 0, 0}, {0, 0, 0}};
    std::vector<std::uint32_t> twist_bones = {5, 6};
    swivel_skeleton skeleton = view_of(*this);
    swivel_limb_joints joints = swivel_default_limb_joints(1, 3, 7);

    Figure()
    {
        joints.twist_bones = twist_bones.data();
        joints.twist_bone_count = 2;
        joints.bend[2] = 1;
    }
    swivel_status bind(swivel_binding* binding) const { return swivel_bind_joints(&skeleton, &joints, binding); }
};
// A limb with nothing aligned.
struct SkewedLimb {
    Random random{9};
    ThreeJoints rest = skewed_joints(random);

    swivel_status bind(swivel_binding* binding) const
    {
        const swivel_skeleton skeleton = rest.skeleton();
        const swivel_limb_joints joints = rest.joints();
        return swivel_bind_joints(&skeleton, &joints, binding);
    }
};

// Binds, and then once more as it was changed.
template <class Good, class Change>
void check_unbound(const std::string& words, const Change& change)
{
    INFO("should say: " << words);
    Good good;
    swivel_binding binding = swivel_default_binding();
    REQUIRE(good.bind(&binding) == SWIVEL_OK);
    const swivel_binding before = binding;
    change(good);
    CHECK_REFUSED(good.bind(&binding), SWIVEL_INVALID_ARGUMENT);
    CHECK_THAT(swivel_last_error(), Catch::Contains(words));
    CHECK(std::memcmp(&binding, &before, sizeof binding) == 0);
}

}  // namespace

TEST_CASE("swivel_bind_joints refuses joints that do not exist or are no limb, by name, and rest poses that are none")
{
    const Refusal<Figure> refusals[] = {
        {"the elbow is joint 10, but the skeleton has 10 joints", [](auto& f) { f.joints.elbow = 10; }},
        {"twist bone 1 is joint 4294967295, but", [](auto& f) { f.twist_bones[1] = ~0u; }},
        {"the shoulder is joint 1, but the skeleton has 0 joints", [](auto& f) { f.skeleton.joint_count = 0; }},
        {"joint 2's parent is 99; give -1 for a root", [](auto& f) { f.parents[2] = 99; }},
        {"joint 0's parent is -2; give -1 for a root", [](auto& f) { f.parents[0] = -2; }},
        {"the parents of the shoulder, joint 1, go round in a circle", [](auto& f) { f.parents[0] = 4; }},
        {"the elbow, joint 9, is not below the shoulder, joint 1", [](auto& f) { f.joints.elbow = 9; }},
        {"the elbow, joint 1, is not below the shoulder, joint 1", [](auto& f) { f.joints.elbow = 1; }},
        {"the wrist, joint 3, is not below the elbow, joint 7",
         [](auto& f) { f.joints.elbow = 7, f.joints.wrist = 3; }},
        {"twist bone 0, joint 2, is not below the elbow, joint 3", [](auto& f) { f.twist_bones[0] = 2; }},
        {"twist bone 1, joint 8, hangs below the wrist, joint 7, and would turn with it",
         [](auto& f) { f.twist_bones[1] = 8; }},
        {"the wrist, joint 7, hangs below twist bone 0, joint 4, and would turn with it",
         [](auto& f) { f.twist_bones[0] = 4; }},
        {"twist bone 1, joint 6, hangs below twist bone 0, joint 5", [](auto& f) { f.parents[6] = 5; }},
        {"twist bone 0 and twist bone 1 are both joint 6", [](auto& f) { f.twist_bones[0] = 6; }},
        {"the wrist and twist bone 1 are both joint 7", [](auto& f) { f.twist_bones[1] = 7; }},
        {"twist bone 1, joint 5, is nearer to the elbow than twist bone 0, joint 6; list them from elbow to wrist",
         [](auto& f) { std::swap(f.twist_bones[0], f.twist_bones[1]); }},
        {"there are 8 twist bones; a limb has at most 7", [](auto& f) { f.joints.twist_bone_count = 8; }},
        {"twist_bones is null", [](auto& f) { f.joints.twist_bones = nullptr; }},
        {"the upper arm has no direction",
         [](auto& f) {
             f.translations[2] = f.translations[3] = {0, 0, 0};
         }},
        {"straight within 10 degrees, so it does not show where the limb bends to; give the bend",
         [](auto& f) { f.joints.bend[2] = 0; }},
        {"the bend lies along the upper arm", [](auto& f) { f.joints.bend[0] = 1e6f; }},
        {"the skeleton's parents are null", [](auto& f) { f.skeleton.parents = {}; }},
        {"the skeleton's translations are null", [](auto& f) { f.skeleton.translations = {}; }},
        {"parents have stride 2, which is smaller than a value, 4 bytes",
         [](auto& f) { f.skeleton.parents.stride = 2; }},
        {"translations have stride 0", [](auto& f) { f.skeleton.translations.stride = 0; }},
        {"rotations have stride 12", [](auto& f) { f.skeleton.rotations.stride = 12; }},
        {"skeleton has size 0", [](auto& f) { f.skeleton.size = 0; }},
        {"limb joints has size 4096", [](auto& f) { f.joints.size = 4096; }},
        {"build with the header", [](auto& f) { f.joints.size += 8; }},
        {"reserved is not 0", [](auto& f) { f.joints.reserved = 1; }},
        {"reserved is not 0", [](auto& f) { f.skeleton.reserved = 1; }},
    };
    for (const auto& [words, change] : refusals) check_unbound<Figure>(words, change);
    for (const std::uint32_t joint : {1u, 2u, 3u, 4u, 5u, 7u})
        for (const float bad : {0.0f, kNan, kInf, 3e38f})
            check_unbound<Figure>("joint " + std::to_string(joint) + "'s rest rotation is zero or not finite",
                                  [&](Figure& f) { f.rotations[joint].fill(bad); });
    for (const std::uint32_t joint : {2u, 3u, 4u, 6u, 7u})
        for (const float bad : {kNan, kInf, 3e38f})
            check_unbound<Figure>("joint " + std::to_string(joint) + "'s translation is not finite",
                                  [&](Figure& f) { f.translations[joint][1] = bad; });
}

TEST_CASE("swivel_bind_joints refuses bones and bends that are no limb's, whatever is aligned")
{
    for (const float bad : {0.0f, 1e-20f}) {
        check_unbound<SkewedLimb>("joint 1's rest rotation", [&](auto& s) { s.rest.rotations[1].fill(bad); });
        check_unbound<SkewedLimb>("forearm has no direction", [&](auto& s) { s.rest.translations[2].fill(bad); });
    }
    const Refusal<SkewedLimb> refusals[] = {
        {"the bend is not finite", [](auto& s) { s.rest.bend[1] = kInf; }},
        {"the bend is not finite or longer than 1e15", [](auto& s) { s.rest.bend[1] = 3e38f; }},
        {"the bend lies along the upper arm", [](auto& s) { s.rest.bend = s.rest.translations[1]; }},
        {"the forearm at rest lies along the axis",
         [](auto& s) {
             const Vector3d hinge = vec(s.rest.bend).cross(vec(s.rest.translations[1]));
             const Quaterniond elbow = quat(s.rest.rotations[1]).normalized();
             s.rest.translations[2] = floats(Vector3d(elbow.conjugate() * hinge));
         }},
    };
    for (const auto& [words, change] : refusals) check_unbound<SkewedLimb>(words, change);
}
