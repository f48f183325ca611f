// SPDX-License-Identifier: MIT
//
// What a reach region adds to the production limb: four cones in order, whose region forbids the wish of a tenth of the
// limbs. The same limbs are solved without the region, with one that forbids none of their wishes, and with this one.
#include <array>
#include <stdexcept>

#include "bench/rivals/production_limb.h"
#include "bench/shares.h"

namespace bench {

namespace {

constexpr swivel_features kInRegion = kProduction | SWIVEL_WITH_REGION;

// Limbs whose wish a region allows, then others, as they come.
struct Sorted {
    std::array<std::vector<Limb>, 2> limbs;

    Sorted(const swivel_region& region, const std::string& isa)
    {
        const std::vector<Limb> all = random_limbs(3 * 8192);
        swivel::Crowd crowd = make_crowd(kInRegion, all.size(), all, &region);
        solve_all(crowd, isa);
        std::vector<std::uint32_t> flags(all.size());
        crowd.read(SWIVEL_FLAGS, 0, flags);
        for (std::size_t n = 0; n < all.size(); ++n) {
            const bool is_forbidden = flags[n] & SWIVEL_LIMITED_REGION;
            if (is_forbidden || held_of(flags[n]) == Held::free) limbs[is_forbidden].push_back(all[n]);
        }
    }
    // One of ten forbidden, or none.
    std::vector<Limb> take(std::size_t count, bool with_forbidden) const
    {
        std::vector<Limb> taken;
        for (std::size_t n = 0; n < count; ++n) {
            const std::vector<Limb>& from = limbs[with_forbidden && n % 10 == n / 10 % 10];
            if (from.empty()) throw std::runtime_error("the region forbids all limbs or none; nothing is measured");
            taken.push_back(from[n % from.size()]);
        }
        return taken;
    }
};

}  // namespace

void add_regions(Suite& suite)
{
    constexpr std::array<swivel_region_cone, 4> cones = {
        {{{0, 0.2f, 1}, 1.1f}, {{0, 1, 0.3f}, 0.8f}, {{1, 0.3f, 0.2f}, 0.9f}, {{0.5f, -0.6f, 0.8f}, 0.7f}}};
    const swivel::Region region = swivel::Region().add_cones(cones);
    const Sorted sorted(region.get(), suite.best_isa());
    const std::size_t arm_count = arms_within(1, kInRegion);
    for (const std::string& isa : suite.isas)
        for (const bool with_forbidden : {false, true}) {
            const std::vector<Limb> limbs = sorted.take(arm_count, with_forbidden);
            const std::string name = "regions/" + isa + (with_forbidden ? "/tenth" : "/none");
            const auto without = std::make_shared<swivel::Crowd>(make_crowd(kProduction, arm_count, limbs));
            const auto within = std::make_shared<swivel::Crowd>(make_crowd(kInRegion, arm_count, limbs, &region.get()));
            solve_all(*within, isa);
            add_solve(name + "/without", isa, without);
            add_solve(name + "/within", isa, within, shares_of(*within));
        }
}

}  // namespace bench
