// SPDX-License-Identifier: MIT
#include "tools/swivel/report.h"

#include <fmt/format.h>

#include <cctype>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "swivel/swivel.h"
#include "tools/cli/streams.h"
#include "tools/crowd/parallel.h"
#include "tools/rig/limb_words.h"

namespace swivel::tools {

namespace {

using formats::LimbKind;

// All flags, each with its name in words, "clamped far".
std::vector<std::pair<std::string, FlagStat>> flags_of(const Statistics& statistics)
{
    std::vector<std::pair<std::string, FlagStat>> flags;
    for (std::size_t bit = 0; bit < statistics.arms.flags.size(); ++bit) {
        const char* const name = swivel_flag_name(1u << bit);
        if (!name) continue;
        auto& [words, of_all] = flags.emplace_back(name, statistics.arms.flags[bit]);
        for (char& c : words) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        of_all.add(statistics.legs.flags[bit]);
    }
    return flags;
}

std::string text_of(const PoseName& pose)
{
    return fmt::format("frame {}, character {}, {}", pose.frame, pose.character, limb_word(pose.limb));
}
nlohmann::ordered_json json_of(const PoseName& pose)
{
    return {{"frame", pose.frame}, {"character", pose.character}, {"limb", limb_word(pose.limb)}};
}

// What was solved, in one word.
std::string limbs_solved(const Statistics& statistics)
{
    if (statistics.legs.limb_count == 0) return "arms";
    return statistics.arms.limb_count == 0 ? "legs" : "limbs";
}

double limbs_per_second(const Statistics& statistics)
{
    return statistics.solve_seconds > 0 ? static_cast<double>(statistics.limb_count()) / statistics.solve_seconds : 0;
}

// What a distance says: that the solver is wrong, that a target is out of reach, or that a pose is not the clip's.
struct Meaning {
    const char *line, *key;  // in a report, in JSON
};
constexpr Meaning kError{"error", "errors"}, kMissed{"missed", "missed"}, kDiffers{"differs", "differences_from_clip"};

// The distances that were measured, each with its name and what it is measured in.
struct Distance {
    Meaning meaning;
    std::string key, text, unit;
    const ErrorStat& stat;
};
void add_distances(std::vector<Distance>& to, const LimbStatistics& s, LimbKind kind)
{
    const LimbWords& w = words_of(kind);
    const bool arm = kind == LimbKind::arm;
    const std::string length = fmt::format("of the {}'s length", w.limb), upper = arm ? "upper_arm" : "thigh";
    const auto add = [&](Meaning meaning, std::string key, std::string text, std::string unit, const ErrorStat& stat) {
        if (stat.count > 0) to.push_back({meaning, std::move(key), std::move(text), std::move(unit), stat});
    };
    const auto joint = [&](std::string_view suffix) { return fmt::format("{}_{}", w.lower_joint, suffix); };
    const std::string key(w.end_joint), end = s.has_effector ? "effector" : key;
    add(kError, key, end + " to target", length, s.reached);
    add(kError, arm ? "aim" : "leg_aim", fmt::format("{}'s ray to target", w.end), length, s.aimed);
    add(kError, std::string(w.end), fmt::format("{} to orientation", w.end), "rad", s.orientation);
    add(kMissed, key, end + " to target, not reached", length, s.missed);
    add(kMissed, arm ? "aim" : "leg_aim", fmt::format("{}'s ray to target, not reached", w.end), length, s.aim_missed);
    add(kDiffers, joint("given"), fmt::format("{} from clip, goal given", w.lower_joint), length, s.given);
    add(kDiffers, joint("bent"), fmt::format("{} from clip, bent over 5 deg", w.lower_joint), length, s.bent);
    add(kDiffers, joint("straight"), fmt::format("{} from clip, straighter", w.lower_joint), length, s.straight);
    add(kDiffers, upper + "_swing", fmt::format("{} from clip, swing", w.upper), "rad", s.upper_swing);
    add(kDiffers, upper + "_twist", fmt::format("{} from clip, twist", w.upper), "rad", s.upper_twist);
    add(kDiffers, std::string(w.lower), fmt::format("{} from clip", w.lower), "rad", s.lower);
}
std::vector<Distance> distances_of(const Statistics& statistics)
{
    std::vector<Distance> distances;
    add_distances(distances, statistics.arms, LimbKind::arm);
    add_distances(distances, statistics.legs, LimbKind::leg);
    return distances;
}

// What is wrong with the limbs of a run that went_wrong(), and what to look at.
std::string what_went_wrong(const Statistics& statistics)
{
    std::string text = fmt::format("of {} {}", statistics.limb_count(), limbs_solved(statistics));
    if (const std::uint64_t count = statistics.unreached(); count > 0)
        text += fmt::format(", {} {} out of reach; are the targets in the right place and unit?", count,
                            count == 1 ? "is" : "are");
    if (const std::uint64_t count = statistics.bad(); count > 0)
        text += fmt::format("{} {} {} bad input; are positions below 1e15 and bones longer than 0?",
                            statistics.unreached() > 0 ? "" : ",", count, count == 1 ? "has" : "have");
    return text;
}

}  // namespace

void print_statistics(std::FILE* to, const Statistics& statistics)
{
    const std::string limbs = limbs_solved(statistics);
    say(to, "solved   {} {}, {:.1f} million {}/s ({}, {} thread{})\n", statistics.limb_count(), limbs,
        limbs_per_second(statistics) / 1e6, limbs, swivel_isa_name(), thread_count(), thread_count() == 1 ? "" : "s");
    for (const Distance& d : distances_of(statistics))
        say(to, "{:<8} {:<32} worst {:.2e}  rms {:.2e}  {}; worst in {}\n", d.meaning.line, d.text, d.stat.max,
            d.stat.rms(), d.unit, text_of(d.stat.worst_pose));
    for (const auto& [name, stat] : flags_of(statistics))
        if (stat.count > 0) say(to, "flag     {} {}, first in {}\n", name, stat.count, text_of(stat.first_pose));
    if (const LookStatistics& looks = statistics.looks; looks.count > 0)
        say(to,
            "looks    {} of {} meet their target, {} turn no further, {} have it behind them or too near, {} are on "
            "their "
            "way\n",
            looks.met, looks.count, looks.limited, looks.faded, looks.on_their_way());
    if (went_wrong(statistics))
        say(to, "note     most {} are not where they should be: {}\n", limbs, what_went_wrong(statistics));
}

nlohmann::ordered_json json_of(const Statistics& statistics)
{
    nlohmann::ordered_json out;
    out[limbs_solved(statistics)] = statistics.limb_count();
    out["solve_seconds"] = statistics.solve_seconds;
    out[limbs_solved(statistics) + "_per_second"] = limbs_per_second(statistics);
    out["isa"] = swivel_isa_name();
    out["threads"] = thread_count();
    for (const Distance& d : distances_of(statistics))
        out[d.meaning.key][d.key] = {
            {"what", d.text},      {"worst", d.stat.max},   {"worst_pose", json_of(d.stat.worst_pose)},
            {"rms", d.stat.rms()}, {"count", d.stat.count}, {"unit", d.unit}};
    for (const auto& [name, stat] : flags_of(statistics)) {
        out["flags"][name] = stat.count;
        if (stat.count > 0) out["first_flagged"][name] = json_of(stat.first_pose);
    }
    if (const LookStatistics& looks = statistics.looks; looks.count > 0)
        out["looks"] = {{"count", looks.count},
                        {"met", looks.met},
                        {"limited", looks.limited},
                        {"faded", looks.faded},
                        {"on_their_way", looks.on_their_way()}};
    out["out_of_reach"] = statistics.unreached();
    out["bad_input"] = statistics.bad();
    out["went_wrong"] = went_wrong(statistics);
    return out;
}

nlohmann::ordered_json frame_time_of(const formats::Clip& clip)
{
    return clip.frame_time > 0 ? nlohmann::ordered_json(clip.frame_time) : nlohmann::ordered_json();
}

void print_json(const nlohmann::ordered_json& json, std::FILE* to)
{
    say(to, "{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace swivel::tools
