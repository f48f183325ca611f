// SPDX-License-Identifier: MIT
//
// Crowds as they are made, of groups as Python gives them.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <functional>
#include <string>
#include <vector>

#include "tools/python/crowd.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

constexpr const char* kCrowdText =
    "Groups of limbs that are solved together.\n\n"
    "groups is the number of limbs, a Group, or a sequence with an entry for each group of limbs that share\n"
    "features and a binding: a number, a Group, or (number, binding), which is short for Group(number,\n"
    "binding). Feature.JOINTS needs the binding that bind() gave. features, on_bad_input and the orders are\n"
    "for groups without their own. The orders are those of Field.SHOULDER_BOX and Field.WRIST_BOX.\n\n"
    "Targets and shoulder positions start as NaN, lengths as the binding's, or NaN: a limb that never gets them has\n"
    "Flag.BAD_INPUT. Parents and hands start as the identity, without limits; results as the rest pose. After\n"
    "creation the library allocates nothing.\n\n"
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

// A number of limbs, or a tuple: the members of swivel.Group, of which all but the first may be missing or None. What
// they do not say is as in `usual`.
swivel_group_def group_of(py::handle entry, const swivel_group_def& usual)
{
    constexpr std::size_t kMemberCount = 6;
    const auto refuse = [&] {
        throw py::type_error("groups: expected a number of limbs, (number of limbs, binding) or a Group, got " +
                             std::string(py::repr(entry)));
    };
    const bool is_tuple = py::isinstance<py::tuple>(entry);
    const auto given = is_tuple ? py::reinterpret_borrow<py::tuple>(entry) : py::make_tuple(entry);
    if (given.size() < 1 || given.size() > kMemberCount || !is_number(given[0])) refuse();
    const auto says = [&](std::size_t member) {
        if (member >= given.size() || given[member].is_none()) return false;
        if (member > 1 && !is_number(given[member])) refuse();
        return true;
    };
    swivel_group_def def = usual;
    def.limb_count = count_of("limb count", given[0].cast<std::int64_t>());
    if (says(1)) {
        if (!py::isinstance<swivel_binding>(given[1])) refuse();
        def.binding = given[1].cast<swivel_binding>();
    }
    if (says(2)) def.features = features_of(given[2].cast<std::int64_t>());
    if (says(3)) def.on_bad_input = on_bad_input_of(given[3].cast<std::int64_t>());
    if (says(4)) def.shoulder_order = order_of(given[4].cast<std::int64_t>());
    if (says(5)) def.wrist_order = order_of(given[5].cast<std::int64_t>());
    return def;
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

HeldCrowd make(const py::object& groups, std::int64_t features, std::int64_t shoulder_order, std::int64_t wrist_order,
               std::int64_t on_bad_input)
{
    swivel_group_def usual = swivel_default_group_def(0);
    usual.features = features_of(features);
    usual.shoulder_order = order_of(shoulder_order);
    usual.wrist_order = order_of(wrist_order);
    usual.on_bad_input = on_bad_input_of(on_bad_input);
    std::vector<swivel_group_def> defs;
    const py::object one_group = py::module_::import("swivel").attr("Group");  // a tuple, but not of groups
    if (is_number(groups) || py::isinstance(groups, one_group) || !py::isinstance<py::iterable>(groups))
        defs.push_back(group_of(groups, usual));
    else
        for (const py::handle entry : groups) defs.push_back(group_of(entry, usual));
    Crowd crowd(std::span<const swivel_group_def>{defs});
    const Memory rows = memory_of(crowd.get());
    return {std::move(crowd), rows};
}

}  // namespace

void add_creation(CrowdClass& crowd)
{
    crowd.doc() = kCrowdText;
    crowd.def(py::init(&make), py::arg("groups"), py::arg("features") = 0, py::arg("shoulder_order") = 0,
              py::arg("wrist_order") = 0, py::arg("on_bad_input") = 0, "See the class.");
}

}  // namespace swivel::python
