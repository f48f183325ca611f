// SPDX-License-Identifier: MIT
//
// Solving: all limbs, some blocks, those chosen, from and to rows or the caller's own arrays.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <string_view>

#include "swivel/swivel_bodies.hpp"
#include "tools/python/crowd.h"
#include "tools/python/poses.h"
#include "tools/python/structures.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

std::size_t lane_count(const HeldCrowd& held)
{
    return std::size_t{swivel_block_count(held.crowd.get())} * SWIVEL_LANES;
}

std::vector<std::uint32_t> no_words(const HeldCrowd& held)
{
    return std::vector<std::uint32_t>((lane_count(held) + 31) / 32);
}

// The library's bits from a bool for each lane.
std::vector<std::uint32_t> words_of(const HeldCrowd& held, const py::object& mask)
{
    const auto flags = py::array::ensure(mask);
    if (!flags || !flags.dtype().equal(py::dtype::of<bool>())) throw py::type_error("mask: expected an array of bool");
    if (flags.ndim() != 1 || static_cast<std::size_t>(flags.size()) != lane_count(held))
        throw py::value_error("mask: expected shape (" + std::to_string(lane_count(held)) +
                              ",), one for each lane, got " + shape_text(flags));
    const auto lanes = py::array_t<bool>(flags).unchecked<1>();
    std::vector<std::uint32_t> words = no_words(held);
    for (py::ssize_t lane = 0; lane < lanes.shape(0); ++lane)
        words[static_cast<std::size_t>(lane) / 32] |= std::uint32_t{lanes(lane)} << (lane % 32);
    return words;
}

py::array lanes_of(const HeldCrowd& held, const std::vector<std::uint32_t>& words)
{
    py::array_t<bool> flags(static_cast<py::ssize_t>(lane_count(held)));
    auto lanes = flags.mutable_unchecked<1>();
    for (py::ssize_t lane = 0; lane < lanes.shape(0); ++lane)
        lanes(lane) = words[static_cast<std::size_t>(lane) / 32] >> (lane % 32) & 1;
    return flags;
}

std::vector<Input> priorities_of(const HeldCrowd& held, const py::object& given)
{
    const py::list each(given);
    const std::uint32_t groups = held.joint_count > 0 ? 1 : swivel_group_count(held.crowd.get());  // with own lanes
    if (each.size() != groups)
        throw py::value_error("priorities: expected one entry " +
                              (held.joint_count > 0 ? "for the bodies, got "
                                                    : "for each of " + std::to_string(groups) + " groups, got ") +
                              std::to_string(each.size()));
    std::vector<Input> priorities;
    for (std::uint32_t group = 0; group < each.size(); ++group) {
        const Values wanted{"priorities of group " + std::to_string(group),
                            swivel_group_limb_count(held.crowd.get(), group), 1};
        priorities.push_back(input(wanted, each[group], py::dtype::of<float>(), true, held.rows));
    }
    return priorities;
}

using Groups = std::optional<std::vector<std::int64_t>>;

// Their numbers as given; without any, those of all groups.
std::vector<std::uint32_t> groups_of(const HeldCrowd& held, const Groups& given)
{
    std::vector<std::uint32_t> groups(swivel_group_count(held.crowd.get()));
    std::iota(groups.begin(), groups.end(), 0u);
    if (!given) return groups;
    std::vector<bool> is_named(groups.size());
    groups.clear();
    for (const std::int64_t number : *given) {
        groups.push_back(limbs_of(held, number, 0, {}).group);
        if (is_named[groups.back()])
            throw py::value_error("groups: group " + std::to_string(number) + " is named twice");
        is_named[groups.back()] = true;
    }
    return groups;
}

// The caller's own, one for each block, or none.
std::span<float> urgency_of(const HeldCrowd& held, const py::object& given)
{
    if (given.is_none()) return {};
    const Values wanted{"urgency", swivel_block_count(held.crowd.get()), 1};
    const Output array = output(wanted, given, py::dtype::of<float>(), held.rows);
    const bool aligned = reinterpret_cast<std::uintptr_t>(array.values.data) % alignof(float) == 0;
    if (array.values.stride != sizeof(float) || !array.given.is(array.direct) || !aligned)
        throw py::value_error("urgency: its numbers must lie side by side, and aligned");
    return {static_cast<float*>(array.values.data), wanted.limb_count};
}

std::vector<swivel_in> pointers_of(const std::vector<Input>& inputs)
{
    std::vector<swivel_in> pointers;
    for (const Input& each : inputs) pointers.push_back(each.values);
    return pointers;
}

using Blocks = std::optional<std::pair<std::int64_t, std::int64_t>>;

// Results go straight into the caller's arrays, or through copies. A copy brings back the whole group's values, over
// those that another thread solved meanwhile.
void require_direct(const StreamArrays& streams)
{
    for (const Output& each : streams.outputs)
        if (!each.given.is(each.direct))
            throw py::value_error(
                "streams: where not all limbs are solved, outputs need the numbers of a value side by side");
}

