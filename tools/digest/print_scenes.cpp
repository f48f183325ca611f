// SPDX-License-Identifier: MIT
//
// Writes crowds of the corpus to a file, as scenes that the tests of other languages play: every argument by its name,
// and the digests that each frame must have. They are small, and have what the corpus lacks: regions made by calls, and
// weights. JSON: null is NaN. JSON has no infinity, so the largest number takes its place.
//   print_scenes FILE
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "swivel/swivel_explain.hpp"
#include "swivel/swivel_regions.hpp"
#include "tools/corpus/corpus.h"

// Structures of C are objects of their members. Twist bones, whose number is another member, are added below.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(swivel_limb_joints, shoulder, elbow, wrist, bend)

namespace swivel::corpus {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Support, position, rotation)

namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kBodies = 2, kStandingBodies = 10, kFreeLimbs = 2, kFrames = 2;
// Standing bodies change little from frame to frame, so scenes have every ninth.
constexpr std::uint32_t kStandingFramesShown = 8, kStandingStep = 9;

std::string hex(std::uint64_t number) { return fmt::format("{:x}", number); }

template <class Arrays>
Json flat(const Arrays& arrays)
{
    Json all = Json::array();
    for (const auto& array : arrays)
        for (const auto& x : array) all.push_back(x);
    return all;
}
template <class Value>
std::vector<Value> copied(const void* data, std::size_t count)
{
    return {static_cast<const Value*>(data), static_cast<const Value*>(data) + count};
}

Json names_of(swivel_features features)
{
    Json names = Json::array();
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
        if (features & info.feature) names.push_back(info.name);
    return names;
}

// The constants of a structure, as the library describes them. joint_count: of a look.
template <class Structure>
Json constants_of(std::string_view structure, const Structure& values, std::size_t joint_count = 0)
{
    Json made;
    swivel_constant_info info;
    for (std::uint32_t n = 0; swivel_describe_constant(n, &info); ++n) {
        if (structure != info.structure) continue;
        const std::byte* const first = reinterpret_cast<const std::byte*>(&values) + info.offset;
        const std::vector<float> all =
            copied<float>(first, info.count == SWIVEL_MAX_LOOK_JOINTS ? joint_count : info.count);
        made[info.name] = info.count == 1 ? Json(all[0]) : Json(all);
    }
    return made;
}

// Numbers that JSON has.
template <class Value>
void make_writable(std::vector<Value>& values)
{
    for (Value& x : values) {
        if (std::isnan(x)) x = std::numeric_limits<Value>::quiet_NaN();  // without its sign
        if (std::isinf(x)) x = std::copysign(std::numeric_limits<Value>::max(), x);
    }
}
void make_writable(Poses& poses)
{
    for (std::vector<float>* const values :
         {&poses.rotations, &poses.translations, &poses.scales, &poses.root_positions, &poses.root_rotations,
          &poses.root_scales, &poses.times, &poses.support_positions, &poses.support_rotations})
        make_writable(*values);
    for (std::vector<double>* const values : {&poses.far_roots, &poses.far_supports}) make_writable(*values);
}

