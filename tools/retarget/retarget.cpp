// SPDX-License-Identifier: MIT
#include "tools/retarget/retarget.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tools/rig/limb_chain.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;
using formats::LimbKind;
using formats::position_of;
using Poses = std::vector<JointPose>;

constexpr double kMaxWay = 0.1;  // leg lengths that hips move for knees: legs in a split would ask for any
constexpr double kMaxExtra = 2 * std::numbers::pi;  // radians a second, 3 degrees a frame at 120 frames a second
constexpr double kWayWeight = 5;  // of the hips' way in leg lengths, beside the knees' angles in radians

const JointPose& at(const Poses& pose_w, int joint) { return pose_w[static_cast<std::size_t>(joint)]; }

// The mean place of one joint of each of some limbs.
Vector3d middle(const Poses& pose_w, const KnownLimbs& limbs, const std::vector<std::size_t>& which)
{
    Vector3d sum = Vector3d::Zero();
    for (const std::size_t limb : which) sum += position_of(pose_w, (*limbs[limb])[0]);
    return sum / static_cast<double>(which.size());
}

// Rises evenly from 0 to 1 between two values.
double rise(double value, double from, double to)
{
    const double share = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return share * share * (3 - 2 * share);
}

bool has_all_toes(const RestFigure& figure)
{
    return (!figure.limbs[2] || figure.toes[0] >= 0) && (!figure.limbs[3] || figure.toes[1] >= 0);
}

// The two bones of a leg, or of an arm.
struct Bones {
    double thigh, shin;

    // The cosine of a knee's bend, 1 for a straight leg, by the squared distance from hip to ankle; and the reverse.
    double cosine(double apart2) const
    {
        return std::clamp((apart2 - thigh * thigh - shin * shin) / (2 * thigh * shin), -1.0, 1.0);
    }
    double apart2(double cosine) const { return thigh * thigh + shin * shin + 2 * thigh * shin * cosine; }
    // The bend by the distance.
    double flexion(double apart) const { return std::acos(cosine(apart * apart)); }
};
Bones bones_of(const RestFigure& figure, std::size_t limb)
{
    const LimbJoints& at = *figure.limbs[limb];
    return {figure.own_way(at[0], at[1]).norm(), figure.own_way(at[1], at[2]).norm()};
}

class Mapper {
public:
    Mapper(const Clip& source, const Clip& target, const JointPairs& pairs)
        : source_clip_(source),
          source_(rest_figure(source, parts_of(pairs, BodySide::source))),
          target_(rest_figure(target, parts_of(pairs, BodySide::target))),
          has_toes_(has_all_toes(source_) && has_all_toes(target_))
    {
        for (std::size_t limb = 0; limb < formats::kLimbNames.size(); ++limb)
            if (source_.limbs[limb] && target_.limbs[limb])
                (formats::kLimbNames[limb].kind == LimbKind::arm ? arms_ : legs_).push_back(limb);
        source_hips_ = first_joint(parts_of(pairs, BodySide::source), "hips");
        out_.hips = first_joint(parts_of(pairs, BodySide::target), "hips");
        if (source_hips_ < 0 || out_.hips < 0 || legs_.empty())
            throw std::invalid_argument("both bodies need hips and a leg");
        for (const std::vector<std::size_t>& limbs : {arms_, legs_})
            for (const std::size_t limb : limbs) out_.limbs.push_back(formats::kLimbNames[limb]);
        double source_length = 0, target_length = 0;
        for (const std::size_t leg : legs_) {
            source_length += source_.length(leg);
            target_length += target_.length(leg);
        }
        out_.leg_ratio = target_length / source_length;
        const Stance from = stance_of(source, source_, has_toes_), to = stance_of(target, target_, has_toes_);
        transfers_ = transfers_of(pairs, {source, source_, from}, {target, target_, to});
        if (from.height) {
            const double scaled = out_.leg_ratio * *from.height;
            out_.ground = {*from.height, to.height.value_or(scaled), has_toes_};
            lift_ = out_.ground->target - scaled;
        }
        if (has_toes_)
            for (const std::size_t leg : legs_)
                foot_difference_ += foot_difference(leg, from, to) / static_cast<double>(legs_.size());
        prepare(target);
    }

