// SPDX-License-Identifier: MIT
//
// `swivel lab verify`: compares the formulas with each other, and every instruction set of this machine with the
// corpus's golden bits, with several thread counts and chunk sizes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "swivel/lecture.h"
#include "swivel/swivel.hpp"
#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/corpus/corpus.h"
#include "tools/corpus/golden.h"
#include "tools/crowd/parallel.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

using PartDigests = std::array<std::uint64_t, std::size(corpus::kParts)>;
constexpr PartDigests kGolden = std::to_array(corpus::kGoldenDigests);

struct Digest {
    std::string isa, how;
    PartDigests parts;
    PartDigests expected;  // the golden ones; of crowds in other sizes the first instruction set's

    bool is_right() const { return parts == expected; }
    bool is_golden() const { return expected == kGolden; }  // that is, should be
};

// Solves the parts whose crowds have more limbs than that, and replaces their digests.
template <class Solve>
PartDigests digests_of_parts(PartDigests digests, std::uint32_t limb_count, Solve solve)
{
    for (std::size_t n = 0; n < digests.size(); ++n)
        if (const corpus::Part part = corpus::kParts[n]; corpus::own_limb_count(part) > limb_count)
            digests[n] = corpus::fold(corpus::digests_of(part, solve));
    return digests;
}

