// SPDX-License-Identifier: MIT
#include "tools/swivel/root_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/formats/error.h"
#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::JointPose;

constexpr const char* kRoot = "root";
constexpr double kUpsideDown = 0.01;  // within a degree of upside down, a body has no heading

// The world itself for -1.
JointPose at(const std::vector<JointPose>& pose_w, int joint)
{
    return joint < 0 ? JointPose() : pose_w[static_cast<std::size_t>(joint)];
}

// The new values of root and carrier.
struct RootMotion {
    TurnedJoint root, carrier;
};
RootMotion root_motion(const formats::Clip& clip, const MovedBody& body)
{
    RootMotion motion{{body.root, {}, {}}, {body.carrier, {}, {}}};
    const bool is_new = body.root < 0;
    const std::vector<JointPose> rest_w = formats::rest_pose(clip);
    const int above = joint_at(clip, is_new ? body.carrier : body.root).parent;
    const Quaterniond root_rest_w = at(rest_w, is_new ? above : body.root).rotation;
    const auto carrier = static_cast<std::size_t>(body.carrier);
    Quaterniond heading_w = Quaterniond::Identity();
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const std::vector<JointPose> pose_w = formats::world_pose(clip, frame);
        // The hips' turn from rest is one about up, the heading, after one about a level axis.
        const Quaterniond turn_w = at(pose_w, body.hips).rotation * at(rest_w, body.hips).rotation.conjugate();
        const double about_up = turn_w.vec().dot(body.up_w);
        if (std::hypot(turn_w.w(), about_up) > kUpsideDown) {
            heading_w.w() = turn_w.w();
            heading_w.vec() = about_up * body.up_w;
            heading_w.normalize();
        }
        const Vector3d hips_w = at(pose_w, body.hips).position;
        const Vector3d place_w = hips_w + (body.floor_height(hips_w) - hips_w.dot(body.up_w)) * body.up_w;
        const JointPose above_w = at(pose_w, above);
        const Quaterniond local = above_w.rotation.conjugate() * heading_w * root_rest_w;
        const Quaterniond rotation = above_w.mirrored ? formats::mirrored(local) : local;
        const Vector3d place = formats::to_inner(above_w, place_w);
        motion.root.rotation.push_back(rotation);
        motion.root.translation.push_back(place);
        // Neither root has a scale, so what is below it stays exactly, whatever scales are above.
        const JointPose old = is_new ? JointPose() : local_pose(clip, frame, static_cast<std::size_t>(body.root));
        const Quaterniond back = rotation.conjugate();
        motion.carrier.rotation.push_back(back * old.rotation * clip.rotation[frame * clip.joints.size() + carrier]);
        motion.carrier.translation.push_back(
            back * (formats::to_outer(old, formats::local_translation(clip, frame, carrier)) - place));
    }
    return motion;
}

// Puts a joint's values in place of those that it has, if any.
void put(std::vector<TurnedJoint>& joints, TurnedJoint joint)
{
    const auto own = std::ranges::find(joints, joint.joint, &TurnedJoint::joint);
    (own == joints.end() ? joints.emplace_back() : *own) = std::move(joint);
}

}  // namespace

int root_joint(const formats::Clip& clip, int carrier, const std::string& file)
{
    const int above = joint_at(clip, carrier).parent;
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        const formats::Joint& joint = clip.joints[n];
        if (!formats::same_ignoring_case(joint.name, kRoot)) continue;
        if (static_cast<int>(n) == carrier)
            throw formats::InputError(file, fmt::format("'{}' already carries the motion of the whole body, hips "
                                                        "included; rename it to get a new root above it",
                                                        printable_name(joint)));
        const bool is_rigid = joint.rest_scale == Vector3d::Ones() && joint.scale_track < 0 && !joint.is_sheared;
        if (static_cast<int>(n) != above || !is_rigid)
            throw formats::InputError(file,
                                      fmt::format("'{}' has the name that --root-motion gives the joint right "
                                                  "above '{}'; rename it, or leave the option out",
                                                  printable_name(joint), printable_name(joint_at(clip, carrier))));
    }
    return above >= 0 && formats::same_ignoring_case(joint_at(clip, above).name, kRoot) ? above : -1;
}

bool rests_on_ground(const formats::Clip& clip, int thigh, int ankle, const Eigen::Vector3d& up_w)
{
    const std::vector<JointPose> rest_w = formats::rest_pose(clip);
    const double low = at(rest_w, ankle).position.dot(up_w), high = at(rest_w, thigh).position.dot(up_w);
    return std::abs(low) < 0.3 * (high - low);
}

void write_joints(const std::filesystem::path& out, const MotionFile& file, const formats::Clip& clip,
                  std::vector<TurnedJoint> joints, const std::optional<formats::NewFrames>& frames,
                  const std::optional<MovedBody>& body)
{
    RootMotion motion{};
    std::optional<formats::NewJoint> new_root;
    if (body) {
        motion = root_motion(clip, *body);
        put(joints, std::move(motion.carrier));
        if (body->root < 0)
            new_root = formats::NewJoint{kRoot, body->carrier, motion.root.rotation, motion.root.translation};
        else
            put(joints, std::move(motion.root));
    }
    std::vector<formats::JointKeys> keys;
    for (const TurnedJoint& each : joints) keys.push_back({each.joint, each.rotation, each.translation});
    file.write(out, keys, frames, new_root);
}

}  // namespace swivel::tools
