// SPDX-License-Identifier: MIT
#include "tools/corpus/recipe.h"

#include <array>
#include <cctype>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "tools/corpus/random.h"

namespace swivel::corpus {

namespace {

// Features with what they need, and what that needs, as far as groups of the kind may have it.
swivel_features with_needs(swivel_features features, swivel_kind kind)
{
    swivel_feature_info info;
    swivel_features allowed = 0, before = 0;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
        if (info.kinds >> kind & 1) allowed |= info.feature;
    while (before != features) {
        before = features;
        for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
            if (features & info.feature) features |= info.needs & allowed;
    }
    return features;
}

// "hand-cone" of WITH_HAND_CONE.
std::string short_name(std::string_view feature)
{
    if (feature.starts_with("WITH_")) feature.remove_prefix(5);
    std::string name;
    for (const char c : feature)
        name += c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return name;
}

// Every set of plain arms' features, with results as they are and packed.
std::vector<Recipe> plain_recipes(Part part)
{
    constexpr struct {
        swivel_features feature;
        const char* name;
    } plain[] = {{SWIVEL_WORLD, "world"},
                 {SWIVEL_JOINTS, "joints"},
                 {SWIVEL_WITH_HAND, "hand"},
                 {SWIVEL_POLE_DIRECTION, "direction"}};
    std::vector<Recipe> recipes;
    for (std::uint32_t set = 0; set < 1u << std::size(plain); ++set) {
        Recipe recipe{.part = part, .name = set == 0 ? "arms" : ""};
        for (std::uint32_t n = 0; n < std::size(plain); ++n) {
            if (!(set >> n & 1)) continue;
            recipe.features |= plain[n].feature;
            recipe.name += std::string(recipe.name.empty() ? "" : "-") + plain[n].name;
        }
        if (recipe.features != with_needs(recipe.features, SWIVEL_KIND_LIMB)) continue;
        recipes.push_back(recipe);
        recipe.name += "-packed", recipe.is_packed = true;
        recipes.push_back(recipe);
    }
    return recipes;
}

// Each feature of free limbs alone, with what it needs.
void add_features_alone(std::vector<Recipe>& recipes)
{
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
        if (info.kinds >> SWIVEL_KIND_LIMB & 1)
            recipes.push_back({.part = Part::limbs,
                               .name = short_name(info.name),
                               .features = with_needs(info.feature, SWIVEL_KIND_LIMB)});
}
// Both boxes in the orders that they do not have alone.
void add_orders(std::vector<Recipe>& recipes)
{
    constexpr const char* names[] = {"xyz", "xzy", "yzx", "yxz", "zxy", "zyx"};
    for (std::uint32_t n = 1; n < std::size(names); ++n) {
        const auto order = static_cast<swivel_euler_order>(n);
        recipes.push_back({.part = Part::limbs,
                           .name = std::string("shoulder-box-") + names[n],
                           .features = SWIVEL_WITH_SHOULDER_BOX,
                           .shoulder_order = order});
        recipes.push_back({.part = Part::limbs,
                           .name = std::string("wrist-box-") + names[n],
                           .features = SWIVEL_WITH_HAND | SWIVEL_WITH_WRIST_BOX,
                           .wrist_order = order});
    }
}

// with_needs() completes the features that these are given.
Recipe limb(const char* name, swivel_features features, std::uint32_t twist_bones = 0)
{
    return {.part = Part::limbs,
            .name = name,
            .features = with_needs(features, SWIVEL_KIND_LIMB),
            .twist_bones = twist_bones,
            .shoulder_order = SWIVEL_YXZ,
            .wrist_order = SWIVEL_ZXY};
}
Recipe packed(const char* name, swivel_features features)
{
    Recipe recipe = limb(name, features);
    recipe.is_packed = true;
    return recipe;
}
Recipe body(const char* name, swivel_features features, std::uint32_t pose, swivel_pose_form form = SWIVEL_ROTATIONS,
            std::uint32_t twist_bones = 0)
{
    return {.part = Part::bodies,
            .name = name,
            .features = with_needs(features, SWIVEL_KIND_BODY_LIMB),
            .twist_bones = twist_bones,
            .shoulder_order = SWIVEL_YXZ,
            .wrist_order = SWIVEL_ZXY,
            .form = form,
            .pose = pose};
}
Recipe standing(const char* name, swivel_features features, std::uint32_t pose, Holds holds = Holds::nothing,
                swivel_features holding = 0)
{
    return {.part = Part::standing,
            .name = name,
            .features = with_needs(SWIVEL_WITH_PLANT | features, SWIVEL_KIND_BODY_LIMB),
            .pose = kRoots | pose,
            .holds = holds,
            .holding = with_needs(holding, SWIVEL_KIND_BODY_LIMB)};
}

constexpr swivel_features kAllLimits = SWIVEL_WITH_MAX_SWIVEL | SWIVEL_WITH_FLEXION_LIMIT | SWIVEL_WITH_SHOULDER_CONE |
                                       SWIVEL_WITH_HUMERAL_TWIST | SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_HAND_CONE |
                                       SWIVEL_WITH_FOREARM_TWIST | SWIVEL_WITH_HAND_TWIST | SWIVEL_WITH_WRIST_BOX,
                          kMany = SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_ANGLE | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_REACH |
                                  kAllLimits;

std::vector<Recipe> limb_recipes()
{
    std::vector<Recipe> recipes;
    add_features_alone(recipes);
    add_orders(recipes);
    const Recipe sets[] = {
        limb("incoming-hand", SWIVEL_WITH_INCOMING | SWIVEL_WITH_HAND),
        limb("weights-hand", SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_HAND),
        limb("aim-hand", SWIVEL_WITH_AIM | SWIVEL_WITH_HAND),
        limb("angle-direction", SWIVEL_WITH_ANGLE | SWIVEL_POLE_DIRECTION),
        limb("twist-bones-1", SWIVEL_WITH_HAND, 1),
        limb("twist-bones-3", SWIVEL_WITH_HAND, 3),
        limb("twist-bones-7", SWIVEL_WITH_HAND, 7),
        limb("twist-bones-3-joints", SWIVEL_WITH_HAND | SWIVEL_JOINTS, 3),
        packed("packed-angle", SWIVEL_WITH_ANGLE),
        packed("packed-limits", SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_WITH_ANGLE |
                                    SWIVEL_WITH_FLEXION_LIMIT | SWIVEL_WITH_SHOULDER_CONE),
        limb("set-pole-hand", SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_POLE_HAND | SWIVEL_WITH_EFFECTOR |
                                  SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_MAX_SWIVEL),
        limb("set-pole-half-line", SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_POLE_HALF_LINE | SWIVEL_WITH_ANGLE |
                                       SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_MAX_SWIVEL),
        limb("set-pole-normal",
             SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_POLE_NORMAL | SWIVEL_WITH_ANGLE | SWIVEL_WITH_MAX_SWIVEL),
        limb("set-pole-incoming",
             SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING | SWIVEL_WITH_REACH | SWIVEL_WITH_FLEXION_LIMIT),
        limb("set-both-boxes", SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX),
        limb("set-twists", SWIVEL_WORLD | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_HUMERAL_TWIST | SWIVEL_WITH_HAND_CONE |
                               SWIVEL_WITH_FOREARM_TWIST | SWIVEL_WITH_HAND_TWIST),
        limb("set-region", SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_MAX_SWIVEL |
                               SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST | SWIVEL_WITH_SHOULDER_BOX |
                               SWIVEL_WITH_FOREARM_TWIST | SWIVEL_WITH_WRIST_BOX | SWIVEL_WITH_REGION),
        limb("set-step-wins", SWIVEL_WITH_ANGLE | SWIVEL_STEP_WINS | SWIVEL_WITH_SHOULDER_CONE |
                                  SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX),
        limb("set-aim", SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_MAX_SWIVEL |
                            SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_AIM),
        limb("set-clavicle", SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_CLAVICLE),
        limb("set-all-limits", SWIVEL_JOINTS | SWIVEL_POLE_DIRECTION | kMany),
    };
    recipes.insert(recipes.end(), std::begin(sets), std::end(sets));
    return recipes;
}

std::vector<Recipe> body_recipes()
{
    constexpr std::uint32_t many = kTranslations | kScales | kRoots | kBetween;
    return {
        body("rotations", 0, 0),
        body("rotations-places", 0, kTranslations),
        body("rotations-scales", 0, kScales),
        body("rotations-all", SWIVEL_WITH_HAND, many),
        body("rows", SWIVEL_WITH_HAND, kRoots | kBetween, SWIVEL_MATRIX_ROWS),
        body("columns", SWIVEL_WITH_HAND, kRoots | kBetween, SWIVEL_MATRIX_COLUMNS),
        body("columns3", SWIVEL_WITH_HAND, kRoots | kBetween, SWIVEL_MATRIX_COLUMNS3),
        body("far", SWIVEL_WITH_HAND, kTranslations | kRoots | kFar),
        body("far-pole-incoming", SWIVEL_POLE_INCOMING, kRoots | kFar, SWIVEL_MATRIX_COLUMNS),
        body("offsets-apart", SWIVEL_WITH_HAND, kBetween | kOffsets | kApart),
        body("rows-offsets-apart", SWIVEL_WITH_HAND, kRoots | kOffsets | kApart, SWIVEL_MATRIX_ROWS),
        body("rests", SWIVEL_WITH_HAND, many | kRests),
        body("columns-rests", SWIVEL_WITH_HAND, kRoots | kBetween | kRests, SWIVEL_MATRIX_COLUMNS),
        body("lengths", SWIVEL_WITH_HAND, kScales | kRoots | kBetween | kLengths),
        body("pole-incoming", SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING, kTranslations | kRoots | kBetween),
        body("pole-normal-angle", SWIVEL_POLE_NORMAL | SWIVEL_WITH_ANGLE, kRoots),
        body("pole-direction", SWIVEL_POLE_DIRECTION, kRoots, SWIVEL_MATRIX_ROWS),
        body("pole-hand", SWIVEL_POLE_HAND | SWIVEL_WITH_ANGLE | SWIVEL_WITH_CLAVICLE,
             kTranslations | kRoots | kBetween | kFar),
        body("pole-half-line", SWIVEL_POLE_HALF_LINE | SWIVEL_WITH_CLAVICLE, kTranslations | kRoots | kBetween | kFar),
        body("weights", SWIVEL_WITH_WEIGHTS, kTranslations | kRoots),
        body("weights-hand-pole-incoming", SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS | SWIVEL_POLE_INCOMING,
             kRoots | kBetween, SWIVEL_MATRIX_COLUMNS3),
        body("effector", SWIVEL_WITH_EFFECTOR, kScales | kRoots | kBetween),
        body("reach-step", SWIVEL_WITH_HAND | SWIVEL_WITH_REACH | SWIVEL_WITH_MAX_SWIVEL, many),
        body("aim-step", SWIVEL_WITH_AIM | SWIVEL_WITH_MAX_SWIVEL, kRoots, SWIVEL_MATRIX_COLUMNS),
        body("aim-hand", SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_AIM, kRoots | kBetween),
        body("set-both-boxes", SWIVEL_POLE_INCOMING | SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX, many),
        body("set-all-limits", kMany, many | kFar),
        body("twist-bones-1", SWIVEL_WITH_HAND, kRoots | kBetween, SWIVEL_ROTATIONS, 1),
        body("twist-bones-3", SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS, kRoots, SWIVEL_MATRIX_COLUMNS, 3),
        body("twist-bones-7", SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING, many, SWIVEL_ROTATIONS, 7),
        body("clavicle", SWIVEL_WITH_CLAVICLE, many),
        body("clavicle-hand", SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_CLAVICLE,
             kRoots | kBetween | kRests, SWIVEL_MATRIX_ROWS),
        body("clavicle-aim", SWIVEL_WITH_HAND | SWIVEL_WITH_AIM | SWIVEL_WITH_CLAVICLE, kRoots),
        body("in-body", SWIVEL_WITH_HAND, kTranslations | kScales | kBetween | kInBody),
        body("in-body-apart", SWIVEL_WITH_HAND, many | kOffsets | kApart | kInBody),
        body("in-body-rows", SWIVEL_WITH_HAND | SWIVEL_WITH_CLAVICLE, kRoots | kBetween | kInBody, SWIVEL_MATRIX_ROWS,
             2),
        body("in-body-columns", SWIVEL_POLE_INCOMING, kRoots | kFar | kInBody, SWIVEL_MATRIX_COLUMNS),
        body("in-body-columns3", SWIVEL_WITH_WEIGHTS, kRoots | kApart | kInBody, SWIVEL_MATRIX_COLUMNS3),
        body("all-joints", SWIVEL_WITH_HAND, many | kAllJoints, SWIVEL_ROTATIONS, 3),
        body("in-body-all-joints", SWIVEL_WITH_HAND | SWIVEL_WITH_CLAVICLE, kRoots | kBetween | kInBody | kAllJoints,
             SWIVEL_MATRIX_COLUMNS),
        body("region", SWIVEL_WITH_HAND_CONE | SWIVEL_WITH_REGION, kTranslations | kRoots | kInBody),
        body("record", SWIVEL_WITH_HAND | SWIVEL_WITH_REACH | SWIVEL_WITH_MAX_SWIVEL | SWIVEL_WITH_RECORD, many),
        body("record-aim-clavicle", SWIVEL_WITH_AIM | SWIVEL_WITH_CLAVICLE | SWIVEL_WITH_RECORD, kRoots),
        body("set-everything", kMany | SWIVEL_WITH_CLAVICLE | SWIVEL_WITH_RECORD, many | kFar | kInBody | kAllJoints,
             SWIVEL_ROTATIONS, 3),
    };
}

std::vector<Recipe> standing_recipes()
{
    constexpr swivel_features held = SWIVEL_WITH_LINK | SWIVEL_WITH_EFFECTOR | SWIVEL_POLE_INCOMING;
    return {
        standing("feet",
                 SWIVEL_HAND_YIELDS | SWIVEL_POLE_INCOMING | SWIVEL_WITH_CAP | SWIVEL_WITH_PELVIS_FIT |
                     SWIVEL_WITH_NEXT_TARGET,
                 0),
        standing("feet-by-motion",
                 SWIVEL_POLE_INCOMING | SWIVEL_PLANT_BY_MOTION | SWIVEL_WITH_CAP | SWIVEL_WITH_PELVIS_FIT,
                 kFar | kSupports),
        standing("palms",
                 SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_PLANT_ROTATION | SWIVEL_POLE_INCOMING | SWIVEL_WITH_MAX_SWIVEL |
                     SWIVEL_WITH_WEIGHTS,
                 kTranslations | kSupports | kRests),
        standing("palms-by-motion",
                 SWIVEL_WITH_PLANT_ROTATION | SWIVEL_PLANT_BY_MOTION | SWIVEL_POLE_INCOMING | SWIVEL_WITH_NEXT_TARGET |
                     SWIVEL_WITH_RECORD | SWIVEL_WITH_FLEXION_LIMIT | SWIVEL_WITH_CLAVICLE,
                 kBetween | kFar | kSupports | kAllJoints),
        standing(
            "ground",
            SWIVEL_HAND_YIELDS | SWIVEL_POLE_INCOMING | SWIVEL_WITH_CAP | SWIVEL_WITH_PELVIS_FIT | SWIVEL_WITH_GROUND,
            kSupports),
        standing("ground-by-motion",
                 SWIVEL_WITH_PLANT_ROTATION | SWIVEL_PLANT_BY_MOTION | SWIVEL_POLE_INCOMING | SWIVEL_WITH_NEXT_TARGET |
                     SWIVEL_WITH_GROUND | SWIVEL_WITH_RECORD,
                 kTranslations | kFar | kSupports | kRests),
        standing("held-hand",
                 SWIVEL_POLE_INCOMING | SWIVEL_WITH_GROUND | SWIVEL_WITH_HAND_TRANSFORM | SWIVEL_WITH_CLAVICLE,
                 kBetween | kFar | kSupports | kAllJoints, Holds::hand,
                 held | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_HAND_TRANSFORM | SWIVEL_WITH_RECORD | SWIVEL_WITH_CLAVICLE),
        standing("prop", SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING | SWIVEL_WITH_PELVIS_FIT, kTranslations, Holds::prop,
                 held | SWIVEL_WITH_CAP | SWIVEL_WITH_RECORD),
        standing("looks", SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING | SWIVEL_WITH_PELVIS_FIT,
                 kTranslations | kSupports | kLooks),
        standing("looks-far", SWIVEL_WITH_EFFECTOR | SWIVEL_POLE_INCOMING | SWIVEL_WITH_CLAVICLE,
                 kBetween | kFar | kSupports | kAllJoints | kRests | kLooks),
        standing("looks-in-body", SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING | SWIVEL_WITH_PELVIS_FIT,
                 kTranslations | kInBody | kLooks, Holds::prop, held),
        standing("prop-at-joint", SWIVEL_POLE_INCOMING | SWIVEL_WITH_GROUND | SWIVEL_WITH_PELVIS_FIT,
                 kBetween | kFar | kSupports | kRests, Holds::prop_at_joint,
                 held | SWIVEL_HAND_YIELDS | SWIVEL_WITH_REACH | SWIVEL_WITH_MAX_SWIVEL),
    };
}

std::vector<Recipe> seeded(std::vector<Recipe> recipes)
{
    for (Recipe& recipe : recipes) recipe.seed = hash_of(full_name(recipe));
    return recipes;
}

}  // namespace

const char* name_of(Part part)
{
    constexpr const char* names[] = {"ordinary", "hard", "limbs", "bodies", "standing"};
    return names[static_cast<std::size_t>(part)];
}
std::string full_name(const Recipe& recipe) { return std::string(name_of(recipe.part)) + " " + recipe.name; }

std::span<const Recipe> recipes_of(Part part)
{
    static const std::array<std::vector<Recipe>, std::size(kParts)> parts = {
        seeded(plain_recipes(Part::ordinary)), seeded(plain_recipes(Part::hard)), seeded(limb_recipes()),
        seeded(body_recipes()), seeded(standing_recipes())};
    return parts[static_cast<std::size_t>(part)];
}
const Recipe& recipe_of(Part part, std::string_view name)
{
    for (const Recipe& recipe : recipes_of(part))
        if (recipe.name == name) return recipe;
    throw std::out_of_range("corpus: part " + std::string(name_of(part)) + " has no crowd " + std::string(name));
}

}  // namespace swivel::corpus
