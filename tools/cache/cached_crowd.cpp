// SPDX-License-Identifier: MIT
#include "tools/cache/cached_crowd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr std::pair<Keep, const char*> kKeeps[] = {
    {Keep::goals, "goals"}, {Keep::poses, "poses"}, {Keep::both, "both"}};
constexpr std::uint32_t kLimbsInChunk = 65'536;

// The rotations of a binding, by the names of swivel_binding.
constexpr std::pair<const char*, float (swivel_binding::*)[4]> kBindingRotations[] = {
    {"parent_from_arm", &swivel_binding::parent_from_arm},
    {"upper_from_arm", &swivel_binding::upper_from_arm},
    {"elbow_parent_from_arm", &swivel_binding::elbow_parent_from_arm},
    {"fore_from_arm", &swivel_binding::fore_from_arm},
    {"wrist_parent_from_arm", &swivel_binding::wrist_parent_from_arm},
    {"shoulder_rest", &swivel_binding::shoulder_rest},
    {"elbow_rest", &swivel_binding::elbow_rest},
    {"wrist_rest", &swivel_binding::wrist_rest}};

Json json_of(const swivel_binding& binding)
{
    Json out;
    for (const auto& [name, rotation] : kBindingRotations) out[name] = binding.*rotation;
    out["lengths"] = binding.lengths;
    out["twist_bone_count"] = binding.twist_bone_count;
    out["twist_parent_from_arm"] = binding.twist_parent_from_arm;
    out["twist_from_arm"] = binding.twist_from_arm;
    return out;
}

// A number, or what JSON has in place of one that is not finite.
float number_of(const Json& json)
{
    return json.is_null() ? std::numeric_limits<float>::quiet_NaN() : json.get<float>();
}
template <class Number, std::size_t Count>
void get(const Json& json, Number (&to)[Count])
{
    if (json.size() != Count) throw std::invalid_argument("a list is too short or too long");
    for (std::size_t n = 0; n < Count; ++n)
        if constexpr (std::is_array_v<Number>)
            get(json[n], to[n]);
        else if constexpr (std::is_same_v<Number, float>)
            to[n] = number_of(json[n]);
        else
            json[n].get_to(to[n]);
}

swivel_binding binding_of(const Json& json)
{
    swivel_binding binding{};
    for (const auto& [name, rotation] : kBindingRotations) get(json.at(name), binding.*rotation);
    get(json.at("lengths"), binding.lengths);
    json.at("twist_bone_count").get_to(binding.twist_bone_count);
    get(json.at("twist_parent_from_arm"), binding.twist_parent_from_arm);
    get(json.at("twist_from_arm"), binding.twist_from_arm);
    return binding;
}

Json json_of(const goal_plan& goals)
{
    return {{"target_point", goals.target_point},
            {"target_offset", goals.target_offset},
            {"effector", goals.effector},
            {"pole_fixed", goals.pole_fixed},
            {"has_target_point", goals.has_target_point},
            {"has_pole_fixed", goals.has_pole_fixed},
            {"pole", goals.pole},
            {"hand_is_local", goals.hand_is_local},
            {"is_mirrored", goals.is_mirrored}};
}

goal_plan goals_of(const Json& json)
{
    goal_plan goals{};
    get(json.at("target_point"), goals.target_point);
    get(json.at("target_offset"), goals.target_offset);
    get(json.at("effector"), goals.effector);
    get(json.at("pole_fixed"), goals.pole_fixed);
    json.at("has_target_point").get_to(goals.has_target_point);
    json.at("has_pole_fixed").get_to(goals.has_pole_fixed);
    json.at("pole").get_to(goals.pole);
    json.at("hand_is_local").get_to(goals.hand_is_local);
    json.at("is_mirrored").get_to(goals.is_mirrored);
    return goals;
}

