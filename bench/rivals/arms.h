// SPDX-License-Identifier: MIT
//
// Problem P's inputs and outputs as plain arrays, one for each row of swivel's: what loops over arrays work on. Knows
// no solver.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

namespace bench {

// Arrays of floats of one length. There are five cache lines between one array and the next. Without them, 4 KiB arrays
// laid end to end would compete for the same places of a cache.
template <std::size_t N>
class Columns {
public:
    explicit Columns(std::size_t count) : step_((count + 15) / 16 * 16 + 80), count_(count)
    {
        const std::size_t size = step_ * N;
        data_.reset(static_cast<float*>(::operator new (size * sizeof(float), std::align_val_t{64})));
        for (std::size_t n = 0; n < size; ++n) data_[n] = 0;
    }
    float* operator[](std::size_t column) { return data_.get() + column * step_; }
    const float* operator[](std::size_t column) const { return data_.get() + column * step_; }
    std::size_t count() const { return count_; }

private:
    struct Free {
        void operator()(float* p) const { ::operator delete (p, std::align_val_t{64}); }
    };
    std::size_t step_, count_;
    std::unique_ptr<float[], Free> data_;
};

using Arms = Columns<8>;   // target xyz, pole xyz, upper, fore: the order of swivel's input rows
using Poses = Columns<7>;  // shoulder xyzw, cos and sin of half the flexion, flags: the order of its result rows

}  // namespace bench
