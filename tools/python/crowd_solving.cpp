// SPDX-License-Identifier: MIT
//
// Solving all limbs, some blocks, those chosen.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <string>

#include "tools/python/crowd.h"

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
std::vector<std::uint32_t> words_of(const HeldCrowd& held, const py::object& active)
{
    const auto flags = py::array::ensure(active);
    if (!flags || !flags.dtype().equal(py::dtype::of<bool>()))
        throw py::type_error("active: expected an array of bool");
    if (flags.ndim() != 1 || static_cast<std::size_t>(flags.size()) != lane_count(held))
        throw py::value_error("active: expected shape (" + std::to_string(lane_count(held)) +
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

std::vector<std::uint32_t> indices_of(const py::object& lanes)
{
    py::array given = py::array::ensure(lanes);
    if (!given || (given.dtype().kind() != 'i' && given.dtype().kind() != 'u' && given.size() > 0))
        throw py::type_error("lanes: expected whole numbers, such as Crowd.limbs() gives");
    if (given.ndim() != 1) throw py::value_error("lanes: expected shape (count,), got " + shape_text(given));
    const auto numbers = py::array_t<std::int64_t, py::array::forcecast>(given).unchecked<1>();
    std::vector<std::uint32_t> indices;
    indices.reserve(static_cast<std::size_t>(numbers.shape(0)));
    for (py::ssize_t n = 0; n < numbers.shape(0); ++n) indices.push_back(count_of("lane", numbers(n)));
    return indices;
}

std::vector<Input> priorities_of(const HeldCrowd& held, const py::object& given)
{
    const py::list each(given);
    if (each.size() != group_count(held))
        throw py::value_error("priorities: expected one entry for each of " + std::to_string(group_count(held)) +
                              " groups, got " + std::to_string(each.size()));
    std::vector<Input> priorities;
    for (std::uint32_t group = 0; group < each.size(); ++group) {
        const Values wanted{"priorities of group " + std::to_string(group),
                            swivel_group_limb_count(held.crowd.get(), group), 1};
        priorities.push_back(input(wanted, each[group], py::dtype::of<float>(), true, rows_memory(held)));
    }
    return priorities;
}

std::vector<swivel_in> pointers_of(const std::vector<Input>& inputs)
{
    std::vector<swivel_in> pointers;
    for (const Input& each : inputs) pointers.push_back(each.values);
    return pointers;
}

void solve_blocks(HeldCrowd& held, std::int64_t first, std::int64_t count)
{
    const std::uint32_t begin = count_of("first", first), blocks = count_of("count", count);
    run(held, Way::kSolvingBlocks, [&] { held.crowd.solve_blocks(begin, blocks); });
}

void solve_active(HeldCrowd& held, const py::object& active)
{
    const std::vector<std::uint32_t> words = words_of(held, active);
    run(held, Way::kAlone, [&] { held.crowd.solve_active(words); });
}

void solve_active_blocks(HeldCrowd& held, const py::object& active, std::int64_t first, std::int64_t count)
{
    const std::vector<std::uint32_t> words = words_of(held, active);
    const std::uint32_t begin = count_of("first", first), blocks = count_of("count", count);
    run(held, Way::kSolvingBlocks, [&] { held.crowd.solve_active_blocks(words, begin, blocks); });
}

void solve_list(HeldCrowd& held, const py::object& lanes)
{
    const std::vector<std::uint32_t> indices = indices_of(lanes);
    run(held, Way::kAlone, [&] { held.crowd.solve_list(indices); });
}

py::array choose(HeldCrowd& held, const py::object& priorities, std::int64_t most_blocks)
{
    const std::vector<Input> given = priorities_of(held, priorities);
    const std::uint32_t most = count_of("most_blocks", most_blocks);
    std::vector<std::uint32_t> words = no_words(held);
    run(held, Way::kAlone, [&] { held.crowd.choose(pointers_of(given), most, words); });
    return lanes_of(held, words);
}

std::uint32_t solve_budget(HeldCrowd& held, const py::object& priorities, std::int64_t most_blocks)
{
    const std::vector<Input> given = priorities_of(held, priorities);
    const std::uint32_t most = count_of("most_blocks", most_blocks);
    return run(held, Way::kAlone, [&] { return held.crowd.solve_budget(pointers_of(given), most); });
}

void reset(HeldCrowd& held, std::int64_t group, std::int64_t first, std::optional<std::int64_t> count)
{
    const Limbs limbs = limbs_of(held, group, first, count);
    run(held, Way::kAlone, [&] { check(swivel_reset(held.crowd.get(), limbs.group, limbs.first, limbs.count)); });
}

}  // namespace

void add_solving(CrowdClass& crowd)
{
    crowd.def(
        "solve", [](HeldCrowd& held) { run(held, Way::kAlone, [&] { held.crowd.solve(); }); },
        "Solves every limb, on all cores if the library was built with oneTBB. Equal inputs give equal bits on every "
        "CPU.");
    crowd.def("solve_blocks", &solve_blocks, py::arg("first"), py::arg("count"),
              "Solves `count` blocks of LANES limbs from block `first` on, on the calling thread. Ranges that do\n"
              "not overlap may be solved by several threads at once.");
    crowd.def("solve_active", &solve_active, py::arg("active"),
              "Solves the limbs whose lane is True in active, a bool array of shape (lane_count,); lanes of padding\n"
              "mean nothing. All other limbs keep their results bit for bit.");
    crowd.def("solve_active_blocks", &solve_active_blocks, py::arg("active"), py::arg("first"), py::arg("count"),
              "The same for the limbs of `count` blocks from block `first` on, on the calling thread; active is\n"
              "still that of the whole crowd. Ranges that do not overlap may run on several threads at once.");
    crowd.def("solve_list", &solve_list, py::arg("lanes"),
              "Solves the limbs of these lanes, whole numbers of shape (count,) in any order: limbs(group)[n] is\n"
              "limb n of a group. All other limbs keep their results. ValueError for lanes that do not exist or\n"
              "are padding.");
    crowd.def("choose", &choose, py::arg("priorities"), py::arg("most_blocks"),
              "Picks at most most_blocks blocks by urgency, with Feature.BUDGET; solves nothing.\n\n"
              "priorities has one entry for each group: (n,) float32, one number for each limb, or () for the\n"
              "whole group, in any unit. Each call adds a block's largest priority to its urgency, which is 0\n"
              "again for those picked, so none starves. Gives a bool array of shape (lane_count,) for\n"
              "solve_active() and solve_active_blocks().");
    crowd.def("solve_budget", &solve_budget, py::arg("priorities"), py::arg("most_blocks"),
              "choose() and solve_active() in one; gives the number of limbs solved.");
    crowd.def("reset", &reset, py::arg("group") = 0, py::arg("first") = 0, py::arg("count") = py::none(),
              "Forgets the swivel carried from solve to solve with Feature.WITH_STEP, after a teleport.");
}

}  // namespace swivel::python
