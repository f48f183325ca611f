// SPDX-License-Identifier: MIT
//
// The C entry points that solve some limbs of a crowd: by bits, by a list, by urgency.
#include <algorithm>

#include "batch/budget.h"
#include "batch/check.h"
#include "batch/solve.h"
#include "batch/status.h"

using namespace swivel;

namespace {

swivel_status check_words(const swivel_crowd* crowd, const std::uint32_t* words, std::uint32_t word_count)
{
    if (!crowd) return fail(SWIVEL_INVALID_ARGUMENT, "crowd is null");
    if (!words) return fail(SWIVEL_INVALID_ARGUMENT, "active words are null");
    if (const std::uint32_t needed = mask_word_count(crowd->block_count); word_count != needed)
        return fail(SWIVEL_INVALID_ARGUMENT, "%u active words; this crowd of %u blocks has %u, a bit for each lane",
                    word_count, crowd->block_count, needed);
    return SWIVEL_OK;
}

swivel_status check_priorities(const swivel_crowd* crowd, const swivel_in* priorities)
{
    if (!crowd) return fail(SWIVEL_INVALID_ARGUMENT, "crowd is null");
    if (!crowd->urgency)
        return fail(SWIVEL_INVALID_ARGUMENT, "this crowd remembers no urgency; create it with SWIVEL_BUDGET");
    if (!priorities)
        return fail(SWIVEL_INVALID_ARGUMENT, "priorities are missing; give one for each of this crowd's %u groups",
                    crowd->group_count);
    swivel_status status = SWIVEL_OK;
    for (std::uint32_t g = 0; g < crowd->group_count && status == SWIVEL_OK; ++g)
        status = check_stride(g, "priority", priorities[g].data, priorities[g].stride, sizeof(float), true);
    return status;
}

// Which of a crowd's groups a limb index is in; lists often stay in one.
struct Finder {
    const swivel_crowd& crowd;
    const Group* at = crowd.groups;

    bool is_limb(std::uint32_t limb)
    {
        const std::uint32_t block = limb / SWIVEL_LANES;
        if (block >= crowd.block_count) return false;
        if (block < at->first_block || block - at->first_block >= at->block_count) {
            const auto starts_after = [](std::uint32_t b, const Group& group) { return b < group.first_block; };
            at = std::upper_bound(crowd.groups, crowd.groups + crowd.group_count, block, starts_after) - 1;
        }
        return limb - at->first_block * SWIVEL_LANES < at->limb_count;
    }
};

void clear(std::uint32_t* words, const std::uint32_t* limbs, std::uint32_t limb_count)
{
    for (std::uint32_t n = 0; n < limb_count; ++n) words[limbs[n] / 32] = 0;
}

}  // namespace

swivel_status swivel_solve_active(swivel_crowd* crowd, const uint32_t* active_words, uint32_t word_count)
{
    swivel_status status = check_words(crowd, active_words, word_count);
    if (status != SWIVEL_OK) return status;
    const Isa* isa = usable_isa(status);
    if (!isa) return status;
    solve_chosen_all(*crowd, isa->kernels, active_words);
    return SWIVEL_OK;
}

swivel_status swivel_solve_active_blocks(swivel_crowd* crowd, const uint32_t* active_words, uint32_t word_count,
                                         uint32_t first_block, uint32_t block_count)
{
    swivel_status status = check_words(crowd, active_words, word_count);
    if (status == SWIVEL_OK) status = check_blocks(crowd, first_block, block_count);
    if (status != SWIVEL_OK) return status;
    const Isa* isa = usable_isa(status);
    if (!isa) return status;
    solve_chosen_blocks(*crowd, isa->kernels, active_words, first_block, block_count);
    return SWIVEL_OK;
}

swivel_status swivel_solve_list(swivel_crowd* crowd, const uint32_t* limbs, uint32_t limb_count)
{
    if (!crowd) return fail(SWIVEL_INVALID_ARGUMENT, "crowd is null");
    if (!limbs && limb_count > 0) return fail(SWIVEL_INVALID_ARGUMENT, "a list of %u limbs is null", limb_count);
    swivel_status status = SWIVEL_OK;
    const Isa* isa = usable_isa(status);
    if (!isa) return status;
    Finder finder{*crowd};
    for (uint32_t n = 0; n < limb_count; ++n) {
        if (!finder.is_limb(limbs[n])) {
            clear(crowd->chosen, limbs, n);
            return fail(SWIVEL_INVALID_ARGUMENT, "entry %u of the list: %u is no limb of this crowd, %s", n, limbs[n],
                        limbs[n] / SWIVEL_LANES < crowd->block_count ? "but padding" : "but past its end");
        }
        crowd->chosen[limbs[n] / 32] |= 1u << limbs[n] % 32;
    }
    if (limb_count > 0) solve_chosen_all(*crowd, isa->kernels, crowd->chosen);
    clear(crowd->chosen, limbs, limb_count);
    return SWIVEL_OK;
}

swivel_status swivel_choose(swivel_crowd* crowd, const swivel_in* priorities, uint32_t most_blocks,
                            uint32_t* active_words, uint32_t word_count, uint32_t* chosen_count)
{
    swivel_status status = check_priorities(crowd, priorities);
    if (status == SWIVEL_OK) status = check_words(crowd, active_words, word_count);
    if (status != SWIVEL_OK) return status;
    const uint32_t picked = choose(*crowd, priorities, most_blocks, active_words);
    if (chosen_count) *chosen_count = picked;
    return SWIVEL_OK;
}

swivel_status swivel_solve_budget(swivel_crowd* crowd, const swivel_in* priorities, uint32_t most_blocks,
                                  uint32_t* solved_count)
{
    swivel_status status = check_priorities(crowd, priorities);
    if (status != SWIVEL_OK) return status;
    const Isa* isa = usable_isa(status);
    if (!isa) return status;
    const uint32_t picked = choose(*crowd, priorities, most_blocks, crowd->chosen);
    if (picked > 0) solve_chosen_all(*crowd, isa->kernels, crowd->chosen);
    std::fill_n(crowd->chosen, mask_word_count(crowd->block_count), 0u);
    if (solved_count) *solved_count = picked;
    return SWIVEL_OK;
}
