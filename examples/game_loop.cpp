// SPDX-License-Identifier: MIT
// A crowd of bodies in a game loop. The game moves in steps of fixed length, while frames differ in length. Bodies get
// a fixed part of each frame's time. Those near the camera move more often, and none is forgotten.
//
// In its turn a body is animated. swivel writes the corrected pose to a copy, which is drawn. A body without a turn
// keeps its last pose: games animate far characters less often. Animated but not solved, its hands and feet would jump
// off their targets.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <swivel/swivel_bodies.hpp>
#include <vector>

namespace {

using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;  // a rotation: x, y, z, w

constexpr std::uint32_t kBodyCount = 4096;
constexpr int kFrameCount = 300;
constexpr double kStep = 1.0 / 60;    // seconds, of the game
constexpr double kBudget = 0.2e-3;    // seconds of each frame for the bodies
constexpr float kTargetSpeed = 0.1f;  // metres a second
constexpr float kLongestWait = 1;     // seconds after which we call a body forgotten
constexpr float kExact = 1e-4f;       // metres; floats know the farthest places to 1e-5

// The trunk from the hips up to the head, left and right arm with clavicles, left and right leg. At rest arms lie along
// x, and the face looks along z.
constexpr std::size_t kJoints = 20, kLimbs = 4;
constexpr std::array<std::int32_t, kJoints> kParents = {-1, 0,  1,  2,  3, 4,  3,  6, 7,  8,
                                                        3,  10, 11, 12, 0, 14, 15, 0, 17, 18};
constexpr std::array<Float3, kJoints> kOffsets = {
    {{0, 0.96f, 0},      {0, 0.1f, 0},      {0, 0.15f, 0},      {0, 0.15f, 0},  {0, 0.2f, 0},
     {0, 0.1f, 0},       {0.05f, 0.15f, 0}, {0.12f, 0, 0},      {0.3f, 0, 0},   {0.26f, 0, 0},
     {-0.05f, 0.15f, 0}, {-0.12f, 0, 0},    {-0.3f, 0, 0},      {-0.26f, 0, 0}, {0.1f, -0.05f, 0},
     {0, -0.42f, 0},     {0, -0.43f, 0},    {-0.1f, -0.05f, 0}, {0, -0.42f, 0}, {0, -0.43f, 0}}};
constexpr std::array<std::uint32_t, kLimbs> kFirstJoints = {7, 11, 14, 17};  // of arms and legs; the next two follow

struct Character {
    Float3 home, place;                        // where it stands, and where its root is now
    std::array<Float4, kJoints> pose, solved;  // as animated, and as drawn
    std::array<Float3, kLimbs> targets;        // of hands and feet
    float phase, priority;
};

// Characters stand in rows of 64 before a camera at the origin. swivel solves neighbours together, in blocks of 16, so
// neighbours should be about equally important.
std::vector<Character> make_characters()
{
    std::vector<Character> characters(kBodyCount);
    for (std::uint32_t n = 0; n < kBodyCount; ++n) {
        Character& c = characters[n];
        const float x = static_cast<float>(n % 64) - 32, z = -static_cast<float>(n / 64) - 2;
        c.home = c.place = {x, 0, z};
        c.pose.fill({0, 0, 0, 1});
        c.solved = c.pose;
        c.targets[2] = {x + 0.12f, 0.1f + 0.02f * std::sin(z), z + 0.05f};  // feet stand still, on uneven ground
        c.targets[3] = {x - 0.12f, 0.1f + 0.02f * std::cos(z), z - 0.05f};
        c.phase = 0.7f * static_cast<float>(n % 9);
        // A priority says how often, beside the others: here four times as often close by as from 80 metres on.
        c.priority = std::clamp(80 / std::hypot(x, z), 1.0f, 4.0f);
    }
    return characters;
}

// The game: the hands' targets go round circles of 0.1 metres before each character.
void step_game(std::vector<Character>& characters, double time)
{
    for (Character& c : characters) {
        const float angle = kTargetSpeed / 0.1f * static_cast<float>(time) + c.phase;
        const float across = 0.1f * std::cos(angle), up = 0.1f * std::sin(angle);
        c.targets[0] = {c.home[0] + 0.2f + across, 1.25f + up, c.home[2] + 0.35f};
        c.targets[1] = {c.home[0] - 0.2f + across, 1.25f - up, c.home[2] + 0.35f};
    }
}

Float4 turn_about(std::size_t axis, float angle)
{
    Float4 q = {0, 0, 0, std::cos(angle / 2)};
    q[axis] = std::sin(angle / 2);
    return q;
}

// The animation knows no targets: the weight goes from foot to foot, and elbows and knees are bent.
void animate(Character& c, double time)
{
    const float sway = std::sin(1.5f * static_cast<float>(time) + c.phase);
    c.place[0] = c.home[0] + 0.03f * sway;
    c.pose[1] = turn_about(2, 0.05f * sway);
    c.pose[2] = turn_about(1, 0.05f * sway);
    for (std::size_t limb = 0; limb < kLimbs; ++limb) {
        const bool is_arm = limb < 2;
        const float side = limb % 2 ? -1 : 1;
        c.pose[kFirstJoints[limb]] = is_arm ? turn_about(2, -1.2f * side) : turn_about(0, -0.3f);
        c.pose[kFirstJoints[limb] + 1] = is_arm ? turn_about(1, -0.5f * side) : turn_about(0, 0.6f);
    }
    c.solved = c.pose;  // a solve writes arms and legs alone
}

swivel::Crowd make_crowd()
{
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = swivel::stream(kParents);
    skeleton.translations = swivel::stream(kOffsets);
    skeleton.joint_count = kJoints;
    std::array<swivel_limb_joints, kLimbs> limbs;
    std::vector<swivel::Definition> groups;
    for (std::size_t n = 0; n < kLimbs; ++n) {
        limbs[n] = swivel_default_limb_joints(kFirstJoints[n], kFirstJoints[n] + 1, kFirstJoints[n] + 2);
        limbs[n].bend[2] = n < 2 ? 1 : -1;  // elbows bend forwards, knees backwards
        // On the side where the animation has them.
        groups.push_back(swivel::body_limb(limbs[n], SWIVEL_POLE_INCOMING));
    }
    return swivel::Crowd(skeleton, kBodyCount, groups);
}

struct Game {
    std::vector<Character> characters = make_characters();
    swivel::Crowd crowd = make_crowd();
    std::vector<float> urgency = std::vector<float>(swivel_block_count(crowd.get()));  // swivel keeps it up to date
    std::vector<std::uint32_t> turns = std::vector<std::uint32_t>((urgency.size() + 1) / 2);  // a bit for each body
    double blocks = 0;  // that fit into the budget
    // for the report
    int steps = 0;
    double turn_count = 0;
    std::vector<double> seconds;  // of each frame, for its bodies
};

// How many blocks would have fitted into the last frame's budget? We go a tenth of the way there, so that one bad frame
// matters little. At least a tenth of the crowd has its turn, however slow the machine is.
void plan_turns(Game& game)
{
    const auto all = static_cast<double>(game.urgency.size());
    const double fitting = game.seconds.empty() ? 0 : game.blocks * kBudget / std::max(game.seconds.back(), 1e-9);
    game.blocks = std::clamp(0.9 * game.blocks + 0.1 * std::min(fitting, all), all / 10 + 1, all);
    const swivel_in priorities[] = {swivel::stream(game.characters, &Character::priority)};
    game.turn_count += game.crowd.choose(priorities, game.urgency, static_cast<std::uint32_t>(game.blocks), game.turns);
}

void solve_bodies(Game& game)
{
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {&game.characters[0].pose, sizeof(Character), sizeof(Float4), nullptr};
    pose.results = {&game.characters[0].solved, sizeof(Character), sizeof(Float4), nullptr};
    pose.root_position = swivel::stream(game.characters, &Character::place);
    std::array<swivel::Streams, kLimbs> streams;
    for (std::size_t n = 0; n < kLimbs; ++n) {
        const auto target = [n](Character& each) -> Float3& { return each.targets[n]; };
        streams[n].in(SWIVEL_TARGET, swivel::stream(game.characters, target));
    }
    game.crowd.solve({.mask = game.turns, .streams = {streams.begin(), streams.end()}, .pose = &pose});
}

void run(Game& game)
{
    double not_yet_played = 0;
    for (int frame = 0; frame < kFrameCount; ++frame) {
        // How long the last frame took: a game would ask the clock. Here frames take 12 to 21 milliseconds.
        not_yet_played += 0.012 + 0.003 * (frame % 4);
        for (; not_yet_played >= kStep; not_yet_played -= kStep) step_game(game.characters, ++game.steps * kStep);
        const auto start = std::chrono::steady_clock::now();
        plan_turns(game);
        for (std::uint32_t n = 0; n < kBodyCount; ++n)
            if (game.turns[n / 32] >> n % 32 & 1) animate(game.characters[n], game.steps * kStep);
        solve_bodies(game);  // a renderer would read the solved poses now
        game.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
}

Float3 turned(const Float4& q, const Float3& v)
{
    const auto [x, y, z, w] = q;
    const Float3 t = {2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])};
    return {v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0]};
}

