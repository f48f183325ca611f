// SPDX-License-Identifier: MIT
//
// Character B: 4,096 bodies, poses as an array of structures, in place. Each of its four limbs has a target and a hand
// or foot. Beside it the same on glm, one body at a time, and a copy of the same bytes.
#include <algorithm>

#include "bench/rivals/bodies.h"
#include "bench/rivals/level.h"
#include "bench/suite.h"

namespace bench {

namespace {

constexpr std::size_t kBodies = 4096;

// A crowd of them, whose goals are read from the characters, too.
class BodyCrowd {
public:
    explicit BodyCrowd(std::size_t count) : bodies(random_bodies(count)), crowd_(make(count)) {}
    void solve()
    {
        pose_.rotations = {bodies[0].rotations, sizeof(BodyCharacter), sizeof bodies[0].rotations[0], nullptr};
        pose_.root_position = {bodies[0].root_place, sizeof(BodyCharacter)};
        pose_.root_rotation = {bodies[0].root_rotation, sizeof(BodyCharacter)};
        crowd_.solve({.frames = frames_, .on_this_thread = true, .pose = &pose_});
    }

    std::vector<BodyCharacter> bodies;

private:
    swivel::Crowd make(std::size_t count)
    {
        swivel_skeleton skeleton = swivel_default_skeleton();
        skeleton.parents = {kBodyParents, sizeof kBodyParents[0]};
        skeleton.translations = {kBodyOffsets, sizeof kBodyOffsets[0]};
        skeleton.joint_count = kBodyJoints;
        std::array<swivel_limb_joints, kBodyLimbs> joints;
        std::vector<swivel_group_def> groups;
        for (std::size_t limb = 0; limb < kBodyLimbs; ++limb) {
            const BodyChain& chain = kBodyChains[limb];
            joints[limb] = swivel_default_limb_joints(chain.first, chain.middle, chain.last);
            std::ranges::copy(chain.bend, joints[limb].bend);
            groups.push_back(swivel::body_group(joints[limb], SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING));
            BodyGoal& goal = bodies[0].goals[limb];
            fields_[limb] = {
                {{SWIVEL_TARGET, goal.target, sizeof(BodyCharacter)}, {SWIVEL_HAND, goal.hand, sizeof(BodyCharacter)}}};
            frames_[limb] = swivel_default_frame();
            frames_[limb].fields = fields_[limb].data();
            frames_[limb].field_count = static_cast<std::uint32_t>(fields_[limb].size());
        }
        return swivel::Crowd(skeleton, static_cast<std::uint32_t>(count), groups);
    }

    std::array<std::array<swivel_frame_field, 2>, kBodyLimbs> fields_;
    std::array<swivel_frame, kBodyLimbs> frames_;
    swivel_pose pose_ = swivel_default_pose();
    swivel::Crowd crowd_;
};

}  // namespace

void add_bodies(Suite& suite)
{
    const auto crowd = std::make_shared<BodyCrowd>(kBodies);
    for (const std::string& isa : suite.isas) {
        swivel::check(swivel_use_isa(isa.c_str()));
        crowd->solve();
        add(
            "bodies/" + isa, kBodies, Clock::cpu,
            [=]() -> Work {
                swivel::check(swivel_use_isa(isa.c_str()));
                return [crowd] { crowd->solve(); };
            },
            checked("bodies/" + isa, worst_miss(crowd->bodies)));
    }
    for (const Level* const level : runnable_levels()) {
        const auto bodies = std::make_shared<std::vector<BodyCharacter>>(random_bodies(kBodies));
        level->solve_bodies(bodies->data(), kBodies);
        const std::string name = std::string("bodies_glm/") + level->name;
        add(
            name, kBodies, Clock::cpu, [=]() -> Work { return [=] { level->solve_bodies(bodies->data(), kBodies); }; },
            checked(name, worst_miss(*bodies)));
    }
    const auto copies = std::make_shared<std::vector<BodyCharacter>>(crowd->bodies);
    add("bodies/copy", kBodies, Clock::cpu,
        [=]() -> Work { return [=] { std::ranges::copy(crowd->bodies, copies->begin()); }; });
}

}  // namespace bench
