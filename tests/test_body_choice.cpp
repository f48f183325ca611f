// SPDX-License-Identifier: MIT
//
// The promise: bodies that a job chooses, by whatever, get the bits of a solve of all. Of others no byte of a pose or
// of a frame is read or written: their memory is locked away meanwhile. So are no other groups' joints written.
#include <sys/mman.h>

#include <catch2/catch.hpp>

#include <cstring>
#include <set>

#include "tests/body_stage.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::size_t kPage = 4096, kTargetsAt = 4000;  // of each body; what lies between is a pattern

PoseLayout paged(const BodyStage& stage)
{
    PoseLayout layout = layout_of(SWIVEL_ROTATIONS);
    layout.gap = kPage - PoseBuffer(layout, stage.bodies).body_stride;
    return layout;
}

// Poses and targets of bodies, each body's on a page of its own.
struct Pages {
    const BodyStage& stage;
    PoseBuffer poses;
    char* const first;

    explicit Pages(const BodyStage& of)
        : stage(of),
          poses(paged(of), of.bodies),
          first(static_cast<char*>(
              mmap(nullptr, poses.bytes.size(), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)))
    {
        REQUIRE(first != MAP_FAILED);
        for (std::size_t n = 0; n < kStageBodies; ++n)
            for (std::size_t g = 0; g < stage.goals.size(); ++g)
                std::memcpy(&poses.bytes[n * kPage + kTargetsAt + g * sizeof(Float3)], &stage.goals[g][n].target,
                            sizeof(Float3));
        std::memcpy(first, poses.bytes.data(), poses.bytes.size());
    }
    ~Pages() { munmap(first, poses.bytes.size()); }
    Pages(const Pages&) = delete;
    Pages& operator=(const Pages&) = delete;

    void lock(std::size_t body) const { REQUIRE(mprotect(first + body * kPage, kPage, PROT_NONE) == 0); }
    void unlock() const { REQUIRE(mprotect(first, poses.bytes.size(), PROT_READ | PROT_WRITE) == 0); }
    std::string page(std::size_t body) const { return {first + body * kPage, kPage}; }

    swivel_pose view()
    {
        swivel_pose pose = poses.view();
        const auto move = [&](auto& values) {
            values.data =
                first + (static_cast<const char*>(values.data) - reinterpret_cast<const char*>(poses.bytes.data()));
        };
        move(pose.rotations), move(pose.translations), move(pose.scales);
        move(pose.root_position), move(pose.root_rotation), move(pose.root_scale);
        return pose;
    }
    // Of these groups, in the crowd's order.
    std::vector<Frame> frames(const std::vector<std::uint32_t>& groups) const
    {
        std::vector<Frame> frames(groups.size());
        for (std::size_t n = 0; n < groups.size(); ++n)
            frames[n].in(SWIVEL_TARGET, swivel_in{first + kTargetsAt + groups[n] * sizeof(Float3), kPage});
        return frames;
    }
};

// What the rows have of a limb's results.
std::vector<std::uint32_t> result_words(const Crowd& crowd, std::uint32_t group, std::uint32_t limb)
{
    std::vector<std::uint32_t> words;
    swivel_field_info info;
    for (std::uint32_t f = 0; swivel_describe_field(f, &info); ++f) {
        const std::uint32_t count = swivel_component_count(info.field, swivel_group_features(crowd.get(), group));
        if (info.kind == SWIVEL_FIELD_INPUT || count == 0) continue;
        words.resize(words.size() + count);
        check(swivel_read(crowd.get(), info.field, group, limb, 1, {&words[words.size() - count], count * 4}));
    }
    return words;
}

// Solves a job for these bodies, and compares it with a solve of all.
void solve_chosen(const BodyStage& stage, Job job, const std::set<std::uint32_t>& chosen,
                  const std::vector<std::uint32_t>& groups)
{
    Pages all(stage), some(stage);
    const Crowd untouched = stage.crowd();
    Crowd whole = stage.crowd(), part = stage.crowd();
    const swivel_pose whole_pose = all.view(), pose = some.view();
    const std::vector<Frame> frames = some.frames(groups);
    whole.solve({.pose = &whole_pose});
    job.pose = &pose;
    job.frames = frames;
    for (std::uint32_t n = 0; n < kStageBodies; ++n)
        if (!chosen.contains(n)) some.lock(n);
    const std::uint32_t solved = part.solve(job);
    some.unlock();
    REQUIRE(solved == chosen.size());
    for (std::uint32_t n = 0; n < kStageBodies; ++n) {
        std::string expected = Pages(stage).page(n);
        for (std::uint32_t g = 0; g < stage.goals.size(); ++g) {
            const bool is_solved = chosen.contains(n) && std::ranges::find(groups, g) != groups.end();
            REQUIRE(result_words(part, g, n) == result_words(is_solved ? whole : untouched, g, n));
            const BodyLimbJoints& limb = stage.skeleton.limbs[g];
            for (const std::uint32_t joint : {limb.shoulder, limb.elbow, limb.wrist})
                if (is_solved) expected.replace(joint * 16, 16, all.page(n), joint * 16, 16);
        }
        REQUIRE(some.page(n) == expected);
    }
}

}  // namespace

