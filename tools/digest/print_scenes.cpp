// SPDX-License-Identifier: MIT
//
// Writes crowds of the corpus to a file, as scenes that the tests of other languages play: every argument by its name,
// and the digests that each frame must have. They are small, and have what the corpus lacks: regions made by calls, and
// weights. JSON: floats are the shortest decimals that give them back, null is NaN, and 1e999 is infinity.
//   print_scenes FILE
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tools/corpus/corpus.h"

namespace swivel::corpus {

namespace {

constexpr std::uint32_t kBodies = 2, kStandingBodies = 6, kFreeLimbs = 2, kFrames = 2;
// Standing bodies change little from frame to frame, so scenes have every ninth.
constexpr std::uint32_t kStandingFramesShown = 8, kStandingStep = 9;

template <class Number>
std::string text(Number x)
{
    if constexpr (std::is_floating_point_v<Number>) {
        if (std::isnan(x)) return "null";
        if (std::isinf(x)) return x < 0 ? "-1e999" : "1e999";
        if (x == 0 && std::signbit(x)) return "-0.0";
    }
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}
std::string quoted(const std::string& word) { return '"' + word + '"'; }
std::string hex(std::uint64_t number)
{
    char digits[16];
    return quoted({digits, std::to_chars(digits, digits + sizeof digits, number, 16).ptr});
}
std::string list(const std::vector<std::string>& items)
{
    std::string all = "[";
    for (const std::string& item : items) all += (all.size() > 1 ? "," : "") + item;
    return all + "]";
}
template <class Numbers>
std::string numbers(const Numbers& values)
{
    std::vector<std::string> items;
    for (const auto& x : values) items.push_back(text(x));
    return list(items);
}
template <class Arrays>
std::string flat(const Arrays& arrays)
{
    std::vector<std::string> items;
    for (const auto& array : arrays)
        for (const auto& x : array) items.push_back(text(x));
    return list(items);
}

struct Object {
    std::string members;
    void add(const char* name, const std::string& value)
    {
        members += (members.empty() ? "\"" : ",\"") + std::string(name) + "\":" + value;
    }
    template <class Values>
    void add_filled(const char* name, const Values& values)
    {
        if (!values.empty()) add(name, numbers(values));
    }
    std::string text() const { return "{" + members + "}"; }
};
std::string object(std::initializer_list<std::pair<const char*, std::string>> members)
{
    Object made;
    for (const auto& [name, value] : members) made.add(name, value);
    return made.text();
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
    region.add_cones(kCones, true).add_polygon(kCorners).add_directions(kWays, kMargin, 2).forbid(kForbidden);
    return region.mirrored();
}
std::string region_text(const Region& region)
{
    std::vector<std::string> axes, angles, rooms;
    for (const auto& [axis, angle] : kCones) axes.push_back(numbers(axis)), angles.push_back(text(angle));
    for (const auto& probe : kProbes) rooms.push_back(text(region.room(probe)));
    return object({{"axes", list(axes)},
                   {"angles", list(angles)},
                   {"corners", flat(kCorners)},
                   {"directions", flat(kWays)},
                   {"margin", text(kMargin)},
                   {"most_cones", "2"},
                   {"forbidden", object({{"axis", numbers(kForbidden.axis)}, {"angle", text(kForbidden.angle)}})},
                   {"probes", flat(kProbes)},
                   {"rooms", list(rooms)}});
}

std::string features_text(swivel_features features)
{
    std::vector<std::string> names;
    swivel_feature_info info;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
        if (info.feature != SWIVEL_WITH_TWIST_BONES && (features & info.feature)) names.push_back(quoted(info.name));
    return list(names);
}

std::string plant_text(const swivel_plant& plant)
{
    return object({{"lock", text(plant.lock)},
                   {"unlock", text(plant.unlock)},
                   {"stop", text(plant.stop)},
                   {"blend", text(plant.blend)},
                   {"again", text(plant.again)},
                   {"run", text(plant.run)},
                   {"longest", text(plant.longest)},
                   {"speed", numbers(plant.speed)},
                   {"height", numbers(plant.height)}});
}
std::string ground_text(const swivel_ground& ground)
{
    return object({{"heel", numbers(ground.heel)},
                   {"toe_clearance", text(ground.toe_clearance)},
                   {"heel_clearance", text(ground.heel_clearance)},
                   {"cos_most", text(ground.cos_most)},
                   {"half", text(ground.half)}});
}
std::string look_text(const swivel_look& look)
{
    const std::size_t count = look.joint_count;
    return object({{"joints", numbers(std::span(look.joints).first(count))},
                   {"share", numbers(std::span(look.share).first(count))},
                   {"cos_most", numbers(std::span(look.cos_most).first(count))},
                   {"eye", numbers(look.eye)},
                   {"axis", numbers(look.axis)},
                   {"cos_full", text(look.cos_full)},
                   {"cos_none", text(look.cos_none)},
                   {"fade_distance", text(look.fade_distance)},
                   {"rate", text(look.rate)}});
}
std::string joints_text(const swivel_limb_joints& joints)
{
    return object({{"shoulder", text(joints.shoulder)},
                   {"elbow", text(joints.elbow)},
                   {"wrist", text(joints.wrist)},
                   {"bend", numbers(joints.bend)},
                   {"twist_bones", numbers(std::span(joints.twist_bones, joints.twist_bone_count))}});
}

// Constants of features that a group lacks are left out, as they count for nothing.
std::string group_text(const swivel_group_def& group, const Region& region)
{
    const swivel_features features = group.features;
    Object made;
    made.add("on_bad_input", text(static_cast<int>(group.on_bad_input)));
    if (features & SWIVEL_FIT) {
        const auto& [drop, rise, half, ahead] = group.fit;
        made.add("fit",
                 object({{"drop", text(drop)}, {"rise", text(rise)}, {"half", text(half)}, {"ahead", text(ahead)}}));
    } else if (features & SWIVEL_PROP) {
        made.add("prop", object({{"joint", text(group.prop.joint)}, {"most_move", text(group.prop.most_move)}}));
    } else if (features & SWIVEL_LOOK) {
        made.add("look", look_text(group.look));
    } else {
        made.add("features", features_text(features));
        made.add("shoulder_order", text(static_cast<int>(group.shoulder_order)));
        made.add("wrist_order", text(static_cast<int>(group.wrist_order)));
        if (group.joints)
            made.add("joints", joints_text(*group.joints));
        else
            made.add("limb_count", text(group.limb_count)),
                made.add("twist_bones", text(features / SWIVEL_WITH_TWIST_BONES & SWIVEL_MOST_TWIST_BONES));
        if (features & SWIVEL_WITH_PLANT) made.add("plant", plant_text(group.plant));
        if (features & SWIVEL_WITH_GROUND) made.add("ground", ground_text(group.ground));
        if (features & SWIVEL_WITH_LINK) made.add("link", text(group.link));
        if (features & SWIVEL_WITH_REGION) made.add("region", region_text(region));
    }
    return made.text();
}

template <class Value>
std::vector<Value> streamed(const swivel_in& in, std::uint32_t joint_count, std::size_t components)
{
    const auto* const values = static_cast<const Value*>(in.data);
    return {values, values + joint_count * components};
}
std::string skeleton_text(const swivel_skeleton& skeleton)
{
    return object({{"parents", numbers(streamed<std::int32_t>(skeleton.parents, skeleton.joint_count, 1))},
                   {"translations", numbers(streamed<float>(skeleton.translations, skeleton.joint_count, 3))},
                   {"rotations", numbers(streamed<float>(skeleton.rotations, skeleton.joint_count, 4))}});
}

// Four digits of each number are enough, except of places far away.
template <class Value>
void shorten(std::vector<Value>& values)
{
    char digits[32];
    for (Value& x : values) {
        std::snprintf(digits, sizeof digits, "%.*g", std::is_same_v<Value, double> ? 12 : 4, double{x});
        if (std::isfinite(x)) x = static_cast<Value>(std::strtod(digits, nullptr));
    }
}
void shorten(Poses& poses)
{
    for (std::vector<float>* const values :
         {&poses.rotations, &poses.translations, &poses.scales, &poses.root_positions, &poses.root_rotations,
          &poses.root_scales, &poses.times, &poses.support_positions, &poses.support_rotations})
        shorten(*values);
    for (std::vector<double>* const values : {&poses.far_roots, &poses.far_supports}) shorten(*values);
}

// Takes a crowd's inputs to another, and lists those that changed: of each group a field's values by its name.
class Inputs {
public:
    std::string bring(const Crowd& from, Crowd& to)
    {
        std::vector<std::string> groups;
        before_.resize(swivel_group_count(from.get()));
        for (std::uint32_t group = 0; group < before_.size(); ++group) groups.push_back(bring(group, from, to));
        return list(groups);
    }

private:
    std::string bring(std::uint32_t group, const Crowd& from, Crowd& to)
    {
        Object made;
        const std::uint32_t count = swivel_group_limb_count(from.get(), group);
        swivel_field_info info;
        for (std::uint32_t n = 0; swivel_describe_field(n, &info); ++n) {
            const std::uint32_t each = swivel_component_count(info.field, swivel_group_features(from.get(), group));
            if (info.kind != SWIVEL_FIELD_INPUT || each == 0) continue;
            std::vector<float> values(std::size_t{count} * each);
            check(swivel_read(from.get(), info.field, group, 0, count, {values.data(), each * sizeof(float)}));
            for (float& x : values)
                if (std::isnan(x)) x = std::numeric_limits<float>::quiet_NaN();  // without its sign, which JSON lacks
            const std::string shown = numbers(values);
            std::vector<std::string>& before = before_[group];
            if (before.size() <= n) before.resize(n + 1);
            if (shown == before[n]) continue;
            before[n] = shown;
            made.add(info.name, shown);
            check(swivel_write(to.get(), info.field, group, 0, count, {values.data(), each * sizeof(float)}));
        }
        return made.text();
    }

