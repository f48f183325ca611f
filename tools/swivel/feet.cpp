// SPDX-License-Identifier: MIT
//
// `swivel feet`: finds when clips' feet are on the ground, makes them stand, reports, and writes the clips.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/command_error.h"
#include "tools/cli/streams.h"
#include "tools/feet/judge_feet.h"
#include "tools/feet/turn_legs.h"
#include "tools/formats/error.h"
#include "tools/formats/height_picture.h"
#include "tools/formats/text.h"
#include "tools/rig/clip_doubts.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/report.h"
#include "tools/swivel/root_motion.h"
#include "tools/swivel/run_files.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;

// One clip: its legs, when they are in contact, and how its feet skate before and after.
struct FeetRun {
    std::string name, out;  // its files, as the user wrote them; out may be empty
    MotionFile file;
    ContactBars bars;
    std::vector<Limb> legs{};
    std::vector<LimbFinding> missing{};
    std::vector<BodyPart> body{};
    LegMotion motion{};
    Contacts contacts{};
    Floor floor{};
    PlacedFeet placed{};
    double body_moved = 0, body_lowered = 0;  // at most, in leg lengths
    Skating before{}, after{};
    std::vector<FeetDoubt> doubts{};
    std::vector<ClipDoubt> clip_doubts{};  // of FILE itself
    std::vector<std::string> garbage{};    // of the clip with its new legs
    std::optional<Vector3d> travel_w{};    // by which --travel moves the root, a second
};

