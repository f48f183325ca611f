// SPDX-License-Identifier: MIT
#include "tools/python/poses.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>

#include "swivel/swivel_bodies.h"
#include "tools/python/arrays.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

// The shape that an array must have: a value for each joint of each body. Its shape is (bodies, joints) and that of a
// value.
struct JointValues {
    std::string name;  // in messages
    std::size_t body_count, joint_count;
    Shape value;  // (3,), (4,), (3, 4) or (4, 4)
};

// The values as swivel takes them, how the numbers of a value lie, and what keeps the memory. Rows of numbers are
// SWIVEL_ROTATIONS.
struct JointArray {
    swivel_joint_values values;
    swivel_pose_form form;
    pybind11::array owner;
};

// The strides of a value's own axes, of floats.
struct Form {
    swivel_pose_form form;
    Shape strides;
};
const Form kForms[] = {{SWIVEL_ROTATIONS, {4}},
                       {SWIVEL_MATRIX_ROWS, {16, 4}},
                       {SWIVEL_MATRIX_COLUMNS, {4, 16}},
                       {SWIVEL_MATRIX_COLUMNS3, {4, 12}}};

Shape each_joint(const JointValues& wanted)
{
    Shape shape = wanted.value;
    shape.insert(shape.begin(), static_cast<py::ssize_t>(wanted.joint_count));
    return shape;
}

Shape each_body(const JointValues& wanted)
{
    Shape shape = each_joint(wanted);
    shape.insert(shape.begin(), static_cast<py::ssize_t>(wanted.body_count));
    return shape;
}

// The form in which an array lies: none where the numbers of a value are not side by side, or values in each other.
const Form* form_of(const JointValues& wanted, const py::array& array, bool may_repeat)
{
    const py::ssize_t *const end = array.strides() + array.ndim(), *const own = end - wanted.value.size();
    py::ssize_t bytes = array.itemsize();
    for (const py::ssize_t count : wanted.value) bytes *= count;
    for (py::ssize_t axis = 0; axis < own - array.strides(); ++axis)
        if (array.shape(axis) > 1 && array.strides(axis) < bytes && !(may_repeat && array.strides(axis) == 0))
            return nullptr;
    const auto* const found = std::find_if(std::begin(kForms), std::end(kForms), [&](const Form& each) {
        return std::equal(own, end, each.strides.begin(), each.strides.end());
    });
    return found == std::end(kForms) ? nullptr : found;
}

JointArray view(const JointValues& wanted, const py::array& array, const Form& form)
{
    const auto joints = static_cast<std::size_t>(array.ndim()) - wanted.value.size() - 1;
    const bool is_one = joints == 0 || wanted.body_count == 1;
    const auto stride = [&](std::size_t axis) { return static_cast<std::size_t>(array.strides()[axis]); };
    return {{const_cast<void*>(array.data()), is_one ? 0 : stride(0), stride(joints), nullptr}, form.form, array};
}

// object: as for input(). An array without the first axis is all bodies'.
JointArray joint_input(const JointValues& wanted, py::handle object, const Memory& apart)
{
    const auto floats = py::dtype::of<float>();
    py::array given = given_array(wanted.name, object);
    if (const Shape shape = shape_of(given); shape != each_body(wanted) && shape != each_joint(wanted))
        throw py::value_error(wanted.name + ": expected shape " + shape_text(each_body(wanted)) + ", or " +
                              shape_text(each_joint(wanted)) + " for all bodies, got " + shape_text(given));
    const bool as_it_is = given.dtype().equal(floats) && form_of(wanted, given, true) && !touches(given, apart);
    if (!as_it_is) given = converted(wanted.name, given, floats);
    return view(wanted, given, *form_of(wanted, given, true));
}

// object: an array of float32 of this shape that may be written, else ValueError or TypeError. It is never copied, so
// each value's numbers must lie side by side.
JointArray joint_output(const JointValues& wanted, py::handle object, const Memory& apart)
{
    const py::array given = array_to_write(wanted.name, each_body(wanted), object, py::dtype::of<float>(), apart);
    const Form* const form = form_of(wanted, given, false);
    if (!form)
        throw py::value_error(wanted.name +
                              ": the numbers of a value must lie side by side, and joints and bodies apart; give an "
                              "array that numpy.ascontiguousarray() makes");
    return view(wanted, given, *form);
}

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
                                         {"joint_positions", &swivel_pose::joint_positions, 3, true}};
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

constexpr const char kOrigin[] = "origin";  // the key that is no field

// ValueError for a key that no streams have.
void check_keys(std::uint32_t group, const py::dict& given)
{
    for (const auto& [key, array] : given) {
        const std::string name = py::str(key);
        const auto is_called = [&](const swivel_field_info& info) { return info.name == name; };
        if (name == kOrigin || std::any_of(fields().begin(), fields().end(), is_called)) continue;
        std::string message =
            "streams of group " + std::to_string(group) + ": there is no key '" + name + "'; there are " + kOrigin;
        for (const swivel_field_info& info : fields()) message += std::string(", ") + info.name;
        throw py::value_error(message);
    }
}

void add_streams(const HeldCrowd& held, const Limbs& limbs, const py::dict& given, bool far, StreamArrays& into)
{
    check_keys(limbs.group, given);
    const bool from_origin = given.contains(kOrigin);
    const auto take = [&](const char* key, const Values& values, bool as_doubles) {
        const auto type = as_doubles ? py::dtype::of<double>() : py::dtype::of<float>();
        into.inputs.push_back(input(values, given[key], type, true, held.rows));
        return into.inputs.back().values;
    };
    Streams streams;
    for (const swivel_field_info& info : fields()) {
        if (!given.contains(info.name)) continue;
        const Values values = values_of(held, info.field, limbs);
        if (info.kind == SWIVEL_FIELD_INPUT) {
            streams.in(info.field, take(info.name, values, (far || from_origin) && info.is_position));
            continue;
        }
        const py::object array = given[info.name];
        if (array.is_none()) throw py::type_error(values.name + ": expected an array to write to, got None");
        into.outputs.push_back(output(values, array, type_of(info.field), held.rows));
        into.outputs.back().start();
        streams.out(info.field, into.outputs.back().values);
    }
    if (from_origin) streams.origin(take(kOrigin, {kOrigin, limbs.count, 3}, true));
    into.streams.push_back(streams);
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

StreamArrays streams_of(const HeldCrowd& held, const py::object& given, const std::vector<std::uint32_t>& groups,
                        bool far)
{
    std::vector<py::dict> dicts;
    if (py::isinstance<py::dict>(given))
        dicts.push_back(given);
    else
        for (const py::handle each : given) {
            if (!py::isinstance<py::dict>(each)) throw py::type_error("streams: expected a dict for each group");
            dicts.push_back(py::reinterpret_borrow<py::dict>(each));
        }
    if (dicts.size() != groups.size())
        throw py::value_error("streams: expected one for each of " + std::to_string(groups.size()) + " groups, got " +
                              std::to_string(dicts.size()));
    std::vector<std::size_t> order(groups.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return groups[a] < groups[b]; });
    StreamArrays streams;
    for (const std::size_t n : order) add_streams(held, limbs_of(held, groups[n], 0, {}), dicts[n], far, streams);
    return streams;
}

}  // namespace swivel::python