// Whether a group's limbs have targets of their own: what is planted or linked needs none.
bool has_targets(const swivel_crowd* crowd, std::uint32_t group)
{
    constexpr swivel_features kSent = SWIVEL_WITH_PLANT | SWIVEL_WITH_LINK;
    return swivel_group_kind(crowd, group) == SWIVEL_KIND_BODY_LIMB && !(swivel_group_features(crowd, group) & kSent);
}

// A root in doubles makes positions in rows the root's. Whoever writes them to rows alone may not know.
void require_streams(const HeldCrowd& held, const std::vector<std::uint32_t>& groups, const PoseArrays& pose,
                     const py::object& streams)
{
    const bool wants_targets = std::any_of(groups.begin(), groups.end(),
                                           [&](std::uint32_t group) { return has_targets(held.crowd.get(), group); });
    if (pose.view.root_is_double && wants_targets && streams.is_none())
        throw py::value_error(
            "root_position is float64, so targets are, too, and come in streams; give these, or a root_position of "
            "float32");
}

// A workspace of the calling thread's own.
void* workspace_of(const HeldCrowd& held)
{
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    static thread_local std::vector<Line> lines;
    const std::size_t wanted = swivel_workspace_bytes(held.crowd.get()) / sizeof(Line);
    if (lines.size() < wanted) lines.resize(wanted);
    return lines.data();
}

std::uint32_t solve(HeldCrowd& held, const Blocks& blocks, const Groups& groups, const py::object& mask,
                    const py::object& streams, const py::object& pose, bool on_this_thread)
{
    Job job;
    if (blocks) job.blocks = {count_of("first block", blocks->first), count_of("block count", blocks->second)};
    const std::vector<std::uint32_t> named = groups_of(held, groups);
    if (groups) job.groups = named;
    const auto words = mask.is_none() ? std::vector<std::uint32_t>() : words_of(held, mask);
    if (!mask.is_none()) job.mask = words;
    const PoseArrays poses = pose.is_none() ? PoseArrays() : pose_of(held, pose);
    if (!pose.is_none()) job.pose = &poses.view;
    require_streams(held, named, poses, streams);
    const StreamArrays arrays =
        streams.is_none() ? StreamArrays() : streams_of(held, streams, named, poses.view.root_is_double != 0);
    if (blocks || !mask.is_none()) require_direct(arrays);
    job.streams.assign(arrays.streams.begin(), arrays.streams.end());
    job.on_this_thread = on_this_thread;
    job.workspace = workspace_of(held);
    const Way way = on_this_thread ? Way::kSolvingBlocks : Way::kAlone;
    const std::uint32_t solved = run(held, way, [&] { return held.crowd.solve(job); });
    for (const Output& each : arrays.outputs) each.finish();
    return solved;
}

py::array choose(HeldCrowd& held, const py::object& priorities, std::int64_t max_blocks, const py::object& urgency)
{
    const std::vector<Input> given = priorities_of(held, priorities);
    const std::uint32_t max = count_of("max_blocks", max_blocks);
    const std::span<float> kept = urgency_of(held, urgency);
    std::vector<std::uint32_t> words = no_words(held);
    run(held, Way::kAlone, [&] { held.crowd.choose(pointers_of(given), kept, max, words); });
    return lanes_of(held, words);
}

void reset(HeldCrowd& held, std::int64_t group, std::int64_t first, std::optional<std::int64_t> count)
{
    const Limbs limbs = limbs_of(held, group, first, count);
    run(held, Way::kAlone, [&] { check(swivel_reset(held.crowd.get(), limbs.group, limbs.first, limbs.count)); });
}

// Bodies, or in a crowd of free limbs what is limb n of each group. count None is to the end.
Limbs bodies_of(const HeldCrowd& held, std::int64_t first, std::optional<std::int64_t> count)
{
    return limbs_of(held, 0, first, count);
}

void reset_bodies(HeldCrowd& held, std::int64_t first, std::optional<std::int64_t> count)
{
    const Limbs bodies = bodies_of(held, first, count);
    run(held, Way::kAlone, [&] { held.crowd.reset_bodies(bodies.first, bodies.count); });
}

py::bytes save(HeldCrowd& held, std::int64_t first, std::optional<std::int64_t> count)
{
    const Limbs bodies = bodies_of(held, first, count);
    std::string bytes(bodies.count * swivel_state_bytes(held.crowd.get()), '\0');
    run(held, Way::kReading,
        [&] { check(swivel_save(held.crowd.get(), bodies.first, bodies.count, bytes.data(), bytes.size())); });
    return bytes;
}

void load(HeldCrowd& held, const py::bytes& state, std::int64_t first, std::optional<std::int64_t> count)
{
    const Limbs bodies = bodies_of(held, first, count);
    const std::string_view bytes = state;
    const std::size_t wanted = bodies.count * swivel_state_bytes(held.crowd.get());
    if (wanted > 0 && bytes.size() != wanted)
        throw py::value_error("state: expected " + std::to_string(wanted) + " bytes for " +
                              std::to_string(bodies.count) + " bodies, got " + std::to_string(bytes.size()));
    run(held, Way::kAlone,
        [&] { check(swivel_load(held.crowd.get(), bodies.first, bodies.count, bytes.data(), bytes.size())); });
}

