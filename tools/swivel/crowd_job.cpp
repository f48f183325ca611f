// SPDX-License-Identifier: MIT
#include "tools/swivel/crowd_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "tools/cli/command_error.h"
#include "tools/crowd/characters.h"
#include "tools/crowd/crowd_checks.h"
#include "tools/crowd/heading.h"
#include "tools/feet/leg_motion.h"
#include "tools/feet/standing.h"
#include "tools/formats/agents_csv.h"
#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/report.h"
#include "tools/swivel/run_files.h"

namespace swivel::tools {

namespace {

void require_named_limbs_solved(const LimbChoice& choice)
{
    const auto refuse = [&](const char* named) {
        throw CommandError(2, fmt::format("{}, but {} solves none; use --limbs all", named, kinds_words(choice)));
    };
    if (choice.kinds == "legs" && !choice.arms.empty()) refuse("--arm names an arm");
    if (choice.kinds == "arms" && !choice.legs.empty()) refuse("--leg names a leg");
}

Between between_of(const SolveOptions& options, const std::string& targets)
{
    if (options.between.empty()) return Between::clip;
    if (targets == "clip")
        throw CommandError(2, fmt::format("--between {}: is about the rows of a table; give one with --targets FILE",
                                          options.between));
    return options.between == "hold" ? Between::hold : Between::linear;
}

// A clip's loop, as the crowd file asks for it. name: of the clip, for people.
FoundLoop loop_of(const formats::CrowdFile& file, const std::string& name, const formats::Clip& clip, int body)
{
    const formats::Given<formats::LoopFrames>& asked = *file.loop;
    const auto refuse = [&](const std::string& cause) {
        throw formats::InputError(file.path, asked.line, fmt::format("{}: {} {}", asked.key, name, cause));
    };
    const char* const advice = file.clips.empty() ? "write [first, last]" : "take another";
    if (clip.frame_time == 0) refuse("has keys at uneven times; give --fps");
    if (clip.frame_count <= kFewestLooped) refuse("has fewer than three frames and cannot loop; take this out");
    if (asked.value) {
        const auto [first, last] = *asked.value;
        if (!file.clips.empty()) refuse("is not the only clip, and these are frames of one; write \"auto\" or false");
        if (last >= clip.frame_count)
            refuse(fmt::format("has no frame {}; it has frames 0 to {}", last, clip.frame_count - 1));
        if (last - first < kFewestLooped) refuse("needs two frames or more to loop; write [first, last]");
        return {{first, last}, 0};
    }
    if (clip.frame_count > kMaxSearched)
        refuse(
            fmt::format("has {} frames, and \"auto\" compares up to {}; {}", clip.frame_count, kMaxSearched, advice));
    const FoundLoop found = find_loop(clip, body);
    if (!std::isfinite(found.gap)) refuse(fmt::format("is shorter than half a second; {}", advice));
    return found;
}

LookPlan look_of(const formats::CrowdFile& file, const formats::Clip& clip, const CrowdJob& job)
{
    constexpr double kRadians = std::numbers::pi / 180;
    const auto refuse = [&](std::string_view cause) {
        throw formats::InputError(file.path, file.look->line, fmt::format("look: {}", cause));
    };
    if (clip.frame_time == 0 && clip.frame_count > 1) refuse("the clip's keys lie at uneven times; give --fps");
    if (job.plan.budget_blocks > 0) refuse("heads that look are solved in every frame; take this or [budget] out");
    std::vector<int> joints = look_joints(clip, job.body, job.limbs);
    if (joints.empty()) refuse("no head of the clip is known that can turn; name one by look.head, or take this out");
    return plan_look(clip, std::move(joints), job.faces_w, file.look->target, kRadians * file.look->max_deg);
}

CarryPlan carry_of(const formats::CrowdFile& file, const formats::Clip& clip, const Eigen::Vector3d& up_w,
                   const CrowdJob& job)
{
    const formats::CarrySettings& carry = *file.carry;
    if (const std::string cause = why_not_carry(clip, job.limbs); !cause.empty())
        throw formats::InputError(file.path, carry.line, fmt::format("carry: {}, or take this out", cause));
    const double shortest = std::ranges::min(job.builds, {}, &Proportions::arms).arms;
    return plan_carry(clip, job.limbs, carry, shortest, up_w, job.faces_w);
}

// Reads one of the further clips. Its joints are the same ones.
formats::Clip further_clip(const SolveOptions& options, const formats::FurtherClip& from, const formats::Clip& first,
                           std::span<const int> joints, CrowdJob& job)
{
    const std::filesystem::path path =
        from.file.empty() ? std::filesystem::path(options.file) : job.crowd->path.parent_path() / from.file;
    const std::string name = formats::printable(path.string(), std::string::npos);
    const auto fault = [&](const std::string& cause) {
        return formats::InputError(job.crowd->path, from.line, fmt::format("{}: {}", from.key, cause));
    };
    if (formats::is_standard_stream(path)) throw fault("standard input is read once; name a file");
    const auto reading = [&](const auto& act) {
        try {
            return act();
        } catch (const formats::InputError& error) {
            throw fault(error.what());
        } catch (const CommandError&) {  // of a choice that a BVH file does not have
            throw fault(name + ": is a BVH file, which has one motion; take clip out");
        }
    };
    MotionFile file = reading([&] { return MotionFile(path, {from.animation, options.motion.rate, {}}); });
    if (const std::string difference = difference_of(first, file.clip()); !difference.empty())
        throw fault(fmt::format("{}: {}; put it on this skeleton by swivel retarget", name, difference));
    reading([&] { file.sample(joints); });
    // A rate that is asked for fits each clip's length, so they differ a little.
    const double max = options.motion.rate > 0 ? 0.1 : 1e-3;
    if (std::abs(file.clip().frame_time - first.frame_time) > max * first.frame_time)
        throw fault(name + ": its frames come at another rate than the clip's; give --fps");
    job.further.push_back({path, fmt::format("{}: {}", formats::printable(title_of(path.string())), file.describe())});
    return file.clip();
}

// A file that the crowd file names; empty: none.
std::string named_file(const formats::CrowdFile& file, const formats::Maybe<std::string>& name)
{
    return name ? beside(file, *name).string() : std::string();
}

// The head that the crowd file names.
std::optional<NamedJoint> named_head(const CrowdJob& job)
{
    if (!job.crowd || !job.crowd->look || !job.crowd->look->head) return std::nullopt;
    const formats::Given<std::string>& head = *job.crowd->look->head;
    return NamedJoint{head.value, {head.key, job.crowd->path, head.line}};
}

constexpr std::size_t kBuilds = 8;  // the number of figures, where proportions differ

// The agents of a table, as many as are asked for. table: empty without.
std::vector<formats::Agent> read_agents(const SolveOptions& options, const std::string& table)
{
    if (table.empty()) return {};
    std::vector<formats::Agent> agents = formats::read_agents_csv(table);
    const std::size_t count = options.characters.value_or(agents.size());
    if (count > agents.size())
        throw CommandError(2, fmt::format("--characters {}: the table {} has {} agents", count,
                                          formats::printable(table), agents.size()));
    agents.resize(count);
    return agents;
}

// Places the agents: each stands at its place below the joint that all limbs hang on, in the frame that it starts at.
// max_frames: of the clip, where it is not performed in parts; 0: all.
std::vector<PlannedAgent> placed_agents(const std::vector<formats::Agent>& agents, const formats::Clip& clip,
                                        const CrowdJob& job, std::size_t max_frames)
{
    const std::size_t clip_count = 1 + job.further.size(),
                      frame_count = max_frames > 0 ? std::min(max_frames, clip.frame_count) : clip.frame_count;
    const int body = common_joint(clip, job.limbs);
    std::vector<PlannedAgent> placed;
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    for (const formats::Agent& agent : agents) {
        const auto below = [&](const char* column, double value, std::size_t count, const char* what) {
            const auto number = static_cast<std::size_t>(value);
            if (number < count) return number;
            throw formats::InputError(
                job.agents, agent.line,
                fmt::format("column {}: {} is not below {}, the number of {}", column, number, count, what));
        };
        const std::size_t which = below("clip", agent.clip, clip_count, "clips, FILE's own and crowd.clips");
        const std::size_t build =
            below("build", agent.build, job.builds.size(), "builds, which crowd.legs, arms, spine and speed make");
        const std::size_t part = build * clip_count + which;
        const ClipPart own = job.plan.clips.empty() ? ClipPart{0, frame_count, frame_count} : job.plan.clips[part];
        const std::size_t start = below("start", agent.start, own.starts, "frames that its clip can start at");
        goal_character who{};
        who.size = double{static_cast<float>(agent.size)};
        who.heading = heading_of(agent.heading_deg);
        formats::world_pose(clip, own.first + start, pose_w);
        Eigen::Vector3d stands = who.size * formats::position_of(pose_w, body);
        stands.y() = who.size * job.plan.foot.y();
        turn_with(who, stands.x(), stands.z());
        Eigen::Map<Eigen::Vector3d>(who.place) = Eigen::Vector3d(agent.x, agent.y, agent.z) - stands;
        who.start = static_cast<std::uint32_t>(start);
        placed.push_back({agent.name, who, part});
    }
    return placed;
}

// The builds of a crowd of more than one character, the clip's own first.
std::vector<Proportions> builds_of(const SolveOptions& options, const formats::CrowdFile& file,
                                   const Eigen::Vector3d& up_w, const std::vector<BodyPart>& body)
{
    std::vector<Proportions> builds(1);
    if (!file.legs && !file.arms && !file.spine && !file.speed) return builds;
    const std::pair<const formats::Maybe<formats::NumberRange>*, Proportions> asked[] = {
        {&file.legs, {0, 1, 1}}, {&file.arms, {1, 0, 1}}, {&file.spine, {1, 1, 0}}};
    for (const auto& [range, alone] : asked) {
        const std::string part = *range ? unknown_part(body, alone) : "";
        if (!part.empty())
            throw formats::InputError(
                file.path, (*range)->line,
                fmt::format("{}: no joint of the clip is known as {}; see swivel rig FILE, or take this out",
                            (*range)->key, part));
    }
    if (file.legs && up_w != Eigen::Vector3d::UnitY())
        throw formats::InputError(
            file.path, file.legs->line,
            fmt::format("{}: the figure does not stand along Y; turn the clip, or take this out", file.legs->key));
    const std::uint64_t seed = file.seed ? static_cast<std::uint64_t>(file.seed->value) : CrowdPlan().seed;
    const std::uint64_t own = options.seed.value_or(seed) ^ 0x6275696c6473u;  // unlike those that draw characters
    std::mt19937_64 random(own), speeds(~own);                                // so that speeds change no build
    const auto drawn = [](std::mt19937_64& from, const formats::Maybe<formats::NumberRange>& range) {
        return drawn_in(range ? range->value : formats::NumberRange{1, 1}, from);
    };
    for (std::size_t n = 1; n < kBuilds; ++n) {
        const double legs = drawn(random, file.legs), arms = drawn(random, file.arms),
                     spine = drawn(random, file.spine);
        const Proportions build{legs, arms, spine, drawn(speeds, file.speed)};
        if (std::ranges::find(builds, build) == builds.end()) builds.push_back(build);
    }
    return builds;
}

// Replaces the clip by the crowd's performance: looped clips, or several clips one after the other, each by figures of
// all builds. Returns the parts.
std::vector<ClipPart> perform(const SolveOptions& options, std::span<const int> joints, MotionFile& file, CrowdJob& job)
{
    const formats::Clip& clip = file.clip();
    const int body = common_joint(clip, job.limbs);
    const bool is_loop = job.crowd->loop.has_value();
    if (is_loop && options.frames > 0) job.frame_count = options.frames;
    const double slowest = std::ranges::min(job.builds, {}, &Proportions::speed).speed,
                 fastest = std::ranges::max(job.builds, {}, &Proportions::speed).speed;
    const auto goes_on = static_cast<std::size_t>(std::ceil(static_cast<double>(job.frame_count) * fastest));
    std::vector<formats::Clip> clips;
    std::vector<ClipPart> parts;
    // Adds a looped clip, long enough for all solved frames from any start in the loop; or the clip's first frames.
    const auto add = [&](const std::string& name, const formats::Clip& from) {
        const std::size_t max = options.frames > 0 ? options.frames : from.frame_count;
        const ClipLoop loop = is_loop ? job.loops.emplace_back(loop_of(*job.crowd, name, from, body)).loop : ClipLoop();
        const std::size_t first = parts.empty() ? 0 : parts.back().first + parts.back().count,
                          count = is_loop ? goes_on + loop.length() : std::min(max, from.frame_count),
                          all = static_cast<std::size_t>(static_cast<double>(job.builds.size() * (first + count)) /
                                                         slowest);
        parts.push_back({first, count, is_loop ? loop.length() : count});
        if (const double bytes = static_cast<double>(all * from.joints.size()) * 32; bytes > 0x1p33)
            throw formats::InputError(
                job.crowd->path,
                fmt::format("crowd: {} frames of {} joints take {:.1f} GiB, more than 8; give fewer --frames", all,
                            from.joints.size(), bytes / 0x1p30));
        clips.push_back(is_loop ? looped(from, body, loop, count) : frames_of(from, {0, count}));
    };
    add("the clip", clip);
    for (const formats::FurtherClip& each : job.crowd->clips) {
        const formats::Clip further = further_clip(options, each, clip, joints, job);
        add(job.further.back().words, further);
    }
    if (!is_loop) job.frame_count = parts[0].count;
    formats::Clip all = clips.size() == 1 ? std::move(clips[0]) : joined(clips, body);
    for (std::size_t build = 1; build < job.builds.size(); ++build)
        for (std::size_t n = 0; n < clips.size(); ++n)
            parts.push_back({build * all.frame_count + parts[n].first, parts[n].count, parts[n].starts});
    if (job.builds.size() > 1) all = proportioned(all, job.body, job.builds);
    if (slowest != 1 || fastest != 1) {
        std::vector<double> speeds;
        for (std::size_t n = 0; n < parts.size(); ++n) speeds.push_back(job.builds[n / clips.size()].speed);
        all = paced(all, parts, speeds, is_loop ? job.frame_count : 0);
    }
    file.replace(std::move(all));
    return parts;
}

}  // namespace

int common_joint(const formats::Clip& clip, std::span<const Limb> limbs)
{
    int body = joint_at(clip, limbs.front().upper()).parent;
    for (const Limb& limb : limbs)
        if (body >= 0) body = fork_of(clip, body, limb.upper());
    return std::max(body, 0);
}

std::string title_of(const std::string& file)
{
    return formats::is_standard_stream(file) ? "motion" : std::filesystem::path(file).filename().string();
}

std::string motion_of(const MotionFile& file, const CrowdJob& job)
{
    const std::size_t more = job.further.size();
    return file.describe() + (more > 0 ? fmt::format(", and {} more", counted(more, "clip")) : "");
}

LimbChoice choice_of(const SolveOptions& options)
{
    LimbChoice choice;
    choice.kinds = options.kinds;
    if (!options.kinds.empty()) choice.kinds_source = {"--limbs"};
    for (const std::string& arm : options.arms) choice.arms.push_back(limb_of_option(arm, "--arm"));
    for (const std::string& leg : options.legs) choice.legs.push_back(limb_of_option(leg, "--leg"));
    require_named_limbs_solved(choice);
    return choice;
}

CrowdJob make_job(const SolveOptions& options, LimbChoice choice, MotionFile& file)
{
    CrowdJob job;
    std::vector<formats::Agent> agents;
    std::uint32_t characters = 1;  // unless an option says otherwise
    if (!options.crowd.empty()) {
        job.crowd = formats::read_crowd_file(options.crowd);
        add_choice(*job.crowd, choice);
        require_named_limbs_solved(choice);
        job.agents = named_file(*job.crowd, job.crowd->agents);
        if (job.crowd->characters) characters = static_cast<std::uint32_t>(job.crowd->characters->value);
        agents = read_agents(options, job.agents);
        if (!agents.empty()) characters = static_cast<std::uint32_t>(agents.size());
    }
    out_kind(options.out, options.characters.value_or(characters), !agents.empty());  // before any work
    const formats::Clip& clip = file.clip();
    const FigureJoints joints = file.find_limbs(choice);
    LimbSearch search = bind_limbs(clip, joints, choice);
    job.limbs = require_limbs(search, options.file);
    const Eigen::Vector3d up_w = nearest_axis(search.facing.up_w), &forwards_w = search.facing.forwards_w;
    job.body = body_of(clip, options.file, joints, named_head(job));
    job.faces_w = (forwards_w - forwards_w.dot(up_w) * up_w).normalized();
    for (LimbFinding& finding : search.findings)
        if (!finding.limb) job.missing.push_back(std::move(finding));
    job.frame_count = job.clip_frames = clip.frame_count;
    std::vector<ClipPart> parts;
    const bool is_crowd = !agents.empty() || options.characters.value_or(characters) > 1;
    if (job.crowd && is_crowd) job.builds = builds_of(options, *job.crowd, up_w, job.body);
    if (job.crowd && (job.crowd->loop || !job.crowd->clips.empty() || job.builds.size() > 1))
        parts = perform(options, joints_of(joints), file, job);
    if (!job.further.empty()) job.limbs = require_limbs(bind_limbs(clip, joints, choice), options.file);  // in all
    if (job.crowd) put_holding_last(*job.crowd, job.limbs);
    job.plan = plan_crowd(job.crowd ? &*job.crowd : nullptr, clip, job.limbs);
    const std::size_t last = job.further.size();  // of the clip's own figure
    job.plan.foot = foot_of(clip, parts.empty() ? clip.frame_count : parts[last].first + parts[last].count);
    job.plan.clips = std::move(parts);
    job.plan.agents = placed_agents(agents, clip, job, options.frames);
    if (job.plan.has_headings() && up_w != Eigen::Vector3d::UnitY())
        throw formats::InputError(job.crowd->path,
                                  "crowd: agents and headings need Y up, and the figure does not stand along Y; turn "
                                  "the clip, or take agents and heading_deg out");
    if (job.crowd && job.crowd->ground) {
        stand_on_ground(*job.crowd, clip, job.limbs, {search.facing.up_w, carrier_of(clip, joints)},
                        {job.loops.empty() ? 0 : job.loops[0].loop.first, job.clip_frames}, job.plan);
        job.heights = named_file(*job.crowd, job.crowd->ground->heights);
        job.contacts = named_file(*job.crowd, job.crowd->ground->contacts);
    }
    if (job.crowd && job.crowd->look) job.plan.look = look_of(*job.crowd, clip, job);
    if (job.crowd && job.crowd->carry) job.plan.carry = carry_of(*job.crowd, clip, up_w, job);
    job.plan.characters = options.characters.value_or(characters);
    if (clip.frame_time == 0 && job.plan.characters > 1)
        throw formats::InputError(options.file,
                                  "its keys lie at uneven times, and the characters of a crowd start at "
                                  "different frames; give --fps");
    if (options.seed) job.plan.seed = *options.seed;
    job.targets = options.targets ? *options.targets : job.crowd ? checked_targets(*job.crowd) : "clip";
    require_one_reader(options, job.targets);
    job.given.emplace(job.targets, between_of(options, job.targets), job.frame_count, job.limbs, job.plan);
    if (job.plan.clips.empty() && options.frames > 0 && options.frames < clip.frame_count) {
        file.cut(options.frames);
        job.frame_count = options.frames;
    }
    return job;
}

}  // namespace swivel::tools
