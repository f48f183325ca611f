// SPDX-License-Identifier: MIT
#include "tools/crowd/characters.h"

#include <algorithm>
#include <cmath>

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

CharacterStream::CharacterStream(const CrowdPlan& plan, std::span<const Limb> limbs, std::size_t frame_count)
    : plan_(plan),
      random_(plan.seed),
      starts_(plan.starts > 0 ? plan.starts : frame_count),
      columns_(static_cast<std::uint32_t>(std::ceil(std::sqrt(plan.characters)))),
      spacing_(plan.spacing * limb_span(limbs))
{
}

goal_character CharacterStream::next()
{
    const std::uint32_t n = made_++;
    const auto wish = [&](double size) { return static_cast<float>(size * plan_.shift_wish); };
    if (n == 0) return {1, {0, 0, 0}, 0, wish(1)};
    const double size = static_cast<float>(plan_.least_size + (plan_.most_size - plan_.least_size) * unit(random_));
    const auto start = static_cast<std::uint32_t>(random_() % starts_);
    const Eigen::Vector3d place =
        Eigen::Vector3d(spacing_ * (n % columns_), 0, spacing_ * (n / columns_)) + (1 - size) * plan_.foot;
    return {size, {place.x(), place.y(), place.z()}, plan_.stagger ? start : 0, wish(size)};
}

std::vector<goal_character> characters_of(const CrowdPlan& plan, std::span<const Limb> limbs, std::size_t frame_count)
{
    CharacterStream stream(plan, limbs, frame_count);
    std::vector<goal_character> characters(plan.characters);
    for (goal_character& character : characters) character = stream.next();
    return characters;
}

}  // namespace swivel::tools
