// SPDX-License-Identifier: MIT
#include "tools/swivel/solve_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace swivel::tools {

namespace {

using Json = nlohmann::ordered_json;

std::string digits_of(const Json& number) { return fmt::format("{:.4g}", number.get<double>()); }

// What was solved: "arms", "legs" or "limbs", as json_of() has it.
std::string limbs_of(const Json& run)
{
    for (const char* word : {"arms", "legs"})
        if (run.contains(word)) return word;
    return "limbs";
}

// How far the worst limb that did not reach its target is from it, in limb lengths; 0: none was measured.
double furthest_of(const Json& run)
{
    double furthest = 0;
    if (run.contains("missed"))
        for (const auto& [key, stat] : run.at("missed").items())
            furthest = std::max(furthest, stat.at("worst").get<double>());
    return furthest;
}

}  // namespace

std::string text_of(const Json& string) { return string.get<std::string>(); }

std::string count_of(const Json& number)
{
    std::string digits = std::to_string(number.get<std::uint64_t>());
    for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
    return digits;
}

std::string result_of(const Json& run)
{
    const std::string limbs = limbs_of(run), limb = limbs.substr(0, limbs.size() - 1);
    const auto all = run.at(limbs).get<std::uint64_t>(), reached = run.at("flags").at("reached").get<std::uint64_t>();
    const auto bad = run.at("bad_input").get<std::uint64_t>();
    std::string text;
    if (all == 0) return fmt::format("No {} was solved.", limb);
    if (all == 1)
        text = fmt::format("The {} {} its target.", limb, reached == 1 ? "reached" : "did not reach");
    else if (reached == 0)
        text = fmt::format("None of the {} {} reached its target.", count_of(all), limbs);
    else if (2 * reached < all)
        text = fmt::format("Only {} of {} {} reached their targets.", count_of(reached), count_of(all), limbs);
    else
        text = fmt::format("All {} {} reached their targets{}.", count_of(all), limbs,
                           reached == all ? "" : " but for " + count_of(all - reached));
    if (const double furthest = furthest_of(run); furthest > 0)
        text += fmt::format(" The furthest is {:.4g} times its length away from its target.", furthest);
    if (bad > 0) text += fmt::format(" {} {} bad input.", count_of(bad), bad == 1 ? "has" : "have");
    if (run.at("went_wrong").get<bool>()) text += " Are the targets in the right place and unit?";
    return text;
}

std::vector<std::vector<Cell>> facts_of(const Json& run)
{
    const std::string limbs = limbs_of(run), targets = text_of(run.at("targets"));
    const Json& frame_time = run.at("frame_time");
    std::vector<std::vector<Cell>> rows;
    const auto add = [&](const std::string& what, const std::string& value) { rows.push_back({what, value}); };
    add("clip", text_of(run.at("clip")));
    add("motion", text_of(run.at("motion")));
    add("joints", count_of(run.at("joints")));
    add("frames", count_of(run.at("frames")));
    add("frames a second",
        frame_time.is_null() ? "uneven: the times of its keys" : digits_of(1 / frame_time.get<double>()));
    add("characters", count_of(run.at("characters")));
    if (run.at("characters").get<std::uint32_t>() > 1) add("seed of the crowd", count_of(run.at("seed")));
    add("targets from", targets == "clip" ? "the clip" : targets);
    if (run.contains("crowd")) add("all else from", text_of(run.at("crowd")));
    add(limbs + " solved, in all frames", count_of(run.at(limbs)));
    add("out of reach: too far or too near, by more than 1e-4 of their length", count_of(run.at("out_of_reach")));
    add("with bad input", count_of(run.at("bad_input")));
    add("seconds to solve", digits_of(run.at("solve_seconds")));
    add("million " + limbs + " a second", digits_of(run.at(limbs + "_per_second").get<double>() / 1e6));
    add("instruction set", text_of(run.at("isa")));
    add("threads", count_of(run.at("threads")));
    add("seconds in all, with reading and writing", digits_of(run.at("seconds")));
    if (run.contains("out")) add("poses in", text_of(run.at("out")));
    if (run.contains("export_targets")) add("targets in", text_of(run.at("export_targets")));
    if (run.contains("view")) add("page", text_of(run.at("view")));
    return rows;
}

}  // namespace swivel::tools
