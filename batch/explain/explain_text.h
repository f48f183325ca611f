// SPDX-License-Identifier: MIT
//
// Text in a buffer, always with a 0 at its end. A text that does not fit ends in three dots.
#pragma once

#include <algorithm>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <span>

namespace swivel {

inline double in_degrees(double radians) { return radians * 180 / std::numbers::pi; }

class Text {
public:
    explicit Text(std::span<char> room) : room_(room) { room_[0] = 0; }

    [[gnu::format(printf, 2, 3)]] void add(const char* format, ...)
    {
        std::va_list arguments;
        va_start(arguments, format);
        const std::size_t left = room_.size() - used_;
        const int length = std::vsnprintf(room_.data() + used_, left, format, arguments);
        va_end(arguments);
        if (length < 0) return;
        used_ += std::min(static_cast<std::size_t>(length), left - 1);
        if (static_cast<std::size_t>(length) < left) return;
        for (std::size_t at = used_ - std::min(used_, std::size_t{3}); at < used_; ++at) room_[at] = '.';
    }
    bool is_empty() const { return used_ == 0; }

private:
    std::span<char> room_;
    std::size_t used_ = 0;
};

}  // namespace swivel
