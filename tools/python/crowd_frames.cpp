// SPDX-License-Identifier: MIT
#include "tools/python/frames.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

// The members of swivel_frame; their keys are the fields' names.
struct FrameInput {
    swivel_field field;
    swivel_in swivel_frame::*member;
};
constexpr FrameInput kFrameInputs[] = {
    {SWIVEL_TARGET, &swivel_frame::target},
    {SWIVEL_POLE, &swivel_frame::pole},
    {SWIVEL_LENGTHS, &swivel_frame::lengths},
    {SWIVEL_SHOULDER_POSITION, &swivel_frame::shoulder_position},
    {SWIVEL_PARENT_ROTATION, &swivel_frame::parent_rotation},
    {SWIVEL_PARENT_SCALE, &swivel_frame::parent_scale},
    {SWIVEL_HAND, &swivel_frame::hand},
    {SWIVEL_EFFECTOR, &swivel_frame::effector},
    {SWIVEL_ANGLE, &swivel_frame::angle},
    {SWIVEL_INCOMING_SHOULDER, &swivel_frame::incoming_shoulder},
    {SWIVEL_INCOMING_ELBOW, &swivel_frame::incoming_elbow},
    {SWIVEL_INCOMING_WRIST, &swivel_frame::incoming_wrist},
    {SWIVEL_WEIGHTS, &swivel_frame::weights},
    {SWIVEL_REACH, &swivel_frame::reach},
    {SWIVEL_MOST_SWIVEL, &swivel_frame::most_swivel},
    {SWIVEL_FLEXION_LIMIT, &swivel_frame::flexion_limit},
    {SWIVEL_SHOULDER_CONE, &swivel_frame::shoulder_cone},
    {SWIVEL_HUMERAL_TWIST, &swivel_frame::humeral_twist},
    {SWIVEL_SHOULDER_BOX, &swivel_frame::shoulder_box},
    {SWIVEL_HAND_CONE, &swivel_frame::hand_cone},
    {SWIVEL_FOREARM_TWIST, &swivel_frame::forearm_twist},
    {SWIVEL_HAND_TWIST, &swivel_frame::hand_twist},
    {SWIVEL_WRIST_BOX, &swivel_frame::wrist_box},
    {SWIVEL_AIM, &swivel_frame::aim},
    {SWIVEL_CLAVICLE, &swivel_frame::clavicle},
};
static_assert(std::size(kFrameInputs) == SWIVEL_SHOULDER);
struct FrameOutput {
    swivel_field field;
    swivel_out swivel_frame::*member;
};
constexpr FrameOutput kFrameOutputs[] = {
    {SWIVEL_SHOULDER, &swivel_frame::shoulder}, {SWIVEL_ELBOW, &swivel_frame::elbow},
    {SWIVEL_WRIST, &swivel_frame::wrist},       {SWIVEL_FLAGS, &swivel_frame::flags},
    {SWIVEL_STRETCH, &swivel_frame::stretch},   {SWIVEL_NORMAL, &swivel_frame::normal},
    {SWIVEL_TWIST_BONES, &swivel_frame::twist}, {SWIVEL_CLAVICLE_TURN, &swivel_frame::clavicle_turn},
};
static_assert(std::size(kFrameOutputs) == SWIVEL_FIELD_COUNT - SWIVEL_SHOULDER);

// ValueError for a key that no frame has.
void check_keys(std::uint32_t group, const py::dict& given)
{
    std::vector<std::string> keys{"origin"};
    for (const FrameInput& each : kFrameInputs) keys.push_back(field_name(each.field));
    for (const FrameOutput& each : kFrameOutputs) keys.push_back(field_name(each.field));
    for (const auto& [key, array] : given) {
        const std::string name = py::str(key);
        if (std::find(keys.begin(), keys.end(), name) != keys.end()) continue;
        std::string message = "frame of group " + std::to_string(group) + ": there is no key '" + name + "'; there are";
        for (const std::string& each : keys) message += (&each == &keys.front() ? " " : ", ") + each;
        throw py::value_error(message);
    }
}

void add_frame(const HeldCrowd& held, const Limbs& limbs, const py::dict& given, Frames& into)
{
    check_keys(limbs.group, given);
    swivel_frame frame = swivel_default_frame();
    const bool doubles = given.contains("origin");
    const auto take = [&](const std::string& key, const Values& values, swivel_in& member, bool as_doubles) {
        const auto type = as_doubles ? py::dtype::of<double>() : py::dtype::of<float>();
        into.inputs.push_back(input(values, given[key.c_str()], type, true, rows_memory(held)));
        member = into.inputs.back().values;
    };
    for (const auto& [field, member] : kFrameInputs)
        if (const std::string key = field_name(field); given.contains(key)) {
            const bool position = field == SWIVEL_TARGET || field == SWIVEL_POLE || field == SWIVEL_SHOULDER_POSITION;
            take(key, values_of(held, field, limbs), frame.*member, doubles && position);
        }
    if (doubles) take("origin", {"origin", limbs.count, 3}, frame.origin, true);
    for (const auto& [field, member] : kFrameOutputs)
        if (const std::string key = field_name(field); given.contains(key)) {
            const py::object array = given[key.c_str()];
            if (array.is_none()) throw py::type_error(key + ": expected an array to write to, got None");
            into.outputs.push_back(output(values_of(held, field, limbs), array, type_of(field), rows_memory(held)));
            frame.*member = into.outputs.back().values;
        }
    into.frames.push_back(frame);
}

}  // namespace

Frames frames_of(const HeldCrowd& held, const py::object& given)
{
    std::vector<py::dict> dicts;
    if (py::isinstance<py::dict>(given))
        dicts.push_back(given);
    else
        for (const py::handle each : given) {
            if (!py::isinstance<py::dict>(each)) throw py::type_error("frames: expected a dict for each group");
            dicts.push_back(py::reinterpret_borrow<py::dict>(each));
        }
    if (dicts.size() != group_count(held))
        throw py::value_error("frames: expected one for each of " + std::to_string(group_count(held)) +
                              " groups, got " + std::to_string(dicts.size()));
    Frames frames;
    for (std::size_t group = 0; group < dicts.size(); ++group)
        add_frame(held, limbs_of(held, static_cast<std::int64_t>(group), 0, {}), dicts[group], frames);
    return frames;
}

}  // namespace swivel::python
