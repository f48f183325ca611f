// SPDX-License-Identifier: MIT
#include "tools/swivel/solve_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "swivel/swivel.h"
#include "tools/swivel/report.h"
#include "tools/swivel/solve_words.h"

namespace swivel::tools {

namespace {

using Json = nlohmann::ordered_json;

// Numbers with that between them. Components of a direction are so near to 0 that they are rounding, or they are not.
std::string joined(const Json& numbers, const char* between)
{
    std::string text;
    for (const double x : numbers.get<std::vector<double>>())
        text += fmt::format("{}{:.4g}", text.empty() ? "" : between, std::fabs(x) < 5e-5 ? 0 : x);
    return text;
}

// A distance or an angle of a limb; NaN: bad input.
std::string error_text(double error) { return std::isnan(error) ? kNoNumber : fmt::format("{:.3e}", error); }

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

// A table for each kind. Its first columns are what --json calls side and joints.
void SolveHtml::put_limbs(const Json& run)
{
    report_.heading("Limbs");
    for (const char* kind : {"arms_bound", "legs_bound"}) {
        if (!run.contains(kind)) continue;
        std::vector<std::string> heads;
        for (const auto& [key, value] : run.at(kind).at(0).items())
            if (heads.size() < 4) heads.push_back(key);
        const std::vector<std::string> joints = heads;
        heads.insert(heads.end(), {"lengths", "bends towards", "which is from"});
        std::vector<std::vector<Cell>> rows;
        for (const Json& limb : run.at(kind)) {
            std::vector<Cell>& row = rows.emplace_back();
            for (const std::string& key : joints) row.push_back(text_of(limb.at(key)));
            row.push_back(joined(limb.at("lengths"), " + "));
            row.push_back(joined(limb.at("bend"), ", "));
            row.push_back(text_of(limb.at("bend_source")));
        }
        report_.table(heads, rows);
        for (const Json& limb : run.at(kind)) put_notes(limb, std::string_view(kind) == "arms_bound" ? "arm" : "leg");
    }
}

void SolveHtml::put_notes(const Json& limb, const char* kind)
{
    const std::string name = fmt::format("The {} {}", text_of(limb.at("side")), kind);
    for (const Json& note : limb.at("notes")) report_.paragraph(fmt::format("{}: {}.", name, text_of(note)));
    if (const auto share = limb.at("unevenness").get<double>(); share > 0)
        report_.paragraph(
            fmt::format("{}: uneven scales put its end off by at most {:.4g} of its length.", name, share));
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
            rows.push_back({text_of(stat.at("what")), error_text(stat.at("worst").get<double>()),
                            error_text(stat.at("rms").get<double>()), text_of(stat.at("unit")),
                            count_of(stat.at("count")), place_of(pose_of(stat.at("worst_pose")))});
    }
    report_.table({"from where to where", "worst", "root mean square", "unit", "limbs", "worst in"}, rows);
    report_.plot(errors_over_time());
}

void SolveHtml::put_flags(const Json& run)
{
    report_.heading("Flags");
    std::vector<std::vector<Cell>> rows;
    for (const auto& [name, count] : run.at("flags").items())
        if (count.get<std::uint64_t>() > 0)
            rows.push_back({name, count_of(count), place_of(pose_of(run.at("first_flagged").at(name)))});
    report_.table({"flag", "limbs", "first in"}, rows);
    report_.plot(flags_over_time());
}

void SolveHtml::put_worst()
{
    report_.heading("The worst limbs");
    report_.paragraph(
        "Those whose wrist or ankle is furthest from its target, each in its worst frame. Limbs with bad input come "
        "first. Sentences give distances in the clip's unit, unless they say otherwise, and from targets as the solver "
        "has them, rounded to single precision.");
    std::vector<std::vector<Cell>> rows;
    for (const auto& [pose, error] : worst_.limbs())
        rows.push_back({place_of(pose), error_text(error), flag_names(why_.at(pose).flags), why_.at(pose).sentence});
    report_.table({"limb", "limb lengths off", "flags", "why"}, rows);
}

Plot SolveHtml::flags_over_time() const
{
    Plot plot{"Flags over time: the share of limbs in each frame, without the flag of those that reached their targets",
              "frame",
              "share of limbs",
              false,
              false,
              {}};
    for (std::uint32_t bit = 0; bit < 32; ++bit) {
        if (1u << bit == SWIVEL_REACHED) continue;  // most limbs: beside it all others would lie on 0
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
    Plot plot{"Errors over time: from target to wrist or ankle",
              "frame",
              "distance from target, in limb lengths",
              false,
              true,
              {}};
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
    report_.paragraph(result_of(run));
    report_.table({"what", "value"}, facts_of(run));
    for (const Json& note : run.value("notes", Json::array())) report_.paragraph(text_of(note) + ".");
    put_limbs(run);
    put_missing(run);
    put_errors(run);
    put_flags(run);
    put_worst();
    report_.commit();
}

}  // namespace swivel::tools
