// SPDX-License-Identifier: MIT
#include "tools/cache/cache.h"

#include <fmt/format.h>
#include <pybind11/stl/filesystem.h>

#include "tools/cache/fill.h"
#include "tools/python/helpers.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

py::dict fill_cache(const std::filesystem::path& folder, std::uint32_t index, std::uint32_t count, bool verify,
                    std::uint64_t memory, unsigned threads)
{
    if (index >= count) throw py::value_error("index: it must be below count");
    tools::FillOptions options;
    options.shard = {index, count, ""};
    options.verifies = verify;
    options.memory = memory;
    options.threads = threads;
    options.progress = [](std::uint64_t) {
        const py::gil_scoped_acquire held;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    };
    const auto report = [&] {
        const py::gil_scoped_release released;
        return tools::fill(tools::Cache(folder), options);
    }();
    py::list again;
    for (const tools::Difference& each : report.differences)
        again.append(fmt::format("{}.{}: {}", each.at.time, each.at.column, each.what));
    py::dict filled;
    filled["written"] = report.written;
    filled["compared"] = report.compared;
    filled["skipped"] = report.skipped;
    filled["limbs"] = report.limbs;
    filled["bytes"] = report.bytes;
    filled["written_again"] = again;
    return filled;
}

}  // namespace

void add_cache(py::module_& module)
{
    module.def(
        "fill_cache", &fill_cache, py::arg("folder"), py::arg("index") = 0, py::arg("count") = 1, py::kw_only(),
        py::arg("verify") = false, py::arg("memory") = std::uint64_t{1} << 30, py::arg("threads") = 0,
        "Solves the chunks of part index, from 0 on, of count parts of a cache that `swivel store` made.\n\n"
        "Chunks that are done are left. With verify they are solved again, and those that differ are written\n"
        "again. memory: bytes that the process may take. threads: 0 for all.\n"
        "Processes may fill different parts, or the same one, at once; each chunk appears whole.\n"
        "Gives the chunks \"written\", \"compared\" and \"skipped\", the \"limbs\" solved, the \"bytes\" of files,\n"
        "and \"written_again\", a list of texts. RuntimeError names a file that is missing or damaged, or cannot\n"
        "be written.");
}

}  // namespace swivel::python
