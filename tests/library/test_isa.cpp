// SPDX-License-Identifier: MIT
//
// The promise: the instruction set is chosen by name or by the CPU, never silently by anything else.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/test_arm.h"
#include "tests/test_scopes.h"

namespace {

using namespace swivel;
using namespace swivel::test;

std::vector<std::string> all_isas()
{
    std::vector<std::string> names;
    for (std::uint32_t n = 0; const char* name = swivel_isa_at(n); ++n) names.push_back(name);
    return names;
}

}  // namespace

TEST_CASE("the list has the best first, scalar last, nothing twice")
{
    const std::vector<std::string> isas = all_isas();
#ifdef __x86_64__
    CHECK(isas == std::vector<std::string>{"avx512", "avx2", "sse2", "scalar"});
#else
    CHECK(isas == std::vector<std::string>{"neon64", "scalar"});
#endif
    CHECK(swivel_isa_at(static_cast<std::uint32_t>(isas.size())) == nullptr);
    CHECK(swivel_isa_at(~0u) == nullptr);
    CHECK(swivel_isa_runs("scalar") == 1);
}

TEST_CASE("names that are not there are refused and change nothing")
{
    const std::string before = swivel_isa_name();
    for (const char* name : {"", "mmx", "AVX2", "avx2 ", "avx", static_cast<const char*>(nullptr)}) {
        CHECK(swivel_use_isa(name) == SWIVEL_UNKNOWN_ISA);
        CHECK(swivel_isa_runs(name) == 0);
        CHECK(std::string(swivel_last_error()).find('\'') != std::string::npos);  // names what was asked for
        CHECK(swivel_isa_name() == before);
    }
}

TEST_CASE("each one that runs can be used, each other says so")
{
    const IsaScope scope;
    for (const std::string& isa : all_isas()) {
        const std::string before = swivel_isa_name();
        if (swivel_isa_runs(isa.c_str())) {
            CHECK(swivel_use_isa(isa.c_str()) == SWIVEL_OK);
            CHECK(swivel_isa_name() == isa);
            Crowd crowd = crowd_of(0, 20);
            crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 1, 1});
            crowd.solve();
            CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS)[19] == SWIVEL_REACHED);
        } else {
            WARN("skipped: this CPU does not run " << isa);
            CHECK(swivel_use_isa(isa.c_str()) == SWIVEL_ISA_UNAVAILABLE);
            CHECK(std::string(swivel_last_error()).find(isa) != std::string::npos);
            CHECK(swivel_isa_name() == before);
        }
    }
}

#ifdef __x86_64__
TEST_CASE("what runs is what the kernel of the operating system reports")
{
    std::string flags;
    if (std::FILE* file = std::fopen("/proc/cpuinfo", "r")) {
        char line[8192];
        while (flags.empty() && std::fgets(line, sizeof line, file))
            if (std::string(line).rfind("flags", 0) == 0) flags = std::string(line) + " ";
        std::fclose(file);
    }
    std::replace(flags.begin(), flags.end(), '\n', ' ');
    REQUIRE_FALSE(flags.empty());
    const auto has = [&](const char* flag) { return flags.find(std::string(" ") + flag + " ") != std::string::npos; };
    CHECK((swivel_isa_runs("avx2") == 1) == has("avx2"));
    CHECK((swivel_isa_runs("avx512") == 1) ==
          (has("avx512f") && has("avx512cd") && has("avx512dq") && has("avx512bw") && has("avx512vl")));
    CHECK(swivel_isa_runs("sse2") == 1);
}
#endif
