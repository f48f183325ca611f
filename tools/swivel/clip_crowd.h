// SPDX-License-Identifier: MIT
//
// A crowd that performs a clip: every character has the clip's skeleton, its own limb lengths, place and start, and
// targets for wrists, elbows and hands, ankles, knees and feet for each frame, taken from the clip or given. Knows
// clips and the public interface; no file format.
#pragma once

#include <span>
#include <vector>

#include "tools/formats/poses_csv.h"
#include "tools/formats/targets_csv.h"
#include "tools/swivel/limbs.h"
#include "tools/swivel/statistics.h"

namespace swivel::tools {

class ClipCrowd {
public:
    // Character 0 is the clip's own. The others differ by the seed: limb lengths by a factor in 0.85..1.15, and targets
    // taken from the clip reach by the same factor; start anywhere in the clip. Character n stands 3 arm spans (leg
    // spans where no arm is solved) apart from its neighbours on a square grid in X and Z: column n % w, row n / w, w =
    // ceil(sqrt(characters)). clip and limbs must outlive the crowd. Memory grows with characters and with frames, not
    // with their product.
    ClipCrowd(const formats::Clip& clip, std::span<const Limb> limbs, std::uint32_t characters, std::uint64_t seed);

    std::uint32_t character_count() const { return static_cast<std::uint32_t>(characters_.size()); }

    // Sets all inputs for a frame. given: this frame's targets in the world; limbs without one follow the clip, and
    // hands and feet without an orientation keep the clip's. Every character and limb in given must exist.
    void set_frame(std::size_t frame, std::span<const formats::Target> given);

    // Solves the frame; adds the time it took.
    void solve(Statistics& statistics);

    // Adds what the solved frame's errors and flags are, by forward kinematics in double.
    void measure(Statistics& statistics) const;

    // One limb's solved local rotations: shoulder, elbow, wrist, or hip, knee, ankle.
    formats::PoseRow pose(std::size_t limb, std::uint32_t character) const;
    // All of them, in order of character, then limb.
    std::span<const formats::PoseRow> poses();

private:
    struct Source {  // where the clip has one limb in one frame, relative to the root joint
        Eigen::Vector3d shoulder, elbow, wrist;
        Eigen::Quaterniond parent, hand, upper, fore;
    };
    struct Character {
        double reach = 1;       // factor of limb lengths and of targets
        std::size_t start = 0;  // frame of the clip it starts at
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
    };
    struct Goal {  // what one limb was asked for, relative to its character's root
        Eigen::Vector3d wrist, pole;
        Eigen::Quaterniond hand;
        bool from_clip;
    };
    struct Input {  // the same as the solver takes it
        float target[3], pole[3], lengths[2], position[3], rotation[4], hand[4];
    };

    const Source& source(std::size_t limb, std::uint32_t character) const;
    Goal goal_from_clip(std::size_t limb, std::uint32_t character) const;
    void put(std::size_t limb, std::uint32_t character, const Goal& goal);
    void measure_range(std::size_t limb, std::uint32_t begin, std::uint32_t end, LimbStatistics& statistics) const;
    void measure_against_clip(std::size_t limb, std::uint32_t character, const Eigen::Vector3d& elbow,
                              LimbStatistics& statistics) const;

    const formats::Clip& clip_;
    std::span<const Limb> limbs_;
    std::vector<Source> sources_;         // [frame * limbs + limb]
    std::vector<Eigen::Vector3d> roots_;  // the root joint in the world, by frame
    std::vector<Character> characters_;
    std::vector<std::vector<Goal>> goals_;    // [limb][character]
    std::vector<std::vector<Input>> inputs_;  // [limb][character]
    std::vector<formats::PoseRow> rows_;
    std::size_t frame_ = 0;
    Crowd crowd_;
};

}  // namespace swivel::tools
