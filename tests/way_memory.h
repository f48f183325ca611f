// SPDX-License-Identifier: MIT
//
// Memory that one of the ways to solve reads and writes (ways.h): values of limbs or bodies packed, with gaps, joint by
// joint, or on pages that are locked away; and the arrays that a pose has.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "tests/ways.h"

namespace swivel::test {

inline constexpr std::array<double, 3> kFar = {1048576.0 * 64, -1048576.0 * 32, 1048576.0 * 8};
inline constexpr std::size_t kGap = 52;

using Limbs = std::vector<std::uint32_t>;

// Values of a crowd's limbs or bodies, in any memory, and how they came. A pose has some of each body, one for a joint.
class Values {
public:
    // first: the number of the first limb in its crowd.
    Values(std::uint32_t first, std::size_t count, std::size_t joint_count, std::size_t size, Way::Memory memory)
        : first_(first), count_(count), joint_count_(joint_count), size_(size), is_paged_(memory == Way::Memory::pages)
    {
        const bool has_gaps = memory == Way::Memory::gaps || memory == Way::Memory::joints;
        step_ = size + (has_gaps ? kGap : 0);
        stride_ = is_paged_ ? (joint_count * step_ + kPage - 1) / kPage * kPage : joint_count * step_;
        Page filled;
        std::ranges::fill(filled.bytes, '\x5a');
        pages_.resize((count * stride_ + kPage - 1) / kPage, filled);
        if (memory != Way::Memory::joints || joint_count == 1) return;
        stride_ = step_;
        for (std::size_t joint = joint_count; joint-- > 0;) offsets_.push_back(joint * count * step_);
    }
    char* at(std::size_t n, std::size_t joint = 0)
    {
        return bytes() + n * stride_ + (offsets_.empty() ? joint * step_ : offsets_[joint]);
    }
    void put(std::size_t n, const void* value) { std::memcpy(at(n), value, size_); }
    void put_far(std::size_t n, const void* floats, bool is_moved = true)
    {
        float place[3];
        std::memcpy(place, floats, sizeof place);
        for (std::size_t c = 0; c < 3; ++c) {
            const double far = (is_moved ? kFar[c] : 0) + double{place[c]};
            std::memcpy(at(n) + c * sizeof far, &far, sizeof far);
        }
    }
    swivel_in in() { return {bytes(), stride_}; }
    swivel_joint_values joints() { return {bytes(), stride_, step_, offsets_.empty() ? nullptr : offsets_.data()}; }

    void come() { came_.assign(bytes(), bytes() + kPage * pages_.size()); }
    // Whether no byte has changed; or, where a solve writes, none beside the values.
    bool is_as_it_came(bool is_written)
    {
        if (!is_written) return std::equal(came_.begin(), came_.end(), bytes());
        std::vector<char> now(bytes(), bytes() + kPage * pages_.size());
        for (std::size_t n = 0; n < count_; ++n)
            for (std::size_t joint = 0; joint < joint_count_; ++joint) {
                const std::ptrdiff_t from = at(n, joint) - bytes();
                std::copy_n(came_.begin() + from, size_, now.begin() + from);
            }
        return now == came_;
    }
    // Locks the pages of all limbs but these, or unlocks them again.
    bool protect_others(const Limbs& limbs, int rights)
    {
        for (std::uint32_t n = 0; is_paged_ && n < count_; ++n)
            if (!std::ranges::binary_search(limbs, first_ + n) && mprotect(at(n), stride_, rights) != 0) return false;
        return true;
    }

private:
    static constexpr std::size_t kPage = 4096;
    struct alignas(kPage) Page {
        char bytes[kPage];
    };
    char* bytes() { return pages_[0].bytes; }

    std::uint32_t first_;
    std::size_t count_, joint_count_, size_;
    bool is_paged_;
    std::size_t step_, stride_;
    std::vector<std::size_t> offsets_;
    std::vector<Page> pages_;
    std::vector<char> came_;
};

// What a pose has of joints, and whether a solve writes there.
struct JointArray {
    swivel_joint_values swivel_pose::*values;
    std::size_t size;
    bool is_written;
};
inline std::vector<JointArray> joint_arrays(const swivel_pose& pose)
{
    const bool moves = pose.space == SWIVEL_IN_BODY;
    const std::size_t turn = pose.form == SWIVEL_ROTATIONS ? 16 : pose.form == SWIVEL_MATRIX_COLUMNS ? 64 : 48;
    std::vector<JointArray> all = {{&swivel_pose::rotations, turn, !pose.results.data},
                                   {&swivel_pose::translations, 12, moves && !pose.translation_results.data},
                                   {&swivel_pose::scales, 12, false},
                                   {&swivel_pose::results, turn, true},
                                   {&swivel_pose::translation_results, 12, true},
                                   {&swivel_pose::joint_rotations, 16, true},
                                   {&swivel_pose::joint_positions, 12, true}};
    std::erase_if(all, [&](const JointArray& each) { return !(pose.*each.values).data; });
    return all;
}
inline const char* value_at(const swivel_joint_values& values, std::size_t body, std::size_t joint)
{
    return static_cast<char*>(values.data) + body * values.body_stride +
           (values.offsets ? values.offsets[joint] : joint * values.joint_stride);
}
// What it has of bodies.
struct BodyArray {
    swivel_in swivel_pose::*values;
    std::size_t size;
    bool is_position = false;
};
inline constexpr BodyArray kBodyArrays[] = {{&swivel_pose::root_position, 12, true},
                                            {&swivel_pose::root_rotation, 16},
                                            {&swivel_pose::root_scale, 4},
                                            {&swivel_pose::support_position, 12, true},
                                            {&swivel_pose::support_rotation, 16},
                                            {&swivel_pose::time, 4},
                                            {&swivel_pose::weight, 4}};

}  // namespace swivel::test
