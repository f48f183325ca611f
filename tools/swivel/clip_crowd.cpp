// SPDX-License-Identifier: MIT
#include "tools/swivel/clip_crowd.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <random>

#include "tools/swivel/parallel.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kBentSine = 0.08715574274765817;  // sin 5 degrees

Crowd make_crowd(std::span<const Limb> limbs, std::uint32_t characters)
{
    std::vector<swivel_group_def> groups;
    for (const Limb& limb : limbs) groups.push_back({characters, limb.bound.binding});
    return Crowd(SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND, groups);
}

// Of the first kind that is solved, so that legs beside arms move no one.
double limb_span(std::span<const Limb> limbs)
{
    double most = 0;
    for (const Limb& limb : limbs)
        if (limb.name.kind == limbs[0].name.kind)
            most = std::max(most, double{limb.bound.lengths[0]} + limb.bound.lengths[1]);
    return 2 * most;
}

// Uniform in 0..1; std::uniform_real_distribution may differ between libraries.
double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

void store(const Vector3d& v, float (&to)[3])
{
    for (int n = 0; n < 3; ++n) to[n] = static_cast<float>(v[n]);
}
void store(const Quaterniond& q, float (&to)[4])
{
    for (int n = 0; n < 4; ++n) to[n] = static_cast<float>(q.coeffs()[n]);
}

Quaterniond quaternion(const std::array<float, 4>& q) { return Quaterniond(q[3], q[0], q[1], q[2]).normalized(); }

// Of a rotation: its whole angle, and its parts about an axis and across it.
double angle(const Quaterniond& q) { return 2 * std::atan2(q.vec().norm(), std::fabs(q.w())); }
double twist(const Quaterniond& q, const Vector3d& axis)
{
    return 2 * std::atan2(std::fabs(q.vec().dot(axis)), std::fabs(q.w()));
}
double swing(const Quaterniond& q, const Vector3d& axis)
{
    const Vector3d turned = q * axis;
    return std::atan2(turned.cross(axis).norm(), turned.dot(axis));
}

}  // namespace

ClipCrowd::ClipCrowd(const formats::Clip& clip, std::span<const Limb> limbs, std::uint32_t characters,
                     std::uint64_t seed)
    : clip_(clip), limbs_(limbs), characters_(characters), crowd_(make_crowd(limbs, characters))
{
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        const auto at = [&](int joint) -> const formats::JointPose& { return pose_w[static_cast<std::size_t>(joint)]; };
        const Vector3d root = pose_w[0].position;
        roots_.push_back(root);
        for (const Limb& limb : limbs) {
            const int parent = clip.joints[static_cast<std::size_t>(limb.upper())].parent;
            sources_.push_back({at(limb.upper()).position - root, at(limb.lower()).position - root,
                                at(limb.end()).position - root,
                                parent < 0 ? Quaterniond::Identity() : at(parent).rotation, at(limb.end()).rotation,
                                at(limb.upper()).rotation, at(limb.lower()).rotation});
        }
    }

    std::mt19937_64 random(seed);
    const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(characters)));
    const double spacing = 3 * limb_span(limbs);
    for (std::uint32_t n = 1; n < characters; ++n)
        characters_[n] = {0.85 + 0.3 * unit(random), static_cast<std::size_t>(random() % clip.frame_count),
                          Vector3d(spacing * (n % columns), 0, spacing * (n / columns))};
    goals_.resize(limbs.size(), std::vector<Goal>(characters));
    inputs_.resize(limbs.size(), std::vector<Input>(characters));
    rows_.resize(limbs.size() * characters);
}

const ClipCrowd::Source& ClipCrowd::source(std::size_t limb, std::uint32_t character) const
{
    const std::size_t frame = (frame_ + characters_[character].start) % clip_.frame_count;
    return sources_[frame * limbs_.size() + limb];
}

ClipCrowd::Goal ClipCrowd::goal_from_clip(std::size_t limb, std::uint32_t character) const
{
    const Source& from = source(limb, character);
    const double reach = characters_[character].reach;
    return {from.shoulder + reach * (from.wrist - from.shoulder), from.shoulder + reach * (from.elbow - from.shoulder),
            from.hand, true};
}

void ClipCrowd::put(std::size_t limb, std::uint32_t character, const Goal& goal)
{
    const Source& from = source(limb, character);
    const auto reach = static_cast<float>(characters_[character].reach);
    Input& input = inputs_[limb][character];
    goals_[limb][character] = goal;
    store(goal.wrist, input.target);
    store(goal.pole, input.pole);
    for (int n = 0; n < 2; ++n) input.lengths[n] = reach * limbs_[limb].bound.lengths[n];
    store(from.shoulder, input.position);
    store(from.parent, input.rotation);
    store(goal.hand, input.hand);
}

