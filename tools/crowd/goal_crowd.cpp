// SPDX-License-Identifier: MIT
#include "tools/crowd/goal_crowd.h"

#include <algorithm>

#include "swivel/swivel_bodies.hpp"
#include "tools/crowd/parallel.h"

namespace swivel::tools {

namespace {

Crowd crowd_of(std::span<const LimbSetup> limbs, std::uint32_t characters)
{
    const LimbSkeleton of = skeleton_of(limbs);
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = static_cast<std::uint32_t>(of.parents.size());
    skeleton.parents = {of.parents.data(), sizeof of.parents[0]};
    skeleton.translations = {of.translations.data(), sizeof of.translations[0]};
    skeleton.rotations = {of.rotations.data(), sizeof of.rotations[0]};
    std::vector<swivel_limb_joints> joints;
    for (const LimbSkeleton::OfLimb& limb : of.limbs) {
        swivel_limb_joints& limb_joints =
            joints.emplace_back(swivel_default_limb_joints(limb.shoulder, limb.shoulder + 1, limb.shoulder + 2));
        limb_joints.twist_bone_count = static_cast<std::uint32_t>(limb.twist_bones.size());
        limb_joints.twist_bones = limb.twist_bones.data();
        std::ranges::copy(limb.bend, limb_joints.bend);
    }
    std::vector<Definition> groups;
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        if (limbs[n].look) {
            swivel_look_def look = *limbs[n].look;
            for (std::uint32_t joint = 0; joint < look.joint_count; ++joint) look.joints[joint] += of.limbs[n].shoulder;
            groups.emplace_back(look);
            continue;
        }
        swivel_body_limb_def limb = body_limb(joints[n], limbs[n].features);
        limb.on_bad_input = SWIVEL_REST_POSE;  // the same in whatever order frames are solved
        limb.shoulder_order = limbs[n].shoulder_order;
        limb.wrist_order = limbs[n].wrist_order;
        if (limbs[n].region) limb.region = &*limbs[n].region;
        limb.plant = limbs[n].standing_plant();
        limb.ground = limbs[n].standing_ground();
        if (limbs[n].goals.holds) limb.link = limbs[n].goals.holds - 1;
        groups.emplace_back(limb);
    }
    if (std::ranges::any_of(limbs, [](const LimbSetup& limb) { return limb.has(SWIVEL_WITH_PELVIS_FIT); }))
        groups.emplace_back(swivel_default_shift_def());
    Crowd crowd(skeleton, characters, groups);
    for (std::uint32_t n = 0; n < limbs.size(); ++n)
        for (const FixedField& fixed : limbs[n].fields)
            check(swivel_write(crowd.get(), fixed.field, n, 0, characters, {fixed.value.data(), 0}));
    return crowd;
}

}  // namespace

LimbSkeleton skeleton_of(std::span<const LimbSetup> limbs)
{
    constexpr std::array<float, 4> still{0, 0, 0, 1};
    LimbSkeleton skeleton;
    const auto add = [&](std::int32_t parent, const std::array<float, 3>& place, const std::array<float, 4>& rotation) {
        skeleton.parents.push_back(parent);
        skeleton.translations.push_back(place);
        skeleton.rotations.push_back(rotation);
        return static_cast<std::int32_t>(skeleton.parents.size()) - 1;
    };
    for (const LimbSetup& limb : limbs) {
        std::array<float, 3> place;
        std::ranges::transform(limb.goals.shoulder_place, place.begin(),
                               [](double x) { return static_cast<float>(x); });
        const std::int32_t above = add(-1, {0, 0, 0}, still);
        const std::int32_t shoulder = add(above, place, std::to_array(limb.rest.shoulder_rotation));
        const std::int32_t elbow =
            add(shoulder, std::to_array(limb.rest.elbow_offset), std::to_array(limb.rest.elbow_rotation));
        add(elbow, std::to_array(limb.rest.wrist_offset), std::to_array(limb.rest.wrist_rotation));
        LimbSkeleton::OfLimb& joints = skeleton.limbs.emplace_back();
        joints.shoulder = static_cast<std::uint32_t>(shoulder);
        joints.bend = std::to_array(limb.rest.bend);
        for (std::uint32_t n = 0; n < limb.twist_bone_count; ++n)
            joints.twist_bones.push_back(static_cast<std::uint32_t>(add(elbow, {0, 0, 0}, still)));
    }
    return skeleton;
}

