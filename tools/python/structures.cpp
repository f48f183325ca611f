// SPDX-License-Identifier: MIT
#include "tools/python/structures.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "tools/python/crowd.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

template <class Number = float>
Number number_of(const char* of, const char* name, const py::handle& given)
{
    const py::object value = given.attr(name);
    try {
        return value.cast<Number>();
    } catch (const py::cast_error&) {
        throw py::type_error(std::string(of) + "." + name + ": expected a " +
                             (std::is_integral_v<Number> ? "whole " : "") + "number, got " +
                             std::string(py::repr(value)));
    }
}

// A structure of floats. type: of the package, which begins with the same members in the same order. Rows are as long
// as their defaults.
template <class Structure>
Structure floats_of(const char* of, const char* type, const py::handle& given)
{
    std::array<float, sizeof(Structure) / sizeof(float)> values;
    const py::tuple names = package(type).attr("_fields");
    std::size_t n = 0;
    for (std::size_t member = 0; n < values.size(); ++member) {
        const auto name = names[member].cast<std::string>();
        const py::object usual = package(type).attr("_field_defaults")[names[member]];
        const std::size_t length = py::isinstance<py::tuple>(usual) ? py::len(usual) : 0;
        if (length > 0)
            copy(std::string(of) + "." + name, given.attr(name.c_str()), std::span(values).subspan(n, length));
        else
            values[n] = number_of(of, name.c_str(), given);
        n += std::max<std::size_t>(length, 1);
    }
    return std::bit_cast<Structure>(values);
}

// A number for each joint, or one for all.
void copy_each(const char* name, const py::object& given, std::span<float> to)
{
    const Input in = input({name, to.size(), 1, "joints"}, given, py::dtype::of<float>(), true);
    for (std::size_t n = 0; n < to.size(); ++n)
        std::memcpy(&to[n], static_cast<const char*>(in.values.data) + n * in.values.stride, sizeof(float));
}

void require(const char* name, const char* type, const py::object& given)
{
    if (!py::isinstance(given, package(type)))
        throw py::type_error(std::string(name) + ": expected a " + type + ", got " + std::string(py::repr(given)));
}

}  // namespace

SkeletonArrays skeleton_of(const py::object& parents, const py::object& translations, const py::object& rotations)
{
    const std::size_t count = length_of("parents", parents);
    const auto floats = py::dtype::of<float>();
    SkeletonArrays made{swivel_default_skeleton(),
                        input({"parents", count, 1}, parents, py::dtype::of<std::int32_t>(), false),
                        input({"translations", count, 3}, translations, floats, false),
                        {}};
    if (!rotations.is_none()) made.rotations = input({"rotations", count, 4}, rotations, floats, false);
    made.view.joint_count = count_of("number of joints", static_cast<std::int64_t>(count));
    made.view.parents = made.parents.values;
    made.view.translations = made.translations.values;
    made.view.rotations = made.rotations.values;
    return made;
}

LimbJoints joints_of(std::int64_t shoulder, std::int64_t elbow, std::int64_t wrist,
                     const std::vector<std::int64_t>& twist_bones, const py::object& bend)
{
    LimbJoints made;
    made.view =
        swivel_default_limb_joints(count_of("shoulder", shoulder), count_of("elbow", elbow), count_of("wrist", wrist));
    for (const std::int64_t bone : twist_bones) made.twist_bones.push_back(count_of("twist_bones", bone));
    made.view.twist_bones = made.twist_bones.data();
    made.view.twist_bone_count = count_of("number of twist bones", static_cast<std::int64_t>(twist_bones.size()));
    copy("bend", bend, made.view.bend);
    return made;
}

swivel_plant plant_of(const py::object& given)
{
    require("plant", "Plant", given);
    return floats_of<swivel_plant>("plant", "Plant", given);
}

swivel_ground ground_of(const py::object& given)
{
    require("ground", "Ground", given);
    return floats_of<swivel_ground>("ground", "Ground", given);
}

swivel_shift_def shift_of(const py::handle& group)
{
    const auto number = [&](const char* name) { return number_of("shift", name, group); };
    swivel_shift_def made = swivel_default_shift_def();
    made.drop = number("drop"), made.rise = number("rise");
    made.half_life = number("half_life"), made.lookahead = number("lookahead");
    return made;
}

swivel_prop_def prop_of(const py::handle& group)
{
    swivel_prop_def made = swivel_default_prop_def();
    made.joint = number_of<std::int32_t>("prop", "joint", group);
    made.max_move = number_of("prop", "max_move", group);
    return made;
}

swivel_look_def look_of(const py::handle& group)
{
    const auto number = [&](const char* name) { return number_of("look", name, group); };
    swivel_look_def made = swivel_default_look_def();
    std::vector<std::int64_t> joints;
    try {
        joints = group.attr("joints").cast<std::vector<std::int64_t>>();
    } catch (const py::cast_error&) {
        throw py::type_error("look.joints: expected numbers of joints, got " +
                             std::string(py::repr(group.attr("joints"))));
    }
    made.joint_count = static_cast<std::uint32_t>(joints.size());
    const std::size_t count = std::min<std::size_t>(joints.size(), SWIVEL_MAX_LOOK_JOINTS);
    for (std::size_t n = 0; n < count; ++n) made.joints[n] = count_of("look.joints", joints[n]);
    copy_each("look.share", group.attr("share"), std::span(made.share).first(count));
    copy_each("look.cos_max", group.attr("cos_max"), std::span(made.cos_max).first(count));
    copy("look.eye", group.attr("eye"), made.eye);
    copy("look.axis", group.attr("axis"), made.axis);
    made.cos_full = number("cos_full"), made.cos_none = number("cos_none");
    made.fade_distance = number("fade_distance"), made.rate = number("rate");
    return made;
}

SupportArrays supports_of(const char* name, const py::object& given, std::size_t body_count)
{
    require(name, "Support", given);
    const auto take = [&](const char* member, std::size_t component_count, const py::dtype& type) {
        const py::object values = given.attr(member);
        const std::string what = std::string(name) + "." + member;
        return values.is_none() ? Input{} : input({what, body_count, component_count, "bodies"}, values, type, true);
    };
    return {take("position", 3, py::dtype::of<double>()), take("rotation", 4, py::dtype::of<float>())};
}

}  // namespace swivel::python
