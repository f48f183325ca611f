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
    swivel::Crowd crowd({swivel::group(64)});
    // [active]
    std::vector<std::uint32_t> active((swivel_block_count(crowd.get()) + 1) / 2);
    for (std::uint32_t limb = 0; limb < 20; ++limb)
        active[limb / 32] |= 1u << (limb % 32);  // the nearest twenty
    crowd.solve({.mask = active});
    // [end]
    CHECK(solved(crowd) == 20);
}

TEST_CASE("docs: lists")
{
    swivel::Crowd crowd({swivel::group(64)});
    // [list]
    const std::uint32_t first = swivel_group_first_limb(crowd.get(), 0);
    crowd.solve({.limbs = std::array{first + 3, first + 4, first + 40}});
    // [end]
    CHECK(solved(crowd) == 3);
}

TEST_CASE("docs: budget")
{
    // [budget]
    swivel::Crowd crowd({swivel::group(64)});
    // Yours, kept from frame to frame: a float for each block, zeros at first.
    std::vector<float> urgency(swivel_block_count(crowd.get()));
    std::vector<float> priority(64, 1.0f);  // for each arm; size on screen, say
    const swivel_in priorities{priority.data(), sizeof(float)};
    // At most two blocks of 16 in this frame.
    const std::uint32_t count =
        crowd.solve({.priorities = {priorities}, .urgency = urgency, .max_blocks = 2});
    // [end]
    CHECK(count == 32);
    CHECK(solved(crowd) == 32);
    crowd.solve({.priorities = {priorities}, .urgency = urgency, .max_blocks = 2});
    CHECK(solved(crowd) == 64);
}
