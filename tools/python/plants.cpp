// SPDX-License-Identifier: MIT
#include "tools/python/plants.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "tools/python/arrays.h"
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

swivel_plant plant_of(const py::object& given)
{
    require("plant", "Plant", given);
    const auto number = [&](const char* name) { return number_of("plant", name, given); };
    swivel_plant made{number("lock"),
                      number("unlock"),
                      number("stop"),
                      number("blend"),
                      number("again"),
                      number("run"),
                      number("longest"),
                      {},
                      {}};
    copy("plant.speed", given.attr("speed"), made.speed);
    copy("plant.height", given.attr("height"), made.height);
    return made;
}

swivel_ground ground_of(const py::object& given)
{
    require("ground", "Ground", given);
    const auto number = [&](const char* name) { return number_of("ground", name, given); };
    swivel_ground made{{}, number("toe_clearance"), number("heel_clearance"), number("cos_most"), number("half")};
    copy("ground.heel", given.attr("heel"), made.heel);
    return made;
}

swivel_fit fit_of(const py::handle& group)
{
    const auto number = [&](const char* name) { return number_of("fit", name, group); };
    return {number("drop"), number("rise"), number("half"), number("ahead")};
}

swivel_prop prop_of(const py::handle& group)
{
    return {number_of<std::int32_t>("prop", "joint", group), number_of("prop", "most_move", group)};
}

swivel_look look_of(const py::handle& group)
{
    const auto number = [&](const char* name) { return number_of("look", name, group); };
    swivel_look made = swivel_default_look();
    std::vector<std::int64_t> joints;
    try {
        joints = group.attr("joints").cast<std::vector<std::int64_t>>();
    } catch (const py::cast_error&) {
        throw py::type_error("look.joints: expected numbers of joints, got " +
                             std::string(py::repr(group.attr("joints"))));
    }
    made.joint_count = static_cast<std::uint32_t>(joints.size());
    const std::size_t count = std::min<std::size_t>(joints.size(), SWIVEL_MOST_LOOK_JOINTS);
    for (std::size_t n = 0; n < count; ++n) made.joints[n] = count_of("look.joints", joints[n]);
    copy_each("look.share", group.attr("share"), std::span(made.share).first(count));
    copy_each("look.cos_most", group.attr("cos_most"), std::span(made.cos_most).first(count));
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
