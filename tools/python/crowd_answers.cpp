// SPDX-License-Identifier: MIT
//
// The answers about results: positions, distances, angles, arcs, texts. All numbers are double, but for arcs.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstring>
#include <string>

#include "swivel/swivel_explain.hpp"
#include "tools/python/crowd.h"
#include "tools/python/names.h"
#include "tools/python/poses.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

using Count = std::optional<std::int64_t>;

void write(HeldCrowd& held, std::int64_t number, const py::object& values, std::int64_t group, std::int64_t first,
           Count count)
{
    const swivel_field field = field_of(number);
    const Limbs limbs = limbs_of(held, group, first, count);
    const float none = 0;
    check(swivel_write(held.crowd.get(), field, limbs.group, 0, 0, {&none, 0}));  // refuses other groups' fields
    const Input in = input(values_of(held, field, limbs), values, py::dtype::of<float>(), true, held.rows);
    run(held, Way::kAlone,
        [&] { check(swivel_write(held.crowd.get(), field, limbs.group, limbs.first, limbs.count, in.values)); });
}

void write_doubles(HeldCrowd& held, std::int64_t number, const py::object& values, const py::object& origins,
                   std::int64_t group, std::int64_t first, Count count)
{
    const swivel_field field = field_of(number);
    const Limbs limbs = limbs_of(held, group, first, count);
    const double none[3] = {};
    check(swivel_write_doubles(held.crowd.get(), field, limbs.group, 0, 0, {none, 0}, {}));  // must be a position
    const auto type = py::dtype::of<double>();
    const Input in = input(values_of(held, field, limbs), values, type, true);
    Input from{};
    if (!origins.is_none()) from = input({"origins", limbs.count, 3}, origins, type, true);
    run(held, Way::kAlone, [&] {
        check(swivel_write_doubles(held.crowd.get(), field, limbs.group, limbs.first, limbs.count, in.values,
                                   from.values));
    });
}

py::array read(HeldCrowd& held, std::int64_t number, std::int64_t group, std::int64_t first, Count count,
               const py::object& out)
{
    const swivel_field field = field_of(number);
    const Limbs limbs = limbs_of(held, group, first, count);
    const Output to = output(values_of(held, field, limbs), out, type_of(field), held.rows);
    run(held, Way::kReading,
        [&] { check(swivel_read(held.crowd.get(), field, limbs.group, limbs.first, limbs.count, to.values)); });
    return to.finish();
}

// An array of doubles for some limbs, filled by call(crowd, limbs, values).
template <class Call>
py::array doubles(HeldCrowd& held, std::size_t component_count, std::int64_t group, std::int64_t first, Count count,
                  const py::object& out, Call call)
{
    const Limbs limbs = limbs_of(held, group, first, count);
    const Output to = output({"out", limbs.count, component_count}, out, py::dtype::of<double>(), held.rows);
    run(held, Way::kReading, [&] { check(call(held.crowd.get(), limbs, to.values)); });
    return to.finish();
}

py::array joint_angles(HeldCrowd& held, std::int64_t shoulder_order, std::int64_t wrist_order, int family,
                       std::int64_t group, std::int64_t first, Count count, const py::object& out)
{
    const swivel_euler_order shoulder = order_of(shoulder_order), wrist = order_of(wrist_order);
    return doubles(held, 7, group, first, count, out, [&](swivel_crowd* crowd, const Limbs& limbs, swivel_out values) {
        return swivel_joint_angles(crowd, limbs.group, limbs.first, limbs.count, shoulder, wrist, family, values);
    });
}

py::array allowed_arcs(HeldCrowd& held, std::int64_t limb, std::int64_t group)
{
    const std::uint32_t g = count_of("group", group), n = count_of("limb", limb);
    const auto arcs = run(held, Way::kReading, [&] { return held.crowd.allowed_arcs(g, n); });
    static_assert(sizeof(swivel_arc) == 4 * sizeof(float));
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(arcs.size()), 2, 2};
    return py::array(py::dtype::of<float>(), shape, arcs.data());  // no base, so it is copied
}

std::pair<bool, std::string> compare(HeldCrowd& held, const py::object& pose, std::int64_t body,
                                     const py::object& shoulder, const py::object& elbow, const py::object& wrist,
                                     std::int64_t group)
{
    const Limbs one = limbs_of(held, group, body, 1);
    const PoseArrays poses = pose_of(held, pose);
    const auto from = vector_of("shoulder", shoulder), over = vector_of("elbow", elbow), to = vector_of("wrist", wrist);
    const auto said = run(held, Way::kReading, [&] {
        return swivel::compare(held.crowd, one.group, one.first, poses.view, from, over, to);
    });
    return {said.agrees, said.text};
}

