// SPDX-License-Identifier: MIT
#include "tools/formats/height_picture.h"

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <string>

#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

constexpr png_uint_32 kMaxSide = 16'384, kMaxPixels = 1 << 26;  // pixels; in all

struct Source {
    std::string bytes;
    std::size_t at = 0;
    char problem[100] = "";
};

void take(png_structp png, png_bytep to, std::size_t count)
{
    auto& source = *static_cast<Source*>(png_get_io_ptr(png));
    if (source.bytes.size() - source.at < count) png_error(png, "it ends too early");
    std::memcpy(to, source.bytes.data() + source.at, count);
    source.at += count;
}

void note_problem(png_structp png, png_const_charp text)
{
    auto& source = *static_cast<Source*>(png_get_error_ptr(png));
    std::strncpy(source.problem, text, sizeof source.problem - 1);
    std::longjmp(png_jmpbuf(png), 1);
}

void ignore_warning(png_structp, png_const_charp) {}

// libpng leaves this function by longjmp, so nothing in it has a destructor. Samples become 16 bits wide. False: it
// failed.
bool read_picture(png_structp png, png_infop info, Source& source)
{
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_read_fn(png, &source, take);
    png_set_user_limits(png, kMaxSide, kMaxSide);
    png_read_png(png, info, PNG_TRANSFORM_EXPAND | PNG_TRANSFORM_STRIP_ALPHA | PNG_TRANSFORM_EXPAND_16, nullptr);
    return true;
}

}  // namespace

HeightPicture read_height_picture(const std::filesystem::path& path)
{
    Source source;
    append_rest(path, open_text(path).get(), source.bytes);
    const auto* const begin = reinterpret_cast<png_const_bytep>(source.bytes.data());
    if (source.bytes.size() < 8 || png_sig_cmp(begin, 0, 8) != 0)
        throw InputError(path, "is no PNG; write the picture of heights as a PNG of 8 or 16 bits");
    if (source.bytes.size() >= 24) {  // a PNG begins with its size, which tells what reading it takes
        const png_uint_32 columns = png_get_uint_32(begin + 16), rows = png_get_uint_32(begin + 20);
        if (columns > kMaxSide || rows > kMaxSide || std::uint64_t{columns} * rows > kMaxPixels)
            throw InputError(path, fmt::format("has {} x {} pixels; make it smaller: at most {} a side, and {} in all",
                                               columns, rows, kMaxSide, kMaxPixels));
    }
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, note_problem, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    HeightPicture picture;
    if (info && read_picture(png, info, source)) {
        picture.columns = png_get_image_width(png, info);
        picture.rows = png_get_image_height(png, info);
        const std::size_t step = 2 * std::size_t{png_get_channels(png, info)};
        picture.heights.reserve(std::size_t{picture.columns} * picture.rows);
        png_bytepp const rows = png_get_rows(png, info);
        for (std::uint32_t row = 0; row < picture.rows; ++row)
            for (std::uint32_t column = 0; column < picture.columns; ++column) {
                const png_bytep sample = rows[row] + column * step;
                picture.heights.push_back(static_cast<float>(256 * sample[0] + sample[1]) / 65535);
            }
    }
    png_destroy_read_struct(&png, &info, nullptr);
    if (picture.heights.empty())
        throw InputError(path, fmt::format("cannot be read as a PNG: {}; write it anew", printable(source.problem)));
    if (picture.columns < 2 || picture.rows < 2)
        throw InputError(path, fmt::format("has {} x {} pixels; a picture of heights has 2 x 2 at least",
                                           picture.columns, picture.rows));
    return picture;
}

}  // namespace swivel::formats
