// SPDX-License-Identifier: MIT
#include "bench/shares.h"

#include <stdexcept>

namespace bench {

namespace {

// Knuth's MMIX generator.
struct Random {
    std::uint64_t state = 1;
    std::size_t operator()(std::size_t end)
    {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return (state >> 33) % end;
    }
};

std::vector<std::uint32_t> flags_of(const swivel::Crowd& crowd)
{
    std::vector<std::uint32_t> flags(swivel_group_limb_count(crowd.get(), 0));
    crowd.read(SWIVEL_FLAGS, 0, flags);
    return flags;
}

// A flexion limit does not count: it holds back the wrist, not the swivel.
Held held_of(std::uint32_t flags)
{
    constexpr std::uint32_t swivel_limits = SWIVEL_LIMITED_SHOULDER_CONE | SWIVEL_LIMITED_REGION;
    return flags & SWIVEL_INFEASIBLE ? Held::infeasible : flags & swivel_limits ? Held::limited : Held::free;
}

// The inputs of a limb of one crowd for a limb of another.
void copy_limb(const swivel_rows& from, std::size_t source, const swivel_rows& to, std::size_t limb)
{
    const auto place = [](const swivel_rows& rows, std::size_t n) {
        return rows.base + n / SWIVEL_LANES * rows.row_count * SWIVEL_LANES + n % SWIVEL_LANES;
    };
    for (std::size_t row = 0; row < to.row_count; ++row)
        place(to, limb)[row * SWIVEL_LANES] = place(from, source)[row * SWIVEL_LANES];
}

}  // namespace

Notes shares_of(const swivel::Crowd& crowd)
{
    std::array<double, 3> counts{};
    const std::vector<std::uint32_t> flags = flags_of(crowd);
    for (const std::uint32_t word : flags) ++counts[static_cast<std::size_t>(held_of(word))];
    const auto all = static_cast<double>(flags.size());
    return {{"limited", counts[1] / all}, {"infeasible", counts[2] / all}};
}

Pool make_pool(swivel_features features, const std::string& isa, const swivel_region* region)
{
    const std::vector<Limb> limbs = random_limbs(24576);
    Pool pool{features, region, make_crowd(features, limbs.size(), limbs, region), {}};
    solve_all(pool.crowd, isa);
    const std::vector<std::uint32_t> flags = flags_of(pool.crowd);
    for (std::uint32_t n = 0; n < flags.size(); ++n)
        pool.limbs[static_cast<std::size_t>(held_of(flags[n]))].push_back(n);
    for (const std::vector<std::uint32_t>& kind : pool.limbs)
        if (kind.size() < 512) throw std::runtime_error("the pool lacks limbs of a kind; nothing is measured");
    return pool;
}

std::shared_ptr<swivel::Crowd> mixed_crowd(const Pool& pool, std::size_t arm_count, Held kind, double share)
{
    const auto held = static_cast<std::size_t>(share * static_cast<double>(arm_count) + 0.5);
    std::vector<Held> kinds(arm_count, Held::free);
    std::fill_n(kinds.begin(), held, kind);
    Random random;
    for (std::size_t n = arm_count; n > 1; --n) std::swap(kinds[n - 1], kinds[random(n)]);

    const auto crowd =
        std::make_shared<swivel::Crowd>(make_crowd(pool.features, arm_count, random_limbs(arm_count), pool.region));
    const swivel_rows from = swivel_input_rows(pool.crowd.get(), 0), to = swivel_input_rows(crowd->get(), 0);
    for (std::size_t n = 0; n < arm_count; ++n) {
        const std::vector<std::uint32_t>& limbs = pool.limbs[static_cast<std::size_t>(kinds[n])];
        copy_limb(from, limbs[random(limbs.size())], to, n);
    }
    return crowd;
}

}  // namespace bench
