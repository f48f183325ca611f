// SPDX-License-Identifier: MIT
//
// Problem P by the arithmetic of core/solve_arm.h, written out by hand and without the algebra. It does by hand what
// the types of the kernels do, in the same three stages, and gives the same bits. Compiled once for each instruction
// set, with the flags of its kernels.
#include "bench/rivals/probe.h"
#include "bench/rivals/wide.h"

namespace bench::SWIVEL_ISA {

namespace {

constexpr unsigned kRow = 16;                              // floats in a row of a block
constexpr unsigned kInput = 8 * kRow, kResult = 7 * kRow;  // in a block
constexpr std::size_t kStrip = 8;                          // blocks: temporary rows of 5 KiB
struct alignas(64) Strip {
    float rows[9][kStrip * kRow];
};  // what a stage leaves to the next ones

inline Wide less_of(Wide a, Wide b) { return select(less(a, b), a, b); }
inline Wide larger_of(Wide a, Wide b) { return select(less(b, a), a, b); }
inline Wide flag(unsigned bits) { return broadcast(__builtin_bit_cast(float, bits)); }

// Of the line from shoulder to wrist, and of the swivel plane's normal, which is scaled by a power of two.
struct Line {
    Wide length, nx, ny, nz, normal_length;
};
// How far the upper arm is lifted off that line.
struct Lift {
    Wide larger, smaller, squared, difference;
};

inline void keep_in(Strip& strip, unsigned at, const Line& line)
{
    store(strip.rows[0] + at, line.length);
    store(strip.rows[1] + at, line.nx);
    store(strip.rows[2] + at, line.ny);
    store(strip.rows[3] + at, line.nz);
    store(strip.rows[4] + at, line.normal_length);
}
inline void keep_in(Strip& strip, unsigned at, const Lift& lift)
{
    store(strip.rows[5] + at, lift.larger);
    store(strip.rows[6] + at, lift.smaller);
    store(strip.rows[7] + at, lift.squared);
    store(strip.rows[8] + at, lift.difference);
}
inline Line line_of(const Strip& strip, unsigned at)
{
    return {load(strip.rows[0] + at), load(strip.rows[1] + at), load(strip.rows[2] + at), load(strip.rows[3] + at),
            load(strip.rows[4] + at)};
}
inline Lift lift_of(const Strip& strip, unsigned at)
{
    return {load(strip.rows[5] + at), load(strip.rows[6] + at), load(strip.rows[7] + at), load(strip.rows[8] + at)};
}

// Each stage works on one register of arms. ordinary becomes false if the formula does not hold for one of them.
inline Line solve_line(const float* in, bool& ordinary)
{
    const Wide wx = load(in), wy = load(in + 16), wz = load(in + 32);
    const Wide px = load(in + 48), py = load(in + 64), pz = load(in + 80);
    const Wide wrist2 = wx * wx + wy * wy + wz * wz, length = root(wrist2), per_wrist2 = per_power_of_two(wrist2);
    const Wide nx = wy * pz - wz * py, ny = wz * px - wx * pz, nz = wx * py - wy * px;
    const Wide normal_length = root(nx * nx + ny * ny + nz * nz);

    const Wide pole1 = size_of(px) + size_of(py) + size_of(pz), far = load(in + 96) + load(in + 112);
    const Mask sized =
        less_equal(broadcast(1e-9f), less_of(wrist2, pole1)) & less_equal(wrist2 + pole1 + far, broadcast(3.5e7f));
    if (!all(sized & less(broadcast(1e-3f) * (length * pole1), normal_length))) [[unlikely]]
        ordinary = false;
    return {length, per_wrist2 * nx, per_wrist2 * ny, per_wrist2 * nz, per_wrist2 * normal_length};
}

inline Lift solve_triangle(const float* in, Wide length, float* out)
{
    const Wide upper = load(in + 96), fore = load(in + 112);
    const Wide far = upper + fore, diff = upper - fore, near = size_of(diff);
    const Wide d = less_of(larger_of(length, near), far);
    const Wide longer = far + d, shorter = far - d, ahead = d + diff, behind = d - diff;
    const Wide a = behind * ahead, b = shorter * longer, p = ahead * longer, m = behind * shorter;
    const Wide per_sum = broadcast(1) / (a + b);
    const Wide cos_half = root(a * per_sum), sin_half = root(b * per_sum);
    const Wide larger = larger_of(p, m) * per_sum, smaller = cos_half * sin_half;
    store(out + 64, cos_half);
    store(out + 80, sin_half);
    store(out + 96, select(less(far, length), flag(8), select(less(length, near), flag(16), flag(1))));
    return {larger, smaller, larger * ((p + m) * per_sum), p - m};
}

// The frame along the target's line, the lift, and the root that takes off all lengths.
inline void solve_frame(const float* in, const Line& line, const Lift& lift, float* out, bool& ordinary)
{
    const Wide wx = load(in), wy = load(in + 16), wz = load(in + 32);
    const Wide height = line.length + size_of(wz), mz = signed_as(height, wz);
    const Wide along = flipped_as(line.nz, wz);
    const Wide c = along * wx - height * line.nx, s = along * wy - height * line.ny;
    const Wide spread = line.normal_length * height, large = spread + size_of(c);
    const Mask obtuse = less(c, broadcast(0));
    const Wide turn_w = select(obtuse, s, large), turn_z = select(obtuse, large, s);
    const Wide fw = flipped_as(mz * turn_z, broadcast(-0.0f)), fx = wx * turn_w + wy * turn_z;
    const Wide fy = wy * turn_w - wx * turn_z, fz = mz * turn_w;

    const Mask larger_first = less_equal(broadcast(0), flipped_as(lift.difference, wz));
    const Wide l0 = flipped_as(select(larger_first, lift.larger, lift.smaller), wz);
    const Wide l1 = select(larger_first, lift.smaller, lift.larger);
    const Wide half2 = (line.length * height) * (large * large + s * s) * lift.squared;
    const Wide scale = broadcast(0.707106781186547524f) / root(half2);
    const Wide w = scale * (fw * l0 - fx * l1), x = scale * (fx * l0 + fw * l1);
    const Wide y = scale * (fy * l0 + fz * l1), z = scale * (fz * l0 - fy * l1);
    store(out, flipped_as(x, w));
    store(out + 16, flipped_as(y, w));
    store(out + 32, flipped_as(z, w));
    store(out + 48, flipped_as(w, w));

    const Wide upper = load(in + 96), fore = load(in + 112), far = upper + fore, near = size_of(upper - fore);
    const Wide least = less_of(far - near, broadcast(1e4f) * ((line.length * height) * lift.squared));
    if (!all(less_equal(broadcast(1e-9f), least) & less(broadcast(0), size_of(w)))) [[unlikely]]
        ordinary = false;
}

}  // namespace

bool solve_by_hand(const float* input, float* results, std::size_t block_count)
{
    bool ordinary = true;
    for (std::size_t block = 0; block < block_count; ++block, input += kInput, results += kResult)
        for (unsigned lane = 0; lane < kRow; lane += kWide) {
            const Line line = solve_line(input + lane, ordinary);
            const Lift lift = solve_triangle(input + lane, line.length, results + lane);
            solve_frame(input + lane, line, lift, results + lane, ordinary);
        }
    return ordinary;
}

bool solve_by_stages(const float* input, float* results, std::size_t block_count)
{
    bool ordinary = true;
    Strip strip;
    for (std::size_t done = 0; done < block_count; done += kStrip) {
        const unsigned lanes = static_cast<unsigned>(block_count - done < kStrip ? block_count - done : kStrip) * kRow;
        const float* const in = input + done * kInput;
        float* const out = results + done * kResult;
        const auto in_at = [in](unsigned at) { return in + at / kRow * kInput + at % kRow; };
        const auto out_at = [out](unsigned at) { return out + at / kRow * kResult + at % kRow; };
        for (unsigned at = 0; at < lanes; at += kWide) keep_in(strip, at, solve_line(in_at(at), ordinary));
        for (unsigned at = 0; at < lanes; at += kWide)
            keep_in(strip, at, solve_triangle(in_at(at), load(strip.rows[0] + at), out_at(at)));
        for (unsigned at = 0; at < lanes; at += kWide)
            solve_frame(in_at(at), line_of(strip, at), lift_of(strip, at), out_at(at), ordinary);
    }
    return ordinary;
}

}  // namespace bench::SWIVEL_ISA
