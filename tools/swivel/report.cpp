// SPDX-License-Identifier: MIT
#include "tools/swivel/report.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <bit>
#include <cctype>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "swivel/swivel.h"
#include "tools/cli/command_error.h"
#include "tools/cli/streams.h"
#include "tools/crowd/characters.h"
#include "tools/crowd/heading.h"
#include "tools/crowd/parallel.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"

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
Json json_of(const PoseName& pose)
{
    return {{"frame", pose.frame}, {"character", pose.character}, {"limb", limb_word(pose.limb)}};
}

// The solved limbs' kind, in one word.
std::string limbs_solved(const Statistics& statistics)
{
    if (statistics.legs.limb_count == 0) return "arms";
    return statistics.arms.limb_count == 0 ? "legs" : "limbs";
}

double limbs_per_second(const Statistics& statistics)
{
    return statistics.solve_seconds > 0 ? static_cast<double>(statistics.limb_count()) / statistics.solve_seconds : 0;
}

// The meaning of a distance: the solver's error, a miss of a target out of reach, or a difference from the clip.
struct Meaning {
    const char *line, *key;  // in a report, in JSON
};
constexpr Meaning kError{"error", "errors"}, kMissed{"missed", "missed"}, kDiffers{"differs", "differences_from_clip"};

// A measured distance, with its name and unit.
struct Distance {
    Meaning meaning;
    std::string key, text, unit;
    const ErrorStat& stat;

