// SPDX-License-Identifier: MIT
//
// What one instruction set can do at most, as code to be timed: compiled once for each of swivel's instruction sets,
// with the flags of its kernels.
#pragma once

#include <cstddef>

namespace bench {

struct Probe {
    const char* isa;
    unsigned lanes;  // floats in a register
    // Works through at least that many registers' results, none of which waits for another, outside memory:
    void (*multiply_add)(std::size_t count);  // half multiplications, half additions
    void (*divide)(std::size_t count);
    void (*root)(std::size_t count);
    void (*divide_and_root)(std::size_t count);  // in turns
    // Copies floats, a multiple of 64 of them, between addresses aligned to 64 bytes; the second past the caches.
    void (*copy)(const float* from, float* to, std::size_t count);
    void (*copy_streamed)(const float* from, float* to, std::size_t count);
    // A crowd's memory traffic and nothing else: of each block reads every input row and writes every result row, of
    // which there are no more, past the caches.
    void (*copy_rows)(const float* input, std::size_t input_rows, float* results, std::size_t result_rows,
                      std::size_t block_count);
    // What a reader of results does at least: copies each block's rows to the same place, which stays in the nearest
    // cache.
    void (*read_rows)(const float* results, std::size_t result_rows, std::size_t block_count);
    // Problem P for the rows of a crowd without features, by hand (hand.cpp): an arm's whole formula at once, or in
    // three stages over strips of blocks. False if one of the arms is out of the ordinary: then its step's results mean
    // nothing.
    bool (*solve_by_hand)(const float* input, float* results, std::size_t block_count);
    bool (*solve_by_stages)(const float* input, float* results, std::size_t block_count);
};
inline constexpr std::size_t kMostReadRows = 16;  // by read_rows

// Of an instruction set that swivel_isa_at() names.
const Probe& probe_of(const char* isa);

#ifdef SWIVEL_ISA  // in the files that are compiled once for each instruction set
namespace SWIVEL_ISA {

void multiply_add(std::size_t count);
void divide(std::size_t count);
void root_only(std::size_t count);
void divide_and_root(std::size_t count);
void copy(const float* from, float* to, std::size_t count);
void copy_streamed(const float* from, float* to, std::size_t count);
void copy_rows(const float* input, std::size_t input_rows, float* results, std::size_t result_rows,
               std::size_t block_count);
void read_rows(const float* results, std::size_t result_rows, std::size_t block_count);
bool solve_by_hand(const float* input, float* results, std::size_t block_count);
bool solve_by_stages(const float* input, float* results, std::size_t block_count);

}  // namespace SWIVEL_ISA
#endif

}  // namespace bench
