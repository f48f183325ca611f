// SPDX-License-Identifier: MIT
#include "bench/hard_limbs.h"

#include <cmath>

namespace bench {

namespace {

void scale(Limb& limb, float by)
{
    for (float& x : limb.target) x *= by;
    for (float& x : limb.pole) x *= by;
    for (float& x : limb.lengths) x *= by;
}

void make_pole_hard(Limb& limb, std::size_t n)
{
    const float along = n % 3 == 0 ? 2.0f : n % 3 == 1 ? -0.5f : 0.0f;
    for (std::size_t axis = 0; axis < 3; ++axis) limb.pole[axis] = along * limb.target[axis];
}

void make_size_hard(Limb& limb, std::size_t n)
{
    switch (n % 4) {
        case 0:
            return scale(limb, 1e-12f);
        case 1:
            return scale(limb, 1e10f);
        case 2:
            for (float& x : limb.target) x *= 1e-6f;
            return;
        default:
            for (float& x : limb.pole) x *= 1e12f;
    }
}

void make_number_hard(Limb& limb, std::size_t n)
{
    switch (n % 4) {
        case 0:
            limb.target[n / 4 % 3] = NAN;
            return;
        case 1:
            limb.pole[n / 4 % 3] = INFINITY;
            return;
        case 2:
            limb.lengths[n / 4 % 2] = -1;
            return;
        default:
            limb.target[n / 4 % 3] = 1e20f;
    }
}

}  // namespace

void make_hard(Limb& limb, Hard kind, std::size_t n)
{
    limb.ordinary = false;
    switch (kind) {
        case Hard::pole:
            return make_pole_hard(limb, n);
        case Hard::size:
            return make_size_hard(limb, n);
        case Hard::number:
            return make_number_hard(limb, n);
    }
}

bool solved_as_hard(const swivel::Crowd& crowd, std::span<const Hard* const> kinds)
{
    std::vector<std::uint32_t> flags(kinds.size());
    std::vector<double> residuals(kinds.size());
    crowd.read(SWIVEL_FLAGS, 0, flags);
    crowd.residuals(0, residuals);
    for (std::size_t n = 0; n < kinds.size(); ++n) {
        const Hard* const kind = kinds[n];
        if (bool(flags[n] & SWIVEL_BAD_INPUT) != (kind && *kind == Hard::number)) return false;
        if (bool(flags[n] & SWIVEL_SWIVEL_UNDEFINED) != (kind && *kind == Hard::pole)) return false;
        if ((flags[n] & SWIVEL_REACHED) && !(residuals[n] <= 1e-6)) return false;
    }
    return true;
}

}  // namespace bench
