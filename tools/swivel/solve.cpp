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
#include "tools/swivel/parallel.h"
#include "tools/swivel/progress.h"
#include "tools/swivel/report.h"
#include "tools/swivel/validators.h"

namespace swivel::tools {

namespace {

struct Options {
    std::string clip, targets = "clip", out;
    std::vector<std::string> arms;
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

// The given targets, frame by frame.
class GivenTargets {
public:
    GivenTargets(const Options& options, const formats::Clip& clip, std::span<const Arm> arms)
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
            if (std::none_of(arms.begin(), arms.end(), [&](const Arm& arm) { return arm.side == target.side; }))
                refuse(fmt::format("the skeleton has no {} arm; name it with --arm", formats::side_name(target.side)));
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

// The first character's solved rotations, kept for a BVH file: three joints for each arm.
class BvhKeys {
public:
    explicit BvhKeys(std::size_t arm_count) : keys_(3 * arm_count) {}

    void add(const ClipCrowd& crowd)
    {
        for (std::size_t arm = 0; 3 * arm < keys_.size(); ++arm) {
            const formats::PoseRow row = crowd.pose(arm, 0);
            for (std::size_t n = 0; n < 3; ++n) {
                const auto& q = n == 0 ? row.shoulder : n == 1 ? row.elbow : row.wrist;
                keys_[3 * arm + n].emplace_back(q[3], q[0], q[1], q[2]);
            }
        }
    }
    void write(const std::filesystem::path& path, const formats::BvhFile& file, std::span<const Arm> arms) const
    {
        std::vector<formats::RotationOverride> overrides;
        for (std::size_t arm = 0; arm < arms.size(); ++arm)
            for (std::size_t n = 0; n < 3; ++n)
                overrides.push_back({n == 0   ? arms[arm].shoulder
                                     : n == 1 ? arms[arm].elbow
                                              : arms[arm].wrist,
                                     keys_[3 * arm + n]});
        formats::write_bvh(path, file, overrides);
    }

private:
    std::vector<std::vector<Eigen::Quaterniond>> keys_;
};

Statistics solve_clip(const Options& options, const formats::BvhFile& file, std::span<const Arm> arms)
{
    const OutKind kind = out_kind(options);
    GivenTargets given(options, file.clip, arms);
    ClipCrowd crowd(file.clip, arms, options.characters, options.seed);
    std::optional<formats::PosesCsv> csv;
    if (kind == OutKind::csv) csv.emplace(options.out);
    if (kind == OutKind::bvh)
        const formats::OutputFile can_be_written(options.out);  // says so before the work, not after
    BvhKeys keys(arms.size());
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
    if (kind == OutKind::bvh) keys.write(options.out, file, arms);
    return statistics;
}

const std::string& joint_name(const formats::Clip& clip, int joint)
{
    return clip.joints[static_cast<std::size_t>(joint)].name;
}

void print_clip(const Options& options, const formats::Clip& clip, std::span<const Arm> arms)
{
    fmt::print("clip     {}: {} joints, {} frames, {:.1f} frames/s\n", options.clip, clip.joints.size(),
               clip.frame_count, 1 / clip.frame_time);
    for (const Arm& arm : arms)
        fmt::print("arm      {:<5} {} > {} > {}, {:.4g} + {:.4g} long, hinge ({:.3f} {:.3f} {:.3f}), {}\n",
                   formats::side_name(arm.side), joint_name(clip, arm.shoulder), joint_name(clip, arm.elbow),
                   joint_name(clip, arm.wrist), arm.limb.lengths[0], arm.limb.lengths[1], arm.hinge.x(), arm.hinge.y(),
                   arm.hinge.z(), arm.hinge_source);
    const std::size_t arm_count = arms.size() * options.characters;
    fmt::print("crowd    {} character{}, {} arm{}, targets from {}\n", options.characters,
               options.characters == 1 ? "" : "s", arm_count, arm_count == 1 ? "" : "s",
               options.targets == "clip" ? "the clip" : options.targets);
}

nlohmann::ordered_json json_of(const Options& options, const formats::Clip& clip, std::span<const Arm> arms)
{
    nlohmann::ordered_json out{
        {"clip", options.clip},          {"joints", clip.joints.size()},     {"frames", clip.frame_count},
        {"frame_time", clip.frame_time}, {"characters", options.characters}, {"seed", options.seed},
        {"targets", options.targets}};
    for (const Arm& arm : arms)
        out["arms_bound"].push_back({{"side", formats::side_name(arm.side)},
                                     {"shoulder", joint_name(clip, arm.shoulder)},
                                     {"elbow", joint_name(clip, arm.elbow)},
                                     {"wrist", joint_name(clip, arm.wrist)},
                                     {"lengths", {arm.limb.lengths[0], arm.limb.lengths[1]}},
                                     {"hinge", {arm.hinge.x(), arm.hinge.y(), arm.hinge.z()}},
                                     {"hinge_source", arm.hinge_source}});
    return out;
}

void run(const Options& options)
{
    note_interrupts();
    const auto before = std::chrono::steady_clock::now();
    out_kind(options);  // usage errors first
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const formats::BvhFile file = formats::read_bvh(options.clip);
    const std::vector<Arm> arms = find_arms(file.clip, options.clip, options.arms);
    if (!options.json) print_clip(options, file.clip, arms);

    const ThreadLimit limit(options.threads);
    const Statistics statistics = solve_clip(options, file, arms);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    if (options.json) {
        nlohmann::ordered_json out = json_of(options, file.clip, arms);
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
    CLI::App* command = app.add_subcommand("solve", "Solve the arms of a BVH clip, or of a crowd that performs it");
    auto options = std::make_shared<Options>();
    command->add_option("clip", options->clip, "Motion file, .bvh")->required()->check(file_name());
    command
        ->add_option(
            "--targets", options->targets,
            "Where wrists, elbows and hands must be: 'clip' for the clip's own motion, or a CSV file with the columns\n"
            "frame,character,side,x,y,z,pole_x,pole_y,pole_z[,qx,qy,qz,qw], in the world; arms without a row follow "
            "the clip")
        ->capture_default_str();
    command
        ->add_option("--out", options->out, "Write the poses: .bvh (one character) or .csv; without it statistics only")
        ->check(file_name());
    command
        ->add_option("--arm", options->arms,
                     "Joints of an arm, SHOULDER,ELBOW,WRIST, by name or path; up to twice; left: or right: in front "
                     "sets the side")
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
