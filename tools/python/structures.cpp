// SPDX-License-Identifier: MIT
#include "tools/python/structures.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iomanip>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tools/python/crowd.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

template <class Number = float>
Number number_of(const std::string& name, const py::object& value)
{
    try {
        return value.cast<Number>();
    } catch (const py::cast_error&) {
        throw py::type_error(name + ": expected a " + (std::is_integral_v<Number> ? "whole " : "") + "number, got " +
                             std::string(py::repr(value)));
    }
}

// A number for each joint, or one for all.
void copy_each(const std::string& name, const py::object& given, std::span<float> to)
{
    const Input in = input({name, to.size(), 1, "joints"}, given, py::dtype::of<float>(), true);
    for (std::size_t n = 0; n < to.size(); ++n)
        std::memcpy(&to[n], static_cast<const char*>(in.values.data) + n * in.values.stride, sizeof(float));
}

bool is_of_each_joint(const swivel_constant_info& info) { return info.count == SWIVEL_MAX_LOOK_JOINTS; }

// The constants of a structure, in its order.
std::vector<swivel_constant_info> constants_of(std::string_view structure)
{
    std::vector<swivel_constant_info> found;
    swivel_constant_info info;
    for (std::uint32_t n = 0; swivel_describe_constant(n, &info); ++n)
        if (structure == info.structure) found.push_back(info);
    return found;
}

// Fills in the constants of a structure from attributes of their names. joint_count: of a look.
template <class Structure>
void take_constants(const std::string& structure, const py::handle& given, Structure& to, std::size_t joint_count = 0)
{
    for (const swivel_constant_info& info : constants_of(structure)) {
        const std::string name = structure + "." + info.name;
        const py::object value = given.attr(info.name);
        auto* const first = reinterpret_cast<float*>(reinterpret_cast<std::byte*>(&to) + info.offset);
        if (is_of_each_joint(info))
            copy_each(name, value, {first, joint_count});
        else if (info.count > 1)
            copy(name, value, {first, info.count});
        else
            *first = number_of(name, value);
    }
}

// The number of the fewest digits that become the same float, as the header has it. Python prints them, because older
// standard libraries of Apple's have no std::to_chars() for floats.
py::float_ short_number(float x)
{
    for (int digits = 1; digits <= 9; ++digits) {  // nine are enough for every float
        const py::float_ number(py::str("{:.{}g}").format(x, digits));
        if (static_cast<float>(number) == x) return number;
    }
    return x;  // NaN
}
py::object default_of(const swivel_constant_info& info)
{
    if (info.count == 1 || is_of_each_joint(info)) return short_number(info.defaults[0]);
    py::list numbers;
    for (std::uint32_t n = 0; n < info.count; ++n) numbers.append(short_number(info.defaults[n]));
    return py::tuple(numbers);
}
// Its line in a class's documentation.
std::string line_of(const swivel_constant_info& info)
{
    std::ostringstream line;
    line << '\n' << std::left << std::setw(15) << info.name << ' ';
    if (is_of_each_joint(info))
        line << "(joints,), or a number, the same of all: ";
    else if (info.count > 1)
        line << '(' << info.count << ",) ";
    line << info.text << " (" << info.unit << (*info.unit ? ", " : "") << info.min << " to " << info.max << ')';
    return line.str();
}

// A member of a class beside its constants. Type: for type checkers, of names that swivel/__init__.py imports.
struct FirstMember {
    const char *name, *type;
    std::optional<int> usual;
    const char* text;
};
// Makes the named tuple of a structure's constants in the module.
void add_class(py::module_& module, const char* name, const char* structure, const char* text,
               const std::optional<FirstMember>& first = {})
{
    py::list names, defaults;
    py::dict types;
    std::string doc = std::string(text) + '\n';
    if (first) {
        names.append(first->name), types[first->name] = first->type;
        if (first->usual) defaults.append(*first->usual);
        doc += first->text;
    }
    for (const swivel_constant_info& info : constants_of(structure)) {
        names.append(info.name), defaults.append(default_of(info));
        types[info.name] = info.count > 1 ? "npt.ArrayLike" : "float";
        doc += line_of(info);
    }
    const py::object made =
        py::module_::import("collections")
            .attr("namedtuple")(name, names, py::arg("defaults") = py::tuple(defaults), py::arg("module") = "swivel");
    made.attr("__doc__") = doc;
    made.attr("__annotations__") = types;
    module.attr(name) = made;
}

void require(const char* name, const char* type, const py::object& given)
{
    if (!py::isinstance(given, package(type)))
        throw py::type_error(std::string(name) + ": expected a " + type + ", got " + std::string(py::repr(given)));
}

}  // namespace

