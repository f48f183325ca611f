// SPDX-License-Identifier: MIT
//
// The promise: hands that hold a prop or another hand go on from a saved state with the same bits. Results that a body
// keeps because its input is bad are not in the state. So they differ after a load, until the next good solve. No pose,
// carried number or other result depends on them.
#include <set>

#include "tests/posed_bodies.h"
#include "tests/test_crowd.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr std::uint32_t kBodies = 20;
constexpr int kSaved = 40, kEnd = 50;  // frames
constexpr Float7 kGrip = {-0.15f, 0, 0, 0, 0, 0, 1};

enum Joint : std::uint32_t {
    kPelvis,
    kChest,
    kHead,
    kCollar,
    kLeftArm,
    kLeftForearm,
    kTwistBone,
    kLeftHand,
    kRightArm,
    kRightForearm,
    kRightHand,
    kThigh,
    kShin,
    kFoot
};

BodySkeleton person()
{
    BodySkeleton made;
    made.parents = {-1,           kPelvis, kChest,    kChest,        kCollar, kLeftArm, kLeftForearm,
                    kLeftForearm, kChest,  kRightArm, kRightForearm, kPelvis, kThigh,   kShin};
    made.translations = {{0, 0.9f, 0},   {0, 0.4f, 0},  {0, 0.3f, 0},   {0.05f, 0.2f, 0}, {0.15f, 0, 0},
                         {0.3f, 0, 0},   {0.13f, 0, 0}, {0.26f, 0, 0},  {-0.2f, 0.2f, 0}, {-0.3f, 0, 0},
                         {-0.26f, 0, 0}, {0.1f, 0, 0},  {0, -0.45f, 0}, {0, -0.42f, 0}};
    made.rotations.assign(made.parents.size(), {0, 0, 0, 1});
    made.limbs = {{kLeftArm, kLeftForearm, kLeftHand, {0, 0, 1}, {kTwistBone}},
                  {kRightArm, kRightForearm, kRightHand, {0, 0, 1}, {}},
                  {kThigh, kShin, kFoot, {0, 0, -1}, {}}};
    return made;
}

// How the animation turns a joint: about an axis, by an angle that sways.
struct Sway {
    std::uint32_t joint;
    Vector3d axis;
    double angle;  // radians
};
const Sway kSways[] = {{kLeftArm, {1, 0, 0}, 0},  {kLeftForearm, {0, -1, 0}, 0.9}, {kLeftHand, {1, 0, 0}, 0.3},
                       {kRightArm, {1, 0, 0}, 0}, {kRightForearm, {0, 1, 0}, 0.9}, {kRightHand, {1, 0, 0}, 0.3},
                       {kThigh, {1, 0, 0}, -0.4}, {kShin, {1, 0, 0}, 0.8},         {kFoot, {1, 0, 0}, -0.4}};

// Bodies that move. The left hand holds a prop, for which its arm stretches, and the right hand holds the left one. A
// foot stands on ground, the pelvis shifts for it, and the head looks. Elbows, knees and heads turn slowly.
struct Holders : PosedBodies {
    enum Group : std::uint32_t { prop, left, right, leg, shift, look };

