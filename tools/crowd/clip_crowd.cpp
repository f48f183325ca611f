// SPDX-License-Identifier: MIT
#include "tools/crowd/clip_crowd.h"

#include <algorithm>
#include <chrono>

#include "tools/crowd/parallel.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::PoleKind;

static_assert(formats::kMostTwistBones == SWIVEL_MOST_TWIST_BONES);  // a format knows no solver

void store(const Vector3d& v, float (&to)[3])
{
    for (int n = 0; n < 3; ++n) to[n] = static_cast<float>(v[n]);
}

template <class Floats>
void store(const Quaterniond& q, Floats& to)
{
    for (int n = 0; n < 4; ++n) to[static_cast<std::size_t>(n)] = static_cast<float>(q.coeffs()[n]);
}

}  // namespace

ClipCrowd::ClipCrowd(const formats::Clip& clip, std::span<const Limb> limbs, const CrowdPlan& plan,
                     const std::filesystem::path& file)
    : clip_(clip),
      motion_(clip, limbs),
      limbs_(limbs),
      plans_(plan.limbs),
      characters_(characters_of(plan, limbs, motion_.frame_count())),
      crowds_(limbs, plan, file)
{
    goals_.resize(limbs.size(), std::vector<Goal>(plan.characters));
    inputs_.resize(limbs.size(), std::vector<Input>(plan.characters));
    rows_.resize(limbs.size() * plan.characters);
    const formats::PoseColumns wanted = columns();
    if (wanted.stretch || wanted.clavicle || wanted.twist_count > 0) extras_.resize(rows_.size());
    write_sizes();
}

// What goes with a character's size and stays the same.
void ClipCrowd::write_sizes()
{
    for (std::size_t limb = 0; limb < limbs_.size(); ++limb) {
        struct Value {
            float lengths[2], effector[3];
        };
        std::vector<Value> values(characters_.size());
        for (std::size_t n = 0; n < characters_.size(); ++n) {
            for (int bone = 0; bone < 2; ++bone)
                values[n].lengths[bone] = static_cast<float>(characters_[n].size) * limbs_[limb].bound.lengths[bone];
            store(characters_[n].size * plans_[limb].effector, values[n].effector);
            std::copy_n(values[n].lengths, 2, inputs_[limb][n].lengths);
        }
        crowds_.write(limb, SWIVEL_LENGTHS, values[0].lengths, sizeof(Value));
        if (crowds_.has(limb, SWIVEL_EFFECTOR)) crowds_.write(limb, SWIVEL_EFFECTOR, values[0].effector, sizeof(Value));
    }
}

// As the plan's kind of pole has it.
Vector3d ClipCrowd::pole_from_clip(std::size_t limb, std::uint32_t character) const
{
    const LimbInClip& from = in_clip(limb, character);
    const LimbPlan& plan = plans_[limb];
    const Vector3d elbow = from.elbow - from.shoulder;
    if (plan.pole == PoleKind::point)
        return from.shoulder +
               (plan.pole_fixed ? as_solved(limb, *plan.pole_fixed) : characters_[character].size * elbow);
    if (plan.pole_fixed) return as_solved(limb, *plan.pole_fixed);
    return plan.pole == PoleKind::normal ? Vector3d(from.wrist - from.shoulder).cross(elbow) : elbow;
}

ClipCrowd::Goal ClipCrowd::goal_from_plan(std::size_t limb, std::uint32_t character) const
{
    const LimbInClip& from = in_clip(limb, character);
    const LimbPlan& plan = plans_[limb];
    const double size = characters_[character].size;
    const Vector3d at_clip = from.shoulder + size * (from.wrist - from.shoulder + from.hand * plan.effector);
    const Vector3d at =
        plan.target_point ? as_solved(limb, *plan.target_point - motion_.origin(clip_frame(character), limb)) : at_clip;
    const bool from_clip = !plan.target_point && plan.target_offset.isZero(0) && plan.follows_pole;
    return {at + as_solved(limb, plan.target_offset), pole_from_clip(limb, character), from.hand, from_clip};
}

ClipCrowd::Goal ClipCrowd::goal_given(std::size_t limb, const formats::Target& target) const
{
    const LimbPlan& plan = plans_[limb];
    const Vector3d at = origin(limb, target.character);
    const Vector3d pole = plan.pole == PoleKind::point ? Vector3d(target.pole - at) : target.pole;
    const bool has_pole = target.has_pole && !plan.pole_fixed;
    return {as_solved(limb, target.position - at + plan.target_offset),
            has_pole ? as_solved(limb, pole) : pole_from_clip(limb, target.character),
            target.has_orientation ? as_solved(limb, target.orientation) : in_clip(limb, target.character).hand, false};
}

