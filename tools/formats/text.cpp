// SPDX-License-Identifier: MIT
#include "tools/formats/text.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <new>
#include <system_error>

#include "tools/formats/error.h"

namespace swivel::formats {
namespace {

constexpr std::size_t kChunkBytes = 1 << 20, kMaxBytes = std::size_t{2} << 30;

// from_chars takes no plus sign, files do.
std::string_view without_plus(std::string_view text)
{
    const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
    return has_plus ? text.substr(1) : text;
}

template <class Number>
std::optional<Number> parse_whole(std::string_view text)
{
    const std::string_view digits = without_plus(text);
    Number value{};
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (status != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
    return value;
}

std::size_t read_some(const std::filesystem::path& path, std::FILE* file, char* buffer, std::size_t size)
{
    const std::size_t count = std::fread(buffer, 1, size, file);
    if (std::ferror(file)) throw InputError(path, "cannot be read to its end; check the disk");
    return count;
}

void require_text(const std::filesystem::path& path, std::string_view bytes)
{
    const bool is_binary = bytes.find('\0') != std::string_view::npos;
    if (is_binary) throw InputError(path, "is a binary file; a text file is needed");
}

// The bytes left in a plain file; 0: unknown.
std::size_t size_beyond(std::FILE* file)
{
    struct stat status {};
    const off_t at = ::ftello(file);
    if (at < 0 || ::fstat(::fileno(file), &status) != 0 || !S_ISREG(status.st_mode)) return 0;
    return static_cast<std::size_t>(std::max(status.st_size - at, off_t{0}));
}

void append(const std::filesystem::path& path, std::FILE* file, std::size_t max, std::string& bytes, bool is_text)
{
    bytes.reserve(bytes.size() + std::min(max, size_beyond(file)));
    const auto chunk = std::make_unique_for_overwrite<char[]>(kChunkBytes);
    while (max > 0) {
        const std::size_t count = read_some(path, file, chunk.get(), std::min(max, kChunkBytes));
        if (is_text) require_text(path, {chunk.get(), count});
        if (count == 0) return;
        bytes.append(chunk.get(), count);
        max -= count;
    }
}

// The rest of a file, appended to `bytes`.
void append_all(const std::filesystem::path& path, std::FILE* file, std::string& bytes, std::string_view advice,
                bool is_text)
{
    const auto require = [&](std::size_t size) {
        if (size > kMaxBytes) throw InputError(path, fmt::format("is longer than 2 GiB; {}", advice));
    };
    require(bytes.size() + size_beyond(file));  // a plain file need not be read for this
    append(path, file, kMaxBytes + 1 - bytes.size(), bytes, is_text);
    require(bytes.size());
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

TextFile open_text(const std::filesystem::path& path)
{
    if (is_standard_stream(path)) {
        TextFile input(::fdopen(::dup(STDIN_FILENO), "rb"));
        if (!input && errno == ENOMEM) throw std::bad_alloc();
        if (!input) throw InputError(path, "is closed; give a file");
        return input;
    }
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        throw InputError(path, "is a directory; name a file in it");
    }
    TextFile file(std::fopen(path.c_str(), "rb"));
    if (!file) {
        if (errno == ENOMEM) throw std::bad_alloc();  // no fault of the file's
        const std::string reason = std::generic_category().message(errno);
        throw InputError(path, fmt::format("cannot be opened: {}; check the path", reason));
    }
    return file;
}

std::size_t read_chunk(const std::filesystem::path& path, std::FILE* file, char* buffer, std::size_t size)
{
    const std::size_t count = read_some(path, file, buffer, size);
    require_text(path, {buffer, count});
    return count;
}

std::string read_text(const std::filesystem::path& path) { return read_text(path, open_text(path).get(), {}); }

std::string read_text(const std::filesystem::path& path, std::FILE* file, std::string begin)
{
    require_text(path, begin);
    append_all(path, file, begin, "cut it", true);
    if (begin.empty()) throw InputError(path, "is empty; check how it was written");
    return begin;
}

void append_bytes(const std::filesystem::path& path, std::FILE* file, std::size_t max, std::string& bytes)
{
    append(path, file, max, bytes, false);
}

void append_rest(const std::filesystem::path& path, std::FILE* file, std::string& bytes, std::string_view advice)
{
    append_all(path, file, bytes, advice, false);
}

std::string_view without_byte_order_mark(std::string_view text)
{
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
    return text;
}

std::string_view take_word(std::string_view& rest)
{
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(kBlanks));
    rest.remove_prefix(word.size());
    return word;
}

std::string_view trimmed(std::string_view text)
{
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

bool same_ignoring_case(std::string_view a, std::string_view b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

std::string lower_suffix(const std::filesystem::path& path)
{
    std::string suffix = path.extension().string();
    std::transform(suffix.begin(), suffix.end(), suffix.begin(), lower);
    return suffix;
}

std::optional<double> parse_number(std::string_view text)
{
    const std::optional<double> number = parse_whole<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::int64_t> parse_integer(std::string_view text) { return parse_whole<std::int64_t>(text); }

std::vector<double> numbers_of(const std::string& text)
{
    std::vector<double> values;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        double value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc() || !std::isfinite(value)) return {};
        values.push_back(value);
        if (next == end) return values;
        if (*next != ',') return {};
        at = next + 1;
    }
}

}  // namespace swivel::formats