    explicit Holders(swivel_on_bad_input on_bad_input = SWIVEL_KEEP_POSE)
        : PosedBodies(person(), std::vector<Body>(kBodies, person().rest()), {.roots = true})
    {
        constexpr swivel_features kLimb =
            SWIVEL_WITH_HAND | SWIVEL_WITH_RECORD | SWIVEL_POLE_INCOMING | SWIVEL_WITH_MAX_SWIVEL;
        swivel_prop_def prop_def = swivel_default_prop_def();
        prop_def.max_move = 0;
        swivel_look_def look_def = swivel::look({kChest, kHead});
        look_def.rate = 1;
        add(prop_def);
        add_limb(0, kLimb | SWIVEL_WITH_LINK | SWIVEL_WITH_REACH | SWIVEL_WITH_CLAVICLE, prop);
        add_limb(1, kLimb | SWIVEL_WITH_LINK, left);
        add_limb(2, kLimb | SWIVEL_WITH_PLANT | SWIVEL_WITH_GROUND | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_PELVIS_FIT);
        add(swivel_default_shift_def());
        add(look_def);
        for (const std::uint32_t g : {left, right, leg}) {
            limb_def(g).on_bad_input = on_bad_input;
            give_all(g, SWIVEL_MAX_SWIVEL, cos_sin(0.02));
        }
        give_all(left, SWIVEL_REACH, Float4{0, 0, 1.3f, 0});
        give_all(left, SWIVEL_CLAVICLE, Float1{0.3f});
        give_all(leg, SWIVEL_EFFECTOR, Float3{0, -0.06f, 0.1f});
        give_all(leg, SWIVEL_GROUND, Float3{0, 0.02f, 0});
        give_all(leg, SWIVEL_GROUND_NORMAL, Float3{0, 1, 0.1f});
        // go_to() writes these.
        give_all(prop, SWIVEL_PROP_POSITION, Float3{});
        give_all(prop, SWIVEL_PROP_WEIGHT, Float1{});
        give_all(right, SWIVEL_GRIP, Float7{});
        give_all(leg, SWIVEL_CONTACT, Float1{});
        give_all(look, SWIVEL_LOOK_TARGET, Float3{});
    }
    void go_to(int frame)
    {
        for (std::uint32_t n = 0; n < kBodies; ++n) {
            const double t = frame / 60.0 + n;
            Body& body = bodies[n];
            for (const Sway& sway : kSways) {
                const double angle = sway.angle + 0.3 * std::sin(3 * t + sway.joint);
                body.rotations[sway.joint] = floats(Quaterniond(Eigen::AngleAxisd(angle, sway.axis)));
            }
            const Vector3d root(n, 0, 0.2 * t);
            body.root_position = floats(root);
            const Vector3d held = root + Vector3d(0.1 * std::sin(t), 1.3, 0.5 + 0.15 * std::sin(2 * t)),
                           seen = root + Vector3d(3 * std::sin(2 * t), 1, 3);
            find(prop, SWIVEL_PROP_POSITION)->write(n, floats(held));
            find(prop, SWIVEL_PROP_WEIGHT)->write(n, Float1{1});
            find(right, SWIVEL_GRIP)->write(n, kGrip);
            find(leg, SWIVEL_CONTACT)->write(n, Float1{std::sin(4 * t) > 0 ? 1.0f : 0.0f});
            find(look, SWIVEL_LOOK_TARGET)->write(n, floats(seen));
        }
    }
    // Bad input of every other body: of its prop, so also of the left hand; of its foot and look; and of some right
    // hands.
    void spoil()
    {
        for (std::uint32_t n = 1; n < kBodies; n += 2) {
            find(prop, SWIVEL_PROP_WEIGHT)->write(n, Float1{2});
            find(leg, SWIVEL_CONTACT)->write(n, Float1{2});
            find(look, SWIVEL_LOOK_TARGET)->write(n, Float3{0, 1e16f, 0});
            if (n % 4 == 1) find(right, SWIVEL_GRIP)->write(n, Float7{kNan});
        }
    }
    // Solves the present frame, or one that it goes to, and returns the poses.
    std::vector<unsigned char> play(Crowd& crowd) const
    {
        write(crowd);
        PoseBuffer poses = incoming();
        solve_poses(crowd, view(poses));
        return poses.bytes;
    }
    std::vector<unsigned char> play(Crowd& crowd, int frame)
    {
        go_to(frame);
        return play(crowd);
    }
    Crowd played(int end)
    {
        Crowd crowd = this->crowd();
        for (int frame = 0; frame < end; ++frame) play(crowd, frame);
        return crowd;
    }

private:
    template <class Value>
    void give_all(std::uint32_t group, swivel_field field, const Value& value)
    {
        give(group, field, [&](std::size_t) { return value; });
    }
};

std::vector<std::byte> saved(const Crowd& crowd)
{
    std::vector<std::byte> state(kBodies * swivel_state_bytes(crowd.get()));
    crowd.save(state);
    return state;
}