SkeletonArrays skeleton_of(const py::object& parents, const py::object& translations, const py::object& rotations)
{
    const std::size_t count = length_of("parents", parents);
    const auto floats = py::dtype::of<float>();
    SkeletonArrays made{swivel_default_skeleton(),
                        input({"parents", count, 1}, parents, py::dtype::of<std::int32_t>(), false),
                        input({"translations", count, 3}, translations, floats, false),
                        {}};
    if (!rotations.is_none()) made.rotations = input({"rotations", count, 4}, rotations, floats, false);
    made.view.joint_count = count_of("number of joints", static_cast<std::int64_t>(count));
    made.view.parents = made.parents.values;
    made.view.translations = made.translations.values;
    made.view.rotations = made.rotations.values;
    return made;
}

LimbJoints joints_of(std::int64_t shoulder, std::int64_t elbow, std::int64_t wrist,
                     const std::vector<std::int64_t>& twist_bones, const py::object& bend)
{
    LimbJoints made;
    made.view =
        swivel_default_limb_joints(count_of("shoulder", shoulder), count_of("elbow", elbow), count_of("wrist", wrist));
    for (const std::int64_t bone : twist_bones) made.twist_bones.push_back(count_of("twist_bones", bone));
    made.view.twist_bones = made.twist_bones.data();
    made.view.twist_bone_count = count_of("number of twist bones", static_cast<std::int64_t>(twist_bones.size()));
    copy("bend", bend, made.view.bend);
    return made;
}

swivel_plant plant_of(const py::object& given)
{
    require("plant", "Plant", given);
    swivel_plant made = swivel_default_plant();
    take_constants("plant", given, made);
    return made;
}

swivel_ground ground_of(const py::object& given)
{
    require("ground", "Ground", given);
    swivel_ground made = swivel_default_ground();
    take_constants("ground", given, made);
    return made;
}

swivel_shift_def shift_of(const py::handle& group)
{
    swivel_shift_def made = swivel_default_shift_def();
    take_constants("shift", group, made);
    return made;
}

swivel_prop_def prop_of(const py::handle& group)
{
    swivel_prop_def made = swivel_default_prop_def();
    made.joint = number_of<std::int32_t>("prop.joint", group.attr("joint"));
    take_constants("prop", group, made);
    return made;
}

swivel_look_def look_of(const py::handle& group)
{
    swivel_look_def made = swivel_default_look_def();
    std::vector<std::int64_t> joints;
    try {
        joints = group.attr("joints").cast<std::vector<std::int64_t>>();
    } catch (const py::cast_error&) {
        throw py::type_error("look.joints: expected numbers of joints, got " +
                             std::string(py::repr(group.attr("joints"))));
    }
    made.joint_count = static_cast<std::uint32_t>(joints.size());
    const std::size_t count = std::min<std::size_t>(joints.size(), SWIVEL_MAX_LOOK_JOINTS);
    for (std::size_t n = 0; n < count; ++n) made.joints[n] = count_of("look.joints", joints[n]);
    take_constants("look", group, made, count);
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

void add_constants(py::module_& module)
{
    add_class(module, "Plant", "plant",
              "How the limbs of a BodyGroup with Feature.WITH_PLANT stand: each plants its effector, or its wrist.\n\n"
              "Limb lengths are both bones of the skeleton at rest, times the root's scale. speed and height are\n"
              "for Feature.PLANT_BY_MOTION.\n");
    add_class(module, "Ground", "ground",
              "How the feet of a BodyGroup with Feature.WITH_GROUND stand on ground as it lies.\n\n"
              "Their effectors are the toes.\n");
    add_class(module, "ShiftGroup", "shift",
              "The shift of each body along the crowd's `up`, so that limbs with Feature.WITH_PELVIS_FIT reach.\n\n"
              "One of a Crowd's groups. It has no features and names no joints. Field.SHIFT[0] is by how much the\n"
              "root, or the pelvis, moves. Field.NEXT_TARGET is the next target.\n");
    add_class(module, "PropGroup", "prop",
              "A thing that one hand or two of each body hold, such as a rifle: BodyGroups with Feature.WITH_LINK.\n\n"
              "One of a Crowd's groups. It is no limb and has no features. Field.PROP_POSITION and\n"
              "Field.PROP_ROTATION say where it is, or else its joint, or else the hands of the incoming pose. It\n"
              "moves as little as it must so that all hands reach. Field.PROP_TRANSFORM is where it then is.\n",
              FirstMember{"joint", "int", -1, "\njoint           of the skeleton, which no limb turns; -1: none"});
    add_class(
        module, "LookGroup", "look",
        "A chain of joints of each body that looks: the line of sight in the last meets Field.LOOK_TARGET.\n\n"
        "One of a Crowd's groups. It is no limb and has no features. It comes after the shift and before all\n"
        "props and limbs, so limbs may hang below it. An eye is a LookGroup of one joint, after that of the\n"
        "head. Field.SIGHT is where the line then is: its start and its direction. With a rate the pose\n"
        "needs its time.\n",
        FirstMember{"joints",
                    "Sequence[int]",
                    {},
                    "\njoints          1 to 8 of the skeleton, each below the one before, such as neck and head"});
}

}  // namespace swivel::python
