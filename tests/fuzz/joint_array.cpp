// SPDX-License-Identifier: MIT
#include "tests/fuzz/joint_array.h"

#include <algorithm>
#include <cstring>

#include "tests/fuzz/strided.h"

namespace swivel::fuzz {

JointArray::JointArray(Bytes& bytes, const BodyDef& bodies, std::size_t value_bytes)
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

void JointArray::take_steps(Bytes& bytes)
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

std::size_t JointArray::at(std::uint32_t body, std::uint32_t joint) const
{
    return start_ + body * view_.body_stride + (view_.offsets ? view_.offsets[joint] : joint * view_.joint_stride);
}

std::vector<char> JointArray::values_of(std::uint32_t body) const
{
    std::vector<char> values(bodies_->joint_count() * value_bytes_);
    for (std::uint32_t joint = 0; joint < bodies_->joint_count(); ++joint)
        if (has(joint)) std::memcpy(&values[joint * value_bytes_], &before_[at(body, joint)], value_bytes_);
    return values;
}

void JointArray::expect(std::uint32_t body, std::uint32_t joint, const char* value)
{
    std::memcpy(&before_[at(body, joint)], value ? value : &memory_[at(body, joint)], value_bytes_);
}

}  // namespace swivel::fuzz
