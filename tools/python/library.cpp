// SPDX-License-Identifier: MIT
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "swivel/lecture.h"
#include "tools/cache/cache.h"
#include "tools/cache/fill.h"
#include "tools/formats/error.h"
#include "tools/python/arrays.h"
#include "tools/python/crowd.h"
#include "tools/python/helpers.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

// The place of one arm, not of an array of limbs.
std::array<double, 3> array3(const char* name, const py::object& values)
{
    const py::array given = py::array::ensure(values);
    if (given && (given.ndim() != 1 || given.shape(0) != 3))
        throw py::value_error(std::string(name) + ": expected shape (3,), got " + shape_text(given));
    return vector_of(name, values);
}

std::pair<std::vector<swivel_entity>, double> steps_of(const py::object& target, const py::object& pole, double upper,
                                                       double fore)
{
    std::vector<swivel_entity> entities(SWIVEL_ENTITY_COUNT);
    double closing_error = 0;
    const std::array<double, 3> to = array3("target", target), side = array3("pole", pole);
    if (const char* const why = swivel_steps(to.data(), side.data(), upper, fore, entities.data(), &closing_error))
        throw py::value_error(why);
    return {std::move(entities), closing_error};
}

std::string blade_name(std::int64_t blade)
{
    const char* const name = blade < 0 || blade > 31 ? nullptr : swivel_blade_name(static_cast<std::uint32_t>(blade));
    if (!name) throw py::value_error("blade is " + std::to_string(blade) + "; give 0 to 31");
    return name;
}

struct Check {
    std::string name, set;
    std::uint64_t arm_count;
    double max, rms, max_limit, rms_limit;
};

std::pair<bool, std::vector<Check>> verify(std::uint64_t arm_count, std::uint64_t seed)
{
    std::vector<Check> checks;
    const auto note = [](const swivel_check* c, void* user) {
        static_cast<std::vector<Check>*>(user)->push_back(
            {c->name, c->set, c->arm_count, c->max, c->rms, c->max_limit, c->rms_limit});
    };
    const py::gil_scoped_release released;
    const bool passed = swivel_verify(arm_count, seed, note, &checks);
    return {passed, checks};
}

std::string isa_name()
{
    const char* const name = swivel_isa_name();
    if (!name) throw std::runtime_error(swivel_last_error());
    return name;
}

std::vector<std::pair<std::string, bool>> isas()
{
    std::vector<std::pair<std::string, bool>> all;
    for (std::uint32_t n = 0; const char* const name = swivel_isa_at(n); ++n)
        all.emplace_back(name, swivel_isa_runs(name) != 0);
    return all;
}

py::array unpack_rotations(const py::object& words)
{
    const py::array given = py::module_::import("numpy").attr("asarray")(words);
    const std::size_t count = given.ndim() == 2 ? static_cast<std::size_t>(given.shape(0)) : 1;
    const Input in = input({"words", count, 3}, given, py::dtype::of<std::uint16_t>(), true);
    std::vector<py::ssize_t> shape(given.shape(), given.shape() + given.ndim());
    shape.back() = 4;
    py::array_t<float> rotations(shape);
    for (std::size_t n = 0; n < count; ++n) {
        std::uint16_t value[3];
        std::memcpy(value, static_cast<const char*>(in.values.data) + n * in.values.stride, sizeof value);
        swivel_unpack_rotation(value, 1, rotations.mutable_data() + 4 * n);
    }
    return rotations;
}

void add_check(py::module_& module)
{
    py::class_<Check> one(module, "Check", "One line of verify(): an error measured over many arms against its limit.");
    one.attr("__module__") = "swivel";
    one.def("__repr__", [](const Check& check) {
        const auto number = [](double value) { return std::string(py::repr(py::float_(value))); };
        return "<Check " + check.name + ", " + check.set + ": max " + number(check.max) + " of " +
               number(check.max_limit) + ">";
    });
    one.def_readonly("name", &Check::name, "What is compared.")
        .def_readonly("set", &Check::set, "Over which arms.")
        .def_readonly("arm_count", &Check::arm_count, "How many arms.")
        .def_readonly("max", &Check::max, "The largest error, in arm lengths, or as the name says.")
        .def_readonly("rms", &Check::rms, "The root of the mean square error.")
        .def_readonly("max_limit", &Check::max_limit, "What max may be.")
        .def_readonly("rms_limit", &Check::rms_limit, "What rms may be; 0: not limited.");
    module.def("verify", &verify, py::arg("arm_count") = 10000, py::arg("seed") = 1,
               "Checks the formulas against each other on random arms, arm_count in each of five bands of reach.\n\n"
               "Gives whether every limit was kept, and the list of Checks. About a microsecond an arm, on the\n"
               "calling thread. The same seed gives the same arms everywhere.");
}

// Thrown to end a filling that Python interrupts.
struct Stopped {};

