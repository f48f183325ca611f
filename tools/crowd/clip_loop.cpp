// SPDX-License-Identifier: MIT
#include "tools/crowd/clip_loop.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "tools/crowd/clip_parts.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;

// A turn about y, then a move along x and z.
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

using Eigen::Index;
using Eigen::MatrixXf;

constexpr double kNoGap = 1e-3;  // radians: nobody sees them

// A frame's column has its joints' rotations, and below these their turns in kStep. The distance of two such
// columns is that of the poses: the root of the sum of squared angles, in radians, where they are small. Joints that
// lie in the world are turned with the body.
MatrixXf looks_of(const Clip& clip, int body)
{
    constexpr double kStep = 1.0 / 30;  // seconds
    const std::size_t joints = clip.joints.size();
    std::vector<Quaterniond> rotations = clip.rotation;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Quaterniond heading = stand_of(clip, frame, body).turn.conjugate();
        for (std::size_t n = 0; n < joints; ++n)
            if (clip.joints[n].parent < 0) rotations[frame * joints + n] = heading * rotations[frame * joints + n];
    }
    MatrixXf looks(12 * joints, clip.frame_count);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const std::size_t before = frame > 0 ? frame - 1 : 0, after = std::min(frame + 1, clip.frame_count - 1);
        const double per = kStep / (static_cast<double>(after - before) * clip.frame_time);
        for (std::size_t n = 0; n < joints; ++n) {
            const auto rotation = [&](std::size_t at) { return rotations[at * joints + n]; };
            const auto pose = static_cast<Index>(9 * n), motion = static_cast<Index>(9 * joints + 3 * n),
                       column = static_cast<Index>(frame);
            const Eigen::Matrix3d turned = std::sqrt(0.5) * rotation(frame).toRotationMatrix();
            const Eigen::AngleAxisd turn(rotation(after) * rotation(before).conjugate());
            looks.block<9, 1>(pose, column) = turned.reshaped().cast<float>();
            looks.block<3, 1>(motion, column) = (per * turn.angle() * turn.axis()).cast<float>();
        }
    }
    return looks;
}

// The number of joints that ever turn away from the first frame, at least 1. Others would only dilute a mean.
double turning_count(const MatrixXf& looks)
{
    Index count = 0;
    for (Index row = 0; row < looks.rows() / 12 * 9; row += 9) {
        const auto joint = looks.middleRows<9>(row);
        if ((joint.colwise() - joint.col(0)).colwise().norm().maxCoeff() > kNoGap) ++count;
    }
    return static_cast<double>(std::max<Index>(count, 1));
}

float gap2_of(const MatrixXf& looks, const ClipLoop& loop)
{
    return (looks.col(static_cast<Index>(loop.last)) - looks.col(static_cast<Index>(loop.first))).squaredNorm();
}

// The speed at which a clip's joints turn, all together.
class Pace {
public:
    Pace(const MatrixXf& looks, std::size_t frames_a_second)
    {
        const Eigen::VectorXf speeds = looks.bottomRows(looks.rows() / 4).colwise().norm();
        for (const float speed : speeds) sums_.push_back(sums_.back() + double{speed});
        const std::size_t frames = sums_.size() - 1, span = std::min(frames_a_second, frames);
        double sum2 = 0;
        for (std::size_t n = 0; n + span <= frames; ++n) sum2 += std::pow(mean({n, n + span}), 2);
        min_pace_ = kMinPace * std::sqrt(sum2 / static_cast<double>(frames - span + 1));
    }
    bool is_kept(const ClipLoop& loop) const { return mean(loop) >= min_pace_; }

private:
    double mean(const ClipLoop& loop) const
    {
        return (sums_[loop.last] - sums_[loop.first]) / static_cast<double>(loop.length());
    }

    std::vector<double> sums_ = {0};  // of the speeds of all frames before each one
    double min_pace_;
};

constexpr Index kDirections = 8;
using Coarse = Eigen::Matrix<float, kDirections, Eigen::Dynamic>;

