// SPDX-License-Identifier: MIT
//
// Solves some limbs of a resident crowd. They are picked at random or as neighbours, or are a tenth of the crowd within
// a budget. Times are nanoseconds for each arm of the whole crowd. Compare them with all/.
#include "bench/suite.h"

namespace bench {

namespace {

// Picks of 1 in so many: single limbs, or whole runs of neighbours.
std::vector<std::uint32_t> random_words(std::uint32_t word_count, std::uint32_t one_in, std::uint32_t neighbours)
{
    std::vector<std::uint32_t> words(word_count);
    std::uint64_t state = 1;
    bool picked = false;
    for (std::uint32_t limb = 0; limb < word_count * 32; ++limb) {
        state = state * 6364136223846793005u + 1442695040888963407u;  // Knuth's MMIX generator
        if (limb % neighbours == 0) picked = (state >> 33) % one_in == 0;
        words[limb / 32] |= std::uint32_t{picked} << limb % 32;
    }
    return words;
}

}  // namespace

void add_choice(Suite& suite)
{
    const swivel_features features = kResident;
    for (const std::size_t level : {1u, 3u}) {
        const std::size_t arm_count = arms_within(level, features);
        const std::string place = level == 1 ? "/L2" : "/memory", family = "choice/" + suite.best_isa();
        add_solve(suite, family + "/all" + place, suite.best_isa(), features, arm_count);
        const auto add_words = [&](const std::string& name, std::uint32_t one_in, std::uint32_t neighbours) {
            add(family + name + std::to_string(one_in) + place, arm_count, Clock::cpu, [=, &suite]() -> Work {
                swivel::check(swivel_use_isa(suite.best_isa().c_str()));
                swivel::Crowd& crowd = suite.crowds.get(features, arm_count);
                const std::uint32_t blocks = swivel_block_count(crowd.get());
                return [&crowd, blocks, words = random_words((blocks + 1) / 2, one_in, neighbours)] {
                    crowd.solve({.blocks = swivel_blocks{0, blocks}, .mask = words, .on_this_thread = true});
                };
            });
        };
        for (const std::uint32_t one_in : {2u, 10u, 100u}) add_words("/random/1_in_", one_in, 1);
        for (const std::uint32_t one_in : {2u, 10u, 100u}) add_words("/neighbours/1_in_", one_in, 64);
        add(family + "/budget/1_in_10" + place, arm_count, Clock::cpu, [=, &suite]() -> Work {
            swivel::check(swivel_use_isa(suite.best_isa().c_str()));
            swivel::Crowd& crowd = suite.crowds.get(features, arm_count);
            const std::uint32_t blocks = swivel_block_count(crowd.get());
            std::vector<float> priorities(arm_count);
            for (std::size_t n = 0; n < arm_count; ++n) priorities[n] = static_cast<float>(1 + n / 16 * 7 % 31);
            return [&crowd, blocks, priorities, urgency = std::vector<float>(blocks),
                    words = std::vector<std::uint32_t>((blocks + 1) / 2)]() mutable {
                const swivel_in in{priorities.data(), sizeof(float)};
                crowd.choose({&in, 1}, urgency, blocks / 10, words);
                crowd.solve({.blocks = swivel_blocks{0, blocks}, .mask = words, .on_this_thread = true});
            };
        });
    }
}

}  // namespace bench
