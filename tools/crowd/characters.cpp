// SPDX-License-Identifier: MIT
#include "tools/crowd/characters.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace swivel::tools {

namespace {

// Of the first kind that is solved, so that legs beside arms move no one.
double limb_span(std::span<const Limb> limbs)
{
    double most = 0;
    for (const Limb& limb : limbs)
        if (limb.name.kind == limbs[0].name.kind)
            most = std::max(most, double{limb.bound.lengths[0]} + limb.bound.lengths[1]);
    return 2 * most;
}

// Uniform in 0..1; std::uniform_real_distribution may differ between libraries.
double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

}  // namespace

std::vector<goal_character> characters_of(const CrowdPlan& plan, std::span<const Limb> limbs, std::size_t frame_count)
{
    std::vector<goal_character> characters(plan.characters, goal_character{1, {0, 0, 0}, 0, 0});
    std::mt19937_64 random(plan.seed);
    const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(plan.characters)));
    const double spacing = plan.spacing * limb_span(limbs);
    for (std::uint32_t n = 1; n < plan.characters; ++n) {
        const double size = plan.least_size + (plan.most_size - plan.least_size) * unit(random);
        const auto start = static_cast<std::uint32_t>(random() % frame_count);
        characters[n] = {size, {spacing * (n % columns), 0, spacing * (n / columns)}, plan.stagger ? start : 0, 0};
    }
    return characters;
}

}  // namespace swivel::tools