// Projects each frame onto the directions in which poses differ most, nearly. Projections are no farther apart than the
// frames themselves.
Coarse coarse_of(const MatrixXf& looks)
{
    constexpr Index kSampled = 400, kRounds = 4;
    const Index every = (looks.cols() + kSampled - 1) / kSampled, count = (looks.cols() + every - 1) / every;
    MatrixXf some(looks.rows(), count), axes(looks.rows(), kDirections);
    for (Index n = 0; n < count; ++n) some.col(n) = looks.col(n * every);
    some.colwise() -= some.rowwise().mean().eval();
    for (Index n = 0; n < kDirections; ++n) axes.col(n) = some.col(n * count / kDirections);
    for (Index round = 0; round < kRounds; ++round) {  // towards the largest eigenvectors of the covariance
        const Eigen::HouseholderQR<MatrixXf> qr(some * (some.transpose() * axes));
        axes = qr.householderQ() * MatrixXf::Identity(axes.rows(), kDirections);
    }
    return axes.transpose() * looks;
}

// Nearly the best loop of this length or longer. Frames are sorted along the first coarse direction, then by time. Each
// is compared with the following ones until their distance there exceeds the best pair's; a full comparison is made
// only if all coarse directions allow it. A budget bounds the time where all frames are alike or equally far apart:
// kBudget comparisons, of which a full one costs kInFull. (Real clips need 40 full ones.)
FoundLoop nearest(const MatrixXf& looks, const Pace& pace, std::size_t apart, float no_gap2)
{
    constexpr Index kBudget = 4000, kInFull = 20;
    const Coarse unsorted = coarse_of(looks);
    std::vector<std::uint32_t> order(static_cast<std::size_t>(looks.cols()));
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t n) { return unsorted(0, n); });
    Coarse coarse(kDirections, looks.cols());
    for (Index n = 0; n < looks.cols(); ++n) coarse.col(n) = unsorted.col(order[static_cast<std::size_t>(n)]);

    FoundLoop best{{0, order.size() - 1}, std::numeric_limits<double>::infinity()};
    float best2 = std::numeric_limits<float>::infinity();
    for (Index at = 0; at < looks.cols(); ++at)
        for (Index to = at + 1, left = kBudget + static_cast<Index>(apart); to < looks.cols() && left > 0;
             ++to, --left) {
            const float ahead = coarse(0, to) - coarse(0, at);
            if (ahead * ahead > best2) break;
            if ((coarse.col(to) - coarse.col(at)).squaredNorm() > best2) continue;
            const auto [first, last] =
                std::minmax({order[static_cast<std::size_t>(at)], order[static_cast<std::size_t>(to)]});
            const ClipLoop loop{first, last};
            const bool is_shorter = loop.length() < best.loop.length();
            if (loop.length() < apart || (best2 <= no_gap2 && !is_shorter) || !pace.is_kept(loop)) continue;
            left -= kInFull;
            const float gap2 = std::max(gap2_of(looks, loop), no_gap2);
            if (gap2 < best2 || (gap2 <= no_gap2 && is_shorter)) best = {loop, 0}, best2 = gap2;
        }
    if (std::isfinite(best2)) best.gap = std::sqrt(double{gap2_of(looks, best.loop)});
    return best;
}

}  // namespace

Clip looped(const Clip& clip, int body, const ClipLoop& loop, std::size_t frame_count)
{
    const std::size_t joints = clip.joints.size();
    Clip to = frames_of(clip, {});
    to.frame_count = frame_count;
    for (formats::Joint& joint : to.joints)  // roots go on
        if (joint.parent < 0 && joint.track < 0) joint.track = static_cast<int>(to.track_count++);
    to.rotation.reserve(frame_count * joints);
    to.translation.assign(frame_count * to.track_count, Vector3d::Zero());

    // The last frame's difference from the first one, brought to the first one's place.
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

FoundLoop find_loop(const Clip& clip, int body)
{
    const auto frames_in = [&](double seconds) {
        const double frames = std::ceil(seconds / clip.frame_time - 1e-6);
        return static_cast<std::size_t>(std::clamp(frames, 1.0, static_cast<double>(clip.frame_count)));
    };
    const double half = static_cast<double>(clip.frame_count - 1) * clip.frame_time / 2;
    const std::size_t apart = std::max(frames_in(std::clamp(half, kShortestLoop, kLongEnough)), kFewestLooped);
    if (apart >= clip.frame_count) return {{0, clip.frame_count - 1}, std::numeric_limits<double>::infinity()};
    const MatrixXf looks = looks_of(clip, body);
    const double joints = turning_count(looks);
    FoundLoop best = nearest(looks, Pace(looks, frames_in(1)), apart, static_cast<float>(kNoGap * kNoGap * joints));
    best.gap /= std::sqrt(joints);
    return best;
}

}  // namespace swivel::tools
