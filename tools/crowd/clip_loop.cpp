// SPDX-License-Identifier: MIT
#include "tools/crowd/clip_loop.h"

#include <algorithm>
#include <cmath>

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;

// A turn about y, then a way along x and z.
struct GroundMotion {
    Quaterniond turn = Quaterniond::Identity();
    Vector3d way = Vector3d::Zero();

    Vector3d operator*(const Vector3d& v) const { return turn * v + way; }
    GroundMotion operator*(const GroundMotion& b) const { return {turn * b.turn, turn * b.way + way}; }
    GroundMotion inverse() const { return {turn.conjugate(), -(turn.conjugate() * way)}; }
};

// Where a body stands in a frame, and which way it is turned.
GroundMotion stand_of(const Clip& clip, std::size_t frame, int body)
{
    const JointPose body_w = formats::world_pose(clip, frame)[static_cast<std::size_t>(body)];
    const Quaterniond& q = body_w.rotation;
    const bool has_turn = std::hypot(q.w(), q.y()) > 1e-9;  // none for one that lies turned over
    return {has_turn ? Quaterniond(q.w(), 0, q.y(), 0).normalized() : Quaterniond::Identity(),
            {body_w.position.x(), 0, body_w.position.z()}};
}

// 1 to 0 in kSeam, without a kink at either end.
double faded(double seconds)
{
    const double share = std::min(seconds / kSeam, 1.0);
    return 1 - share * share * (3 - 2 * share);
}

}  // namespace

Quaterniond heading_of(const Clip& clip, std::size_t frame, int body) { return stand_of(clip, frame, body).turn; }

Clip looped(const Clip& clip, int body, const ClipLoop& loop, std::size_t frame_count)
{
    const std::size_t joints = clip.joints.size();
    Clip to;
    to.joints = clip.joints, to.human_bones = clip.human_bones;
    to.frame_time = clip.frame_time, to.frame_count = frame_count;
    to.track_count = clip.track_count, to.scale_track_count = clip.scale_track_count;
    for (formats::Joint& joint : to.joints)  // roots go on
        if (joint.parent < 0 && joint.track < 0) joint.track = static_cast<int>(to.track_count++);
    to.rotation.reserve(frame_count * joints);
    to.translation.assign(frame_count * to.track_count, Vector3d::Zero());

    // What the last frame has and the first one has not, where the first one stands.
    const GroundMotion round = stand_of(clip, loop.last, body) * stand_of(clip, loop.first, body).inverse(),
                       back = round.inverse();
    std::vector<Quaterniond> turns;
    std::vector<Vector3d> ways;
    for (std::size_t n = 0; n < joints; ++n) {
        const bool is_root = clip.joints[n].parent < 0;
        const Quaterniond& turn = clip.rotation[loop.last * joints + n];
        const Vector3d place = formats::local_translation(clip, loop.last, n);
        turns.push_back((is_root ? back.turn * turn : turn) * clip.rotation[loop.first * joints + n].conjugate());
        ways.push_back((is_root ? back * place : place) - formats::local_translation(clip, loop.first, n));
    }
    GroundMotion goes;
    for (std::size_t frame = 0; frame < frame_count; ++frame) {
        const std::size_t since = frame % loop.length(), from = loop.first + since;
        if (frame > 0 && since == 0) goes = round * goes;
        const double share = frame < loop.length() ? 0 : faded(static_cast<double>(since) * clip.frame_time);
        for (std::size_t n = 0; n < joints; ++n) {
            const bool is_root = clip.joints[n].parent < 0;
            const Quaterniond q = Quaterniond::Identity().slerp(share, turns[n]) * clip.rotation[from * joints + n];
            to.rotation.push_back(is_root ? goes.turn * q : q);
            if (to.joints[n].track < 0) continue;
            const Vector3d place = formats::local_translation(clip, from, n) + share * ways[n];
            to.translation[frame * to.track_count + static_cast<std::size_t>(to.joints[n].track)] =
                is_root ? goes * place : place;
        }
        for (std::size_t track = 0; track < clip.scale_track_count; ++track)
            to.scale.push_back(clip.scale[from * clip.scale_track_count + track]);
    }
    return to;
}

}  // namespace swivel::tools
