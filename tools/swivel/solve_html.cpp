// SPDX-License-Identifier: MIT
#include "tools/swivel/solve_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

using Json = nlohmann::ordered_json;

std::string words_of_key(std::string key)
{
    std::ranges::replace(key, '_', ' ');
    return key;
}
std::string text_of(const Json& value)
{
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}
PoseName pose_of(const Json& json)
{
    return {json.at("frame").get<std::uint64_t>(), json.at("character").get<std::uint32_t>(),
            *formats::limb_of_word(json.at("limb").get<std::string>())};
}

}  // namespace

SolveHtml::SolveHtml(const std::filesystem::path& path, const std::filesystem::path& page, const std::string& title)
    : path_(path), page_(page), report_(path, title)
{
}

void SolveHtml::add_frame(const Statistics& of_frame, const ClipCrowd& crowd)
{
    Frame frame;
    LimbStatistics all = of_frame.arms;
    all.add(of_frame.legs);
    all.reached.add(all.aimed);
    all.missed.add(all.aim_missed);
    frame.limb_count = all.limb_count;
    frame.reached_worst = all.reached.max;
    frame.reached_rms = all.reached.rms();
    frame.missed_worst = all.missed.max;
    for (std::size_t bit = 0; bit < all.flags.size(); ++bit) frame.flags[bit] = all.flags[bit].count;
    frames_.push_back(frame);
    keep_worst(all.worst, crowd);
}

// Only now does the crowd know why.
void SolveHtml::keep_worst(const WorstLimbs& of_frame, const ClipCrowd& crowd)
{
    worst_.add(of_frame);
    std::map<PoseName, Why> why;
    for (const auto& [pose, error] : worst_.limbs()) {
        const auto known = why_.find(pose);
        why[pose] = known != why_.end()
                        ? known->second
                        : Why{crowd.flags(pose.limb, pose.character), crowd.explain(pose.limb, pose.character)};
    }
    why_ = std::move(why);
}

Cell SolveHtml::place_of(const PoseName& pose) const
{
    const std::string text =
        fmt::format("frame {}, character {}, {}", pose.frame, pose.character, limb_word(pose.limb));
    if (page_.empty()) return text;
    return {text,
            address_of(page_, path_,
                       fmt::format("frame={}&character={}&limb={}", pose.frame, pose.character, limb_word(pose.limb)))};
}

void SolveHtml::put_facts(const Json& run)
{
    std::vector<std::vector<Cell>> rows;
    for (const auto& [key, value] : run.items())
        if (!value.is_structured()) rows.push_back({words_of_key(key), text_of(value)});
    report_.table({"what", "value"}, rows);
}

// A table for each kind, whose columns are what --json says of the first.
void SolveHtml::put_limbs(const Json& run)
{
    report_.heading("Limbs");
    for (const char* kind : {"arms_bound", "legs_bound"}) {
        if (!run.contains(kind)) continue;
        std::vector<std::string> heads;
        for (const auto& [key, value] : run.at(kind).at(0).items()) heads.push_back(words_of_key(key));
        std::vector<std::vector<Cell>> rows;
        for (const Json& limb : run.at(kind)) {
            rows.emplace_back();
            for (const auto& [key, value] : limb.items()) rows.back().push_back(text_of(value));
        }
        report_.table(heads, rows);
    }
}

void SolveHtml::put_missing(const Json& run)
{
    if (!run.contains("missing")) return;
    report_.heading("Limbs that do not bind");
    std::vector<std::vector<Cell>> rows;
    for (const Json& limb : run.at("missing")) rows.push_back({text_of(limb.at("limb")), text_of(limb.at("problem"))});
    report_.table({"limb", "problem"}, rows);
}

void SolveHtml::put_errors(const Json& run)
{
    report_.heading("Errors and differences");
    std::vector<std::vector<Cell>> rows;
    for (const char* meaning : {"errors", "missed", "differences_from_clip"}) {
        if (!run.contains(meaning)) continue;
        for (const auto& [key, stat] : run.at(meaning).items())
            rows.push_back({words_of_key(meaning), words_of_key(key),
                            fmt::format("{:.3e}", stat.at("worst").get<double>()),
                            fmt::format("{:.3e}", stat.at("rms").get<double>()), text_of(stat.at("count")),
                            text_of(stat.at("unit")), place_of(pose_of(stat.at("worst_pose")))});
    }
    report_.table({"kind", "of", "worst", "rms", "count", "unit", "worst in"}, rows);
    report_.plot(errors_over_time());
}

void SolveHtml::put_flags(const Json& run)
{
    report_.heading("Flags");
    std::vector<std::vector<Cell>> rows;
    for (const auto& [name, count] : run.at("flags").items())
        if (count.get<std::uint64_t>() > 0)
            rows.push_back({name, text_of(count), place_of(pose_of(run.at("first_flagged").at(name)))});
    report_.table({"flag", "limbs", "first in"}, rows);
    report_.plot(flags_over_time());
}

void SolveHtml::put_worst()
{
    report_.heading("The worst limbs");
    report_.paragraph("Those whose wrist or ankle is furthest from its target, each in its worst frame.");
    std::vector<std::vector<Cell>> rows;
    for (const auto& [pose, error] : worst_.limbs())
        rows.push_back(
            {place_of(pose), fmt::format("{:.3e}", error), flag_names(why_.at(pose).flags), why_.at(pose).sentence});
    report_.table({"limb", "limb lengths off", "flags", "why"}, rows);
}

Plot SolveHtml::flags_over_time() const
{
    Plot plot{"Flags over time: the share of limbs in each frame", "frame", "share of limbs", false, false, {}};
    for (std::uint32_t bit = 0; bit < 32; ++bit) {
        Series series{flag_names(1u << bit), {}};
        for (std::size_t frame = 0; frame < frames_.size(); ++frame)
            if (frames_[frame].limb_count > 0)
                series.points.emplace_back(frame, static_cast<double>(frames_[frame].flags[bit]) /
                                                      static_cast<double>(frames_[frame].limb_count));
        if (std::ranges::any_of(series.points, [](const auto& point) { return point.second > 0; }))
            plot.series.push_back(std::move(series));
    }
    return plot;
}

Plot SolveHtml::errors_over_time() const
{
    Plot plot{"Errors over time: from target to wrist or ankle", "frame", "limb lengths", false, true, {}};
    plot.series = {{"reached, worst", {}}, {"reached, rms", {}}, {"not reached, worst", {}}};
    for (std::size_t frame = 0; frame < frames_.size(); ++frame) {
        plot.series[0].points.emplace_back(frame, frames_[frame].reached_worst);
        plot.series[1].points.emplace_back(frame, frames_[frame].reached_rms);
        plot.series[2].points.emplace_back(frame, frames_[frame].missed_worst);
    }
    return plot;
}

void SolveHtml::commit(const Json& run)
{
    put_facts(run);
    put_limbs(run);
    put_missing(run);
    put_errors(run);
    put_flags(run);
    put_worst();
    report_.commit();
}

}  // namespace swivel::tools
