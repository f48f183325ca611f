// SPDX-License-Identifier: MIT
//
// Prints the golden digest of the instruction set in use: the part of the bit promise that runs on a CPU of another
// family, under an emulator.
#include <cstdio>

#include "tools/swivel/golden_crowd.h"

int main()
{
    try {
        const std::uint64_t hash = swivel::tools::golden_digest(1000, [](swivel::Crowd& crowd) { crowd.solve(); });
        std::printf("%s %016llx\n", swivel_isa_name(), static_cast<unsigned long long>(hash));
    } catch (const swivel::Error& error) {
        std::fprintf(stderr, "print_digest: %s\n", error.what());
        return 1;
    }
}
