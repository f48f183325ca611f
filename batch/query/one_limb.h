// SPDX-License-Identifier: MIT
//
// A crowd of one free limb, on the stack, which takes limbs of a group. A body's limb it takes from its record, so what
// works on free limbs works on bodies.
#pragma once

#include "batch/crowd/crowd.h"
#include "core/space.h"

namespace swivel {

// For bodies the hand joint's own frame when the arm lies in the arm frame at rest; for free limbs no rotation.
Rotor<double> hand_from_arm(const Group& group);

class OneLimb {
public:
    explicit OneLimb(const Group& group);
    // Takes a limb, its results too. A body's limb must have SWIVEL_WITH_RECORD.
    void take(std::uint32_t limb);
    const Group& group() const { return crowd_->groups[0]; }
    // From now on, where the upper arm may point.
    void set_region(const swivel_region* region) { crowd_->groups[0].region = region; }

private:
    void take_record(std::uint32_t limb);
    void set(swivel_field field, std::uint32_t component, double value);
    void set(swivel_field field, const Vector<double>& v);
    void set(swivel_field field, const Rotor<double>& q);

    static constexpr std::size_t kArenaBytes = 14 * 1024;
    alignas(64) unsigned char arena_[kArenaBytes];
    const Group& source_;
    swivel_crowd* crowd_;
};

}  // namespace swivel
