// SPDX-License-Identifier: MIT
//
// `swivel inspect`: prints how good clips are, and what they hold. People read the same words as machines.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/cli/command_error.h"
#include "tools/cli/streams.h"
#include "tools/formats/printable.h"
#include "tools/rig/plain_units.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/inspection.h"
#include "tools/swivel/motion_file.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

using Json = nlohmann::ordered_json;

std::string spaced(std::string key)
{
    std::ranges::replace(key, '_', ' ');
    return key;
}

// A value of such JSON for people: "2.2 cm in frame 27", "94 of 152 frames (62 %), from frame 0".
std::string words_of(const Json& value)
{
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
    if (value.is_string()) return formats::printable(value.get<std::string>(), std::string::npos);
    if (!value.is_structured()) return value.dump();
    if (value.is_array() && value.size() == 3 && value[0].is_number())
        return vector_text({value[0].get<double>(), value[1].get<double>(), value[2].get<double>()});
    if (value.contains("text")) return value["text"].get<std::string>();
    std::string words;
    if (value.contains("cm"))
        words = length_text(value["cm"].get<double>(), {1});
    else if (value.contains("deg"))
        words = fmt::format("{:.3g} degrees", value["deg"].get<double>());
    else if (value.contains("of"))
        words = share_text(value["frames"].get<std::size_t>(), value["of"].get<std::size_t>()) +
                (value["frames"] > 0 ? ", from frame " + value["from_frame"].dump() : "");
    else
        for (const auto& [key, each] : value.items())
            words += (words.empty() ? "" : ", ") + (value.is_array() ? "" : spaced(key) + " ") + words_of(each);
    if (value.contains("frame")) words += " in frame " + value["frame"].dump();
    return words;
}

// One file: the verdict, its reasons, and a line for each thing that the clip holds.
void print_inspection(const Json& json)
{
    say(stdout, "{:<10} {}{}\n", json["verdict"].get<std::string>(), shown_file(json["file"].get<std::string>()),
        json["doubts"].empty() ? ": nothing stands out" : "");
    for (const Json& doubt : json["doubts"])
        say(stdout, "{:<10} {}\n", doubt["verdict"].get<std::string>(), words_of(doubt));
    for (const auto& [key, value] : json.items())
        if (value.is_structured() && key != "doubts") say(stdout, "{:<10} {}\n", spaced(key), words_of(value));
}

// The first doubt, or the first that makes the clip garbage; empty for a good one.
std::string first_doubt(const Json& json)
{
    for (const Json& each : json["doubts"])
        if (each["verdict"] == json["verdict"]) return words_of(each);
    return {};
}

// Many files: a line each.
void print_line(const Json& json)
{
    double skate_cm = 0;
    for (const char* const foot : {"left_foot", "right_foot"})
        if (json.contains(foot)) skate_cm = std::max(skate_cm, json[foot]["skate_a_step"]["cm"].get<double>());
    std::string doubts = json["doubts"].empty() ? "" : ": " + first_doubt(json);
    if (json["doubts"].size() > 1) doubts += fmt::format("; {} more", json["doubts"].size() - 1);
    const bool closes = json.contains("loop") && json["loop"]["closes"].get<bool>();
    say(stdout, "{:<8}{:>7}{:>9}{:>11}  {:<13}{}{}\n", json["verdict"].get<std::string>(),
        words_of(json["clip"].value("seconds", Json("-"))),
        json.contains("root") ? words_of(json["root"]["goes"]) : "-", skate_cm > 0 ? length_text(skate_cm, {1}) : "-",
        closes ? fmt::format("{} to {}", json["loop"]["first_frame"].dump(), json["loop"]["last_frame"].dump()) : "-",
        shown_file(json["file"].get<std::string>()), doubts);
}

Json inspected(const InspectOptions& options, const std::string& name)
{
    const LimbChoice choice = choice_of(options.clip);
    MotionFile file(name, options.clip.motion);
    const FigureJoints figure = choose_joints(file.clip(), name, choice);
    file.sample(joints_of(figure));
    file.fix_rest_pose(known_limbs(figure));
    return inspection_of(name, file, figure, bind_limbs(file.clip(), figure, choice));
}

}  // namespace

void run_inspect(const InspectOptions& options)
{
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const bool is_one = options.files.size() == 1, prints = !options.json && !options.quiet;
    if (prints && !is_one)
        say(stdout, "{:<8}{:>7}{:>9}{:>11}  {:<13}{}\n", "", "seconds", "goes", "skate/step", "loop", "file");
    Json clips = Json::array();
    std::size_t bad = 0;
    std::string cause;
    const auto run_one = [&](const std::string& name) {
        const Json json = inspected(options, name);
        if (prints) is_one ? print_inspection(json) : print_line(json);
        if (options.json) clips.push_back(json);
        if (json["verdict"] != "garbage") return;
        ++bad;
        if (is_one) cause = fmt::format("{}: garbage: {}", name, first_doubt(json));
    };
    if (is_one)
        run_one(options.files.front());
    else
        for (const std::string& name : options.files)
            if (run_to_end([&] { run_one(name); }) != 0) ++bad;
    if (options.json) print_json({{"clips", clips}});
    if (bad > 0)
        throw CommandError(
            1, is_one ? cause : fmt::format("{} of {} clips failed or are garbage", bad, options.files.size()));
}

}  // namespace swivel::tools
