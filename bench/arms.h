// SPDX-License-Identifier: MIT
//
// The arms that swivel and its rivals solve: problem P's inputs as plain arrays, the same on every machine. Knows no
// solver.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

namespace bench {

// Arrays of floats of one length. Each starts five cache lines past a multiple of its predecessor's length, so that no
// two of them compete for the same places of a cache, as 4 KiB arrays laid end to end would.
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

struct Random {  // xorshift64*
    std::uint64_t state = 0x9e3779b97f4a7c15u;
    double operator()(double from, double to)
    {
        state ^= state >> 12, state ^= state << 25, state ^= state >> 27;
        return from + (to - from) * static_cast<double>((state * 0x2545f4914f6cdd1du) >> 11) * 0x1p-53;
    }
    std::array<double, 3> direction()
    {
        for (;;) {
            const double x = (*this)(-1, 1), y = (*this)(-1, 1), z = (*this)(-1, 1), r2 = x * x + y * y + z * z;
            if (r2 > 1 || r2 < 0.01) continue;
            const double per_r = 1 / std::sqrt(r2);
            return {x * per_r, y * per_r, z * per_r};
        }
    }
};

// Upper arms of 0.2 to 0.4, forearms of 0.7 to 1.4 of that, targets in any direction. Seven of ten in the inner 5 to 98
// % of the shell that the wrist can reach, one nearly straight, one nearly folded or too near, one too far. Every arm
// that the inner band holds is "ordinary": its pole is at least sin 0.1 off the target's line.
struct Crowd {
    Arms arms;
    std::unique_ptr<bool[]> ordinary;
};
inline Crowd random_crowd(std::size_t count)
{
    Crowd crowd{Arms(count), std::make_unique<bool[]>(count)};
    Random random;
    for (std::size_t n = 0; n < count; ++n) {
        const double upper = random(0.2, 0.4), fore = upper * random(0.7, 1.4);
        const double near = std::fabs(upper - fore), far = upper + fore;
        const int band = static_cast<int>(random(0, 10));
        const double share = band < 7    ? random(0.05, 0.98)
                             : band == 7 ? random(0.98, 1.0)
                             : band == 8 ? random(-0.05, 0.05)
                                         : random(1.0, 1.3);
        const double distance = std::fmax(near + share * (far - near), 0.01);
        const std::array u = random.direction();
        std::array pole = random.direction();
        while (std::fabs(pole[0] * u[0] + pole[1] * u[1] + pole[2] * u[2]) > 0.995) pole = random.direction();
        const double pole_length = random(0.2, 2.0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            crowd.arms[axis][n] = static_cast<float>(distance * u[axis]);
            crowd.arms[3 + axis][n] = static_cast<float>(pole_length * pole[axis]);
        }
        crowd.arms[6][n] = static_cast<float>(upper);
        crowd.arms[7][n] = static_cast<float>(fore);
        crowd.ordinary[n] = band < 7 && distance > 0.02;
    }
    return crowd;
}

}  // namespace bench
