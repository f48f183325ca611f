// SPDX-License-Identifier: MIT
#include "tools/swivel/verify_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace swivel::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kReach = "reach ";  // starts the names of bands

std::string error_text(const Json& number) { return fmt::format("{:.3e}", number.get<double>()); }

void put_checks(Report& report, const Json& checks)
{
    report.heading("Checks");
    report.paragraph(
        "Three programs solve the same arms. The oracle is plain algebra on dense multivectors. pipeline is the "
        "lecture's "
        "five steps, line by line. production is the formula that swivel solves with, in double and in float, the "
        "precision of every solve. How far wrists are from targets is in lengths of the arm; rms is the "
        "root mean square.");
    std::vector<std::vector<Cell>> rows;
    for (const Json& check : checks) {
        const bool has_rms_limit = check.at("rms_limit").get<double>() > 0;
        Cell passed(check.at("passed").get<bool>() ? "passed" : "failed");
        passed.is_bad = !check.at("passed").get<bool>();
        rows.push_back({check.at("name").get<std::string>(), check.at("set").get<std::string>(),
                        check.at("arms").dump(), error_text(check.at("max")), error_text(check.at("max_limit")),
                        error_text(check.at("rms")), has_rms_limit ? error_text(check.at("rms_limit")) : "", passed});
    }
    report.table({"what is compared", "arms", "count", "largest", "its limit", "rms", "limit of rms", "result"}, rows);
}

// A plot for each check that is made in several bands of reach.
void put_bands(Report& report, const Json& checks)
{
    std::vector<std::string> names;
    for (const Json& check : checks)
        if (std::ranges::count(names, check.at("name").get<std::string>()) == 0) names.push_back(check.at("name"));
    for (const std::string& name : names) {
        Plot plot{name + ", by band of reach",
                  "where the target is, from the nearest to the furthest place that a wrist can reach",
                  "error",
                  false,
                  true,
                  {{"largest", {}}, {"rms", {}}, {"limit", {}, true, true}}};
        for (const Json& check : checks) {
            if (check.at("name") != name) continue;
            const auto at = static_cast<double>(plot.x_names.size());
            const auto band = check.at("set").get<std::string>();
            plot.x_names.push_back(band.starts_with(kReach) ? band.substr(kReach.size()) : band);
            plot.series[0].points.emplace_back(at, check.at("max").get<double>());
            plot.series[1].points.emplace_back(at, check.at("rms").get<double>());
            plot.series[2].points.emplace_back(at, check.at("max_limit").get<double>());
        }
        if (plot.x_names.size() > 2) report.plot(plot);
    }
}

void put_digests(Report& report, const Json& digests)
{
    report.heading("Digests");
    report.paragraph("The results' bits of frozen crowds, by instruction set and by the way they are solved.");
    std::vector<std::vector<Cell>> rows;
    for (const Json& digest : digests) {
        Cell passed(digest.at("passed").get<bool>() ? "as recorded" : "differs");
        passed.is_bad = !digest.at("passed").get<bool>();
        std::vector<Cell> row;
        for (const char* key : {"isa", "how", "ordinary", "hard", "limbs"})
            row.push_back(digest.at(key).get<std::string>());
        row.push_back(passed);
        rows.push_back(row);
    }
    report.table({"instruction set", "solved", "ordinary arms", "hard arms", "limbs", "result"}, rows);
}

}  // namespace

void put_verification(Report& report, const Json& run)
{
    report.paragraph(run.at("passed").get<bool>() ? "All checks passed, and all digests are the recorded ones."
                                                  : "A check failed, or a digest differs.");
    put_checks(report, run.at("checks"));
    put_bands(report, run.at("checks"));
    put_digests(report, run.at("digests"));
}

}  // namespace swivel::tools