formats::Target ClipCrowd::target(std::size_t limb, std::uint32_t character) const
{
    const Goal& goal = goals_[limb][character];
    const LimbPlan& plan = plans_[limb];
    const Vector3d at = origin(limb, character), pole = as_solved(limb, goal.pole);
    formats::Target target;
    target.frame = static_cast<std::uint32_t>(frame_);
    target.character = character;
    target.limb = limbs_[limb].name;
    target.has_pole = target.has_orientation = true;
    target.position = at + (as_solved(limb, goal.target) - plan.target_offset);
    target.pole = plan.pole == PoleKind::point ? Vector3d(at + pole) : pole;
    target.orientation = as_solved(limb, goal.hand);
    return target;
}

Vector3d ClipCrowd::as_solved(std::size_t limb, const Vector3d& v) const
{
    return limbs_[limb].mirrored ? formats::mirrored(v) : v;
}
Quaterniond ClipCrowd::as_solved(std::size_t limb, const Quaterniond& q) const
{
    return limbs_[limb].mirrored ? formats::mirrored(q) : q;
}

void ClipCrowd::put(std::size_t limb, std::uint32_t character, const Goal& goal)
{
    const LimbInClip& from = in_clip(limb, character);
    Input& input = inputs_[limb][character];
    goals_[limb][character] = goal;
    store(goal.target, input.target);
    store(goal.pole, input.pole);
    store(from.shoulder, input.position);
    store(from.parent, input.rotation);
    store(plans_[limb].has(SWIVEL_WITH_AIM) ? from.local_wrist() : goal.hand, input.hand);
    if (motion_.stretches(limb)) {
        input.lengths[0] = static_cast<float>(characters_[character].size * from.upper_length());
        input.lengths[1] = static_cast<float>(characters_[character].size * from.fore_length());
    }
    if (!crowds_.has(limb, SWIVEL_INCOMING_SHOULDER)) return;
    store(from.local_shoulder(), input.shoulder);
    store(from.local_elbow(), input.elbow);
    store(from.local_wrist(), input.wrist);
}

void ClipCrowd::write_inputs(std::size_t limb)
{
    const Input& first = inputs_[limb][0];
    for (const auto& [field, from] : {std::pair{SWIVEL_TARGET, &first.target[0]},
                                      {SWIVEL_POLE, first.pole},
                                      {SWIVEL_SHOULDER_POSITION, first.position},
                                      {SWIVEL_PARENT_ROTATION, first.rotation},
                                      {SWIVEL_HAND, first.hand},
                                      {SWIVEL_INCOMING_SHOULDER, first.shoulder},
                                      {SWIVEL_INCOMING_ELBOW, first.elbow},
                                      {SWIVEL_INCOMING_WRIST, first.wrist}})
        if (crowds_.has(limb, field)) crowds_.write(limb, field, from, sizeof(Input));
    if (motion_.stretches(limb)) crowds_.write(limb, SWIVEL_LENGTHS, first.lengths, sizeof(Input));
}

void ClipCrowd::set_frame(std::size_t frame, std::span<const formats::Target> given)
{
    frame_ = frame;
    for (std::size_t limb = 0; limb < limbs_.size(); ++limb)
        for_ranges(character_count(), [&](std::uint32_t begin, std::uint32_t end) {
            for (std::uint32_t n = begin; n < end; ++n) put(limb, n, goal_from_plan(limb, n));
        });
    for (const formats::Target& target : given) {
        const auto of = [&](const Limb& each) { return each.name == target.limb; };
        const auto limb = static_cast<std::size_t>(std::find_if(limbs_.begin(), limbs_.end(), of) - limbs_.begin());
        put(limb, target.character, goal_given(limb, target));
    }
    for (std::size_t limb = 0; limb < limbs_.size(); ++limb) {
        write_inputs(limb);
        if (frame == 0 || !crowds_.has(limb, SWIVEL_NORMAL)) continue;
        for (std::uint32_t n = 0; n < character_count(); ++n)  // from the clip's end to its start is no motion
            if (clip_frame(n) == 0) crowds_.reset(limb, n);
    }
}

