// SPDX-License-Identifier: MIT
#include "tools/swivel/report.h"

#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "swivel/swivel.h"
#include "tools/swivel/parallel.h"

namespace swivel::tools {

namespace {

constexpr std::pair<swivel_flag, const char*> kFlagNames[] = {{SWIVEL_REACHED, "reached"},
                                                              {SWIVEL_CLAMPED_FAR, "clamped far"},
                                                              {SWIVEL_CLAMPED_NEAR, "clamped near"},
                                                              {SWIVEL_SWIVEL_UNDEFINED, "swivel undefined"},
                                                              {SWIVEL_BAD_INPUT, "bad input"}};

std::uint64_t count_of(const Statistics& statistics, swivel_flag flag)
{
    return statistics.flags[static_cast<std::size_t>(std::countr_zero(static_cast<std::uint32_t>(flag)))];
}

double arms_per_second(const Statistics& statistics)
{
    return statistics.solve_seconds > 0 ? static_cast<double>(statistics.arm_count) / statistics.solve_seconds : 0;
}

// The errors that were measured, each with its name and what it is measured in.
struct NamedError {
    const char* key;
    const char* text;
    const char* unit;
    const ErrorStat& error;
};
std::array<NamedError, 8> errors_of(const Statistics& s)
{
    return {{{"wrist", "wrist to target", "of the arm's length", s.wrist},
             {"missed", "wrist to target, out of reach", "of the arm's length", s.missed},
             {"hand", "hand to orientation", "rad", s.hand},
             {"elbow_bent", "elbow to clip, bent over 5 deg", "of the arm's length", s.elbow_bent},
             {"elbow_straight", "elbow to clip, straighter", "of the arm's length", s.elbow_straight},
             {"upper_arm_swing", "upper arm to clip, swing", "rad", s.upper_arm_swing},
             {"upper_arm_twist", "upper arm to clip, twist", "rad", s.upper_arm_twist},
             {"forearm", "forearm to clip", "rad", s.forearm}}};
}

}  // namespace

void print_statistics(const Statistics& statistics)
{
    fmt::print("solved   {} arms, {:.1f} million arms/s ({}, {} thread{})\n", statistics.arm_count,
               arms_per_second(statistics) / 1e6, swivel_isa_name(), thread_count(), thread_count() == 1 ? "" : "s");
    for (const NamedError& e : errors_of(statistics))
        if (e.error.count > 0)
            fmt::print("error    {:<32} worst {:.2e}  rms {:.2e}  {}\n", e.text, e.error.max, e.error.rms(), e.unit);
    std::string flags;
    for (const auto& [flag, name] : kFlagNames)
        if (count_of(statistics, flag) > 0)
            flags += fmt::format("{}{} {}", flags.empty() ? "" : ", ", name, count_of(statistics, flag));
    fmt::print("flags    {}\n", flags);
}

nlohmann::ordered_json json_of(const Statistics& statistics)
{
    nlohmann::ordered_json out;
    out["arms"] = statistics.arm_count;
    out["solve_seconds"] = statistics.solve_seconds;
    out["arms_per_second"] = arms_per_second(statistics);
    out["isa"] = swivel_isa_name();
    out["threads"] = thread_count();
    for (const NamedError& e : errors_of(statistics))
        if (e.error.count > 0)
            out["errors"][e.key] = {
                {"worst", e.error.max}, {"rms", e.error.rms()}, {"count", e.error.count}, {"unit", e.unit}};
    for (const auto& [flag, name] : kFlagNames) out["flags"][name] = count_of(statistics, flag);
    return out;
}

void print_json(const nlohmann::ordered_json& json)
{
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace swivel::tools
