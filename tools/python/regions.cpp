// SPDX-License-Identifier: MIT
//
// Reach regions, as Python makes them.
#include <pybind11/numpy.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/python/arrays.h"
#include "tools/python/helpers.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

using Direction = std::array<float, 3>;

// An array of shape (n, 3).
std::vector<Direction> directions_of(const char* name, const py::object& given)
{
    const py::array array = given_array(name, given);
    if (array.ndim() != 2 || array.shape(1) != 3)
        throw py::value_error(std::string(name) + ": expected shape (n, 3), got " + shape_text(array));
    const auto count = static_cast<std::size_t>(array.shape(0));
    const Input in = input({name, count, 3, "directions"}, given, py::dtype::of<float>(), false);
    std::vector<Direction> made(count);
    for (std::size_t n = 0; n < count; ++n)
        std::memcpy(made[n].data(), static_cast<const char*>(in.values.data) + n * in.values.stride, sizeof made[n]);
    return made;
}

void add_cones(Region& region, const py::object& axes, const py::object& angles, bool closed)
{
    const std::vector<Direction> axis = directions_of("axes", axes);
    const Input in = input({"angles", axis.size(), 1, "cones"}, angles, py::dtype::of<float>(), true);
    std::vector<swivel_region_cone> cones(axis.size());
    for (std::size_t n = 0; n < cones.size(); ++n) {
        std::memcpy(cones[n].axis, axis[n].data(), sizeof cones[n].axis);
        std::memcpy(&cones[n].angle, static_cast<const char*>(in.values.data) + n * in.values.stride, sizeof(float));
    }
    region.add_cones(cones, closed);
}

py::object rooms(const Region& region, const py::object& directions)
{
    const py::array given = py::module_::import("numpy").attr("asarray")(directions);
    if (given.ndim() <= 1) {
        float direction[3];
        copy("direction", given, direction);
        return py::float_(region.room({direction[0], direction[1], direction[2]}));
    }
    const std::vector<Direction> all = directions_of("directions", given);
    py::array_t<float> made(static_cast<py::ssize_t>(all.size()));
    for (std::size_t n = 0; n < all.size(); ++n) made.mutable_data()[n] = region.room(all[n]);
    return made;
}

}  // namespace

void add_regions(py::module_& module)
{
    py::class_<Region> region(
        module, "Region",
        "Where the upper arms of a group may point: a union of cones in order, bridges between neighbours and convex\n"
        "polygons, less forbidden cones. It starts empty, and allows nothing. Directions are in the arm frame at "
        "rest:\n"
        "arm_axis() converts those of the character. They may have any length but 0. Angles are radians. A Group or\n"
        "BodyGroup with a region gets Feature.WITH_REGION. ValueError for what cannot be; the region then stays.");
    region.attr("__module__") = "swivel";
    region.def(py::init<>(), "Empty.");
    region.def("add_cones", &add_cones, py::arg("axes"), py::arg("angles"), py::arg("closed") = false,
               "Adds cones in order, with a bridge between neighbours. axes: (n, 3). angles: (n,), or one for all, to\n"
               "the axis at most. closed: bridges the last and the first, too.");
    region.def(
        "add_polygon", [](Region& to, const py::object& corners) { to.add_polygon(directions_of("corners", corners)); },
        py::arg("corners"), "Adds a convex polygon. corners: (n, 3), counter-clockwise as seen from outside.");
    region.def(
        "add_directions",
        [](Region& to, const py::object& directions, float margin, std::uint32_t most_cones) {
            to.add_directions(directions_of("directions", directions), margin, most_cones);
        },
        py::arg("directions"), py::arg("margin"), py::arg("most_cones") = 4,
        "Adds cones in order that hold all these directions, each with `margin` radians, 0.01 to 1, around it: what a\n"
        "clip does, and a little more. directions: (n, 3). most_cones: 1 to 6; as many are taken as allow least.");
    region.def(
        "forbid",
        [](Region& from, const py::object& axis, float angle) {
            swivel_region_cone cone{};
            copy("axis", axis, cone.axis);
            cone.angle = angle;
            from.forbid(cone);
        },
        py::arg("axis"), py::arg("angle"), "Cuts a cone out of all that is there and will be added. axis: (3,).");
    region.def("mirrored", &Region::mirrored,
               "The region of the same limb on the body's other side, as mirror() has it.");
    region.def(
        "room", &rooms, py::arg("directions"),
        "How much room a direction, (3,), or each of some, (n, 3), has, in units of a cosine: not negative where\n"
        "it is allowed. A float, or (n,) float32.");
}

}  // namespace swivel::python
