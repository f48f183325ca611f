// SPDX-License-Identifier: MIT
#include "check.h"

namespace {

std::uint32_t solved(const swivel::Crowd& crowd)
{
    std::vector<std::uint32_t> flags(64);
    crowd.read(SWIVEL_FLAGS, 0, flags);
    std::uint32_t count = 0;
    for (const std::uint32_t flag : flags) count += flag != 0;
    return count;
}

}  // namespace

TEST_CASE("docs: active limbs")
{
    swivel::Crowd crowd({swivel::limbs(64)});
    // [active]
    std::vector<std::uint32_t> active((swivel_block_count(crowd.get()) + 1) / 2);
    for (std::uint32_t limb = 0; limb < 20; ++limb)
        active[limb / 32] |= 1u << (limb % 32);  // the nearest twenty
    crowd.solve({.mask = active});
    // [end]
    CHECK(solved(crowd) == 20);
}

TEST_CASE("docs: budget")
{
    // [budget]
    swivel::Crowd crowd({swivel::limbs(64)});
    // Yours, kept from frame to frame: a float for each block, zeros at first.
    std::vector<float> urgency(swivel_block_count(crowd.get()));
    std::vector<std::uint32_t> mask((urgency.size() + 1) / 2);
    std::vector<float> priority(64, 1.0f);  // for each arm; size on screen, say
    const swivel_in priorities[] = {swivel::stream(priority)};
    // At most two blocks of 16 in this frame.
    crowd.choose(priorities, urgency, 2, mask);
    crowd.solve({.mask = mask});
    // [end]
    CHECK(solved(crowd) == 32);
    CHECK(crowd.choose(priorities, urgency, 2, mask) == 32);
    crowd.solve({.mask = mask});
    CHECK(solved(crowd) == 64);
}
