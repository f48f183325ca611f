#pragma once
// SPDX-License-Identifier: MIT
// A caller's array for the C interface, of any alignment and stride, allowed or not. It is exactly as long as its
// values. So the address sanitizer sees an access that is a byte too far on either side.

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>

#include "swivel/swivel.h"
#include "tests/fuzz/bytes.h"
#include "tests/fuzz/require.h"

namespace swivel::fuzz {

class Strided {
public:
    // may_repeat: a stride of 0 is allowed.
    Strided(Bytes& bytes, std::size_t count, std::size_t value_bytes, bool may_repeat)
        : count_(count), value_bytes_(value_bytes)
    {
        switch (bytes.take<std::uint8_t>() % 8) {
            case 1:
                stride_ = 0;
                break;
            case 2:
                stride_ = value_bytes + bytes.below(9);
                break;
            case 3:
                stride_ = value_bytes + bytes.below(300);
                break;
            case 4:  // too small
                stride_ = bytes.below(static_cast<std::uint32_t>(value_bytes));
                break;
            case 5:  // of no use beside one value, and of no harm
                stride_ = count <= 1 ? std::max(bytes.take<std::size_t>() >> 8, value_bytes) : value_bytes;
                break;
            case 6:
                is_null_ = bytes.one_in(4);
                [[fallthrough]];
            default:
                stride_ = value_bytes;
        }
        is_valid_ = (!is_null_ || count == 0) && (stride_ >= value_bytes || (may_repeat && stride_ == 0));
        start_ = bytes.below(8);
        size_ = is_valid_ ? (count == 0 ? 0 : (stride_ == 0 ? 0 : (count - 1) * stride_) + value_bytes) : 0;
        memory_ = std::make_unique<char[]>(start_ + size_);
        std::memset(memory_.get(), kPattern, start_ + size_);
    }

    bool is_valid() const { return is_valid_; }
    bool is_null() const { return is_null_; }
    std::size_t stride() const { return stride_; }
    std::size_t value_bytes() const { return value_bytes_; }
    char* at(std::size_t n) const { return memory_.get() + start_ + n * stride_; }
    char* data() const { return is_null_ ? nullptr : memory_.get() + start_; }
    swivel_in in() const { return {data(), stride_}; }
    swivel_out out() const { return {data(), stride_}; }

    // fill(n, address) for each value, the last first where they share an address.
    template <class Fill>
    void fill(Fill fill_one)
    {
        if (!is_valid_) return;
        for (std::size_t n = count_; n-- > 0;) fill_one(n, at(n));
    }

    // No byte beside the values was written; none at all if `untouched`.
    void check_gaps(bool untouched) const
    {
        std::size_t value_at = start_, value_index = 0;
        for (std::size_t n = 0; n < start_ + size_; ++n) {
            while (value_index < count_ && n >= value_at + value_bytes_) value_at += stride_, ++value_index;
            const bool in_value = !untouched && value_index < count_ && n >= value_at;
            SWIVEL_REQUIRE(in_value || memory_[n] == kPattern);
        }
    }

    static constexpr char kPattern = 0x5a;  // what every byte starts as

private:
    std::size_t count_, value_bytes_, stride_ = 0, start_ = 0, size_ = 0;
    bool is_valid_ = false, is_null_ = false;
    std::unique_ptr<char[]> memory_;
};

}  // namespace swivel::fuzz
