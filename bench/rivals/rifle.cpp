// SPDX-License-Identifier: MIT
#include "bench/rivals/rifle.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "bench/rivals/character.h"
#include "swivel/swivel_regions.hpp"

namespace bench {

const swivel_region& rifle_region()
{
    static const swivel::Region region = [] {
        std::vector<swivel_region_cone> cones(std::size(kArmCones));
        for (std::size_t n = 0; n < cones.size(); ++n) {
            std::ranges::copy(kArmCones[n].axis, cones[n].axis);
            cones[n].angle = kArmCones[n].angle;
        }
        return swivel::Region().add_cones(cones);
    }();
    return region.get();
}

}  // namespace bench
