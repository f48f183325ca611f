// SPDX-License-Identifier: MIT
//
// The arithmetic of a probe, and its table; compiled once for each instruction set.
#include "bench/rivals/probe.h"

#include <utility>

#include "bench/rivals/wide.h"

namespace bench::SWIVEL_ISA {

namespace {

// Twelve values stay in registers on every instruction set, with two constants; in flight side by side they hide a
// latency of 4 for two multipliers and two adders.
constexpr std::size_t kStreams = 12;

// Calls step.operator()<n>(x) for each of the streams, with its operand, in turns until count results are there. No
// loop over n: only at constant places of an array do compilers keep it in registers.
template <class Step, std::size_t... N>
inline void run(std::size_t count, Step step, std::index_sequence<N...>)
{
    // Full mantissas: some dividers finish early on round numbers.
    Wide x[] = {broadcast(1.2345678f + 0.1234567f * N)...};
    for (std::size_t done = 0; done < count; done += sizeof...(N)) (step.template operator()<N>(x[N]), ...);
}
template <class Step>
inline void run(std::size_t count, Step step)
{
    run(count, step, std::make_index_sequence<kStreams>{});
}

// The operand is hidden and the result used, so that every one is worked out anew.
template <class Work>
inline void once(Wide& x, Work work)
{
    keep(x);
    Wide result = work(x);
    keep(result);
}

}  // namespace

void multiply_add(std::size_t count)
{
    Wide factor = broadcast(1), term = broadcast(0);
    keep(factor), keep(term);
    run(count, [&]<std::size_t N>(Wide& x) {
        if constexpr (N % 2 == 0)
            x = x * factor;
        else
            x = x + term;
        keep(x);
    });
}

void divide(std::size_t count)
{
    Wide dividend = broadcast(1.7654321f);
    keep(dividend);
    run(count, [&]<std::size_t N>(Wide& x) { once(x, [&](Wide by) { return dividend / by; }); });
}

void root_only(std::size_t count)
{
    run(count, []<std::size_t N>(Wide& x) { once(x, [](Wide of) { return root(of); }); });
}

void divide_and_root(std::size_t count)
{
    Wide dividend = broadcast(1.7654321f);
    keep(dividend);
    run(count, [&]<std::size_t N>(Wide& x) {
        if constexpr (N % 2 == 0)
            once(x, [&](Wide by) { return dividend / by; });
        else
            once(x, [](Wide of) { return root(of); });
    });
}

#define SWIVEL_NAME_OF(isa) #isa
#define SWIVEL_NAME(isa) SWIVEL_NAME_OF(isa)

extern const Probe probe;
const Probe probe{SWIVEL_NAME(SWIVEL_ISA), kWide,          multiply_add,  divide,    root_only,
                  divide_and_root,         copy,           copy_streamed, copy_rows, read_rows,
                  solve_by_hand,           solve_by_stages};

}  // namespace bench::SWIVEL_ISA
