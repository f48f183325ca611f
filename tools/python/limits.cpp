// SPDX-License-Identifier: MIT
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "swivel/swivel_regions.hpp"
#include "tools/python/arrays.h"
#include "tools/python/helpers.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

template <std::size_t N>
py::array array_of(const std::array<float, N>& numbers)
{
    return py::array_t<float>(static_cast<py::ssize_t>(N), numbers.data());
}

py::array cone_array(const py::object& axis, double max) { return array_of(cone(vector_of("axis", axis), max)); }

py::array aim(const py::object& axis, double flexion)
{
    std::array<float, 5> value;
    check(swivel_aim(vector_of("axis", axis).data(), flexion, value.data()));
    return array_of(value);
}

py::array mirror(std::int64_t number, const py::object& values, std::int64_t order)
{
    const swivel_field field = field_of(number);
    const swivel_euler_order axes = order_of(order);
    const std::uint32_t k = info_of(field).max_components;
    const py::array given = py::module_::import("numpy").attr("asarray")(values);
    const bool many = given.ndim() == (k > 1 ? 2 : 1);
    const std::size_t count = many ? static_cast<std::size_t>(given.shape(0)) : 1;
    if (info_of(field).kind != SWIVEL_FIELD_INPUT) {  // which the library refuses
        float none = 0;
        check(swivel_mirror(field, axes, &none, &none));
    }
    const Values wanted{info_of(field).name, count, k};
    const Input in = input(wanted, given, py::dtype::of<float>(), true);
    py::array_t<float> out(std::vector<py::ssize_t>(given.shape(), given.shape() + given.ndim()));
    for (std::size_t n = 0; n < count; ++n) {
        float* const value = out.mutable_data() + n * wanted.component_count;
        std::memcpy(value, static_cast<const char*>(in.values.data) + n * in.values.stride,
                    wanted.component_count * sizeof(float));
        check(swivel_mirror(field, axes, value, value));
    }
    return out;
}

py::array arm_axis_array(const swivel_binding& binding, const py::object& parent_rotation, const py::object& direction)
{
    float rotation[4];
    copy("parent_rotation", parent_rotation, rotation);
    const std::array<double, 3> towards = vector_of("direction", direction);
    py::array_t<double> axis(3);
    check(swivel_arm_axis(&binding, rotation, towards.data(), axis.mutable_data()));
    return axis;
}

py::tuple kinds_of(std::int64_t number)
{
    const swivel_field_info& info = info_of(field_of(number));
    py::list kinds;
    for (const swivel_kind kind :
         {SWIVEL_KIND_LIMB, SWIVEL_KIND_BODY_LIMB, SWIVEL_KIND_LOOK, SWIVEL_KIND_PROP, SWIVEL_KIND_SHIFT})
        if (has_kind(info, kind)) kinds.append(kind_member(kind));
    return kinds;
}

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

void add_limits(py::module_& module)
{
    module.def(
        "range", [](double min, double max) { return array_of(range(min, max)); }, py::arg("min"), py::arg("max"),
        "A range of angles in radians, min <= max, no wider than 2 pi: (4,) float32, cos and sin of its\n"
        "middle, cos and sin of half its width. A twist's, or one of the three that np.concatenate makes a\n"
        "box of.");
    module.def("arm_axis", &arm_axis_array, py::arg("binding"), py::arg("parent_rotation"), py::arg("direction"),
               "A direction of the character as the axes of limits take it: (3,) float64, unit.\n\n"
               "direction (3,): in the world of the rest pose, of any length. parent_rotation (4,): of the shoulder's\n"
               "parent joint there, x, y, z, w. cone(arm_axis(binding, rotation, (0, -1, 1)), math.radians(80)) keeps\n"
               "an arm within 80 degrees of forwards and down.");
    module.def("cone", &cone_array, py::arg("axis"), py::arg("max"),
               "A cone about an axis (3,) of any length, open by `most` radians from it, 0 to pi: (4,) float32.");
    module.def(
        "flexion", [](double min, double max) { return array_of(flexion(min, max)); }, py::arg("min"), py::arg("max"),
        "The elbow's min and max flexion in radians, 0 <= min <= max <= pi: (2,) float32.");
    module.def(
        "cos_sin", [](double angle) { return array_of(cos_sin(angle)); }, py::arg("angle"),
        "Cosine and sine of an angle in radians, for fields such as Field.ANGLE: (2,) float32.");
    module.def("aim", &aim, py::arg("axis"), py::arg("flexion"),
               "An aim for Field.AIM: the hand's axis (3,), of any length, and the elbow's flexion in radians, 0 to\n"
               "pi: (5,) float32.");
    module.def("mirror", &mirror, py::arg("field"), py::arg("values"), py::arg("order") = 0,
               "Values of a limit, or of a turn such as Field.ANGLE, for the same limbs on the body's other side:\n"
               "(k,) or (n, k) float32.\n\n"
               "order is the EulerOrder of boxes. Values of other input fields are copied: places, hands and poses\n"
               "are for you to mirror. ValueError for results.");
    module.def(
        "needed_features", [](std::int64_t field) { return feature_set(needed_features(field_of(field))); },
        py::arg("field"),
        "The fewest features with which a Group has a field, or another kind of group where a Group has none. A\n"
        "BodyGroup has Feature.WORLD and Feature.WITH_INCOMING by itself, and is not given them.");
    module.def("field_kinds", &kinds_of, py::arg("field"),
               "The kinds of groups that may have a field: a tuple of Kinds.");
}

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
        [](Region& to, const py::object& directions, float margin, std::uint32_t max_cones) {
            to.add_directions(directions_of("directions", directions), margin, max_cones);
        },
        py::arg("directions"), py::arg("margin"), py::arg("max_cones") = 4,
        "Adds cones in order that hold all these directions, each with `margin` radians, 0.01 to 1, around it: what a\n"
        "clip does, and a little more. directions: (n, 3). max_cones: 1 to 6; as many are taken as allow least.");
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
