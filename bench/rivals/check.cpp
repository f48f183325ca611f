// SPDX-License-Identifier: MIT
#include "bench/rivals/check.h"

#include <cmath>

namespace bench {

namespace {

struct Vec {
    double x, y, z;
};
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vec turn(const double (&q)[4], Vec v)
{
    const auto [x, y, z] = v;
    const double tx = 2 * (q[1] * z - q[2] * y), ty = 2 * (q[2] * x - q[0] * z), tz = 2 * (q[0] * y - q[1] * x);
    return {x + q[3] * tx + q[1] * tz - q[2] * ty, y + q[3] * ty + q[2] * tx - q[0] * tz,
            z + q[3] * tz + q[0] * ty - q[1] * tx};
}

}  // namespace

double worst_error(std::span<const Limb> limbs, const Poses& poses)
{
    double worst = 0;
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        const Limb& limb = limbs[n];
        if (!limb.ordinary) continue;
        const double q[4] = {poses[0][n], poses[1][n], poses[2][n], poses[3][n]}, c = poses[4][n], s = poses[5][n];
        const double upper = limb.lengths[0], fore = limb.lengths[1];
        const Vec elbow = turn(q, {0, 0, upper});
        const Vec wrist = turn(q, {0, 2 * c * s * fore, upper + (c * c - s * s) * fore});
        const Vec target{limb.target[0], limb.target[1], limb.target[2]};
        const Vec pole{limb.pole[0], limb.pole[1], limb.pole[2]};
        const double error = std::hypot(wrist.x - target.x, wrist.y - target.y, wrist.z - target.z) / (upper + fore);
        // Both measured from the target's line.
        const bool right_side = dot(elbow, pole) - dot(target, elbow) * dot(target, pole) / dot(target, target) > 0;
        if (!right_side || !std::isfinite(error)) return INFINITY;
        worst = std::fmax(worst, error);
    }
    return worst;
}

}  // namespace bench