// Names, lines and colours.
py::tuple draw(HeldCrowd& held, std::int64_t limb, const Count& group, const py::object& pose)
{
    const Limbs one = limbs_of(held, group.value_or(0), limb, 1);
    const std::uint32_t g = group || held.joint_count == 0 ? one.group : SWIVEL_EVERY_GROUP;
    std::optional<PoseArrays> poses;
    if (!pose.is_none()) poses = pose_of(held, pose);
    const auto shapes = run(held, Way::kReading, [&] {
        const auto fill = [&](swivel_shape* to, std::uint32_t capacity) {
            std::uint32_t count = 0;
            check(swivel_draw(held.crowd.get(), g, one.first, poses ? &poses->view : nullptr, to, capacity, &count));
            return count;
        };
        std::vector<swivel_shape> found(fill(nullptr, 0));
        fill(found.data(), static_cast<std::uint32_t>(found.size()));
        return found;
    });
    const auto count = static_cast<py::ssize_t>(shapes.size());
    py::list names;
    py::array_t<double> lines(std::vector<py::ssize_t>{count, 2, 3});
    py::array_t<std::uint8_t> colors(std::vector<py::ssize_t>{count, 4});
    for (std::size_t n = 0; n < shapes.size(); ++n) {
        names.append(shapes[n].name);
        std::memcpy(lines.mutable_data() + 6 * n, shapes[n].from, sizeof shapes[n].from);
        std::memcpy(lines.mutable_data() + 6 * n + 3, shapes[n].to, sizeof shapes[n].to);
        for (std::size_t c = 0; c < 4; ++c)
            colors.mutable_data()[4 * n + c] = static_cast<std::uint8_t>(shapes[n].color >> (24 - 8 * c));
    }
    return py::make_tuple(names, lines, colors);
}

// Positions, rotations, distances and angles of the results.
void add_kinematics(CrowdClass& crowd)
{
    using Call = swivel_status (*)(swivel_crowd*, const Limbs&, swivel_out);
    const auto add = [&](const char* name, std::size_t component_count, Call call, const char* text) {
        crowd.def(
            name,
            [component_count, call](HeldCrowd& held, std::int64_t group, std::int64_t first, Count count,
                                    const py::object& out) {
                return doubles(held, component_count, group, first, count, out, call);
            },
            py::arg("group") = 0, py::arg("first") = 0, py::arg("count") = py::none(), py::arg("out") = py::none(),
            text);
    };
    add(
        "elbows", 3,
        [](swivel_crowd* held, const Limbs& limbs, swivel_out to) {
            return swivel_forward(held, limbs.group, limbs.first, limbs.count, to, {}, {});
        },
        "Where the results put the elbows: (count, 3) float64, in the space of the targets and your unit of length.");
    add(
        "wrists", 3,
        [](swivel_crowd* held, const Limbs& limbs, swivel_out to) {
            return swivel_forward(held, limbs.group, limbs.first, limbs.count, {}, to, {});
        },
        "Where the results put the wrists: (count, 3) float64, in the space of the targets and your unit of length.");
    add(
        "hands", 4,
        [](swivel_crowd* held, const Limbs& limbs, swivel_out to) {
            return swivel_forward(held, limbs.group, limbs.first, limbs.count, {}, {}, to);
        },
        "How the results turn the hands: (count, 4) float64, quaternions x, y, z, w in the space of the\n"
        "targets; without Feature.WITH_HAND those of the forearms.");
    add(
        "residuals", 1,
        [](swivel_crowd* held, const Limbs& limbs, swivel_out to) {
            return swivel_residuals(held, limbs.group, limbs.first, limbs.count, to);
        },
        "How far each wrist, or effector, is from its target: (count,) float64, in arm lengths (upper arm and\n"
        "forearm, scaled and stretched). 0 for limbs of no length, NaN for those with Flag.BAD_INPUT.");
    crowd.def("joint_angles", &joint_angles, py::arg("shoulder_order") = 0, py::arg("wrist_order") = 0,
              py::arg("family") = 0, py::arg("group") = 0, py::arg("first") = 0, py::arg("count") = py::none(),
              py::arg("out") = py::none(),
              "Joint angles of the results about the rest pose, in radians: (count, 7) float64.\n\n"
              "Three of the shoulder in the given order of axes, the flexion, three of the wrist (0 without\n"
              "Feature.WITH_HAND). Of the two triples for a rotation, family 0 has the middle one within\n"
              "-pi/2..pi/2, family 1 the other.");
}

