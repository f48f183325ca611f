// SPDX-License-Identifier: MIT
//
// What feet that stand and hands that hold add to a body: the limbs of 512 of character B, in cache. The legs first
// have a target and a rotation of each foot; then they are planted, of which each third is in contact; then they get a
// cap, a shift of the body, and ground. The arms have targets; then the left hand holds the right one; then both hold a
// prop. At last come all.
#include <algorithm>

#include "bench/body_pose.h"
#include "bench/suite.h"

namespace bench {

namespace {

constexpr std::size_t kBodies = 512;
constexpr swivel_features kEvery = SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING,
                          kFitted = SWIVEL_WITH_PLANT | SWIVEL_WITH_CAP | SWIVEL_WITH_PELVIS_FIT,
                          kGrounded = kFitted | SWIVEL_WITH_GROUND;
enum class Hold { nothing, hand, prop };
struct Cast {
    const char* name;
    bool has_arms, has_legs;
    swivel_features legs;
    Hold hold;
};
constexpr Cast kCasts[] = {
    {"goals", false, true, 0, Hold::nothing},
    {"planted", false, true, SWIVEL_WITH_PLANT, Hold::nothing},
    {"capped", false, true, SWIVEL_WITH_PLANT | SWIVEL_WITH_CAP, Hold::nothing},
    {"fitted", false, true, kFitted, Hold::nothing},
    {"grounded", false, true, kGrounded, Hold::nothing},
    {"arms", true, false, 0, Hold::nothing},
    {"linked", true, false, 0, Hold::hand},
    {"prop", true, false, 0, Hold::prop},
    {"all", true, true, kGrounded, Hold::hand},
    {"all_with_prop", true, true, kGrounded, Hold::prop},
};

struct Walkers {
    std::vector<BodyCharacter> bodies = random_bodies(kBodies), results = bodies;
    float time = 1.0f / 60;
    swivel_pose pose = body_pose(bodies[0], results[0], sizeof(BodyCharacter), time);
    std::array<std::uint32_t, kBodyLimbs> group = {};  // of each limb
    swivel::Crowd crowd;

    explicit Walkers(const Cast& cast) : crowd(make(cast))
    {
        if (cast.has_arms) write_arms(cast.hold);
        if (cast.has_legs) write_legs(cast.legs);
    }

private:
    swivel::Crowd make(const Cast& cast)
    {
        const auto joints = body_limbs();
        std::vector<swivel_body_limb_def> limbs;
        for (std::size_t limb = 0; limb < kBodyLimbs; ++limb) {
            const bool is_leg = limb >= 2;
            if (!(is_leg ? cast.has_legs : cast.has_arms)) continue;
            const bool is_linked = !is_leg && (cast.hold == Hold::prop || (cast.hold == Hold::hand && limb == 0));
            group[limb] = static_cast<std::uint32_t>(limbs.size());
            limbs.push_back(swivel::body_limb(joints[limb], kEvery | (is_leg      ? cast.legs | SWIVEL_WITH_EFFECTOR
                                                                      : is_linked ? SWIVEL_WITH_LINK
                                                                                  : 0)));
            limbs.back().ground.heel[1] = -0.05f;
        }
        if (cast.hold == Hold::hand) {  // the leader first
            std::swap(limbs[0], limbs[1]);
            std::swap(group[0], group[1]);
            limbs[1].link = 0;
        }
        if (cast.hold == Hold::prop) limbs[0].link = limbs[1].link = static_cast<std::uint32_t>(limbs.size());
        std::vector<swivel::Definition> groups(limbs.begin(), limbs.end());
        if (cast.hold == Hold::prop) groups.push_back(swivel_default_prop_def());
        if (cast.legs & SWIVEL_WITH_PELVIS_FIT) groups.push_back(swivel_default_shift_def());
        return swivel::Crowd(body_skeleton(), kBodies, groups);
    }
    void write_goals(std::size_t limb)
    {
        const BodyGoal& goal = bodies[0].goals[limb];
        const swivel_in targets{goal.target, sizeof(BodyCharacter)}, hands{goal.hand, sizeof(BodyCharacter)};
        swivel::check(swivel_write(crowd.get(), SWIVEL_TARGET, group[limb], 0, kBodies, targets));
        swivel::check(swivel_write(crowd.get(), SWIVEL_HAND, group[limb], 0, kBodies, hands));
    }
    void write_arms(Hold hold)
    {
        for (std::size_t arm = 0; arm < 2; ++arm) {
            if (hold != Hold::prop && !(hold == Hold::hand && arm == 0)) write_goals(arm);
            if (hold != Hold::nothing && arm == 0)
                crowd.write_all(SWIVEL_GRIP, group[arm], std::array{0.05f, 0.0f, 0.3f, 0.0f, 0.0f, 0.0f, 1.0f});
        }
    }
    void write_legs(swivel_features features)
    {
        for (std::size_t leg = 0; leg < 2; ++leg) {
            const std::uint32_t g = group[2 + leg];
            crowd.write_all(SWIVEL_EFFECTOR, g, std::array{0.0f, -0.05f, 0.1f});
            if (!(features & SWIVEL_WITH_PLANT)) {
                write_goals(2 + leg);
                continue;
            }
            std::vector<float> contact(kBodies);
            for (std::size_t n = 0; n < kBodies; ++n) contact[n] = n % 3 == leg ? 1.0f : 0.0f;
            crowd.write(SWIVEL_CONTACT, g, contact);
            if (!(features & SWIVEL_WITH_GROUND)) continue;
            std::vector<std::array<float, 3>> grounds(kBodies);
            for (std::size_t n = 0; n < kBodies; ++n) std::ranges::copy(bodies[n].root_place, grounds[n].begin());
            crowd.write(SWIVEL_GROUND, g, grounds);
            crowd.write_all(SWIVEL_GROUND_NORMAL, g, std::array{0.1f, 1.0f, 0.2f});
        }
    }
};

}  // namespace

void add_feet(Suite& suite)
{
    for (const std::string& isa : suite.isas)
        for (const Cast& cast : kCasts)
            add("feet/" + isa + "/" + cast.name, kBodies, Clock::cpu, [isa, &cast]() -> Work {
                swivel::check(swivel_use_isa(isa.c_str()));
                const auto walkers = std::make_shared<Walkers>(cast);
                return [walkers] { walkers->crowd.solve({.on_this_thread = true, .pose = &walkers->pose}); };
            });
}

}  // namespace bench
