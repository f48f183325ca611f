// SPDX-License-Identifier: MIT
#include "tools/python/names.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace py = pybind11;

namespace swivel::python {

namespace {

struct Named {
    std::string name;  // without SWIVEL_
    std::int64_t value;
};
using Table = std::vector<Named>;

const std::vector<swivel_feature_info>& features()
{
    static const std::vector<swivel_feature_info> all = [] {
        std::vector<swivel_feature_info> found;
        for (swivel_feature_info info; swivel_describe_feature(static_cast<std::uint32_t>(found.size()), &info);)
            found.push_back(info);
        return found;
    }();
    return all;
}

Table feature_table()
{
    Table table;
    for (const swivel_feature_info& info : features())
        table.push_back({info.name, static_cast<std::int64_t>(info.feature)});
    return table;
}

Table field_table()
{
    Table table;
    for (const swivel_field_info& info : fields()) {
        table.push_back({info.name, info.field});
        for (char& letter : table.back().name)
            letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    }
    return table;
}

Table flag_table()
{
    Table table;
    for (std::uint32_t flag = 1; flag != 0; flag <<= 1)
        if (const char* const name = swivel_flag_name(flag)) table.push_back({name, flag});
    return table;
}

struct Enum {
    const char* kind;
    const char* name;
    const char* text;
    Table table;
};
const std::vector<Enum>& enums()
{
    static const std::vector<Enum> all = {
        {"IntFlag", "Feature",
         "What a group takes and gives; fixed at creation, combined with |.\n\n"
         "Whatever is off costs neither memory nor time. A BodyGroup is in the world and has an incoming pose without\n"
         "asking.",
         feature_table()},
        {"IntEnum", "Field",
         "A field of a group's limbs: an input up to SHOULDER, from there on a result.\n\n"
         "Crowd.component_count() tells how many numbers its values have; docs/fields.md lists units and meanings.",
         field_table()},
        {"IntFlag", "Flag", "Bits of a limb's flag word, the result Field.FLAGS. Hard poses are results, not errors.",
         flag_table()},
        {"IntEnum",
         "EulerOrder",
         "The axes of three rotations that make one, each about the axis as the ones before have left it: R = Rx Ry Rz "
         "is XYZ.",
         {{"XYZ", SWIVEL_XYZ},
          {"XZY", SWIVEL_XZY},
          {"YZX", SWIVEL_YZX},
          {"YXZ", SWIVEL_YXZ},
          {"ZXY", SWIVEL_ZXY},
          {"ZYX", SWIVEL_ZYX}}},
        {"IntEnum",
         "OnBadInput",
         "What a limb with Flag.BAD_INPUT gets.\n\n"
         "REST_POSE: its rest pose. KEEP_POSE: it keeps its results and its values in streams; only its flags\n"
         "are written.",
         {{"REST_POSE", SWIVEL_REST_POSE}, {"KEEP_POSE", SWIVEL_KEEP_POSE}}},
        {"IntEnum",
         "PoseSpace",
         "What the joints of a Pose are relative to.\n\n"
         "LOCAL: each to its parent. IN_BODY: all to the root; what hangs below a limb then moves with it.",
         {{"LOCAL", SWIVEL_LOCAL}, {"IN_BODY", SWIVEL_IN_BODY}}},
        {"IntEnum",
         "Kind",
         "The kind of a group.\n\n"
         "LIMB: a Group of free limbs. BODY_LIMB, LOOK, PROP, SHIFT: a BodyGroup, LookGroup, PropGroup, ShiftGroup.",
         {{"LIMB", SWIVEL_KIND_LIMB},
          {"BODY_LIMB", SWIVEL_KIND_BODY_LIMB},
          {"LOOK", SWIVEL_KIND_LOOK},
          {"PROP", SWIVEL_KIND_PROP},
          {"SHIFT", SWIVEL_KIND_SHIFT}}},
    };
    return all;
}

void add_enum(py::module_& module, const Enum& each)
{
    py::dict members;
    for (const auto& [name, value] : each.table) members[name.c_str()] = value;
    py::object made = py::module_::import("enum").attr(each.kind)(each.name, members, py::arg("module") = "swivel");
    made.attr("__doc__") = each.text;
    module.attr(each.name) = made;
}

// A constant of the header, without its SWIVEL_, as Python has it; empty for a name that is none.
std::string member_called(const std::string& name)
{
    for (const Enum& each : enums())
        if (std::any_of(each.table.begin(), each.table.end(), [&](const Named& one) { return one.name == name; }))
            return std::string(each.name) + "." + name;
    return {};
}

// The number as one of this enum's; ValueError if it has none.
template <class Wanted>
Wanted member_of(const char* enum_name, const char* what, std::int64_t number)
{
    const auto& wanted = *std::find_if(enums().begin(), enums().end(),
                                       [&](const Enum& each) { return each.name == std::string(enum_name); });
    if (std::none_of(wanted.table.begin(), wanted.table.end(), [&](const Named& one) { return one.value == number; }))
        throw py::value_error("there is no " + std::string(what) + " " + std::to_string(number) +
                              "; give a member of swivel." + enum_name);
    return static_cast<Wanted>(number);
}

// The named tuple that swivel.solve() gives: the results that all free limbs have, positions, and the others or None.
void add_arms(py::module_& module)
{
    py::list names, more;
    for (const swivel_field_info& info : fields())
        if (info.kind != SWIVEL_FIELD_INPUT && has_kind(info, SWIVEL_KIND_LIMB))
            (info.needs ? more : names).append(info.name);
    for (const char* name : {"elbow_position", "wrist_position", "residual"}) names.append(name);
    const py::object nones = py::make_tuple(py::none()) * py::int_(more.size());
    const py::object made =
        py::module_::import("collections")
            .attr("namedtuple")("Arms", names + more, py::arg("defaults") = nones, py::arg("module") = "swivel");
    made.attr("__doc__") =
        "What solve() gives for n arms: the results of docs/fields.md, shaped as docs/python.md says.\n\n"
        "None: the arms were not asked for it. elbow_position and wrist_position are (n, 3) float64, in the space and\n"
        "unit of the targets. residual is (n,) float64, from target to wrist, or effector, in arm lengths.";
    module.attr("Arms") = made;
}

}  // namespace

std::span<const swivel_field_info> fields()
{
    static const std::vector<swivel_field_info> all = [] {
        std::vector<swivel_field_info> found;
        for (swivel_field_info info; swivel_describe_field(static_cast<std::uint32_t>(found.size()), &info);)
            found.push_back(info);
        return found;
    }();
    return all;
}

const swivel_field_info& info_of(swivel_field field)
{
    return *std::find_if(fields().begin(), fields().end(),
                         [&](const swivel_field_info& info) { return info.field == field; });
}

swivel_features needed_features(swivel_field field)
{
    swivel_features needed = info_of(field).needs;
    for (swivel_features before = ~needed; before != needed;) {
        before = needed;
        for (const swivel_feature_info& info : features())
            if (needed & info.feature) needed |= info.needs;
    }
    return needed;
}

std::string in_python(const std::string& line)
{
    const auto is_letter = [](char c) { return c == '_' || std::isalpha(static_cast<unsigned char>(c)); };
    std::string said;
    for (auto at = line.begin(); at != line.end();) {
        const auto word_end = std::find_if_not(at, line.end(), is_letter);
        const std::string word(at, word_end == at ? at + 1 : word_end);
        at += static_cast<std::ptrdiff_t>(word.size());
        const std::string member = word.starts_with("SWIVEL_") ? member_called(word.substr(7)) : "";
        said += !member.empty() ? member : word.starts_with("swivel_") ? word.substr(7) : word;
    }
    return said;
}

swivel_field field_of(std::int64_t number) { return member_of<swivel_field>("Field", "field", number); }
swivel_euler_order order_of(std::int64_t number)
{
    return member_of<swivel_euler_order>("EulerOrder", "order of axes", number);
}
swivel_on_bad_input on_bad_input_of(std::int64_t number)
{
    return member_of<swivel_on_bad_input>("OnBadInput", "way to treat bad input", number);
}
swivel_pose_space pose_space_of(std::int64_t number)
{
    return member_of<swivel_pose_space>("PoseSpace", "space of poses", number);
}

py::object package(const char* name) { return py::module_::import("swivel").attr(name); }
py::object feature_set(swivel_features features) { return package("Feature")(features); }
py::object kind_member(swivel_kind kind) { return package("Kind")(static_cast<int>(kind)); }

void add_enums(py::module_& module)
{
    for (const Enum& each : enums()) add_enum(module, each);
    add_arms(module);
}

}  // namespace swivel::python
