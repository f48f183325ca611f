// SPDX-License-Identifier: MIT
//
// Crowds as they are made, their counts, and their rows as arrays.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <string>

#include "tools/python/crowd.h"
#include "tools/python/fields.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

constexpr const char* kCrowdText =
    "Limbs that are solved together: Crowd(groups, features=0, shoulder_order=XYZ, wrist_order=XYZ).\n\n"
    "groups is the number of limbs, or a sequence with one entry for each group of limbs that share a\n"
    "binding: a number, or (number, binding) with what bind() gave, which Feature.JOINTS needs. The\n"
    "orders are those of Field.SHOULDER_BOX and Field.WRIST_BOX. Targets and shoulder positions start as\n"
    "NaN, lengths as the binding's, or NaN: a limb that never gets them has Flag.BAD_INPUT. Parents and\n"
    "hands start as the identity, without limits; results as the rest pose. After creation the library\n"
    "allocates nothing.\n\n"
    "Arrays have one row for each limb of a group: (n, 3) positions in your unit of length, (n, 4)\n"
    "quaternions x, y, z, w, (n,) single numbers, float32. Different crowds may be used by different\n"
    "threads at once; one crowd may not (RuntimeError), but for readers beside readers, and\n"
    "solve(on_this_thread=True) on blocks that do not overlap.";

// Python's and NumPy's whole numbers; an array is none.
std::optional<std::uint32_t> limb_count_of(py::handle object)
{
    if (!PyIndex_Check(object.ptr()) || py::isinstance<py::array>(object)) return {};
    return count_of("limb count", object.cast<std::int64_t>());
}

swivel_group_def group_of(py::handle entry)
{
    if (const auto limb_count = limb_count_of(entry)) return group(*limb_count);
    if (py::isinstance<py::tuple>(entry) && py::len(entry) == 2) {
        const auto pair = py::reinterpret_borrow<py::tuple>(entry);
        const auto limb_count = limb_count_of(pair[0]);
        if (limb_count && py::isinstance<swivel_binding>(pair[1]))
            return group(*limb_count, pair[1].cast<swivel_binding>());
    }
    throw py::type_error("groups: expected a number of limbs or (number of limbs, binding), got " +
                         std::string(py::repr(entry)));
}

