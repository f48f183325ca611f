// SPDX-License-Identifier: MIT
#include "tools/cache/cache_attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "tools/cache/digest.h"
#include "tools/crowd/goal_crowd.h"
#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 11;
constexpr std::uint32_t kMax = 0x7fffffff;      // frames, characters
constexpr std::uint32_t kMaxLimbs = 4;          // of a character: formats::LimbName has no more
constexpr double kMaxLength = 1e15;             // as swivel.h has it
constexpr std::uint32_t kMaxHeights = 16'384;   // along a side: formats::read_height_picture() has no more
constexpr std::int64_t kMaxJoints = 1'000'000;  // more than the attributes have room for

// A member of a structure by its name in JSON. Whole numbers are within a range.
template <class Struct, class Value>
struct Member {
    const char* name;
    Value Struct::*at;
    std::uint32_t min = 0, max = 1;
};
// clang 14 deduces the arguments of no aggregate by itself.
template <class Struct, class Value>
Member(const char*, Value Struct::*, std::uint32_t = 0, std::uint32_t = 1) -> Member<Struct, Value>;
constexpr std::tuple kRest{Member{"shoulder_rotation", &formats::LimbRest::shoulder_rotation},
                           Member{"elbow_rotation", &formats::LimbRest::elbow_rotation},
                           Member{"wrist_rotation", &formats::LimbRest::wrist_rotation},
                           Member{"elbow_offset", &formats::LimbRest::elbow_offset},
                           Member{"wrist_offset", &formats::LimbRest::wrist_offset},
                           Member{"bend", &formats::LimbRest::bend}};
constexpr std::tuple kGoals{Member{"target_point", &goal_plan::target_point},
                            Member{"target_offset", &goal_plan::target_offset},
                            Member{"effector", &goal_plan::effector},
                            Member{"pole_fixed", &goal_plan::pole_fixed},
                            Member{"shoulder_place", &goal_plan::shoulder_place},
                            Member{"bones", &goal_plan::bones},
                            Member{"weights", &goal_plan::weights},
                            Member{"has_target_point", &goal_plan::has_target_point},
                            Member{"has_pole_fixed", &goal_plan::has_pole_fixed},
                            Member{"pole", &goal_plan::pole, 0, GOAL_POLE_NORMAL},
                            Member{"holds_pole", &goal_plan::holds_pole},
                            Member{"hand_is_local", &goal_plan::hand_is_local},
                            Member{"goes_along", &goal_plan::goes_along},
                            Member{"holds", &goal_plan::holds, 0, kMaxLimbs}};
constexpr std::tuple kHalfSpace{Member{"axis", &swivel_half_space::axis}, Member{"cosine", &swivel_half_space::cosine},
                                Member{"is_edge", &swivel_half_space::is_edge}};
constexpr std::tuple kGround{Member{"size", &goal_ground::size}, Member{"place", &goal_ground::place},
                             Member{"columns", &goal_ground::columns, 0, kMaxHeights},
                             Member{"rows", &goal_ground::rows, 0, kMaxHeights}};
// What a crowd is, around how it is cut.
constexpr std::tuple kCrowd{Member{"has_poses", &CachedCrowd::has_poses},
                            Member{"frames", &CachedCrowd::frame_count, 1, kMax},
                            Member{"characters", &CachedCrowd::character_count, 1, kMax}};
constexpr std::tuple kChunk{Member{"chunk_frames", &ChunkShape::frames, 1, kMaxFramesInChunk},
                            Member{"chunk_characters", &ChunkShape::characters, SWIVEL_LANES, kMaxCharactersInChunk}};
constexpr std::tuple kClip{Member{"has_given", &CachedCrowd::has_given},
                           Member{"has_headings", &CachedCrowd::has_headings},
                           Member{"title", &CachedCrowd::title},
                           Member{"clip", &CachedCrowd::clip},
                           Member{"clip_frames", &CachedCrowd::clip_frames, 1, kMax},
                           Member{"frame_seconds", &CachedCrowd::frame_seconds}};

