// SPDX-License-Identifier: MIT
#include "tools/retarget/transfers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "tools/rig/facing.h"
#include "tools/rig/limb_chain.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;

constexpr double kNearAxis_deg = 15;

Eigen::Quaterniond axes_of(const Facing& facing)
{
    const Vector3d up = nearest_axis(facing.up_w);
    Vector3d forwards = (facing.forwards_w - facing.forwards_w.dot(up) * up).normalized();
    const Vector3d axis = nearest_axis(forwards);
    if (forwards.dot(axis) > std::cos(kNearAxis_deg * std::numbers::pi / 180)) forwards = axis;
    Eigen::Matrix3d axes;
    axes << up.cross(forwards), up, forwards;
    return Eigen::Quaterniond(axes);
}

using formats::Clip;
using Poses = std::vector<formats::JointPose>;

constexpr double kNearGround = 0.3, kStill = 0.3;  // legs; legs a second
constexpr std::size_t kFewest = 10;

struct Feet {
    const RestFigure& figure;
    bool has_toes;

    int ankle(std::size_t side) const { return figure.ground_joint(2 + side, false); }
    int ground_joint(std::size_t side) const { return figure.ground_joint(2 + side, has_toes); }
    Vector3d own_place(const Poses& pose_w, int joint) const { return figure.own(formats::position_of(pose_w, joint)); }
    double height(const Poses& pose_w) const
    {
        double lowest = HUGE_VAL;
        for (std::size_t side = 0; side < 2; ++side)
            if (figure.limbs[2 + side]) lowest = std::min(lowest, own_place(pose_w, ground_joint(side)).y());
        return lowest;
    }
    double slope(const Poses& pose_w, std::size_t side) const
    {
        return slope_of(own_place(pose_w, figure.toes[side]) - own_place(pose_w, ankle(side)));
    }
    double step(const Poses& before_w, const Poses& after_w, int joint) const
    {
        return (own_place(after_w, joint) - own_place(before_w, joint)).norm();
    }
};

using Eigen::Quaterniond;

bool is_trunk(const std::string& part)
{
    return part == "hips" || part == "spine" || part == "neck" || part == "head" || part.ends_with("Shoulder");
}

// The nearest joint above that is in `joints`; -1 if there is none.
int nearest_above(const Clip& clip, int joint, const std::map<int, int>& joints)
{
    do {
        joint = joint_at(clip, joint).parent;
    } while (joint >= 0 && !joints.contains(joint));
    return joint;
}

// Brings one foot's way from ankle to toe over the other's, steeper by `more` radians.
Quaterniond foot_over(const Vector3d& from, const Vector3d& to, double more)
{
    const Vector3d level_from(from.x(), 0, from.z()), level_to(to.x(), 0, to.z());
    const Quaterniond turned = aim(level_from, level_to);
    const double slope = slope_of(to) + more;
    return aim(turned * from, std::cos(slope) * level_to.normalized() + std::sin(slope) * Vector3d::UnitY()) * turned;
}

struct Aligner {
    const StandingFigure& source;
    const StandingFigure& target;
    std::map<int, int> to_target{}, to_source{};  // joints that stand for one another

    // The directions of a pair's bones: the mean to the pairs right below both.
    std::pair<Vector3d, Vector3d> ways_below(int from, int to) const
    {
        Vector3d from_way = Vector3d::Zero(), to_way = Vector3d::Zero();
        for (const auto& [next_to, next_from] : to_source) {
            if (nearest_above(target.clip, next_to, to_source) != to ||
                nearest_above(source.clip, next_from, to_target) != from)
                continue;
            from_way += source.rest.own_way(from, next_from);
            to_way += target.rest.own_way(to, next_to);
        }
        return {from_way, to_way};
    }
    std::pair<Vector3d, Vector3d> ways(int from, int to) const
    {
        for (std::size_t n = 0; n < target.rest.limbs.size(); ++n) {
            if (!target.rest.limbs[n] || !source.rest.limbs[n]) continue;
            for (std::size_t joint = 0; joint < 2; ++joint)
                if ((*target.rest.limbs[n])[joint] == to)
                    return {source.rest.own_way(from, (*source.rest.limbs[n])[joint + 1]),
                            target.rest.own_way(to, (*target.rest.limbs[n])[joint + 1])};
        }
        return ways_below(from, to);
    }
    // How much steeper the target's flat foot is than the source's.
    double steeper(std::size_t side) const
    {
        const auto &from = source.stance.slope[side], &to = target.stance.slope[side];
        return from && to ? *to - *from : 0;
    }
    Quaterniond align(const std::string& part, int from, int to, const Quaterniond& above) const
    {
        if (is_trunk(part)) return Quaterniond::Identity();
        const auto [from_way, to_way] = ways(from, to);
        if (part.ends_with("Foot"))
            return foot_over(to_way, from_way, steeper(part.starts_with("left") ? std::size_t{0} : std::size_t{1}));
        return aim(above * to_way, from_way) * above;
    }
};

}  // namespace

