// SPDX-License-Identifier: MIT
#include "tools/corpus/bodies.h"

#include <algorithm>

#include "tools/corpus/vectors.h"

namespace swivel::corpus {

namespace {

std::array<float, 3> random_offset(Random& random)
{
    const double size = random.between(0.05, 0.3);  // first: compilers order the operands of a product as they like
    return floats(size * random_direction(random));
}

// Numbers joints from the last to the first.
void turn_round(Skeleton& skeleton)
{
    const std::uint32_t last = skeleton.joint_count() - 1;
    std::reverse(skeleton.parents.begin(), skeleton.parents.end());
    std::reverse(skeleton.rotations.begin(), skeleton.rotations.end());
    std::reverse(skeleton.translations.begin(), skeleton.translations.end());
    for (std::int32_t& parent : skeleton.parents)
        if (parent >= 0) parent = static_cast<std::int32_t>(last) - parent;
    for (LimbJoints& limb : skeleton.limbs) {
        for (std::uint32_t* const joint : {&limb.shoulder, &limb.elbow, &limb.wrist}) *joint = last - *joint;
        for (std::uint32_t& joint : limb.twist_bones) joint = last - joint;
    }
}

// Where a joint is: from the root's place, in the world's directions.
struct JointAt {
    Rotation rotation;
    Vector place;
    double scale;
};
std::vector<JointAt> joints_at(const Skeleton& skeleton, const Body& body)
{
    const JointAt root{unit(rotation_of(body.root_rotation)), {0, 0, 0}, body.root_scale};
    std::vector<JointAt> at(skeleton.joint_count());
    for (std::size_t n = at.size(); n-- > 0;) {
        const std::int32_t parent = skeleton.parents[n];
        const JointAt& above = parent < 0 ? root : at[static_cast<std::size_t>(parent)];
        at[n] = {above.rotation * unit(rotation_of(body.rotations[n])),
                 above.place + above.scale * turn(above.rotation, vector_of(body.translations[n])),
                 above.scale * body.scales[n]};
    }
    return at;
}

// Bends an elbow to any side, so that the forearm's slope along the upper arm is of that size: straight or folded where
// that is large.
void bend_elbow(Random& random, int max_power, const Skeleton& skeleton, const LimbJoints& limb, Body& body)
{
    const std::vector<JointAt> at = joints_at(skeleton, body);
    const Vector upper = unit(at[limb.elbow].place - at[limb.shoulder].place),
                 fore = at[limb.wrist].place - at[limb.elbow].place, across = random_across(random, upper);
    const double size = random.spread(-3, max_power), slope = random.below(2) == 0 ? size : -size;
    const Rotation parent = at[static_cast<std::size_t>(skeleton.parents[limb.elbow])].rotation;
    body.rotations[limb.elbow] =
        floats(reverse(parent) * turn_between(fore, across + slope * upper) * at[limb.elbow].rotation);
}

// The numbers that each body draws from.
struct Streams {
    Random rotations, translations, scales, bends, root_positions, root_rotations, root_scales;

