// SPDX-License-Identifier: MIT
//
// The look of a body: spine, chest, neck and head turn to a target.
#pragma once

#include "bench/body_pose.h"
#include "bench/rivals/character.h"

namespace bench {

inline swivel_look_def body_look()
{
    swivel_look_def look = swivel::look({std::begin(kLookChain), std::end(kLookChain)});
    std::ranges::copy(kLookShares, look.share);
    std::ranges::copy(kLookMax, look.cos_max);
    std::ranges::copy(kEye, look.eye);
    return look;
}

}  // namespace bench