void ClipCrowd::set_frame(std::size_t frame, std::span<const formats::Target> given)
{
    frame_ = frame;
    for (std::size_t limb = 0; limb < limbs_.size(); ++limb)
        for_ranges(character_count(), [&](std::uint32_t begin, std::uint32_t end) {
            for (std::uint32_t n = begin; n < end; ++n) put(limb, n, goal_from_clip(limb, n));
        });
    for (const formats::Target& target : given) {
        const auto of = [&](const Limb& each) { return each.name == target.limb; };
        const auto limb = static_cast<std::size_t>(std::find_if(limbs_.begin(), limbs_.end(), of) - limbs_.begin());
        const Character& who = characters_[target.character];
        const Vector3d root = roots_[(frame + who.start) % clip_.frame_count] + who.place;
        put(limb, target.character,
            {target.position - root, target.pole - root,
             target.has_orientation ? target.orientation : source(limb, target.character).hand, false});
    }
    for (std::uint32_t limb = 0; limb < limbs_.size(); ++limb) {
        const auto write = [&](swivel_field field, const float* first) {
            check(swivel_write(crowd_.get(), field, limb, 0, character_count(), {first, sizeof(Input)}));
        };
        const Input& first = inputs_[limb][0];
        write(SWIVEL_TARGET, first.target);
        write(SWIVEL_POLE, first.pole);
        write(SWIVEL_LENGTHS, first.lengths);
        write(SWIVEL_PARENT_POSITION, first.position);
        write(SWIVEL_PARENT_ROTATION, first.rotation);
        write(SWIVEL_HAND, first.hand);
    }
}

void ClipCrowd::solve(Statistics& statistics)
{
    const auto before = std::chrono::steady_clock::now();
    crowd_.solve();
    statistics.solve_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

formats::PoseRow ClipCrowd::pose(std::size_t limb, std::uint32_t character) const
{
    formats::PoseRow row;
    row.character = character;
    row.limb = limbs_[limb].name;
    const auto read = [&](swivel_field field, void* to, std::size_t bytes) {
        check(swivel_read(crowd_.get(), field, static_cast<std::uint32_t>(limb), character, 1, {to, bytes}));
    };
    read(SWIVEL_SHOULDER, row.shoulder.data(), sizeof row.shoulder);
    read(SWIVEL_ELBOW, row.elbow.data(), sizeof row.elbow);
    read(SWIVEL_WRIST, row.wrist.data(), sizeof row.wrist);
    read(SWIVEL_FLAGS, &row.flags, sizeof row.flags);
    return row;
}

std::span<const formats::PoseRow> ClipCrowd::poses()
{
    for_ranges(character_count(), [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t n = begin; n < end; ++n)
            for (std::size_t limb = 0; limb < limbs_.size(); ++limb) rows_[n * limbs_.size() + limb] = pose(limb, n);
    });
    return rows_;
}

void ClipCrowd::measure(Statistics& statistics) const
{
    std::mutex mutex;
    for (std::size_t limb = 0; limb < limbs_.size(); ++limb)
        for_ranges(character_count(), [&](std::uint32_t begin, std::uint32_t end) {
            LimbStatistics range;
            measure_range(limb, begin, end, range);
            const std::lock_guard lock(mutex);
            statistics.of(limbs_[limb].name.kind).add(range);
        });
}

void ClipCrowd::measure_range(std::size_t limb, std::uint32_t begin, std::uint32_t end,
                              LimbStatistics& statistics) const
{
    struct Reached {
        double elbow[3], wrist[3], hand[4];
    };
    std::vector<Reached> reached(end - begin);
    std::vector<std::uint32_t> flags(end - begin);
    const auto group = static_cast<std::uint32_t>(limb);
    check(swivel_forward(crowd_.get(), group, begin, end - begin, {reached[0].elbow, sizeof(Reached)},
                         {reached[0].wrist, sizeof(Reached)}, {reached[0].hand, sizeof(Reached)}));
    check(swivel_read(crowd_.get(), SWIVEL_FLAGS, group, begin, end - begin, {flags.data(), sizeof flags[0]}));
    for (std::uint32_t n = begin; n < end; ++n) {
        const Reached& at = reached[n - begin];
        const Goal& goal = goals_[limb][n];
        const float(&lengths)[2] = inputs_[limb][n].lengths;
        const double length = double{lengths[0]} + lengths[1];
        statistics.add_flags(flags[n - begin]);
        if (flags[n - begin] & SWIVEL_BAD_INPUT) continue;  // counted; its errors mean nothing
        const double missed = (Vector3d(at.wrist) - goal.wrist).norm() / length;
        (flags[n - begin] & SWIVEL_REACHED ? statistics.reached : statistics.missed).add(missed);
        statistics.orientation.add(angle(goal.hand.conjugate() * Quaterniond(at.hand)));
        if (goal.from_clip) measure_against_clip(limb, n, Vector3d(at.elbow), statistics);
    }
}

void ClipCrowd::measure_against_clip(std::size_t limb, std::uint32_t character, const Vector3d& elbow,
                                     LimbStatistics& statistics) const
{
    const Source& from = source(limb, character);
    const Goal& goal = goals_[limb][character];
    const Vector3d upper = (from.elbow - from.shoulder).normalized(), fore = (from.wrist - from.elbow).normalized();
    const float(&lengths)[2] = inputs_[limb][character].lengths;
    const bool bent = upper.cross(fore).norm() > kBentSine || upper.dot(fore) < 0;
    (bent ? statistics.bent : statistics.straight).add((elbow - goal.pole).norm() / (double{lengths[0]} + lengths[1]));
    if (character != 0) return;

    const formats::PoseRow row = pose(limb, character);
    const Quaterniond shoulder_w = from.parent * quaternion(row.shoulder);
    const Quaterniond turned = from.upper.conjugate() * shoulder_w;
    const Vector3d axis = clip_.joints[static_cast<std::size_t>(limbs_[limb].lower())].offset.normalized();
    statistics.upper_swing.add(swing(turned, axis));
    statistics.upper_twist.add(twist(turned, axis));
    statistics.lower.add(angle(from.fore.conjugate() * shoulder_w * quaternion(row.elbow)));
}

}  // namespace swivel::tools