TEST_CASE("bodies that are not chosen are neither read nor written, others are solved as all are")
{
    const BodyStage stage(11);
    const std::vector<std::uint32_t> groups =
        GENERATE(std::vector<std::uint32_t>{0, 1, 2}, std::vector<std::uint32_t>{0, 2});
    Job job;
    job.groups = groups;
    Random random{12};
    std::set<std::uint32_t> chosen;
    std::vector<std::uint32_t> mask(5), list;
    for (std::uint32_t n = 0; n < kStageBodies; ++n)
        if (random.below(3) == 0 && n / 16 != 4) {
            chosen.insert(n);
            mask[n / 32] |= 1u << n % 32;
            list.insert(list.begin() + random.below(static_cast<std::uint32_t>(list.size()) + 1), n);
        }
    SECTION("by a mask")
    {
        job.mask = mask;
        solve_chosen(stage, job, chosen, groups);
        job.blocks = swivel_blocks{3, 4};
        job.on_this_thread = true;
        std::erase_if(chosen, [](std::uint32_t n) { return n < 48 || n >= 112; });
        solve_chosen(stage, job, chosen, groups);
    }
    SECTION("by a list")
    {
        job.limbs = list;
        solve_chosen(stage, job, chosen, groups);
    }
    SECTION("by priorities")
    {
        if (groups.size() < 3) return;  // priorities are of all groups
        job.groups = everything;
        std::vector<float> priorities(kStageBodies);
        for (const std::uint32_t n : {5u, 90u, 149u}) priorities[n] = 1;  // the last block is not full
        job.priorities = swivel_in{priorities.data(), sizeof(float)};
        job.most_blocks = 5;
        std::set<std::uint32_t> in_blocks;
        for (std::uint32_t n = 0; n < kStageBodies; ++n)
            if (n / 16 == 0 || n / 16 == 5 || n / 16 == 9) in_blocks.insert(n);
        solve_chosen(stage, job, in_blocks, groups);
    }
}

TEST_CASE("joints of a group that is not named are where they come")
{
    const BodyStage stage(13);
    PoseLayout layout = layout_of(SWIVEL_ROTATIONS);
    layout.in_body = GENERATE(true, false) ? &stage.skeleton : nullptr;
    PoseBuffer poses(layout, stage.bodies);
    std::vector<Float3> places(kStageBodies * poses.joint_count);
    std::vector<Float4> rotations(places.size());
    swivel_pose pose = poses.view();
    pose.joint_places = {places.data(), poses.joint_count * sizeof(Float3), sizeof(Float3), nullptr};
    pose.joint_rotations = {rotations.data(), poses.joint_count * sizeof(Float4), sizeof(Float4), nullptr};
    constexpr std::array<std::uint32_t, 2> named = {0, 2};
    Crowd crowd = stage.crowd();
    crowd.solve({.groups = named, .pose = &pose});
    for (std::uint32_t n = 0; n < kStageBodies; ++n) {
        Body body = poses.read(n, stage.bodies[n]);
        body.root_rotation = {0, 0, 0, 1}, body.root_scale = 1;
        const std::vector<JointAt> at = joints_at(stage.skeleton, body);
        for (const BodyLimbJoints& limb : stage.skeleton.limbs) {
            const std::size_t wrist = n * poses.joint_count + limb.wrist;
            REQUIRE((vec(places[wrist]) - at[limb.wrist].place).norm() <= 1e-5);
            REQUIRE(std::fabs(quat(rotations[wrist]).norm() - 1) <= 1e-5);
            REQUIRE(quat(rotations[wrist]).angularDistance(at[limb.wrist].rotation) <= 1e-5);
        }
    }
}