    bool is_angle() const { return unit == "rad"; }
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

// "under 0.01 cm", or "2.6 cm rms, 4.4 cm at most in frame 62, character 5498, left_arm"
std::string text_of(const ErrorStat& stat, bool is_angle, const LengthUnit& unit)
{
    const std::string max = is_angle ? angle_text(stat.max) : error_text(stat.max_length(), unit),
                      rms = is_angle ? angle_text(stat.rms()) : error_text(stat.rms_length(), unit);
    if (max == rms && max.starts_with("under")) return max;
    return fmt::format("{} rms, {} at most in {}", rms, max, text_of(stat.worst_pose));
}

// One line for all limbs: how far elbows and knees are from the clip's.
void print_differences(std::FILE* to, const Statistics& statistics, const LengthUnit& unit)
{
    ErrorStat all;
    for (const LimbStatistics* limbs : {&statistics.arms, &statistics.legs})
        for (const ErrorStat* each : {&limbs->given, &limbs->bent, &limbs->straight}) all.add(*each);
    if (all.count == 0) return;
    const bool arms = statistics.arms.limb_count > 0, legs = statistics.legs.limb_count > 0;
    say(to, "differs  {} from the clip's: {}\n",
        !legs  ? "elbows"
        : arms ? "elbows and knees"
               : "knees",
        text_of(all, false, unit));
}

// Says what is wrong with the limbs of a run that went_wrong(), and what to check.
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

// Notes for the user on a crowd without motion, a line each; mostly none.
std::vector<std::string> rest_notes(const SolveOptions& options, const MotionFile& file, const CrowdJob& job)
{
    if (file.has_motion() || job.plan.characters <= 1) return {};
    return {
        fmt::format("{0} has no motion: all {1} characters stand in its rest pose, but for limbs with "
                    "targets; swivel retarget puts a motion on it",
                    shown_file(options.file), job.plan.characters)};
}

std::string number_of_clip(const CrowdJob& job, std::size_t n)
{
    return job.loops.size() > 1 ? fmt::format(" {}", n + 1) : "";
}

// The same for loops.
std::vector<std::string> loop_notes(const CrowdJob& job)
{
    std::vector<std::string> notes;
    for (std::size_t n = 0; n < job.loops.size(); ++n)
        if (job.loops[n].gap > kWideGap)
            notes.push_back(
                fmt::format("the clip{} never comes back to a pose while it moves: at the loop's seam its joints are "
                            "{:.0f} degrees apart, and this shows; {}take a clip that repeats itself",
                            number_of_clip(job, n), job.loops[n].gap * 180 / std::numbers::pi,
                            job.further.empty() ? "name [first, last], or " : ""));
    return notes;
}

// A note if characters leave the picture of heights, beyond which the ground is level; else none.
std::vector<std::string> ground_notes(const formats::Clip& clip, const CrowdJob& job)
{
    if (job.heights.empty()) return {};
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    std::vector<Eigen::AlignedBox2d> ways(clip.frame_count);  // [the first frame of a clip]
    std::vector<ClipPart> parts = job.plan.clips;
    if (parts.empty()) parts = {{0, clip.frame_count}};
    for (const ClipPart& part : parts)
        for (std::size_t frame = part.first; frame < part.first + part.count; ++frame) {
            formats::world_pose(clip, frame, pose_w);
            const Eigen::Vector3d& at = pose_w[static_cast<std::size_t>(job.limbs[0].upper())].position;
            ways[part.first].extend(Eigen::Vector2d(at.x(), at.z()));
        }
    const goal_ground& grid = job.plan.ground->grid;
    const Eigen::Vector2d middle(grid.place[0], grid.place[2]), half(grid.size[0] / 2, grid.size[2] / 2);
    const Eigen::AlignedBox2d picture(middle - half, middle + half);
    const std::vector<goal_character> characters = characters_of(job.plan, job.limbs, clip.frame_count);
    const auto leaves = [&](const goal_character& who) {
        const Eigen::AlignedBox2d& way = ways[who.first];
        for (const auto corner : {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                                  Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
            Eigen::Vector2d at = who.size * way.corner(corner);
            turn_with(who, at.x(), at.y());
            if (!picture.contains(Eigen::Vector2d(who.place[0], who.place[2]) + at)) return true;
        }
        return false;
    };
    const auto first = std::ranges::find_if(characters, leaves);
    if (first == characters.end()) return {};
    return {fmt::format(
        "{} of {} characters walk beside the picture, which lies from {:.4g} to {:.4g} along x and from {:.4g} to "
        "{:.4g} along z, and where the ground goes on level: character {} is the first. Give a larger picture, or a "
        "smaller crowd.spacing",
        std::ranges::count_if(characters, leaves), characters.size(), picture.min().x(), picture.max().x(),
        picture.min().y(), picture.max().y(), first - characters.begin())};
}

// The limbs that are bound, with their notes, and those that are not.
void print_limbs(std::FILE* to, const formats::Clip& clip, const CrowdJob& job)
{
    const auto shown = [&](int joint) { return printable_name(joint_at(clip, joint)); };
    for (const Limb& limb : job.limbs)
        say(to, "{:<8} {:<5} {} > {} > {}, {:.4g} + {:.4g} long, limb.{}.bend = {}: {}\n", kind_name(limb.name.kind),
            side_name(limb.name.side), shown(limb.upper()), shown(limb.lower()), shown(limb.end()),
            limb.bound.lengths[0], limb.bound.lengths[1], limb_word(limb.name), toml_row(limb.bend), limb.bend_source);
    for (const Limb& limb : job.limbs)
        for (const std::string& note : limb.notes) say(to, "note     {}: {}\n", plain_name(limb.name), note);
    print_missing(to, job.missing);
}

// The clips after the first one, and the frames between which clips loop.
void print_further_clips(std::FILE* to, const formats::Clip& clip, const CrowdJob& job)
{
    for (const FurtherMotion& each : job.further) say(to, "clip     {}\n", each.words);
    for (std::size_t n = 0; n < job.loops.size(); ++n) {
        const FoundLoop& found = job.loops[n];
        say(to, "loop     frames {} to {} of the clip{}, {:.2f} s{}\n", found.loop.first, found.loop.last,
            number_of_clip(job, n), static_cast<double>(found.loop.length()) * clip.frame_time,
            found.gap > 0 ? fmt::format("; a joint's pose and motion differ by {:.1f} degrees",
                                        found.gap * 180 / std::numbers::pi)
                          : "");
    }
    for (const std::string& note : loop_notes(job)) say(to, "note     {}\n", note);
}

void print_ground(std::FILE* to, const formats::Clip& clip, const CrowdJob& job)
{
    if (const auto& ground = job.plan.ground)
        say(to, "ground   {}; feet stand{}, bodies hang lower by {:.3g}\n",
            job.heights.empty()
                ? "level"
                : fmt::format("{}, {} x {} pixels", shown_file(job.heights), ground->grid.columns, ground->grid.rows),
            job.contacts.empty() ? "" : " when " + shown_file(job.contacts) + " says", -job.plan.shift_wish);
    for (const std::string& note : ground_notes(clip, job)) say(to, "note     {}\n", note);
}

// The proportions of figures, where they differ.
void print_builds(std::FILE* to, const CrowdJob& job)
{
    if (job.builds.size() <= 1) return;
    const auto factors = [&](double Proportions::*part) {
        const auto [min, max] = std::ranges::minmax(job.builds, {}, part);
        return fmt::format("{:.3g} to {:.3g}", min.*part, max.*part);
    };
    say(to, "builds   {}: legs {}, arms {}, spine {}, speed {} times the clip's own\n", job.builds.size(),
        factors(&Proportions::legs), factors(&Proportions::arms), factors(&Proportions::spine),
        factors(&Proportions::speed));
}

// The hands that hold another hand or a box.
void print_hands(std::FILE* to, const formats::Clip& clip, const CrowdJob& job)
{
    for (std::size_t n = 0; n < job.limbs.size(); ++n)
        if (const auto holds = job.plan.limbs[n].goals.holds)
            say(to, "hold     the {} keeps its hand to that of the {}, as in the clip\n", plain_name(job.limbs[n].name),
                plain_name(job.limbs[holds - 1].name));
    if (const auto& carry = job.plan.carry)
        say(to, "carry    {} of {} characters have a box in both hands, {:.3g} x {:.3g} x {:.3g}\n",
            std::ranges::count(characters_of(job.plan, job.limbs, clip.frame_count), 1u, &goal_character::carries),
            job.plan.characters, carry->size.x(), carry->size.y(), carry->size.z());
}

void print_crowd(std::FILE* to, const SolveOptions& options, const CrowdJob& job)
{
    const std::uint32_t characters = job.plan.characters;
    std::string counts;
    for (const LimbKind kind : {LimbKind::arm, LimbKind::leg}) {
        const auto is_of_kind = [&](const Limb& limb) { return limb.name.kind == kind; };
        const auto count = static_cast<std::size_t>(std::ranges::count_if(job.limbs, is_of_kind));
        if (count > 0) counts += ", " + counted(count * characters, kind_name(kind));
    }
    say(to, "crowd    {}{}, targets from {}{}{}\n", counted(characters, "character"), counts,
        job.targets == "clip" ? "the clip" : shown_file(job.targets),
        job.agents.empty() ? "" : fmt::format(", agents from {}", shown_file(job.agents)),
        options.crowd.empty() ? "" : fmt::format(", all else from {}", shown_file(options.crowd)));
}

// A run's verdict, and what is doubted.
struct Verdict {
    const char* word;
    std::string text;
};
Verdict verdict_of(const Statistics& statistics)
{
    if (went_wrong(statistics)) return {verdict_word(true, true), what_went_wrong(statistics)};
    const std::string limbs = limbs_solved(statistics);
    constexpr std::size_t infeasible = std::countr_zero(std::uint32_t{SWIVEL_INFEASIBLE});
    const std::pair<std::uint64_t, const char*> doubts[] = {
        {statistics.unreached(), "are out of reach"},
        {statistics.bad(), "have bad input"},
        {statistics.flagged(infeasible), "cannot keep all their limits"}};
    std::string text;
    for (const auto& [count, words] : doubts)
        if (count > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", share_text(count, statistics.limb_count(), limbs),
                                words);
    return {verdict_word(!text.empty(), false), text};
}

}  // namespace

void print_statistics(std::FILE* to, const Statistics& statistics, const LengthUnit& unit)
{
    const std::string limbs = limbs_solved(statistics);
    const Verdict verdict = verdict_of(statistics);
    say(to, "verdict  {}{}{}\n", verdict.word, verdict.text.empty() ? "" : ": ", verdict.text);
    say(to, "solved   {} {}, {:.1f} million {}/s ({}, {})\n", statistics.limb_count(), limbs,
        limbs_per_second(statistics) / 1e6, limbs, swivel_isa_name(), counted(thread_count(), "thread"));
    for (const Distance& d : distances_of(statistics))
        if (d.meaning.line != kDiffers.line)
            say(to, "{:<8} {}: {}\n", d.meaning.line, d.text, text_of(d.stat, d.is_angle(), unit));
    print_differences(to, statistics, unit);
    for (const auto& [name, stat] : flags_of(statistics))
        if (stat.count > 0)
            say(to, "flag     {}: {}, first in {}\n", name, share_text(stat.count, statistics.limb_count(), limbs),
                text_of(stat.first_pose));
    if (const LookStatistics& looks = statistics.looks; looks.count > 0)
        say(to,
            "looks    {} of {} meet their target, {} turn no further, {} have it behind them or too near, {} are on "
            "their way\n",
            looks.met, looks.count, looks.limited, looks.faded, looks.on_their_way());
}

void require_went_well(const Statistics& statistics, const std::string& file)
{
    if (went_wrong(statistics))
        throw CommandError(1, fmt::format("{}: most {} are not where they should be: {}", shown_file(file),
                                          limbs_solved(statistics), what_went_wrong(statistics)));
}

Json json_of(const Statistics& statistics)
{
    Json out;
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
    const Verdict verdict = verdict_of(statistics);
    out["verdict"] = verdict.word;
    if (!verdict.text.empty()) out["doubts"] = {verdict.text};
    return out;
}

Json frame_time_of(const formats::Clip& clip) { return clip.frame_time > 0 ? Json(clip.frame_time) : Json(); }

std::string json_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }
void print_json(const Json& json, std::FILE* to) { say(to, "{}", json_text(json)); }

