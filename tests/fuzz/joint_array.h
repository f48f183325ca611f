#pragma once
// SPDX-License-Identifier: MIT
// Values of bodies' joints in a caller's array, at distances that bytes say, allowed or not. It is as long as its
// values. So the address sanitizer sees an access past its end.

#include <vector>

#include "tests/fuzz/bodies_of_bytes.h"
#include "tests/fuzz/require.h"

namespace swivel::fuzz {

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

}  // namespace swivel::fuzz
