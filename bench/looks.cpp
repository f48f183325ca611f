// SPDX-License-Identifier: MIT
//
// What a look adds to a body: the arms of 512 of character B, in cache, first alone, then below a spine, chest, neck
// and head that follow a target.
#include "bench/rivals/bodies.h"
#include "bench/suite.h"

namespace bench {

namespace {

constexpr std::size_t kBodies = 512, kArms = 2;
constexpr std::uint32_t kChain[] = {2, 3, 4, 5};
constexpr float kShares[] = {1, 1, 2, 4}, kMost[] = {0.97f, 0.94f, 0.8f, 0.5f};

swivel_group_def look_group()
{
    swivel_group_def def = swivel_default_group_def(0);
    def.features = SWIVEL_LOOK;
    def.look.joint_count = static_cast<std::uint32_t>(std::size(kChain));
    std::ranges::copy(kChain, def.look.joints);
    std::ranges::copy(kShares, def.look.share);
    std::ranges::copy(kMost, def.look.cos_most);
    def.look.eye[1] = 0.08f, def.look.eye[2] = 0.1f;
    return def;
}

struct Lookers {
    std::vector<BodyCharacter> bodies = random_bodies(kBodies), results = bodies;
    float time = 1.0f / 60;
    swivel_pose pose = swivel_default_pose();
    swivel::Crowd crowd;

    explicit Lookers(bool look) : crowd(make(look))
    {
        pose.rotations = {bodies[0].rotations, sizeof(BodyCharacter), sizeof bodies[0].rotations[0], nullptr};
        pose.results = {results[0].rotations, sizeof(BodyCharacter), sizeof results[0].rotations[0], nullptr};
        pose.root_position = {bodies[0].root_place, sizeof(BodyCharacter)};
        pose.root_rotation = {bodies[0].root_rotation, sizeof(BodyCharacter)};
        pose.time = {&time, 0};
        const auto write = [&](swivel_field field, std::uint32_t group, const float* values) {
            swivel::check(swivel_write(crowd.get(), field, group, 0, kBodies, {values, sizeof(BodyCharacter)}));
        };
        for (std::uint32_t arm = 0; arm < kArms; ++arm) {
            write(SWIVEL_TARGET, arm, bodies[0].goals[arm].target);
            write(SWIVEL_HAND, arm, bodies[0].goals[arm].hand);
        }
        // They look at one of their hands' goals.
        if (look) write(SWIVEL_LOOK_TARGET, kArms, bodies[0].goals[0].target);
    }

private:
    static swivel::Crowd make(bool look)
    {
        swivel_skeleton skeleton = swivel_default_skeleton();
        skeleton.parents = {kBodyParents, sizeof kBodyParents[0]};
        skeleton.translations = {kBodyOffsets, sizeof kBodyOffsets[0]};
        skeleton.joint_count = kBodyJoints;
        std::array<swivel_limb_joints, kArms> joints;
        std::vector<swivel_group_def> groups;
        for (std::size_t arm = 0; arm < kArms; ++arm) {
            const BodyChain& chain = kBodyChains[arm];
            joints[arm] = swivel_default_limb_joints(chain.first, chain.middle, chain.last);
            std::ranges::copy(chain.bend, joints[arm].bend);
            groups.push_back(swivel::body_group(joints[arm], SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING));
        }
        if (look) groups.push_back(look_group());
        return swivel::Crowd(skeleton, kBodies, groups);
    }
};

}  // namespace

void add_looks(Suite& suite)
{
    for (const std::string& isa : suite.isas)
        for (const bool look : {false, true})
            add("looks/" + isa + (look ? "/look" : "/arms"), kBodies, Clock::cpu, [isa, look]() -> Work {
                swivel::check(swivel_use_isa(isa.c_str()));
                const auto lookers = std::make_shared<Lookers>(look);
                return [lookers] { lookers->crowd.solve({.on_this_thread = true, .pose = &lookers->pose}); };
            });
}

}  // namespace bench
