#pragma once
// SPDX-License-Identifier: MIT
// glTF: any bytes are read or refused in one line. What is read has a sound clip, and says the same after it was
// written.

#include "tests/fuzz/bytes.h"
#include "tests/fuzz/scratch_folder.h"

namespace swivel::fuzz {

// Bytes that start neither like a GLB nor like text are made into a GLB. The first is the rate of frames, and the next
// two are the length of the JSON. Then come the JSON and the binary chunk. So the sizes in the GLB fit, and the fuzzer
// reaches keys and accessors.
void check_gltf_of(Bytes bytes, const ScratchFolder& folder);

}  // namespace swivel::fuzz
