#pragma once
// SPDX-License-Identifier: MIT
// Helpers of all text formats: a file as one string, words of a line, and numbers.
// Numbers are read by std::from_chars, so no locale can change them. Knows no format.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace swivel::formats {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using TextFile = std::unique_ptr<std::FILE, CloseFile>;

// Whether a name stands for standard input, or for standard output where something is written: "-".
inline bool is_standard_stream(const std::filesystem::path& path) { return path == "-"; }

// Opens a file, or standard input, to be read. Throws InputError when it is missing, a directory, or not readable.
TextFile open_text(const std::filesystem::path& path);

// Reads up to `size` bytes into `buffer`; fewer, or none, only at the end of the file. Throws InputError on a read
// error and for a binary file (one with a zero byte). `path` is for messages.
std::size_t read_chunk(const std::filesystem::path& path, std::FILE* file, char* buffer, std::size_t size);

// The whole file, every byte as it is. Throws InputError as the two above do, for an empty file, and for more than
// 2 GiB: a device may have no end. Holds the file once; reading from a pipe works.
std::string read_text(const std::filesystem::path& path);

// The same for an open file whose first bytes are `begin`. path: its name in messages.
std::string read_text(const std::filesystem::path& path, std::FILE* file, std::string begin);

// Appends the next bytes of any file, text or binary: `max` of them, or fewer at its end. Throws InputError on a read
// error. Allocates as bytes come, not `max` at once.
void append_bytes(const std::filesystem::path& path, std::FILE* file, std::size_t max, std::string& bytes);

// Appends the rest of any file, with the limit of read_text(). advice: what to do about a longer one.
void append_rest(const std::filesystem::path& path, std::FILE* file, std::string& bytes,
                 std::string_view advice = "cut it");

// `text` without the mark of three bytes that some editors put before UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

constexpr std::string_view kBlanks = " \t\r\n\v\f";

// Takes the next word, a run of anything but blanks, off the front of `rest`; empty when only blanks are left.
// The word points into the text `rest` points into.
std::string_view take_word(std::string_view& rest);

// `text` without blanks at either end.
std::string_view trimmed(std::string_view text);

// True if the two are equal when ASCII letters are compared without case.
bool same_ignoring_case(std::string_view a, std::string_view b);

// The end of a path's name from its last dot on, in lower case: ".glb" of "Walk.GLB". Empty: no suffix.
std::string lower_suffix(const std::filesystem::path& path);

// The whole of `text` as a finite decimal number, such as -1.5, .5, 5. or +1e-3. Nothing for anything else: NaN,
// infinity, hexadecimal, trailing characters, more than a double can hold.
std::optional<double> parse_number(std::string_view text);

// The whole of `text` as a whole decimal number. Nothing for anything else, 1.0 included.
std::optional<std::int64_t> parse_integer(std::string_view text);

// Numbers with commas between, such as 1,2.5; empty if one is no number.
std::vector<double> numbers_of(const std::string& text);

// Words with `between` between. fmt::join() does the same in seven kilobytes of code a file.
std::string joined(const auto& words, std::string_view between)
{
    std::string text;
    for (bool is_first = true; const std::string_view word : words) {
        if (!std::exchange(is_first, false)) text += between;
        text += word;
    }
    return text;
}

}  // namespace swivel::formats
