// SPDX-License-Identifier: MIT
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/python/arrays.h"
#include "tools/python/helpers.h"
#include "tools/python/structures.h"

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
    {"elbow_parent_from_arm", &swivel_binding::elbow_parent_from_arm,
     "Arm frame at rest to the elbow's parent joint: (4,) float32."},
    {"fore_from_arm", &swivel_binding::fore_from_arm, "Arm frame at rest to the elbow joint's own: (4,) float32."},
    {"wrist_parent_from_arm", &swivel_binding::wrist_parent_from_arm,
     "Arm frame at rest to the wrist's parent joint: (4,) float32."},
    {"shoulder_rest", &swivel_binding::shoulder_rest, "The shoulder's local rotation at rest: (4,) float32."},
    {"elbow_rest", &swivel_binding::elbow_rest, "The elbow's local rotation at rest: (4,) float32."},
    {"wrist_rest", &swivel_binding::wrist_rest, "The wrist's local rotation at rest: (4,) float32."},
};

struct TwistMember {
    const char* name;
    float (swivel_binding::*quaternions)[SWIVEL_MAX_TWIST_BONES][4];
    const char* text;
};
constexpr TwistMember kTwistFrames[] = {
    {"twist_parent_from_arm", &swivel_binding::twist_parent_from_arm,
     "Arm frame at rest to the parent joint of each twist bone: (n, 4) float32."},
    {"twist_from_arm", &swivel_binding::twist_from_arm, "The same to its own frame: (n, 4) float32."},
};

// As many as there are, and the forearm's for those that there are not.
void copy_frames(const TwistMember& member, const py::object& given, swivel_binding& binding)
{
    auto& frames = binding.*member.quaternions;
    for (auto& frame : frames) std::copy_n(binding.fore_from_arm, 4, frame);
    if (binding.twist_bone_count == 0) return;
    const Input in = input({member.name, binding.twist_bone_count, 4}, given, py::dtype::of<float>(), false);
    for (std::uint32_t n = 0; n < binding.twist_bone_count; ++n)
        std::memcpy(frames[n], static_cast<const char*>(in.values.data) + n * in.values.stride, sizeof frames[n]);
}

swivel_binding make_binding(const py::object& parent_from_arm, const py::object& upper_from_arm,
                            const py::object& elbow_parent_from_arm, const py::object& fore_from_arm,
                            const py::object& wrist_parent_from_arm, const py::object& shoulder_rest,
                            const py::object& elbow_rest, const py::object& wrist_rest, const py::object& lengths,
                            const py::object& twist_parent_from_arm, const py::object& twist_from_arm)
{
    const py::object* const given[] = {&parent_from_arm,
                                       &upper_from_arm,
                                       &elbow_parent_from_arm,
                                       &fore_from_arm,
                                       &wrist_parent_from_arm,
                                       &shoulder_rest,
                                       &elbow_rest,
                                       &wrist_rest};
    static_assert(std::size(given) == std::size(kQuaternions));
    swivel_binding binding = swivel_default_binding();
    for (std::size_t n = 0; n < std::size(kQuaternions); ++n)
        copy(kQuaternions[n].name, *given[n], binding.*kQuaternions[n].quaternion);
    copy("lengths", lengths, binding.lengths);
    const std::size_t bones = length_of("twist_from_arm", twist_from_arm);
    if (bones > SWIVEL_MAX_TWIST_BONES)
        throw py::value_error("twist_from_arm: there are " + std::to_string(bones) +
                              " twist bones; a limb has at most " + std::to_string(SWIVEL_MAX_TWIST_BONES));
    binding.twist_bone_count = static_cast<std::uint32_t>(bones);
    copy_frames(kTwistFrames[0], twist_parent_from_arm, binding);
    copy_frames(kTwistFrames[1], twist_from_arm, binding);
    return binding;
}

