// SPDX-License-Identifier: MIT
#include "tests/fuzz/crowd_of_bytes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace swivel::fuzz {

BodyDef::BodyDef(Bytes& bytes, std::uint32_t max_bodies)
{
    Random random{bytes.take<std::uint16_t>()};
    body_count = 1 + bytes.below(max_bodies);
    const std::uint32_t trunk = bytes.below(5);
    for (std::uint32_t n = 0; n < trunk; ++n) add(random, static_cast<std::int32_t>(bytes.below(n + 1)) - 1);
    groups.resize(1 + bytes.below(4));
    std::vector<swivel_features> features;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        features.push_back(body_features_of(bytes));
        take_limb(bytes, random, trunk, features[g]);
    }
    skeleton.joint_count = joint_count();
    skeleton.parents = {parents.data(), sizeof parents[0]};
    skeleton.translations = {translations.data(), 3 * sizeof translations[0]};
    if (bytes.one_in(2)) skeleton.rotations = {rotations.data(), 4 * sizeof rotations[0]};
    for (std::size_t g = 0; g < groups.size(); ++g) {
        joints[g].twist_bones = twist_bones[g].data();
        // Where flexion carries the forearm: not along the upper arm.
        for (std::size_t axis = 0; axis < 3; ++axis) {
            swivel_binding binding = swivel_default_binding();
            if (swivel_bind_joints(&skeleton, &joints[g], &binding) == SWIVEL_OK) break;
            for (std::size_t n = 0; n < 3; ++n) joints[g].bend[n] = n == axis;
        }
        groups[g] = swivel_default_body_group_def(&joints[g]);
        groups[g].features = features[g];
        groups[g].shoulder_order = static_cast<swivel_euler_order>(bytes.below(6));
        groups[g].wrist_order = static_cast<swivel_euler_order>(bytes.below(6));
        if (bytes.one_in(2)) groups[g].on_bad_input = SWIVEL_REST_POSE;
        give_region(bytes, groups[g]);
    }
    add_shift();
    take_links(bytes, trunk);
    if (trunk > 0 && bytes.one_in(2)) take_looks(bytes, trunk);
    if (bytes.one_in(2)) take_constants(bytes);
    if (!bytes.one_in(4)) return;
    is_sound = false;
    for (std::uint32_t n = 1 + bytes.below(3); n > 0; --n) spoil(bytes);
}

// The group that limbs which are to fit need.
void BodyDef::add_shift()
{
    if (std::ranges::any_of(groups, [](const auto& group) { return group.features & SWIVEL_WITH_PELVIS_FIT; }))
        groups.push_back(swivel_default_fit_group_def());
}

// What limbs hold: the hand of an earlier one, or a prop.
void BodyDef::take_links(Bytes& bytes, std::uint32_t trunk)
{
    for (std::uint32_t g = 0; g < joints.size(); ++g) {
        if (!(groups[g].features & SWIVEL_WITH_LINK)) continue;
        const std::uint32_t earlier = bytes.below(g + 2);
        if (earlier < g && groups[earlier].features & SWIVEL_WITH_HAND)
            groups[g].link = earlier;
        else
            link_to_prop(bytes, trunk, groups[g]);
    }
}
// The last group may be a prop that one limb holds so far. Others are new.
void BodyDef::link_to_prop(Bytes& bytes, std::uint32_t trunk, swivel_group_def& group)
{
    const auto last = static_cast<std::uint32_t>(groups.size() - 1);
    const auto is_on_last = [&](const swivel_group_def& other) {
        return other.features & SWIVEL_WITH_LINK && other.link == last;
    };
    const bool is_held = groups[last].features & SWIVEL_PROP && std::ranges::count_if(groups, is_on_last) == 1;
    group.link = is_held && !bytes.one_in(4) ? last : last + 1;
    if (group.link == last) return;
    swivel_group_def prop = swivel_default_prop_group_def();
    if (bytes.one_in(2)) prop.prop.joint = static_cast<std::int32_t>(bytes.below(trunk + 1)) - 1;
    groups.push_back(prop);  // group is no longer there
}

