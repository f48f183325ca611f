// SPDX-License-Identifier: MIT
//
// From joints of a skeleton, named by index, to a limb at rest. Knows no arm frame.
#pragma once

#include "batch/rig.h"

namespace swivel {

// What swivel_bind_joints() promises of the joints: the limb, or a refusal.
swivel_status rest_limb(const swivel_skeleton& skeleton, const swivel_limb_joints& joints, RestLimb& limb);

}  // namespace swivel
