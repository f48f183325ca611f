// SPDX-License-Identifier: MIT
//
// glTF as text, buffers in data: addresses: any text is read or refused in one line; see check_gltf.h for the rest.
#include <cstdint>

#include "tests/fuzz/check_gltf.h"
#include "tests/fuzz/scratch_folder.h"

using namespace swivel::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const ScratchFolder folder;
    check_gltf(folder.spill("in.gltf", text_of(data, size)), folder.path, 0);
    return 0;
}
