// SPDX-License-Identifier: MIT
//
// Character B: 4,096 bodies, poses as an array of structures, in place. Each of its four limbs has a target and a hand
// or foot. Beside it is the same on glm, one body at a time. Parts of the job tell what its stages take. Last come two
// threads.
#include "bench/body_pose.h"
#include "bench/rivals/level.h"
#include "bench/suite.h"

namespace bench {

namespace {

constexpr std::size_t kBodies = 4096;
constexpr std::uint32_t kThreads = 2;

// A crowd of them, whose goals are read from the characters, too.
class BodyCrowd {
public:
    explicit BodyCrowd(std::size_t count) : bodies(random_bodies(count)), crowd_(make(count))
    {
        pose_.rotations = {bodies[0].rotations, sizeof(BodyCharacter), sizeof bodies[0].rotations[0], nullptr};
        pose_.root_position = {bodies[0].root_place, sizeof(BodyCharacter)};
        pose_.root_rotation = {bodies[0].root_rotation, sizeof(BodyCharacter)};
    }
    swivel::Crowd& crowd() { return crowd_; }
    swivel::Job job() const
    {
        return {.streams = {frames_.begin(), frames_.end()}, .on_this_thread = true, .pose = &pose_};
    }

    std::vector<BodyCharacter> bodies;

private:
    swivel::Crowd make(std::size_t count)
    {
        const swivel_skeleton skeleton = body_skeleton();
        const auto joints = body_limbs();
        std::array<swivel_body_limb_def, kBodyLimbs> limbs;
        std::array<swivel_group_def, kBodyLimbs> groups;
        for (std::size_t limb = 0; limb < kBodyLimbs; ++limb) {
            limbs[limb] = swivel::body_limb(joints[limb], SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING);
            groups[limb] = swivel_default_group_def();
            groups[limb].body_limb = &limbs[limb];
            BodyGoal& goal = bodies[0].goals[limb];
            fields_[limb] = {
                {{SWIVEL_TARGET, goal.target, sizeof(BodyCharacter)}, {SWIVEL_HAND, goal.hand, sizeof(BodyCharacter)}}};
            frames_[limb] = swivel_default_streams();
            frames_[limb].fields = fields_[limb].data();
            frames_[limb].field_count = static_cast<std::uint32_t>(fields_[limb].size());
        }
        swivel_crowd_def def = swivel_default_crowd_def();
        def.skeleton = &skeleton;
        def.body_count = static_cast<std::uint32_t>(count);
        def.groups = groups.data();
        def.group_count = static_cast<std::uint32_t>(groups.size());
        def.workspace_count = kThreads;
        return swivel::Crowd(def);
    }

    std::array<std::array<swivel_stream, 2>, kBodyLimbs> fields_;
    std::array<swivel_streams, kBodyLimbs> frames_;
    swivel_pose pose_ = swivel_default_pose();
    swivel::Crowd crowd_;
};
using SharedCrowd = std::shared_ptr<BodyCrowd>;

void add_job(const std::string& name, const std::string& isa, const SharedCrowd& crowd, const swivel::Job& job,
             Notes notes = {})
{
    add(
        name, kBodies, Clock::cpu,
        [=]() -> Work {
            swivel::check(swivel_use_isa(isa.c_str()));
            return [=] { crowd->crowd().solve(job); };
        },
        std::move(notes));
}

void add_swivel(const Suite& suite, const SharedCrowd& crowd)
{
    for (const std::string& isa : suite.isas) {
        swivel::check(swivel_use_isa(isa.c_str()));
        crowd->crowd().solve(crowd->job());
        add_job("bodies/" + isa, isa, crowd, crowd->job(), checked("bodies/" + isa, worst_miss(crowd->bodies)));
    }
    // Without the other limbs; and with goals that lie in rows, where earlier jobs have left them.
    static constexpr std::array first_limb = {0u};
    swivel::Job one_limb = crowd->job(), from_rows = crowd->job();
    one_limb.groups = first_limb;
    one_limb.streams.resize(1);
    from_rows.streams.clear();
    add_job("bodies_one_limb/" + suite.best_isa(), suite.best_isa(), crowd, one_limb);
    add_job("bodies_from_rows/" + suite.best_isa(), suite.best_isa(), crowd, from_rows);
}

void add_glm()
{
    for (const Level* const level : runnable_levels()) {
        const auto bodies = std::make_shared<std::vector<BodyCharacter>>(random_bodies(kBodies));
        level->solve_bodies(bodies->data(), kBodies);
        const std::string name = std::string("bodies_glm/") + level->name;
        add(
            name, kBodies, Clock::cpu, [=]() -> Work { return [=] { level->solve_bodies(bodies->data(), kBodies); }; },
            checked(name, worst_miss(*bodies)));
    }
}

void add_two(const Suite& suite)
{
    add("bodies_threads/2", kThreads * kBodies, Clock::wall, [isa = suite.best_isa()]() -> Work {
        swivel::check(swivel_use_isa(isa.c_str()));
        const auto crowd = std::make_shared<BodyCrowd>(kThreads * kBodies);
        swivel::Job job = crowd->job();
        job.on_this_thread = false;
        return [crowd, solve = solve_on(kThreads, crowd->crowd(), job)] { solve(); };
    });
}

}  // namespace

void add_bodies(Suite& suite)
{
    add_swivel(suite, std::make_shared<BodyCrowd>(kBodies));
    add_glm();
    if (core_count() >= 2) add_two(suite);
}

}  // namespace bench