void change_support(HeldCrowd& held, const py::object& was, const py::object& is, std::int64_t group,
                    std::int64_t first, std::optional<std::int64_t> count)
{
    const Limbs limbs = limbs_of(held, group, first, count);
    const SupportArrays from = supports_of("was", was, limbs.count), to = supports_of("now", is, limbs.count);
    run(held, Way::kAlone, [&] {
        check(swivel_change_support(held.crowd.get(), limbs.group, limbs.first, limbs.count, from.view(), to.view()));
    });
}

}  // namespace

void add_solving(CrowdClass& crowd)
{
    crowd.def(
        "solve", &solve, py::kw_only(), py::arg("blocks") = py::none(), py::arg("groups") = py::none(),
        py::arg("mask") = py::none(), py::arg("streams") = py::none(), py::arg("pose") = py::none(),
        py::arg("on_this_thread") = false,
        "Solves limbs, all of them if nothing is given, and gives how many. Equal inputs give equal bits on every "
        "CPU.\n\n"
        "blocks is (first, count), of LANES limbs each. groups: numbers of groups; others are neither read nor\n"
        "written. mask: bool of shape (lane_count,), True for limbs to solve, as choose() gives it; lanes of padding\n"
        "mean nothing. Limbs that are not chosen keep their results bit for bit.\n\n"
        "streams solve from and to your own arrays. They take a run of blocks of each group in turn, while they are "
        "in\n"
        "the nearest cache. Give a dict for each group, or one dict if there is one group; with groups, for each of\n"
        "these, in the same order. Keys are lower-case names of fields, values arrays of the whole group as write()\n"
        "takes them and as out of read(). A field of a structured array is one. Inputs are read, results are filled.\n"
        "With the key origin, (n, 3) or (3,), the positions are float64 from there, as in write_doubles(). What is\n"
        "left out keeps its rows, or is not written. A limb's results may be its own inputs; no other arrays may\n"
        "overlap results. Where not all limbs of a group are solved, results need each value's numbers side by "
        "side.\n\n"
        "pose, a Pose, is what a crowd of bodies is solved from and to; no other crowd takes one. Counts, blocks and\n"
        "masks are of bodies then. Bodies that are not chosen are neither read nor written. Targets, poles and hands\n"
        "are in the world.\n\n"
        "For groups with Feature.WITH_GROUND, read Field.PROBE after a solve, sample the ground there, and write\n"
        "Field.GROUND and Field.GROUND_NORMAL for the next one. No function of yours is called in a solve.\n\n"
        "On all cores if the library was built with oneTBB; on_this_thread on one, and then several threads may\n"
        "solve blocks that do not overlap at once, with the same mask and streams.");
    crowd.def("choose", &choose, py::arg("priorities"), py::arg("max_blocks"), py::arg("urgency") = py::none(),
              "Picks at most max_blocks blocks, the most urgent ones; solves nothing.\n\n"
              "priorities has one entry for each group, of bodies one alone: (n,) float32, one number for each limb,\n"
              "or () for the whole group, in any unit. urgency (block_count,) float32 is yours: start it as np.zeros "
              "and give it to\n"
              "every call. Each call adds a block's largest priority to its urgency, which is 0 again for those\n"
              "picked, so none starves. Only its magnitude counts. None: priorities alone decide. Gives a mask for\n"
              "solve().");
    crowd.def(
        "reset", &reset, py::arg("group") = 0, py::arg("first") = 0, py::arg("count") = py::none(),
        "Forgets what is carried from solve to solve: swivels, planted points, shifts and lifts. After a teleport.");
    crowd.def("reset_bodies", &reset_bodies, py::arg("first") = 0, py::arg("count") = py::none(),
              "reset() of all groups of `count` bodies from `first` on. After a teleport.");
    crowd.def("save", &save, py::arg("first") = 0, py::arg("count") = py::none(),
              "The state of `count` bodies from `first` on, as bytes: all that their next solve starts from besides\n"
              "its inputs. The bytes are the same on every CPU. In a crowd of free limbs body n is limb n of each\n"
              "group, and groups must have the same number of limbs.");
    crowd.def(
        "load", &load, py::arg("state"), py::arg("first") = 0, py::arg("count") = py::none(),
        "Loads what save() gave, of as many bodies of this crowd or of another with the same groups. Inputs stay\n"
        "as they are. ValueError for bytes of another kind of crowd.");
    crowd.def("change_support", &change_support, py::arg("was"), py::arg("now"), py::arg("group") = 0,
              py::arg("first") = 0, py::arg("count") = py::none(),
              "Changes what planted points of `count` bodies from `first` on stand on, without a jump.\n\n"
              "was and now are Supports, as they are at this moment. Call it between two solves, best while a foot is\n"
              "in the air, and give the next Pose the new support. ValueError for a group without Feature.WITH_PLANT.");
}

}  // namespace swivel::python
