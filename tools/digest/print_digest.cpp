// SPDX-License-Identifier: MIT
//
// Prints the digests of the corpus's parts, with the instruction set in use. On another platform or under an emulator,
// it shows the promise of equal bits. With `each`, prints a line for each instruction set that runs here. With
// `golden`, prints the tables of tools/corpus/golden.h instead.
#include <cstdio>
#include <cstring>
#include <exception>
#include <vector>

#include "tools/corpus/corpus.h"

namespace {

using namespace swivel;
using namespace swivel::corpus;

void solve(Crowd& crowd) { crowd.solve(); }

void print_golden()
{
    for (const Part part : kParts)
        std::printf("    0x%016llxu,  // %s\n", static_cast<unsigned long long>(digest_of(part, solve)), name_of(part));
    for (const Part part : kParts)
        for (const Recipe& recipe : recipes_of(part))
            std::printf("    {Part::%s, \"%s\", 0x%016llxu},\n", name_of(part), recipe.name,
                        static_cast<unsigned long long>(digest_of(recipe, solve)));
}

void print_digests()
{
    std::printf("%s", swivel_isa_name());
    for (const Part part : kParts) std::printf(" %016llx", static_cast<unsigned long long>(digest_of(part, solve)));
    std::printf("\n");
    std::fflush(stdout);
}

void print_each()
{
    for (std::uint32_t n = 0; const char* isa = swivel_isa_at(n); ++n) {
        if (!swivel_isa_runs(isa)) continue;
        check(swivel_use_isa(isa));
        print_digests();
    }
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        const char* const what = argc == 2 ? argv[1] : "";
        if (std::strcmp(what, "golden") == 0)
            print_golden();
        else if (std::strcmp(what, "each") == 0)
            print_each();
        else
            print_digests();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "print_digest: %s\n", error.what());
        return 1;
    }
}