// Explanations and comparisons in words, and drawings.
void add_explanations(CrowdClass& crowd)
{
    crowd.def(
        "explain",
        [](HeldCrowd& held, std::int64_t limb, std::int64_t group) {
            const Limbs one = limbs_of(held, group, limb, 1);
            return run(held, Way::kReading, [&] { return swivel::explain(held.crowd, one.group, one.first); });
        },
        py::kw_only(), py::arg("limb"), py::arg("group") = 0,
        "Why a limb is as it is, from its present inputs, in a sentence or two.\n\n"
        "By keywords, so that limb and group are not mixed up. Of all limbs with bad input:\n"
        "for limb in numpy.flatnonzero(crowd.read(Field.FLAGS) & Flag.BAD_INPUT): print(crowd.explain(limb=limb))");
    crowd.def("compare", &compare, py::arg("pose"), py::kw_only(), py::arg("body"), py::arg("shoulder"),
              py::arg("elbow"), py::arg("wrist"), py::arg("group") = 0,
              "Compares a Pose with where your engine has a limb of a body: (agrees, text). The text names the input\n"
              "that disagrees, such as quaternions in another order, and what to do.\n\n"
              "shoulder, elbow and wrist (3,): places of these joints in the world, in the pose as it goes in.");
    crowd.def("draw", &draw, py::kw_only(), py::arg("limb"), py::arg("group") = py::none(),
              py::arg("pose") = py::none(),
              "What a limb or body does, as lines: (names, lines, colors). names says of each what it is, such as\n"
              "'bone' or 'miss'; lines (count, 2, 3) float64 have equal ends where they are points; colors (count, 4)\n"
              "uint8 are red, green, blue, alpha. Bodies: in the world. Free limbs: in the space of their rows, from\n"
              "their origin; without WORLD in the arm frame.\n\n"
              "pose: of bodies, the one of the last solve. group None: all groups of body `limb`, or group 0 of free\n"
              "limbs.");
}

}  // namespace

void add_copies(CrowdClass& crowd)
{
    crowd.def(
        "write", &write, py::arg("field"), py::arg("values"), py::arg("group") = 0, py::arg("first") = 0,
        py::arg("count") = py::none(),
        "Copies an input field in, of `count` limbs of a group from `first` on; None: to the group's end.\n"
        "Or sets back what read() gave of a field that is carried: NORMAL, PLANT, PLANT_ROTATION, MOTION, SHIFT, "
        "LIFT.\n\n"
        "values has shape (count, k), or (count,) for fields of one number, or is one value (k,) for all of\n"
        "them; k is component_count(field, group). float32 whose k numbers lie side by side is read where it is,\n"
        "with any stride from limb to limb, read-only or not; everything else that NumPy takes for real\n"
        "numbers is converted first. ValueError for another shape, for other results, for limbs that the crowd\n"
        "does not have and fields that the group does not have.");
    crowd.def("write_doubles", &write_doubles, py::arg("field"), py::arg("values"), py::arg("origins") = py::none(),
              py::arg("group") = 0, py::arg("first") = 0, py::arg("count") = py::none(),
              "The same for positions far from the origin: Field.TARGET, Field.POLE, Field.SHOULDER_POSITION, "
              "Field.NEXT_TARGET, Field.GROUND, Field.PROP_POSITION.\n\n"
              "values and origins have shape (count, 3), or (3,) for all limbs, float64. origins are subtracted in\n"
              "double, then the difference is rounded once to float32; None subtracts nothing. All positions of a\n"
              "limb must come from the same origin.");
    crowd.def("read", &read, py::arg("field"), py::arg("group") = 0, py::arg("first") = 0,
              py::arg("count") = py::none(), py::arg("out") = py::none(),
              "A field's values, input or result, of `count` limbs from `first` on; None: to the group's end.\n\n"
              "Shape (count, k), or (count,) for fields of one number, float32, or uint32 for Field.FLAGS. out: an\n"
              "array of that shape and type with any strides, which is filled and returned, instead of a new one.");
}

void add_answers(CrowdClass& crowd)
{
    add_kinematics(crowd);
    add_explanations(crowd);
    crowd.def(
        "digest", [](HeldCrowd& held) { return run(held, Way::kReading, [&] { return held.crowd.digest(); }); },
        "A number for all results, to compare crowds across machines. Equal results give equal digests on every\n"
        "CPU, and other results almost surely another one.");
    crowd.def(
        "state_digest",
        [](HeldCrowd& held) { return run(held, Way::kReading, [&] { return held.crowd.state_digest(); }); },
        "The same for what save() has: a crowd that has loaded all bodies of another has its number.");
    crowd.def("allowed_arcs", &allowed_arcs, py::arg("limb"), py::arg("group") = 0,
              "The swivels that one limb's limits allow for its inputs as they are: (arcs, 2, 2) float32.\n\n"
              "For each arc its two ends, for each end cos and sin of the angle about the line from shoulder to\n"
              "wrist, by the right hand from the swivel wished for. The whole circle is one arc with equal ends; no\n"
              "arc: bad input or no swivel within the limits.");
}

}  // namespace swivel::python