RestFigure rest_figure(const formats::Clip& clip, const std::vector<BodyPart>& parts)
{
    RestFigure figure;
    figure.pose_w = formats::rest_pose(clip);
    figure.limbs = limbs_of(parts);
    figure.axes = axes_of(facing_of(clip, figure.limbs));
    if (const int hips = first_joint(parts, "hips"); hips >= 0)
        figure.mirrored = figure.pose_w[static_cast<std::size_t>(hips)].mirrored;
    int count = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        figure.toes[side] = first_joint(parts, side == 0 ? "leftToes" : "rightToes");
        if (!figure.limbs[2 + side]) continue;
        figure.leg += figure.length(2 + side);
        ++count;
    }
    if (count > 0) figure.leg /= count;
    return figure;
}

double slope_of(const Vector3d& way) { return std::atan2(way.y(), std::hypot(way.x(), way.z())); }

Stance stance_of(const Clip& clip, const RestFigure& figure, bool has_toes)
{
    const Feet feet{figure, has_toes};
    const auto has_slope = [&](std::size_t side) { return has_toes && figure.limbs[2 + side]; };
    Stance stance;
    const bool is_files_own = std::ranges::all_of(clip.joints, [](const formats::Joint& joint) {
        return pose_without_keys(joint).rotation.coeffs() == joint.rest_rotation.coeffs();
    });  // a frame in mid-step tells nothing of flat feet
    if (is_files_own && std::abs(feet.height(figure.pose_w)) < kNearGround * figure.leg) {
        stance.height = feet.height(figure.pose_w);
        for (std::size_t side = 0; side < 2; ++side)
            if (has_slope(side)) stance.slope[side] = feet.slope(figure.pose_w, side);
        return stance;
    }
    if (clip.frame_count < 2) return stance;
    std::vector<double> heights, still;  // of the lower foot in each frame, and where it is still
    std::vector<double> slopes;          // of both feet: in some clips one of them hardly stands
    Poses before_w;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Poses pose_w = formats::world_pose(clip, frame);
        heights.push_back(feet.height(pose_w));
        const double max_step = kStill * figure.leg * clip.frame_time;
        for (std::size_t side = 0; side < 2 && frame > 0; ++side) {
            if (!figure.limbs[2 + side] || feet.step(before_w, pose_w, feet.ankle(side)) >= max_step ||
                feet.step(before_w, pose_w, feet.ground_joint(side)) >= max_step)
                continue;
            if (const double height = feet.own_place(pose_w, feet.ground_joint(side)).y(); height <= heights.back())
                still.push_back(height);
            if (has_toes) slopes.push_back(feet.slope(pose_w, side));
        }
        before_w = pose_w;
    }
    stance.height = still.size() >= kFewest ? quantile(still, 0.5) : quantile(heights, 0.05);
    for (std::size_t side = 0; side < 2; ++side)
        if (has_slope(side) && slopes.size() >= kFewest) stance.slope[side] = quantile(slopes, 0.9);
    return stance;
}

std::vector<std::optional<Transfer>> transfers_of(const JointPairs& pairs, const StandingFigure& source,
                                                  const StandingFigure& target)
{
    std::vector<std::optional<Transfer>> transfers(target.clip.joints.size());
    std::vector<const std::string*> part_of(transfers.size());
    Aligner aligner{source, target};
    for (const PairedPart& part : pairs)
        for (std::size_t n = 0; part.is_paired() && n < part.target.size(); ++n) {
            const double place =
                static_cast<double>((n + 1) * part.source.size()) / static_cast<double>(part.target.size());
            const auto after = static_cast<std::size_t>(std::ceil(place)) - 1;
            const auto joint = static_cast<std::size_t>(part.target[n]);
            transfers[joint] = Transfer{after > 0 ? part.source[after - 1] : -1, part.source[after],
                                        place - static_cast<double>(after)};
            part_of[joint] = &part.name;
            aligner.to_source[part.target[n]] = part.source[after];
            aligner.to_target[part.source[after]] = part.target[n];
        }
    for (std::size_t n = 0; n < transfers.size(); ++n) {  // parents come before their children
        if (!transfers[n]) continue;
        const auto joint = static_cast<int>(n);
        Transfer& transfer = *transfers[n];
        if (transfer.before < 0) transfer.before = nearest_above(source.clip, transfer.after, aligner.to_target);
        const int above = nearest_above(target.clip, joint, aligner.to_source);
        transfer.align =
            aligner.align(*part_of[n], transfer.after, joint,
                          above < 0 ? Quaterniond::Identity() : transfers[static_cast<std::size_t>(above)]->align);
    }
    return transfers;
}

}  // namespace swivel::tools
