// SPDX-License-Identifier: MIT
//
// Whether scales and mirrors of a skeleton let a limb be solved by rotations alone. Knows clips.
#pragma once

#include "tools/formats/clip.h"
#include "tools/rig/limb_chain.h"

namespace swivel::tools {

// A bound on how far uneven scales put the wrist off, as a share of the limb's length at rest: over the rest pose and
// all frames the largest sum, over the joints at and above the limb, of a joint's unevenness times its distance to the
// wrist. An uneven scale is solved by its mean, which is that far off at most. Throws CannotBind for scales that are
// uneven by more than 1e-3 in all, sheared or nothing, and for mirrors that come or go.
double scale_error(const formats::Clip& clip, const LimbChain& chain);

}  // namespace swivel::tools
