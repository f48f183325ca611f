// SPDX-License-Identifier: MIT
//
// What `swivel rig` says of a skeleton to machines.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/rig/limbs.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

// file: as the user wrote it; with_joints: every joint, too.
nlohmann::ordered_json json_of(const MotionFile& motion, const std::string& file, const LimbSearch& search,
                               bool with_joints);

}  // namespace swivel::tools
