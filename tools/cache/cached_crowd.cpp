// SPDX-License-Identifier: MIT
#include "tools/cache/cached_crowd.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr std::pair<Keep, const char*> kKeeps[] = {
    {Keep::goals, "goals"}, {Keep::poses, "poses"}, {Keep::both, "both"}};
constexpr std::uint32_t kLimbsInChunk = 65'536;
constexpr std::uint32_t kMost = 0x7fffffff;  // frames, characters
constexpr std::size_t kMostLimbs = 4;        // of a character: formats::LimbName has no more

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

// A number within its range.
std::uint32_t whole(const Json& json, const char* name, std::uint32_t least, std::uint32_t most)
{
    const Json& value = json.at(name);
    const bool is_whole =
        value.is_number_unsigned() && value.get<std::uint64_t>() >= least && value.get<std::uint64_t>() <= most;
    if (!is_whole)
        throw std::invalid_argument(
            fmt::format("{} is {}, not a number from {} to {}", name, value.dump(), least, most));
    return value.get<std::uint32_t>();
}

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
    goals.pole = static_cast<decltype(goals.pole)>(whole(json, "pole", 0, 2));
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

Keep keep_of(const Json& json)
{
    for (const auto& [keep, word] : kKeeps)
        if (json == word) return keep;
    throw std::invalid_argument("keep is none of goals, poses and both");
}

// What the rest of the program relies on, beside the ranges of numbers.
void require_sane(const CachedCrowd& crowd)
{
    if (crowd.limbs.empty() || crowd.limbs.size() > kMostLimbs)
        throw std::invalid_argument("there are no limbs, or too many");
    const auto joint_count = static_cast<int>(crowd.joints.size());
    for (int n = 0; n < joint_count; ++n)
        if (const int parent = crowd.joints[static_cast<std::size_t>(n)].parent; parent < -1 || parent >= n)
            throw std::invalid_argument("a joint comes before its parent");
    const auto is_joint = [&](int joint) { return joint >= 0 && joint < joint_count; };
    for (const CachedLimb& limb : crowd.limbs)
        if (limb.joints.size() != 3 || !std::ranges::all_of(limb.joints, is_joint))
            throw std::invalid_argument("a limb's joints are not three of the joints");
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
             {"goals_digest", fmt::format("{:016x}", crowd.goals_digest)},
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
        crowd.keep = keep_of(attributes.at("keep"));
        attributes.at("closed").get_to(crowd.is_closed);
        attributes.at("compressed").get_to(crowd.is_compressed);
        crowd.frame_count = whole(attributes, "frames", 1, kMost);
        crowd.character_count = whole(attributes, "characters", 1, kMost);
        crowd.chunk.frames = whole(attributes, "chunk_frames", 1, kMostFramesInChunk);
        crowd.chunk.characters = whole(attributes, "chunk_characters", SWIVEL_LANES, kMostCharactersInChunk);
        if (crowd.chunk.characters % SWIVEL_LANES != 0)
            throw std::invalid_argument("chunk_characters is no multiple of 16");
        crowd.budget_blocks = whole(attributes, "budget_blocks", 0, kMost);
        attributes.at("has_given").get_to(crowd.has_given);
        attributes.at("title").get_to(crowd.title);
        attributes.at("clip").get_to(crowd.clip);
        *clip_frame_count = whole(attributes, "clip_frames", 1, crowd.frame_count);
        attributes.at("frame_seconds").get_to(crowd.frame_seconds);
        crowd.goals_digest = std::stoull(attributes.at("goals_digest").get<std::string>(), nullptr, 16);
        for (const Json& joint : attributes.at("joints"))
            crowd.joints.push_back({joint.at("name").get<std::string>(), joint.at("parent").get<int>()});
        for (const Json& limb : attributes.at("limbs")) crowd.limbs.push_back(limb_of(limb));
        require_sane(crowd);
    } catch (const std::exception& error) {  // the digest holds, so another program wrote it
        refuse(fmt::format("cannot be understood: {}; make the cache anew by swivel store", error.what()));
    }
    return crowd;
}

}  // namespace swivel::tools
