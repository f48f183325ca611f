// SPDX-License-Identifier: MIT
//
// Finds visible faults in a clip. Some are the body's, in any motion: left and right exchanged, a knee that bends the
// wrong way. Others are the motion's: a joint that jumps in one frame, a limb that never moves, feet below the ground.
// Knows clips and the parts of bodies.
#pragma once

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/rig/body_parts.h"

namespace swivel::tools {

inline constexpr double kMostly = 0.25;  // of the frames

// The frames of a clip with some property.
struct SomeFrames {
    std::size_t all;  // frames of the clip
    std::size_t count = 0, first = 0;

    void add(std::size_t frame)
    {
        if (count++ == 0) first = frame;
    }
    bool are_over(double share) const { return static_cast<double>(count) > share * static_cast<double>(all); }
    // "in 20 of 120 frames, from frame 100"
    std::string words() const;
};

// The places of the judged joints of a body, in all frames of a clip.
class BodyFrames {
public:
    // The joints' places in one frame: limbs, then toes and hips.
    using Places = std::vector<Eigen::Vector3d>;

    // parts: of body_parts(). Clip and parts must outlive the object.
    BodyFrames(const formats::Clip& clip, const std::vector<BodyPart>& parts);

    const formats::Clip& clip() const { return clip_; }
    const std::vector<BodyPart>& parts() const { return parts_; }
    const KnownLimbs& limbs() const { return limbs_; }
    const Eigen::Vector3d& up_w() const { return up_w_; }  // the axis of the world, by the rest pose
    int hips() const { return hips_; }                     // -1: unknown
    std::size_t count() const { return frames_w_.size(); }
    const Places& rest_w() const { return rest_w_; }
    const std::vector<Places>& frames_w() const { return frames_w_; }

    // A pair of limbs: 0 for arms, 2 for legs. A side: 0 for the left one.
    bool has(std::size_t pair) const { return limbs_[pair] && limbs_[pair + 1]; }
    bool has_toes(std::size_t side) const { return limbs_[2 + side] && toes_[side] >= 0; }
    const Eigen::Vector3d& place(const Places& places_w, int joint) const
    {
        return places_w[slots_[static_cast<std::size_t>(joint)]];
    }
    Eigen::Vector3d bone_w(const Places& places_w, std::size_t limb, std::size_t bone) const
    {
        return place(places_w, (*limbs_[limb])[bone + 1]) - place(places_w, (*limbs_[limb])[bone]);
    }
    Eigen::Vector3d toe_way_w(const Places& places_w, std::size_t side) const
    {
        return place(places_w, toes_[side]) - place(places_w, (*limbs_[2 + side])[2]);
    }
    // The toe, or else the ankle.
    const Eigen::Vector3d& low_w(const Places& places_w, std::size_t side) const
    {
        return place(places_w, has_toes(side) ? toes_[side] : (*limbs_[2 + side])[2]);
    }
    Eigen::Vector3d to_left_w(const Places& places_w, std::size_t pair) const
    {
        return place(places_w, (*limbs_[pair])[0]) - place(places_w, (*limbs_[pair + 1])[0]);
    }
    // The left of a pair of limbs, and its front, unit. In a figure that is mirrored as a whole, the limbs called left
    // are on its right.
    Eigen::Vector3d left_w(const Places& places_w, std::size_t pair) const
    {
        return (is_mirrored_ ? -1 : 1) * to_left_w(places_w, pair).normalized();
    }
    Eigen::Vector3d front_w(const Places& places_w, std::size_t pair) const
    {
        return left_w(places_w, pair).cross(up_w_).normalized();
    }
    double leg_length() const;  // at rest; a leg must be known

    // The frames for which is_so holds.
    template <class IsSo>
    SomeFrames where(const IsSo& is_so) const
    {
        SomeFrames frames{count()};
        for (std::size_t frame = 0; frame < count(); ++frame)
            if (is_so(frames_w_[frame])) frames.add(frame);
        return frames;
    }

private:
    Places places_of(const std::vector<formats::JointPose>& pose_w) const;

    const formats::Clip& clip_;
    const std::vector<BodyPart>& parts_;
    KnownLimbs limbs_;
    std::array<int, 2> toes_{-1, -1};
    Eigen::Vector3d up_w_;
    int hips_ = -1;
    bool is_mirrored_ = false;
    std::vector<std::size_t> seen_, slots_;  // joints, and where each is among them
    Places rest_w_;
    std::vector<Places> frames_w_;
};

// A thing in a clip that stands out.
struct ClipDoubt {
    std::string text;          // a line for people
    bool is_garbage = false;   // nobody is built or bends like that, for a quarter of the frames or more
    double leg_lengths = 0;    // the length that the text has in leg lengths; 0: none
    bool is_up_wrong = false;  // it is about the axes, and stands alone, since all else would follow from it
};

// Doubts in the order in which they are found.
struct DoubtList {
    std::vector<ClipDoubt> all;

    template <class... Words>
    ClipDoubt& look(fmt::format_string<Words...> text, Words&&... words)
    {
        return all.emplace_back(ClipDoubt{fmt::format(text, std::forward<Words>(words)...)});
    }
    template <class... Words>
    void garbage(fmt::format_string<Words...> text, Words&&... words)
    {
        look(text, std::forward<Words>(words)...).is_garbage = true;
    }
};

// The texts alone.
std::vector<std::string> texts_of(const std::vector<ClipDoubt>& doubts);

// The rules are how people are built.
// - Bones of one side are a tenth longer than the other's.
// - Garbage: the left leg is on the right of where the toes point, or the left arm on the side of the right leg; one
//   foot points backwards.
// - Garbage: a knee bends forwards, or an elbow backwards.
// - The frames stand along another axis than the rest pose.
// Unknown parts are not judged.
std::vector<ClipDoubt> body_doubts(const BodyFrames& body);

// Empty for a clip that looks right. First those of body_doubts(). The other rules are how people move.
// - A bone changes its length by a tenth.
// - An upper arm points backwards. Garbage: an elbow is inside the trunk.
// - A joint turns there and back within three frames, far more than it does beside that. The worst one is told.
// - The first frame is a pose of its own, such as a T-pose. The body jumps. A limb never moves while the other does.
// - The feet are below height 0.
// Unknown parts are not judged. Time: some passes over all frames.
std::vector<ClipDoubt> clip_doubts(const BodyFrames& body);

// "thigh"; bone: 0 for a limb's upper one, 1 for its lower one
std::string_view bone_name(std::size_t limb, std::size_t bone);

// Whether one length is a tenth longer than the other. False for bones of no length.
bool is_other_length(double a, double b);

}  // namespace swivel::tools
