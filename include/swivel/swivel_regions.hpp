// SPDX-License-Identifier: MIT
//
// C++ on top of swivel_regions.h.
#pragma once

#include "swivel.hpp"
#include "swivel_regions.h"

#ifdef SWIVEL_NAMESPACE  // C++20; swivel.hpp refuses older C++
namespace SWIVEL_NAMESPACE {

// Where the upper arms of a group may point. It starts empty, and allows nothing. A group WITH_REGION takes get(),
// which must live until the crowd is made: arms.region = &region.get().
class Region {
public:
    Region& add_cones(std::span<const swivel_region_cone> cones, bool closed = false)
    {
        check(swivel_region_add_cones(&region_, cones.data(), static_cast<std::uint32_t>(cones.size()), closed));
        return *this;
    }
    Region& add_cones(std::initializer_list<swivel_region_cone> cones, bool closed = false)
    {
        return add_cones(std::span(cones.begin(), cones.size()), closed);
    }
    Region& add_polygon(std::span<const std::array<float, 3>> corners)
    {
        check(swivel_region_add_polygon(&region_, first_of(corners), static_cast<std::uint32_t>(corners.size())));
        return *this;
    }
    Region& add_directions(std::span<const std::array<float, 3>> directions, float margin, std::uint32_t max_cones)
    {
        check(swivel_region_add_directions(&region_, first_of(directions),
                                           static_cast<std::uint32_t>(directions.size()), margin, max_cones));
        return *this;
    }
    Region& forbid(const swivel_region_cone& cone)
    {
        check(swivel_region_forbid(&region_, &cone));
        return *this;
    }
    Region mirrored() const
    {
        Region made;
        check(swivel_region_mirror(&region_, &made.region_));
        return made;
    }
    float room(const std::array<float, 3>& direction) const
    {
        float made = 0;
        check(swivel_region_room(&region_, direction.data(), &made));
        return made;
    }
    const swivel_region& get() const { return region_; }

private:
    static const float* first_of(std::span<const std::array<float, 3>> list)
    {
        return list.empty() ? nullptr : list.front().data();
    }

    swivel_region region_ = swivel_default_region();
};

}  // namespace SWIVEL_NAMESPACE
#endif
