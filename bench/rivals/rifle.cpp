// SPDX-License-Identifier: MIT
#include "bench/rivals/rifle.h"

#include <algorithm>
#include <array>

#include "bench/rivals/character.h"
#include "swivel/swivel_regions.hpp"

namespace bench {

const swivel_region& rifle_region()
{
    static const swivel::Region region = [] {
        std::array<swivel_region_cone, std::size(kArmCones)> cones;
        for (std::size_t n = 0; n < cones.size(); ++n) {
            std::ranges::copy(kArmCones[n].axis, cones[n].axis);
            cones[n].angle = kArmCones[n].angle;
        }
        return swivel::Region().add_cones(cones);
    }();
    return region.get();
}

}  // namespace bench