// A number that is measured before and after, as people and as machines read it.
struct Measure {
    const char* words;
    const char* unit;
    const char* key;
    double Skating::*value;
};
constexpr Measure kMeasures[] = {
    {"toe speed in contact, mean", "leg lengths/s", "contact_speed_mean", &Skating::mean_speed},
    {"toe speed in contact, most", "leg lengths/s", "contact_speed_max", &Skating::max_speed},
    {"skate a step", "leg lengths", "skate_a_step", &Skating::step},
    {"drift in a contact, most", "leg lengths", "drift_max", &Skating::drift},
    {"off the ground in contact, most", "leg lengths", "off_ground_max", &Skating::off_ground},
    {"a toe's tip in the ground, most", "leg lengths", "tip_depth_max", &Skating::tip_depth},
    {"a knee's turn in a frame, most", "degrees", "knee_degrees_a_frame_max", &Skating::knee_deg},
    {"a toe's jump in velocity, most", "leg lengths/s", "velocity_jump_max", &Skating::jump},
    {"the body's jump in velocity, most", "leg lengths/s", "body_velocity_jump_max", &Skating::body_jump},
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
Json doubt_json(const FeetRun& run, const FeetDoubt& doubt)
{
    constexpr const char* kKeys[] = {"off_ground_max", "knee_degrees_a_frame_max", "velocity_jump_max",
                                     "body_velocity_jump_max"};
    Json out = {{"measure", kKeys[doubt.kind]}, {"first_frame", doubt.first}, {"last_frame", doubt.last},
                {"value", doubt.value},         {"near", doubt.place_w},      {"text", doubt_text(run, doubt)}};
    if (doubt.leg < run.legs.size()) out["limb"] = limb_word(run.legs[doubt.leg].name);
    return out;
}

// What stands out. Garbage of FILE is told as that of the clip with its new legs, unless that has none.
std::vector<std::string> look_texts(const FeetRun& run)
{
    std::vector<std::string> texts;
    for (const ClipDoubt& doubt : run.clip_doubts)
        if (!doubt.is_garbage || run.garbage.empty()) texts.push_back("FILE: " + doubt.text);
    for (const FeetDoubt& doubt : run.doubts) texts.push_back(doubt_text(run, doubt));
    return texts;
}

double share_on(const std::vector<bool>& contact)
{
    return static_cast<double>(std::ranges::count(contact, true)) / static_cast<double>(contact.size());
}

// Whether the clip with its new legs is garbage, and so nothing is written.
bool is_refused(const FeetOptions& options, const FeetRun& run) { return !options.force && !run.garbage.empty(); }

void print_feet(std::FILE* reports, const FeetOptions& options, const FeetRun& run)
{
    const formats::Clip& clip = run.file.clip();
    print_motion_file(reports, run.name, run.file, clip.frame_count);
    const auto shown = [&](int joint) { return printable_name(joint_at(clip, joint)); };
    for (std::size_t n = 0; n < run.legs.size(); ++n) {
        const Limb& leg = run.legs[n];
        const LegPath& path = run.motion.legs[n];
        say(reports, "leg      {:<5} {} > {} > {}, {:.4g} long; {}; in contact {}, {:.0f} % of the frames\n",
            side_name(leg.name.side), shown(leg.upper()), shown(leg.lower()), shown(leg.end()), path.length,
            path.has_toe ? shown(path.toe) + " stands" : "without a toe joint its ankle stands",
            counted(contacts_of(run.contacts[n]).size(), "time"), 100 * share_on(run.contacts[n]));
    }
    print_missing(reports, run.missing);
    if (options.contacts.empty())
        say(reports,
            "contact  slower than {:g} leg lengths a second and lower than {:g} over its floor, in most frames of a "
            "twelfth of a second\n",
            run.bars.speed, run.bars.height);
    else
        say(reports, "contact  as {} says\n", shown_file(options.contacts));
    if (run.floor.hills)
        say(reports, "ground   {}, {} x {} pixels; the clip's own floor is level, its feet stand at {:.4g}\n",
            shown_file(options.ground), run.floor.hills->grid.columns, run.floor.hills->grid.rows, run.floor.level);
    else
        say(reports, "ground   level, feet stand at {:.4g}\n", run.floor.level);
    say(reports, "body     moved by {}\n", shown(run.motion.carrier));
    if (options.travel)
        say(reports, "travel   {}\n",
            run.travel_w ? vector_text(*run.travel_w) + " a second, as it walks in place"
                         : "none: it does not walk in place");
    say(reports, "{:<35}{:>9}{:>10}\n", "", "before", "after");
    for (const Measure& each : kMeasures)
        say(reports, "{:<35}{:>9.4f}{:>10.4f}  {}\n", each.words, run.before.*each.value, run.after.*each.value,
            each.unit);
    say(reports, "{:<35}{:>9}{:>10.4f}  leg lengths, {:.4f} down\n", "the body is moved by, most", "", run.body_moved,
        run.body_lowered);
    for (const std::string& text : look_texts(run)) say(reports, "look     {}\n", text);
    for (const std::string& text : run.garbage) say(reports, "garbage  {}\n", text);
    print_written(reports, {run.out, is_refused(options, run) ? "" : options.export_contacts});
}

Json json_of(const FeetOptions& options, const FeetRun& run)
{
    const formats::Clip& clip = run.file.clip();
    const auto name = [&](int joint) { return joint_at(clip, joint).name; };
    Json out = {{"file", run.name},
                {"format", run.file.describe()},
                {"frames", clip.frame_count},
                {"frame_time", frame_time_of(clip)}};
    if (const auto notes = run.file.notes(); !notes.empty()) out["notes"] = notes;
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
    add_missing(out, run.missing);
    if (options.contacts.empty())
        out["bars"] = {{"speed", run.bars.speed}, {"height", run.bars.height}};
    else
        out["contacts"] = options.contacts;
    if (run.floor.hills) out["ground"] = options.ground;
    out["floor"] = run.floor.level;
    out["body"] = name(run.motion.carrier);
    if (options.travel) out["travel"] = run.travel_w ? Json(*run.travel_w) : Json();
    for (const Measure& each : kMeasures) {
        out["before"][each.key] = run.before.*each.value;
        out["after"][each.key] = run.after.*each.value;
    }
    out["after"]["body_moved_max"] = run.body_moved;
    out["after"]["body_moved_down_max"] = run.body_lowered;
    for (const FeetDoubt& doubt : run.doubts) out["doubts"].push_back(doubt_json(run, doubt));
    const std::vector<std::string> look = look_texts(run);
    out["verdict"] = verdict_word(!look.empty(), !run.garbage.empty());
    out["look"] = look;
    out["garbage"] = run.garbage;
    if (!run.out.empty()) out["out"] = run.out;
    if (!options.export_contacts.empty() && !is_refused(options, run)) out["export_contacts"] = options.export_contacts;
    return out;
}

using formats::InputError;

void require_usage(const FeetOptions& options)
{
    if (options.ground.empty() != options.ground_size.empty())
        throw CommandError(2, "--ground and --ground-size go together; give both");
    require_one_reader(std::array{options.files[0], options.contacts, options.ground}, "FILE, --contacts and --ground");
    require_many_files(options.files, options.files.size(), options.out, "FILE",
                       {{"--contacts", options.contacts}, {"--export-contacts", options.export_contacts}});
}

std::optional<Ground> read_ground(const FeetOptions& options)
{
    if (options.ground.empty()) return std::nullopt;
    const std::vector<double> size = formats::numbers_of(options.ground_size);
    formats::HeightPicture picture = formats::read_height_picture(options.ground);
    return Ground{{{size[0], size[1], size[2]}, {0, 0, 0}, picture.columns, picture.rows}, std::move(picture.heights)};
}

// Moves the root of a clip that walks in place, evenly, so that its feet mostly do not slide.
void travel(FeetRun& run)
{
    const auto slide = slide_of(run.motion, run.bars);
    if (!slide || slide->with_body) return;
    run.travel_w = -slide->velocity_w;
    const formats::Clip& clip = run.file.clip();
    const int carrier = run.motion.carrier, parent = joint_at(clip, carrier).parent;
    TurnedJoint moved{carrier, {}, {}};
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const double seconds = static_cast<double>(frame) * clip.frame_time;
        const Vector3d place_w = run.motion.carrier_w[frame] + seconds * *run.travel_w;
        const std::vector<formats::JointPose> pose_w = formats::world_pose(clip, frame);
        moved.translation.push_back(parent < 0 ? place_w
                                               : formats::to_inner(pose_w[static_cast<std::size_t>(parent)], place_w));
    }
    run.file.replace(with_joints(clip, std::array{moved}));
    run.motion = leg_motion(clip, run.legs, carrier, run.motion.up_w);
}

