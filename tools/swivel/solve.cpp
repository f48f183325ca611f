// SPDX-License-Identifier: MIT
//
// `swivel solve`: binds a clip's skeleton, makes a crowd of it, solves every frame, reports, and writes the poses.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/formats/bvh.h"
#include "tools/formats/error.h"
#include "tools/formats/output_file.h"
#include "tools/formats/poses_csv.h"
#include "tools/formats/targets_csv.h"
#include "tools/swivel/clip_crowd.h"
#include "tools/swivel/command_error.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/interrupt.h"
#include "tools/swivel/limb_words.h"
#include "tools/swivel/parallel.h"
#include "tools/swivel/progress.h"
#include "tools/swivel/report.h"
#include "tools/swivel/validators.h"

namespace swivel::tools {

namespace {

struct Options {
    std::string clip, targets = "clip", out;
    LimbChoice limbs;
    std::uint32_t characters = 1;
    std::uint64_t seed = 1;
    unsigned threads = 0;
    bool json = false;
};

enum class OutKind { none, bvh, csv };

OutKind out_kind(const Options& options)
{
    if (options.out.empty()) return OutKind::none;
    const std::string suffix = std::filesystem::path(options.out).extension().string();
    if (suffix == ".csv") return OutKind::csv;
    if (suffix != ".bvh")
        throw CommandError(2, fmt::format("--out {}: no writer for this suffix; use .bvh or .csv", options.out));
    if (options.characters > 1)
        throw CommandError(2, fmt::format("--out {}: a BVH file holds one character, not {}; write a .csv", options.out,
                                          options.characters));
    return OutKind::bvh;
}

// Why a row speaks of a limb that is not solved, and what to do.
std::string no_limb(const formats::Clip& clip, formats::LimbName name)
{
    const LimbWords& words = words_of(name.kind);
    if (joints_by_habit(clip, name))
        return fmt::format("the {} is not solved; take it in with --limbs", plain_name(name));
    return fmt::format("the skeleton has no {}; name it with {} {}", plain_name(name), words.option, words.joints);
}

// The given targets, frame by frame.
class GivenTargets {
public:
    GivenTargets(const Options& options, const formats::Clip& clip, std::span<const Limb> limbs)
    {
        if (options.targets == "clip") return;
        targets_ = formats::read_targets_csv(options.targets);
        for (const formats::Target& target : targets_) {
            const auto refuse = [&](const std::string& cause) {
                throw formats::InputError(options.targets, target.line, cause);
            };
            if (target.frame >= clip.frame_count)
                refuse(fmt::format("frame {} does not exist; the clip has frames 0 to {}", target.frame,
                                   clip.frame_count - 1));
            if (target.character >= options.characters)
                refuse(fmt::format("character {} does not exist; there are {} (--characters), counted from 0",
                                   target.character, options.characters));
            if (std::none_of(limbs.begin(), limbs.end(), [&](const Limb& limb) { return limb.name == target.limb; }))
                refuse(no_limb(clip, target.limb));
        }
    }

    // Those of a frame; frames must be asked for in order.
    std::span<const formats::Target> of_frame(std::size_t frame)
    {
        const std::size_t begin = next_;
        while (next_ < targets_.size() && targets_[next_].frame == frame) ++next_;
        return std::span(targets_).subspan(begin, next_ - begin);
    }

private:
    std::vector<formats::Target> targets_;  // sorted by frame
    std::size_t next_ = 0;
};

// The first character's solved rotations, kept for a BVH file: three joints for each limb.
class BvhKeys {
public:
    explicit BvhKeys(std::size_t limb_count) : keys_(3 * limb_count) {}

