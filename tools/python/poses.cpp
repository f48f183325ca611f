// SPDX-License-Identifier: MIT
#include "tools/python/poses.h"

#include <string>

#include "tools/python/joint_arrays.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

// Members of swivel.Pose beside the rotations: floats for each joint, and for each body.
struct JointMember {
    const char* name;
    swivel_joint_values swivel_pose::*values;
    py::ssize_t component_count;
    bool is_output;
};
constexpr JointMember kJointMembers[] = {{"translations", &swivel_pose::translations, 3, false},
                                         {"scales", &swivel_pose::scales, 3, false},
                                         {"out_translations", &swivel_pose::translation_results, 3, true},
                                         {"joint_rotations", &swivel_pose::joint_rotations, 4, true},
                                         {"joint_places", &swivel_pose::joint_places, 3, true}};
struct BodyMember {
    const char* name;
    swivel_in swivel_pose::*values;
    std::size_t component_count;
    bool is_position = false;  // in doubles if the root is
};
constexpr BodyMember kBodyMembers[] = {{"root_position", &swivel_pose::root_position, 3, true},
                                       {"root_rotation", &swivel_pose::root_rotation, 4},
                                       {"root_scale", &swivel_pose::root_scale, 1},
                                       {"time", &swivel_pose::time, 1},
                                       {"support_position", &swivel_pose::support_position, 3, true},
                                       {"support_rotation", &swivel_pose::support_rotation, 4},
                                       {"weight", &swivel_pose::weight, 1}};

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

swivel_pose_space space_of(const py::object& given)
{
    try {
        return pose_space_of(given.cast<std::int64_t>());
    } catch (const py::cast_error&) {
        throw py::type_error("space: expected a member of swivel.PoseSpace, got " + std::string(py::repr(given)));
    }
}

// The library says so, too, but calls them results.
void require_out_translations(const py::object& given, swivel_pose_space space)
{
    const auto has = [&](const char* name) { return !given.attr(name).is_none(); };
    const bool change = space == SWIVEL_IN_BODY && has("translations") && !has("matrices");
    if (has("out_translations") && !change)
        throw py::value_error(
            "the pose has out_translations, but only translations in the body's space change; leave them out");
    if (change && has("out") && !has("out_translations"))
        throw py::value_error(
            "the pose has out, but no out_translations, and in the body's space translations change; give them");
}

void add_joint_members(const HeldCrowd& held, const py::object& given, std::uint32_t body_count, PoseArrays& into)
{
    require_out_translations(given, into.view.space);
    const bool in_place = into.view.space == SWIVEL_IN_BODY && given.attr("out_translations").is_none();
    for (const JointMember& member : kJointMembers) {
        const py::object values = given.attr(member.name);
        if (values.is_none()) continue;
        const bool is_output = member.is_output || (in_place && member.values == &swivel_pose::translations);
        const JointValues wanted{member.name, body_count, held.joint_count, {member.component_count}};
        const JointArray array =
            is_output ? joint_output(wanted, values, held.rows) : joint_input(wanted, values, held.rows);
        into.view.*member.values = array.values;
        into.owners.push_back(array.owner);
    }
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
    made.view.space = space_of(given.attr("space"));
    add_rotations(held, given, {"", body_count, held.joint_count, {}}, made);
    add_joint_members(held, given, body_count, made);
    made.view.root_is_double = is_doubles(given.attr("root_position"));
    for (const BodyMember& member : kBodyMembers) {
        const py::object values = given.attr(member.name);
        if (values.is_none()) continue;
        const bool doubles = made.view.root_is_double && member.is_position;
        const Input in = input({member.name, body_count, member.component_count, "bodies"}, values,
                               doubles ? py::dtype::of<double>() : py::dtype::of<float>(), true, held.rows);
        made.view.*member.values = in.values;
        made.owners.push_back(in.owner);
    }
    return made;
}

}  // namespace swivel::python