// Joints on the way down to one of the trunk look, and those below some of them may look by themselves.
void BodyDef::take_looks(Bytes& bytes, std::uint32_t trunk)
{
    std::vector<std::uint32_t> way;
    for (auto at = static_cast<std::int32_t>(bytes.below(trunk)); at >= 0; at = parents[static_cast<std::size_t>(at)])
        if (way.empty() || !bytes.one_in(4)) way.insert(way.begin(), static_cast<std::uint32_t>(at));
    const auto count = static_cast<std::uint32_t>(way.size()), first = 1 + bytes.below(count);
    add_look(bytes, way.data(), first);
    if (first < count) add_look(bytes, way.data() + first, count - first);
}
void BodyDef::add_look(Bytes& bytes, const std::uint32_t* of, std::size_t count)
{
    const auto number = [&](float min, float max) {
        return min + (max - min) * static_cast<float>(bytes.below(9)) / 8;
    };
    swivel_group_def group = swivel_default_group_def(0);
    group.features = SWIVEL_LOOK;
    if (bytes.one_in(2)) group.on_bad_input = SWIVEL_KEEP_POSE;
    swivel_look& look = group.look;
    look.joint_count = static_cast<std::uint32_t>(count);
    for (std::size_t n = 0; n < count; ++n) {
        look.joints[n] = of[n];
        look.share[n] = number(n + 1 < count ? 0 : 0.5f, 3);
        look.cos_max[n] = number(-1, 1);
    }
    for (float& x : look.eye) x = number(-0.2f, 0.2f);
    for (float& x : look.axis) x = number(-1, 1);
    look.axis[1] += 1.5f;
    look.fade_distance = number(0, 0.5f);
    look.rate = number(0, 4);
    groups.push_back(group);
}

// How limbs stand and bodies shift, in steps from nothing to much.
void BodyDef::take_constants(Bytes& bytes)
{
    const auto number = [&](float max) { return max * static_cast<float>(bytes.below(9)) / 8; };
    for (swivel_group_def& group : groups) {
        group.plant = {number(1),
                       number(1),
                       number(0.4f),
                       number(0.4f),
                       number(2),
                       number(1),
                       number(2),
                       {number(4), number(4)},
                       {number(2) - 1, number(2) - 1}};
        group.plant.unlock_radius += group.plant.lock_radius;  // which it is no less than
        group.fit = {number(1), number(1), number(0.4f), number(1)};
        if (!((group.features & SWIVEL_WITH_GROUND) | (group.features & SWIVEL_PROP))) continue;
        group.ground = {{number(0.4f) - 0.2f, number(0.4f) - 0.2f, number(0.4f) - 0.2f},
                        number(0.2f),
                        number(0.2f),
                        number(1),
                        number(0.4f)};
        group.prop.max_move = number(1);
    }
    for (float& x : up) x = number(2) - 1;
    up[1] = 1;
}

std::int32_t BodyDef::add(Random& random, std::int32_t parent)
{
    parents.push_back(parent);
    for (int n = 0; n < 4; ++n) rotations.push_back(random.share());
    for (int n = 0; n < 3; ++n) translations.push_back(random.share());
    return static_cast<std::int32_t>(joint_count() - 1);
}

void BodyDef::take_limb(Bytes& bytes, Random& random, std::uint32_t trunk, swivel_features features)
{
    const auto below = [&](std::int32_t joint) {
        for (std::uint32_t n = bytes.below(3); n > 0; --n) joint = add(random, joint);
        return add(random, joint);
    };
    std::int32_t above = static_cast<std::int32_t>(bytes.below(trunk + 1)) - 1;
    if (features & SWIVEL_WITH_CLAVICLE) above = add(random, above);
    const std::int32_t shoulder = add(random, above), elbow = below(shoulder), wrist = below(elbow);
    if (bytes.one_in(2)) add(random, wrist);  // which no limb needs
    joints.push_back(swivel_default_limb_joints(static_cast<std::uint32_t>(shoulder), static_cast<std::uint32_t>(elbow),
                                                static_cast<std::uint32_t>(wrist)));
    for (float& x : joints.back().bend) x = random.share();
    // At the elbow, all of them: they must not lie one before the other.
    std::vector<std::uint32_t>& bones = twist_bones.emplace_back();
    for (auto n = features / SWIVEL_WITH_TWIST_BONES % (SWIVEL_MAX_TWIST_BONES + 1); n > 0; --n) {
        bones.push_back(static_cast<std::uint32_t>(add(random, elbow)));
        std::fill_n(translations.end() - 3, 3, 0.0f);
    }
    joints.back().twist_bone_count = static_cast<std::uint32_t>(bones.size());
}

// Puts any bits, or the number of a joint or of none, into one of the words up to the end.
void BodyDef::spoil_word(Bytes& bytes, void* begin, const void* end) const
{
    const auto size = static_cast<const char*>(end) - static_cast<char*>(begin);
    const std::uint32_t any = bytes.one_in(2) ? bytes.take<std::uint32_t>() : bytes.below(joint_count() + 3) - 1;
    std::memcpy(static_cast<char*>(begin) + sizeof any * bytes.below(static_cast<std::uint32_t>(size / 4)), &any,
                sizeof any);
}