void ClipCrowd::solve(Statistics& statistics)
{
    const auto before = std::chrono::steady_clock::now();
    crowds_.solve();
    statistics.solve_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

formats::PoseRow ClipCrowd::pose(std::size_t limb, std::uint32_t character) const
{
    formats::PoseRow row = solved_pose(limb, character);
    const LimbInClip& from = in_clip(limb, character);
    const LimbChain& chain = limbs_[limb].chain;
    const auto is_none = [](const Quaterniond& q) { return q.vec().isZero(0); };
    // The joints of most skeletons are the solver's own, to the last bit.
    if (chain.is_plain && is_none(from.upper_aim) && is_none(from.fore_aim)) return row;
    const Quaterniond shoulder = quaternion(row.shoulder), fore = shoulder * quaternion(row.elbow);
    const std::array<Quaterniond, 3> own = local_rotations(
        clip_, clip_frame(character), chain,
        {shoulder * from.upper_aim.conjugate(), fore * from.fore_aim.conjugate(), fore * quaternion(row.wrist)});
    store(own[0], row.shoulder);
    store(own[1], row.elbow);
    store(own[2], row.wrist);
    return row;
}

formats::PoseRow ClipCrowd::solved_pose(std::size_t limb, std::uint32_t character) const
{
    formats::PoseRow row;
    const Character& who = characters_[character];
    row.character = character;
    row.place = {who.place.x(), who.place.y(), who.place.z()};
    row.size = who.size;
    row.start = who.start;
    row.limb = limbs_[limb].name;
    crowds_.read(limb, SWIVEL_SHOULDER, character, 1, {row.shoulder.data(), sizeof row.shoulder});
    crowds_.read(limb, SWIVEL_ELBOW, character, 1, {row.elbow.data(), sizeof row.elbow});
    if (crowds_.has(limb, SWIVEL_WRIST))
        crowds_.read(limb, SWIVEL_WRIST, character, 1, {row.wrist.data(), sizeof row.wrist});
    else
        store(in_clip(limb, character).local_wrist(), row.wrist);
    crowds_.read(limb, SWIVEL_FLAGS, character, 1, {&row.flags, sizeof row.flags});
    return row;
}

Quaterniond ClipCrowd::clavicle(std::size_t limb, std::uint32_t character) const
{
    float turn[4];
    crowds_.read(limb, SWIVEL_CLAVICLE_TURN, character, 1, {turn, sizeof turn});
    return in_clip(limb, character).local_parent * Quaterniond(turn[3], turn[0], turn[1], turn[2]);
}

formats::PoseExtra ClipCrowd::extra(std::size_t limb, std::uint32_t character) const
{
    formats::PoseExtra extra;
    if (crowds_.has(limb, SWIVEL_STRETCH))
        crowds_.read(limb, SWIVEL_STRETCH, character, 1, {&extra.stretch, sizeof extra.stretch});
    if (plans_[limb].has(SWIVEL_WITH_CLAVICLE)) {
        extra.has_clavicle = true;
        store(clavicle(limb, character), extra.clavicle);
    }
    extra.twist_count = plans_[limb].twist_count();
    if (extra.twist_count > 0)
        crowds_.read(limb, SWIVEL_TWIST_BONES, character, 1, {extra.twist.data(), sizeof extra.twist});
    return extra;
}

formats::PoseColumns ClipCrowd::columns() const
{
    formats::PoseColumns columns;
    for (const LimbPlan& plan : plans_) {
        columns.stretch = columns.stretch || plan.has(SWIVEL_WITH_REACH);
        columns.clavicle = columns.clavicle || plan.has(SWIVEL_WITH_CLAVICLE);
        columns.twist_count = std::max(columns.twist_count, plan.twist_count());
    }
    return columns;
}

std::span<const formats::Target> ClipCrowd::targets()
{
    targets_.resize(rows_.size());
    for_ranges(character_count(), [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t n = begin; n < end; ++n)
            for (std::size_t limb = 0; limb < limbs_.size(); ++limb)
                targets_[n * limbs_.size() + limb] = target(limb, n);
    });
    return targets_;
}

std::span<const formats::PoseRow> ClipCrowd::poses()
{
    for_ranges(character_count(), [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t n = begin; n < end; ++n)
            for (std::size_t limb = 0; limb < limbs_.size(); ++limb) rows_[n * limbs_.size() + limb] = pose(limb, n);
    });
    return rows_;
}

std::span<const formats::PoseExtra> ClipCrowd::extras()
{
    if (extras_.empty()) return {};
    for_ranges(character_count(), [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t n = begin; n < end; ++n)
            for (std::size_t limb = 0; limb < limbs_.size(); ++limb) extras_[n * limbs_.size() + limb] = extra(limb, n);
    });
    return extras_;
}

}  // namespace swivel::tools
