// SPDX-License-Identifier: MIT
//
// A crowd that performs a clip. Every character has the clip's skeleton, and a size, place and start of its own. In
// each frame its limbs have goals from the clip or from the user. Knows clips and the public interface; no file format.
#pragma once

#include <span>
#include <vector>

#include "tools/crowd/characters.h"
#include "tools/crowd/clip_motion.h"
#include "tools/crowd/goal_crowd.h"
#include "tools/crowd/statistics.h"
#include "tools/formats/poses_csv.h"
#include "tools/formats/targets_csv.h"

namespace swivel::tools {

class ClipCrowd {
public:
    // Its characters are characters_of() the plan. The incoming pose is the clip's. limbs, plan and clip must outlive
    // the crowd. Memory grows with characters and with frames, not with their product.
    ClipCrowd(const formats::Clip& clip, std::span<const Limb> limbs, const CrowdPlan& plan);

    std::uint32_t character_count() const { return crowd_.character_count(); }

    // Sets all inputs for a frame; frames follow each other. given: this frame's targets in the world. Limbs without
    // one take their plan's point or follow the clip. Without a pole elbows and knees go as the clip's do, without an
    // orientation hands and feet keep the clip's. Every character and limb in given must exist.
    void set_frame(std::size_t frame, std::span<const formats::Target> given);

    // The frame's goals of all limbs, in order of character, then limb. Given to set_frame() they give the same frame.
    // Limbs that move with a body on ground, or hold another hand, are left out.
    std::span<const formats::Target> targets();

    // Solves the frame; adds the time it took.
    void solve(Statistics& statistics);

    // Adds the errors, differences from the clip and flags of the limbs solved in this frame, by forward kinematics in
    // double.
    void measure(Statistics& statistics) const;

    // One limb's local rotations as the skeleton stores them: shoulder, elbow, wrist, or hip, knee, ankle. A wrist that
    // is not solved is the clip's.
    formats::PoseRow pose(std::size_t limb, std::uint32_t character) const;
    // The local rotation of the joint above a limb whose plan has a clavicle.
    Eigen::Quaterniond clavicle(std::size_t limb, std::uint32_t character) const;
    // The local rotation of one of the joints of the plan's look.
    Eigen::Quaterniond looking(std::size_t joint, std::uint32_t character) const;
    // All poses, in order of character, then limb, and the columns that the plan asks for beside.
    std::span<const formats::PoseRow> poses();
    std::span<const formats::PoseExtra> extras();
    formats::PoseColumns columns() const;

    // The crowd's setup, for a page or a cache that solves it again.
    const GoalCrowd& goal_crowd() const { return crowd_; }
    const ClipMotion& motion() const { return motion_; }
    // The limbs that this frame's given targets are for.
    std::vector<GivenPlace> given_places() const;

private:
    std::size_t clip_frame(std::uint32_t character) const { return crowd_.clip_frame(character); }
    std::span<const goal_character> characters() const { return crowd_.characters(); }
    const LimbInClip& in_clip(std::size_t limb, std::uint32_t character) const
    {
        return motion_.at(clip_frame(character), limb);
    }
    std::size_t limb_index(formats::LimbName name) const;  // of one that is solved
    bool carries(std::size_t limb, std::uint32_t character) const;
    // A vector or a rotation of the clip, turned along with a character.
    Eigen::Vector3d headed(std::uint32_t character, Eigen::Vector3d v) const;
    Eigen::Quaterniond headed(std::uint32_t character, const Eigen::Quaterniond& q) const;
    bool follows_clip(std::size_t limb, std::uint32_t character) const;
    // The rotations of the solver's two bones, without flags.
    formats::PoseRow solved_pose(std::size_t limb, std::uint32_t character) const;
    formats::Target target(std::size_t limb, std::uint32_t character) const;
    const formats::Target* given(std::size_t limb, std::uint32_t character) const;  // in this frame; null: none
    void set_given(std::size_t limb, std::uint32_t character);
    double length(std::size_t limb, std::uint32_t character) const;  // of both bones
    formats::PoseExtra extra(std::size_t limb, std::uint32_t character) const;
    // Fills in rows of all characters and limbs.
    template <class Row, class Make>
    std::span<const Row> rows_of(std::vector<Row>& rows, const Make& make) const;
    void measure_range(std::size_t limb, std::uint32_t begin, std::uint32_t end, LimbStatistics& statistics) const;
    // Where a pose has its joints, in the world.
    struct Reached {
        Eigen::Vector3d elbow, wrist;
        Eigen::Quaterniond upper, fore, hand;
    };
    Reached reached(std::size_t limb, const formats::PoseRow& row, double stretch) const;
    Eigen::Vector3d offset(std::size_t limb, std::uint32_t character) const;  // of a given target
    Eigen::Vector3d target_point(std::size_t limb, std::uint32_t character) const;
    void measure_against_clip(std::size_t limb, const PoseName& pose, const Reached& at,
                              LimbStatistics& statistics) const;

    const formats::Clip& clip_;
    ClipMotion motion_;
    std::span<const Limb> limbs_;
    const CrowdPlan& plan_;
    std::vector<LimbSetup> setups_;
    std::vector<formats::Target> given_;               // to set_frame()
    std::vector<std::vector<std::int32_t>> given_at_;  // [limb][character]: which of them; -1: none
    std::vector<formats::Target> targets_;
    std::vector<formats::PoseRow> rows_;
    std::vector<formats::PoseExtra> extras_;  // empty unless there are columns for them
    std::size_t frame_ = 0;
    GoalCrowd crowd_;
};

}  // namespace swivel::tools
