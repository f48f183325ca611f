// SPDX-License-Identifier: MIT
#include "tools/crowd/characters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/crowd/heading.h"

namespace swivel::tools {

namespace {

// The span of two limbs of the first solved kind, so that solving legs besides arms moves no character.
double limb_span(std::span<const Limb> limbs)
{
    double max = 0;
    for (const Limb& limb : limbs)
        if (limb.name.kind == limbs[0].name.kind)
            max = std::max(max, double{limb.bound.lengths[0]} + limb.bound.lengths[1]);
    return 2 * max;
}

}  // namespace

CharacterStream::CharacterStream(const CrowdPlan& plan, std::span<const Limb> limbs, std::size_t frame_count)
    : plan_(plan),
      random_(plan.seed),
      carriers_(~plan.seed),
      headings_(plan.seed ^ 0x68656164696e67u),
      clips_(plan.clips),
      columns_(static_cast<std::uint32_t>(std::ceil(std::sqrt(plan.characters)))),
      spacing_(plan.spacing * limb_span(limbs))
{
    if (clips_.empty()) clips_ = {{0, frame_count, frame_count}};
}

goal_character CharacterStream::next()
{
    const std::uint32_t n = made_++;
    const auto wish = [&](double size) { return static_cast<float>(size * plan_.shift_wish); };
    const auto performing = [&](std::size_t clip, double size, const Eigen::Vector3d& place, std::size_t start,
                                float heading) {
        const auto word = [](std::size_t count) { return static_cast<std::uint32_t>(count); };
        const std::uint32_t carries =
            plan_.carry && (n == 0 ? plan_.carry->share >= 1 : drawn_share(carriers_) < plan_.carry->share);
        return goal_character{size,
                              {place.x(), place.y(), place.z()},
                              word(start),
                              wish(size),
                              word(clips_[clip].first),
                              word(clips_[clip].count),
                              carries,
                              heading};
    };
    if (!plan_.agents.empty()) {
        const PlannedAgent& agent = plan_.agents[n];
        return performing(agent.clip, agent.size, agent.place, agent.start, agent.heading);
    }
    if (n == 0) return performing(0, 1, Eigen::Vector3d(0, 0, 0), 0, 0);
    const double size = static_cast<float>(plan_.min_size + (plan_.max_size - plan_.min_size) * drawn_share(random_));
    const std::uint64_t drawn = random_();
    const std::size_t clip = clips_.size() == 1 ? 0 : random_() % clips_.size();
    const std::size_t start = plan_.stagger ? drawn % clips_[clip].starts : 0;
    const double degrees =
        plan_.has_headings()
            ? plan_.min_heading_deg + (plan_.max_heading_deg - plan_.min_heading_deg) * drawn_share(headings_)
            : 0;
    const Eigen::Vector3d grid(spacing_ * (n % columns_), 0, spacing_ * (n / columns_));
    goal_character who = performing(clip, size, grid + (1 - size) * plan_.foot, start, heading_of(degrees));
    if (who.heading != 0) {  // the foot stays where it is
        Eigen::Vector3d foot = size * plan_.foot;
        turn_with(who, foot.x(), foot.z());
        Eigen::Map<Eigen::Vector3d>(who.place) = grid + plan_.foot - foot;
    }
    return who;
}

float heading_of(double degrees)
{
    return static_cast<float>(std::tan(std::remainder(degrees, 360) * std::numbers::pi / 720));
}

std::vector<goal_character> characters_of(const CrowdPlan& plan, std::span<const Limb> limbs, std::size_t frame_count)
{
    CharacterStream stream(plan, limbs, frame_count);
    std::vector<goal_character> characters(plan.characters);
    for (goal_character& character : characters) character = stream.next();
    return characters;
}

}  // namespace swivel::tools
