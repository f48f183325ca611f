// SPDX-License-Identifier: MIT
#include "tools/swivel/report_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "tools/cli/command_error.h"
#include "tools/cli/signals.h"
#include "tools/formats/output_file.h"
#include "tools/formats/text.h"

namespace swivel::tools {

void require_html_name(std::string_view option, const std::string& file)
{
    constexpr std::string_view kOthers[] = {".csv", ".bvh", ".glb", ".gltf", ".vrm", ".toml"};
    const std::string suffix = formats::lower_suffix(file);
    if (std::ranges::find(kOthers, suffix) != std::end(kOthers))
        throw CommandError(
            2, fmt::format("{} {}: writes HTML, and {} is for other files; name a .html", option, file, suffix));
}

void require_report_file(const std::string& file)
{
    if (file.empty()) return;
    require_html_name("--report", file);
    if (formats::is_standard_stream(file))
        throw CommandError(2, "--report -: standard output has the figures; name a file");
    const StopSignals signals;
    {
        const formats::OutputFile can_be_written(file);
    }
    signals.check();
}

void write_report(const std::string& file, const std::string& title, const std::function<void(Report&)>& put)
{
    const StopSignals signals;
    Report report(file, title);
    put(report);
    signals.check();
    report.commit();
}

}  // namespace swivel::tools
