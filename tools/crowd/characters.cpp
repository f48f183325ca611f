// SPDX-License-Identifier: MIT
#include "tools/crowd/characters.h"

#include <algorithm>
#include <cmath>

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
    const auto word = [](std::size_t count) { return static_cast<std::uint32_t>(count); };
    const std::uint32_t n = made_++;
    const PlannedAgent agent = plan_.agents.empty() ? drawn(n) : plan_.agents[n];
    goal_character who = agent.who;
    who.first = word(clips_[agent.clip].first), who.count = word(clips_[agent.clip].count);
    who.wish = static_cast<float>(who.size * plan_.shift_wish);
    who.carries = plan_.carry && (n == 0 ? plan_.carry->share >= 1 : drawn_share(carriers_) < plan_.carry->share);
    return who;
}

PlannedAgent CharacterStream::drawn(std::uint32_t n)
{
    PlannedAgent agent{};
    goal_character& who = agent.who;
    who.size = 1;
    if (n == 0) return agent;
    who.size = static_cast<float>(drawn_in(plan_.size, random_));
    const std::uint64_t start = random_();
    agent.clip = clips_.size() == 1 ? 0 : random_() % clips_.size();
    if (plan_.stagger) who.start = static_cast<std::uint32_t>(start % clips_[agent.clip].starts);
    const Eigen::Vector3d grid(spacing_ * (n % columns_), 0, spacing_ * (n / columns_));
    Eigen::Map<Eigen::Vector3d> place(who.place);
    place = grid + (1 - who.size) * plan_.foot;
    if (!plan_.has_headings()) return agent;
    who.heading = heading_of(drawn_in(plan_.heading_deg, headings_));
    Eigen::Vector3d foot = who.size * plan_.foot;  // stays where it is
    turn_with(who, foot.x(), foot.z());
    place = grid + plan_.foot - foot;
    return agent;
}

std::vector<goal_character> characters_of(const CrowdPlan& plan, std::span<const Limb> limbs, std::size_t frame_count)
{
    CharacterStream stream(plan, limbs, frame_count);
    std::vector<goal_character> characters(plan.characters);
    for (goal_character& character : characters) character = stream.next();
    return characters;
}

}  // namespace swivel::tools
