// SPDX-License-Identifier: MIT
//
// Character C from pose to pose: 512 of them, in cache, and as few as one and more than the caches hold. Beside all of
// it are its legs, look and arms alone, what saving and loading its state takes, and the same on glm, one character at
// a time.
#include "bench/body_look.h"
#include "bench/rivals/level.h"
#include "bench/rivals/rifle.h"
#include "bench/suite.h"

namespace bench {

namespace {

constexpr std::size_t kCharacters = 512, kOtherCounts[] = {1, 4, 8, 16, 64, 16384};
constexpr swivel_features kEvery = SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING,
                          kLeg = kEvery | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_PLANT | SWIVEL_WITH_CAP |
                                 SWIVEL_WITH_PELVIS_FIT | SWIVEL_WITH_GROUND,
                          kRifle = kEvery | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_FLEXION_LIMIT | SWIVEL_WITH_REGION;

struct Parts {
    const char* name;
    bool legs, look, arms;
};
constexpr Parts kParts[] = {{"legs", true, false, false},
                            {"look", false, true, false},
                            {"arms", false, false, true},
                            {"all", true, true, true}};

class Played {
public:
    Played(const Parts& parts, std::size_t count)
        : given(random_characters(count)), solved(given), crowd_(make(parts, static_cast<std::uint32_t>(count)))
    {
        std::uint32_t group = 0;
        if (parts.arms) write_arms(group), group += 2;
        for (std::size_t leg = 0; parts.legs && leg < 2; ++leg) write_leg(leg, group++);
        if (parts.legs) ++group;
        if (parts.look) write(SWIVEL_LOOK_TARGET, group, given[0].look);
    }
    void solve() { crowd_.solve({.on_this_thread = true, .pose = &pose_}); }
    swivel::Crowd& crowd() { return crowd_; }
    // How many rifles' elbows the region holds back.
    double limited_share() const
    {
        std::vector<std::uint32_t> flags(given.size());
        crowd_.read(SWIVEL_FLAGS, 0, flags);
        return static_cast<double>(
                   std::ranges::count_if(flags, [](std::uint32_t f) { return f & SWIVEL_LIMITED_REGION; })) /
               static_cast<double>(flags.size());
    }

    std::vector<Character> given, solved;

private:
    static swivel::Crowd make(const Parts& parts, std::uint32_t count)
    {
        const auto joints = body_limbs();
        std::vector<swivel::Definition> groups;
        if (parts.arms) {
            swivel_body_limb_def rifle = swivel::body_limb(joints[kRightArm], kRifle);
            rifle.region = &rifle_region();
            swivel_body_limb_def other = swivel::body_limb(joints[0], kEvery | SWIVEL_WITH_LINK);
            other.link = 0;
            groups = {rifle, other};
        }
        for (std::size_t n = 0; parts.legs && n < 2; ++n) {
            swivel_body_limb_def leg = swivel::body_limb(joints[kLegs + n], kLeg);
            std::ranges::copy(kHeel, leg.ground.heel);
            groups.push_back(leg);
        }
        if (parts.legs) groups.push_back(swivel_default_shift_def());
        if (parts.look) groups.push_back(body_look());
        return swivel::Crowd(body_skeleton(), count, groups);
    }
    void write(swivel_field field, std::uint32_t group, const float* first)
    {
        swivel::check(swivel_write(crowd_.get(), field, group, 0, static_cast<std::uint32_t>(given.size()),
                                   {first, sizeof(Character)}));
    }
    void write_arms(std::uint32_t group)
    {
        const BodyGoal& rifle = given[0].body.goals[kRightArm];
        write(SWIVEL_TARGET, group, rifle.target);
        write(SWIVEL_HAND, group, rifle.hand);
        write(SWIVEL_WEIGHTS, group, given[0].weights);
        crowd_.write_all(SWIVEL_FLEXION_LIMIT, group, swivel::flexion(double{kMinFlexion}, double{kMaxFlexion}));
        crowd_.write_all(SWIVEL_GRIP, group + 1, std::array{kGrip[0], kGrip[1], kGrip[2], 0.0f, 0.0f, 0.0f, 1.0f});
    }
    void write_leg(std::size_t leg, std::uint32_t group)
    {
        crowd_.write_all(SWIVEL_EFFECTOR, group, std::to_array(kToe));
        write(SWIVEL_CONTACT, group, &given[0].contact[leg]);
        write(SWIVEL_GROUND, group, given[0].ground[leg]);
        write(SWIVEL_GROUND_NORMAL, group, given[0].normal[leg]);
    }

    float time_ = kFrameTime;
    swivel_pose pose_ = body_pose(given[0].body, solved[0].body, sizeof(Character), time_);
    swivel::Crowd crowd_;
};

void add_swivel(const std::string& isa, const Parts& parts, const std::string& name, std::size_t count)
{
    swivel::check(swivel_use_isa(isa.c_str()));
    const auto played = std::make_shared<Played>(parts, count);
    for (int frame = 0; frame < 30; ++frame) played->solve();
    Notes notes;
    if (parts.arms) {
        notes = checked(name, worst_grip(played->solved));
        notes.emplace_back("limited", played->limited_share());
    }
    add(
        name, count, Clock::cpu,
        [isa, played]() -> Work {
            swivel::check(swivel_use_isa(isa.c_str()));
            return [played] { played->solve(); };
        },
        std::move(notes));
}

// Saves and loads what all of them carry.
void add_state()
{
    const auto played = std::make_shared<Played>(kParts[3], kCharacters);
    for (int frame = 0; frame < 30; ++frame) played->solve();
    const std::size_t body_bytes = swivel_state_bytes(played->crowd().get());
    const auto state = std::make_shared<std::vector<std::byte>>(kCharacters * body_bytes);
    played->crowd().save(*state);
    const Notes notes = {{"bytes", static_cast<double>(body_bytes)}};
    add(
        "character_state/save", kCharacters, Clock::cpu,
        [=]() -> Work { return [=] { played->crowd().save(*state); }; }, notes);
    add(
        "character_state/load", kCharacters, Clock::cpu,
        [=]() -> Work { return [=] { played->crowd().load(*state); }; }, notes);
}

void add_glm()
{
    struct Rival {
        std::vector<Character> given = random_characters(kCharacters), solved = given;
        std::vector<CharacterState> states{kCharacters};
    };
    for (const Level* const level : runnable_levels()) {
        const auto played = std::make_shared<Rival>();
        const auto solve = [=] {
            level->solve_characters(played->given.data(), played->solved.data(), played->states.data(), kCharacters);
        };
        for (int frame = 0; frame < 30; ++frame) solve();
        const std::string name = std::string("character_glm/") + level->name;
        add(
            name, kCharacters, Clock::cpu, [=]() -> Work { return solve; }, checked(name, worst_grip(played->solved)));
    }
}

}  // namespace

void add_character(Suite& suite)
{
    for (const std::string& isa : suite.isas) {
        for (const Parts& parts : kParts) add_swivel(isa, parts, "character/" + isa + "/" + parts.name, kCharacters);
        for (const std::size_t count : kOtherCounts)
            add_swivel(isa, kParts[3], "character_count/" + isa + "/" + std::to_string(count), count);
    }
    add_state();
    add_glm();
}

}  // namespace bench
