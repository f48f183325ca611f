// SPDX-License-Identifier: MIT
//
// The look of a body: spine, chest, neck and head turn to a target.
#pragma once

#include "bench/body_pose.h"
#include "bench/rivals/character.h"

namespace bench {

inline swivel_group_def body_look()
{
    swivel_group_def def = swivel::look_group(kLookChain);
    std::ranges::copy(kLookShares, def.look.share);
    std::ranges::copy(kLookMax, def.look.cos_max);
    std::ranges::copy(kEye, def.look.eye);
    return def;
}

}  // namespace bench
