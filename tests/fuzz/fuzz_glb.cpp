// SPDX-License-Identifier: MIT
//
// GLB: any bytes are read, or refused in one line; see check_gltf.h for the rest. Input that does not start like a GLB
// is made into one. Its first byte is the rate of frames, and the next two are the length of the JSON. Then come the
// JSON and the binary chunk. So the sizes in the GLB fit, and the fuzzer reaches keys and accessors.
#include <cstdint>

#include "tests/fuzz/bytes.h"
#include "tests/fuzz/check_clip.h"
#include "tests/fuzz/check_gltf.h"
#include "tests/fuzz/scratch_folder.h"
#include "tools/formats/gltf_container.h"
#include "tools/formats/text.h"

using namespace swivel::formats;
using namespace swivel::fuzz;

namespace {

// A container reads back as it was, its bytes padded.
void check_container(const std::filesystem::path& path, const GltfContainer& container)
{
    const GltfContainer again = read_gltf_container(path);
    const std::string json = container.json.substr(0, container.json.find_last_not_of(kBlanks) + 1);
    SWIVEL_REQUIRE(again.is_binary && again.json == json && again.other_chunks.empty());
    SWIVEL_REQUIRE(again.bytes.starts_with(container.bytes) && again.bytes.size() < container.bytes.size() + 4);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const ScratchFolder folder;
    const std::string_view text = text_of(data, size);
    if (text.starts_with("glTF")) {
        check_gltf(folder.spill("in.glb", text), folder.path, 0);
        return 0;
    }
    Bytes bytes(data, size);
    const double rate = bytes.take<std::uint8_t>();
    GltfContainer container;
    container.json = bytes.take_text(bytes.take<std::uint16_t>());
    container.bytes = bytes.rest();
    const std::filesystem::path path = folder.spill("in.glb", glb_of(container));
    check_container(path, container);
    check_gltf(path, folder.path, rate);
    return 0;
}
