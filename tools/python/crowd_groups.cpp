// SPDX-License-Identifier: MIT
//
// Crowds as they are made, of groups as Python gives them.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swivel/swivel_regions.hpp"
#include "tools/python/crowd.h"
#include "tools/python/names.h"
#include "tools/python/structures.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

constexpr const char* kCrowdText =
    "Groups of limbs that are solved together.\n\n"
    "groups is the number of limbs, a Group, or a sequence with an entry for each group of limbs that share\n"
    "features and a binding: a number, a Group, or (number, binding), which is short for Group(number,\n"
    "binding). Feature.JOINTS needs the binding that bind_joints() gave. features, on_bad_input and the orders are\n"
    "for groups without their own. The orders are those of Field.SHOULDER_BOX and Field.WRIST_BOX.\n\n"
    "With a skeleton it is a crowd of body_count bodies, whose groups are BodyGroups: limb i of each is body i's.\n"
    "A ShiftGroup among them shifts the bodies, a PropGroup is a thing that hands hold, a LookGroup looks. solve()\n"
    "then takes their pose, and on_bad_input None is OnBadInput.KEEP_POSE instead of REST_POSE. up, of any length but\n"
    "0, is the axis of heights and shifts in the root's frame.\n\n"
    "Targets and shoulder positions start as NaN, lengths as the binding's, or NaN: a limb that never gets them has\n"
    "Flag.BAD_INPUT. A body's hand starts as NaN, which is the incoming one. Parents and other hands start as the\n"
    "identity, without limits; results as the rest pose. After creation the library allocates nothing.\n\n"
    "Arrays have one row for each limb of a group: (n, 3) positions in your unit of length, (n, 4)\n"
    "quaternions x, y, z, w, (n,) single numbers, float32. Different crowds may be used by different\n"
    "threads at once; one crowd may not (RuntimeError), but for readers beside readers, and\n"
    "solve(on_this_thread=True) on blocks that do not overlap.";

// Python's and NumPy's whole numbers; an array is none.
bool is_number(py::handle object) { return PyIndex_Check(object.ptr()) && !py::isinstance<py::array>(object); }

swivel_features features_of(std::int64_t features)
{
    if (features < 0)
        throw py::value_error("features is " + std::to_string(features) + "; give members of swivel.Feature");
    return static_cast<swivel_features>(features);
}

bool is_a(const char* type, py::handle object) { return py::isinstance(object, package(type)); }

// Options of limbs whose group does not say them.
struct Usual {
    swivel_features features;
    swivel_euler_order shoulder_order, wrist_order;
    std::optional<swivel_on_bad_input> on_bad_input;  // none: as the library has it for the kind
};

// Puts the options of a group of limbs into its definition; an option that is None is the usual one. py::cast_error for
// what is no number.
template <class Limb>
void set_options(Limb& def, const Usual& usual, py::handle features, py::handle on_bad_input, py::handle shoulder_order,
                 py::handle wrist_order, py::handle region, const py::object& pole_behind)
{
    using Number = std::optional<std::int64_t>;
    def.features = usual.features;
    def.shoulder_order = usual.shoulder_order;
    def.wrist_order = usual.wrist_order;
    if (usual.on_bad_input) def.on_bad_input = *usual.on_bad_input;
    if (const auto given = features.cast<Number>()) def.features = features_of(*given);
    if (const auto given = on_bad_input.cast<Number>()) def.on_bad_input = on_bad_input_of(*given);
    if (const auto given = shoulder_order.cast<Number>()) def.shoulder_order = order_of(*given);
    if (const auto given = wrist_order.cast<Number>()) def.wrist_order = order_of(*given);
    if (!pole_behind.is_none()) copy("pole_behind", pole_behind, def.pole_behind);
    if (region.is_none()) return;
    if (!py::isinstance<Region>(region))
        throw py::type_error("region: expected a Region, got " + std::string(py::repr(region)));
    def.region = &region.cast<const Region&>().get();  // of the entry, which outlives the call
    def.features |= SWIVEL_WITH_REGION;
}

[[noreturn]] void refuse(const char* expected, py::handle entry)
{
    throw py::type_error("groups: expected " + std::string(expected) + ", got " + std::string(py::repr(entry)));
}

// A number of limbs, or a tuple: the members of swivel.Group, of which all but the first may be missing or None.
swivel_limb_def group_of(py::handle entry, const Usual& usual)
{
    constexpr const char kExpected[] = "a number of limbs, (number of limbs, binding) or a Group";
    constexpr std::size_t kMemberCount = 9;
    const bool is_tuple = py::isinstance<py::tuple>(entry);
    const auto given = is_tuple ? py::reinterpret_borrow<py::tuple>(entry) : py::make_tuple(entry);
    if (given.size() < 1 || given.size() > kMemberCount || !is_number(given[0])) refuse(kExpected, entry);
    const auto member = [&](std::size_t n) { return n < given.size() ? py::object(given[n]) : py::none(); };
    swivel_limb_def def = swivel_default_limb_def(count_of("limb count", given[0].cast<std::int64_t>()));
    try {
        if (!member(1).is_none()) def.binding = member(1).cast<swivel_binding>();
        set_options(def, usual, member(2), member(3), member(4), member(5), member(6), member(8));
        if (!member(7).is_none()) def.twist_bone_count = count_of("twist_bone_count", member(7).cast<std::int64_t>());
    } catch (const py::cast_error&) {
        refuse(kExpected, entry);
    }
    return def;
}

