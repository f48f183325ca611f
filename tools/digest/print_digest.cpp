// SPDX-License-Identifier: MIT
//
// Prints the digests of the corpus's parts, with the instruction set in use. On another platform or under an emulator,
// it shows the promise of equal bits. With `each`, prints a line for each instruction set that runs here, and `end`.
// With `start`, does the same with the standing part's start. With `stacks`, the bits must stay wherever the stack is.
// With `golden`, prints the numbers of tools/corpus/golden.h instead.
#include <cstdio>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tools/corpus/corpus.h"

namespace {

using namespace swivel;
using namespace swivel::corpus;

void solve(Crowd& crowd, const Job& job) { crowd.solve(job); }

void print_golden()
{
    for (const Part part : kParts)
        std::printf("    0x%016llxu,  // %s\n", static_cast<unsigned long long>(digest_of(part, solve)), name_of(part));
    std::printf("kGoldenStart = 0x%016llxu;\n", static_cast<unsigned long long>(digest_of_start(solve)));
    for (const Part part : kParts) {
        std::printf("%s:", name_of(part));
        for (std::size_t n = 0; const std::uint64_t digest : digests_of(part, solve))
            std::printf("%s0x%016llxu,", n++ % 5 == 0 ? "\n    " : " ", static_cast<unsigned long long>(digest));
        std::printf("\n");
    }
}

enum class Frames { all, start };
std::string digests(Frames frames)
{
    std::string text;
    char number[18];
    for (const Part part : kParts) {
        const bool is_start = part == Part::standing && frames == Frames::start;
        const std::uint64_t digest = is_start ? digest_of_start(solve) : digest_of(part, solve);
        std::snprintf(number, sizeof number, " %016llx", static_cast<unsigned long long>(digest));
        text += number;
    }
    return text;
}

// The same with the stack further down. Windows aligns it to 16 bytes, and kernels for larger registers must see to
// their own alignment.
[[gnu::noinline]] std::string digests_below(std::size_t bytes, Frames frames)
{
    volatile char* const room = static_cast<char*>(__builtin_alloca(bytes));
    room[0] = 0;
    return digests(frames);
}

void print_each(std::initializer_list<std::size_t> places, Frames frames = Frames::all)
{
    for (std::uint32_t n = 0; const char* isa = swivel_isa_at(n); ++n) {
        if (!swivel_isa_runs(isa)) continue;
        check(swivel_use_isa(isa));
        std::string text;
        for (const std::size_t bytes : places) {
            const std::string here = digests_below(bytes, frames);
            if (!text.empty() && here != text)
                throw std::runtime_error(std::string(isa) + ": the bits depend on where the stack is");
            text = here;
        }
        std::printf("%s%s\n", isa, text.c_str());
        std::fflush(stdout);
    }
    std::printf("end\n");  // Wine returns 0 for a program that crashed
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        const std::string_view what = argc == 2 ? argv[1] : "";
        if (what == "golden")
            print_golden();
        else if (what == "each")
            print_each({16});
        else if (what == "start")
            print_each({16}, Frames::start);
        else if (what == "stacks")
            print_each({16, 32, 48, 64});
        else
            std::printf("%s%s\n", swivel_isa_name(), digests(Frames::all).c_str());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "print_digest: %s\n", error.what());
        return 1;
    }
}
