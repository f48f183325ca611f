// SPDX-License-Identifier: MIT
//
// Problem P by the arithmetic of core/solve_arm.h, written out by hand and without the algebra. It does by hand what
// the types of the kernels do. It gives the same bits. Compiled once for each instruction set, with the flags of its
// kernels.
#include "bench/rivals/probe.h"
#include "bench/rivals/wide.h"

namespace bench::SWIVEL_ISA {

namespace {

inline Wide less_of(Wide a, Wide b) { return select(less(a, b), a, b); }
inline Wide larger_of(Wide a, Wide b) { return select(less(b, a), a, b); }
inline Wide flag(unsigned bits) { return broadcast(__builtin_bit_cast(float, bits)); }

// One register of arms; false if one of them is none that the formula holds for. Rows are 16 floats apart.
inline bool solve(const float* in, float* out)
{
    const Wide wx = load(in), wy = load(in + 16), wz = load(in + 32);
    const Wide px = load(in + 48), py = load(in + 64), pz = load(in + 80);
    const Wide upper = load(in + 96), fore = load(in + 112);

    const Wide wrist2 = wx * wx + wy * wy + wz * wz, length = root(wrist2), per_wrist2 = per_power_of_two(wrist2);

    // The reach and the triangle.
    const Wide far = upper + fore, diff = upper - fore, near = size_of(diff);
    const Wide d = less_of(larger_of(length, near), far);
    const Wide longer = far + d, shorter = far - d, ahead = d + diff, behind = d - diff;
    const Wide a = behind * ahead, b = shorter * longer, p = ahead * longer, m = behind * shorter;
    const Wide per_sum = broadcast(1) / (a + b);
    const Wide cos_half = root(a * per_sum), sin_half = root(b * per_sum);
    const Wide larger = larger_of(p, m) * per_sum, smaller = cos_half * sin_half;
    const Wide lift2 = larger * ((p + m) * per_sum);

    // The normal, and the frame along the target's line.
    const Wide nx = wy * pz - wz * py, ny = wz * px - wx * pz, nz = wx * py - wy * px;
    const Wide normal_length = root(nx * nx + ny * ny + nz * nz);
    const Wide height = length + size_of(wz), mz = signed_as(height, wz);
    const Wide along = flipped_as(per_wrist2 * nz, wz);
    const Wide c = along * wx - height * (per_wrist2 * nx), s = along * wy - height * (per_wrist2 * ny);
    const Wide spread = (per_wrist2 * normal_length) * height, large = spread + size_of(c);
    const Mask obtuse = less(c, broadcast(0));
    const Wide turn_w = select(obtuse, s, large), turn_z = select(obtuse, large, s);
    const Wide fw = flipped_as(mz * turn_z, broadcast(-0.0f)), fx = wx * turn_w + wy * turn_z;
    const Wide fy = wy * turn_w - wx * turn_z, fz = mz * turn_w;

    // The lift, and the root that takes off all lengths.
    const Mask larger_first = less_equal(broadcast(0), flipped_as(p - m, wz));
    const Wide l0 = flipped_as(select(larger_first, larger, smaller), wz), l1 = select(larger_first, smaller, larger);
    const Wide half2 = (length * height) * (large * large + s * s) * lift2;
    const Wide scale = broadcast(0.707106781186547524f) / root(half2);
    const Wide w = scale * (fw * l0 - fx * l1), x = scale * (fx * l0 + fw * l1);
    const Wide y = scale * (fy * l0 + fz * l1), z = scale * (fz * l0 - fy * l1);

    store(out, flipped_as(x, w));
    store(out + 16, flipped_as(y, w));
    store(out + 32, flipped_as(z, w));
    store(out + 48, flipped_as(w, w));
    store(out + 64, cos_half);
    store(out + 80, sin_half);
    store(out + 96, select(less(far, length), flag(8), select(less(length, near), flag(16), flag(1))));

    const Wide pole1 = size_of(px) + size_of(py) + size_of(pz);
    const Wide least =
        less_of(less_of(wrist2, pole1), less_of(far - near, broadcast(1e4f) * ((length * height) * lift2)));
    const Wide most = wrist2 + pole1 + far;
    const Mask plain = less_equal(broadcast(1e-9f), least) & less_equal(most, broadcast(3.5e7f));
    const Mask defined = less(broadcast(1e-3f) * (length * pole1), normal_length);
    return all(plain & defined & less(broadcast(0), size_of(w)));
}

}  // namespace

bool solve_by_hand(const float* input, float* results, std::size_t block_count)
{
    bool plain = true;
    for (std::size_t block = 0; block < block_count; ++block, input += 8 * 16, results += 7 * 16)
        for (unsigned lane = 0; lane < 16; lane += kWide)
            if (!solve(input + lane, results + lane)) [[unlikely]]
                plain = false;
    return plain;
}

}  // namespace bench::SWIVEL_ISA
