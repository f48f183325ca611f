// SPDX-License-Identifier: MIT
//
// Prints the digests of the corpus's parts, with the instruction set in use. Under an emulator, it checks the promise
// of equal bits on a CPU of another family. With `golden`, prints the tables of tools/corpus/golden.h instead.
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

}  // namespace

int main(int argc, char** argv)
{
    try {
        if (argc == 2 && std::strcmp(argv[1], "golden") == 0) {
            print_golden();
            return 0;
        }
        std::printf("%s", swivel_isa_name());
        for (const Part part : kParts) std::printf(" %016llx", static_cast<unsigned long long>(digest_of(part, solve)));
        std::printf("\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "print_digest: %s\n", error.what());
        return 1;
    }
}
