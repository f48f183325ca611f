// SPDX-License-Identifier: MIT
//
// `swivel verify`: every formula against the others, and the same bits from every instruction set, thread count and
// chunk size of this machine.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/swivel/command_error.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/golden_crowd.h"
#include "tools/swivel/parallel.h"
#include "tools/swivel/progress.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

struct Digest {
    std::string isa, how;
    std::uint64_t arms, limbs;  // of plain arms, and of whole limbs with all that may be asked of them

    bool operator==(const Digest& other) const { return arms == other.arms && limbs == other.limbs; }
};

// Enough plain arms that oneTBB shares them out. Whole limbs take a hundred times as long.
constexpr std::uint32_t kDigestArms = 20'000, kDigestLimbs = 400;

template <class Solve>
Digest digest_of(const char* isa, const std::string& how, Solve solve)
{
    return {isa, how, golden_digest(kDigestArms, solve), limb_digest(kDigestLimbs, solve)};
}

void solve_in_chunks(Crowd& crowd, std::uint32_t chunk)
{
    const std::uint32_t blocks = swivel_block_count(crowd.get());
    for (std::uint32_t first = 0; first < blocks; first += chunk)
        crowd.solve_blocks(first, std::min(chunk, blocks - first));
}

// The golden crowd on one instruction set, every way there is to run it.
void add_digests(const char* isa, std::vector<Digest>& digests)
{
    for (const unsigned threads : {1u, 2u}) {
        const ThreadLimit limit(threads);
        const std::string how = fmt::format("{} thread{}", threads, threads == 1 ? "" : "s");
        digests.push_back(digest_of(isa, how, [](Crowd& crowd) { crowd.solve(); }));
    }
    for (const std::uint32_t chunk : {1u, 2u, 3u, 5u, 64u, 1u << 20}) {
        const std::string how = chunk == 1u << 20 ? "one chunk" : fmt::format("chunks of {}", chunk);
        digests.push_back(digest_of(isa, how, [chunk](Crowd& crowd) { solve_in_chunks(crowd, chunk); }));
    }
}

std::vector<Digest> all_digests()
{
    const std::string in_use = swivel_isa_name();
    std::vector<const char*> isas;
    for (std::uint32_t n = 0; const char* name = swivel_isa_at(n); ++n)
        if (swivel_isa_runs(name)) isas.push_back(name);
    std::vector<Digest> digests;
    Progress progress("instruction sets", isas.size());
    for (std::size_t n = 0; n < isas.size(); ++n) {
        progress.show(n);
        check(swivel_use_isa(isas[n]));
        add_digests(isas[n], digests);
    }
    check(swivel_use_isa(in_use.c_str()));
    return digests;
}

bool is_within(const swivel_check& c) { return c.max <= c.max_limit && (c.rms_limit == 0 || c.rms <= c.rms_limit); }

void print_check(const swivel_check* c, void*)
{
    const std::string rms_limit = c->rms_limit > 0 ? fmt::format(" <= {:.1e}", c->rms_limit) : "";
    fmt::print("{:<46} {:<18} {:>8}  max {:.2e} <= {:.0e}  rms {:.2e}{:<11}{}\n", c->name, c->set, c->arm_count, c->max,
               c->max_limit, c->rms, rms_limit, is_within(*c) ? "" : "  FAILED");
}

void append_check(const swivel_check* c, void* list)
{
    static_cast<nlohmann::ordered_json*>(list)->push_back({{"name", c->name},
                                                           {"set", c->set},
                                                           {"arms", c->arm_count},
                                                           {"max", c->max},
                                                           {"rms", c->rms},
                                                           {"max_limit", c->max_limit},
                                                           {"rms_limit", c->rms_limit},
                                                           {"passed", is_within(*c)}});
}

}  // namespace

void run_verify(const VerifyOptions& options)
{
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    nlohmann::ordered_json checks = nlohmann::ordered_json::array();
    int passed = 0;
    check(swivel_verify(options.arms, options.seed, options.json ? append_check : print_check, &checks, &passed));

    const std::vector<Digest> digests = all_digests();
    bool equal = true;
    for (const Digest& digest : digests) equal = equal && digest == digests[0];
    if (options.json) {
        nlohmann::ordered_json out{{"checks", checks}, {"equal_digests", equal}, {"passed", passed && equal}};
        for (const Digest& d : digests)
            out["digests"].push_back({{"isa", d.isa},
                                      {"how", d.how},
                                      {"digest", fmt::format("{:016x}", d.arms)},
                                      {"limb_digest", fmt::format("{:016x}", d.limbs)}});
        print_json(out);
    } else {
        for (const Digest& d : digests)
            fmt::print("digest  {:<8} {:<12} arms {:016x}  whole limbs {:016x}{}\n", d.isa, d.how, d.arms, d.limbs,
                       d == digests[0] ? "" : "  DIFFERS");
        fmt::print("{}\n", passed && equal ? "all checks passed, all digests equal" : "FAILED");
    }
    if (!passed) throw CommandError(1, "verify: a check is over its limit; the lines marked FAILED say which");
    if (!equal)
        throw CommandError(
            1, "verify: instruction sets or chunks gave different bits; the lines marked DIFFERS say which");
}

}  // namespace swivel::tools