template <class Struct, class... Members>
void put(const Struct& from, const std::tuple<Members...>& members, Json& to)
{
    std::apply([&](const Members&... each) { ((to[each.name] = from.*each.at), ...); }, members);
}
template <class Struct, class... Members>
Json json_of(const Struct& from, const std::tuple<Members...>& members)
{
    Json out;
    put(from, members, out);
    return out;
}

// A number within its range. JSON's own conversions would wrap, cut or round others.
std::uint32_t whole(const Json& json, const char* name, std::uint32_t min, std::uint32_t max)
{
    const Json& value = json.at(name);
    // From 2^63 on it becomes negative, and is out of range as well.
    const std::int64_t number = value.is_number_integer() ? value.get<std::int64_t>() : -1;
    if (number < min || number > max)
        throw std::invalid_argument(
            fmt::format("{} is {}, not a number from {} to {}", name, formats::printable(value.dump()), min, max));
    return static_cast<std::uint32_t>(number);
}
template <class Enum>
Enum one_of(const Json& json, const char* name, Enum last)
{
    return static_cast<Enum>(whole(json, name, 0, last));
}

// A joint's place in the list, or -1.
int place_of(const Json& json)
{
    if (!json.is_number_integer() || json.get<std::int64_t>() < -1 || json.get<std::int64_t>() > kMaxJoints)
        throw std::invalid_argument("a joint's number is out of range");
    return json.get<int>();
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
            json[n].get_to(to[n]);  // throws for what is no number
}

template <class Struct, class... Members>
void take(const Json& json, const std::tuple<Members...>& members, Struct& to)
{
    const auto take_one = [&]<class Value>(const Member<Struct, Value>& each) {
        if constexpr (std::is_same_v<Value, std::uint32_t>)
            to.*each.at = whole(json, each.name, each.min, each.max);
        else if constexpr (std::is_array_v<Value>)
            get(json.at(each.name), to.*each.at);
        else
            json.at(each.name).get_to(to.*each.at);
    };
    std::apply([&](const Members&... each) { (take_one(each), ...); }, members);
}

// A field of the solver, which says by itself what it takes.
swivel_field field_of(const Json& json)
{
    swivel_field_info info{};
    const std::uint32_t field = whole(json, "field", 0, SWIVEL_RESULT_END);
    for (std::uint32_t n = 0; swivel_describe_field(n, &info) && info.field != field;) ++n;
    if (info.field != field) throw std::invalid_argument(fmt::format("field is {}, and there is no such field", field));
    return info.field;
}

Json json_of(const swivel_region& region)
{
    Json half_spaces = Json::array();
    for (std::uint32_t n = 0; n < region.first[region.part_count]; ++n)
        half_spaces.push_back(json_of(region.half_space[n], kHalfSpace));
    return {{"first", std::vector(region.first, region.first + region.part_count + 1)},
            {"half_spaces", std::move(half_spaces)}};
}

// The solver checks what it says.
swivel_region region_of(const Json& json)
{
    swivel_region region = swivel_default_region();
    const Json &first = json.at("first"), &half_spaces = json.at("half_spaces");
    if (first.empty() || first.size() > std::size(region.first) || half_spaces.size() > std::size(region.half_space))
        throw std::invalid_argument("a region has too many parts, or none");
    region.part_count = static_cast<std::uint32_t>(first.size() - 1);
    for (std::size_t n = 0; n < first.size(); ++n) {
        const std::int64_t at = first[n].is_number_integer() ? first[n].get<std::int64_t>() : -1;
        if (at < 0 || at > static_cast<std::int64_t>(half_spaces.size()))
            throw std::invalid_argument("a region's part starts at no half-space");
        region.first[n] = static_cast<std::uint32_t>(at);
    }
    region.cut_count = region.first[0];
    for (std::size_t n = 0; n < half_spaces.size(); ++n) take(half_spaces[n], kHalfSpace, region.half_space[n]);
    return region;
}

