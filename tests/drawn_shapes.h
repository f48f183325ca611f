// SPDX-License-Identifier: MIT
//
// What tests of swivel_draw() share: shapes by their kinds, checks that hold of every drawing, and what is drawn: one
// free limb, and one body with a leg, an arm below a clavicle, and a head.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "swivel/swivel_explain.hpp"
#include "tests/allocation_count.h"
#include "tests/body_crowd.h"
#include "tests/test_crowd.h"

namespace swivel::test {

using Shapes = std::vector<swivel_shape>;
using KindNames = std::set<std::string>;

inline Vector3d start_of(const swivel_shape& shape) { return Vector3d(shape.from[0], shape.from[1], shape.from[2]); }
inline Vector3d end_of(const swivel_shape& shape) { return Vector3d(shape.to[0], shape.to[1], shape.to[2]); }
inline double length_of(const swivel_shape& shape) { return (end_of(shape) - start_of(shape)).norm(); }

inline bool is_same(const swivel_shape& a, const swivel_shape& b)
{
    return start_of(a) == start_of(b) && end_of(a) == end_of(b) && a.name == b.name && a.kind == b.kind &&
           a.color == b.color && a.group == b.group;
}
inline bool is_same(const Shapes& a, const Shapes& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const swivel_shape& one, const swivel_shape& other) { return is_same(one, other); });
}

inline Shapes shapes_of(const Crowd& crowd, std::uint32_t group, std::uint32_t limb, const swivel_pose* pose,
                        std::uint32_t capacity)
{
    const swivel_shape untouched{{1, 2, 3}, {4, 5, 6}, "untouched", SWIVEL_SHAPE_END, 7, 8};
    Shapes shapes(capacity + 1, untouched);
    std::uint32_t count = 0;
    const std::size_t allocations = allocation_count();
    const swivel_status status =
        swivel_draw(crowd.get(), group, limb, pose, capacity > 0 ? shapes.data() : nullptr, capacity, &count);
    CHECK(allocation_count() == allocations);
    check(status);
    CHECK(is_same(shapes.back(), untouched));
    shapes.resize(std::min(count, capacity));
    shapes.resize(count, untouched);
    return shapes;
}
// The name and the colour of each kind, in the order of swivel_shape_kind, whose comments name the colours.
struct NamedColor {
    const char* name;
    std::uint32_t color;
};
inline constexpr NamedColor kNamedColors[] = {
    {"bone", 0xffffffff},       // white
    {"incoming", 0x808080ff},   // grey
    {"bend", 0xfa8072ff},       // salmon
    {"axis_x", 0xff0000ff},     // red
    {"axis_y", 0x00a000ff},     // green
    {"axis_z", 0x0040ffff},     // blue
    {"target", 0xffff00ff},     // yellow
    {"goal", 0xff8c00ff},       // orange
    {"miss", 0xff0000ff},       // red
    {"effector", 0xd0d0d0ff},   // light grey
    {"pole", 0xff00ffff},       // magenta
    {"normal", 0xee82eeff},     // violet
    {"wish", 0xff80c0ff},       // pink
    {"allowed", 0x90ee90ff},    // light green
    {"cone", 0x00ffffff},       // cyan
    {"region", 0x008080ff},     // teal
    {"anchor", 0xffd700ff},     // gold
    {"probe", 0x87ceebff},      // sky blue
    {"ground", 0xa0522dff},     // brown
    {"sight", 0xa0ff00ff},      // lime
    {"shift", 0x800080ff},      // purple
    {"prop", 0xf5deb3ff},       // beige
    {"bad_input", 0xdc143cff},  // crimson
};
static_assert(std::size(kNamedColors) == SWIVEL_SHAPE_END);
// All shapes, with checks that hold of every drawing.
inline Shapes drawn(const Crowd& crowd, std::uint32_t group, std::uint32_t limb, const swivel_pose* pose = nullptr)
{
    const auto count = static_cast<std::uint32_t>(shapes_of(crowd, group, limb, pose, 0).size());
    const Shapes shapes = shapes_of(crowd, group, limb, pose, count),
                 some = shapes_of(crowd, group, limb, pose, count / 2);
    CHECK(is_same(shapes_of(crowd, group, limb, pose, count), shapes));
    CHECK(is_same({some.begin(), some.begin() + count / 2}, {shapes.begin(), shapes.begin() + count / 2}));
    for (const swivel_shape& shape : shapes) {
        CHECK(start_of(shape).allFinite());
        CHECK(end_of(shape).allFinite());
        REQUIRE(shape.kind < SWIVEL_SHAPE_END);
        CHECK(shape.name == std::string(kNamedColors[shape.kind].name));
        CHECK(shape.color == kNamedColors[shape.kind].color);
        CHECK((shape.group == SWIVEL_EVERY_GROUP || shape.group < swivel_group_count(crowd.get())));
    }
    return shapes;
}
inline Shapes drawn_body(const Crowd& crowd, std::uint32_t body, const swivel_pose& pose)
{
    return drawn(crowd, SWIVEL_EVERY_GROUP, body, &pose);
}
inline Shapes of_kind(const Shapes& shapes, swivel_shape_kind kind)
{
    Shapes found;
    for (const swivel_shape& shape : shapes)
        if (shape.kind == kind) found.push_back(shape);
    return found;
}
// The kinds of a group's shapes; SWIVEL_EVERY_GROUP: of the body itself.
inline KindNames names_of(const Shapes& shapes, std::uint32_t group)
{
    KindNames names;
    for (const swivel_shape& shape : shapes)
        if (shape.group == group) names.insert(shape.name);
    return names;
}
inline const KindNames kAxes = {"axis_x", "axis_y", "axis_z"};  // of a rotation
inline KindNames operator+(KindNames a, const KindNames& b)
{
    a.insert(b.begin(), b.end());
    return a;
}