    std::vector<std::vector<std::string>> before_;
};

// What poses are given, and the names of those that they are asked for.
std::string pose_text(const Poses& poses, const std::vector<float>& weights)
{
    Object made;
    made.add_filled("rotations", poses.rotations);
    made.add_filled("translations", poses.translations);
    made.add_filled("scales", poses.scales);
    made.add_filled("root_position", poses.root_positions);
    made.add_filled("root_position", poses.far_roots);
    made.add_filled("root_rotation", poses.root_rotations);
    made.add_filled("root_scale", poses.root_scales);
    made.add_filled("time", poses.times);
    made.add_filled("support_position", poses.support_positions);
    made.add_filled("support_position", poses.far_supports);
    made.add_filled("support_rotation", poses.support_rotations);
    made.add_filled("weight", weights);
    return made.text();
}
std::string outputs_text(const Poses& poses)
{
    std::vector<std::string> names;
    if (!poses.results.empty()) names.push_back("\"results\"");
    if (!poses.translation_results.empty()) names.push_back("\"translation_results\"");
    if (!poses.joint_rotations.empty()) names.insert(names.end(), {"\"joint_rotations\"", "\"joint_places\""});
    return list(names);
}

// Positions in double, of each group.
std::string doubles_text(const Job& job, std::uint32_t group_count, std::uint32_t body_count)
{
    std::vector<std::string> groups;
    const std::span<const swivel_frame> frames = *job.frames;
    for (std::uint32_t group = 0; group < group_count; ++group) {
        Object made;
        for (std::uint32_t n = 0; group < frames.size() && n < frames[group].field_count; ++n) {
            const auto& [field, data, stride] = frames[group].fields[n];
            if (!data) continue;  // not listed
            swivel_field_info info;
            for (std::uint32_t k = 0; swivel_describe_field(k, &info) && info.field != field; ++k) {
            }
            made.add(info.name, numbers(streamed<double>({data, stride}, body_count, 3)));
        }
        groups.push_back(made.text());
    }
    return list(groups);
}

// FNV-1a of words, 32 bits at a time, in all of which NaN is one and the same.
std::string digest_text(const Poses& poses)
{
    std::uint32_t hash = 0x811c9dc5u;
    for (const std::vector<float>* const values : poses.solved())
        for (const float x : *values) {
            const std::uint32_t word = std::isnan(x) ? 0x7fc00000u : std::bit_cast<std::uint32_t>(x);
            hash = (hash ^ word) * 0x01000193u;
        }
    return hex(hash);
}

std::uint32_t count_of(const Recipe& recipe)
{
    return !is_of_bodies(recipe.part) ? kFreeLimbs : recipe.part == Part::standing ? kStandingBodies : kBodies;
}

// What calls beside solves answer about all limbs of a group, and in words about the first.
std::string answers_text(const Crowd& crowd, std::uint32_t group, const swivel_group_def& of)
{
    const std::uint32_t count = of.limb_count;
    std::vector<std::array<double, 3>> places(count);
    std::vector<std::array<double, 4>> hands(count);
    std::vector<std::array<double, 7>> angles(count);
    std::vector<double> off(count);
    Object made;
    crowd.elbows(group, places), made.add("elbows", flat(places));
    crowd.wrists(group, places), made.add("wrists", flat(places));
    if (of.features & SWIVEL_WITH_HAND) crowd.hands(group, hands), made.add("hands", flat(hands));
    crowd.residuals(group, off), made.add("residuals", numbers(off));
    crowd.joint_angles(group, of.wrist_order, of.shoulder_order, 1, angles), made.add("joint_angles", flat(angles));
    std::vector<float> ends;
    for (const swivel_arc& arc : crowd.allowed_arcs(group, 0)) {
        float four[4];
        static_assert(sizeof four == sizeof arc);
        std::memcpy(four, &arc, sizeof four);
        ends.insert(ends.end(), std::begin(four), std::end(four));
    }
    made.add("allowed_arcs", numbers(ends));
    std::string said = crowd.explain(group, 0);
    made.add("explain", quoted(said));
    return made.text();
}

std::string carried_text(const Standing::Carried& carried)
{
    const auto support = [](const Support& of) {
        return object({{"position", numbers(of.position)}, {"rotation", numbers(of.rotation)}});
    };
    Object made;
    made.add("group", text(carried.group)), made.add("body", text(carried.body));
    if (carried.supports) {
        made.add("was", support((*carried.supports)[0]));
        made.add("now", support((*carried.supports)[1]));
    }
    return made.text();
}
void carry(Crowd& crowd, const Standing::Carried& carried)
{
    if (carried.supports)
        change_support(crowd, carried.group, carried.body, (*carried.supports)[0], (*carried.supports)[1]);
    else
        reset_limb(crowd, carried.group, carried.body);
}

// One crowd: what it is made of, and what it is given and must give in each frame.
class Scene {
public:
    Scene(const Recipe& recipe, std::uint32_t number) : recipe_(recipe), corpus_(make_crowd(recipe, count_of(recipe)))
    {
        if (number % 3 == 1 && is_of_bodies(recipe.part)) weights_.assign(count_of(recipe), 0.75f), weights_[0] = 1;
        if (recipe.part == Part::standing) standing_.emplace(recipe_, count_of(recipe));
        with_definition(recipe, limb_counts(corpus_),
                        [&](const void* def) { create(*static_cast<const swivel_crowd_def*>(def)); });
        const std::vector<float> halves(count_of(recipe), 0.5f);
        for (std::uint32_t group = 0; group < groups_.size(); ++group)
            if (groups_[group].features & SWIVEL_PROP) corpus_.write(SWIVEL_PROP_WEIGHT, group, halves);
    }
    std::string text()
    {
        std::vector<std::string> frames;
        const std::uint32_t count = standing_ ? kStandingFramesShown : kFrames;
        for (std::uint32_t n = 0; n < count; ++n) frames.push_back(frame(n));
        made_.add("frames", list(frames));
        std::vector<std::string> answers;
        for (std::uint32_t group = 0; !is_of_bodies(recipe_.part) && group < groups_.size(); ++group)
            answers.push_back(answers_text(*crowd_, group, groups_[group]));
        made_.add("answers", list(answers));
        return made_.text();
    }

private:
    void create(swivel_crowd_def def)
    {
        groups_.assign(def.groups, def.groups + def.group_count);
        for (swivel_group_def& group : groups_) {
            if (group.features & SWIVEL_WITH_REGION) group.region = &region_.get();
            group.fit.ahead = 0.4375f;  // not as by default
        }
        def.groups = groups_.data();
        crowd_.emplace(def);
        made_.add("name", quoted(full_name(recipe_)));
        std::vector<std::string> groups;
        for (const swivel_group_def& group : groups_) groups.push_back(group_text(group, region_));
        made_.add("groups", list(groups));
        if (!def.skeleton) return;
        made_.add("skeleton", skeleton_text(*def.skeleton));
        made_.add("body_count", swivel::corpus::text(def.body_count));
        made_.add("up", numbers(def.up));
    }

