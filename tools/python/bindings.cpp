// SPDX-License-Identifier: MIT
#include <pybind11/numpy.h>

#include <algorithm>
#include <string>

#include "swivel/swivel.hpp"
#include "tools/python/arrays.h"
#include "tools/python/helpers.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

struct Member {
    const char* name;
    float (swivel_binding::*quaternion)[4];
    const char* text;
};
constexpr Member kQuaternions[] = {
    {"parent_from_arm", &swivel_binding::parent_from_arm, "Arm frame to the shoulder's parent joint: (4,) float32."},
    {"upper_from_arm", &swivel_binding::upper_from_arm, "Arm frame at rest to the shoulder joint's own: (4,) float32."},
    {"fore_from_arm", &swivel_binding::fore_from_arm, "Arm frame at rest to the elbow joint's own: (4,) float32."},
    {"shoulder_rest", &swivel_binding::shoulder_rest, "The shoulder's local rotation at rest: (4,) float32."},
    {"elbow_rest", &swivel_binding::elbow_rest, "The elbow's local rotation at rest: (4,) float32."},
    {"wrist_rest", &swivel_binding::wrist_rest, "The wrist's local rotation at rest: (4,) float32."},
};

template <std::size_t N>
void copy(const char* name, const py::object& given, float (&numbers)[N])
{
    const Input in = input({name, 1, N}, given, py::dtype::of<float>(), true);
    std::copy_n(static_cast<const char*>(in.values.data), sizeof numbers, reinterpret_cast<char*>(numbers));
}

swivel_binding make_binding(const py::object& parent_from_arm, const py::object& upper_from_arm,
                            const py::object& fore_from_arm, const py::object& shoulder_rest,
                            const py::object& elbow_rest, const py::object& wrist_rest, const py::object& lengths)
{
    const py::object* const given[] = {&parent_from_arm, &upper_from_arm, &fore_from_arm,
                                       &shoulder_rest,   &elbow_rest,     &wrist_rest};
    swivel_binding binding;
    for (std::size_t n = 0; n < std::size(kQuaternions); ++n)
        copy(kQuaternions[n].name, *given[n], binding.*kQuaternions[n].quaternion);
    copy("lengths", lengths, binding.lengths);
    return binding;
}

swivel_binding bind_chain(const py::object& elbow_offset, const py::object& wrist_offset, const py::object& bend,
                          const py::object& shoulder_rotation, const py::object& elbow_rotation,
                          const py::object& wrist_rotation)
{
    swivel_chain chain = swivel_default_chain();
    copy("elbow_offset", elbow_offset, chain.elbow_offset);
    copy("wrist_offset", wrist_offset, chain.wrist_offset);
    copy("bend", bend, chain.bend);
    copy("shoulder_rotation", shoulder_rotation, chain.shoulder_rotation);
    copy("elbow_rotation", elbow_rotation, chain.elbow_rotation);
    copy("wrist_rotation", wrist_rotation, chain.wrist_rotation);
    return bind(chain);
}

}  // namespace

void add_bindings(py::module_& module)
{
    py::class_<swivel_binding> binding(
        module, "Binding",
        "How the arm frame lies in a skeleton's joints, and their rest pose, six unit quaternions x, y, z, w, and\n"
        "the bones' lengths. Made by bind(); an entry of Crowd's groups is (limb_count, this). The constructor\n"
        "takes all of it as keywords, to keep and restore one.");
    binding.attr("__module__") = "swivel";
    binding.def(py::init(&make_binding), py::kw_only(), py::arg("parent_from_arm"), py::arg("upper_from_arm"),
                py::arg("fore_from_arm"), py::arg("shoulder_rest"), py::arg("elbow_rest"), py::arg("wrist_rest"),
                py::arg("lengths"), "See the class.");
    for (const Member& member : kQuaternions)
        binding.def_property_readonly(
            member.name,
            [quaternion = member.quaternion](const swivel_binding& b) { return py::array_t<float>(4, b.*quaternion); },
            member.text);
    binding.def("__repr__", [](const py::object& self) {
        std::string text = "Binding(";
        for (const Member& member : kQuaternions)
            text +=
                std::string(member.name) + "=" + std::string(py::str(self.attr(member.name).attr("tolist")())) + ", ";
        return text + "lengths=" + std::string(py::str(self.attr("lengths").attr("tolist")())) + ")";
    });
    binding.def_property_readonly(
        "lengths", [](const swivel_binding& b) { return py::array_t<float>(2, b.lengths); },
        "Upper arm and forearm, in the chain's unit, with which limbs start: (2,) float32.");
    const py::tuple identity = py::make_tuple(0, 0, 0, 1), none = py::make_tuple(0, 0, 0);
    module.def("bind", &bind_chain, py::arg("elbow_offset"), py::arg("wrist_offset"), py::arg("bend") = none,
               py::arg("shoulder_rotation") = identity, py::arg("elbow_rotation") = identity,
               py::arg("wrist_rotation") = identity,
               "The binding of a limb from its rest pose, as a skeleton stores it.\n\n"
               "elbow_offset (3,): the elbow's place in the shoulder joint's frame; wrist_offset (3,): the wrist's\n"
               "in the elbow joint's; bend (3,): where flexion carries the forearm, in the shoulder joint's frame, of\n"
               "any length, or zeros: as the rest pose is bent, by more than 10 degrees. Rotations (4,) are\n"
               "x, y, z, w: each joint's at rest, relative to its parent joint. ValueError for a straight rest pose\n"
               "without a bend, a bend along the upper arm, bones of no length and quaternions without a direction.");
}

}  // namespace swivel::python