// A crowd of each part, so large that oneTBB shares it out.
template <class Solve>
PartDigests large_digests(Solve solve)
{
    using corpus::Part;
    return {corpus::digest_of(corpus::recipe_of(Part::ordinary, "world-joints-hand"), solve, 20'000),
            corpus::digest_of(corpus::recipe_of(Part::hard, "world-joints-hand"), solve, 20'000),
            corpus::digest_of(corpus::recipe_of(Part::limbs, "set-all-limits"), solve, 2'000),
            corpus::digest_of(corpus::recipe_of(Part::bodies, "set-all-limits"), solve, 2'000),
            corpus::digest_of(corpus::recipe_of(Part::standing, "palms-by-motion"), solve, 500)};
}

void solve_in_chunks(Crowd& crowd, Job job, std::uint32_t chunk)
{
    const std::uint32_t blocks = swivel_block_count(crowd.get());
    job.on_this_thread = true;
    for (std::uint32_t first = 0; first < blocks; first += chunk) {
        job.blocks = swivel_blocks{first, std::min(chunk, blocks - first)};
        crowd.solve(job);
    }
}

// Runs the corpus on one instruction set in every way.
void add_digests(const char* isa, std::vector<Digest>& digests)
{
    const auto solve = [](Crowd& crowd, Job job) {
        job.on_this_thread = is_one_thread();
        crowd.solve(job);
    };
    const PartDigests whole = digests_of_parts({}, 0, solve);
    digests.push_back({isa, "whole", whole, kGolden});
    for (const std::uint32_t chunk : {1u, 2u, 3u, 5u, 64u}) {
        const auto solve_chunks = [chunk](Crowd& crowd, const Job& job) { solve_in_chunks(crowd, job, chunk); };
        // Crowds of one block have no chunks, so they have the digests of the whole.
        digests.push_back(
            {isa, fmt::format("chunks of {}", chunk), digests_of_parts(whole, SWIVEL_LANES, solve_chunks), kGolden});
    }
    for (const unsigned threads : {1u, 2u}) {
        const ThreadLimit limit(threads);
        const std::string how = "large, " + counted(threads, "thread");
        const PartDigests parts = large_digests(solve);
        const auto first = std::ranges::find_if(digests, [](const Digest& d) { return d.how.starts_with("large"); });
        digests.push_back({isa, how, parts, first == digests.end() ? parts : first->parts});
    }
}

std::vector<Digest> all_digests(bool quiet)
{
    const std::string in_use = swivel_isa_name();
    std::vector<const char*> isas;
    for (std::uint32_t n = 0; const char* name = swivel_isa_at(n); ++n)
        if (swivel_isa_runs(name)) isas.push_back(name);
    std::vector<Digest> digests;
    Progress progress("instruction sets", isas.size(), quiet);
    for (std::size_t n = 0; n < isas.size(); ++n) {
        progress.show(n);
        check(swivel_use_isa(isas[n]));
        add_digests(isas[n], digests);
    }
    check(swivel_use_isa(in_use.c_str()));
    return digests;
}

bool is_within(const swivel_check& c) { return c.max <= c.max_limit && (c.rms_limit == 0 || c.rms <= c.rms_limit); }

void print_check(const swivel_check& c)
{
    const std::string rms_limit = c.rms_limit > 0 ? fmt::format(" <= {:.1e}", c.rms_limit) : "";
    say(stdout, "{:<46} {:<18} {:>8}  max {:.2e} <= {:.0e}  rms {:.2e}{:<11}{}\n", c.name, c.set, c.arm_count, c.max,
        c.max_limit, c.rms, rms_limit, is_within(c) ? "" : "  FAILED");
}

void append_check(const swivel_check& c, Json& list)
{
    list.push_back({{"name", c.name},
                    {"set", c.set},
                    {"arms", c.arm_count},
                    {"max", c.max},
                    {"rms", c.rms},
                    {"max_limit", c.max_limit},
                    {"rms_limit", c.rms_limit},
                    {"passed", is_within(c)}});
}

// Receives the checks. An exception may not pass through the library, so it is kept until the end.
struct Listener {
    bool json;
    Json checks = Json::array();
    std::exception_ptr failure{};
};

void hear(const swivel_check* c, void* context)
{
    Listener& listener = *static_cast<Listener*>(context);
    if (listener.failure) return;
    try {
        append_check(*c, listener.checks);
        if (!listener.json) print_check(*c);
    } catch (...) {
        listener.failure = std::current_exception();
    }
}

void print_digests(const std::vector<Digest>& digests)
{
    for (const Digest& d : digests) {
        if (d.how != "whole" && d.is_right()) continue;  // the same digest again, or one of larger crowds
        say(stdout, "digest  {:<8} {:<16}", d.isa, d.how);
        for (std::size_t n = 0; n < d.parts.size(); ++n)
            say(stdout, "  {} {:016x}", corpus::name_of(corpus::kParts[n]), d.parts[n]);
        say(stdout, "{}\n", d.is_right() ? "" : "  DIFFERS");
    }
}
Json json_of(const std::vector<Digest>& digests)
{
    Json list;
    for (const Digest& d : digests) {
        Json each{{"isa", d.isa}, {"how", d.how}};
        for (std::size_t n = 0; n < d.parts.size(); ++n)
            each[corpus::name_of(corpus::kParts[n])] = fmt::format("{:016x}", d.parts[n]);
        each["golden"] = d.is_golden();
        each["passed"] = d.is_right();
        list.push_back(each);
    }
    return list;
}

}  // namespace

void run_verify(const VerifyOptions& options)
{
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    Listener listener{options.json};
    const bool passed = swivel_verify(options.arms, options.seed, hear, &listener);
    if (listener.failure) std::rethrow_exception(listener.failure);

    const std::vector<Digest> digests = all_digests(options.quiet);
    const bool equal = std::ranges::all_of(digests, &Digest::is_right);
    if (options.json) {
        print_json({{"checks", listener.checks},
                    {"equal_digests", equal},
                    {"passed", passed && equal},
                    {"digests", json_of(digests)}});
    } else {
        print_digests(digests);
        say(stdout, "{}\n", passed && equal ? "all checks passed, all digests are the golden ones" : "FAILED");
    }
    if (!passed) throw CommandError(1, "verify: a check is over its limit; the lines marked FAILED say which");
    if (!equal)
        throw CommandError(1,
                           "verify: digests differ from tools/corpus/golden.h or each other; this build does not give "
                           "the bits of its version");
}

}  // namespace swivel::tools