    Retargeted map()
    {
        for (std::size_t frame = 0; frame < out_.clip.frame_count; ++frame) {
            const Poses source_w = formats::world_pose(source_clip_, frame);
            turn_joints(frame, source_w);
            place_hips(frame, source_w);
            add_goals(frame, source_w);
        }
        ease_goals();
        return std::move(out_);
    }

private:
    // From toe to ankle of flat feet, as the figure has it: the target's less the source's.
    Vector3d foot_difference(std::size_t leg, const Stance& from, const Stance& to) const
    {
        const Vector3d own = source_.own_way((*source_.limbs[leg])[2], source_.toes[leg - 2]);
        const double target_length = target_.own_way((*target_.limbs[leg])[2], target_.toes[leg - 2]).norm();
        const bool both = from.slope[leg - 2] && to.slope[leg - 2];
        const Vector3d ahead = Vector3d(own.x(), 0, own.z()).normalized();
        const auto flat = [&](double length, double slope) {
            return Vector3d(length * (std::cos(slope) * ahead + std::sin(slope) * Vector3d::UnitY()));
        };
        return out_.leg_ratio * flat(own.norm(), both ? *from.slope[leg - 2] : slope_of(own)) -
               flat(target_length, both ? *to.slope[leg - 2] : slope_of(own));
    }

    // The target's clip with room for the source's frames, at rest.
    void prepare(const Clip& target)
    {
        Clip& clip = out_.clip;
        clip = target;
        clip.frame_time = source_clip_.frame_time;
        clip.frame_count = source_clip_.frame_count;
        clip.track_count = 1;
        clip.scale_track_count = 0;
        for (formats::Joint& joint : clip.joints) joint.track = joint.scale_track = -1;
        clip.joints[static_cast<std::size_t>(out_.hips)].track = 0;
        clip.translation.assign(clip.frame_count, joint_at(clip, out_.hips).offset);
        clip.scale.clear();
        clip.rotation.clear();
        for (std::size_t n = 0; n < clip.frame_count * clip.joints.size(); ++n)
            clip.rotation.push_back(clip.joints[n % clip.joints.size()].rest_rotation);
    }

    // A joint's turn from rest, as the figure has it.
    Quaterniond source_turn(const Poses& source_w, int joint) const
    {
        if (joint < 0) return Quaterniond::Identity();
        return source_.own(at(source_w, joint).rotation * at(source_.pose_w, joint).rotation.conjugate());
    }
    Quaterniond turn_of(const Poses& source_w, const Transfer& transfer) const
    {
        const Quaterniond after = source_turn(source_w, transfer.after);
        if (transfer.share == 1) return after * transfer.align;
        return source_turn(source_w, transfer.before).slerp(transfer.share, after) * transfer.align;
    }

    void turn_joints(std::size_t frame, const Poses& source_w)
    {
        Clip& clip = out_.clip;
        Poses pose_w(clip.joints.size());
        for (std::size_t n = 0; n < clip.joints.size(); ++n) {  // parents come before their children
            const formats::Joint& joint = clip.joints[n];
            const JointPose parent_w = joint.parent < 0 ? JointPose() : at(pose_w, joint.parent);
            if (transfers_[n]) {
                const Quaterniond turn_w = target_.world(turn_of(source_w, *transfers_[n]));
                const Quaterniond local = parent_w.rotation.conjugate() * turn_w * target_.pose_w[n].rotation;
                // The rotation that negative scales add is no part of the joint's key.
                const Quaterniond by_scale = joint.rest_rotation.conjugate() * formats::local_rest_pose(joint).rotation;
                clip.rotation[frame * clip.joints.size() + n] =
                    ((parent_w.mirrored ? formats::mirrored(local) : local) * by_scale.conjugate()).normalized();
            }
            pose_w[n] = parent_w * formats::local_pose(clip, frame, n);
        }
    }

