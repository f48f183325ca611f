// SPDX-License-Identifier: MIT
//
// The picture of heights: any bytes are read or refused in one line. What is read has its pixels, from 0 to 1.
#include <algorithm>
#include <cstdint>

#include "tests/fuzz/check_clip.h"
#include "tests/fuzz/scratch_folder.h"
#include "tools/formats/height_picture.h"

using namespace swivel::formats;
using namespace swivel::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const ScratchFolder folder;
    try {
        const HeightPicture picture = read_height_picture(folder.spill("in.png", text_of(data, size)));
        SWIVEL_REQUIRE(picture.columns >= 2 && picture.rows >= 2);
        SWIVEL_REQUIRE(picture.heights.size() == std::size_t{picture.columns} * picture.rows);
        SWIVEL_REQUIRE(std::ranges::all_of(picture.heights, [](float height) { return height >= 0 && height <= 1; }));
    } catch (const InputError& error) {
        check_message(error);
    }
    return 0;
}
