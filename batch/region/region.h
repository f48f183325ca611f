// SPDX-License-Identifier: MIT
//
// How a reach region is put together, in double: the half-spaces that parts and cuts are made of. It owns the bounds of
// their number. It knows no swivel.
#pragma once

#include "core/region.h"
#include "include/swivel/swivel_regions.h"

namespace swivel {

struct HalfSpace {
    Vector<double> axis;  // unit
    double cosine;
    bool is_edge;
};

// A region as it grows. Parts that do not fit are left out, and is_full() then says so.
class RegionBuilder {
public:
    explicit RegionBuilder(const swivel_region& from) : region_(from) {}

    void add(const HalfSpace& half);
    void end_part();
    void cut(const HalfSpace& half);
    bool is_full() const { return full_; }
    const swivel_region& region() const { return region_; }

private:
    // has_room: for one more.
    bool fits(bool has_room)
    {
        full_ = full_ || !has_room;
        return has_room;
    }

    swivel_region region_;
    std::uint32_t open_ = 0;  // half-spaces of the part that is not ended yet
    bool full_ = false;
};

// Whether a region's numbers are what its header says. function: for the message.
swivel_status check_region(const char* function, const swivel_region* region);

constexpr double kMinAngle = 0.01, kMaxAngle = 3.14159265358979 - 0.01;
struct RegionCone {
    Vector<double> axis;  // unit
    double angle;         // kMinAngle to kMaxAngle
};
// The nth of a function's cones.
swivel_status read_cone(const char* function, std::uint32_t n, const swivel_region_cone& cone, RegionCone& to);
// The nth of a function's directions, made unit. noun: what the message calls it.
swivel_status read_direction(const char* function, const char* noun, std::uint32_t n, const float* direction,
                             Vector<double>& to);
// Keeps what was built, or says that it does not fit.
swivel_status keep(const char* function, const RegionBuilder& builder, swivel_region* region);

// The first of cones in order that is opposite to its next neighbour, so that no bridge is between them; count: none.
std::uint32_t first_opposite(const RegionCone* cones, std::uint32_t count, bool closed);
// Cones in order, with bridges between neighbours. None are opposite.
void add_cones(RegionBuilder& builder, const RegionCone* cones, std::uint32_t count, bool closed);

}  // namespace swivel