bool is_length(double length) { return length > 0 && length <= kMaxLength; }
bool is_place(double place) { return std::fabs(place) <= kMaxLength; }

// Without its heights.
Ground ground_of(const Json& json)
{
    Ground ground{};
    take(json, kGround, ground.grid);
    if (!std::ranges::all_of(ground.grid.size, is_length) || !std::ranges::all_of(ground.grid.place, is_place))
        throw std::invalid_argument("a ground's size or place is out of range");
    if (std::min(ground.grid.columns, ground.grid.rows) < 2 && ground.grid.columns + ground.grid.rows > 0)
        throw std::invalid_argument("a ground has one row or column");
    return ground;
}

Json json_of(const CachedLimb& limb)
{
    const LimbSetup& setup = limb.setup;
    Json fixed = Json::array();
    for (const FixedField& each : setup.fields) fixed.push_back({{"field", each.field}, {"value", each.value}});
    Json json{{"name", formats::limb_word(limb.name)},
              {"joints", limb.joints},
              {"features", setup.features},
              {"shoulder_order", setup.shoulder_order},
              {"wrist_order", setup.wrist_order},
              {"twist_bones", setup.twist_bone_count},
              {"mirrored", setup.mirrored ? 1 : 0},
              {"chain", json_of(setup.rest, kRest)},
              {"goals", json_of(setup.goals, kGoals)},
              {"fixed", std::move(fixed)}};
    if (setup.region) json["region"] = json_of(*setup.region);
    if (setup.has(SWIVEL_POLE_HALF_LINE)) json["pole_behind"] = setup.pole_behind;
    if (setup.has(SWIVEL_WITH_GROUND)) json["clearances"] = {setup.ground.toe_clearance, setup.ground.heel_clearance};
    return json;
}

CachedLimb limb_of(const Json& json)
{
    CachedLimb limb;
    const auto name = formats::limb_of_word(json.at("name").get<std::string>());
    if (!name) throw std::invalid_argument("a limb has no name that is known");
    limb.name = *name;
    for (const Json& joint : json.at("joints")) limb.joints.push_back(place_of(joint));
    LimbSetup& setup = limb.setup;
    if (!json.at("features").is_number_unsigned()) throw std::invalid_argument("features is no set of bits");
    json.at("features").get_to(setup.features);
    setup.shoulder_order = one_of(json, "shoulder_order", SWIVEL_ZYX);
    setup.wrist_order = one_of(json, "wrist_order", SWIVEL_ZYX);
    setup.twist_bone_count = whole(json, "twist_bones", 0, SWIVEL_MAX_TWIST_BONES);
    setup.mirrored = whole(json, "mirrored", 0, 1) != 0;
    take(json.at("chain"), kRest, setup.rest);
    take(json.at("goals"), kGoals, setup.goals);
    for (const Json& each : json.at("fixed")) {
        FixedField& fixed = setup.fields.emplace_back();
        fixed.field = field_of(each);
        each.at("value").get_to(fixed.value);
    }
    if (json.contains("region")) setup.region = region_of(json.at("region"));
    if (json.contains("pole_behind")) json.at("pole_behind").get_to(setup.pole_behind);
    if (json.contains("clearances")) {
        float clearances[2];
        get(json.at("clearances"), clearances);
        setup.goals.clearance = setup.ground.toe_clearance = clearances[0];
        setup.ground.heel_clearance = clearances[1];
    }
    return limb;
}

// Its sides, and how far it is ahead.
std::array<double, 4> box_of(const Json& json)
{
    double box[4];
    get(json, box);
    if (!std::ranges::all_of(std::span(box).first(3), is_length) || !is_place(box[3]))
        throw std::invalid_argument("a box's size or place is out of range");
    return std::to_array(box);
}