swivel_binding bind_joints(const py::object& parents, const py::object& translations, std::int64_t shoulder,
                           std::int64_t elbow, std::int64_t wrist, const py::object& rotations,
                           const std::vector<std::int64_t>& twist_bones, const py::object& bend)
{
    const SkeletonArrays skeleton = skeleton_of(parents, translations, rotations);
    const LimbJoints joints = joints_of(shoulder, elbow, wrist, twist_bones, bend);
    return bind(skeleton.view, joints.view);
}

}  // namespace

void add_bindings(py::module_& module)
{
    py::class_<swivel_binding> binding(
        module, "Binding",
        "How the arm frame lies in a skeleton's joints, and their rest pose, unit quaternions x, y, z, w, and the\n"
        "bones' lengths. Made by bind_joints(); an entry of Crowd's groups is Group(limb_count, this). The\n"
        "constructor takes all of it as keywords, to keep and restore one.");
    binding.attr("__module__") = "swivel";
    binding.def(py::init(&make_binding), py::kw_only(), py::arg("parent_from_arm"), py::arg("upper_from_arm"),
                py::arg("elbow_parent_from_arm"), py::arg("fore_from_arm"), py::arg("wrist_parent_from_arm"),
                py::arg("shoulder_rest"), py::arg("elbow_rest"), py::arg("wrist_rest"), py::arg("lengths"),
                py::arg("twist_parent_from_arm") = py::tuple(), py::arg("twist_from_arm") = py::tuple(),
                "See the class.");
    for (const Member& member : kQuaternions)
        binding.def_property_readonly(
            member.name,
            [quaternion = member.quaternion](const swivel_binding& b) { return py::array_t<float>(4, b.*quaternion); },
            member.text);
    for (const TwistMember& member : kTwistFrames)
        binding.def_property_readonly(
            member.name,
            [quaternions = member.quaternions](const swivel_binding& b) {
                return py::array_t<float>({py::ssize_t{b.twist_bone_count}, py::ssize_t{4}}, (b.*quaternions)[0]);
            },
            member.text);
    binding.def("__repr__", [](const py::object& self) {
        std::string text = "Binding(";
        const auto add = [&](const char* name, const char* end) {
            text += std::string(name) + "=" + std::string(py::str(self.attr(name).attr("tolist")())) + end;
        };
        for (const Member& member : kQuaternions) add(member.name, ", ");
        for (const TwistMember& member : kTwistFrames) add(member.name, ", ");
        add("lengths", ")");
        return text;
    });
    binding.def_property_readonly(
        "lengths", [](const swivel_binding& b) { return py::array_t<float>(2, b.lengths); },
        "Upper arm and forearm, in the skeleton's unit, with which limbs start: (2,) float32.");
    module.def(
        "bind_joints", &bind_joints, py::arg("parents"), py::arg("translations"), py::arg("shoulder"), py::arg("elbow"),
        py::arg("wrist"), py::arg("rotations") = py::none(), py::arg("twist_bones") = py::tuple(),
        py::arg("bend") = py::make_tuple(0, 0, 0),
        "The binding of a limb in a skeleton at rest, by its joints' indices.\n\n"
        "parents (n,): each joint's parent, -1 for a root, in any order; translations (n, 3): its place in its\n"
        "parent's frame; rotations (n, 4): relative to its parent, x, y, z, w, or None if no joint is turned.\n"
        "The elbow is below the shoulder, the wrist below the elbow; joints in between keep their rest\n"
        "rotations. twist_bones: joints below the elbow that share the hand's twist, from elbow to wrist; none of\n"
        "them carries another or the wrist. bend (3,): where flexion carries the forearm, in the shoulder joint's\n"
        "frame, of any length, or zeros: as the rest pose is bent, by more than 10 degrees. Results are local\n"
        "rotations relative to the joints' own parents. ValueError for joints that do not exist or are no limb, a\n"
        "straight rest pose without a bend, a bend along the upper arm, bones of no length and quaternions without a\n"
        "direction.");
}

}  // namespace swivel::python