Json names_json(const formats::Clip& clip, std::span<const int> joints)
{
    Json names = Json::array();
    for (const int joint : joints) names.push_back(joint_at(clip, joint).name);
    return names;
}

const char* verdict_word(bool has_doubts, bool is_garbage)
{
    return is_garbage ? "garbage" : has_doubts ? "look" : "good";
}

std::string counted(std::uint64_t count, std::string_view what)
{
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string shown_file(const std::string& name) { return formats::printable(name, std::string::npos); }

void print_motion_file(std::FILE* to, const std::string& name, const MotionFile& file, std::size_t frame_count)
{
    const formats::Clip& clip = file.clip();
    say(to, "clip     {}: {}, {} joints, {}, {}\n", shown_file(name), file.describe(), clip.joints.size(),
        counted(frame_count, "frame"),
        clip.frame_time > 0 ? fmt::format("{:.1f} frames/s", 1 / clip.frame_time) : "at the times of its keys");
    for (const std::string& note : file.notes()) say(to, "note     {}\n", note);
}

void print_missing(std::FILE* to, const std::vector<LimbFinding>& missing)
{
    for (const LimbFinding& finding : missing)
        say(to, "{:<8} {:<5} {}: {}\n", kind_name(finding.name.kind), side_name(finding.name.side),
            finding.has_joints ? "refused" : "missing", problem_text(finding));
}
void add_missing(Json& json, const std::vector<LimbFinding>& missing)
{
    for (const LimbFinding& finding : missing)
        json["missing"].push_back({{"limb", limb_word(finding.name)}, {"problem", problem_text(finding)}});
}

void print_written(std::FILE* to, std::initializer_list<std::string> outputs, std::size_t width)
{
    for (const std::string& name : outputs)
        if (!name.empty())
            say(to, "{:<{}}{}\n", "written", width,
                formats::is_standard_stream(name) ? "to standard output" : shown_file(name));
}

void print_clip(std::FILE* to, const SolveOptions& options, const MotionFile& file, const CrowdJob& job)
{
    const formats::Clip& clip = file.clip();
    print_motion_file(to, options.file, file, job.frame_count);
    for (const std::string& note : rest_notes(options, file, job)) say(to, "note     {}\n", note);
    print_limbs(to, clip, job);
    print_further_clips(to, clip, job);
    if (const std::size_t count = job.given->left_out(); count > 0)
        say(to, "note     {}: {} row{} left out, of limbs that are not solved\n", shown_file(job.targets), count,
            count == 1 ? " is" : "s are");
    print_ground(to, clip, job);
    print_builds(to, job);
    print_hands(to, clip, job);
    print_crowd(to, options, job);
}

Json json_of_clip(const SolveOptions& options, const MotionFile& file, const CrowdJob& job)
{
    const formats::Clip& clip = file.clip();
    Json out{{"clip", options.file},
             {"motion", file.describe()},
             {"joints", clip.joints.size()},
             {"frames", job.frame_count},
             {"frame_time", frame_time_of(clip)},
             {"characters", job.plan.characters},
             {"seed", job.plan.seed},
             {"targets", job.targets}};
    if (!options.crowd.empty()) out["crowd"] = options.crowd;
    if (!job.agents.empty()) out["agents"] = job.agents;
    if (const auto& carry = job.plan.carry) out["carry"] = {{"share", carry->share}, {"size", carry->size}};
    if (job.plan.ground) out["ground"] = job.heights.empty() ? "level" : job.heights;
    if (!job.contacts.empty()) out["contacts"] = job.contacts;
    for (std::size_t n = 0; n < job.plan.clips.size(); ++n) {
        const ClipPart& part = job.plan.clips[n];
        Json& performed = out["performed"].emplace_back();
        const std::size_t which = n % (1 + job.further.size());
        const Proportions& build = job.builds[n / (1 + job.further.size())];
        performed = {{"motion", which == 0 ? file.describe() : job.further[which - 1].words},
                     {"first", part.first},
                     {"frames", part.count}};
        if (!job.loops.empty()) performed["loop"] = {job.loops[which].loop.first, job.loops[which].loop.last};
        if (job.builds.size() > 1)
            performed.update(
                {{"legs", build.legs}, {"arms", build.arms}, {"spine", build.spine}, {"speed", part.pace}});
    }
    if (!job.loops.empty()) out["loop"] = {job.loops[0].loop.first, job.loops[0].loop.last};
    std::vector<std::string> notes = file.notes();
    std::ranges::move(rest_notes(options, file, job), std::back_inserter(notes));
    std::ranges::move(loop_notes(job), std::back_inserter(notes));
    if (!notes.empty()) out["notes"] = notes;
    for (std::size_t n = 0; n < job.limbs.size(); ++n) {
        const Limb& limb = job.limbs[n];
        const LimbWords& words = words_of(limb.name.kind);
        Json& bound = out[fmt::format("{}_bound", words.limbs)].emplace_back();
        bound = {{"side", side_name(limb.name.side)},
                 {words.upper_joint, joint_at(clip, limb.upper()).name},
                 {words.lower_joint, joint_at(clip, limb.lower()).name},
                 {words.end_joint, joint_at(clip, limb.end()).name},
                 {"lengths", limb.bound.lengths},
                 {"bend", limb.bend},
                 {"bend_source", limb.bend_source},
                 {"unevenness", limb.unevenness},
                 {"notes", limb.notes}};
        if (const auto holds = job.plan.limbs[n].goals.holds) bound["holds"] = limb_word(job.limbs[holds - 1].name);
    }
    add_missing(out, job.missing);
    return out;
}

}  // namespace swivel::tools
