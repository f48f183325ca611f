// SPDX-License-Identifier: MIT
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "swivel/lecture.h"
#include "tools/python/arrays.h"
#include "tools/python/helpers.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

// Of one arm, not of an array of limbs.
std::array<double, 3> array3(const char* name, const py::object& values)
{
    const py::array given = py::array::ensure(values);
    if (given && (given.ndim() != 1 || given.shape(0) != 3))
        throw py::value_error(std::string(name) + ": expected shape (3,), got " + shape_text(given));
    const Input in = input({name, 1, 3}, values, py::dtype::of<double>(), true);
    std::array<double, 3> numbers;
    std::memcpy(numbers.data(), in.values.data, sizeof numbers);  // of any alignment
    return numbers;
}

std::pair<std::vector<swivel_entity>, double> steps_of(const py::object& target, const py::object& pole, double upper,
                                                       double fore)
{
    std::vector<swivel_entity> entities(SWIVEL_ENTITY_COUNT);
    double closing_error = 0;
    const std::array<double, 3> to = array3("target", target), side = array3("pole", pole);
    if (const char* const why = swivel_steps(to.data(), side.data(), upper, fore, entities.data(), &closing_error))
        throw py::value_error(why);
    return {std::move(entities), closing_error};
}

std::string blade_name(std::int64_t blade)
{
    const char* const name = blade < 0 || blade > 31 ? nullptr : swivel_blade_name(static_cast<std::uint32_t>(blade));
    if (!name) throw py::value_error("blade is " + std::to_string(blade) + "; give 0 to 31");
    return name;
}

}  // namespace

void add_steps(py::module_& module)
{
    py::class_<swivel_entity> one(module, "Entity", "One entity of the lecture's five steps, as steps() gives it.");
    one.attr("__module__") = "swivel";
    one.def("__repr__", [](const swivel_entity& entity) {
        return "<Entity " + std::string(entity.name) + ", step " + std::to_string(entity.step) + ": " + entity.meaning +
               ">";
    });
    one.def_readonly("name", &swivel_entity::name, "As the lecture calls it, such as \"S1\".")
        .def_readonly("meaning", &swivel_entity::meaning, "What it is, in a few words.")
        .def_readonly("step", &swivel_entity::step, "The step that makes it, 1 to 5.")
        .def_property_readonly(
            "coefficients", [](const swivel_entity& entity) { return py::array_t<double>(32, entity.coefficients); },
            "Of the 32 blades, which blade_name() names: (32,) float64.");
    module.def("steps", &steps_of, py::arg("target"), py::arg("pole"), py::arg("upper"), py::arg("fore"),
               "The lecture's five steps for one arm in its arm frame, in double.\n\n"
               "target (3,): where the wrist goes. pole (3,): a point on the elbow's side. upper, fore: bone lengths.\n"
               "Gives the list of Entities, and how far their rotors put the wrist from the target, in arm lengths.\n"
               "ValueError where the lecture's formulas divide by zero, such as out of reach.");
    module.def("blade_name", &blade_name, py::arg("blade"),
               "The name of a blade of an Entity's coefficients, 0 to 31, such as \"e1^einf\".");
}

}  // namespace swivel::python
