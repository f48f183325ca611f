// SPDX-License-Identifier: MIT
#include "tools/crowd/clip_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

// Of each frame, how its joints are turned, and how far they turn in kStep. The distance of two such columns is that of
// the poses: the root of the sum of squared angles, in radians, where they are small. What lies in the world is turned
// with the body.
Eigen::MatrixXd looks_of(const Clip& clip, int body)
{
    constexpr double kStep = 1.0 / 30;  // seconds
    const std::size_t joints = clip.joints.size();
    std::vector<Quaterniond> rotations = clip.rotation;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Quaterniond heading = stand_of(clip, frame, body).turn.conjugate();
        for (std::size_t n = 0; n < joints; ++n)
            if (clip.joints[n].parent < 0) rotations[frame * joints + n] = heading * rotations[frame * joints + n];
    }
    Eigen::MatrixXd looks(12 * joints, clip.frame_count);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const std::size_t before = frame > 0 ? frame - 1 : 0, after = std::min(frame + 1, clip.frame_count - 1);
        const double per = kStep / (static_cast<double>(after - before) * clip.frame_time);
        for (std::size_t n = 0; n < joints; ++n) {
            const auto rotation = [&](std::size_t at) { return rotations[at * joints + n]; };
            const auto row = static_cast<Eigen::Index>(12 * n), column = static_cast<Eigen::Index>(frame);
            looks.block<9, 1>(row, column) = std::sqrt(0.5) * rotation(frame).toRotationMatrix().reshaped();
            const Eigen::AngleAxisd turn(rotation(after) * rotation(before).conjugate());
            looks.block<3, 1>(row + 9, column) = per * turn.angle() * turn.axis();
        }
    }
    return looks;
}

// 1 to 0 in kSeam, without a kink at either end.
double faded(double seconds)
{
    const double share = std::min(seconds / kSeam, 1.0);
    return 1 - share * share * (3 - 2 * share);
}

}  // namespace

FoundLoop find_loop(const Clip& clip, int body)
{
    const Eigen::MatrixXf looks = looks_of(clip, body).cast<float>();
    const Eigen::VectorXf size2 = looks.colwise().squaredNorm();
    const auto frames = looks.cols();
    const double shortest = std::max<double>(std::ceil(kShortestLoop / clip.frame_time - 1e-6), kFewestLooped);
    const auto apart = static_cast<Eigen::Index>(std::min(shortest, static_cast<double>(frames)));
    constexpr Eigen::Index kTogether = 256;  // frames that are compared with all later ones at once
    FoundLoop best{{0, clip.frame_count - 1}, std::numeric_limits<double>::infinity()};
    for (Eigen::Index from = 0; from + apart < frames; from += kTogether) {
        const Eigen::Index count = std::min(kTogether, frames - apart - from), later = from + apart;
        Eigen::MatrixXf gap2 = -2.0f * looks.rightCols(frames - later).transpose() * looks.middleCols(from, count);
        gap2.colwise() += size2.tail(frames - later);
        for (Eigen::Index n = 0; n < count; ++n) {
            Eigen::Index at;
            const float least = gap2.col(n).tail(frames - later - n).minCoeff(&at) + size2[from + n];
            if (least < best.gap)
                best = {{static_cast<std::size_t>(from + n), static_cast<std::size_t>(later + n + at)}, least};
        }
    }
    best.gap = std::sqrt(std::max(best.gap, 0.0) / static_cast<double>(clip.joints.size()));
    return best;
}

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
