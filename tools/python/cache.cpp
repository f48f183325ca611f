// SPDX-License-Identifier: MIT
#include "tools/cache/cache.h"

#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <chrono>
#include <future>

#include "tools/cache/fill.h"
#include "tools/formats/error.h"
#include "tools/python/helpers.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

// What ends a filling that Python interrupts.
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