GoalCrowd::GoalCrowd(std::span<const LimbSetup> limbs, const std::vector<std::span<const goal_source>>& sources,
                     std::vector<goal_character> characters, std::uint32_t budget_blocks, const Ground* ground,
                     double frame_seconds)
    : limbs_(limbs),
      characters_(std::move(characters)),
      crowd_(crowd_of(limbs, character_count())),
      roots_(characters_.size()),
      inputs_(characters_.size() * limbs.size()),
      pose_size_(swivel_goal_pose_size(crowd_.get())),
      budget_blocks_(budget_blocks),
      ground_(ground),
      frame_seconds_(static_cast<float>(frame_seconds))
{
    poses_.resize(characters_.size() * pose_size_);
    std::size_t place = 0;
    for (std::size_t limb = 0; limb < limbs.size(); ++limb) {
        plans_.push_back(limbs[limb].goals);
        sources_.push_back(sources[limb].data());
        pose_place_.push_back(place);
        place += 4 * (GOAL_JOINTS + limbs[limb].twist_bone_count);
    }
}

float GoalCrowd::rise(std::uint32_t character) const
{
    if (!ground_) return 0;
    const goal_character& who = characters_[character];
    const goal_root& root = roots_[character];
    const double height = who.place[1] + who.size * sources_[0][clip_frame(character)].root[1];
    return static_cast<float>(root.place[1] + double{root.shift} - height);
}

void GoalCrowd::set_frame(std::uint32_t frame)
{
    frame_ = frame;
    const auto limb_count = static_cast<std::uint32_t>(limbs_.size());
    for_ranges(character_count(), [&](std::uint32_t begin, std::uint32_t end) {
        swivel_goals(plans_.data(), sources_.data(), limb_count, frame, grid(), heights(), &characters_[begin],
                     end - begin, &roots_[begin], &inputs_[std::size_t{begin} * limb_count]);
    });
    for (std::uint32_t n = 0; n < character_count(); ++n)
        if (clip_frame(n) == characters_[n].first)
            for (std::uint32_t group = 0; group < swivel_group_count(crowd_.get()); ++group)
                check(swivel_reset(crowd_.get(), group, n, 1));
}

void GoalCrowd::solve()
{
    swivel_job job = swivel_default_job();
    job.on_this_thread = is_one_thread();
    if (budget_blocks_ > 0 && began_) {
        constexpr float kAlike = 1;
        const swivel_in priorities{&kAlike, 0};
        urgency_.resize(swivel_block_count(crowd_.get()));
        active_.resize((urgency_.size() + 1) / 2);
        crowd_.choose({&priorities, 1}, urgency_, budget_blocks_, active_);
        job.mask = active_.data();
        job.mask_word_count = static_cast<std::uint32_t>(active_.size());
    }
    began_ = true;
    check(swivel_goals_solve(crowd_.get(), grid(), heights(), frame_seconds_, characters_.data(), roots_.data(),
                             inputs_.data(), poses_.data(), &job));
}

std::array<float, 4> GoalCrowd::rotation(std::size_t limb, std::uint32_t character, std::size_t joint) const
{
    const std::size_t at = character * pose_size_ + pose_place_[limb] + 4 * joint;
    return limbs_[limb].own(std::span<const float, 4>(&poses_[at], 4));
}

bool GoalCrowd::has(std::size_t limb, swivel_field field) const
{
    return swivel_field_row_count(crowd_.get(), group_of(limb, field), field) > 0;
}

void GoalCrowd::read(std::size_t limb, swivel_field field, std::uint32_t first, std::uint32_t count,
                     swivel_out to) const
{
    check(swivel_read(crowd_.get(), field, group_of(limb, field), first, count, to));
}

void GoalCrowd::residuals(std::size_t limb, std::uint32_t first, std::uint32_t count, swivel_out distance) const
{
    check(swivel_residuals(crowd_.get(), static_cast<std::uint32_t>(limb), first, count, distance));
}

void GoalCrowd::restore(std::size_t limb, swivel_field field, std::span<const std::uint32_t> numbers)
{
    const std::size_t stride = numbers.size_bytes() / character_count();
    check(swivel_write(crowd_.get(), field, group_of(limb, field), 0, character_count(),
                       {reinterpret_cast<const float*>(numbers.data()), stride}));
}

}  // namespace swivel::tools