// With the number of its joints, since a solver's look has more.
Json json_of(const CachedLook& look)
{
    const swivel_look_def& how = *look.setup.look;
    return {{"chain", json_of(look.setup.rest, kRest)},
            {"goals", json_of(look.setup.goals, kGoals)},
            {"joint_count", how.joint_count},
            {"axis", how.axis},
            {"cos_max", how.cos_max[0]}};
}

CachedLook look_of(const Json& json)
{
    CachedLook look;
    LimbSetup& setup = look.setup;
    take(json.at("chain"), kRest, setup.rest);
    take(json.at("goals"), kGoals, setup.goals);
    setup.goals.is_look = 1;
    if (setup.goals.holds > 0) throw std::invalid_argument("a look holds a hand");
    swivel_look_def& how = setup.look.emplace(swivel_default_look_def());
    how.joint_count = whole(json, "joint_count", 1, GOAL_JOINTS - 1);
    for (std::uint32_t n = 0; n < how.joint_count; ++n) how.joints[n] = n;
    get(json.at("axis"), how.axis);
    std::ranges::fill(how.cos_max, number_of(json.at("cos_max")));
    return look;
}

// What the rest of the program relies on, beside the ranges of numbers.
void require_sane(const CachedCrowd& crowd)
{
    if (crowd.limbs.empty() || crowd.limbs.size() > kMaxLimbs)
        throw std::invalid_argument("there are no limbs, or too many");
    if (!crowd.names.empty() && crowd.names.size() != crowd.character_count)
        throw std::invalid_argument("the names are not as many as the characters");
    if (!std::ranges::all_of(crowd.names, formats::is_plain_name))
        throw std::invalid_argument("a name is empty, or it holds a comma, a quote or a control character");
    const auto joint_count = static_cast<int>(crowd.joints.size());
    for (int n = 0; n < joint_count; ++n)
        if (const int parent = crowd.joints[static_cast<std::size_t>(n)].parent; parent < -1 || parent >= n)
            throw std::invalid_argument("a joint comes before its parent");
    const auto is_joint = [&](int joint) { return joint >= 0 && joint < joint_count; };
    for (std::size_t n = 0; n < crowd.limbs.size(); ++n)
        if (crowd.limbs[n].setup.goals.holds > n) throw std::invalid_argument("a limb holds none that is before it");
    for (const CachedLimb& limb : crowd.limbs)
        if (limb.joints.size() != 3 || !std::ranges::all_of(limb.joints, is_joint))
            throw std::invalid_argument("a limb's joints are not three of the joints");
}

// All that is carried is kept, and legs stand where there is a ground, and nowhere else.
void require_kept(const CachedCrowd& crowd)
{
    const std::vector<ResultField> kept = result_fields(crowd);
    swivel_features all = 0;
    for (const LimbSetup& limb : setups_of(crowd)) {
        all |= limb.features;
        const swivel_kind kind = limb.look ? SWIVEL_KIND_LOOK : SWIVEL_KIND_BODY_LIMB;
        swivel_field_info info;
        for (std::uint32_t n = 0; swivel_describe_field(n, &info); ++n)
            if (info.kind == SWIVEL_FIELD_CARRIED && (info.kinds >> kind & 1) != 0 &&
                (limb.features & info.needs) == info.needs && !(limb.features & info.excludes) &&
                std::ranges::find(kept, info.field, &ResultField::field) == kept.end())
                throw std::invalid_argument(fmt::format("a limb carries {}, which no cache keeps", info.name));
    }
    constexpr swivel_features kStands = SWIVEL_WITH_GROUND | SWIVEL_WITH_PELVIS_FIT;
    if ((all & kStands) != (crowd.ground ? kStands : 0))
        throw std::invalid_argument("legs stand without a ground, or there is one that none stands on");
}

// The solver knows what it takes: features that go together, unit rotations, fields that there are.
void require_solvable(const CachedCrowd& crowd)
{
    const std::vector<LimbSetup> setups = setups_of(crowd);
    const goal_source none{};
    const Ground level{};  // the cache's own heights come later
    GoalCrowd crowd_of_one(setups, std::vector(setups.size(), std::span(&none, 1)),
                           {goal_character{1, {}, 0, 0, 0, 1, 0, 0}}, 0, crowd.ground ? &level : nullptr, 0);
    crowd_of_one.set_frame(0);
    crowd_of_one.solve();
}