HeldCrowd make(const py::object& groups, std::int64_t features, std::int64_t shoulder_order, std::int64_t wrist_order)
{
    std::vector<swivel_group_def> defs;
    if (limb_count_of(groups) || !py::isinstance<py::iterable>(groups))
        defs.push_back(group_of(groups));
    else
        for (const py::handle entry : groups) defs.push_back(group_of(entry));
    swivel_crowd_def def = swivel_default_crowd_def();
    if (features < 0)
        throw py::value_error("features is " + std::to_string(features) + "; give members of swivel.Feature");
    def.features = static_cast<swivel_features>(features);
    def.group_count = static_cast<std::uint32_t>(defs.size());
    def.groups = defs.data();
    def.shoulder_order = order_of(shoulder_order);
    def.wrist_order = order_of(wrist_order);
    return {Crowd(def), def.features, component_counts(def.features)};
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

template <class Rows>
py::array all_rows(const py::object& self, Rows rows, bool writeable)
{
    const auto type = py::dtype::of<std::remove_pointer_t<decltype(rows.base)>>();
    if (!rows.base) throw py::value_error("this crowd does not have these rows; see Feature.COMPACT");
    return view(self, type, rows.base, rows.block_count, rows.row_count, rows.row_count, writeable);
}

template <class Rows>
py::array some_rows(const py::object& self, Rows rows, const py::dtype& type, swivel_field field, bool writeable)
{
    const swivel_crowd* const crowd = self.cast<const HeldCrowd&>().crowd.get();
    return view(self, type, rows.base + std::size_t{swivel_field_first_row(crowd, field)} * SWIVEL_LANES,
                rows.block_count, rows.row_count, swivel_field_row_count(crowd, field), writeable);
}

py::array field_rows(const py::object& self, std::int64_t number)
{
    const HeldCrowd& held = self.cast<const HeldCrowd&>();
    const swivel_field field = field_of(number);
    float none[1];
    check(swivel_read(held.crowd.get(), field, 0, 0, 0, {none, SIZE_MAX}));  // this crowd has the field
    if (field < SWIVEL_SHOULDER)
        return some_rows(self, swivel_input_rows(held.crowd.get()), py::dtype::of<float>(), field, true);
    if (held.features & SWIVEL_COMPACT)
        return some_rows(self, swivel_compact_rows(held.crowd.get()), py::dtype::of<std::uint16_t>(), field, false);
    const auto type = field == SWIVEL_FLAGS ? py::dtype::of<std::uint32_t>() : py::dtype::of<float>();
    return some_rows(self, swivel_result_rows(held.crowd.get()), type, field, false);
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
    crowd.doc() = kCrowdText;
    crowd.def(py::init(&make), py::arg("groups"), py::arg("features") = 0, py::arg("shoulder_order") = 0,
              py::arg("wrist_order") = 0, "See the class.");
    crowd.def_property_readonly(
        "features", [](const HeldCrowd& held) { return py::module_::import("swivel").attr("Feature")(held.features); },
        "What the crowd was made with, as Feature.");
    crowd.def("__repr__", [](const HeldCrowd& held) {
        std::string limbs;
        for (std::uint32_t group = 0; group < group_count(held); ++group)
            limbs += (group > 0 ? ", " : "") + std::to_string(swivel_group_limb_count(held.crowd.get(), group));
        const py::object features = py::module_::import("swivel").attr("Feature")(held.features);
        return "<Crowd of [" + limbs + "] limbs, " + std::string(py::repr(features)) + ">";
    });
    crowd.def_property_readonly("group_count", &group_count, "Number of groups.");
    crowd.def_property_readonly(
        "block_count", [](const HeldCrowd& held) { return swivel_block_count(held.crowd.get()); },
        "Number of blocks of LANES limbs; each group starts one.");
    crowd.def_property_readonly(
        "lane_count",
        [](const HeldCrowd& held) { return std::uint64_t{swivel_block_count(held.crowd.get())} * SWIVEL_LANES; },
        "Number of lanes, one for each limb and, past a group's end, padding: block_count * LANES.");
    crowd.def(
        "limb_count", [](const HeldCrowd& held, std::int64_t group) { return limbs_of(held, group, 0, {}).count; },
        py::arg("group") = 0, "Number of limbs in a group. ValueError if there is no such group.");
    crowd.def("limbs", &limb_range, py::arg("group") = 0,
              "The lanes of a group's limbs as a range: indices for solve(limbs=...) and into a mask.");
    crowd.def(
        "component_count",
        [](const HeldCrowd& held, std::int64_t field) { return held.component_counts[field_of(field)]; },
        py::arg("field"), "How many numbers a value of the field has; 0 if this crowd does not have it.");
    crowd.def("rows", &field_rows, py::arg("field"),
              "The field's rows as an array of shape (block_count, rows, LANES) that shares the crowd's memory:\n"
              "lane i is [i // LANES, :, i % LANES]. float32; uint32 for Field.FLAGS; uint16 words for results with\n"
              "Feature.COMPACT. Inputs may be written to, the fast way in; results are for reading. The array keeps\n"
              "the crowd alive. ValueError if this crowd does not have the field.");
    crowd.def_property_readonly(
        "input_rows",
        [](const py::object& self) {
            return all_rows(self, swivel_input_rows(self.cast<HeldCrowd&>().crowd.get()), true);
        },
        "All input rows, shape (block_count, rows, LANES) float32, sharing the crowd's memory.");
    crowd.def_property_readonly(
        "result_rows",
        [](const py::object& self) {
            return all_rows(self, swivel_result_rows(self.cast<HeldCrowd&>().crowd.get()), false);
        },
        "All result rows, shape (block_count, rows, LANES) float32, to read. ValueError with Feature.COMPACT.");
    crowd.def_property_readonly(
        "compact_rows",
        [](const py::object& self) {
            return all_rows(self, swivel_compact_rows(self.cast<HeldCrowd&>().crowd.get()), false);
        },
        "All result rows with Feature.COMPACT, shape (block_count, rows, LANES) uint16, to read; else ValueError.");
}

}  // namespace swivel::python
