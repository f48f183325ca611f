// SPDX-License-Identifier: MIT
#include "tools/formats/agents_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "tools/formats/csv_rows.h"
#include "tools/formats/error.h"
#include "tools/formats/limits.h"
#include "tools/formats/printable.h"
#include "tools/formats/suggestion.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

struct AgentColumn {
    const char* name;
    double Agent::*number;  // null: the name
    double min, max;
    bool is_whole, is_needed;
};
constexpr AgentColumn kAgentColumns[] = {{"name", nullptr, 0, 0, false, true},
                                         {"x", &Agent::x, -kMaxNorm, kMaxNorm, false, true},
                                         {"y", &Agent::y, -kMaxNorm, kMaxNorm, false, true},
                                         {"z", &Agent::z, -kMaxNorm, kMaxNorm, false, true},
                                         {"heading_deg", &Agent::heading_deg, -360, 360, false, false},
                                         {"start", &Agent::start, 0, 1e9, true, false},
                                         {"clip", &Agent::clip, 0, 1e9, true, false},
                                         {"size", &Agent::size, 0.01, 100, false, false},
                                         {"build", &Agent::build, 0, 1e9, true, false}};

// What is wrong with a cell, which the agent takes; empty: nothing.
std::string take(const AgentColumn& column, std::string_view cell, Agent& agent)
{
    if (!column.number) {
        agent.name = cell;
        return is_plain_name(cell) ? "" : "is no name; give one in UTF-8 without commas and quotes";
    }
    const std::optional<double> number = parse_number(cell);
    const bool fits = number && *number >= column.min && *number <= column.max;
    if (!fits || (column.is_whole && *number != std::floor(*number)))
        return fmt::format("is not a {} from {:g} to {:g}", column.is_whole ? "whole number" : "number", column.min,
                           column.max);
    agent.*column.number = *number;
    return {};
}

// The columns that the first line names.
std::vector<AgentColumn> columns_named(const std::filesystem::path& path, std::size_t line,
                                       const std::vector<std::string_view>& cells)
{
    const auto refuse = [&](const std::string& cause) { throw InputError(path, line, cause); };
    std::vector<std::string> known;
    for (const AgentColumn& each : kAgentColumns) known.emplace_back(each.name);
    std::vector<AgentColumn> columns;
    for (const std::string_view cell : cells) {
        const auto found = std::ranges::find(kAgentColumns, cell, &AgentColumn::name);
        if (found == std::end(kAgentColumns))
            refuse(fmt::format("there is no column '{}'; {}", printable(cell), suggestion(cell, known)));
        columns.push_back(*found);
    }
    for (const AgentColumn& each : kAgentColumns) {
        const auto count = std::ranges::count(cells, each.name);
        if (count > 1) refuse(fmt::format("column {} is there twice; remove one", each.name));
        if (count == 0 && each.is_needed)
            refuse(fmt::format("has no column {}; the first line names the columns", each.name));
    }
    return columns;
}

}  // namespace

std::vector<Agent> read_agents_csv(const std::filesystem::path& path)
{
    std::vector<Agent> agents;
    std::vector<AgentColumn> columns;
    std::map<std::string, std::size_t> lines;  // of each name
    for_each_row(path, [&](std::size_t line, const std::vector<std::string_view>& cells) {
        const auto refuse = [&](const std::string& cause) { throw InputError(path, line, cause); };
        if (columns.empty()) {
            columns = columns_named(path, line, cells);
            return;
        }
        if (cells.size() != columns.size())
            refuse(fmt::format("{} values; a row has {}", cells.size(), columns.size()));
        Agent& agent = agents.emplace_back();
        agent.line = line;
        for (std::size_t n = 0; n < cells.size(); ++n)
            if (const std::string problem = take(columns[n], cells[n], agent); !problem.empty())
                refuse(fmt::format("column {}: '{}' {}", columns[n].name, printable(cells[n]), problem));
        const auto [other, is_new] = lines.emplace(agent.name, line);
        if (!is_new)
            refuse(fmt::format("the name '{}' is already in line {}; give another", agent.name, other->second));
    });
    if (agents.empty()) throw InputError(path, "has no agents; write a line of columns and a row for each");
    return agents;
}

}  // namespace swivel::formats
