// SPDX-License-Identifier: MIT
#include "tools/crowd/limb_crowds.h"

#include <fmt/format.h>

#include "tools/crowd/parallel.h"
#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

// Features that a crowd has for all its limbs or for none; the others are at rest where a limb does not use them.
constexpr swivel_features kShared = SWIVEL_WITH_HAND | SWIVEL_WITH_AIM | SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL |
                                    SWIVEL_POLE_INCOMING | SWIVEL_MOST_TWIST_BONES * SWIVEL_WITH_TWIST_BONES;

// A crowd in the making.
struct Draft {
    swivel_features features;
    swivel_euler_order shoulder_order, wrist_order;
    std::vector<swivel_group_def> groups;

    bool takes(const LimbPlan& plan) const
    {
        const auto both = [&](swivel_features box) { return (features & plan.features & box) != 0; };
        return (features & kShared) == (plan.features & kShared) &&
               (!both(SWIVEL_WITH_SHOULDER_BOX) || shoulder_order == plan.shoulder_order) &&
               (!both(SWIVEL_WITH_WRIST_BOX) || wrist_order == plan.wrist_order);
    }
    void add(const LimbPlan& plan, const swivel_group_def& group)
    {
        if (plan.has(SWIVEL_WITH_SHOULDER_BOX)) shoulder_order = plan.shoulder_order;
        if (plan.has(SWIVEL_WITH_WRIST_BOX)) wrist_order = plan.wrist_order;
        features |= plan.features;
        groups.push_back(group);
    }
    Crowd make(bool budget) const
    {
        swivel_crowd_def def = swivel_default_crowd_def();
        def.features = features | (budget ? SWIVEL_BUDGET : 0u);
        def.group_count = static_cast<std::uint32_t>(groups.size());
        def.groups = groups.data();
        def.shoulder_order = shoulder_order;
        def.wrist_order = wrist_order;
        return Crowd(def);
    }
};

}  // namespace

LimbCrowds::LimbCrowds(std::span<const Limb> limbs, const CrowdPlan& plan, const std::filesystem::path& file)
    : budget_blocks_(plan.budget_blocks)
{
    std::vector<Draft> drafts;
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        const LimbPlan& limb = plan.limbs[n];
        std::size_t d = 0;
        while (d < drafts.size() && !drafts[d].takes(limb)) ++d;
        if (d == drafts.size()) drafts.push_back({limb.features, limb.shoulder_order, limb.wrist_order, {}});
        places_.push_back({d, static_cast<std::uint32_t>(drafts[d].groups.size())});
        drafts[d].add(limb, group(plan.characters, limbs[n].bound));
        priorities_.push_back(limb.priority);
    }
    if (budget_blocks_ > 0 && drafts.size() > 1)
        throw formats::InputError(file,
                                  "budget.blocks: limbs that share a budget must have the same pole.kind, hand, aim, "
                                  "twist_bones and order of each box; make them equal, or take the budget out");
    for (const Draft& draft : drafts) crowds_.push_back(draft.make(budget_blocks_ > 0));
    for (std::size_t n = 0; n < limbs.size(); ++n)
        for (const FixedField& fixed : plan.limbs[n].fields) write(n, fixed.field, fixed.value.data(), 0);
}

bool LimbCrowds::has(std::size_t limb, swivel_field field) const
{
    return swivel_field_row_count(crowd_of(limb).get(), field) > 0;
}

void LimbCrowds::write(std::size_t limb, swivel_field field, const float* first, std::size_t stride)
{
    swivel_crowd* const crowd = crowd_of(limb).get();
    const std::uint32_t group = places_[limb].group;
    check(swivel_write(crowd, field, group, 0, swivel_group_limb_count(crowd, group), {first, stride}));
}

void LimbCrowds::read(std::size_t limb, swivel_field field, std::uint32_t first, std::uint32_t count,
                      swivel_out to) const
{
    check(swivel_read(crowd_of(limb).get(), field, places_[limb].group, first, count, to));
}

void LimbCrowds::forward(std::size_t limb, std::uint32_t first, std::uint32_t count, swivel_out elbow, swivel_out wrist,
                         swivel_out hand) const
{
    check(swivel_forward(crowd_of(limb).get(), places_[limb].group, first, count, elbow, wrist, hand));
}

void LimbCrowds::residuals(std::size_t limb, std::uint32_t first, std::uint32_t count, swivel_out distance) const
{
    check(swivel_residuals(crowd_of(limb).get(), places_[limb].group, first, count, distance));
}

void LimbCrowds::reset(std::size_t limb, std::uint32_t character)
{
    check(swivel_reset(crowd_of(limb).get(), places_[limb].group, character, 1));
}

void LimbCrowds::solve()
{
    if (budget_blocks_ == 0 || !began_) {
        for (Crowd& crowd : crowds_) crowd.solve({.on_this_thread = is_one_thread()});
        began_ = true;
        return;
    }
    Crowd& crowd = crowds_[0];
    active_.resize((std::size_t{swivel_block_count(crowd.get())} + 1) / 2);
    std::vector<swivel_in> priorities;
    for (const float& priority : priorities_) priorities.push_back({&priority, 0});
    crowd.choose(priorities, budget_blocks_, active_);
    crowd.solve({.mask = active_, .on_this_thread = is_one_thread()});
}

bool LimbCrowds::solved(std::size_t limb, std::uint32_t character) const
{
    if (active_.empty()) return true;
    const std::uint32_t n = swivel_group_first_limb(crowd_of(limb).get(), places_[limb].group) + character;
    return (active_[n / 32] >> n % 32 & 1u) != 0;
}

}  // namespace swivel::tools
