// SPDX-License-Identifier: MIT
//
// What feet that stand add to a body: the legs of 512 of character B, in cache. First with a target and a rotation of
// each foot; then planted, of which each third is in contact; then with a shift of the body for them, too.
#include <algorithm>

#include "bench/rivals/bodies.h"
#include "bench/suite.h"

namespace bench {

namespace {

constexpr std::size_t kBodies = 512;

struct Walkers {
    std::vector<BodyCharacter> bodies = random_bodies(kBodies), results = bodies;
    float time = 1.0f / 60;
    swivel_pose pose = swivel_default_pose();
    swivel::Crowd crowd;

    explicit Walkers(swivel_features features) : crowd(make(features))
    {
        pose.rotations = {bodies[0].rotations, sizeof(BodyCharacter), sizeof bodies[0].rotations[0], nullptr};
        pose.results = {results[0].rotations, sizeof(BodyCharacter), sizeof results[0].rotations[0], nullptr};
        pose.root_position = {bodies[0].root_place, sizeof(BodyCharacter)};
        pose.root_rotation = {bodies[0].root_rotation, sizeof(BodyCharacter)};
        pose.time = {&time, 0};
        for (std::uint32_t leg = 0; leg < 2; ++leg) {
            const BodyGoal& goal = bodies[0].goals[2 + leg];
            const swivel_in targets{goal.target, sizeof(BodyCharacter)}, feet{goal.hand, sizeof(BodyCharacter)};
            crowd.write_all(SWIVEL_EFFECTOR, leg, std::array{0.0f, -0.05f, 0.1f});
            if (!(features & SWIVEL_WITH_PLANT)) {
                swivel::check(swivel_write(crowd.get(), SWIVEL_TARGET, leg, 0, kBodies, targets));
                swivel::check(swivel_write(crowd.get(), SWIVEL_HAND, leg, 0, kBodies, feet));
                continue;
            }
            std::vector<float> contact(kBodies);
            for (std::size_t n = 0; n < kBodies; ++n) contact[n] = n % 3 == leg ? 1.0f : 0.0f;
            crowd.write(SWIVEL_CONTACT, leg, contact);
        }
    }

private:
    swivel::Crowd make(swivel_features features)
    {
        swivel_skeleton skeleton = swivel_default_skeleton();
        skeleton.parents = {kBodyParents, sizeof kBodyParents[0]};
        skeleton.translations = {kBodyOffsets, sizeof kBodyOffsets[0]};
        skeleton.joint_count = kBodyJoints;
        std::array<swivel_limb_joints, 2> legs;
        std::vector<swivel_group_def> groups;
        for (std::size_t leg = 0; leg < 2; ++leg) {
            const BodyChain& chain = kBodyChains[2 + leg];
            legs[leg] = swivel_default_limb_joints(chain.first, chain.middle, chain.last);
            std::ranges::copy(chain.bend, legs[leg].bend);
            groups.push_back(swivel::body_group(
                legs[leg], features | SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_POLE_INCOMING));
        }
        if (features & SWIVEL_WITH_FIT) groups.push_back(swivel::fit_group());
        return swivel::Crowd(skeleton, kBodies, groups);
    }
};

}  // namespace

void add_feet(Suite& suite)
{
    const std::pair<const char*, swivel_features> jobs[] = {
        {"goals", 0},
        {"planted", SWIVEL_WITH_PLANT},
        {"capped", SWIVEL_WITH_PLANT | SWIVEL_WITH_CAP},
        {"fitted", SWIVEL_WITH_PLANT | SWIVEL_WITH_CAP | SWIVEL_WITH_FIT},
    };
    for (const std::string& isa : suite.isas)
        for (const auto& [name, features] : jobs)
            add("feet/" + isa + "/" + name, kBodies, Clock::cpu, [isa, features = features]() -> Work {
                swivel::check(swivel_use_isa(isa.c_str()));
                const auto walkers = std::make_shared<Walkers>(features);
                return [walkers] { walkers->crowd.solve({.on_this_thread = true, .pose = &walkers->pose}); };
            });
}

}  // namespace bench