// A swivel.BodyGroup, whose joints are kept in `joints`.
swivel_body_limb_def body_group_of(py::handle entry, const Usual& usual, LimbJoints& joints)
{
    const auto number = [&](const char* name) { return entry.attr(name).cast<std::int64_t>(); };
    swivel_body_limb_def def = swivel_default_body_limb_def(&joints.view);
    try {
        joints = joints_of(number("shoulder"), number("elbow"), number("wrist"),
                           entry.attr("twist_bones").cast<std::vector<std::int64_t>>(), entry.attr("bend"));
        if (const py::object link = entry.attr("link"); !link.is_none())
            def.link = count_of("link", link.cast<std::int64_t>());
        set_options(def, usual, entry.attr("features"), entry.attr("on_bad_input"), entry.attr("shoulder_order"),
                    entry.attr("wrist_order"), entry.attr("region"), entry.attr("pole_behind"));
    } catch (const py::cast_error&) {
        refuse("whole numbers in a BodyGroup", entry);
    }
    def.plant = plant_of(entry.attr("plant"));
    def.ground = ground_of(entry.attr("ground"));
    return def;
}

// A group of any kind.
Definition definition_of(py::handle entry, const Usual& usual, LimbJoints& joints)
{
    if (is_a("BodyGroup", entry)) return body_group_of(entry, usual, joints);
    if (is_a("LookGroup", entry)) return look_of(entry);
    if (is_a("PropGroup", entry)) return prop_of(entry);
    if (is_a("ShiftGroup", entry)) return shift_of(entry);
    return group_of(entry, usual);
}

// From the lowest to the highest byte of any group's rows. A crowd's memory is one piece, so no array lies in between.
Memory memory_of(swivel_crowd* crowd)
{
    const std::less<> before;
    const std::byte *begin = nullptr, *end = nullptr;
    const auto include = [&](const auto& rows) {
        if (!rows.base) return;
        const auto* const first = reinterpret_cast<const std::byte*>(rows.base);
        const auto* const last =
            first + std::size_t{rows.block_count} * rows.row_count * SWIVEL_LANES * sizeof *rows.base;
        if (!begin || before(first, begin)) begin = first;
        if (!end || before(end, last)) end = last;
    };
    for (std::uint32_t group = 0; group < swivel_group_count(crowd); ++group) {
        include(swivel_input_rows(crowd, group));
        include(swivel_result_rows(crowd, group));
    }
    return {begin, static_cast<std::size_t>(end - begin)};
}

HeldCrowd held_crowd(Crowd crowd, std::uint32_t joint_count)
{
    const Memory rows = memory_of(crowd.get());
    return {std::move(crowd), rows, joint_count};
}

constexpr const char* kGroupTypes[] = {"Group", "BodyGroup", "LookGroup", "PropGroup", "ShiftGroup"};
std::vector<py::object> entries_of(const py::object& groups)
{
    const bool is_one = std::ranges::any_of(kGroupTypes, [&](const char* type) { return is_a(type, groups); });
    if (is_one || is_number(groups) || !py::isinstance<py::iterable>(groups)) return {groups};
    std::vector<py::object> entries;
    for (const py::handle entry : groups) entries.push_back(py::reinterpret_borrow<py::object>(entry));
    return entries;
}

HeldCrowd make(const py::object& groups, std::int64_t features, std::int64_t shoulder_order, std::int64_t wrist_order,
               std::optional<std::int64_t> on_bad_input, const py::object& skeleton, std::int64_t body_count,
               const py::object& up)
{
    Usual usual{features_of(features), order_of(shoulder_order), order_of(wrist_order), {}};
    if (on_bad_input) usual.on_bad_input = on_bad_input_of(*on_bad_input);
    const std::vector<py::object> entries = entries_of(groups);
    std::vector<LimbJoints> joints(entries.size());
    std::vector<Definition> definitions;
    for (std::size_t n = 0; n < entries.size(); ++n) definitions.push_back(definition_of(entries[n], usual, joints[n]));
    const std::uint32_t bodies = count_of("body_count", body_count);
    std::array<float, 3> axis;
    copy("up", up, axis);
    if (skeleton.is_none()) {
        if (bodies > 0)
            throw py::value_error("body_count is " + std::to_string(bodies) + ", but there is no skeleton; give it");
        return held_crowd(Crowd(definitions), 0);
    }
    if (!is_a("Skeleton", skeleton))
        throw py::type_error("skeleton: expected a Skeleton, got " + std::string(py::repr(skeleton)));
    const SkeletonArrays bones =
        skeleton_of(skeleton.attr("parents"), skeleton.attr("translations"), skeleton.attr("rotations"));
    return held_crowd(Crowd(bones.view, bodies, definitions, axis), bones.view.joint_count);
}

}  // namespace

void add_creation(CrowdClass& crowd)
{
    crowd.doc() = kCrowdText;
    crowd.def(py::init(&make), py::arg("groups"), py::arg("features") = 0, py::arg("shoulder_order") = 0,
              py::arg("wrist_order") = 0, py::arg("on_bad_input") = py::none(), py::kw_only(),
              py::arg("skeleton") = py::none(), py::arg("body_count") = 0, py::arg("up") = py::make_tuple(0, 1, 0),
              "See the class.");
}

}  // namespace swivel::python
