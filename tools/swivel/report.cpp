// SPDX-License-Identifier: MIT
#include "tools/swivel/report.h"

#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "swivel/swivel.h"
#include "tools/swivel/limb_words.h"
#include "tools/swivel/parallel.h"

namespace swivel::tools {

namespace {

using formats::LimbKind;

constexpr std::pair<swivel_flag, const char*> kFlagNames[] = {
    {SWIVEL_REACHED, "reached"},
    {SWIVEL_SOFTENED, "softened"},
    {SWIVEL_STRETCHED, "stretched"},
    {SWIVEL_CLAMPED_FAR, "clamped far"},
    {SWIVEL_CLAMPED_NEAR, "clamped near"},
    {SWIVEL_SWIVEL_UNDEFINED, "swivel undefined"},
    {SWIVEL_LIMITED_FLEXION, "limited by flexion"},
    {SWIVEL_LIMITED_SHOULDER_CONE, "limited by shoulder cone"},
    {SWIVEL_LIMITED_HUMERAL_TWIST, "limited by humeral twist"},
    {SWIVEL_LIMITED_SHOULDER_BOX, "limited by shoulder box"},
    {SWIVEL_LIMITED_HAND_CONE, "limited by hand cone"},
    {SWIVEL_LIMITED_FOREARM_TWIST, "limited by forearm twist"},
    {SWIVEL_LIMITED_HAND_TWIST, "limited by hand twist"},
    {SWIVEL_LIMITED_WRIST_BOX, "limited by wrist box"},
    {SWIVEL_LIMITED_STEP, "limited by most swivel"},
    {SWIVEL_INFEASIBLE, "infeasible"},
    {SWIVEL_JUMPED, "jumped"},
    {SWIVEL_BAD_INPUT, "bad input"}};

FlagStat flag_of(const Statistics& statistics, swivel_flag flag)
{
    const auto bit = static_cast<std::size_t>(std::countr_zero(static_cast<std::uint32_t>(flag)));
    FlagStat of_all = statistics.arms.flags[bit];
    of_all.add(statistics.legs.flags[bit]);
    return of_all;
}

std::string text_of(const PoseName& pose)
{
    return fmt::format("frame {}, character {}, {}", pose.frame, pose.character, limb_word(pose.limb));
}
nlohmann::ordered_json json_of(const PoseName& pose)
{
    return {{"frame", pose.frame}, {"character", pose.character}, {"limb", limb_word(pose.limb)}};
}

std::uint64_t limb_count(const Statistics& statistics)
{
    return statistics.arms.limb_count + statistics.legs.limb_count;
}

// What was solved, in one word.
std::string limbs_solved(const Statistics& statistics)
{
    if (statistics.legs.limb_count == 0) return "arms";
    return statistics.arms.limb_count == 0 ? "legs" : "limbs";
}

double limbs_per_second(const Statistics& statistics)
{
    return statistics.solve_seconds > 0 ? static_cast<double>(limb_count(statistics)) / statistics.solve_seconds : 0;
}

// The errors that were measured, each with its name and what it is measured in.
struct NamedError {
    std::string key, text, unit;
    const ErrorStat& error;
};
void add_errors(std::vector<NamedError>& to, const LimbStatistics& s, LimbKind kind)
{
    const LimbWords& w = words_of(kind);
    const bool arm = kind == LimbKind::arm;
    const std::string length = fmt::format("of the {}'s length", w.limb), upper = arm ? "upper_arm" : "thigh";
    const auto add = [&](std::string key, std::string text, std::string unit, const ErrorStat& error) {
        if (error.count > 0) to.push_back({std::move(key), std::move(text), std::move(unit), error});
    };
    add(std::string(w.end_joint), fmt::format("{} to target", w.end_joint), length, s.reached);
    add(arm ? "missed" : "leg_missed", fmt::format("{} to target, out of reach", w.end_joint), length, s.missed);
    add(arm ? "aim" : "leg_aim", fmt::format("{}'s ray to target", w.end), length, s.aimed);
    add(std::string(w.end), fmt::format("{} to orientation", w.end), "rad", s.orientation);
    add(fmt::format("{}_bent", w.lower_joint), fmt::format("{} to clip, bent over 5 deg", w.lower_joint), length,
        s.bent);
    add(fmt::format("{}_straight", w.lower_joint), fmt::format("{} to clip, straighter", w.lower_joint), length,
        s.straight);
    add(upper + "_swing", fmt::format("{} to clip, swing", w.upper), "rad", s.upper_swing);
    add(upper + "_twist", fmt::format("{} to clip, twist", w.upper), "rad", s.upper_twist);
    add(std::string(w.lower), fmt::format("{} to clip", w.lower), "rad", s.lower);
}
std::vector<NamedError> errors_of(const Statistics& statistics)
{
    std::vector<NamedError> errors;
    add_errors(errors, statistics.arms, LimbKind::arm);
    add_errors(errors, statistics.legs, LimbKind::leg);
    return errors;
}

}  // namespace

void print_statistics(const Statistics& statistics)
{
    const std::string limbs = limbs_solved(statistics);
    fmt::print("solved   {} {}, {:.1f} million {}/s ({}, {} thread{})\n", limb_count(statistics), limbs,
               limbs_per_second(statistics) / 1e6, limbs, swivel_isa_name(), thread_count(),
               thread_count() == 1 ? "" : "s");
    for (const NamedError& e : errors_of(statistics))
        fmt::print("error    {:<32} worst {:.2e}  rms {:.2e}  {}; worst in {}\n", e.text, e.error.max, e.error.rms(),
                   e.unit, text_of(e.error.worst_pose));
    for (const auto& [flag, name] : kFlagNames)
        if (const FlagStat stat = flag_of(statistics, flag); stat.count > 0)
            fmt::print("flag     {} {}, first in {}\n", name, stat.count, text_of(stat.first_pose));
    for (const auto& [s, kind] : {std::pair(&statistics.arms, LimbKind::arm), {&statistics.legs, LimbKind::leg}})
        if (s->turned_over > 0) {
            const LimbWords& w = words_of(kind);
            fmt::print(
                "note     the {} turns over against the clip in {} of {} poses: there the clip bends the {} the other "
                "way; limb.{}.pole.kind = \"incoming\" in a crowd file keeps the twist, and the {} goes "
                "where it may\n",
                w.upper, s->turned_over, s->upper_twist.count, w.lower_joint, w.limbs, w.lower_joint);
        }
}

nlohmann::ordered_json json_of(const Statistics& statistics)
{
    nlohmann::ordered_json out;
    out[limbs_solved(statistics)] = limb_count(statistics);
    out["solve_seconds"] = statistics.solve_seconds;
    out[limbs_solved(statistics) + "_per_second"] = limbs_per_second(statistics);
    out["isa"] = swivel_isa_name();
    out["threads"] = thread_count();
    for (const NamedError& e : errors_of(statistics))
        out["errors"][e.key] = {{"worst", e.error.max},
                                {"worst_pose", json_of(e.error.worst_pose)},
                                {"rms", e.error.rms()},
                                {"count", e.error.count},
                                {"unit", e.unit}};
    for (const auto& [flag, name] : kFlagNames) {
        const FlagStat stat = flag_of(statistics, flag);
        out["flags"][name] = stat.count;
        if (stat.count > 0) out["first_flagged"][name] = json_of(stat.first_pose);
    }
    for (const auto& [s, kind] : {std::pair(&statistics.arms, LimbKind::arm), {&statistics.legs, LimbKind::leg}})
        if (s->upper_twist.count > 0) out["turned_over"][words_of(kind).limbs] = s->turned_over;
    return out;
}

void print_json(const nlohmann::ordered_json& json)
{
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace swivel::tools