    // Of this frame, in the corpus's crowd: goals, poses, and what is carried.
    Poses& go_to(std::uint32_t n, Object& made)
    {
        if (!standing_) {
            if (n > 0) write_goals(corpus_, recipe_, n);
            return poses_ = poses_of(corpus_, recipe_, n);
        }
        std::vector<std::string> all;
        standing_->go_to(n * kStandingStep, corpus_);
        for (const Standing::Carried& carried : standing_->carried()) {
            all.push_back(carried_text(carried));
            carry(*crowd_, carried);
        }
        made.add("carried", list(all));
        return standing_->poses();
    }

    std::string frame(std::uint32_t n)
    {
        Object made;
        Poses& poses = go_to(n, made);
        shorten(poses);
        poses.offsets.clear();  // languages take joints in their order alone
        for (std::vector<float>* const results :
             {&poses.results, &poses.translation_results, &poses.joint_rotations, &poses.joint_places})
            std::fill(results->begin(), results->end(), 0.0f);  // bodies that are not solved keep it
        made.add("inputs", inputs_.bring(corpus_, *crowd_));
        with_job(poses, [&](const Job& given) {
            Job job = given;
            std::optional<swivel_pose> pose;
            if (job.pose) {
                pose = *job.pose, job.pose = &*pose;
                if (n == 0) describe(*pose, poses);
                if (!weights_.empty()) pose->weight = {weights_.data(), sizeof(float)};
                made.add("pose", pose_text(poses, weights_));
            }
            if (job.frames) made.add("doubles", doubles_text(job, swivel_group_count(crowd_->get()), poses.body_count));
            if (!poses.mask.empty()) made.add("mask", swivel::corpus::text(poses.mask[0]));
            made.add("solved", swivel::corpus::text(crowd_->solve(job)));
        });
        made.add("digest", hex(crowd_->digest()));
        made.add("poses", digest_text(poses));
        return made.text();
    }
    void describe(const swivel_pose& pose, const Poses& poses)
    {
        made_.add("form", swivel::corpus::text(static_cast<int>(pose.form)));
        made_.add("space", swivel::corpus::text(static_cast<int>(pose.space)));
        made_.add("root_is_double", swivel::corpus::text(pose.root_is_double));
        made_.add("outputs", outputs_text(poses));
    }

    const Recipe& recipe_;
    Crowd corpus_;  // takes the inputs, and solves nothing
    const Region region_ = region_of_calls();
    std::vector<swivel_group_def> groups_;
    std::optional<Crowd> crowd_;
    std::optional<Standing> standing_;
    std::vector<float> weights_;
    Poses poses_;
    Inputs inputs_;
    Object made_;
};

std::string scenes_text()
{
    std::vector<std::string> scenes;
    for (const Part part : {Part::limbs, Part::bodies, Part::standing})
        for (const Recipe& recipe : recipes_of(part))
            if (is_of_bodies(part) || !(recipe.features & kJoints))  // languages make bindings from skeletons alone
                scenes.push_back(Scene(recipe, static_cast<std::uint32_t>(scenes.size())).text());
    return list(scenes) + "\n";
}

}  // namespace

}  // namespace swivel::corpus

int main(int argc, char** argv)
{
    try {
        if (argc != 2) throw std::runtime_error("give a file to write");
        std::ofstream file(argv[1]);
        file << swivel::corpus::scenes_text();
        if (!file.flush()) throw std::runtime_error(std::string("cannot write ") + argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "print_scenes: %s\n", error.what());
        return 1;
    }
}