// How far a hand or foot is from its target, by forward kinematics from there up to the root.
float miss(const Character& c, std::size_t limb)
{
    Float3 at = {0, 0, 0};
    for (auto joint = static_cast<std::int32_t>(kFirstJoints[limb] + 2); joint >= 0;) {
        const auto n = static_cast<std::size_t>(joint);
        at = turned(c.solved[n], at);
        for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += kOffsets[n][axis];
        joint = kParents[n];
    }
    const Float3& target = c.targets[limb];
    return std::hypot(c.place[0] + at[0] - target[0], c.place[1] + at[1] - target[1], c.place[2] + at[2] - target[2]);
}

// A hand is behind by as far as its target went since the body's turn. Feet stand still, so they are where they should.
int report(Game& game)
{
    double lag[2] = {}, count[2] = {}, worst = 0;  // of hands far from the camera, and near
    bool is_forgotten = false, is_foot_off = false;
    for (const Character& c : game.characters)
        for (std::size_t limb = 0; limb < kLimbs; ++limb) {
            const double off = miss(c, limb);
            if (limb >= 2) {
                is_foot_off |= !(off <= kExact);
                continue;
            }
            lag[c.priority >= 2] += off;
            ++count[c.priority >= 2];
            worst = std::max(worst, off);
            is_forgotten |= !(off <= kTargetSpeed * kLongestWait);
        }
    const double far = lag[0] / count[0], near = lag[1] / count[1];
    std::ranges::nth_element(game.seconds, game.seconds.begin() + kFrameCount / 2);
    std::printf("%d frames, %d steps of 1/60 s, %u bodies\n", kFrameCount, game.steps, kBodyCount);
    std::printf("%.0f bodies a frame, in %.2f ms of a budget of %.2f ms (median)\n", game.turn_count / kFrameCount,
                game.seconds[kFrameCount / 2] * 1e3, kBudget * 1e3);
    std::printf("hands lag %.1f mm behind within 40 m of the camera, %.1f mm beyond, %.1f mm at worst\n", near * 1e3,
                far * 1e3, worst * 1e3);
    const bool is_in_order = near <= far + kExact;
    std::puts(is_forgotten   ? "a body was forgotten"
              : is_foot_off  ? "a foot is off"
              : !is_in_order ? "near bodies came after far ones"
                             : "no body was forgotten");
    return is_forgotten || is_foot_off || !is_in_order ? 1 : 0;
}

}  // namespace

int main()
{
    try {
        Game game;
        step_game(game.characters, 0);
        run(game);
        return report(game);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
