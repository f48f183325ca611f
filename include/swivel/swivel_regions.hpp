// SPDX-License-Identifier: MIT
//
// C++ on top of swivel_regions.h.
#pragma once

#include "swivel.hpp"
#include "swivel_regions.h"

#ifdef SWIVEL_NAMESPACE  // C++20; swivel.hpp refuses older C++
namespace SWIVEL_NAMESPACE {

// Where upper arms may point, at first nowhere. It must live until the crowd is made: arms.region = &region.get().
class Region {
public:
    Region& add_cones(std::span<const swivel_region_cone> cones, bool closed = false)
    {
        return changed_by(swivel_region_add_cones, cones.data(), count_of(cones), closed);
    }
    Region& add_cones(std::initializer_list<swivel_region_cone> cones, bool closed = false)
    {
        return add_cones(std::vector(cones), closed);
    }
    Region& add_polygon(std::span<const std::array<float, 3>> corners)
    {
        return changed_by(swivel_region_add_polygon, reinterpret_cast<const float*>(corners.data()), count_of(corners));
    }
    Region& add_directions(std::span<const std::array<float, 3>> directions, float margin, std::uint32_t max_cones)
    {
        return changed_by(swivel_region_add_directions, reinterpret_cast<const float*>(directions.data()),
                          count_of(directions), margin, max_cones);
    }
    Region& forbid(const swivel_region_cone& cone) { return changed_by(swivel_region_forbid, &cone); }
    Region mirrored() const
    {
        Region made;
        check(swivel_region_mirror(&region_, &made.region_));
        return made;
    }
    float room(const std::array<float, 3>& direction) const
    {
        return written_by<1>(swivel_region_room, &region_, direction.data())[0];
    }
    const swivel_region& get() const { return region_; }

private:
    template <class Call, class... Arguments>
    Region& changed_by(Call call, Arguments... arguments)
    {
        check(call(&region_, arguments...));
        return *this;
    }
    swivel_region region_ = swivel_default_region();
};

}  // namespace SWIVEL_NAMESPACE
#endif