    void add(const ClipCrowd& crowd)
    {
        for (std::size_t limb = 0; 3 * limb < keys_.size(); ++limb) {
            const formats::PoseRow row = crowd.pose(limb, 0);
            for (std::size_t n = 0; n < 3; ++n) {
                const auto& q = n == 0 ? row.shoulder : n == 1 ? row.elbow : row.wrist;
                keys_[3 * limb + n].emplace_back(q[3], q[0], q[1], q[2]);
            }
        }
    }
    void write(const std::filesystem::path& path, const formats::BvhFile& file, std::span<const Limb> limbs) const
    {
        std::vector<formats::RotationOverride> overrides;
        for (std::size_t limb = 0; limb < limbs.size(); ++limb)
            for (std::size_t n = 0; n < 3; ++n) overrides.push_back({limbs[limb].joints[n], keys_[3 * limb + n]});
        formats::write_bvh(path, file, overrides);
    }

private:
    std::vector<std::vector<Eigen::Quaterniond>> keys_;
};

Statistics solve_clip(const Options& options, const formats::BvhFile& file, std::span<const Limb> limbs)
{
    const OutKind kind = out_kind(options);
    GivenTargets given(options, file.clip, limbs);
    ClipCrowd crowd(file.clip, limbs, options.characters, options.seed);
    std::optional<formats::PosesCsv> csv;
    if (kind == OutKind::csv) csv.emplace(options.out);
    if (kind == OutKind::bvh)
        const formats::OutputFile can_be_written(options.out);  // says so before the work, not after
    BvhKeys keys(limbs.size());
    Statistics statistics;
    {
        Progress progress("frames", file.clip.frame_count);
        for (std::size_t frame = 0; frame < file.clip.frame_count; ++frame) {
            check_interrupt();
            progress.show(frame);
            crowd.set_frame(frame, given.of_frame(frame));
            crowd.solve(statistics);
            crowd.measure(statistics);
            if (csv) csv->append(static_cast<std::uint32_t>(frame), crowd.poses());
            if (kind == OutKind::bvh) keys.add(crowd);
        }
    }
    if (csv) csv->commit();
    if (kind == OutKind::bvh) keys.write(options.out, file, limbs);
    return statistics;
}

const std::string& joint_name(const formats::Clip& clip, int joint)
{
    return clip.joints[static_cast<std::size_t>(joint)].name;
}

void print_clip(const Options& options, const formats::Clip& clip, std::span<const Limb> limbs)
{
    fmt::print("clip     {}: {} joints, {} frames, {:.1f} frames/s\n", options.clip, clip.joints.size(),
               clip.frame_count, 1 / clip.frame_time);
    for (const Limb& limb : limbs)
        fmt::print("{:<8} {:<5} {} > {} > {}, {:.4g} + {:.4g} long, hinge ({:.3f} {:.3f} {:.3f}), {}\n",
                   kind_name(limb.name.kind), side_name(limb.name.side), joint_name(clip, limb.upper()),
                   joint_name(clip, limb.lower()), joint_name(clip, limb.end()), limb.bound.lengths[0],
                   limb.bound.lengths[1], limb.hinge.x(), limb.hinge.y(), limb.hinge.z(), limb.hinge_source);
    std::string counts;
    for (const formats::LimbKind kind : {formats::LimbKind::arm, formats::LimbKind::leg}) {
        const auto of_kind = [&](const Limb& limb) { return limb.name.kind == kind; };
        const auto count = static_cast<std::size_t>(std::count_if(limbs.begin(), limbs.end(), of_kind));
        if (count > 0)
            counts += fmt::format(", {} {}{}", count * options.characters, kind_name(kind),
                                  count * options.characters == 1 ? "" : "s");
    }
    fmt::print("crowd    {} character{}{}, targets from {}\n", options.characters, options.characters == 1 ? "" : "s",
               counts, options.targets == "clip" ? "the clip" : options.targets);
}

nlohmann::ordered_json json_of(const Options& options, const formats::Clip& clip, std::span<const Limb> limbs)
{
    nlohmann::ordered_json out{
        {"clip", options.clip},          {"joints", clip.joints.size()},     {"frames", clip.frame_count},
        {"frame_time", clip.frame_time}, {"characters", options.characters}, {"seed", options.seed},
        {"targets", options.targets}};
    for (const Limb& limb : limbs) {
        const LimbWords& words = words_of(limb.name.kind);
        out[fmt::format("{}_bound", words.limbs)].push_back(
            {{"side", side_name(limb.name.side)},
             {words.upper_joint, joint_name(clip, limb.upper())},
             {words.lower_joint, joint_name(clip, limb.lower())},
             {words.end_joint, joint_name(clip, limb.end())},
             {"lengths", {limb.bound.lengths[0], limb.bound.lengths[1]}},
             {"hinge", {limb.hinge.x(), limb.hinge.y(), limb.hinge.z()}},
             {"hinge_source", limb.hinge_source}});
    }
    return out;
}

void require_named_limbs_solved(const LimbChoice& choice)
{
    if (choice.kinds == "legs" && !choice.arms.empty())
        throw CommandError(2, "--arm names an arm, but --limbs legs solves none; use --limbs all");
    if (choice.kinds == "arms" && !choice.legs.empty())
        throw CommandError(2, "--leg names a leg, but --limbs arms solves none; use --limbs all");
}

void run(const Options& options)
{
    note_interrupts();
    const auto before = std::chrono::steady_clock::now();
    out_kind(options);  // usage errors first
    require_named_limbs_solved(options.limbs);
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const formats::BvhFile file = formats::read_bvh(options.clip);
    const std::vector<Limb> limbs = find_limbs(file.clip, options.clip, options.limbs);
    if (!options.json) print_clip(options, file.clip, limbs);

    const ThreadLimit limit(options.threads);
    const Statistics statistics = solve_clip(options, file, limbs);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    if (options.json) {
        nlohmann::ordered_json out = json_of(options, file.clip, limbs);
        out.update(json_of(statistics));
        out["seconds"] = seconds;
        if (!options.out.empty()) out["out"] = options.out;
        print_json(out);
        return;
    }
    print_statistics(statistics);
    fmt::print("time     {:.2f} s in all, {:.3f} s of it solving\n", seconds, statistics.solve_seconds);
    if (!options.out.empty()) fmt::print("written  {}\n", options.out);
}

}  // namespace

void add_solve(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("solve", "Solve the arms and legs of a BVH clip, or of a crowd that performs it");
    auto options = std::make_shared<Options>();
    command->add_option("clip", options->clip, "Motion file, .bvh")->required()->check(file_name());
    command
        ->add_option("--targets", options->targets,
                     "Where wrists, elbows and hands (ankles, knees and feet) must be: 'clip' for the clip's own "
                     "motion, or a CSV "
                     "file with the columns\nframe,character,limb,x,y,z,pole_x,pole_y,pole_z[,qx,qy,qz,qw], in the "
                     "world; limb is "
                     "left_arm, right_arm, left_leg or right_leg; limbs without a row follow the clip")
        ->capture_default_str();
    command
        ->add_option("--out", options->out, "Write the poses: .bvh (one character) or .csv; without it statistics only")
        ->check(file_name());
    command
        ->add_option("--limbs", options->limbs.kinds,
                     "Which limbs to solve: arms, legs or all; without it those named by --arm and --leg, or else the "
                     "arms")
        ->check(CLI::IsMember({"arms", "legs", "all"}));
    command
        ->add_option("--arm", options->limbs.arms,
                     "Joints of an arm, SHOULDER,ELBOW,WRIST, by name or path; up to twice; left: or right: in front "
                     "sets the side")
        ->allow_extra_args(false);
    command->add_option("--leg", options->limbs.legs, "Joints of a leg, HIP,KNEE,ANKLE, in the same way")
        ->allow_extra_args(false);
    command
        ->add_option("--characters", options->characters,
                     "Characters, differing in arm lengths, place and start; the first is the clip's own")
        ->capture_default_str()
        ->check(whole_number(1, 10'000'000));
    command->add_option("--seed", options->seed, "Seed of the characters' differences")
        ->capture_default_str()
        ->check(whole_number(0, UINT64_MAX));
    command->add_option("--threads", options->threads, "Threads at most; 0 for all")
        ->capture_default_str()
        ->check(whole_number(0, 1024));
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([options] { run(*options); });
}

}  // namespace swivel::tools
