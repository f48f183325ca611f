// SPDX-License-Identifier: MIT
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <cstring>
#include <string>

#include "swivel/swivel.hpp"
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

py::array cone_array(const py::object& axis, double most)
{
    const Input in = input({"axis", 1, 3}, axis, py::dtype::of<double>(), true);
    double numbers[3];
    std::memcpy(numbers, in.values.data, sizeof numbers);  // of any alignment
    return array_of(cone({numbers[0], numbers[1], numbers[2]}, most));
}

py::array aim(const py::object& axis, double flexion)
{
    const Input in = input({"axis", 1, 3}, axis, py::dtype::of<double>(), true);
    std::array<float, 5> value;
    double numbers[3];
    std::memcpy(numbers, in.values.data, sizeof numbers);  // of any alignment
    check(swivel_aim(numbers, flexion, value.data()));
    return array_of(value);
}

py::array mirror(std::int64_t number, const py::object& values, std::int64_t order)
{
    const swivel_field field = field_of(number);
    const swivel_euler_order axes = order_of(order);
    const std::uint32_t k = swivel_component_count(field, needed_features(field));
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
    const Input parent = input({"parent_rotation", 1, 4}, parent_rotation, py::dtype::of<float>(), true);
    const Input wanted = input({"direction", 1, 3}, direction, py::dtype::of<double>(), true);
    float rotation[4];
    double towards[3];
    std::memcpy(rotation, parent.values.data, sizeof rotation);  // of any alignment
    std::memcpy(towards, wanted.values.data, sizeof towards);
    py::array_t<double> axis(3);
    check(swivel_arm_axis(&binding, rotation, towards, axis.mutable_data()));
    return axis;
}

}  // namespace

void add_limits(py::module_& module)
{
    module.def(
        "range", [](double least, double most) { return array_of(range(least, most)); }, py::arg("least"),
        py::arg("most"),
        "A range of angles in radians, least <= most, no wider than 2 pi: (4,) float32, cos and sin of its\n"
        "middle, cos and sin of half its width. A twist's, or one of the three that np.concatenate makes a\n"
        "box of.");
    module.def("arm_axis", &arm_axis_array, py::arg("binding"), py::arg("parent_rotation"), py::arg("direction"),
               "A direction of the character as the axes of limits take it: (3,) float64, unit.\n\n"
               "direction (3,): in the world of the rest pose, of any length. parent_rotation (4,): of the shoulder's\n"
               "parent joint there, x, y, z, w. cone(arm_axis(binding, rotation, (0, -1, 1)), math.radians(80)) keeps\n"
               "an arm within 80 degrees of forwards and down.");
    module.def("cone", &cone_array, py::arg("axis"), py::arg("most"),
               "A cone about an axis (3,) of any length, open by `most` radians from it, 0 to pi: (4,) float32.");
    module.def(
        "flexion", [](double least, double most) { return array_of(flexion(least, most)); }, py::arg("least"),
        py::arg("most"), "The elbow's least and largest flexion in radians, 0 <= least <= most <= pi: (2,) float32.");
    module.def(
        "turn", [](double angle) { return array_of(turn(angle)); }, py::arg("angle"),
        "Cosine and sine of an angle in radians, for Field.ANGLE and Field.MOST_SWIVEL: (2,) float32.");
    module.def("aim", &aim, py::arg("axis"), py::arg("flexion"),
               "An aim for Field.AIM: the hand's axis (3,), of any length, and the elbow's flexion in radians, 0 to\n"
               "pi: (5,) float32.");
    module.def("mirror", &mirror, py::arg("field"), py::arg("values"), py::arg("order") = 0,
               "Values of Field.ANGLE or of a limit for the same limbs on the body's other side: (k,) or (n, k)\n"
               "float32.\n\n"
               "order is the EulerOrder of boxes. Values of other input fields are copied: places, hands and poses\n"
               "are for you to mirror. ValueError for results.");
    module.def(
        "needed_features", [](std::int64_t field) { return feature_set(needed_features(field_of(field))); },
        py::arg("field"), "The fewest features with which a group has a field.");
}

}  // namespace swivel::python
