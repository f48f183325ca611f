// SPDX-License-Identifier: MIT
//
// The copies of a probe; compiled once for each instruction set.
#include "bench/rivals/probe.h"
#include "bench/rivals/wide.h"

namespace bench::SWIVEL_ISA {

namespace {

constexpr std::size_t kRow = 16;  // floats in a row of a block

template <class Put>
inline void copy_by(const float* from, float* to, std::size_t count, Put put)
{
    for (std::size_t line = 0; line < count; line += 4 * kRow) {
        // A line of registers at a time, so that loads run ahead of stores.
#pragma GCC unroll 4
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t n = 0; n < kRow; n += kWide)
                put(to + line + row * kRow + n, load(from + line + row * kRow + n));
        asm volatile("" ::: "memory");  // a loop of these stores, not a call of memcpy
    }
}

}  // namespace

void copy(const float* from, float* to, std::size_t count)
{
    copy_by(from, to, count, [](float* place, Wide x) { store(place, x); });
}

void copy_streamed(const float* from, float* to, std::size_t count)
{
    copy_by(from, to, count, [](float* place, Wide x) { stream(place, x); });
    finish_streams();
}

void copy_rows(const float* input, std::size_t input_rows, float* results, std::size_t result_rows,
               std::size_t block_count)
{
    const std::size_t spare = (input_rows - result_rows) * kRow, last = (result_rows - 1) * kRow;
    for (std::size_t block = 0; block < block_count; ++block) {
        // Rows that have no place among the results are added into the last one: they have to be read, too.
        for (std::size_t n = 0; n < last; n += kWide) stream(results + n, load(input + n));
        for (std::size_t n = 0; n < kRow; n += kWide) {
            Wide sum = load(input + last + n);
            for (std::size_t row = kRow; row <= spare; row += kRow) sum = sum + load(input + last + row + n);
            stream(results + last + n, sum);
        }
        input += input_rows * kRow;
        results += result_rows * kRow;
    }
    finish_streams();
}

void read_rows(const float* results, std::size_t result_rows, std::size_t block_count)
{
    alignas(64) float place[kMostReadRows * kRow];
    for (std::size_t block = 0; block < block_count; ++block, results += result_rows * kRow) {
        for (std::size_t n = 0; n < result_rows * kRow; n += kWide) store(place + n, load(results + n));
        asm volatile("" ::"r"(place) : "memory");  // every block is read
    }
}

}  // namespace bench::SWIVEL_ISA