Json json_of(const CachedLimb& limb)
{
    const LimbSetup& setup = limb.setup;
    Json fixed = Json::array();
    for (const FixedField& each : setup.fields) fixed.push_back({{"field", each.field}, {"value", each.value}});
    return {{"name", formats::limb_word(limb.name)},
            {"joints", limb.joints},
            {"features", setup.features},
            {"shoulder_order", setup.shoulder_order},
            {"wrist_order", setup.wrist_order},
            {"priority", setup.priority},
            {"binding", json_of(setup.binding)},
            {"goals", json_of(setup.goals)},
            {"fixed", std::move(fixed)}};
}

CachedLimb limb_of(const Json& json)
{
    CachedLimb limb;
    const auto name = formats::limb_of_word(json.at("name").get<std::string>());
    if (!name) throw std::invalid_argument("a limb has no name that is known");
    limb.name = *name;
    json.at("joints").get_to(limb.joints);
    LimbSetup& setup = limb.setup;
    json.at("features").get_to(setup.features);
    json.at("shoulder_order").get_to(setup.shoulder_order);
    json.at("wrist_order").get_to(setup.wrist_order);
    json.at("priority").get_to(setup.priority);
    setup.binding = binding_of(json.at("binding"));
    setup.goals = goals_of(json.at("goals"));
    for (const Json& each : json.at("fixed"))
        setup.fields.push_back({each.at("field").get<swivel_field>(), each.at("value").get<std::array<float, 12>>()});
    return limb;
}

std::string digest_text(const Json& attributes)
{
    const std::string text = attributes.dump(-1, ' ', false, Json::error_handler_t::replace);
    return fmt::format("{:016x}", digest_of(std::as_bytes(std::span(text))));
}

}  // namespace

bool CachedCrowd::carries_state() const
{
    return budget_blocks > 0 ||
           std::ranges::any_of(limbs, [](const CachedLimb& limb) { return limb.setup.has(SWIVEL_WITH_MOST_SWIVEL); });
}

ChunkShape chunk_shape(std::uint32_t frames, std::uint32_t characters, std::size_t limb_count)
{
    const std::uint64_t blocks = (std::uint64_t{characters} + SWIVEL_LANES - 1) / SWIVEL_LANES;
    const auto most = static_cast<std::uint32_t>(kLimbsInChunk / limb_count);
    const auto of_chunk =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(blocks, most / 4 / SWIVEL_LANES)) * SWIVEL_LANES;
    return {std::clamp(most / of_chunk, 1u, frames), of_chunk};
}

std::size_t ResultField::count() const
{
    std::size_t count = 1;
    for (const std::uint64_t part : parts) count *= part;
    return count;
}

std::vector<ResultField> result_fields(const CachedCrowd& crowd)
{
    swivel_features features = 0;
    unsigned twist_bones = 0;
    for (const CachedLimb& limb : crowd.limbs) {
        features |= limb.setup.features;
        twist_bones = std::max(twist_bones, limb.setup.twist_bone_count());
    }
    const auto has = [&](swivel_features feature) { return (features & feature) != 0; };
    std::vector<ResultField> fields{
        {SWIVEL_SHOULDER, "shoulder", "local rotation of the shoulder joint, x y z w", {4}, {"xyzw"}},
        {SWIVEL_ELBOW, "elbow", "local rotation of the elbow joint, x y z w", {4}, {"xyzw"}}};
    if (has(SWIVEL_WITH_HAND))
        fields.push_back({SWIVEL_WRIST, "wrist", "local rotation of the wrist joint, x y z w", {4}, {"xyzw"}});
    fields.push_back({SWIVEL_FLAGS, "flags", "bits of swivel_flag", {}, {}});
    if (has(SWIVEL_WITH_REACH)) fields.push_back({SWIVEL_STRETCH, "stretch", "factor of both bone lengths", {}, {}});
    if (has(SWIVEL_WITH_MOST_SWIVEL))
        fields.push_back({SWIVEL_NORMAL, "normal", "unit normal of the swivel plane, arm frame", {3}, {"xyz"}});
    if (twist_bones > 0)
        fields.push_back({SWIVEL_TWIST_BONES,
                          "twist_bones",
                          "rotations of the twist bones, x y z w",
                          {twist_bones, 4},
                          {"twist_bone", "xyzw"}});
    if (has(SWIVEL_WITH_CLAVICLE))
        fields.push_back(
            {SWIVEL_CLAVICLE_TURN, "clavicle_turn", "turn of the shoulder's parent joint, x y z w", {4}, {"xyzw"}});
    return fields;
}

