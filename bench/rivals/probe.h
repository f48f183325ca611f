// SPDX-License-Identifier: MIT
//
// What the arithmetic of one instruction set can do at most, as code to be timed: compiled once for each of swivel's
// instruction sets, with the flags of its kernels.
#pragma once

#include <cstddef>

namespace bench {

struct Probe {
    unsigned lanes;  // floats in a register
    // Works through at least that many registers' results, none of which waits for another, outside memory:
    void (*multiply_add)(std::size_t count);  // half multiplications, half additions
    void (*divide)(std::size_t count);
    void (*root)(std::size_t count);
};

// Of an instruction set that swivel_isa_at() names.
const Probe& probe_of(const char* isa);

}  // namespace bench