// Fills on a thread of its own, because Python looks at signals on its main thread alone, and chunks end on any.
tools::FillReport fill_interruptibly(const std::filesystem::path& folder, tools::FillOptions options)
{
    std::atomic<bool> stops = false;
    options.progress = [&](std::uint64_t) {
        if (stops) throw Stopped();
    };
    std::future<tools::FillReport> filling =
        std::async(std::launch::async, [&] { return tools::fill(tools::Cache(folder), options); });
    for (;;) {
        {
            const py::gil_scoped_release released;
            if (filling.wait_for(std::chrono::milliseconds(100)) == std::future_status::ready) break;
        }
        if (PyErr_CheckSignals() == 0) continue;
        stops = true;
        {
            const py::gil_scoped_release released;
            filling.wait();
        }
        throw py::error_already_set();
    }
    return filling.get();
}

py::dict fill_cache(const std::filesystem::path& folder, std::uint32_t index, std::uint32_t count, unsigned threads)
{
    if (index >= count) throw py::value_error("index: it must be below count");
    tools::FillOptions options;
    options.shard = {index, count};
    options.threads = threads;
    tools::FillReport report;
    try {
        report = fill_interruptibly(folder, options);
    } catch (const formats::InputError& error) {  // its text names a file, which need not be UTF-8
        const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(error.what()));
        if (text) PyErr_SetObject(PyExc_RuntimeError, text.ptr());
        throw py::error_already_set();
    }
    py::dict filled;
    filled["written"] = report.written;
    filled["left"] = report.left;
    filled["limbs"] = report.limbs;
    return filled;
}

}  // namespace

void add_steps(py::module_& module)
{
    py::class_<swivel_entity> one(module, "Entity", "One entity of the lecture's five steps, as steps() gives it.");
    one.attr("__module__") = "swivel";
    one.def("__repr__", [](const swivel_entity& entity) {
        return "<Entity " + std::string(entity.name) + ", step " + std::to_string(entity.step) + ": " + entity.meaning +
               ">";
    });
    one.def_readonly("name", &swivel_entity::name, "As the lecture calls it, such as \"S1\".")
        .def_readonly("meaning", &swivel_entity::meaning, "What it is, in a few words.")
        .def_readonly("step", &swivel_entity::step, "The step that makes it, 1 to 5.")
        .def_property_readonly(
            "coefficients", [](const swivel_entity& entity) { return py::array_t<double>(32, entity.coefficients); },
            "Of the 32 blades, which blade_name() names: (32,) float64.");
    module.def("steps", &steps_of, py::arg("target"), py::arg("pole"), py::arg("upper"), py::arg("fore"),
               "The lecture's five steps for one arm in its arm frame, in double.\n\n"
               "target (3,): where the wrist goes. pole (3,): a point on the elbow's side. upper, fore: bone lengths.\n"
               "Gives the list of Entities, and how far their rotors put the wrist from the target, in arm lengths.\n"
               "ValueError where the lecture's formulas divide by zero, such as out of reach.");
    module.def("blade_name", &blade_name, py::arg("blade"),
               "The name of a blade of an Entity's coefficients, 0 to 31, such as \"e1^einf\".");
}

void add_library(py::module_& module)
{
    module.attr("LANES") = static_cast<int>(SWIVEL_LANES);
    module.def(
        "version",
        [] {
            const std::uint32_t version = swivel_version();
            return py::make_tuple(version / 10000, version / 100 % 100, version % 100);
        },
        "Major, minor and patch version of the library.");
    module.def("isa_name", &isa_name,
               "The instruction set in use. RuntimeError if the environment's SWIVEL_FORCE_ISA cannot be used.");
    module.def(
        "use_isa", [](const std::string& name) { swivel::check(swivel_use_isa(name.c_str())); }, py::arg("name"),
        "Changes the instruction set, for the whole process and from the next solve on. ValueError for an\n"
        "unknown name, RuntimeError for one that this CPU does not run.");
    module.def("isas", &isas, "The built-in instruction sets, best first: pairs of name and whether this CPU runs it.");
    module.def("unpack_rotations", &unpack_rotations, py::arg("words"),
               "Quaternions x, y, z, w of packed results: (4,) or (n, 4) float32 from words of shape (3,) or (n, 3)\n"
               "uint16, as Crowd.pack() gives them. Half floats are NumPy's: words.view(np.float16).");
    add_check(module);
}

void add_cache(py::module_& module)
{
    module.def(
        "fill_cache", &fill_cache, py::arg("folder"), py::arg("index") = 0, py::arg("count") = 1, py::kw_only(),
        py::arg("threads") = 0,
        "Solves the chunks of part index, from 0 on, of count parts of a cache that `swivel store` made.\n\n"
        "Chunks that are done are left. threads: 0 for all. Processes may fill different parts, or the same one, at\n"
        "once; each chunk appears whole. Gives the chunks \"written\" and \"left\", and the \"limbs\" solved.\n"
        "RuntimeError names a file that is missing or damaged, or cannot be written.");
}

}  // namespace swivel::python
