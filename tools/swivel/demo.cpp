// SPDX-License-Identifier: MIT
//
// `swivel demo`: the main job on a made-up clip. A crowd of characters swings its arms; targets lie somewhat ahead of
// the clip's own wrists, some of them out of reach. Every frame all arms are solved.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/crowd/clip_crowd.h"
#include "tools/crowd/demo_clip.h"
#include "tools/crowd/parallel.h"
#include "tools/formats/text.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/cached_clip.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/report.h"
#include "tools/swivel/view_page.h"

namespace swivel::tools {

namespace {

// The clip's arms, bound.
std::vector<Limb> demo_limbs(const formats::Clip& clip)
{
    LimbChoice choice;
    for (const formats::Side side : {formats::Side::left, formats::Side::right})
        choice.bends.push_back({{formats::LimbKind::arm, side}, Eigen::Vector3d::UnitZ(), "demo", ""});
    return require_limbs(bind_limbs(clip, choose_joints(clip, "demo", choice), choice), "demo");
}

CrowdPlan demo_plan(const DemoOptions& options, std::span<const Limb> limbs)
{
    CrowdPlan plan;
    plan.characters = options.characters;
    plan.seed = options.seed;
    plan.spacing = 1.6;
    for (const Limb& limb : limbs)
        put(Eigen::Vector3d(0, 0.06, 0.03), plan.limbs.emplace_back(following_setup(limb)).goals.target_offset);
    return plan;
}

Statistics solve_demo(const DemoOptions& options)
{
    std::optional<ViewPage> page;
    if (!options.view.empty()) page.emplace(options.view);
    const formats::Clip clip = demo_clip(std::min<std::size_t>(options.frames, kDemoFrames));
    const std::vector<Limb> limbs = demo_limbs(clip);
    const CrowdPlan plan = demo_plan(options, limbs);
    ClipCrowd crowd(clip, limbs, plan);
    Statistics statistics;
    {
        Progress progress("frames", options.frames, options.quiet);
        for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
            progress.show(frame);
            crowd.set_frame(frame, {});
            crowd.solve(statistics);
            crowd.measure(statistics);
            if (page && frame < clip.frame_count) page->add_frame(crowd.goal_crowd(), crowd.given_places());
        }
    }
    if (page)
        page->commit(cached_clip({"swivel demo", "a made-up crowd"}, clip, limbs, plan, crowd.motion()),
                     crowd.goal_crowd());
    return statistics;
}

}  // namespace

void run_demo(const DemoOptions& options)
{
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const ThreadLimit limit(options.threads);
    std::FILE* const reports = formats::is_standard_stream(options.view) ? stderr : stdout;
    const Statistics statistics = solve_demo(options);
    if (options.json) {
        Json out{{"characters", options.characters}, {"frames", options.frames}, {"seed", options.seed}};
        out.update(json_of(statistics));
        if (!options.view.empty()) out["view"] = options.view;
        print_json(out, reports);
        return;
    }
    say(reports, "demo     {} characters, {} arms, {} frames of made-up reaching\n", options.characters,
        2 * options.characters, options.frames);
    print_statistics(reports, statistics, length_unit(true, 0));
    if (!options.view.empty() && reports == stdout) say(stdout, "page     {}: open it in a browser\n", options.view);
}

}  // namespace swivel::tools
