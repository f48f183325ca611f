// SPDX-License-Identifier: MIT
#include "tools/swivel/feet_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/cli/streams.h"
#include "tools/formats/text.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/report.h"
#include "tools/swivel/solve_report.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;

// What is measured before and after, as people and as machines read it.
struct Measure {
    const char* words;
    const char* unit;
    const char* key;
    double Skating::*value;
};
constexpr Measure kMeasures[] = {
    {"toe speed in contact, mean", "leg lengths/s", "contact_speed_mean", &Skating::mean_speed},
    {"toe speed in contact, most", "leg lengths/s", "contact_speed_most", &Skating::most_speed},
    {"skate a step", "leg lengths", "skate_a_step", &Skating::step},
    {"drift in a contact, most", "leg lengths", "drift_most", &Skating::drift},
    {"off the ground in contact, most", "leg lengths", "off_ground_most", &Skating::off_ground},
    {"a toe's tip in the ground, most", "leg lengths", "tip_depth_most", &Skating::tip_depth},
    {"a knee's turn in a frame, most", "degrees", "knee_degrees_a_frame_most", &Skating::knee_deg},
    {"a toe's jump in velocity, most", "leg lengths/s", "velocity_jump_most", &Skating::jump},
    {"the body's jump in velocity, most", "leg lengths/s", "body_velocity_jump_most", &Skating::body_jump},
};

// How far the body moved, in leg lengths: at most, and downwards.
struct BodyMove {
    double most = 0, down = 0;

    explicit BodyMove(const FeetRun& run)
    {
        for (const Vector3d& shift_w : run.placed.shift_w) {
            most = std::max(most, shift_w.norm() / run.motion.leg_length());
            down = std::max(down, -shift_w.dot(run.motion.up_w) / run.motion.leg_length());
        }
    }
};

std::string doubt_text(const FeetRun& run, const FeetDoubt& doubt)
{
    const std::string who = doubt.leg < run.legs.size() ? plain_name(run.legs[doubt.leg].name) : "the body";
    if (doubt.kind == FeetDoubt::off_ground)
        return fmt::format("{}, frames {} to {}: its toe is up to {:.3g} off the ground, near {}{}", who, doubt.first,
                           doubt.last, doubt.value * run.motion.leg_length(), vector_text(doubt.place_w),
                           run.floor.hills ? "; it cannot follow there" : "");
    const bool is_knee = doubt.kind == FeetDoubt::knee;
    return fmt::format("{}, frame {}: {} by {:.3g} {}, in the clip by {:.3g} at most; near {}", who, doubt.first,
                       is_knee                             ? "its knee turns"
                       : doubt.kind == FeetDoubt::toe_jump ? "its toe's velocity jumps"
                                                           : "its velocity jumps",
                       doubt.value, is_knee ? "degrees" : "leg lengths/s", doubt.before, vector_text(doubt.place_w));
}
nlohmann::ordered_json doubt_json(const FeetRun& run, const FeetDoubt& doubt)
{
    constexpr const char* kKeys[] = {"off_ground_most", "knee_degrees_a_frame_most", "velocity_jump_most",
                                     "body_velocity_jump_most"};
    const Vector3d& place_w = doubt.place_w;
    nlohmann::ordered_json out = {{"measure", kKeys[doubt.kind]},
                                  {"first_frame", doubt.first},
                                  {"last_frame", doubt.last},
                                  {"value", doubt.value},
                                  {"near", {place_w.x(), place_w.y(), place_w.z()}},
                                  {"text", doubt_text(run, doubt)}};
    if (doubt.leg < run.legs.size()) out["limb"] = limb_word(run.legs[doubt.leg].name);
    return out;
}

double share_on(const std::vector<bool>& contact)
{
    return static_cast<double>(std::ranges::count(contact, true)) / static_cast<double>(contact.size());
}

}  // namespace

