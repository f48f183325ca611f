// SPDX-License-Identifier: MIT
#pragma once

#include "swivel/swivel.h"
#include "tools/formats/crowd_file.h"
#include "tools/rig/limbs.h"

namespace swivel::tools {

// Where a limb's upper bone may point, as a crowd file has it: cones, polygons, and about where the clip's own bone
// points. Throws InputError that names line and key for what can be no region.
swivel_region region_of(const formats::CrowdFile& file, const formats::Given<formats::RegionLimit>& from,
                        const formats::Clip& clip, const Limb& limb);

}  // namespace swivel::tools