void BodyDef::spoil(Bytes& bytes)
{
    const std::size_t g = bytes.below(static_cast<std::uint32_t>(joints.size()));
    swivel_limb_joints& limb = joints[g];
    swivel_group_def& group = groups[bytes.below(static_cast<std::uint32_t>(groups.size()))];
    const std::pair<void*, const void*> words[] = {
        {parents.data(), parents.data() + parents.size()},  // also in a circle
        {translations.data(), translations.data() + translations.size()},
        {rotations.data(), rotations.data() + rotations.size()},
        {&limb.shoulder, &limb.twist_bone_count},
        {limb.bend, &limb + 1},
        {&group.plant, &group.region}};  // how it stands, fits, links and looks, also of a group that does not
    const std::uint32_t kind = bytes.take<std::uint8_t>() % 14;
    switch (kind) {
        default:
            spoil_word(bytes, words[std::min(kind, 5u)].first, words[std::min(kind, 5u)].second);
            break;
        case 5:  // the limb of another group
            limb = joints[bytes.below(static_cast<std::uint32_t>(joints.size()))];
            break;
        case 8:
            group.features ^= bytes.one_in(2) ? SWIVEL_WITH_LINK : swivel_features{1} << bytes.below(64);
            break;
        case 9:  // 0 and the bodies' count are right
            group.limb_count = bytes.below(body_count + 2);
            break;
        case 10:
            (bytes.one_in(2) ? skeleton.size : limb.size) = bytes.below(sizeof(swivel_limb_joints) + 9);
            break;
        case 11:
            (bytes.one_in(2) ? skeleton.joint_count : skeleton.reserved) = bytes.below(joint_count());
            break;
        case 12:  // also a second shift, and a prop that nobody holds
            groups.push_back(bytes.one_in(2) ? swivel_default_fit_group_def() : swivel_default_prop_group_def());
            break;
        case 13:
            bytes.one_in(2) ? void(up[1] = bytes.any_float()) : void(groups[g].joints = nullptr);
    }
}

swivel_crowd_def BodyDef::crowd_def(std::uint32_t bodies)
{
    swivel_crowd_def def = swivel_default_crowd_def();
    for (swivel_group_def& group : groups)
        if (group.limb_count == body_count && bodies != body_count) group.limb_count = 0;
    def.groups = groups.data();
    def.group_count = static_cast<std::uint32_t>(groups.size());
    def.skeleton = &skeleton;
    def.body_count = bodies;
    std::ranges::copy(up, def.up);
    return def;
}

swivel_limb_joints BodyDef::limb_of(std::uint32_t group) const
{
    swivel_limb_joints limb = swivel_default_limb_joints(0, 0, 0);
    std::memcpy(&limb, &joints[group], std::min(joints[group].size, sizeof limb));
    return limb;
}

bool BodyDef::is_above(std::uint32_t joint, std::uint32_t below) const
{
    for (auto at = static_cast<std::int32_t>(below); at >= 0; at = parents[static_cast<std::size_t>(at)])
        if (static_cast<std::uint32_t>(at) == joint) return true;
    return false;
}

bool BodyDef::is_needed(std::uint32_t joint) const
{
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
        if (g < joints.size() && is_above(joint, limb_of(g).wrist)) return true;
        for (const std::uint32_t turned : turned_joints(g))
            if (is_above(joint, turned)) return true;
    }
    return std::ranges::any_of(groups, [&](const swivel_group_def& group) {
        return group.features & SWIVEL_PROP && group.prop.joint >= 0 &&
               is_above(joint, static_cast<std::uint32_t>(group.prop.joint));
    });
}

std::vector<std::uint32_t> BodyDef::turned_joints(std::uint32_t group) const
{
    if (groups[group].features & SWIVEL_LOOK)
        return {groups[group].look.joints, groups[group].look.joints + groups[group].look.joint_count};
    if (group >= joints.size()) return {};  // shifts and props turn none
    const swivel_limb_joints limb = limb_of(group);
    const swivel_features features = groups[group].features;
    std::vector<std::uint32_t> turned = {limb.shoulder, limb.elbow};
    if (features & SWIVEL_WITH_HAND) turned.push_back(limb.wrist);
    if (features & SWIVEL_WITH_CLAVICLE) turned.push_back(static_cast<std::uint32_t>(parents[limb.shoulder]));
    const auto bones = features / SWIVEL_WITH_TWIST_BONES % (SWIVEL_MAX_TWIST_BONES + 1);
    turned.insert(turned.end(), limb.twist_bones, limb.twist_bones + bones);
    return turned;
}

std::vector<std::uint32_t> BodyDef::moved_joints(std::uint32_t group) const
{
    std::vector<std::uint32_t> moved;
    for (std::uint32_t joint = 0; joint < joint_count(); ++joint)
        for (const std::uint32_t turned : turned_joints(group))
            if (is_above(turned, joint)) {
                moved.push_back(joint);
                break;
            }
    return moved;
}

bool BodyDef::is_seen(std::uint32_t joint) const
{
    bool is_moved = false;
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
        const std::vector<std::uint32_t> moved = moved_joints(g);
        is_moved = is_moved || std::find(moved.begin(), moved.end(), joint) != moved.end();
    }
    return is_moved || is_needed(joint);
}

}  // namespace swivel::fuzz