    // A place of the source's world in the target's.
    Vector3d mapped(const Vector3d& place_w) const
    {
        return target_.world(out_.leg_ratio * source_.own(place_w)) + lift_ * target_.up_w();
    }

    void place_hips(std::size_t frame, const Poses& source_w)
    {
        Clip& clip = out_.clip;
        const Poses pose_w = formats::world_pose(clip, frame);
        const Vector3d goal_w = mapped(middle(source_w, source_.limbs, legs_)) +
                                target_.world(source_turn(source_w, source_hips_) * foot_difference_);
        const Vector3d shift_w = goal_w - middle(pose_w, target_.limbs, legs_);
        const Vector3d place_w = position_of(pose_w, out_.hips) + shift_w + shift_for_knees(source_w, pose_w, shift_w);
        const int parent = joint_at(clip, out_.hips).parent;
        clip.translation[frame] = parent < 0 ? place_w : formats::to_inner(at(pose_w, parent), place_w);
    }

    // The target's ankle place, which does not depend on its hips.
    Vector3d ankle_goal(std::size_t leg, const Poses& source_w, const Poses& pose_w) const
    {
        return mapped(position_of(source_w, source_.ground_joint(leg, has_toes_))) +
               (position_of(pose_w, (*target_.limbs[leg])[2]) -
                position_of(pose_w, target_.ground_joint(leg, has_toes_)));
    }

    // Gauss-Newton steps from hips that are moved by shift_w. For a knee's angle a and both bones p and q, hip and
    // ankle are d apart: d^2 = p^2 + q^2 + 2 p q cos a, so d dd = -p q sin a da.
    Vector3d shift_for_knees(const Poses& source_w, const Poses& pose_w, const Vector3d& shift_w) const
    {
        Vector3d more_w = Vector3d::Zero();
        for (int step = 0; step < 3; ++step) {
            Eigen::Matrix3d normal = kWayWeight * Eigen::Matrix3d::Identity();
            Vector3d right = -kWayWeight * more_w;
            for (const std::size_t leg : legs_) {
                const LimbJoints &from = *source_.limbs[leg], &to = *target_.limbs[leg];
                const Bones own = bones_of(source_, leg), bones = bones_of(target_, leg);
                const double cosine =
                    own.cosine((position_of(source_w, from[0]) - position_of(source_w, from[2])).squaredNorm());
                const double wanted2 = bones.apart2(cosine);
                const Vector3d way_w =
                    position_of(pose_w, to[0]) + shift_w + more_w - ankle_goal(leg, source_w, pose_w);
                const Vector3d direction_w = way_w.normalized();
                // 0.01: a knee within 6 degrees of straight tells no more
                const double per_length = (bones.thigh + bones.shin) / (bones.thigh * bones.shin);
                const double weight = wanted2 * per_length * per_length / (1 - cosine * cosine + 0.01);
                normal += weight * direction_w * direction_w.transpose();
                right -= weight * (way_w.norm() - std::sqrt(wanted2)) * direction_w;
            }
            more_w += normal.ldlt().solve(right);
        }
        const double max = kMaxWay * target_.leg;
        return more_w.norm() > max ? Vector3d(more_w * (max / more_w.norm())) : more_w;
    }

    // From shoulder to wrist, of a pose of the target.
    Vector3d wrist_way(std::size_t arm, const Poses& source_w, const Poses& pose_w) const
    {
        const LimbJoints& from = *source_.limbs[arm];
        const Vector3d shoulder_w = position_of(source_w, from[0]);
        const Vector3d way_w = position_of(source_w, from[2]) - shoulder_w;
        const double ratio = target_.length(arm) / source_.length(arm);
        const double bent = 1 - rise(way_w.norm() / source_.length(arm), 0.7, 0.95);
        const Vector3d from_middle = source_.own(shoulder_w - middle(source_w, source_.limbs, arms_));
        const Vector3d to_middle =
            target_.own(position_of(pose_w, (*target_.limbs[arm])[0]) - middle(pose_w, target_.limbs, arms_));
        return target_.world(ratio * source_.own(way_w) + bent * (ratio * from_middle - to_middle));
    }

