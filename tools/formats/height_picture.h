#pragma once
// SPDX-License-Identifier: MIT
// A picture of heights: a PNG of 8 or 16 bits, of which black is 0 and white is 1. Of a coloured one the red counts.
// Knows no ground.

#include <cstdint>
#include <filesystem>
#include <vector>

namespace swivel::formats {

struct HeightPicture {
    std::uint32_t columns = 0, rows = 0;
    std::vector<float> heights;  // [row * columns + column], 0 to 1; the first row is the picture's upper edge
};

// Throws InputError for a file that is no PNG, is damaged, or has one pixel a row or column. And for one of more
// than 16,384 a side, or 67,108,864 in all, before it is decoded. Allocates 4 bytes a pixel, and the picture while it
// reads.
HeightPicture read_height_picture(const std::filesystem::path& path);

}  // namespace swivel::formats