    Streams(const Recipe& recipe, std::uint32_t frame)
        : rotations(of(recipe, "joint_rotation", frame)),
          translations(of(recipe, "joint_translation", frame)),
          scales(of(recipe, "joint_scale", frame)),
          bends(of(recipe, "bend", frame)),
          root_positions(of(recipe, "root_position", frame)),
          root_rotations(of(recipe, "root_rotation", frame)),
          root_scales(of(recipe, "root_scale", frame))
    {
    }
    static Random of(const Recipe& recipe, std::string_view name, std::uint32_t frame)
    {
        return stream(recipe.seed, 0, name, Use::value, frame);
    }
};

Body random_body(Streams& streams, const Recipe& recipe, const Skeleton& skeleton, std::uint32_t n)
{
    const bool translates = has_matrices(recipe) || (recipe.pose & kTranslations),
               scales = has_matrices(recipe) || (recipe.pose & kScales);
    Body body;
    for (const std::array<float, 3>& at_rest : skeleton.translations) {
        body.rotations.push_back(floats(random_rotation(streams.rotations, 0.5, 2)));
        body.translations.push_back(translates ? random_offset(streams.translations) : at_rest);
        const bool is_scaled = scales && streams.scales.below(4) == 0;
        body.scales.push_back(is_scaled ? static_cast<float>(streams.scales.between(0.8, 1.25)) : 1);
    }
    if (recipe.pose & kRoots) {
        const double far = recipe.pose & kFar ? 0x1p24 : 4;
        for (double& x : body.root_position) x = far * streams.root_positions.signed_unit();
        body.root_rotation = floats(random_rotation(streams.root_rotations, 0.78, 1.34));
        body.root_scale = static_cast<float>(streams.root_scales.spread(-2, 2));
    }
    for (const LimbJoints& limb : skeleton.limbs)
        bend_elbow(streams.bends, is_spoilt_run(n) ? 26 : 4, skeleton, limb, body);
    return body;
}

}  // namespace

bool has_matrices(const Recipe& recipe) { return recipe.form != SWIVEL_ROTATIONS; }

Body in_body_space(const Skeleton& skeleton, const Body& local)
{
    Body from_root = local, in_body = local;
    from_root.root_rotation = {0, 0, 0, 1}, from_root.root_scale = 1;
    const std::vector<JointAt> at = joints_at(skeleton, from_root);
    for (std::size_t n = 0; n < at.size(); ++n) {
        in_body.rotations[n] = floats(at[n].rotation);
        in_body.translations[n] = floats(at[n].place);
        in_body.scales[n] = static_cast<float>(at[n].scale);
    }
    return in_body;
}

Skeleton skeleton_of(const Recipe& recipe)
{
    Random random = stream(recipe.seed, 0, "skeleton", Use::value, 0);
    Skeleton skeleton;
    const auto add = [&](std::int32_t parent) {
        skeleton.parents.push_back(parent);
        skeleton.rotations.push_back(floats(random_unit_rotation(random)));
        skeleton.translations.push_back(random_offset(random));
        return static_cast<std::int32_t>(skeleton.joint_count() - 1);
    };
    const auto below = [&](std::int32_t joint) {
        if (recipe.pose & kBetween)
            for (std::uint32_t n = random.below(3); n > 0; --n) joint = add(joint);
        return add(joint);
    };
    add(add(add(-1)));  // the trunk
    for (LimbJoints& limb : skeleton.limbs) {
        std::int32_t above = static_cast<std::int32_t>(random.below(4)) - 1;
        if (recipe.features & SWIVEL_WITH_CLAVICLE) above = add(above);
        const std::int32_t shoulder = add(above), elbow = below(shoulder), wrist = below(elbow);
        add(wrist);  // which no limb needs
        limb = {static_cast<std::uint32_t>(shoulder),
                static_cast<std::uint32_t>(elbow),
                static_cast<std::uint32_t>(wrist),
                floats(random_direction(random)),
                {}};
        // All at the elbow, so that they are in any order along the forearm.
        for (std::uint32_t n = 0; n < recipe.twist_bones; ++n) {
            const std::int32_t bone = add(elbow);
            skeleton.translations.back() = {0, 0, 0};
            limb.twist_bones.push_back(static_cast<std::uint32_t>(bone));
        }
    }
    if (recipe.pose & kLooks) add(2);  // an eye, on the trunk
    turn_round(skeleton);
    return skeleton;
}

std::vector<Body> bodies_of(const Recipe& recipe, std::uint32_t body_count, std::uint32_t frame)
{
    const Skeleton skeleton = skeleton_of(recipe);
    Streams streams(recipe, frame);
    std::vector<Body> bodies;
    for (std::uint32_t n = 0; n < body_count; ++n) bodies.push_back(random_body(streams, recipe, skeleton, n));
    return bodies;
}

std::vector<Arm> body_arms(const Recipe& recipe, std::uint32_t group, std::uint32_t body_count, std::uint32_t frame)
{
    Random targets = stream(recipe.seed, group, SWIVEL_TARGET, Use::value, frame),
           poles = stream(recipe.seed, group, SWIVEL_POLE, Use::value, frame),
           hands = stream(recipe.seed, group, SWIVEL_HAND, Use::value, frame);
    const Skeleton skeleton = skeleton_of(recipe);
    const LimbJoints& limb = skeleton.limbs[group];
    std::vector<Arm> arms;
    for (const Body& body : bodies_of(recipe, body_count, frame)) {
        const std::vector<JointAt> at = joints_at(skeleton, body);
        const auto length_of = [&](std::uint32_t from, std::uint32_t to) {
            return static_cast<float>(length(at[to].place - at[from].place));
        };
        // Places are from roots that are far away.
        const auto& [x, y, z] = body.root_position;
        const Vector root = recipe.pose & kFar ? Vector{0, 0, 0} : Vector{x, y, z};
        Arm& arm = arms.emplace_back();
        arm.lengths = {length_of(limb.shoulder, limb.elbow), length_of(limb.elbow, limb.wrist)};
        arm.parent_position = floats(root + at[limb.shoulder].place);
        arm.hand = floats(random_rotation(hands, 0.5, 2));
        set_goals(recipe, targets, poles, arm);
        const std::uint32_t kind = targets.below(8);
        if (kind == 0) {
            arm.target = floats(root + at[limb.wrist].place);
            arm.hand = floats(at[limb.wrist].rotation);
        } else if (kind == 1) {
            arm.pole = arm.target;
        }
    }
    return arms;
}

}  // namespace swivel::corpus
