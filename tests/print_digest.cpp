// SPDX-License-Identifier: MIT
//
// Prints the golden digests, of plain arms and of whole limbs, of the instruction set in use: the part of the bit
// promise that runs on a CPU of another family, under an emulator.
#include <cstdio>

#include "tools/swivel/golden_crowd.h"

int main()
{
    try {
        const auto solve = [](swivel::Crowd& crowd) { crowd.solve(); };
        const unsigned long long arms = swivel::tools::golden_digest(1000, solve),
                                 limbs = swivel::tools::limb_digest(1000, solve);
        std::printf("%s %016llx %016llx\n", swivel_isa_name(), arms, limbs);
    } catch (const swivel::Error& error) {
        std::fprintf(stderr, "print_digest: %s\n", error.what());
        return 1;
    }
}
