// SPDX-License-Identifier: MIT
//
// The textbook solver as a plain loop over arrays, which the compiler vectorises. It is written in three ways, and
// compiled once for each level.
// - Trig: acos and cosines for flexion and lift, as textbooks have it.
// - Light: the fastest way that we found with one angle, that of the flexion. The lift comes from its cosine and a
//   root.
// - Roots: half-angle formulas throughout and no angle at all. This is the fastest loop that we found.
//
// g++ 12 vectorises all of them. -fopt-info-vec shows it: g++ prints "loop vectorized using 64 byte vectors" for the
// loop below, once for each way. `nm` on the object lists _ZGVeN16v_acosf and _ZGVeN16v_cosf of libmvec.
// tests/check_rivals.cmake looks at the objects of every build. Two things were needed. One is ivdep, because 56 alias
// checks are too many and __restrict on locals is not enough. The other is a second cosine in place of the sine,
// because g++ joins the sine and cosine of one angle into a sincos that it cannot vectorise.
#include <bit>
#include <cmath>

#include "bench/rivals/level.h"

namespace bench::SWIVEL_LEVEL {

namespace {

float clamp(float x, float min, float max) { return std::fmin(std::fmax(x, min), max); }

enum class Writing { trig, light, roots };

struct Angle {
    float cos, sin;
};
// Half of the angle that has this cosine.
Angle half_by_trig(float cosine)
{
    const float half = 0.5f * std::acos(cosine);
    return {std::cos(half), std::cos(half - 1.57079633f)};
}
Angle half_by_roots(float cosine) { return {std::sqrt(0.5f + 0.5f * cosine), std::sqrt(0.5f - 0.5f * cosine)}; }

template <Writing How>
void solve_loop(const Arms& arms, Poses& poses)
{
    const float *tx = arms[0], *ty = arms[1], *tz = arms[2], *px = arms[3], *py = arms[4], *pz = arms[5];
    const float *upper = arms[6], *fore = arms[7];
    float *qx = poses[0], *qy = poses[1], *qz = poses[2], *qw = poses[3], *cos_half = poses[4], *sin_half = poses[5];
    float* flags = poses[6];
    const std::size_t count = arms.count();
#ifdef __clang__
#pragma clang loop vectorize(assume_safety)
#else
#pragma GCC ivdep
#endif
    for (std::size_t n = 0; n < count; ++n) {
        const float l1 = upper[n], l2 = fore[n];
        const float far = l1 + l2, near = std::fabs(l1 - l2);
        const float wanted = std::sqrt(tx[n] * tx[n] + ty[n] * ty[n] + tz[n] * tz[n]);
        const float d = clamp(wanted, near, far);
        float ux = tx[n] / wanted, uy = ty[n] / wanted, uz = tz[n] / wanted;

        const float cx = uy * pz[n] - uz * py[n], cy = uz * px[n] - ux * pz[n], cz = ux * py[n] - uy * px[n];
        const float c = std::sqrt(cx * cx + cy * cy + cz * cz);
        const float nx = cx / c, ny = cy / c, nz = cz / c;

        const float cos_flexion = clamp((d * d - l1 * l1 - l2 * l2) / (2 * l1 * l2), -1, 1);
        const float cos_lift = clamp((l1 * l1 + d * d - l2 * l2) / (2 * l1 * d), -1, 1);
        const Angle flexion = How == Writing::roots ? half_by_roots(cos_flexion) : half_by_trig(cos_flexion);

        // The frame (n, u x n, u); for the light writing, lifted towards the pole at once.
        float mx = uy * nz - uz * ny, my = uz * nx - ux * nz, mz = ux * ny - uy * nx;
        if constexpr (How == Writing::light) {
            const float sin_lift = std::sqrt(std::fmax(0.0f, 1 - cos_lift * cos_lift));
            const float bx = cos_lift * ux - sin_lift * mx, by = cos_lift * uy - sin_lift * my,
                        bz = cos_lift * uz - sin_lift * mz;
            mx = cos_lift * mx + sin_lift * ux, my = cos_lift * my + sin_lift * uy, mz = cos_lift * mz + sin_lift * uz;
            ux = bx, uy = by, uz = bz;
        }
        // As a quaternion: four roots and three signs.
        const float w = 0.5f * std::sqrt(std::fmax(0.0f, 1 + nx + my + uz));
        const float x = std::copysign(0.5f * std::sqrt(std::fmax(0.0f, 1 + nx - my - uz)), mz - uy);
        const float y = std::copysign(0.5f * std::sqrt(std::fmax(0.0f, 1 - nx + my - uz)), ux - nz);
        const float z = std::copysign(0.5f * std::sqrt(std::fmax(0.0f, 1 - nx - my + uz)), ny - mx);

        // The others are lifted about e1, by half the angle.
        Angle lift{1, 0};
        if constexpr (How == Writing::trig) lift = half_by_trig(cos_lift);
        if constexpr (How == Writing::roots) lift = half_by_roots(cos_lift);
        qw[n] = w * lift.cos - x * lift.sin;
        qx[n] = x * lift.cos + w * lift.sin;
        qy[n] = y * lift.cos + z * lift.sin;
        qz[n] = z * lift.cos - y * lift.sin;
        cos_half[n] = flexion.cos;
        sin_half[n] = flexion.sin;
        flags[n] = std::bit_cast<float>(wanted > far ? 8u : wanted < near ? 16u : 1u);
    }
}

}  // namespace

void solve_loop_trig(const Arms& arms, Poses& poses) { solve_loop<Writing::trig>(arms, poses); }
void solve_loop_light(const Arms& arms, Poses& poses) { solve_loop<Writing::light>(arms, poses); }
void solve_loop_roots(const Arms& arms, Poses& poses) { solve_loop<Writing::roots>(arms, poses); }

}  // namespace bench::SWIVEL_LEVEL
