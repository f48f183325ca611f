// SPDX-License-Identifier: MIT
//
// `swivel feet`: finds when feet of clips are on the ground, lets them stand, reports, and writes the clips.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/feet/toes.h"
#include "tools/feet/turn_legs.h"
#include "tools/formats/error.h"
#include "tools/formats/height_picture.h"
#include "tools/formats/output_file.h"
#include "tools/formats/text.h"
#include "tools/rig/clip_doubts.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/feet_report.h"
#include "tools/swivel/report.h"
#include "tools/swivel/solve_files.h"

namespace swivel::tools {

namespace {

namespace fs = std::filesystem;
using formats::InputError;

bool is_to_folder(const FeetOptions& options)
{
    std::error_code ignored;
    return !options.out.empty() && (options.files.size() > 1 || fs::is_directory(options.out, ignored));
}

void require_usage(const FeetOptions& options)
{
    if (options.ground.empty() != options.ground_size.empty())
        throw CommandError(2, "--ground and --ground-size go together; give both");
    if (options.files.size() == 1) {
        const auto inputs = {options.files[0], options.contacts, options.ground};
        if (std::ranges::count_if(inputs, [](const std::string& name) { return formats::is_standard_stream(name); }) >
            1)
            throw CommandError(2,
                               "more than one of FILE, --contacts and --ground is -, standard input; name the others");
        return;
    }
    for (const std::string& file : options.files)
        if (formats::is_standard_stream(file))
            throw CommandError(2, "-, standard input, is one FILE of several; give it alone");
    for (const auto& [option, value] :
         {std::pair("--contacts", &options.contacts), {"--export-contacts", &options.export_contacts}})
        if (!value->empty())
            throw CommandError(2, fmt::format("{}: a table is of one FILE, not of {}; run each by itself", option,
                                              options.files.size()));
}

// Where the clips go, one for each FILE; empty: nowhere.
std::vector<std::string> outputs_of(const FeetOptions& options)
{
    std::vector<std::string> outputs;
    for (const std::string& file : options.files)
        outputs.push_back(is_to_folder(options) ? (fs::path(options.out) / title_of(file)).string() : options.out);
    return outputs;
}

std::optional<Ground> read_ground(const FeetOptions& options)
{
    if (options.ground.empty()) return std::nullopt;
    const std::vector<double> size = formats::numbers_of(options.ground_size);
    formats::HeightPicture picture = formats::read_height_picture(options.ground);
    return Ground{{{size[0], size[1], size[2]}, {0, 0, 0}, picture.columns, picture.rows}, std::move(picture.heights)};
}

// The legs that bind, and where they go.
void bind_legs(const FeetOptions& options, MotionFile& file, FeetRun& run)
{
    SolveOptions legs;
    legs.kinds = "legs";
    legs.legs = options.legs;
    const LimbChoice choice = choice_of(legs);
    const FigureJoints figure = choose_joints(file.clip(), run.file, choice);
    file.sample(joints_of(figure));
    file.stand(known_limbs(figure));
    const formats::Clip& clip = file.clip();
    if (clip.frame_time == 0 && clip.frame_count > 1)
        throw InputError(run.file, "its keys lie at uneven times, and feet are judged by even frames; give --fps");
    if (clip.frame_count < 3)
        throw InputError(run.file, fmt::format("has {} frame{}, and feet are judged by their motion; give a clip of 3 "
                                               "or more",
                                               clip.frame_count, clip.frame_count == 1 ? "" : "s"));
    LimbSearch search = bind_limbs(clip, figure, choice);
    run.legs = require_limbs(search, run.file);
    for (LimbFinding& finding : search.findings)
        if (!finding.limb) run.missing.push_back(std::move(finding));
    const int carrier = carrier_of(clip, figure);
    if (carrier < 0) throw InputError(run.file, "no joint is above both legs; the body cannot be moved");
    run.motion = leg_motion(clip, run.legs, carrier, search.facing.up_w);
    run.clip_doubts = clip_doubts(clip, search.body);
}

Contacts choose_contacts(const FeetOptions& options, const FeetRun& run)
{
    if (!options.contacts.empty())
        return contacts_of_rows(run.motion.legs, run.motion.frame_count(), formats::read_contacts_csv(options.contacts),
                                options.contacts);
    if (const auto slide = slide_of(run.motion, run.bars)) {
        const double speed = slide->velocity_w.norm() / run.motion.leg_length();
        throw InputError(
            run.file,
            slide->with_body
                ? fmt::format("its feet slide with the body, by {:.2g} leg lengths a second in the mean; say by "
                              "--contacts when feet stand",
                              speed)
                : fmt::format("it walks in place: on the ground its feet slide by {:.2g} leg lengths a second in the "
                              "mean, and its body ends near where it began; move its root by {} a second first, or say "
                              "by --contacts when feet stand",
                              speed, vector_text(Eigen::Vector3d(-slide->velocity_w))));
    }
    return find_contacts(run.motion, run.bars);
}

// One clip, from its file to its file. hills: null without.
FeetRun run_clip(const FeetOptions& options, const Ground* hills, MotionFile& file, FeetRun run)
{
    bind_legs(options, file, run);
    run.contacts = choose_contacts(options, run);
    if (std::ranges::none_of(run.contacts, [](const std::vector<bool>& leg) { return std::ranges::count(leg, true); }))
        throw InputError(run.file, fmt::format("no foot is ever on the ground: slower than {:g} leg lengths a second "
                                               "and lower than {:g} over its floor; raise --speed or --height, or give "
                                               "--contacts",
                                               run.bars.speed, run.bars.height));
    run.floor = {run.motion.up_w, floor_level(run.motion, run.contacts), hills};
    run.placed = place_feet(run.motion, run.contacts, run.bars, run.floor, run.file);
    const formats::Clip& clip = file.clip();
    std::vector<TurnedJoint> joints = turn_legs(clip, run.legs, run.motion, run.placed, run.file);
    run.before = skating_of(run.motion, run.contacts, {run.motion.up_w, run.floor.level, nullptr});
    const auto motion_of = [&](const formats::Clip& moved) {
        return leg_motion(moved, run.legs, run.motion.carrier, run.motion.up_w);
    };
    const formats::Clip standing = with_joints(clip, joints);
    for (TurnedJoint& toes : bend_toes(standing, motion_of(standing), run.placed, run.floor))
        if (file.can_key(toes.joint))
            joints.push_back(std::move(toes));
        else
            run.clip_doubts.push_back(fmt::format("the tip of '{}' goes into the ground, and it takes no new rotation",
                                                  printable_name(joint_at(clip, toes.joint))));
    const LegMotion after = motion_of(with_joints(clip, joints));
    run.after = skating_of(after, run.contacts, run.floor);
    run.doubts = feet_doubts(after, run.motion, run.before, run.contacts, run.bars, run.floor);
    std::vector<formats::JointKeys> keys;
    for (const TurnedJoint& each : joints) keys.push_back({each.joint, each.rotation, each.translation});
    if (!run.out.empty()) file.write(run.out, keys);
    if (!run.export_contacts.empty())
        formats::write_contacts_csv(run.export_contacts, rows_of(run.motion, run.contacts));
    return run;
}

}  // namespace

void run_feet(const FeetOptions& options)
{
    require_usage(options);
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const std::optional<Ground> hills = read_ground(options);
    const std::vector<std::string> outputs = outputs_of(options);
    std::vector<ReadFile> read{{options.contacts, "the table of contacts"}, {options.ground, "the picture of heights"}};
    for (const std::string& file : options.files) read.push_back({file, "the clip"});
    std::vector<std::string> written = outputs;
    written.push_back(options.export_contacts);
    require_own_outputs(written, read);
    if (is_to_folder(options)) fs::create_directories(options.out);
    std::FILE* const reports = report_stream(written);

    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    const auto run_one = [&](std::size_t n) {
        FeetRun run;
        run.file = options.files[n];
        run.out = outputs[n];
        run.export_contacts = options.export_contacts;
        run.bars = {options.speed, options.height};
        run.contacts_from = options.contacts;
        run.ground = options.ground;
        MotionFile file(run.file, options.motion);
        run.motion_file = &file;
        if (!run.out.empty()) file.require_can_write(run.out, "this clip", "");
        require_not_beside(std::array{run.out, run.export_contacts}, file);
        run = run_clip(options, hills ? &*hills : nullptr, file, std::move(run));
        if (options.json)
            json.push_back(json_of(run));
        else if (!options.quiet)
            print_feet(run, reports);
    };
    std::size_t failed = 0;
    if (options.files.size() == 1) {
        run_one(0);
    } else {
        Progress progress("clips", options.files.size(), options.quiet);
        for (std::size_t n = 0; n < options.files.size(); ++n) {
            progress.show(n);
            if (run_to_end([&] { run_one(n); }) != 0) ++failed;
        }
    }
    if (options.json) print_json({{"clips", json}}, reports);
    if (failed > 0) throw CommandError(1, fmt::format("{} of {} clips failed", failed, options.files.size()));
}

}  // namespace swivel::tools
