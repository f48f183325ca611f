// SPDX-License-Identifier: MIT
#include "tools/crowd/limb_crowds.h"

#include <fmt/format.h>

#include <bit>

#include "tools/crowd/parallel.h"
#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

// Features that a crowd has for all its limbs or for none; the others are at rest where a limb does not use them.
constexpr swivel_features kShared = SWIVEL_WITH_HAND | SWIVEL_WITH_AIM | SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL |
                                    SWIVEL_POLE_INCOMING | SWIVEL_POLE_HAND | SWIVEL_WITH_REGION |
                                    SWIVEL_MOST_TWIST_BONES * SWIVEL_WITH_TWIST_BONES;

// A crowd in the making.
struct Draft {
    LimbCrowds::Shape shape;
    std::vector<swivel_group_def> groups;

    bool takes(const LimbSetup& limb) const
    {
        const auto both = [&](swivel_features feature) { return (shape.features & limb.features & feature) != 0; };
        return (shape.features & kShared) == (limb.features & kShared) &&
               (!both(SWIVEL_WITH_MOST_SWIVEL) || !((shape.features ^ limb.features) & SWIVEL_STEP_WINS)) &&
               (!both(SWIVEL_WITH_SHOULDER_BOX) || shape.shoulder_order == limb.shoulder_order) &&
               (!both(SWIVEL_WITH_WRIST_BOX) || shape.wrist_order == limb.wrist_order);
    }
    void add(const LimbSetup& limb, const swivel_group_def& group)
    {
        if (limb.has(SWIVEL_WITH_SHOULDER_BOX)) shape.shoulder_order = limb.shoulder_order;
        if (limb.has(SWIVEL_WITH_WRIST_BOX)) shape.wrist_order = limb.wrist_order;
        shape.features |= limb.features;
        groups.push_back(group);
    }
    Crowd make() const
    {
        std::vector<swivel_group_def> same = groups;
        for (swivel_group_def& group : same) {
            group.features = shape.features;
            group.shoulder_order = shape.shoulder_order;
            group.wrist_order = shape.wrist_order;
        }
        return Crowd(same);
    }
};

}  // namespace

LimbCrowds::LimbCrowds(std::span<const LimbSetup> limbs, std::uint32_t characters, std::uint32_t budget_blocks,
                       const std::filesystem::path& file)
    : budget_blocks_(budget_blocks)
{
    std::vector<Draft> drafts;
    for (const LimbSetup& limb : limbs) {
        std::size_t d = 0;
        while (d < drafts.size() && !drafts[d].takes(limb)) ++d;
        if (d == drafts.size()) drafts.push_back({{limb.features, limb.shoulder_order, limb.wrist_order}, {}});
        places_.push_back({d, static_cast<std::uint32_t>(drafts[d].groups.size())});
        swivel_group_def of_limb = group(characters, limb.binding, 0);
        if (limb.region) of_limb.region = &*limb.region;
        drafts[d].add(limb, of_limb);
        priorities_.push_back(limb.priority);
    }
    if (budget_blocks_ > 0 && drafts.size() > 1)
        throw formats::InputError(
            file,
            "budget.blocks: limbs that share a budget must have the same pole.kind, hand, aim, twist_bones, "
            "step_wins and order of each box, and either all or none have a region; make them "
            "equal, or take the budget out");
    for (Draft& draft : drafts) {
        crowds_.push_back(draft.make());
        shapes_.push_back(draft.shape);
    }
    for (std::size_t n = 0; n < limbs.size(); ++n)
        for (const FixedField& fixed : limbs[n].fields) write(n, fixed.field, fixed.value.data(), 0);
}

bool LimbCrowds::has(std::size_t limb, swivel_field field) const
{
    return swivel_field_row_count(crowd_of(limb).get(), places_[limb].group, field) > 0;
}

void LimbCrowds::write(std::size_t limb, swivel_field field, const float* first, std::size_t stride)
{
    swivel_crowd* const crowd = crowd_of(limb).get();
    const std::uint32_t group = places_[limb].group;
    check(swivel_write(crowd, field, group, 0, swivel_group_limb_count(crowd, group), {first, stride}));
}

void LimbCrowds::write_goals(std::size_t limb, std::span<const goal_input> inputs)
{
    check(swivel_goals_write(crowd_of(limb).get(), places_[limb].group, static_cast<std::uint32_t>(inputs.size()),
                             inputs.data()));
}

void LimbCrowds::read(std::size_t limb, swivel_field field, std::uint32_t first, std::uint32_t count,
                      swivel_out to) const
{
    check(swivel_read(crowd_of(limb).get(), field, places_[limb].group, first, count, to));
}

void LimbCrowds::restore_normals(std::size_t limb, std::span<const std::uint32_t> numbers)
{
    swivel_crowd* const crowd = crowd_of(limb).get();
    const std::uint32_t group = places_[limb].group;
    const swivel_rows rows = swivel_result_rows(crowd, group);
    const std::uint32_t first_row = swivel_field_first_row(crowd, group, SWIVEL_NORMAL);
    for (std::size_t n = 0; n < numbers.size() / 3; ++n)
        for (std::size_t part = 0; part < 3; ++part) {
            const std::size_t row = n / SWIVEL_LANES * rows.row_count + first_row + part;
            rows.base[row * SWIVEL_LANES + n % SWIVEL_LANES] = std::bit_cast<float>(numbers[3 * n + part]);
        }
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
    urgency_.resize(swivel_block_count(crowd.get()));
    crowd.choose(priorities, urgency_, budget_blocks_, active_);
    crowd.solve({.mask = active_, .on_this_thread = is_one_thread()});
}

std::vector<std::uint64_t> LimbCrowds::digests() const
{
    std::vector<std::uint64_t> digests;
    for (const Crowd& crowd : crowds_) digests.push_back(swivel_digest(crowd.get()));
    return digests;
}

bool LimbCrowds::solved(std::size_t limb, std::uint32_t character) const
{
    if (active_.empty()) return true;
    const std::uint32_t n = swivel_group_first_limb(crowd_of(limb).get(), places_[limb].group) + character;
    return (active_[n / 32] >> n % 32 & 1u) != 0;
}

}  // namespace swivel::tools
