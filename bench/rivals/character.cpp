// SPDX-License-Identifier: MIT
#include "bench/rivals/character.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace bench {

namespace {

double distance(const BodyVec& a, const BodyVec& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

std::vector<Character> random_characters(std::size_t count)
{
    const std::vector<BodyCharacter> bodies = random_bodies(count);
    std::mt19937 random(2);
    const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    std::vector<Character> characters(count);
    for (std::size_t n = 0; n < count; ++n) {
        Character& c = characters[n];
        c.body = bodies[n];
        // Upright, and turned about the vertical.
        const double turn = between(-3, 3);
        const BodyQuat root = {0, std::sin(turn / 2), 0, std::cos(turn / 2)};
        for (std::size_t k = 0; k < 4; ++k) c.body.root_rotation[k] = static_cast<float>(root[k]);
        const auto in_world = [&](const BodyVec& v, float(&to)[3]) {
            const BodyVec t = turned(root, v);
            for (std::size_t k = 0; k < 3; ++k) to[k] = c.body.root_place[k] + static_cast<float>(t[k]);
        };
        BodyGoal& rifle = c.body.goals[kRightArm];
        in_world({between(-0.2, -0.1), between(1.25, 1.4), between(0.2, 0.25)}, rifle.target);
        std::ranges::copy(c.body.root_rotation, rifle.hand);
        c.weights[0] = 1, c.weights[1] = 0.9f, c.weights[2] = 0;
        in_world({between(-2, 2), between(0.5, 2.5), between(2, 5)}, c.look);
        const BodyFrames frames = frames_of(c.body);
        for (std::size_t leg = 0; leg < 2; ++leg) {
            const std::size_t ankle = kBodyChains[kLegs + leg].last;
            c.contact[leg] = n % 3 == leg ? 1.0f : 0.0f;
            const BodyVec normal = {between(-0.2, 0.2), 1, between(-0.2, 0.2)};
            for (std::size_t k = 0; k < 3; ++k) {
                c.normal[leg][k] = static_cast<float>(normal[k]);
                c.ground[leg][k] = k == 1 ? c.body.root_place[1] + static_cast<float>(between(-0.05, 0.05))
                                          : static_cast<float>(frames.place[ankle][k]);
            }
        }
    }
    return characters;
}

double worst_grip(const std::vector<Character>& characters)
{
    constexpr double kNear = 1.5 * (0.3 - 0.26), kFar = 0.99 * (0.3 + 0.26);  // of an arm's bones
    double worst = 0;
    for (const Character& c : characters) {
        const BodyFrames frames = frames_of(c.body);
        BodyVec grip = turned(frames.turn[kRightHand], {kGrip[0], kGrip[1], kGrip[2]});
        for (std::size_t k = 0; k < 3; ++k) grip[k] += frames.place[kRightHand][k];
        const double way = distance(frames.place[kBodyChains[0].first], grip);
        if (way < kNear || way > kFar) continue;
        worst = std::max(worst, distance(frames.place[kLeftHand], grip));
    }
    return worst;
}

}  // namespace bench
