// SPDX-License-Identifier: MIT
#include "tools/python/names.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

namespace py = pybind11;

namespace swivel::python {

namespace {

constexpr Named kFeatures[] = {
    {"WORLD", SWIVEL_WORLD},
    {"JOINTS", SWIVEL_JOINTS},
    {"WITH_HAND", SWIVEL_WITH_HAND},
    {"POLE_DIRECTION", SWIVEL_POLE_DIRECTION},
    {"COMPACT", SWIVEL_COMPACT},
    {"WITH_EFFECTOR", SWIVEL_WITH_EFFECTOR},
    {"WITH_ANGLE", SWIVEL_WITH_ANGLE},
    {"POLE_NORMAL", SWIVEL_POLE_NORMAL},
    {"WITH_INCOMING", SWIVEL_WITH_INCOMING},
    {"POLE_INCOMING", SWIVEL_POLE_INCOMING},
    {"WITH_WEIGHTS", SWIVEL_WITH_WEIGHTS},
    {"WITH_REACH", SWIVEL_WITH_REACH},
    {"WITH_MOST_SWIVEL", SWIVEL_WITH_MOST_SWIVEL},
    {"WITH_FLEXION_LIMIT", SWIVEL_WITH_FLEXION_LIMIT},
    {"WITH_SHOULDER_CONE", SWIVEL_WITH_SHOULDER_CONE},
    {"WITH_HUMERAL_TWIST", SWIVEL_WITH_HUMERAL_TWIST},
    {"WITH_SHOULDER_BOX", SWIVEL_WITH_SHOULDER_BOX},
    {"WITH_HAND_CONE", SWIVEL_WITH_HAND_CONE},
    {"WITH_FOREARM_TWIST", SWIVEL_WITH_FOREARM_TWIST},
    {"WITH_HAND_TWIST", SWIVEL_WITH_HAND_TWIST},
    {"WITH_WRIST_BOX", SWIVEL_WITH_WRIST_BOX},
    {"WITH_TWIST_BONES", SWIVEL_WITH_TWIST_BONES},
    {"WITH_AIM", SWIVEL_WITH_AIM},
    {"WITH_CLAVICLE", SWIVEL_WITH_CLAVICLE},
    {"BUDGET", SWIVEL_BUDGET},
};
constexpr Named kFields[] = {
    {"TARGET", SWIVEL_TARGET},
    {"POLE", SWIVEL_POLE},
    {"LENGTHS", SWIVEL_LENGTHS},
    {"SHOULDER_POSITION", SWIVEL_SHOULDER_POSITION},
    {"PARENT_ROTATION", SWIVEL_PARENT_ROTATION},
    {"PARENT_SCALE", SWIVEL_PARENT_SCALE},
    {"HAND", SWIVEL_HAND},
    {"EFFECTOR", SWIVEL_EFFECTOR},
    {"ANGLE", SWIVEL_ANGLE},
    {"INCOMING_SHOULDER", SWIVEL_INCOMING_SHOULDER},
    {"INCOMING_ELBOW", SWIVEL_INCOMING_ELBOW},
    {"INCOMING_WRIST", SWIVEL_INCOMING_WRIST},
    {"WEIGHTS", SWIVEL_WEIGHTS},
    {"REACH", SWIVEL_REACH},
    {"MOST_SWIVEL", SWIVEL_MOST_SWIVEL},
    {"FLEXION_LIMIT", SWIVEL_FLEXION_LIMIT},
    {"SHOULDER_CONE", SWIVEL_SHOULDER_CONE},
    {"HUMERAL_TWIST", SWIVEL_HUMERAL_TWIST},
    {"SHOULDER_BOX", SWIVEL_SHOULDER_BOX},
    {"HAND_CONE", SWIVEL_HAND_CONE},
    {"FOREARM_TWIST", SWIVEL_FOREARM_TWIST},
    {"HAND_TWIST", SWIVEL_HAND_TWIST},
    {"WRIST_BOX", SWIVEL_WRIST_BOX},
    {"AIM", SWIVEL_AIM},
    {"CLAVICLE", SWIVEL_CLAVICLE},
    {"SHOULDER", SWIVEL_SHOULDER},
    {"ELBOW", SWIVEL_ELBOW},
    {"WRIST", SWIVEL_WRIST},
    {"FLAGS", SWIVEL_FLAGS},
    {"STRETCH", SWIVEL_STRETCH},
    {"NORMAL", SWIVEL_NORMAL},
    {"TWIST", SWIVEL_TWIST_BONES},
    {"CLAVICLE_TURN", SWIVEL_CLAVICLE_TURN},
};
constexpr Named kFlags[] = {
    {"REACHED", SWIVEL_REACHED},
    {"SOFTENED", SWIVEL_SOFTENED},
    {"STRETCHED", SWIVEL_STRETCHED},
    {"CLAMPED_FAR", SWIVEL_CLAMPED_FAR},
    {"CLAMPED_NEAR", SWIVEL_CLAMPED_NEAR},
    {"SWIVEL_UNDEFINED", SWIVEL_SWIVEL_UNDEFINED},
    {"LIMITED_FLEXION", SWIVEL_LIMITED_FLEXION},
    {"LIMITED_SHOULDER_CONE", SWIVEL_LIMITED_SHOULDER_CONE},
    {"LIMITED_HUMERAL_TWIST", SWIVEL_LIMITED_HUMERAL_TWIST},
    {"LIMITED_SHOULDER_BOX", SWIVEL_LIMITED_SHOULDER_BOX},
    {"LIMITED_HAND_CONE", SWIVEL_LIMITED_HAND_CONE},
    {"LIMITED_FOREARM_TWIST", SWIVEL_LIMITED_FOREARM_TWIST},
    {"LIMITED_HAND_TWIST", SWIVEL_LIMITED_HAND_TWIST},
    {"LIMITED_WRIST_BOX", SWIVEL_LIMITED_WRIST_BOX},
    {"LIMITED_STEP", SWIVEL_LIMITED_STEP},
    {"INFEASIBLE", SWIVEL_INFEASIBLE},
    {"JUMPED", SWIVEL_JUMPED},
    {"BAD_INPUT", SWIVEL_BAD_INPUT},
};
constexpr Named kEulerOrders[] = {
    {"XYZ", SWIVEL_XYZ}, {"XZY", SWIVEL_XZY}, {"YZX", SWIVEL_YZX},
    {"YXZ", SWIVEL_YXZ}, {"ZXY", SWIVEL_ZXY}, {"ZYX", SWIVEL_ZYX},
};
static_assert(std::size(kFields) == SWIVEL_FIELD_COUNT, "name the header's new field here");

constexpr const char* kFeatureText =
    "What a crowd takes and gives; fixed at creation, combined with |.\n\n"
    "Whatever is off costs neither memory nor time. n twist bones are n * Feature.WITH_TWIST_BONES, n from 1 to 7.";
constexpr const char* kFieldText =
    "A field of a crowd's limbs: an input up to SHOULDER, from there on a result.\n\n"
    "Crowd.component_count() tells how many numbers its values have; docs/python.md lists units and meanings.";
constexpr const char* kFlagText =
    "Bits of a limb's flag word, the result Field.FLAGS. Hard poses are results, not errors.";
constexpr const char* kEulerOrderText =
    "The axes of three rotations that make one, each about the axis as the ones before have left it: R = Rx Ry Rz is "
    "XYZ.";

void add_enum(py::module_& module, const char* kind, const char* name, std::span<const Named> table, const char* text)
{
    py::dict members;
    for (const Named& each : table) members[each.name] = each.value;
    py::object made = py::module_::import("enum").attr(kind)(name, members, py::arg("module") = "swivel");
    made.attr("__doc__") = text;
    module.attr(name) = made;
}

// A constant of the header, without its SWIVEL_, as Python has it; empty for a name that is none.
std::string member_called(const std::string& name)
{
    const std::pair<const char*, std::span<const Named>> enums[] = {
        {"Feature.", kFeatures}, {"Field.", kFields}, {"Flag.", kFlags}, {"EulerOrder.", kEulerOrders}};
    for (const auto& [prefix, table] : enums)
        if (std::any_of(table.begin(), table.end(), [&](const Named& each) { return each.name == name; }))
            return prefix + name;
    return {};
}

}  // namespace

std::span<const Named> features() { return kFeatures; }

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

std::string field_name(swivel_field field)
{
    std::string name = kFields[field].name;
    for (char& letter : name) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return name;
}

swivel_field field_of(std::int64_t number)
{
    if (number < 0 || number >= SWIVEL_FIELD_COUNT)
        throw py::value_error("there is no field " + std::to_string(number) + "; give a member of swivel.Field");
    return static_cast<swivel_field>(number);
}

swivel_euler_order order_of(std::int64_t number)
{
    if (number < 0 || number >= static_cast<std::int64_t>(std::size(kEulerOrders)))
        throw py::value_error("there is no order of axes " + std::to_string(number) +
                              "; give a member of swivel.EulerOrder");
    return static_cast<swivel_euler_order>(number);
}

void add_enums(py::module_& module)
{
    add_enum(module, "IntFlag", "Feature", kFeatures, kFeatureText);
    add_enum(module, "IntEnum", "Field", kFields, kFieldText);
    add_enum(module, "IntFlag", "Flag", kFlags, kFlagText);
    add_enum(module, "IntEnum", "EulerOrder", kEulerOrders, kEulerOrderText);
}

}  // namespace swivel::python