void print_feet(const FeetRun& run, std::FILE* to)
{
    const formats::Clip& clip = run.motion_file->clip();
    say(to, "clip     {}: {}, {} joints, {} frames, {:.1f} frames/s\n", shown_file(run.file),
        run.motion_file->describe(), clip.joints.size(), clip.frame_count, 1 / clip.frame_time);
    for (const std::string& note : run.motion_file->notes()) say(to, "note     {}\n", note);
    const auto shown = [&](int joint) { return printable_name(joint_at(clip, joint)); };
    for (std::size_t n = 0; n < run.legs.size(); ++n) {
        const Limb& leg = run.legs[n];
        const LegPath& path = run.motion.legs[n];
        say(to, "leg      {:<5} {} > {} > {}, {:.4g} long; {}; in contact {} time{}, {:.0f} % of the frames\n",
            side_name(leg.name.side), shown(leg.upper()), shown(leg.lower()), shown(leg.end()), path.length,
            path.has_toe ? shown(path.toe) + " stands" : "without a toe joint its ankle stands",
            contacts_of(run.contacts[n]).size(), contacts_of(run.contacts[n]).size() == 1 ? "" : "s",
            100 * share_on(run.contacts[n]));
    }
    for (const LimbFinding& finding : run.missing)
        say(to, "leg      {:<5} {}: {}\n", side_name(finding.name.side), finding.has_joints ? "refused" : "missing",
            problem_text(finding));
    if (run.contacts_from.empty())
        say(to,
            "contact  slower than {:g} leg lengths a second and lower than {:g} over its floor, in most frames of a "
            "twelfth of a second\n",
            run.bars.speed, run.bars.height);
    else
        say(to, "contact  as {} says\n", shown_file(run.contacts_from));
    if (run.floor.hills)
        say(to, "ground   {}, {} x {} pixels; the clip's own floor is level, its feet stand at {:.4g}\n",
            shown_file(run.ground), run.floor.hills->grid.columns, run.floor.hills->grid.rows, run.floor.level);
    else
        say(to, "ground   level, feet stand at {:.4g}\n", run.floor.level);
    say(to, "body     moved by {}\n", shown(run.motion.carrier));
    say(to, "{:<35}{:>9}{:>10}\n", "", "before", "after");
    for (const Measure& each : kMeasures)
        say(to, "{:<35}{:>9.4f}{:>10.4f}  {}\n", each.words, run.before.*each.value, run.after.*each.value, each.unit);
    const BodyMove body(run);
    say(to, "{:<35}{:>9}{:>10.4f}  leg lengths, {:.4f} down\n", "the body is moved by, most", "", body.most, body.down);
    for (const std::string& doubt : run.clip_doubts) say(to, "look     FILE: {}\n", doubt);
    for (const FeetDoubt& doubt : run.doubts) say(to, "look     {}\n", doubt_text(run, doubt));
    for (const std::string& name : {run.out, run.export_contacts})
        if (!name.empty())
            say(to, "written  {}\n", formats::is_standard_stream(name) ? "to standard output" : shown_file(name));
}

nlohmann::ordered_json json_of(const FeetRun& run)
{
    const formats::Clip& clip = run.motion_file->clip();
    const auto name = [&](int joint) { return joint_at(clip, joint).name; };
    nlohmann::ordered_json out = {{"file", run.file},
                                  {"format", run.motion_file->describe()},
                                  {"frames", clip.frame_count},
                                  {"frame_time", frame_time_of(clip)}};
    if (const auto notes = run.motion_file->notes(); !notes.empty()) out["notes"] = notes;
    for (std::size_t n = 0; n < run.legs.size(); ++n) {
        const Limb& leg = run.legs[n];
        const LegPath& path = run.motion.legs[n];
        out["legs"].push_back({{"limb", limb_word(leg.name)},
                               {"joints", {name(leg.upper()), name(leg.lower()), name(leg.end())}},
                               {"stands_on", name(path.toe)},
                               {"has_toe", path.has_toe},
                               {"length", path.length},
                               {"contacts", contacts_of(run.contacts[n]).size()},
                               {"share_in_contact", share_on(run.contacts[n])}});
    }
    for (const LimbFinding& finding : run.missing)
        out["missing"].push_back({{"limb", limb_word(finding.name)}, {"problem", problem_text(finding)}});
    if (run.contacts_from.empty())
        out["bars"] = {{"speed", run.bars.speed}, {"height", run.bars.height}};
    else
        out["contacts"] = run.contacts_from;
    if (run.floor.hills) out["ground"] = run.ground;
    out["floor"] = run.floor.level;
    out["body"] = name(run.motion.carrier);
    for (const Measure& each : kMeasures) {
        out["before"][each.key] = run.before.*each.value;
        out["after"][each.key] = run.after.*each.value;
    }
    const BodyMove body(run);
    out["after"]["body_moved_most"] = body.most;
    out["after"]["body_moved_down_most"] = body.down;
    for (const FeetDoubt& doubt : run.doubts) out["look"].push_back(doubt_json(run, doubt));
    if (!run.clip_doubts.empty()) out["doubts"] = run.clip_doubts;
    if (!run.out.empty()) out["out"] = run.out;
    if (!run.export_contacts.empty()) out["export_contacts"] = run.export_contacts;
    return out;
}

}  // namespace swivel::tools
