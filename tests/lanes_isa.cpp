// SPDX-License-Identifier: MIT
//
// Compiled once for each instruction set, as the kernels are: the operations of lanes_ops.h on its lanes.
#include "simd/lanes.h"
#include "tests/lanes_ops.h"

namespace swivel::test::inline SWIVEL_ISA {

namespace {

template <class T>
void run(Op op, const float* a, const float* b, const float* c, float* out, std::size_t count)
{
    for (std::size_t n = 0; n < count; n += lane_count<T>) {
        const auto load = [n](const float* from) { return load_lanes<T>(from + n); };
        if (op == Op::store_some) {
            store_lanes(out + n, load(c));
            store_lanes(out + n, load(a), lanes_where<T>(lane_bits(load(a) < load(b))));
        } else {
            apply<T>(op, load(a), load(b), load(c), [&](const auto& result) { store_lanes(out + n, result); });
        }
    }
}

template <int Registers>
constexpr LaneTest test_of()
{
    using T = typename KernelNumber<SWIVEL_ARCH, Registers>::type;
    return {lane_count<T>, run<T>};
}

}  // namespace

extern const LaneTests lane_tests;
const LaneTests lane_tests{test_of<1>(), test_of<2>()};

}  // namespace swivel::test::inline SWIVEL_ISA