    void add_goals(std::size_t frame, const Poses& source_w)
    {
        const Poses pose_w = formats::world_pose(out_.clip, frame);
        const auto add = [&](std::size_t limb, const Vector3d& place_w) {
            const LimbJoints& joints = *target_.limbs[limb];
            const Vector3d start_w = position_of(pose_w, joints[0]);
            const Vector3d way_w = position_of(pose_w, joints[2]) - start_w;
            formats::Target& goal = out_.goals.emplace_back();
            goal.frame = static_cast<std::uint32_t>(frame);
            goal.limb = formats::kLimbNames[limb];
            goal.position = place_w;
            // The elbow turns with the line from shoulder to wrist: beside a new line the old elbow says little.
            goal.has_pole = true;
            goal.pole = start_w + aim(way_w, place_w - start_w) * (position_of(pose_w, joints[1]) - start_w);
            const LimbJoints& from = *source_.limbs[limb];
            const double apart = (position_of(source_w, from[2]) - position_of(source_w, from[0])).norm();
            bends_.push_back({start_w, bones_of(source_, limb).flexion(apart)});
        };
        for (const std::size_t arm : arms_)
            add(arm, position_of(pose_w, (*target_.limbs[arm])[0]) + wrist_way(arm, source_w, pose_w));
        for (const std::size_t leg : legs_) add(leg, ankle_goal(leg, source_w, pose_w));
    }

    // Knees and elbows turn faster than the source's by no more than its own fastest turn, or kMaxExtra: near its full
    // reach a limb would snap straight, or bend, for a goal that moves a little.
    void ease_goals()
    {
        out_.eased = out_.goals;
        const std::size_t count = out_.limbs.size();
        for (std::size_t n = 0; n < count; ++n) {
            const Bones bones = bones_of(target_, n < arms_.size() ? arms_[n] : legs_[n - arms_.size()]);
            std::vector<double> extra;
            double fastest = kMaxExtra * source_clip_.frame_time;
            for (std::size_t at = n; at < bends_.size(); at += count) {
                extra.push_back(bones.flexion((out_.goals[at].position - bends_[at].start_w).norm()) -
                                bends_[at].source);
                if (at >= count) fastest = std::max(fastest, std::abs(bends_[at].source - bends_[at - count].source));
            }
            const std::vector<double> slower = eased(extra, fastest);
            for (std::size_t frame = 0; frame < extra.size(); ++frame) {
                if (slower[frame] == extra[frame]) continue;
                const Bend& bend = bends_[frame * count + n];
                Vector3d& place_w = out_.eased[frame * count + n].position;
                const double flexion = std::clamp(bend.source + slower[frame], 0.0, std::numbers::pi);
                const double apart = std::sqrt(std::max(0.0, bones.apart2(std::cos(flexion))));
                place_w = bend.start_w + apart * (place_w - bend.start_w).normalized();
            }
        }
    }

    const Clip& source_clip_;
    RestFigure source_, target_;
    bool has_toes_;  // each leg of both
    std::vector<std::optional<Transfer>> transfers_;
    std::vector<std::size_t> arms_, legs_;  // that both have, in formats::kLimbNames
    int source_hips_ = -1;
    Vector3d foot_difference_ = Vector3d::Zero();
    double lift_ = 0;
    struct Bend {
        Vector3d start_w;  // the target's shoulder or hip
        double source;     // flexion of the source's elbow or knee
    };
    std::vector<Bend> bends_;  // beside out_.goals
    Retargeted out_;
};

}  // namespace

Retargeted retarget(const Clip& source, const Clip& target, const JointPairs& pairs)
{
    return Mapper(source, target, pairs).map();
}

}  // namespace swivel::tools
