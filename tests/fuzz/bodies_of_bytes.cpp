// SPDX-License-Identifier: MIT
#include "tests/fuzz/crowd_of_bytes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <utility>

namespace swivel::fuzz {

namespace {

// A large value for a constant, by its unit. Bodies' bones are about 1 long.
float much_of(std::string_view unit)
{
    if (unit == "s") return 0.4f;
    if (unit == "limb lengths a second") return 4;
    return unit == "the bones' unit" ? 0.2f : 1;
}
// Draws a structure's constants, in steps from nothing to much, within their bounds.
template <class Structure>
void put_constants(Bytes& bytes, std::string_view structure, Structure& to)
{
    swivel_constant_info info;
    for (std::uint32_t n = 0; swivel_describe_constant(n, &info); ++n) {
        if (structure != info.structure) continue;
        const float much = much_of(info.unit), min = std::max(info.min, -much), max = std::min(info.max, much);
        auto* const values = reinterpret_cast<float*>(reinterpret_cast<std::byte*>(&to) + info.offset);
        for (std::uint32_t k = 0; k < info.count; ++k)
            values[k] = min + (max - min) * static_cast<float>(bytes.below(9)) / 8;
    }
}

}  // namespace

BodyDef::BodyDef(Bytes& bytes, std::uint32_t max_bodies)
{
    Random random{bytes.take<std::uint16_t>()};
    body_count = 1 + bytes.below(max_bodies);
    const std::uint32_t trunk = bytes.below(5);
    for (std::uint32_t n = 0; n < trunk; ++n) add(random, static_cast<std::int32_t>(bytes.below(n + 1)) - 1);
    groups.resize(1 + bytes.below(4));
    for (BodyGroup& group : groups) {
        const LimbFeatures taken = features_of(bytes, SWIVEL_KIND_BODY_LIMB);
        group.limb.features = taken.features;
        take_limb(bytes, random, trunk, taken);
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
        swivel_body_limb_def& limb = groups[g].limb;
        limb.joints = &joints[g];
        limb.shoulder_order = static_cast<swivel_euler_order>(bytes.below(6));
        limb.wrist_order = static_cast<swivel_euler_order>(bytes.below(6));
        if (bytes.one_in(2)) limb.on_bad_input = SWIVEL_REST_POSE;
        limb.region = region_of(bytes, limb.features);
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
    if (std::ranges::any_of(groups, [](const BodyGroup& group) { return group.has(SWIVEL_WITH_PELVIS_FIT); }))
        groups.push_back({.kind = SWIVEL_KIND_SHIFT});
}

// What limbs hold: the hand of an earlier one, or a prop.
void BodyDef::take_links(Bytes& bytes, std::uint32_t trunk)
{
    for (std::uint32_t g = 0; g < joints.size(); ++g) {
        if (!groups[g].has(SWIVEL_WITH_LINK)) continue;
        const std::uint32_t earlier = bytes.below(g + 2);
        if (earlier < g && groups[earlier].has(SWIVEL_WITH_HAND))
            groups[g].limb.link = earlier;
        else
            link_to_prop(bytes, trunk, groups[g]);
    }
}
// The last group may be a prop that one limb holds so far. Others are new.
void BodyDef::link_to_prop(Bytes& bytes, std::uint32_t trunk, BodyGroup& group)
{
    const auto last = static_cast<std::uint32_t>(groups.size() - 1);
    const auto is_on_last = [&](const BodyGroup& other) {
        return other.has(SWIVEL_WITH_LINK) && other.limb.link == last;
    };
    const bool is_held = groups[last].kind == SWIVEL_KIND_PROP && std::ranges::count_if(groups, is_on_last) == 1;
    group.limb.link = is_held && !bytes.one_in(4) ? last : last + 1;
    if (group.limb.link == last) return;
    BodyGroup prop{.kind = SWIVEL_KIND_PROP};
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
    BodyGroup group{.kind = SWIVEL_KIND_LOOK};
    bytes.take<std::uint8_t>();  // seeds have one that says nothing
    swivel_look_def& look = group.look;
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

// How limbs stand and bodies shift.
void BodyDef::take_constants(Bytes& bytes)
{
    for (BodyGroup& group : groups) {
        swivel_plant& plant = group.limb.plant;
        put_constants(bytes, "plant", plant);
        plant.unlock_radius += plant.lock_radius;  // which it is no less than
        put_constants(bytes, "shift", group.shift);
        if (!group.has(SWIVEL_WITH_GROUND) && group.kind != SWIVEL_KIND_PROP) continue;
        put_constants(bytes, "ground", group.limb.ground);
        put_constants(bytes, "prop", group.prop);
    }
    for (float& x : up) x = 2 * static_cast<float>(bytes.below(9)) / 8 - 1;
    up[1] = 1;
}

std::int32_t BodyDef::add(Random& random, std::int32_t parent)
{
    parents.push_back(parent);
    for (int n = 0; n < 4; ++n) rotations.push_back(random.share());
    for (int n = 0; n < 3; ++n) translations.push_back(random.share());
    return static_cast<std::int32_t>(joint_count() - 1);
}

void BodyDef::take_limb(Bytes& bytes, Random& random, std::uint32_t trunk, const LimbFeatures& features)
{
    const auto below = [&](std::int32_t joint) {
        for (std::uint32_t n = bytes.below(3); n > 0; --n) joint = add(random, joint);
        return add(random, joint);
    };
    std::int32_t above = static_cast<std::int32_t>(bytes.below(trunk + 1)) - 1;
    if (features.features & SWIVEL_WITH_CLAVICLE) above = add(random, above);
    const std::int32_t shoulder = add(random, above), elbow = below(shoulder), wrist = below(elbow);
    if (bytes.one_in(2)) add(random, wrist);  // which no limb needs
    joints.push_back(swivel_default_limb_joints(static_cast<std::uint32_t>(shoulder), static_cast<std::uint32_t>(elbow),
                                                static_cast<std::uint32_t>(wrist)));
    for (float& x : joints.back().bend) x = random.share();
    // At the elbow, all of them: they must not lie one before the other.
    std::vector<std::uint32_t>& bones = twist_bones.emplace_back();
    for (std::uint32_t n = features.twist_bones; n > 0; --n) {
        bones.push_back(static_cast<std::uint32_t>(add(random, elbow)));
        std::fill_n(translations.end() - 3, 3, 0.0f);
    }
    joints.back().twist_bone_count = static_cast<std::uint32_t>(bones.size());
}

// Puts any bits, or the number of a joint or of none, into one of the words.
void BodyDef::spoil_word(Bytes& bytes, std::initializer_list<Words> parts) const
{
    const std::uint32_t any = bytes.one_in(2) ? bytes.take<std::uint32_t>() : bytes.below(joint_count() + 3) - 1;
    std::size_t count = 0;
    for (const Words& part : parts) count += part.count;
    std::size_t n = bytes.below(static_cast<std::uint32_t>(count));
    const Words* part = parts.begin();
    for (; n >= part->count; ++part) n -= part->count;
    std::memcpy(static_cast<char*>(part->begin) + sizeof any * n, &any, sizeof any);
}

void BodyDef::spoil(Bytes& bytes)
{
    const std::size_t g = bytes.below(static_cast<std::uint32_t>(joints.size()));
    swivel_limb_joints& limb = joints[g];
    BodyGroup& group = groups[bytes.below(static_cast<std::uint32_t>(groups.size()))];
    constexpr std::size_t look_words =
        (offsetof(swivel_look_def, reserved) - offsetof(swivel_look_def, joint_count)) / 4;
    switch (bytes.take<std::uint8_t>() % 14) {
        case 0:  // also in a circle
            spoil_word(bytes, {{parents.data(), parents.size()}});
            break;
        case 1:
            spoil_word(bytes, {{translations.data(), translations.size()}});
            break;
        case 2:
            spoil_word(bytes, {{rotations.data(), rotations.size()}});
            break;
        case 3:
            spoil_word(bytes, {{&limb.shoulder, 3}});
            break;
        case 4:  // with the reserved word
            spoil_word(bytes, {{limb.bend, 4}});
            break;
        default:  // how it stands, shifts, lies, links and looks, also of a group that does not
            spoil_word(bytes, {{&group.limb.plant, sizeof(swivel_plant) / 4},
                               {&group.shift.drop, (sizeof group.shift - offsetof(swivel_shift_def, drop)) / 4},
                               {&group.limb.ground, sizeof(swivel_ground) / 4},
                               {&group.prop.joint, (sizeof group.prop - offsetof(swivel_prop_def, joint)) / 4},
                               {&group.limb.link, 1},
                               {&group.look.joint_count, look_words}});
            break;
        case 5:  // the limb of another group
            limb = joints[bytes.below(static_cast<std::uint32_t>(joints.size()))];
            break;
        case 8:
            group.limb.features ^= bytes.one_in(2) ? SWIVEL_WITH_LINK : feature_of_bit(bytes.below(64));
            break;
        case 9:  // of which 1 is right
            group.definition_count = std::min(bytes.below(body_count + 2), 2u);
            break;
        case 10:
            (bytes.one_in(2) ? skeleton.size : limb.size) = bytes.below(sizeof(swivel_limb_joints) + 9);
            break;
        case 11:
            (bytes.one_in(2) ? skeleton.joint_count : skeleton.reserved) = bytes.below(joint_count());
            break;
        case 12:  // also a second shift, and a prop that nobody holds
            groups.push_back({.kind = bytes.one_in(2) ? SWIVEL_KIND_SHIFT : SWIVEL_KIND_PROP});
            break;
        case 13:
            bytes.one_in(2) ? void(up[1] = bytes.any_float()) : void(groups[g].limb.joints = nullptr);
    }
}

swivel_group_def BodyGroup::def() const
{
    swivel_group_def def = swivel_default_group_def();
    if (definition_count == 0) return def;
    if (kind == SWIVEL_KIND_BODY_LIMB) def.body_limb = &limb;
    if (kind == SWIVEL_KIND_LOOK) def.look = &look;
    if (kind == SWIVEL_KIND_PROP) def.prop = &prop;
    if (kind == SWIVEL_KIND_SHIFT || definition_count > 1) def.shift = &shift;
    if (kind == SWIVEL_KIND_SHIFT && definition_count > 1) def.prop = &prop;
    return def;
}

swivel_crowd_def BodyDef::crowd_def(std::uint32_t bodies)
{
    defs.clear();
    for (const BodyGroup& group : groups) defs.push_back(group.def());
    swivel_crowd_def def = swivel_default_crowd_def();
    def.groups = defs.data();
    def.group_count = static_cast<std::uint32_t>(defs.size());
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
    return std::ranges::any_of(groups, [&](const BodyGroup& group) {
        return group.kind == SWIVEL_KIND_PROP && group.prop.joint >= 0 &&
               is_above(joint, static_cast<std::uint32_t>(group.prop.joint));
    });
}

std::vector<std::uint32_t> BodyDef::turned_joints(std::uint32_t group) const
{
    if (groups[group].kind == SWIVEL_KIND_LOOK)
        return {groups[group].look.joints, groups[group].look.joints + groups[group].look.joint_count};
    if (group >= joints.size()) return {};  // shifts and props turn none
    const swivel_limb_joints limb = limb_of(group);
    const swivel_features features = groups[group].limb.features;
    std::vector<std::uint32_t> turned = {limb.shoulder, limb.elbow};
    if (features & SWIVEL_WITH_HAND) turned.push_back(limb.wrist);
    if (features & SWIVEL_WITH_CLAVICLE) turned.push_back(static_cast<std::uint32_t>(parents[limb.shoulder]));
    turned.insert(turned.end(), limb.twist_bones, limb.twist_bones + limb.twist_bone_count);
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
