// SPDX-License-Identifier: MIT
#include "tools/python/poses.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

constexpr const char kOrigin[] = "origin";  // the key that is no field

// ValueError for a key that no frame has.
void check_keys(std::uint32_t group, const py::dict& given)
{
    for (const auto& [key, array] : given) {
        const std::string name = py::str(key);
        const auto is_called = [&](const swivel_field_info& info) { return info.name == name; };
        if (name == kOrigin || std::any_of(fields().begin(), fields().end(), is_called)) continue;
        std::string message =
            "frame of group " + std::to_string(group) + ": there is no key '" + name + "'; there are " + kOrigin;
        for (const swivel_field_info& info : fields()) message += std::string(", ") + info.name;
        throw py::value_error(message);
    }
}

void add_frame(const HeldCrowd& held, const Limbs& limbs, const py::dict& given, bool far, Frames& into)
{
    check_keys(limbs.group, given);
    const bool from_origin = given.contains(kOrigin);
    const auto take = [&](const char* key, const Values& values, bool as_doubles) {
        const auto type = as_doubles ? py::dtype::of<double>() : py::dtype::of<float>();
        into.inputs.push_back(input(values, given[key], type, true, held.rows));
        return into.inputs.back().values;
    };
    Frame frame;
    for (const swivel_field_info& info : fields()) {
        if (!given.contains(info.name)) continue;
        const Values values = values_of(held, info.field, limbs);
        if (info.kind == SWIVEL_FIELD_INPUT) {
            frame.in(info.field, take(info.name, values, (far || from_origin) && info.is_position));
            continue;
        }
        const py::object array = given[info.name];
        if (array.is_none()) throw py::type_error(values.name + ": expected an array to write to, got None");
        into.outputs.push_back(output(values, array, type_of(info.field), held.rows));
        into.outputs.back().start();
        frame.out(info.field, into.outputs.back().values);
    }
    if (from_origin) frame.origin(take(kOrigin, {kOrigin, limbs.count, 3}, true));
    into.frames.push_back(frame);
}

}  // namespace

Frames frames_of(const HeldCrowd& held, const py::object& given, const std::vector<std::uint32_t>& groups, bool far)
{
    std::vector<py::dict> dicts;
    if (py::isinstance<py::dict>(given))
        dicts.push_back(given);
    else
        for (const py::handle each : given) {
            if (!py::isinstance<py::dict>(each)) throw py::type_error("frames: expected a dict for each group");
            dicts.push_back(py::reinterpret_borrow<py::dict>(each));
        }
    if (dicts.size() != groups.size())
        throw py::value_error("frames: expected one for each of " + std::to_string(groups.size()) + " groups, got " +
                              std::to_string(dicts.size()));
    std::vector<std::size_t> order(groups.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return groups[a] < groups[b]; });
    Frames frames;
    for (const std::size_t n : order) add_frame(held, limbs_of(held, groups[n], 0, {}), dicts[n], far, frames);
    return frames;
}

}  // namespace swivel::python