// A limb with bones of lengths 1 and 0.9, whose incoming pose is the rest pose.
inline Crowd free_limb(swivel_features features, const swivel_region* region = nullptr)
{
    swivel_limb_def def = limbs(1, features);
    def.region = region;
    Crowd crowd{Definition(def)};
    crowd.write_all(SWIVEL_TARGET, 0, {0.3f, 0.1f, 1.0f});
    crowd.write_all(SWIVEL_LENGTHS, 0, {1.0f, 0.9f});
    if (features & SWIVEL_WORLD) crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, {1.0f, 2.0f, 3.0f});
    for (const swivel_field field : {SWIVEL_INCOMING_SHOULDER, SWIVEL_INCOMING_ELBOW, SWIVEL_INCOMING_WRIST})
        if (swivel_field_row_count(crowd.get(), 0, field) > 0) crowd.write_all(field, 0, {0.0f, 0.0f, 0.0f, 1.0f});
    return crowd;
}

// The kinds that it has when it is solved.
inline KindNames limb_names(Crowd crowd)
{
    crowd.solve();
    return names_of(drawn(crowd, 0, 0), 0);
}
template <class Value>
KindNames limb_names(swivel_features features, swivel_field field, const Value& value)
{
    Crowd crowd = free_limb(features);
    crowd.write_all(field, 0, value);
    return limb_names(std::move(crowd));
}

struct Figure {
    static constexpr std::uint32_t kPelvis = 0, kThigh = 1, kClavicle = 4, kArm = 5, kHead = 8, kJoints = 9;
    std::vector<std::int32_t> parents = {-1, kPelvis, 1, 2, kPelvis, kClavicle, 5, 6, kPelvis};
    std::vector<Float3> translations = {{0, 1, 0},          {0.1f, 0, 0},     {0, -0.5f, 0.02f},
                                        {0, -0.5f, -0.02f}, {0.05f, 0.5f, 0}, {0.15f, 0, 0},
                                        {0.3f, 0, 0},       {0.3f, 0, 0.02f}, {0, 0.7f, 0}};
    std::vector<Float4> rotations = std::vector<Float4>(kJoints, Float4{0, 0, 0, 1});
    swivel_limb_joints leg = limb(kThigh, -1), arm = limb(kArm, 1);
    float time = 0.02f;

    static swivel_limb_joints limb(std::uint32_t first, float forwards)
    {
        swivel_limb_joints joints = swivel_default_limb_joints(first, first + 1, first + 2);
        joints.bend[2] = forwards;
        return joints;
    }
    Crowd crowd(const std::vector<Definition>& groups) const
    {
        swivel_skeleton skeleton = swivel_default_skeleton();
        skeleton.parents = stream(parents);
        skeleton.translations = stream(translations);
        skeleton.joint_count = kJoints;
        return Crowd(skeleton, 1, groups);
    }
    swivel_pose pose()
    {
        swivel_pose made = swivel_default_pose();
        made.rotations = {rotations.data(), kJoints * sizeof(Float4), sizeof(Float4), nullptr};
        made.time = {&time, 0};
        return made;
    }
    // The shapes after some solves.
    Shapes solved(Crowd& crowd, int frames = 1)
    {
        const swivel_pose view = pose();
        for (int n = 0; n < frames; ++n) solve_poses(crowd, view);
        return drawn_body(crowd, 0, view);
    }
};

// What most limbs of a figure have.
inline constexpr swivel_features kFigureLimb = SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING | SWIVEL_WITH_RECORD;

}  // namespace swivel::test
