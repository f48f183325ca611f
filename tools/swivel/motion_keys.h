// SPDX-License-Identifier: MIT
//
// Collects the solved poses for a motion file that is written at the end: the first character's rotations in the file's
// frames, or whole characters in new frames. Limbs are as solved, all else is as in the clip's frame that the character
// shows, raised with its ground.
#pragma once

#include <span>
#include <vector>

#include "tools/crowd/clip_crowd.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

inline constexpr std::uint32_t kMaxInFile = 200;  // characters

class MotionKeys {
public:
    // Keeps keys of the limbs' joints and the look's, and with new frames of all joints that move in the clip. The clip
    // must outlive it.
    MotionKeys(const formats::Clip& clip, std::span<const Limb> limbs, const CrowdPlan& plan, bool has_new_frames);

    // Throws early if write() would fail: for joints that cannot have keys; with new frames also for joints that change
    // their size, and for more than 3 GB of keys.
    void require_can_write(const std::filesystem::path& out, const MotionFile& file, std::size_t frame_count) const;

    // Takes the frame that the crowd has solved.
    void add(const ClipCrowd& crowd);

    // Writes the clip's file with the frames that were taken. It throws as MotionFile::write() does.
    void write(const std::filesystem::path& out, const MotionFile& file,
               std::span<const goal_character> characters) const;

private:
    // A solved joint, with its limb and the number of its rotation; 3: the joint above. The look counts as the last
    // limb, with rotations counted along it.
    struct Solved {
        std::size_t limb, part;
        int joint;
        std::size_t turning = 0;  // in turning_
    };

    const formats::Clip& clip_;
    bool has_new_frames_;
    std::uint32_t characters_;
    std::size_t limb_count_;
    std::vector<std::string> names_;     // of the characters' nodes; none: they are counted
    std::vector<int> turning_, moving_;  // joints that have keys of rotation, of translation
    int raised_ = -1;                    // the joint that the ground raises with all joints below; -1: none
    std::vector<Solved> solved_;
    std::vector<std::vector<Eigen::Quaterniond>> rotations_;  // [character * turning joints + n][frame]
    std::vector<std::vector<Eigen::Vector3d>> places_;        // [character * moving joints + n][frame]
};

}  // namespace swivel::tools
