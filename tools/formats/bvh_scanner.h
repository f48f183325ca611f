#pragma once
// SPDX-License-Identifier: MIT
// Reads a BVH file's text word by word and counts lines; reads the HIERARCHY. Private to the reader.

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "tools/formats/bvh.h"

namespace swivel::formats {

struct Scanner {
    const std::filesystem::path& path;  // for messages
    std::string_view text;              // not empty
    std::size_t at = 0;                 // the byte to read next
    std::size_t line = 1;               // of that byte
};

// The next word, brace, or label with its colon; empty at the end of the file.
std::string_view next_token(Scanner& scan);

// The rest of the line, up to a brace, without blanks at the ends.
std::string_view rest_of_line(Scanner& scan);

// Goes on to byte `place`, counting lines. The end of the file counts as part of its last line.
void skip_to(Scanner& scan, std::size_t place);

// Takes the next token, which must be `word` in any case; throws InputError if it is not.
void expect(Scanner& scan, std::string_view word);

// Throws InputError for the current line.
[[noreturn]] void fail(const Scanner& scan, std::string_view cause);

// The same, saying that `found` stands in place of `wanted`. Empty `found`: the file has ended.
[[noreturn]] void fail_expected(const Scanner& scan, std::string_view wanted, std::string_view found);

// Reads from HIERARCHY through the word MOTION into the joints of `file` and of its clip, and counts the channels.
// Throws InputError for anything malformed. Keeps its own stack, so nesting cannot exhaust the program's.
void read_hierarchy(Scanner& scan, BvhFile& file);

}  // namespace swivel::formats
