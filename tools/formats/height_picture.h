#pragma once
// SPDX-License-Identifier: MIT
// A picture of heights: a PNG of 8 or 16 bits, from 0 at black to 1 at white. A coloured picture counts by its red.
// Knows no ground.

#include <cstdint>
#include <filesystem>
#include <vector>

namespace swivel::formats {

struct HeightPicture {
    std::uint32_t columns = 0, rows = 0;
    std::vector<float> heights;  // [row * columns + column], 0 to 1; the first row is the picture's upper edge
};

// Throws InputError for a file that is no PNG, is damaged, or has one pixel a row or column. Refuses more than 16,384
// pixels a side, or 67,108,864 in all, before decoding. Allocates 4 bytes a pixel, and the picture while it reads.
HeightPicture read_height_picture(const std::filesystem::path& path);

}  // namespace swivel::formats