// The legs that bind, and where they go.
void bind_legs(const FeetOptions& options, FeetRun& run)
{
    SolveOptions legs;
    legs.kinds = "legs";
    legs.legs = options.legs;
    const LimbChoice choice = choice_of(legs);
    const FigureJoints figure = run.file.find_limbs(choice);
    const formats::Clip& clip = run.file.clip();
    LimbSearch search = bind_limbs(clip, figure, choice);
    run.legs = require_limbs(search, run.name);  // first: of a glTF file the frames are those of known limbs alone
    if (clip.frame_time == 0 && clip.frame_count > 1)
        throw InputError(run.name, "its keys lie at uneven times, and feet are judged by even frames; give --fps");
    if (clip.frame_count < 3)
        throw InputError(run.name, fmt::format("its legs have {}, and feet are judged by their motion; give a clip in "
                                               "which they have 3 or more",
                                               counted(clip.frame_count, "frame")));
    for (LimbFinding& finding : search.findings)
        if (!finding.limb) run.missing.push_back(std::move(finding));
    const int carrier = carrier_of(clip, figure);
    if (carrier < 0) throw InputError(run.name, "no joint is above both legs; the body cannot be moved");
    run.body = std::move(search.body);
    run.motion = leg_motion(clip, run.legs, carrier, search.facing.up_w);
    run.clip_doubts = clip_doubts({clip, run.body});
}

Contacts choose_contacts(const FeetOptions& options, const FeetRun& run)
{
    if (!options.contacts.empty())
        return contacts_of_rows(run.motion.legs, run.motion.frame_count(), formats::read_contacts_csv(options.contacts),
                                options.contacts);
    if (const auto slide = slide_of(run.motion, run.bars)) {
        const double speed = slide->velocity_w.norm() / run.motion.leg_length();
        throw InputError(
            run.name,
            slide->with_body
                ? fmt::format("it glides, and does not walk: its feet slide with the body, by about {:.2g} leg lengths "
                              "a second; say by --contacts when feet stand",
                              speed)
                : fmt::format("it walks in place: on the ground its feet slide by about {:.2g} leg lengths a second, "
                              "and its body ends near where it began; {}say by --contacts when feet stand",
                              speed,
                              run.travel_w ? ""
                                           : fmt::format("give --travel, which moves its root by {} a second, or ",
                                                         vector_text(Vector3d(-slide->velocity_w)))));
    }
    return find_contacts(run.motion, run.bars);
}

// The body, for --root-motion. root: of root_joint().
MovedBody moved_body(const FeetRun& run, int root)
{
    const formats::Clip& clip = run.file.clip();
    const Limb& leg = run.legs[0];
    const Vector3d& up_w = run.motion.up_w;
    const double toe_at_rest = formats::position_of(formats::rest_pose(clip), run.motion.legs[0].toe).dot(up_w);
    const double level = run.floor.level - (rests_on_ground(clip, leg.upper(), leg.end(), up_w) ? toe_at_rest : 0);
    return {root, run.motion.carrier, common_joint(clip, run.legs), up_w,
            [&run, level](const Vector3d& place_w) { return level + run.floor.hill(place_w); }};
}

