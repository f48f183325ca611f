// SPDX-License-Identifier: MIT
//
// The promise: different crowds, and ranges of one crowd that do not overlap, may be solved by several threads at once.
#include "tests/solve_jobs.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"

#include <thread>

using namespace swivel;
using namespace swivel::test;

namespace {

void write_random(Crowd& crowd, std::uint64_t seed)
{
    Random random{seed};
    const std::uint32_t count = swivel_group_limb_count(crowd.get(), 0);
    std::vector<Float3> targets(count), poles(count);
    for (std::uint32_t n = 0; n < count; ++n) {
        targets[n] = floats(random.between(0, 2.2) * random.direction());
        poles[n] = floats(random.direction());
    }
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.write(SWIVEL_POLE, 0, poles);
}

}  // namespace

TEST_CASE("two crowds on two threads do not meet")
{
    Crowd one = crowd_of(0, 3000), two = crowd_of(0, 3001);
    write_random(one, 1);
    write_random(two, 2);
    one.solve();
    two.solve();
    const auto one_alone = all_words(one), two_alone = all_words(two);
    bool same[2] = {true, true};
    const auto run = [](Crowd& crowd, const std::vector<std::uint32_t>& expected, bool& ok) {
        for (int n = 0; n < 40; ++n) {
            const swivel_rows out = swivel_result_rows(crowd.get(), 0);
            std::memset(out.base, 0, sizeof(float) * out.block_count * out.row_count * SWIVEL_LANES);
            ok = swivel_solve(crowd.get(), nullptr) == SWIVEL_OK && all_words(crowd) == expected && ok;
        }
    };
    std::thread other([&] { run(two, two_alone, same[1]); });
    run(one, one_alone, same[0]);
    other.join();
    CHECK(same[0]);
    CHECK(same[1]);
}

TEST_CASE("several threads solve ranges of one crowd that do not overlap")
{
    Crowd crowd = crowd_of(0, 16 * 90);
    write_random(crowd, 3);
    crowd.solve();
    const auto expected = all_words(crowd);
    for (int round = 0; round < 20; ++round) {
        const swivel_rows out = swivel_result_rows(crowd.get(), 0);
        std::memset(out.base, 0xff, sizeof(float) * out.block_count * out.row_count * SWIVEL_LANES);
        std::vector<std::thread> threads;
        for (std::uint32_t t = 0; t < 3; ++t)
            threads.emplace_back([&crowd, t] {
                for (std::uint32_t block = t; block < 90; block += 3) solve_blocks(crowd.get(), block, 1);
            });
        for (std::thread& thread : threads) thread.join();
        REQUIRE(all_words(crowd) == expected);
    }
}
