// SPDX-License-Identifier: MIT
//
// A crowd's counts, and its rows as arrays.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <string>

#include "tools/python/crowd.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

// A view of some rows of each block, which keeps the crowd alive. Results are for reading.
py::array view(const py::object& self, const py::dtype& type, void* base, py::ssize_t block_count,
               py::ssize_t rows_in_block, py::ssize_t row_count, bool writeable)
{
    const py::ssize_t item = type.itemsize();
    const std::vector<py::ssize_t> shape{block_count, row_count, SWIVEL_LANES};
    const std::vector<py::ssize_t> strides{rows_in_block * SWIVEL_LANES * item, SWIVEL_LANES * item, item};
    py::array rows(type, shape, strides, base, self);
    if (!writeable) rows.attr("setflags")(py::arg("write") = false);
    return rows;
}

template <class Rows>
py::array all_rows(const py::object& self, Rows rows, bool writeable)
{
    const auto type = py::dtype::of<std::remove_pointer_t<decltype(rows.base)>>();
    if (!rows.base) throw py::value_error("this group does not have these rows; see Feature.COMPACT");
    return view(self, type, rows.base, rows.block_count, rows.row_count, rows.row_count, writeable);
}

py::array compact_rows(const py::object& self, std::int64_t number)
{
    const HeldCrowd& held = self.cast<const HeldCrowd&>();
    return all_rows(self, swivel_compact_rows(held.crowd.get(), limbs_of(held, number, 0, {}).group), false);
}

py::array field_rows(const py::object& self, std::int64_t field_number, std::int64_t group_number)
{
    const HeldCrowd& held = self.cast<const HeldCrowd&>();
    swivel_crowd* const crowd = held.crowd.get();
    const swivel_field field = field_of(field_number);
    const std::uint32_t group = limbs_of(held, group_number, 0, {}).group;
    float none[1];
    check(swivel_read(crowd, field, group, 0, 0, {none, SIZE_MAX}));  // this group has the field
    const auto some_rows = [&](auto rows, const py::dtype& type, bool writeable) {
        return view(self, type, rows.base + std::size_t{swivel_field_first_row(crowd, group, field)} * SWIVEL_LANES,
                    rows.block_count, rows.row_count, swivel_field_row_count(crowd, group, field), writeable);
    };
    if (info_of(field).kind == SWIVEL_FIELD_INPUT)
        return some_rows(swivel_input_rows(crowd, group), type_of(field), true);
    if (swivel_group_features(crowd, group) & SWIVEL_COMPACT)
        return some_rows(swivel_compact_rows(crowd, group), py::dtype::of<std::uint16_t>(), false);
    return some_rows(swivel_result_rows(crowd, group), type_of(field), false);
}

py::object limb_range(const HeldCrowd& held, std::int64_t group)
{
    const Limbs limbs = limbs_of(held, group, 0, {});
    const std::uint32_t first = swivel_group_first_limb(held.crowd.get(), limbs.group);
    return py::module_::import("builtins").attr("range")(first, first + limbs.count);
}

}  // namespace

void add_shape(CrowdClass& crowd)
{
    crowd.def("__repr__", [](const HeldCrowd& held) {
        py::list limbs, features;
        for (std::uint32_t group = 0; group < swivel_group_count(held.crowd.get()); ++group) {
            limbs.append(swivel_group_limb_count(held.crowd.get(), group));
            features.append(feature_set(swivel_group_features(held.crowd.get(), group)));
        }
        return py::str("<Crowd of {} limbs, {}>").format(limbs, features);
    });
    crowd.def_property_readonly(
        "group_count", [](const HeldCrowd& held) { return swivel_group_count(held.crowd.get()); }, "Number of groups.");
    crowd.def_property_readonly(
        "block_count", [](const HeldCrowd& held) { return swivel_block_count(held.crowd.get()); },
        "Number of blocks of LANES limbs; each group starts one.");
    crowd.def_property_readonly(
        "lane_count",
        [](const HeldCrowd& held) { return std::uint64_t{swivel_block_count(held.crowd.get())} * SWIVEL_LANES; },
        "Number of lanes, one for each limb and, past a group's end, padding: block_count * LANES.");
    crowd.def(
        "features",
        [](const HeldCrowd& held, std::int64_t group) {
            return feature_set(swivel_group_features(held.crowd.get(), limbs_of(held, group, 0, {}).group));
        },
        py::arg("group") = 0, "What a group was made with, as Feature.");
    crowd.def(
        "limb_count", [](const HeldCrowd& held, std::int64_t group) { return limbs_of(held, group, 0, {}).count; },
        py::arg("group") = 0, "Number of limbs in a group. ValueError if there is no such group.");
    crowd.def("limbs", &limb_range, py::arg("group") = 0,
              "The lanes of a group's limbs as a range: indices for solve(limbs=...) and into a mask.");
    crowd.def(
        "component_count",
        [](const HeldCrowd& held, std::int64_t field, std::int64_t group) {
            const std::uint32_t g = limbs_of(held, group, 0, {}).group;
            return swivel_component_count(field_of(field), swivel_group_features(held.crowd.get(), g));
        },
        py::arg("field"), py::arg("group") = 0,
        "How many numbers a value of the field has; 0 if the group does not have it.");
    crowd.def("rows", &field_rows, py::arg("field"), py::arg("group") = 0,
              "The field's rows as an array of shape (blocks, rows, LANES) that shares the crowd's memory: limb i of\n"
              "the group is [i // LANES, :, i % LANES]. float32; uint32 for Field.FLAGS; uint16 words for results\n"
              "with Feature.COMPACT. Inputs may be written to, the fast way in; results are for reading. The array\n"
              "keeps the crowd alive. ValueError if the group does not have the field.");
    crowd.def("compact_rows", &compact_rows, py::arg("group") = 0,
              "All result rows of a group with Feature.COMPACT, shape (blocks, rows, LANES) uint16, to read; else\n"
              "ValueError.");
}

}  // namespace swivel::python
