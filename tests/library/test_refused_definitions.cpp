// SPDX-License-Identifier: MIT
//
// The promise: a crowd of limbs, free or of bodies, that cannot be is refused in one line, which names what is wrong.
// Nothing is made. Each row is a good definition with one thing changed.
#include "tests/refused_definitions.h"

using namespace swivel;
using namespace swivel::test;

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
        {"group 1: shoulder_order is 6", [](auto& d) { set_number(d.limbs[1].shoulder_order, SWIVEL_ZYX + 1); }},
        {"group 0: wrist_order is 7", [](auto& d) { set_number(d.limbs[0].wrist_order, 7); }},
        {"group 0: on_bad_input is 2", [](auto& d) { set_number(d.limbs[0].on_bad_input, 2); }},
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
        {"group 1 has a pole_behind, but not SWIVEL_POLE_HALF_LINE; add it",
         [](auto& d) { d.limbs[1].pole_behind[1] = kNan; }},
        {"group 1: pole_behind is 0, nan, 0; give a direction 1e-15 to 1e15 long, or zeros",
         [](auto& d) { d.limbs[1].features = SWIVEL_POLE_HALF_LINE, d.limbs[1].pole_behind[1] = kNan; }},
        {"group 1: pole_behind is 0, 1e-16, 0; give a direction",
         [](auto& d) { d.limbs[1].features = SWIVEL_POLE_HALF_LINE, d.limbs[1].pole_behind[1] = 1e-16f; }},
        {"group 1: pole_behind lies along the limb at rest; give a direction where its wrist does not go",
         [](auto& d) { d.limbs[1].features = SWIVEL_POLE_HALF_LINE, d.limbs[1].pole_behind[2] = 3; }},
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
    // All that is missing is named at once: what a feature needs, what that needs in turn, and what others need.
    refuse(SWIVEL_HAND_YIELDS, "group 1: SWIVEL_HAND_YIELDS needs SWIVEL_WITH_HAND and SWIVEL_WITH_EFFECTOR; add them");
    refuse(SWIVEL_POLE_DIRECTION | SWIVEL_WITH_WEIGHTS | SWIVEL_STEP_WINS,
           "group 1: SWIVEL_POLE_DIRECTION and others need SWIVEL_WORLD, SWIVEL_WITH_INCOMING and "
           "SWIVEL_WITH_MAX_SWIVEL; add them");
    ArmDef foot;
    foot.limbs[0].features = SWIVEL_WITH_GROUND;
    check_refused(&foot.def,
                  "group 0: SWIVEL_WITH_GROUND needs SWIVEL_WITH_HAND, SWIVEL_WITH_EFFECTOR and SWIVEL_WITH_PLANT; "
                  "add them");
    constexpr swivel_features kPoles[] = {SWIVEL_POLE_DIRECTION, SWIVEL_POLE_NORMAL, SWIVEL_POLE_INCOMING,
                                          SWIVEL_POLE_HAND, SWIVEL_POLE_HALF_LINE};
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
        {"group 0: on_bad_input is 2", [](auto& d) { set_number(d.limbs[0].on_bad_input, 2); }},
        {"group 0 has a region, but not SWIVEL_WITH_REGION; add it",
         [](auto& d) {
             static const swivel_region region = swivel_default_region();
             d.limbs[0].region = &region;
         }},
        {"group 0 has a pole_behind, but not SWIVEL_POLE_HALF_LINE; add it",
         [](auto& d) { d.limbs[0].pole_behind[1] = 1; }},
        {"group 0: pole_behind is 1e+16, 0, 0; give a direction 1e-15 to 1e15 long, or zeros",
         [](auto& d) { d.limbs[0].features = SWIVEL_POLE_HALF_LINE, d.limbs[0].pole_behind[0] = 1e16f; }},
        {"group 0: pole_behind lies along the limb at rest; give a direction where its wrist does not go",
         [](auto& d) { d.limbs[0].features = SWIVEL_POLE_HALF_LINE, d.limbs[0].pole_behind[2] = 1; }},
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
