// SPDX-License-Identifier: MIT
#include "tools/python/poses.h"

#include <string>

#include "tools/python/joint_arrays.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

// Members of swivel.Pose that are only read: 3 floats for each joint; and some for each root.
struct JointMember {
    const char* name;
    swivel_joint_values swivel_pose::*values;
};
constexpr JointMember kJointMembers[] = {{"translations", &swivel_pose::translations},
                                         {"scales", &swivel_pose::scales}};
struct RootMember {
    const char* name;
    swivel_in swivel_pose::*values;
    std::size_t component_count;
};
constexpr RootMember kRootMembers[] = {{"root_position", &swivel_pose::root_position, 3},
                                       {"root_rotation", &swivel_pose::root_rotation, 4},
                                       {"root_scale", &swivel_pose::root_scale, 1}};

bool is_doubles(const py::object& given)
{
    return py::isinstance<py::array>(given) && py::array(given).dtype().equal(py::dtype::of<double>());
}

// The rotations, or matrices of three rows or four, and where they go.
void add_rotations(const HeldCrowd& held, const py::object& given, JointValues wanted, PoseArrays& into)
{
    const py::object rotations = given.attr("rotations"), matrices = given.attr("matrices"), out = given.attr("out");
    if (rotations.is_none() == matrices.is_none())
        throw py::value_error("the pose has " + std::string(rotations.is_none() ? "no" : "both") +
                              " rotations and matrices; give one of the two");
    const py::object& poses = rotations.is_none() ? matrices : rotations;
    wanted.name = rotations.is_none() ? "matrices" : "rotations";
    wanted.value = {4};
    if (rotations.is_none()) {
        const Shape shape = shape_of(given_array(wanted.name, matrices));
        const bool has_three_rows = shape.size() > 1 && shape[shape.size() - 2] == 3;
        wanted.value = {has_three_rows ? 3 : 4, 4};
    }
    const JointArray in =
        out.is_none() ? joint_output(wanted, poses, held.rows) : joint_input(wanted, poses, held.rows);
    into.view.form = in.form;
    into.view.rotations = in.values;
    into.owners.push_back(in.owner);
    if (out.is_none()) return;
    wanted.name = "out";
    const JointArray to = joint_output(wanted, out, held.rows);
    if (to.form != in.form)
        throw py::value_error("out: its matrices lie in another order than those that are read; give a copy of these");
    into.view.results = to.values;
    into.owners.push_back(to.owner);
}

}  // namespace

PoseArrays pose_of(const HeldCrowd& held, const py::object& given)
{
    if (!py::isinstance(given, package("Pose")))
        throw py::type_error("pose: expected a Pose, got " +
                             std::string(py::str(py::type::handle_of(given).attr("__name__"))));
    PoseArrays made{swivel_default_pose(), {}};
    if (held.joint_count == 0) return made;  // which the library refuses
    const std::uint32_t body_count = swivel_group_limb_count(held.crowd.get(), 0);
    add_rotations(held, given, {"", body_count, held.joint_count, {}}, made);
    for (const JointMember& member : kJointMembers) {
        const py::object values = given.attr(member.name);
        if (values.is_none()) continue;
        const JointArray in = joint_input({member.name, body_count, held.joint_count, {3}}, values, held.rows);
        made.view.*member.values = in.values;
        made.owners.push_back(in.owner);
    }
    made.view.root_is_double = is_doubles(given.attr("root_position"));
    for (const RootMember& member : kRootMembers) {
        const py::object values = given.attr(member.name);
        if (values.is_none()) continue;
        const bool doubles = made.view.root_is_double && member.values == &swivel_pose::root_position;
        const Input in = input({member.name, body_count, member.component_count, "bodies"}, values,
                               doubles ? py::dtype::of<double>() : py::dtype::of<float>(), true, held.rows);
        made.view.*member.values = in.values;
        made.owners.push_back(in.owner);
    }
    return made;
}

}  // namespace swivel::python
