// SPDX-License-Identifier: MIT
//
// A host's C++20 program: solves a thousand arms and prints one line with the digest of their results, the same as
// arm.c prints. It is also built without exceptions and run-time types, as engines are. There, with the word "fail", it
// makes a mistake, which ends it; OWN_HANDLER says so in its own words.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#ifdef OWN_HANDLER
#define SWIVEL_ON_ERROR(status, text) (std::printf("the engine's log: status %d, %s\n", status, text), std::exit(7))
#endif
#include <swivel/swivel_explain.hpp>
#include <vector>

namespace {

constexpr std::uint32_t kArmCount = 1000;

std::vector<std::array<float, 3>> make_targets()
{
    std::vector<std::array<float, 3>> targets(kArmCount);
    std::uint32_t random = 1;
    for (std::array<float, 3>& target : targets)
        for (float& component : target) {  // components from 0.04 to 0.30: all within reach
            random = random * 1664525u + 1013904223u;
            component = 0.04f + static_cast<float>(random >> 8) * (0.26f / 16777216.0f);
        }
    return targets;
}

}  // namespace

int main(int argc, char** argv)
{
    swivel::Crowd crowd(swivel::limbs(kArmCount));
    crowd.write(SWIVEL_TARGET, 0, make_targets());
    crowd.write_all(SWIVEL_POLE, 0, std::array{0.25f, -1.0f, 0.125f});
    crowd.write_all(SWIVEL_LENGTHS, 0, std::array{0.30f, 0.26f});
    if (argc > 1 && std::strcmp(argv[1], "fail") == 0) crowd.solve({.mask = std::array{1u}});
    const std::array<std::uint32_t, 32> first_arm{1u};
    const std::uint32_t solved = crowd.solve() * crowd.solve({.mask = first_arm});
    std::vector<double> distances(kArmCount);
    crowd.residuals(0, distances);
    bool held = solved == kArmCount && !swivel::explain(crowd, 0, 0).empty();
    for (const double distance : distances) held = held && distance < 1e-6;
    std::printf("swivel %u, %d arms %s, digest %016llx\n", static_cast<unsigned>(swivel_version()),
                static_cast<int>(kArmCount), held ? "on target" : "off target",
                static_cast<unsigned long long>(crowd.digest()));
    return held ? 0 : 1;
}
