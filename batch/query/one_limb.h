// SPDX-License-Identifier: MIT
//
// A group of one free limb, on the stack, which takes limbs of another group. It takes a body's limb from its record,
// so functions of free limbs work for bodies, too.
#pragma once

#include "batch/crowd/crowd.h"
#include "batch/query/limb_value.h"
#include "simd/rows.h"

namespace swivel {

// The hand joint's own frame while the arm lies at rest in the arm frame; the identity for free limbs.
Rotor<double> hand_from_arm(const Group& group);
// How the arm frame of a body's limb was turned before its clavicle turned it, in the world, by its record; of about
// unit length.
Rotor<double> incoming_arm_rotation(const Group& group, std::uint32_t limb);
// How the hand of a body's limb came, likewise. The limb has no aim.
Rotor<double> incoming_hand(const Group& group, std::uint32_t limb);
// The hand that was written for it, of any length, or else the incoming one.
Rotor<double> wanted_hand(const Group& group, std::uint32_t limb);

// The features that no free limb has.
inline constexpr swivel_features kBodyFeatures = [] {
    swivel_features found = kBody | kLibraryGoal;
    for (const FeatureRow& row : kFeatures)
        if (row.kinds == kBodyLimbs) found |= row.feature;
    return found;
}();

class OneLimb {
public:
    explicit OneLimb(const Group& group);
    // Takes a limb with its results. A body's limb must have SWIVEL_WITH_RECORD.
    void take(std::uint32_t limb);
    const Group& group() const { return group_; }
    // Replaces the region of the upper arm.
    void set_region(const swivel_region* region) { group_.region = region; }

private:
    void take_record(std::uint32_t limb);
    LimbValue own(swivel_field field) const { return {group_, 0, field}; }

    alignas(64) char rows_[block_bytes(kEveryFeature & ~kBodyFeatures)] = {};
    const Group& source_;
    Group group_{};
};

}  // namespace swivel