Json attributes_of(const CachedCrowd& crowd)
{
    Json joints = Json::array(), limbs = Json::array();
    for (const CachedJoint& joint : crowd.joints) joints.push_back({{"name", joint.name}, {"parent", joint.parent}});
    for (const CachedLimb& limb : crowd.limbs) limbs.push_back(json_of(limb));
    const auto keep = std::ranges::find(kKeeps, crowd.keep, &std::pair<Keep, const char*>::first);
    Json out{{"swivel_cache", kFormat},
             {"keep", keep->second},
             {"closed", crowd.is_closed},
             {"compressed", crowd.is_compressed},
             {"frames", crowd.frame_count},
             {"characters", crowd.character_count},
             {"chunk_frames", crowd.chunk.frames},
             {"chunk_characters", crowd.chunk.characters},
             {"budget_blocks", crowd.budget_blocks},
             {"has_given", crowd.has_given},
             {"title", crowd.title},
             {"clip", crowd.clip},
             {"clip_frames", crowd.clip_frame_count()},
             {"frame_seconds", crowd.frame_seconds},
             {"joints", std::move(joints)},
             {"limbs", std::move(limbs)}};
    out["digest"] = digest_text(out);
    return out;
}

CachedCrowd crowd_of_attributes(const Json& attributes, const std::filesystem::path& path,
                                std::uint32_t* clip_frame_count)
{
    const auto refuse = [&](const std::string& why) { throw formats::InputError(path, why); };
    if (!attributes.contains("swivel_cache")) refuse("describes no cache of swivel; swivel store makes one");
    if (attributes["swivel_cache"] != kFormat)
        refuse(fmt::format("the cache has format {}, this swivel reads format {}; use the swivel that made it",
                           attributes["swivel_cache"].dump(), kFormat));
    Json without = attributes;
    without.erase("digest");
    if (attributes.value("digest", Json()) != digest_text(without))
        refuse("was changed: its digest is another; take it from a copy, or make the cache anew");
    CachedCrowd crowd;
    try {
        for (const auto& [keep, word] : kKeeps)
            if (attributes.at("keep") == word) crowd.keep = keep;
        attributes.at("closed").get_to(crowd.is_closed);
        attributes.at("compressed").get_to(crowd.is_compressed);
        attributes.at("frames").get_to(crowd.frame_count);
        attributes.at("characters").get_to(crowd.character_count);
        attributes.at("chunk_frames").get_to(crowd.chunk.frames);
        attributes.at("chunk_characters").get_to(crowd.chunk.characters);
        attributes.at("budget_blocks").get_to(crowd.budget_blocks);
        attributes.at("has_given").get_to(crowd.has_given);
        attributes.at("title").get_to(crowd.title);
        attributes.at("clip").get_to(crowd.clip);
        attributes.at("clip_frames").get_to(*clip_frame_count);
        attributes.at("frame_seconds").get_to(crowd.frame_seconds);
        for (const Json& joint : attributes.at("joints"))
            crowd.joints.push_back({joint.at("name").get<std::string>(), joint.at("parent").get<int>()});
        for (const Json& limb : attributes.at("limbs")) crowd.limbs.push_back(limb_of(limb));
    } catch (const std::exception& error) {  // the digest holds, so another program wrote it
        refuse(fmt::format("cannot be understood: {}; make the cache anew by swivel store", error.what()));
    }
    return crowd;
}

}  // namespace swivel::tools
