#pragma once
// SPDX-License-Identifier: MIT
// A caller's arrays for the C interface, at any distances that bytes say, allowed or not. Each is exactly as long as
// its values. So the address sanitizer sees an access that is a byte too far.

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

#include "swivel/swivel.h"
#include "tests/fuzz/crowd_of_bytes.h"

namespace swivel::fuzz {

// Values of limbs, of any alignment and stride.
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

// Values of bodies' joints.
class JointArray {
public:
    JointArray(Bytes& bytes, const BodyDef& bodies, std::size_t value_bytes);
    JointArray(const JointArray&) = delete;  // its view points to its memory

    // fill(address) for each value that there is.
    template <class Fill>
    void fill(Fill fill_one)
    {
        for (std::uint32_t body = 0; body < bodies_->body_count; ++body)
            for (std::uint32_t joint = 0; joint < bodies_->joint_count(); ++joint)
                if (has(joint)) fill_one(memory_.data() + at(body, joint));
        before_ = memory_;
    }
    bool has(std::uint32_t joint) const { return !is_null_ && (!view_.offsets || is_seen_[joint]); }
    std::size_t at(std::uint32_t body, std::uint32_t joint) const;
    std::size_t value_bytes() const { return value_bytes_; }
    const swivel_joint_values& view() const { return view_; }
    // A body's values side by side, as they were before the call.
    std::vector<char> values_of(std::uint32_t body) const;
    // A value is to be this; null: it may be anything.
    void expect(std::uint32_t body, std::uint32_t joint, const char* value);
    // All is as it was, or as expected.
    void check() const { SWIVEL_REQUIRE(memory_ == before_); }

private:
    void take_steps(Bytes& bytes);

    const BodyDef* bodies_;
    std::size_t value_bytes_, start_;
    std::vector<char> memory_, before_ = {};
    std::vector<std::size_t> offsets_ = {};
    swivel_joint_values view_ = {};
    std::vector<bool> is_seen_ = {};  // whether a solve may look at a joint
    bool is_null_ = false;
};

inline JointArray::JointArray(Bytes& bytes, const BodyDef& bodies, std::size_t value_bytes)
    : bodies_(&bodies), value_bytes_(value_bytes), start_(bytes.below(8))
{
    take_steps(bytes);
    std::size_t size = start_;
    for (const std::uint32_t body : {0u, bodies_->body_count - 1})
        for (std::uint32_t joint = 0; joint < bodies_->joint_count(); ++joint)
            if (has(joint)) size = std::max(size, at(body, joint) + value_bytes_);
    memory_.assign(size, Strided::kPattern);
    before_ = memory_;
    if (!is_null_) view_.data = memory_.data() + start_;
}

inline void JointArray::take_steps(Bytes& bytes)
{
    const std::size_t joints = bodies_->joint_count();
    view_ = {nullptr, joints * value_bytes_, value_bytes_, nullptr};
    switch (bytes.take<std::uint8_t>() % 8) {
        case 1:  // joint by joint
            view_.body_stride = value_bytes_, view_.joint_stride = bodies_->body_count * value_bytes_;
            break;
        case 2:
            view_.joint_stride += bytes.below(9);
            view_.body_stride = joints * view_.joint_stride + bytes.below(300);
            break;
        case 3:  // in another order; nobody may look at joints that no limb needs or moves
            for (std::uint32_t joint = 0; joint < joints; ++joint) is_seen_.push_back(bodies_->is_seen(joint));
            for (std::uint32_t joint = 0; joint < joints; ++joint)
                offsets_.push_back(is_seen_[joint] ? (joints - 1 - joint) * value_bytes_ : ~std::size_t{0} / 4);
            view_.offsets = offsets_.data();
            view_.joint_stride = bytes.below(2);
            break;
        case 4:  // the same for all bodies
            view_.body_stride = 0;
            break;
        case 5:  // for all joints
            view_.body_stride = value_bytes_, view_.joint_stride = 0;
            break;
        case 6:
            if (bytes.one_in(8))
                (bytes.one_in(2) ? view_.body_stride : view_.joint_stride) =
                    bytes.below(static_cast<std::uint32_t>(value_bytes_));
            break;
        case 7:
            is_null_ = bytes.one_in(4);
    }
}

inline std::size_t JointArray::at(std::uint32_t body, std::uint32_t joint) const
{
    return start_ + body * view_.body_stride + (view_.offsets ? view_.offsets[joint] : joint * view_.joint_stride);
}

inline std::vector<char> JointArray::values_of(std::uint32_t body) const
{
    std::vector<char> values(bodies_->joint_count() * value_bytes_);
    for (std::uint32_t joint = 0; joint < bodies_->joint_count(); ++joint)
        if (has(joint)) std::memcpy(&values[joint * value_bytes_], &before_[at(body, joint)], value_bytes_);
    return values;
}

inline void JointArray::expect(std::uint32_t body, std::uint32_t joint, const char* value)
{
    std::memcpy(&before_[at(body, joint)], value ? value : &memory_[at(body, joint)], value_bytes_);
}

}  // namespace swivel::fuzz
