#pragma once
// SPDX-License-Identifier: MIT
// A fuzzer's input, taken piece by piece from the front: past the end all is 0, so every input means something. And
// what must hold whatever the input. A fuzzer takes the abort for a finding and keeps the input; fuzz_seeds fails.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace swivel::fuzz {

[[noreturn]] inline void report(const char* condition, const char* file, int line)
{
    std::fprintf(stderr, "%s:%d: does not hold: %s\n", file, line, condition);
    std::abort();
}

class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : text_(reinterpret_cast<const char*>(data), size) {}
    explicit Bytes(std::string_view text) : text_(text) {}

    bool is_empty() const { return text_.empty(); }

    template <class Whole>
    Whole take()
    {
        Whole value{};
        const std::string_view piece = take_text(sizeof value);
        std::memcpy(&value, piece.data(), piece.size());
        return value;
    }
    // 0 to limit - 1.
    std::uint32_t below(std::uint32_t limit) { return limit == 0 ? 0 : take<std::uint16_t>() % limit; }
    // True for one in `of` values of a byte; false past the end.
    bool one_in(std::uint8_t of) { return take<std::uint8_t>() % of == of - 1; }
    // Any bits.
    float any_float() { return std::bit_cast<float>(take<std::uint32_t>()); }
    double any_double() { return std::bit_cast<double>(take<std::uint64_t>()); }
    // -1 to 1 in steps of 1/127, so that one byte is a number and most numbers are ordinary.
    float share() { return static_cast<float>(std::max(int{take<std::int8_t>()}, -127)) / 127; }

    std::string_view take_text(std::size_t size)
    {
        const std::string_view piece = text_.substr(0, size);
        text_.remove_prefix(piece.size());
        return piece;
    }
    std::string_view rest() { return take_text(text_.size()); }

private:
    std::string_view text_;
};

}  // namespace swivel::fuzz

#define SWIVEL_REQUIRE(condition) \
    ((condition) ? static_cast<void>(0) : ::swivel::fuzz::report(#condition, __FILE__, __LINE__))