// One clip, from its file to its file. hills: null without.
void run_clip(const FeetOptions& options, const Ground* hills, FeetRun& run)
{
    bind_legs(options, run);
    const formats::Clip& clip = run.file.clip();
    std::optional<int> root;
    if (options.root_motion) root = root_joint(clip, run.motion.carrier, run.name);  // refuses before the work
    const LegMotion motion_in_file = run.motion;
    if (options.travel) travel(run);
    run.contacts = choose_contacts(options, run);
    if (std::ranges::none_of(run.contacts, [](const std::vector<bool>& leg) { return std::ranges::count(leg, true); }))
        throw InputError(run.name, fmt::format("no foot is ever on the ground: slower than {:g} leg lengths a second "
                                               "and lower than {:g} over its floor; raise --speed or --height, or give "
                                               "--contacts",
                                               run.bars.speed, run.bars.height));
    run.floor = {run.motion.up_w, floor_level(run.motion, run.contacts), hills};
    run.placed = place_feet(run.motion, run.contacts, run.bars, run.floor, run.name);
    for (const Vector3d& shift_w : run.placed.shift_w) {
        run.body_moved = std::max(run.body_moved, shift_w.norm() / run.motion.leg_length());
        run.body_lowered = std::max(run.body_lowered, -shift_w.dot(run.motion.up_w) / run.motion.leg_length());
    }
    std::vector<TurnedJoint> joints = turn_legs(clip, run.legs, run.motion, run.placed, run.name);
    run.before = skating_of(motion_in_file, run.contacts, {run.motion.up_w, run.floor.level, nullptr});
    const auto motion_of = [&](const formats::Clip& moved) {
        return leg_motion(moved, run.legs, run.motion.carrier, run.motion.up_w);
    };
    const formats::Clip standing = with_joints(clip, joints);
    for (TurnedJoint& toes : bend_toes(standing, motion_of(standing), run.placed, run.floor))
        if (run.file.can_key(toes.joint))
            joints.push_back(std::move(toes));
        else
            run.clip_doubts.push_back({fmt::format("the tip of '{}' goes into the ground, and it takes no new rotation",
                                                   printable_name(joint_at(clip, toes.joint)))});
    const formats::Clip moved = with_joints(clip, joints);
    const LegMotion after = motion_of(moved);
    run.after = skating_of(after, run.contacts, run.floor);
    run.doubts = feet_doubts(after, run.motion, run.before, run.contacts, run.bars, run.floor);
    for (ClipDoubt& doubt : clip_doubts({moved, run.body}))
        if (doubt.is_garbage) run.garbage.push_back(std::move(doubt.text));
    if (is_refused(options, run)) {
        run.out.clear();
        return;
    }
    if (!run.out.empty())
        write_joints(run.out, run.file, moved, std::move(joints), {},
                     root ? std::optional(moved_body(run, *root)) : std::nullopt);
    if (!options.export_contacts.empty())
        formats::write_contacts_csv(options.export_contacts, rows_of(run.motion, run.contacts));
}

}  // namespace

void run_feet(const FeetOptions& options)
{
    require_usage(options);
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const std::optional<Ground> hills = read_ground(options);
    std::vector<ReadFile> read{{options.contacts, "the table of contacts"}, {options.ground, "the picture of heights"}};
    for (const std::string& file : options.files) read.push_back({file, "the clip"});
    std::vector<std::string> outputs = outputs_of(options.files, options.out);
    outputs.push_back(options.export_contacts);
    require_own_outputs(outputs, read);
    std::FILE* const stream = report_stream(outputs);
    std::FILE* const reports = options.json || options.quiet ? nullptr : stream;
    const bool to_folder = is_to_folder(options.out, options.files.size());

    const auto work = [&](std::size_t n, Json& clips) {
        FeetRun run{options.files[n],
                    outputs[n],
                    MotionFile(options.files[n], options.motion),
                    {options.speed, options.height}};
        if (!run.out.empty()) run.file.require_can_write(run.out);
        require_not_beside(std::array{run.out, options.export_contacts}, run.file);
        run_clip(options, hills ? &*hills : nullptr, run);
        if (options.json) clips.push_back(json_of(options, run));
        if (reports && !to_folder) print_feet(reports, options, run);
        return FileOutcome{run.name, run.out, look_texts(run), run.garbage, is_refused(options, run)};
    };
    const std::vector<FileOutcome> outcomes =
        run_files(options.files, {options.out, options.quiet, reports, options.json ? stream : nullptr}, work);
    if (options.files.size() > 1 || to_folder) return require_none_failed(outcomes);
    require_not_refused(outcomes.front(), options.files.front(), "swivel inspect",
                        !options.out.empty() || !options.export_contacts.empty());
}

}  // namespace swivel::tools
