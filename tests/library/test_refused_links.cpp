// SPDX-License-Identifier: MIT
//
// The promise: links, props, shifts and looks that cannot be are refused in one line, which names what is wrong.
// Nothing is made. Each row is a good definition with one thing changed.
#include "tests/posed_bodies.h"
#include "tests/refused_definitions.h"

using namespace swivel;
using namespace swivel::test;

namespace {

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
