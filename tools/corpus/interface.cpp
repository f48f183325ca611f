// SPDX-License-Identifier: MIT
#include "tools/corpus/interface.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "swivel/swivel_regions.h"
#include "tools/corpus/bodies.h"

namespace swivel::corpus {

namespace {

std::vector<swivel_field> fields_of(const Crowd& crowd, std::uint32_t group, bool are_inputs)
{
    std::vector<swivel_field> fields;
    swivel_field_info info;
    for (std::uint32_t n = 0; swivel_describe_field(n, &info); ++n)
        if ((info.kind == SWIVEL_FIELD_INPUT) == are_inputs &&
            swivel_field_row_count(crowd.get(), group, info.field) > 0)
            fields.push_back(info.field);
    return fields;
}

// The 16-bit words of a field, limb by limb.
std::vector<std::uint32_t> packed_field(const Crowd& crowd, swivel_field field, std::uint32_t group)
{
    const auto next = static_cast<swivel_field>(field + 1);
    const std::uint32_t limbs = swivel_group_limb_count(crowd.get(), group),
                        first = swivel_packed_row(crowd.get(), group, field),
                        end = swivel_packed_row(crowd.get(), group, next),
                        rows = swivel_packed_row(crowd.get(), group, SWIVEL_RESULT_END);
    const std::vector<std::uint16_t> packed = crowd.pack(group);
    std::vector<std::uint32_t> words;
    for (std::size_t limb = 0; limb < limbs; ++limb)
        for (std::uint32_t row = first; row < end; ++row)
            words.push_back(packed[(limb / 16 * rows + row) * 16 + limb % 16]);
    return words;
}

// The bindings of the corpus's skeletons, one for each group, written out as numbers, so that a change in making
// bindings changes no bit.
struct Quaternion {
    float x, y, z, w;
};
struct Binding {
    Quaternion parent_from_arm, upper_from_arm, fore_from_arm, shoulder_rest, elbow_rest, wrist_rest;
};
constexpr Binding kBindings[kGroupCount] = {
    {
        {0.1f, 0.7f, 0.7f, 0.1f},
        {0.5f, 0.5f, 0.5f, 0.5f},
        {0.7f, 0.1f, 0.7f, 0.1f},
        {0.0f, 0.0f, 0.6f, 0.8f},
        {0.28f, 0.0f, 0.0f, 0.96f},
        {-0.8f, 0.0f, 0.0f, 0.6f},
    },
    {
        {-0.82f, 0.46f, 0.34f, 0.02f},
        {0.5f, -0.5f, -0.5f, 0.5f},
        {0.34f, -0.82f, -0.02f, 0.46f},
        {0.36f, -0.48f, 0.0f, 0.8f},
        {0.0f, 0.0f, 0.352f, 0.936f},
        {0.0f, 0.28f, 0.0f, 0.96f},
    },
    {
        {0x1.524aap-2f, -0x1.4ed5dcp-3f, -0x1.739d5cp-2f, 0x1.b62e38p-1f},
        {0x1.07cac8p-1f, -0x1.10bc72p-1f, -0x1.110066p-1f, 0x1.a1d14ep-2f},
        {0x1.d1836cp-2f, -0x1.84d942p-2f, -0x1.3c97f2p-1f, 0x1.087448p-1f},
        {-0.2f, 0.4f, 0.4f, 0.8f},
        {0.0f, 0.28f, 0.0f, 0.96f},
        {0.1f, -0.5f, 0.5f, 0.7f},
    },
};

void copy(const Quaternion& q, float (&to)[4]) { to[0] = q.x, to[1] = q.y, to[2] = q.z, to[3] = q.w; }

swivel_binding library_binding(const Binding& own)
{
    swivel_binding binding = swivel_default_binding();
    copy(own.parent_from_arm, binding.parent_from_arm);
    copy(own.upper_from_arm, binding.upper_from_arm);
    copy(own.upper_from_arm, binding.elbow_parent_from_arm);
    copy(own.fore_from_arm, binding.fore_from_arm);
    copy(own.fore_from_arm, binding.wrist_parent_from_arm);
    for (auto& frame : binding.twist_parent_from_arm) copy(own.fore_from_arm, frame);
    for (auto& frame : binding.twist_from_arm) copy(own.fore_from_arm, frame);
    copy(own.shoulder_rest, binding.shoulder_rest);
    copy(own.elbow_rest, binding.elbow_rest);
    copy(own.wrist_rest, binding.wrist_rest);
    std::fill(std::begin(binding.lengths), std::end(binding.lengths),
              std::numeric_limits<float>::quiet_NaN());  // written
    return binding;
}

template <class Value>
swivel_in in(const std::vector<Value>& values)
{
    return {values.data(), sizeof values[0]};
}

// How limbs stand, group by group, and how bodies shift and look. Constants that are not named here are the defaults,
// as all of the first group's plant are.
swivel_plant plant_of(std::uint32_t group)
{
    swivel_plant plant = swivel_default_plant();
    if (group == 1) {
        plant.lock_radius = 0.3f, plant.unlock_radius = 0.5f;
        plant.stop_time = 0.05f, plant.release_time = 0.3f;
        plant.relock_speed = 0.5f, plant.anchor_lead = 1, plant.reset_time = 1;
        plant.speed[0] = 1, plant.speed[1] = 1.5f;
        plant.height[0] = 0.5f, plant.height[1] = 1;
    } else if (group == 2) {
        plant.lock_radius = 0.02f, plant.unlock_radius = 0.05f;
        plant.stop_time = plant.release_time = 0;
        plant.relock_speed = 0, plant.anchor_lead = 0, plant.reset_time = 0.5f;
        plant.speed[0] = 2, plant.speed[1] = 4;
        plant.height[0] = plant.height[1] = 10;
    }
    return plant;
}
swivel_ground ground_of(std::uint32_t group)
{
    constexpr float heels[kGroupCount][3] = {{0.03f, -0.06f, 0.05f}, {0, 0, 0}, {-0.1f, 0.02f, 0}};
    swivel_ground ground = swivel_default_ground();
    std::copy_n(heels[group], 3, ground.heel);
    if (group == 0) ground.toe_clearance = 0.01f, ground.heel_clearance = 0.02f;
    if (group == 1) ground.cos_max = 0.95f, ground.half_life = 0.2f;
    if (group == 2) ground.toe_clearance = 0.05f, ground.cos_max = 0.3f, ground.half_life = 0;
    return ground;
}
swivel_shift_def shift_of_bodies()
{
    swivel_shift_def shift = swivel_default_shift_def();
    shift.drop = 0.3f, shift.rise = 0.2f, shift.half_life = 0.15f;
    return shift;
}
// joint: of the trunk, or -1, which is none.
swivel_prop_def prop_at(std::int32_t joint)
{
    swivel_prop_def prop = swivel_default_prop_def();
    prop.joint = joint;
    if (joint >= 0) prop.max_move = 0.1f;
    return prop;
}
swivel_look_def trunk_look(std::uint32_t spine, std::uint32_t chest)
{
    swivel_look_def look = swivel_default_look_def();
    look.joint_count = 2;
    look.joints[0] = spine, look.joints[1] = chest;
    look.share[0] = 0.5f, look.share[1] = 2;
    look.cos_max[0] = 0.9f, look.cos_max[1] = 0.3f;
    look.eye[0] = 0.02f, look.eye[1] = 0.1f, look.eye[2] = -0.05f;
    look.axis[0] = 0.6f, look.axis[1] = 0, look.axis[2] = 0.8f;
    look.cos_full = 0.5f, look.cos_none = -0.8f;
    look.fade_distance = 0.4f, look.rate = 2;
    return look;
}
swivel_look_def eye_look(std::uint32_t joint)
{
    swivel_look_def look = swivel_default_look_def();
    look.joint_count = 1;
    look.joints[0] = joint;
    look.cos_max[0] = 0.2f;
    look.axis[1] = 1, look.axis[2] = 0;
    look.cos_full = -0.5f, look.cos_none = -1;
    look.fade_distance = look.rate = 0;
    return look;
}

// Regions of upper arms: a forbidden cone, two cones, three half-spaces, and half of the sphere.
constexpr swivel_region kUpperArms = {sizeof(swivel_region),
                                      1,
                                      3,
                                      {1, 2, 3, 6},
                                      {{{0.28f, 0, -0.96f}, -0.9f, 1},
                                       {{0.6f, 0, 0.8f}, 0.5f, 1},
                                       {{-0.48f, 0.6f, 0.64f}, 0.4f, 1},
                                       {{0, 0.6f, -0.8f}, 0.3f, 1},
                                       {{1, 0, 0}, -0.2f, 1},
                                       {{0, -0.8f, -0.6f}, -0.6f, 1}}};

using TakeDefinition = std::function<void(const swivel_crowd_def&)>;

// Puts what limbs of both kinds have.
template <class Limb>
void put_limb(const Recipe& recipe, std::uint32_t group, Limb& limb)
{
    limb.features = features_of(recipe, group);
    limb.shoulder_order = recipe.shoulder_order;
    limb.wrist_order = recipe.wrist_order;
    if (limb.features & SWIVEL_WITH_REGION) limb.region = &kUpperArms;
}

void define_free_limbs(const Recipe& recipe, const LimbCounts& limb_counts, const TakeDefinition& take)
{
    swivel_limb_def limbs[kGroupCount];
    swivel_group_def groups[kGroupCount];
    for (std::uint32_t g = 0; g < kGroupCount; ++g) {
        limbs[g] = swivel_default_limb_def(limb_counts[g]);
        put_limb(recipe, g, limbs[g]);
        limbs[g].twist_bone_count = recipe.twist_bones;
        limbs[g].binding = library_binding(kBindings[g]);
        groups[g] = swivel_default_group_def();
        groups[g].limb = &limbs[g];
    }
    swivel_crowd_def def = swivel_default_crowd_def();
    def.groups = groups;
    def.group_count = kGroupCount;
    take(def);
}

void define_bodies(const Recipe& recipe, std::uint32_t body_count, const TakeDefinition& take)
{
    const Skeleton own = skeleton_of(recipe);
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = in(own.parents);
    skeleton.rotations = in(own.rotations);
    skeleton.translations = in(own.translations);
    skeleton.joint_count = own.joint_count();
    swivel_limb_joints joints[kGroupCount];
    swivel_body_limb_def limbs[kGroupCount];
    std::array<swivel_group_def, kGroupCount + 2 + kLookCount> groups;
    groups.fill(swivel_default_group_def());
    std::uint32_t count = kGroupCount;
    for (std::uint32_t g = 0; g < kGroupCount; ++g) {
        const LimbJoints& limb = own.limbs[g];
        joints[g] = swivel_default_limb_joints(limb.shoulder, limb.elbow, limb.wrist);
        std::copy(limb.bend.begin(), limb.bend.end(), joints[g].bend);
        joints[g].twist_bones = limb.twist_bones.data();
        joints[g].twist_bone_count = recipe.twist_bones;
        limbs[g] = swivel_default_body_limb_def(&joints[g]);
        put_limb(recipe, g, limbs[g]);
        limbs[g].on_bad_input = recipe.pose & kRests ? SWIVEL_REST_POSE : SWIVEL_KEEP_POSE;
        limbs[g].plant = plant_of(g);
        limbs[g].ground = ground_of(g);
        if (is_holding(recipe, g)) limbs[g].link = has_prop(recipe) ? prop_group(recipe) : 0;
        groups[g].body_limb = &limbs[g];
    }
    const swivel_shift_def shift = shift_of_bodies();
    if (has_shift(recipe)) groups[count++].shift = &shift;
    // The trunk's joints come last, from its root on. The first joint is the eye.
    const std::uint32_t spine = own.joint_count() - 2, chest = own.joint_count() - 3;
    const swivel_prop_def prop = prop_at(recipe.holds == Holds::prop_at_joint ? static_cast<std::int32_t>(spine) : -1);
    if (has_prop(recipe)) groups[count++].prop = &prop;
    const swivel_look_def looks[kLookCount] = {trunk_look(spine, chest), eye_look(0)};
    if (recipe.pose & kLooks)
        for (const swivel_look_def& look : looks) groups[count++].look = &look;
    swivel_crowd_def def = swivel_default_crowd_def();
    def.skeleton = &skeleton;
    def.body_count = body_count;
    def.groups = groups.data();
    def.group_count = count;
    def.up[0] = 1, def.up[1] = 3, def.up[2] = -2;
    take(def);
}

// Values of bodies; none where they are empty.
template <class Value>
swivel_in body_values(const Poses& poses, const std::vector<Value>& values)
{
    return {values.empty() ? nullptr : values.data(), values.size() / poses.body_count * sizeof(Value)};
}
swivel_joint_values joint_values(const Poses& poses, std::vector<float>& values,
                                 const std::vector<std::size_t>& offsets)
{
    if (values.empty()) return {};
    const std::size_t each = values.size() / poses.body_count * sizeof(float);
    return {values.data(), each, each / poses.joint_count, offsets.empty() ? nullptr : offsets.data()};
}
swivel_pose library_pose(Poses& poses)
{
    swivel_pose pose = swivel_default_pose();
    pose.form = poses.form;
    pose.rotations = joint_values(poses, poses.rotations, poses.offsets);
    pose.translations = joint_values(poses, poses.translations, {});
    pose.scales = joint_values(poses, poses.scales, {});
    pose.results = joint_values(poses, poses.results, poses.offsets);
    pose.space = poses.is_in_body ? SWIVEL_IN_BODY : SWIVEL_LOCAL;
    pose.translation_results = joint_values(poses, poses.translation_results, {});
    pose.joint_rotations = joint_values(poses, poses.joint_rotations, {});
    pose.joint_positions = joint_values(poses, poses.joint_positions, {});
    pose.root_is_double = !poses.far_roots.empty();
    pose.root_position =
        pose.root_is_double ? body_values(poses, poses.far_roots) : body_values(poses, poses.root_positions);
    pose.root_rotation = body_values(poses, poses.root_rotations);
    pose.root_scale = body_values(poses, poses.root_scales);
    pose.time = body_values(poses, poses.times);
    pose.support_position =
        pose.root_is_double ? body_values(poses, poses.far_supports) : body_values(poses, poses.support_positions);
    pose.support_rotation = body_values(poses, poses.support_rotations);
    return pose;
}

}  // namespace

void with_definition(const Recipe& recipe, const LimbCounts& limb_counts, const TakeDefinition& take)
{
    if (is_of_bodies(recipe.part))
        define_bodies(recipe, limb_counts[0], take);
    else
        define_free_limbs(recipe, limb_counts, take);
}

Crowd create_crowd(const Recipe& recipe, const LimbCounts& limb_counts)
{
    std::optional<Crowd> crowd;
    with_definition(recipe, limb_counts, [&](const swivel_crowd_def& def) { crowd.emplace(def); });
    return std::move(*crowd);
}

std::vector<swivel_field> inputs_of(const Crowd& crowd, std::uint32_t group) { return fields_of(crowd, group, true); }
std::vector<swivel_field> results_of(const Crowd& crowd, std::uint32_t group) { return fields_of(crowd, group, false); }

LimbCounts limb_counts(const Crowd& crowd)
{
    LimbCounts counts;
    for (std::uint32_t group = 0; group < counts.size(); ++group)
        counts[group] = swivel_group_limb_count(crowd.get(), group);
    return counts;
}

void write_field(Crowd& crowd, swivel_field field, std::uint32_t group, std::span<const float> values)
{
    const std::uint32_t count = swivel_group_limb_count(crowd.get(), group);
    check(swivel_write(crowd.get(), field, group, 0, count, {values.data(), values.size() / count * sizeof(float)}));
}

std::vector<std::uint32_t> read_field(const Crowd& crowd, const Recipe& recipe, swivel_field field, std::uint32_t group)
{
    if (recipe.is_packed && field > SWIVEL_INPUT_END) return packed_field(crowd, field, group);
    const std::uint32_t limbs = swivel_group_limb_count(crowd.get(), group),
                        count = swivel_field_row_count(crowd.get(), group, field);
    std::vector<std::uint32_t> words(std::size_t{limbs} * count);
    check(swivel_read(crowd.get(), field, group, 0, limbs, {words.data(), count * sizeof(std::uint32_t)}));
    return words;
}

void reset_limb(Crowd& crowd, std::uint32_t group, std::uint32_t limb)
{
    check(swivel_reset(crowd.get(), group, limb, 1));
}
void change_support(Crowd& crowd, std::uint32_t group, std::uint32_t body, const Support& from, const Support& to)
{
    const auto view = [](const Support& s) { return swivel_supports{{&s.position, 0}, {&s.rotation, 0}}; };
    check(swivel_change_support(crowd.get(), group, body, 1, view(from), view(to)));
}
void with_job(Poses& poses, const std::function<void(const Job&)>& take)
{
    if (poses.body_count == 0) return take({});
    const swivel_pose pose = library_pose(poses);
    Job job{.pose = &pose};
    if (!poses.mask.empty()) job.mask = poses.mask;
    std::array<swivel::Streams, kGroupCount + 2 + kLookCount> frames;
    const auto give = [&](std::size_t group, swivel_field field, const std::vector<double>& values) {
        if (!values.empty()) frames[group].in(field, body_values(poses, values));
    };
    for (std::size_t g = 0; g < kGroupCount; ++g) {
        give(g, SWIVEL_TARGET, poses.far_targets[g]);
        give(g, SWIVEL_POLE, poses.far_poles[g]);
        give(g, SWIVEL_NEXT_TARGET, poses.far_next_targets[g]);
        give(g, SWIVEL_GROUND, poses.far_grounds[g]);
    }
    give(poses.prop_group, SWIVEL_PROP_POSITION, poses.far_props);
    for (std::uint32_t n = 0; n < kLookCount; ++n)
        give(poses.look_group + n, SWIVEL_LOOK_TARGET, poses.far_look_targets[n]);
    if (pose.root_is_double) job.streams.assign(frames.begin(), frames.begin() + poses.group_count);
    take(job);
}

}  // namespace swivel::corpus