// One of every call that makes a region. The half-spaces of the corpus's own are for C alone.
constexpr swivel_region_cone kCones[] = {{{0.25f, 0.5f, 1}, 0.75f}, {{-0.5f, 0.25f, 0.5f}, 0.5f}, {{0, -1, 1}, 0.25f}};
constexpr std::array<float, 3> kCorners[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                               kWays[] = {{-1, 0, -0.5f}, {-1, 0.25f, 0}, {-0.75f, 0.5f, 0}, {-1, 1, 0.5f}},
                               kProbes[] = {{1, 2, 3}, {-1, 0.5f, 0}, {0, 0, -2}};
constexpr swivel_region_cone kForbidden = {{0.125f, 0.5f, 1}, 0.125f};
constexpr float kMargin = 0.125f;
Region region_of_calls()
{
    Region region;
    region.add_cones({std::begin(kCones), std::end(kCones)}, true);
    region.add_polygon(kCorners).add_directions(kWays, kMargin, 2).forbid(kForbidden);
    return region.mirrored();
}
Json json_of(const Region& region)
{
    Json made{{"corners", flat(kCorners)}, {"directions", flat(kWays)}, {"margin", kMargin}, {"max_cones", 2}};
    for (const auto& [axis, angle] : kCones) made["axes"].push_back(axis), made["angles"].push_back(angle);
    made["forbidden"] = {{"axis", kForbidden.axis}, {"angle", kForbidden.angle}};
    made["probes"] = flat(kProbes);
    for (const auto& probe : kProbes) made["rooms"].push_back(region.room(probe));
    return made;
}

Definition definition_of(const swivel_group_def& group)
{
    if (group.limb) return *group.limb;
    if (group.body_limb) return *group.body_limb;
    if (group.look) return *group.look;
    if (group.prop) return *group.prop;
    return *group.shift;
}

// Members of limbs of both kinds.
template <class Limb>
Json json_of_limb(const Limb& limb, const Region& region)
{
    Json made{{"on_bad_input", limb.on_bad_input},
              {"features", names_of(limb.features)},
              {"shoulder_order", limb.shoulder_order},
              {"wrist_order", limb.wrist_order}};
    if (limb.features & SWIVEL_WITH_REGION) made["region"] = json_of(region);
    return made;
}
// A group of a scene. Constants of features that it lacks are left out, as they count for nothing.
struct GroupWriter {
    const Region& region;

    Json operator()(const swivel_limb_def& limb) const
    {
        Json made = json_of_limb(limb, region);
        made["limb_count"] = limb.limb_count, made["twist_bone_count"] = limb.twist_bone_count;
        return made;
    }
    Json operator()(const swivel_body_limb_def& limb) const
    {
        Json made = json_of_limb(limb, region);
        made["joints"] = *limb.joints;
        made["joints"]["twist_bones"] = copied<std::uint32_t>(limb.joints->twist_bones, limb.joints->twist_bone_count);
        if (limb.features & SWIVEL_WITH_PLANT) made["plant"] = constants_of("plant", limb.plant);
        if (limb.features & SWIVEL_WITH_GROUND) made["ground"] = constants_of("ground", limb.ground);
        if (limb.features & SWIVEL_WITH_LINK) made["link"] = limb.link;
        return made;
    }
    Json operator()(const swivel_look_def& look) const
    {
        Json made = constants_of("look", look, look.joint_count);
        made["joints"] = copied<std::uint32_t>(look.joints, look.joint_count);
        return {{"look", made}};
    }
    Json operator()(const swivel_prop_def& prop) const
    {
        Json made = constants_of("prop", prop);
        made["joint"] = prop.joint;
        return {{"prop", made}};
    }
    Json operator()(const swivel_shift_def& shift) const { return {{"shift", constants_of("shift", shift)}}; }
};
Json json_of(const swivel_skeleton& skeleton)
{
    const std::size_t count = skeleton.joint_count;
    return {{"parents", copied<std::int32_t>(skeleton.parents.data, count)},
            {"translations", copied<float>(skeleton.translations.data, 3 * count)},
            {"rotations", copied<float>(skeleton.rotations.data, 4 * count)}};
}

// The arrays that poses are given.
Json json_of(const Poses& poses, const std::vector<float>& weights)
{
    Json made;
    const auto add = [&](const char* name, const auto& values) {
        if (!values.empty()) made[name] = values;
    };
    add("rotations", poses.rotations), add("translations", poses.translations), add("scales", poses.scales);
    add("root_position", poses.root_positions), add("root_position", poses.far_roots);
    add("root_rotation", poses.root_rotations), add("root_scale", poses.root_scales), add("time", poses.times);
    add("support_position", poses.support_positions), add("support_position", poses.far_supports);
    add("support_rotation", poses.support_rotations), add("weight", weights);
    return made;
}
// The names of those parts that poses are asked for.
Json outputs_of(const Poses& poses)
{
    Json names = Json::array();
    if (!poses.results.empty()) names.push_back("results");
    if (!poses.translation_results.empty()) names.push_back("translation_results");
    if (!poses.joint_rotations.empty()) names.insert(names.end(), {"joint_rotations", "joint_positions"});
    return names;
}
// FNV-1a of words, 32 bits at a time, in all of which NaN is one and the same.
std::uint32_t digest_of(const Poses& poses)
{
    std::uint32_t hash = 0x811c9dc5u;
    for (const std::vector<float>* const values : poses.solved())
        for (const float x : *values) {
            const std::uint32_t word = std::isnan(x) ? 0x7fc00000u : std::bit_cast<std::uint32_t>(x);
            hash = (hash ^ word) * 0x01000193u;
        }
    return hash;
}

// One crowd: what it is made of, and what it is given and must give in each frame.
class Scene {
public:
    Scene(const Recipe& recipe, std::uint32_t number)
        : recipe_(recipe),
          count_(!is_of_bodies(recipe.part)      ? kFreeLimbs
                 : recipe.part == Part::standing ? kStandingBodies
                                                 : kBodies),
          corpus_(make_crowd(recipe, count_))
    {
        if (number % 3 == 1 && is_of_bodies(recipe.part)) weights_.assign(count_, 0.75f), weights_[0] = 1;
        if (recipe.part == Part::standing) standing_.emplace(recipe_, count_);
        with_definition(recipe, limb_counts(corpus_), [&](const swivel_crowd_def& def) { create(def); });
        for (std::uint32_t group = 0; group < groups_.size(); ++group)
            if (std::holds_alternative<swivel_prop_def>(groups_[group]))
                corpus_.write(SWIVEL_PROP_WEIGHT, group, std::vector<float>(count_, 0.5f));
    }
    Json json()
    {
        const std::uint32_t frame_count = standing_ ? kStandingFramesShown : kFrames;
        for (std::uint32_t n = 0; n < frame_count; ++n) made_["frames"].push_back(frame(n));
        made_["answers"] = Json::array();
        for (std::uint32_t group = 0; !is_of_bodies(recipe_.part) && group < groups_.size(); ++group)
            made_["answers"].push_back(answers(group));
        return made_;
    }

private:
    // The group as scenes have it, which languages must be able to give.
    Definition shown(Definition group) const
    {
        const auto give_region = [&](auto& limb) {
            if (limb.features & SWIVEL_WITH_REGION) limb.region = &region_.get();
        };
        if (auto* const limb = std::get_if<swivel_limb_def>(&group)) give_region(*limb);
        if (auto* const limb = std::get_if<swivel_body_limb_def>(&group)) give_region(*limb);
        if (auto* const shift = std::get_if<swivel_shift_def>(&group)) shift->lookahead = 0.4375f;  // not as by default
        return group;
    }
    void create(const swivel_crowd_def& def)
    {
        made_["name"] = full_name(recipe_);
        for (const swivel_group_def& group : std::span(def.groups, def.group_count)) {
            groups_.push_back(shown(definition_of(group)));
            made_["groups"].push_back(std::visit(GroupWriter{region_}, groups_.back()));
        }
        if (!def.skeleton) {
            crowd_.emplace(groups_);
            return;
        }
        crowd_.emplace(*def.skeleton, def.body_count, groups_, std::to_array(def.up));
        made_["skeleton"] = json_of(*def.skeleton);
        made_["body_count"] = def.body_count, made_["up"] = def.up;
    }

    // Brings the corpus's crowd to this frame: goals, poses, and what is carried.
    Poses& go_to(std::uint32_t n, Json& made)
    {
        if (!standing_) {
            if (n > 0) write_goals(corpus_, recipe_, n);
            return poses_ = poses_of(corpus_, recipe_, n);
        }
        standing_->go_to(n * kStandingStep, corpus_);
        made["carried"] = Json::array();
        for (const auto& [group, body, supports] : standing_->carried()) {
            Json carried{{"group", group}, {"body", body}};
            if (supports) {
                const auto& [was, now] = *supports;
                carried["was"] = was, carried["now"] = now;
                change_support(*crowd_, group, body, was, now);
            } else {
                reset_limb(*crowd_, group, body);
            }
            made["carried"].push_back(carried);
        }
        return standing_->poses();
    }

    Json frame(std::uint32_t n)
    {
        Json made;
        Poses& poses = go_to(n, made);
        make_writable(poses);
        poses.offsets.clear();  // languages take joints in their order alone
        for (std::vector<float>* const results :
             {&poses.results, &poses.translation_results, &poses.joint_rotations, &poses.joint_positions})
            std::fill(results->begin(), results->end(), 0.0f);  // bodies that are not solved keep it
        for (std::uint32_t group = 0; group < groups_.size(); ++group) made["inputs"].push_back(bring(group));
        with_job(poses, [&](Job job) {
            std::optional<swivel_pose> pose;
            if (job.pose) {
                pose = *job.pose, job.pose = &*pose;
                if (!weights_.empty()) pose->weight = {weights_.data(), sizeof(float)};
                made["pose"] = json_of(poses, weights_);
                made_["form"] = pose->form, made_["space"] = pose->space, made_["outputs"] = outputs_of(poses);
                made_["root_is_double"] = pose->root_is_double;
            }
            if (!job.streams.empty()) made["doubles"] = doubles(job.streams);
            if (!poses.mask.empty()) made["mask"] = poses.mask[0];
            made["solved"] = crowd_->solve(job);
        });
        made["digest"] = hex(crowd_->digest()), made["poses"] = hex(digest_of(poses));
        return made;
    }

    // Takes a group's inputs to the crowd that is solved. Those that changed, by the names of their fields.
    Json bring(std::uint32_t group)
    {
        Json made = Json::object();
        const std::uint32_t count = swivel_group_limb_count(corpus_.get(), group);
        swivel_field_info info;
        for (std::uint32_t n = 0; swivel_describe_field(n, &info); ++n) {
            const std::uint32_t each = swivel_field_row_count(corpus_.get(), group, info.field);
            if (info.kind != SWIVEL_FIELD_INPUT || each == 0) continue;
            std::vector<float> values(std::size_t{count} * each);
            check(swivel_read(corpus_.get(), info.field, group, 0, count, {values.data(), each * sizeof(float)}));
            make_writable(values);
            const Json shown = values;
            std::string& before = before_[{group, n}];
            if (shown.dump() == before) continue;
            before = shown.dump();
            made[info.name] = shown;
            check(swivel_write(crowd_->get(), info.field, group, 0, count, {values.data(), each * sizeof(float)}));
        }
        return made;
    }

    // Positions in double, of each group.
    Json doubles(std::span<const swivel_streams> frames) const
    {
        Json groups = Json::array();
        for (std::uint32_t group = 0; group < groups_.size(); ++group) {
            groups.push_back(Json::object());
            for (std::uint32_t n = 0; group < frames.size() && n < frames[group].field_count; ++n) {
                const auto& [field, data, stride] = frames[group].fields[n];
                if (data) groups.back()[describe(field).name] = copied<double>(data, 3 * count_);
            }
        }
        return groups;
    }

    // The answers of calls beside solves about all free limbs of a group, and in words about the first.
    Json answers(std::uint32_t group) const
    {
        const auto& def = std::get<swivel_limb_def>(groups_[group]);
        std::vector<std::array<double, 3>> elbows(def.limb_count), wrists(def.limb_count);
        std::vector<std::array<double, 4>> hands(def.limb_count);
        std::vector<std::array<double, 7>> angles(def.limb_count);
        std::vector<double> off(def.limb_count);
        crowd_->elbows(group, elbows), crowd_->wrists(group, wrists), crowd_->residuals(group, off);
        crowd_->joint_angles(group, def.wrist_order, def.shoulder_order, 1, angles);
        Json made{{"elbows", flat(elbows)}, {"wrists", flat(wrists)}, {"residuals", off}};
        made["joint_angles"] = flat(angles), made["explain"] = explain(*crowd_, group, 0);
        if (def.features & SWIVEL_WITH_HAND) crowd_->hands(group, hands), made["hands"] = flat(hands);
        made["allowed_arcs"] = Json::array();
        for (const auto& [from, to] : crowd_->allowed_arcs(group, 0))
            made["allowed_arcs"].insert(made["allowed_arcs"].end(), {from[0], from[1], to[0], to[1]});
        return made;
    }

    const Recipe& recipe_;
    const std::uint32_t count_;
    Crowd corpus_;  // takes the inputs, and solves nothing
    const Region region_ = region_of_calls();
    std::vector<Definition> groups_;
    std::optional<Crowd> crowd_;
    std::optional<Standing> standing_;
    std::vector<float> weights_;
    Poses poses_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string>
        before_;  // inputs of the frame before, by group and field
    Json made_;
};

Json scenes()
{
    Json made;
    for (const Part part : {Part::limbs, Part::bodies, Part::standing})
        for (const Recipe& recipe : recipes_of(part))
            // Languages make bindings from skeletons alone.
            if (is_of_bodies(part) || !(recipe.features & SWIVEL_JOINTS))
                made.push_back(Scene(recipe, static_cast<std::uint32_t>(made.size())).json());
    return made;
}

}  // namespace

}  // namespace swivel::corpus

int main(int argc, char** argv)
{
    try {
        if (argc != 2) throw std::runtime_error("give a file to write");
        std::ofstream file(argv[1]);
        file << swivel::corpus::scenes() << '\n';
        if (!file.flush()) throw std::runtime_error(std::string("cannot write ") + argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "print_scenes: %s\n", error.what());
        return 1;
    }
}
