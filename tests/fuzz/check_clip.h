#pragma once
// SPDX-License-Identifier: MIT
// What every reader of motion promises of its clip, and of its messages.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "tests/fuzz/require.h"
#include "tools/formats/clip.h"
#include "tools/formats/error.h"

namespace swivel::fuzz {

// One line that can be printed as it is.
inline void check_message(const formats::InputError& error)
{
    const std::string_view text = error.what();
    SWIVEL_REQUIRE(!text.empty());
    SWIVEL_REQUIRE(text.find_first_of("\n\r") == std::string_view::npos);
}

// What `read` returns; nothing if it refuses the file, in one line.
template <class Read>
auto read_or_refuse(const Read& read) -> std::optional<decltype(read())>
{
    try {
        return read();
    } catch (const formats::InputError& error) {
        check_message(error);
        return std::nullopt;
    }
}

inline bool is_unit(const Eigen::Quaterniond& q) { return std::abs(q.norm() - 1) < 1e-6; }

inline void check_joint(const formats::Clip& clip, std::size_t n)
{
    const formats::Joint& joint = clip.joints[n];
    SWIVEL_REQUIRE(joint.parent >= -1 && joint.parent < static_cast<int>(n));
    SWIVEL_REQUIRE(joint.track >= -1 && joint.track < static_cast<int>(clip.track_count));
    SWIVEL_REQUIRE(joint.scale_track >= -1 && joint.scale_track < static_cast<int>(clip.scale_track_count));
    SWIVEL_REQUIRE(joint.offset.allFinite());
    SWIVEL_REQUIRE(joint.rest_scale.allFinite());
    SWIVEL_REQUIRE(is_unit(joint.rest_rotation));
}

inline void check_clip(const formats::Clip& clip)
{
    SWIVEL_REQUIRE(!clip.joints.empty() && clip.frame_count > 0);
    SWIVEL_REQUIRE(clip.frame_time >= 0 && std::isfinite(clip.frame_time));  // 0: uneven frames
    SWIVEL_REQUIRE(clip.rotation.size() == clip.frame_count * clip.joints.size());
    SWIVEL_REQUIRE(clip.translation.size() == clip.frame_count * clip.track_count);
    SWIVEL_REQUIRE(clip.scale.size() == clip.frame_count * clip.scale_track_count);
    for (std::size_t n = 0; n < clip.joints.size(); ++n) check_joint(clip, n);
    for (const Eigen::Quaterniond& rotation : clip.rotation) SWIVEL_REQUIRE(is_unit(rotation));
    for (const Eigen::Vector3d& translation : clip.translation) SWIVEL_REQUIRE(translation.allFinite());
    for (const Eigen::Vector3d& scale : clip.scale) SWIVEL_REQUIRE(scale.allFinite());

    world_pose(clip, clip.frame_count - 1);
    rest_pose(clip);
    const int last = static_cast<int>(clip.joints.size()) - 1;
    const std::vector<int> found = find_joints(clip, joint_path(clip, last));
    SWIVEL_REQUIRE(std::find(found.begin(), found.end(), last) != found.end());
}

// The clip's rotations of one joint, as a writer takes them.
inline std::vector<Eigen::Quaterniond> rotations_of(const formats::Clip& clip, std::size_t joint)
{
    std::vector<Eigen::Quaterniond> rotations;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        rotations.push_back(clip.rotation[frame * clip.joints.size() + joint]);
    return rotations;
}

}  // namespace swivel::fuzz
