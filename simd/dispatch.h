// SPDX-License-Identifier: MIT
//
// Which kernels to run. This asks the CPU once. The environment or the caller may choose by name instead.
#pragma once

#include "simd/kernels.h"

namespace swivel {

struct Isa {
    const char* name;
    bool (*can_run)();
    Kernels kernels;
};

// The built-in instruction sets, best first; null past the last.
const Isa* isa_at(std::uint32_t index);
// The kernels for calls about a single limb, which alone find allowed arcs. They run on every CPU. They have the fewest
// lanes, so the lanes that such a call leaves empty cost it least.
const Kernels& single_limb_kernels();
// By name; null if there is none.
const Isa* find_isa(const char* name);

// The one in use. Chosen on first call: SWIVEL_FORCE_ISA, else the first that can run. Null if SWIVEL_FORCE_ISA cannot
// be used.
const Isa* current_isa();
void use_isa(const Isa& isa);

}  // namespace swivel