std::string digest_text(const Json& attributes)
{
    const std::string text = attributes.dump(-1, ' ', false, Json::error_handler_t::replace);
    return fmt::format("{:016x}", digest_of(std::as_bytes(std::span(text))));
}

}  // namespace

Json attributes_of(const CachedCrowd& crowd)
{
    Json joints = Json::array(), limbs = Json::array();
    for (const CachedJoint& joint : crowd.joints) joints.push_back({{"name", joint.name}, {"parent", joint.parent}});
    for (const CachedLimb& limb : crowd.limbs) limbs.push_back(json_of(limb));
    Json out{{"swivel_cache", kFormat}};
    put(crowd, kCrowd, out);
    put(crowd.chunk, kChunk, out);
    put(crowd, kClip, out);
    out["goals_digest"] = fmt::format("{:016x}", crowd.goals_digest);
    out["joints"] = std::move(joints);
    out["limbs"] = std::move(limbs);
    if (crowd.ground) out["ground"] = json_of(crowd.ground->grid, kGround);
    if (crowd.look) out["look"] = json_of(*crowd.look);
    if (crowd.box) out["box"] = *crowd.box;
    if (!crowd.names.empty()) out["names"] = crowd.names;
    out["digest"] = digest_text(out);
    return out;
}

CachedCrowd crowd_of_attributes(const Json& attributes, const std::filesystem::path& path)
{
    const auto refuse = [&](const std::string& why) { throw formats::InputError(path, why); };
    if (!attributes.contains("swivel_cache")) refuse("describes no cache of swivel; swivel store makes one");
    if (attributes["swivel_cache"] != kFormat)
        refuse(
            fmt::format("the cache has format {}, this swivel reads format {}; make it anew by swivel store, or use "
                        "the swivel that made it",
                        formats::printable(attributes["swivel_cache"].dump()), kFormat));
    Json without = attributes;
    without.erase("digest");
    if (attributes.value("digest", Json()) != digest_text(without))
        refuse("was changed: its digest is another; take it from a copy, or make the cache anew");
    CachedCrowd crowd;
    try {
        take(attributes, kCrowd, crowd);
        take(attributes, kChunk, crowd.chunk);
        take(attributes, kClip, crowd);
        if (crowd.chunk.characters % SWIVEL_LANES != 0)
            throw std::invalid_argument("chunk_characters is no multiple of 16");
        if (!(crowd.frame_seconds >= 0 && crowd.frame_seconds <= kMaxLength))
            throw std::invalid_argument("frame_seconds is out of range");
        crowd.goals_digest = std::stoull(attributes.at("goals_digest").get<std::string>(), nullptr, 16);
        for (const Json& joint : attributes.at("joints"))
            crowd.joints.push_back({joint.at("name").get<std::string>(), place_of(joint.at("parent"))});
        for (const Json& limb : attributes.at("limbs")) crowd.limbs.push_back(limb_of(limb));
        if (attributes.contains("ground")) crowd.ground = ground_of(attributes.at("ground"));
        if (attributes.contains("look")) crowd.look = look_of(attributes.at("look"));
        if (attributes.contains("box")) crowd.box = box_of(attributes.at("box"));
        if (attributes.contains("names")) attributes.at("names").get_to(crowd.names);
        require_sane(crowd);
        require_kept(crowd);
        require_solvable(crowd);
    } catch (const formats::InputError&) {
        throw;
    } catch (const std::exception& error) {  // the digest holds, so another program wrote it
        refuse(fmt::format("cannot be understood: {}; make the cache anew by swivel store",
                           formats::printable(error.what(), formats::kMaxQuoted)));
    }
    return crowd;
}

}  // namespace swivel::tools
