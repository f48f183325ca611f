// SPDX-License-Identifier: MIT
//
// What a look adds to a body: the arms of 512 of character B, in cache, first alone, then below a spine, chest, neck
// and head that follow a target.
#include "bench/body_look.h"
#include "bench/suite.h"

namespace bench {

namespace {

constexpr std::size_t kBodies = 512, kArms = 2;
struct Lookers {
    std::vector<BodyCharacter> bodies = random_bodies(kBodies), results = bodies;
    float time = 1.0f / 60;
    swivel_pose pose = body_pose(bodies[0], results[0], sizeof(BodyCharacter), time);
    swivel::Crowd crowd;

    explicit Lookers(bool look) : crowd(make(look))
    {
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
        const auto joints = body_limbs();
        std::vector<swivel::Definition> groups;
        for (std::size_t arm = 0; arm < kArms; ++arm)
            groups.push_back(swivel::body_limb(joints[arm], SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING));
        if (look) groups.push_back(body_look());
        return swivel::Crowd(body_skeleton(), kBodies, groups);
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
