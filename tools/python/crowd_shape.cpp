// SPDX-License-Identifier: MIT
//
// A crowd's counts, and its rows as arrays.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <string>

#include "tools/python/crowd.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

std::uint32_t& entered(HeldCrowd& held, Way way)
{
    const auto own = static_cast<std::size_t>(way);
    for (std::size_t other = 0; other < held.users.size(); ++other)
        if (held.users[other] > 0 && (other != own || way == Way::kAlone))
            throw std::runtime_error(
                "another thread is using this crowd; one crowd serves one thread at a time, but for solving blocks");
    return ++held.users[own];
}

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

std::uint32_t packed_row(const HeldCrowd& held, std::int64_t field, std::int64_t group)
{
    const std::uint32_t g = limbs_of(held, group, 0, {}).group;
    return swivel_packed_row(held.crowd.get(), g, field_of(field));
}

py::array pack(const HeldCrowd& held, std::int64_t number)
{
    const Limbs limbs = limbs_of(held, number, 0, {});
    const std::uint32_t rows = swivel_packed_row(held.crowd.get(), limbs.group, SWIVEL_RESULT_END);
    const std::uint32_t blocks = (limbs.count + SWIVEL_LANES - 1) / SWIVEL_LANES;
    py::array_t<std::uint16_t> words(std::vector<py::ssize_t>{blocks, rows, SWIVEL_LANES});
    check(swivel_pack(held.crowd.get(), limbs.group, {0, blocks}, words.mutable_data()));
    return words;
}

py::array field_rows(const py::object& self, std::int64_t field_number, std::int64_t group_number)
{
    const HeldCrowd& held = self.cast<const HeldCrowd&>();
    swivel_crowd* const crowd = held.crowd.get();
    const swivel_field field = field_of(field_number);
    const std::uint32_t group = limbs_of(held, group_number, 0, {}).group;
    float none[1];
    check(swivel_read(crowd, field, group, 0, 0, {none, SIZE_MAX}));  // this group has the field
    const bool is_input = info_of(field).kind == SWIVEL_FIELD_INPUT;
    const swivel_rows rows = is_input ? swivel_input_rows(crowd, group) : swivel_result_rows(crowd, group);
    return view(self, type_of(field),
                rows.base + std::size_t{swivel_field_first_row(crowd, group, field)} * SWIVEL_LANES, rows.block_count,
                rows.row_count, swivel_field_row_count(crowd, group, field), is_input);
}

py::object limb_range(const HeldCrowd& held, std::int64_t group)
{
    const Limbs limbs = limbs_of(held, group, 0, {});
    const std::uint32_t first = swivel_group_first_limb(held.crowd.get(), limbs.group);
    return py::module_::import("builtins").attr("range")(first, first + limbs.count);
}

}  // namespace

Use::Use(HeldCrowd& held, Way way) : count_(entered(held, way)) {}
Use::~Use() { --count_; }

std::uint32_t count_of(const char* name, std::int64_t number)
{
    if (number < 0 || number > std::int64_t{UINT32_MAX})
        throw py::value_error(std::string(name) + " is " + std::to_string(number) + "; it is from 0 to 4294967295");
    return static_cast<std::uint32_t>(number);
}

Limbs limbs_of(const HeldCrowd& held, std::int64_t group, std::int64_t first, std::optional<std::int64_t> count)
{
    const std::uint32_t g = count_of("group", group), begin = count_of("first", first);
    const std::uint32_t has = swivel_group_limb_count(held.crowd.get(), g);
    if (has == 0)
        throw py::value_error("group " + std::to_string(g) + " does not exist; this crowd has " +
                              std::to_string(swivel_group_count(held.crowd.get())));
    const std::uint32_t limb_count = count ? count_of("count", *count) : has - std::min(begin, has);
    if (begin > has || limb_count > has - begin)
        throw py::value_error(std::to_string(limb_count) + " limbs from limb " + std::to_string(begin) +
                              " on are not all in group " + std::to_string(g) + ", which has " + std::to_string(has));
    return {g, begin, limb_count};
}

py::dtype type_of(swivel_field field)
{
    return field == SWIVEL_FLAGS ? py::dtype::of<std::uint32_t>() : py::dtype::of<float>();
}

Values values_of(const HeldCrowd& held, swivel_field field, const Limbs& limbs)
{
    float none[1];
    check(swivel_read(held.crowd.get(), field, limbs.group, 0, 0, {none, SIZE_MAX}));
    return {info_of(field).name, limbs.count, swivel_field_row_count(held.crowd.get(), limbs.group, field)};
}

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
        py::arg("group") = 0, "The features that a group of limbs was made with, as Feature.");
    crowd.def(
        "kind",
        [](const HeldCrowd& held, std::int64_t group) {
            return kind_member(swivel_group_kind(held.crowd.get(), limbs_of(held, group, 0, {}).group));
        },
        py::arg("group") = 0, "The kind of a group, as Kind.");
    crowd.def(
        "limb_count", [](const HeldCrowd& held, std::int64_t group) { return limbs_of(held, group, 0, {}).count; },
        py::arg("group") = 0, "Number of limbs in a group. ValueError if there is no such group.");
    crowd.def("limbs", &limb_range, py::arg("group") = 0,
              "The lanes of a group's limbs as a range: indices into a mask.");
    crowd.def(
        "component_count",
        [](const HeldCrowd& held, std::int64_t field, std::int64_t group) {
            const std::uint32_t g = limbs_of(held, group, 0, {}).group;
            return swivel_field_row_count(held.crowd.get(), g, field_of(field));
        },
        py::arg("field"), py::arg("group") = 0,
        "How many numbers a value of the field has; 0 if the group does not have it.");
    crowd.def(
        "rows", &field_rows, py::arg("field"), py::arg("group") = 0,
        "The field's rows as an array of shape (blocks, rows, LANES) that shares the crowd's memory: limb i of\n"
        "the group is [i // LANES, :, i % LANES]. float32; uint32 for Field.FLAGS. Inputs may be written to, the\n"
        "fast way in; results are for reading. The array keeps the crowd alive. ValueError if the group does not\n"
        "have the field.");
    crowd.def("pack", &pack, py::arg("group") = 0,
              "The results of a group in 16-bit words, shape (blocks, rows, LANES) uint16, as swivel_pack() says.");
    crowd.def("packed_row", &packed_row, py::arg("field"), py::arg("group") = 0,
              "The row in which a field of pack() begins: 3 rows a rotation, 1 a number, 2 for the flags.");
}

}  // namespace swivel::python
