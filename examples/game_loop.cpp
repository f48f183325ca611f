// SPDX-License-Identifier: MIT
// A crowd in a game loop. The game moves in steps of fixed length, while frames differ in length. Hands get a fixed
// part of each frame's time. Hands near the camera are solved more often, and none is forgotten.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <span>
#include <swivel/swivel.hpp>
#include <vector>

namespace {

constexpr std::uint32_t kHandCount = 20'000;
constexpr int kFrameCount = 300;
constexpr double kStep = 1.0 / 60;      // seconds, of the game
constexpr double kHandBudget = 0.3e-3;  // seconds of each frame for the hands
constexpr double kArmLength = 0.56;     // metres
constexpr double kTargetSpeed = 0.1;    // metres a second
constexpr double kLongestWait = 1.0;    // seconds after which we call a hand forgotten

struct Character {
    std::array<float, 3> shoulder, target;
    float priority;
};

// Characters stand in rows of 100 before a camera at the origin. swivel solves neighbours together, in blocks of 16, so
// neighbours should be about equally important.
std::vector<Character> make_characters()
{
    std::vector<Character> characters(kHandCount);
    for (std::uint32_t n = 0; n < kHandCount; ++n) {
        const float x = static_cast<float>(n % 100) - 50, z = static_cast<float>(n / 100) + 2;
        characters[n].shoulder = {x, 1.4f, z};
        // A priority says how often, beside the others: here four times as often close by as from 80 metres on.
        characters[n].priority = std::clamp(80 / std::hypot(x, z), 1.0f, 4.0f);
    }
    return characters;
}

// The game: each target goes round a circle of 0.1 metres before its character.
void step_game(std::span<Character> characters, double time)
{
    for (std::size_t n = 0; n < characters.size(); ++n) {
        const double angle = kTargetSpeed / 0.1 * time + 0.7 * static_cast<double>(n % 9);
        const std::array<float, 3>& shoulder = characters[n].shoulder;
        characters[n].target = {shoulder[0] + static_cast<float>(0.1 * std::cos(angle)),
                                shoulder[1] + static_cast<float>(0.1 * std::sin(angle)), shoulder[2] - 0.35f};
    }
}

swivel::Crowd make_crowd(std::span<const Character> characters)
{
    const swivel_features limits = SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST;
    swivel::Crowd crowd({swivel::group(kHandCount, SWIVEL_WORLD | SWIVEL_POLE_DIRECTION | limits)});
    crowd.write_all(SWIVEL_POLE, 0, std::array{0.0f, -1.0f, 0.0f});  // elbows down
    crowd.write_all(SWIVEL_LENGTHS, 0, std::array{0.30f, 0.26f});
    crowd.write_all(SWIVEL_SHOULDER_CONE, 0, swivel::cone({0, 0, -1}, 2.4));
    crowd.write_all(SWIVEL_HUMERAL_TWIST, 0, swivel::range(-2.6, 2.6));
    std::vector<std::array<float, 3>> shoulders;
    for (const Character& character : characters) shoulders.push_back(character.shoulder);
    crowd.write(SWIVEL_SHOULDER_POSITION, 0, shoulders);
    return crowd;
}

// How many blocks of hands fit into the budget, from how long those before took. And how urgent each block is, which
// swivel keeps up to date.
class HandBudget {
public:
    explicit HandBudget(std::uint32_t block_count)
        : urgency(block_count), least_(block_count / 10.0 + 1), most_(block_count), blocks_(least_)
    {
    }
    std::vector<float> urgency;  // of each block, 0 at first
    std::uint32_t blocks() const { return static_cast<std::uint32_t>(blocks_); }
    void took(double seconds)
    {
        // A tenth of the way to what would have fitted, so that one bad frame matters little; at least a tenth of the
        // crowd, however slow the machine.
        const double fitting = blocks_ * kHandBudget / std::max(seconds, 1e-9);
        blocks_ = std::clamp(0.9 * blocks_ + 0.1 * std::min(fitting, most_), least_, most_);
    }

private:
    double least_, most_, blocks_;
};

struct Totals {
    int steps = 0;
    double hands = 0;
    std::vector<double> seconds;  // of each frame, for its hands
};

// One frame's hands: targets in, the most urgent solved. A renderer would read the rotations now.
void solve_hands(swivel::Crowd& crowd, std::span<const Character> characters, HandBudget& budget, Totals& totals)
{
    const auto start = std::chrono::steady_clock::now();
    const swivel_in target{&characters[0].target, sizeof characters[0]};
    swivel::check(swivel_write(crowd.get(), SWIVEL_TARGET, 0, 0, kHandCount, target));
    const swivel_in priorities[] = {{&characters[0].priority, sizeof characters[0]}};
    totals.hands += crowd.solve({.priorities = priorities, .urgency = budget.urgency, .most_blocks = budget.blocks()});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    budget.took(seconds);
    totals.seconds.push_back(seconds);
}

Totals run_game(swivel::Crowd& crowd, std::span<Character> characters)
{
    HandBudget budget(swivel_block_count(crowd.get()));
    Totals totals;
    double not_yet_played = 0;
    for (int frame = 0; frame < kFrameCount; ++frame) {
        // How long the last frame took: a game would ask the clock, and here frames take 12 to 21 milliseconds in
        // turns.
        not_yet_played += 0.012 + 0.003 * (frame % 4);
        for (; not_yet_played >= kStep; not_yet_played -= kStep) step_game(characters, ++totals.steps * kStep);
        solve_hands(crowd, characters, budget, totals);
    }
    return totals;
}

// How far each hand is from where its target is by now: it has not been solved since the target was there.
int report(const swivel::Crowd& crowd, std::span<const Character> characters, Totals& totals)
{
    std::vector<double> lag(kHandCount);
    crowd.residuals(0, lag);
    double near = 0, far = 0, near_count = 0, far_count = 0, worst = 0;
    for (std::uint32_t n = 0; n < kHandCount; ++n) {
        const bool is_near = characters[n].priority >= 2;
        (is_near ? near : far) += lag[n] * kArmLength;
        (is_near ? near_count : far_count) += 1;
        worst = std::max(worst, lag[n] * kArmLength);
    }
    // Never solved at all: not a number.
    const bool forgotten =
        !std::ranges::all_of(lag, [](double each) { return each * kArmLength <= kTargetSpeed * kLongestWait; });
    const bool in_order = near / near_count <= far / far_count + 1e-6;
    std::printf("%d frames, %d steps of 1/60 s, %u hands\n", kFrameCount, totals.steps, kHandCount);
    std::ranges::nth_element(totals.seconds, totals.seconds.begin() + kFrameCount / 2);
    std::printf("%.0f hands a frame, in %.2f ms of a budget of %.2f ms (median)\n", totals.hands / kFrameCount,
                totals.seconds[kFrameCount / 2] * 1e3, kHandBudget * 1e3);
    std::printf("hands lag %.1f mm behind within 40 m of the camera, %.1f mm beyond, %.1f mm at worst\n",
                near / near_count * 1e3, far / far_count * 1e3, worst * 1e3);
    std::puts(forgotten  ? "a hand was forgotten"
              : in_order ? "no hand was forgotten"
                         : "near hands came after far ones");
    return !forgotten && in_order ? 0 : 1;
}

}  // namespace

int main()
{
    try {
        std::vector<Character> characters = make_characters();
        step_game(characters, 0);
        swivel::Crowd crowd = make_crowd(characters);
        Totals totals = run_game(crowd, characters);
        return report(crowd, characters, totals);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