struct Result {
    std::uint32_t group;
    swivel_field field;
    std::uint32_t body;
    std::vector<std::uint32_t> bits;
};
// All results of all bodies, in the same order for crowds of the same groups.
std::vector<Result> results_of(const Crowd& crowd)
{
    std::vector<Result> results;
    for (std::uint32_t g = 0; g < swivel_group_count(crowd.get()); ++g)
        for (const swivel_field field : every_field()) {
            const std::uint32_t count = swivel_field_row_count(crowd.get(), g, field);
            if (field < SWIVEL_INPUT_END || count == 0) continue;
            for (std::uint32_t n = 0; n < kBodies; ++n) {
                Result& result = results.emplace_back(Result{g, field, n, std::vector<std::uint32_t>(count)});
                check(swivel_read(crowd.get(), field, g, n, 1, {result.bits.data(), count * sizeof(float)}));
            }
        }
    return results;
}

}  // namespace

TEST_CASE("hands on a prop and on another hand are played again with the same bits")
{
    Holders holders;
    Crowd crowd = holders.played(kSaved);
    int stretched = 0;
    for (std::uint32_t n = 0; n < kBodies; ++n) {
        REQUIRE((flags_of(crowd, Holders::left, n) & flags_of(crowd, Holders::right, n) & SWIVEL_REACHED) != 0);
        stretched += (flags_of(crowd, Holders::left, n) & SWIVEL_STRETCHED) != 0;
    }
    REQUIRE((stretched > 5 && stretched < 15));

    const std::vector<std::byte> state = saved(crowd);
    std::vector<std::vector<unsigned char>> poses;
    for (int frame = kSaved; frame < kEnd; ++frame) poses.push_back(holders.play(crowd, frame));
    const std::uint64_t digest = crowd.digest();

    Crowd other = holders.crowd(), fresh = holders.crowd();
    for (Crowd* const again : {&crowd, &other}) {
        again->load(state);
        for (int frame = kSaved; frame < kEnd; ++frame)
            REQUIRE(holders.play(*again, frame) == poses[static_cast<std::size_t>(frame - kSaved)]);
        REQUIRE(again->digest() == digest);
    }
    // Both hands go elsewhere without the state.
    holders.play(fresh, kEnd - 1);
    for (const std::uint32_t g : {Holders::left, Holders::right}) {
        int differing = 0;
        for (std::uint32_t n = 0; n < kBodies; ++n)
            differing +=
                value_of<Float4>(fresh, SWIVEL_SHOULDER, g, n) != value_of<Float4>(crowd, SWIVEL_SHOULDER, g, n);
        CHECK(differing > 10);
    }
}

TEST_CASE("results that are kept because of bad input are not in the state, and nothing else depends on them")
{
    const swivel_on_bad_input on_bad_input = GENERATE(SWIVEL_KEEP_POSE, SWIVEL_REST_POSE);
    Holders holders(on_bad_input);
    Crowd crowd = holders.played(kSaved), loaded = holders.crowd();
    loaded.load(saved(crowd));
    const std::vector<Result> before = results_of(crowd), loaded_before = results_of(loaded);
    holders.go_to(kSaved);
    holders.spoil();
    REQUIRE(holders.play(loaded) == holders.play(crowd));
    REQUIRE(loaded.state_digest() == crowd.state_digest());

    const std::vector<Result> after = results_of(crowd), loaded_after = results_of(loaded);
    std::set<swivel_field> kept;
    for (std::size_t r = 0; r < after.size(); ++r) {
        if (loaded_after[r].bits == after[r].bits) continue;
        const Result& result = after[r];
        CAPTURE(result.group, result.field, result.body);
        REQUIRE(flags_of(crowd, result.group, result.body) == SWIVEL_BAD_INPUT);
        REQUIRE((result.bits == before[r].bits && loaded_after[r].bits == loaded_before[r].bits));
        kept.insert(result.field);
    }
    std::set<swivel_field> wanted = {SWIVEL_SOLVED_GOAL, SWIVEL_PROBE, SWIVEL_PROP_TRANSFORM, SWIVEL_SIGHT};
    if (on_bad_input == SWIVEL_KEEP_POSE)
        wanted.insert({SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST, SWIVEL_STRETCH, SWIVEL_TWIST_BONES,
                       SWIVEL_CLAVICLE_ROTATION});
    CHECK(kept == wanted);

    REQUIRE(holders.play(loaded, kSaved + 1) == holders.play(crowd, kSaved + 1));
    REQUIRE(loaded.digest() == crowd.digest());
}
