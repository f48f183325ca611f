// SPDX-License-Identifier: MIT
#include "tools/swivel/view_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "swivel/swivel.h"
#include "tools/cli/command_error.h"
#include "tools/formats/base64.h"
#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Places in the page's program, of the script's digest and of the crowd.
constexpr std::string_view kDigestPlace = "data-digest=\"\">", kPlace = "/*crowd*/null", kScriptEnd = "</script>";

// FNV-1a of 64 bits, which the page computes again (tools/view/src/whole.js).
std::uint64_t script_digest(std::string_view script)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char byte : script) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
    return hash;
}

// Installed with the command, or built in the folder of builds.
std::string page_program()
{
    const fs::path build = fs::read_symlink("/proc/self/exe").parent_path() / "../../view/view.html";
    for (const fs::path& file : {shared_file("view.html"), build}) {
        if (std::error_code missing; !fs::exists(file, missing)) continue;
        std::string text = formats::read_text(file);
        const std::size_t script = text.find(kDigestPlace), crowd = text.find(kPlace, script);
        if (text.find(kScriptEnd, crowd) != std::string::npos) return text;
    }
    throw CommandError(1,
                       "the page's program, view.html, is missing; build it with tools/view/build, which takes npm and "
                       "emscripten");
}

template <class Value>
std::string base64_of(std::span<const Value> values)
{
    return formats::base64_of({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
}

Json json_of_limb(const CachedLimb& limb, const LimbSkeleton::OfLimb& joints)
{
    const LimbSetup& setup = limb.setup;
    Json out{{"name", formats::limb_word(limb.name)},
             {"features", fmt::format("{}", setup.features)},
             {"shoulder_order", setup.shoulder_order},
             {"wrist_order", setup.wrist_order},
             {"shoulder", joints.shoulder},
             {"twist_bones", joints.twist_bones},
             {"bend", joints.bend},
             {"pole_behind", setup.pole_behind},
             {"plan", base64_of(std::span(&setup.goals, 1))},
             {"sources", base64_of(std::span<const goal_source>(limb.sources))},
             {"weights", setup.goals.weights},
             {"fixed", Json::array()},
             {"joints", limb.joints}};
    if (setup.region) {
        swivel_region region = *setup.region;
        out["region"] = base64_of(std::span<const char>(bytes_behind_size(region)));
    }
    if (setup.has(SWIVEL_WITH_GROUND)) {
        const swivel_plant plant = setup.standing_plant();
        const swivel_ground ground = setup.standing_ground();
        out["plant"] = base64_of(std::span(&plant, 1));
        out["ground"] = base64_of(std::span(&ground, 1));
    }
    for (const FixedField& fixed : setup.fields)
        out["fixed"].push_back({{"field", fixed.field}, {"value", fixed.value}});
    return out;
}

Json json_of_look(const CachedLook& look)
{
    const swivel_look_def& how = *look.setup.look;
    return {{"plan", base64_of(std::span(&look.setup.goals, 1))},
            {"sources", base64_of(std::span<const goal_source>(look.sources))},
            {"joint_count", how.joint_count},
            {"axis", how.axis},
            {"cos_max", how.cos_max[0]}};
}

// Appends JSON for a script: escapes the sign that could end it, and replaces bytes that are no UTF-8.
void append_script_text(std::string& text, const Json& json)
{
    for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
        c == '<' ? text += "\\u003c" : text += c;
}

// A page would replace a clip, a table or a crowd file of that name.
const fs::path& page_name(const fs::path& path)
{
    constexpr std::string_view kOthers[] = {".csv", ".bvh", ".glb", ".gltf", ".vrm", ".toml"};
    const std::string suffix = formats::lower_suffix(path);
    if (std::ranges::find(kOthers, suffix) != std::end(kOthers))
        throw CommandError(
            2, fmt::format("{}: a page is HTML, and {} is for other files; name a .html", path.string(), suffix));
    return path;
}

}  // namespace

fs::path shared_file(const char* name)
{
    return fs::read_symlink("/proc/self/exe").parent_path() / "../share/swivel" / name;
}

ViewPage::ViewPage(const fs::path& path) : out_(page_name(path)), program_(page_program()) {}

void ViewPage::add_frame(const GoalCrowd& crowd, std::span<const GivenPlace> places)
{
    const auto frame = static_cast<std::uint32_t>(digests_.size());
    for (const GivenPlace& at : places) {
        goal_given& given = given_.emplace_back();
        const goal_input& input = crowd.input(at.limb, at.character);
        given = {frame, at.character, static_cast<std::uint32_t>(at.limb), input.weights[2], {}, {}, {}};
        std::ranges::copy(input.target, given.target);
        std::ranges::copy(input.pole, given.pole);
        std::ranges::copy(input.hand, given.hand);
    }
    digests_.push_back(crowd.digest());
}

void ViewPage::commit(const CachedCrowd& cached, const GoalCrowd& crowd, const std::optional<PageSkin>& skin)
{
    Json joints = Json::array();
    for (const CachedJoint& joint : cached.joints) joints.push_back({{"name", joint.name}, {"parent", joint.parent}});
    Json page{{"version", fmt::format("{}.{}.{}", SWIVEL_VERSION_MAJOR, SWIVEL_VERSION_MINOR, SWIVEL_VERSION_PATCH)},
              {"title", cached.title},
              {"clip", cached.clip},
              {"frame_seconds", cached.frame_seconds},
              {"frame_count", digests_.size()},
              {"joints", std::move(joints)},
              {"positions", base64_of(std::span(cached.positions))},
              {"character_count", crowd.character_count()},
              {"characters", base64_of(crowd.characters())},
              {"limbs", Json::array()},
              {"budget_blocks", cached.budget_blocks},
              {"given", base64_of(std::span<const goal_given>(given_))},
              {"digests", Json::array()}};
    if (const auto& ground = cached.ground)
        page["ground"] = {{"grid", base64_of(std::span(&ground->grid, 1))},
                          {"heights", base64_of(std::span(ground->heights))}};
    if (skin)
        page["skin"] = {{"glb", formats::base64_of(skin->glb)},
                        {"nodes", skin->nodes},
                        {"turns", base64_of(std::span(skin->turns))},
                        {"head", skin->head},
                        {"face", skin->face}};
    if (cached.box) page["box"] = *cached.box;
    if (cached.look) page["look"] = json_of_look(*cached.look);
    const LimbSkeleton skeleton = skeleton_of(crowd.limbs());
    page["skeleton"] = {
        {"parents", skeleton.parents}, {"translations", skeleton.translations}, {"rotations", skeleton.rotations}};
    for (std::size_t n = 0; n < cached.limbs.size(); ++n)
        page["limbs"].push_back(json_of_limb(cached.limbs[n], skeleton.limbs[n]));
    for (const std::uint64_t digest : digests_) page["digests"].push_back(fmt::format("{:016x}", digest));
    const std::size_t begin = program_.find(kDigestPlace) + kDigestPlace.size(), place = program_.find(kPlace, begin),
                      after_place = place + kPlace.size(), end = program_.find(kScriptEnd, after_place);
    std::string script = program_.substr(begin, place - begin);
    append_script_text(script, page);
    script += program_.substr(after_place, end - after_place);
    constexpr std::string_view kDigestEnd = "\">";
    out_.write(program_.substr(0, begin - kDigestEnd.size()));
    out_.write(fmt::format("{:016x}{}", script_digest(script), kDigestEnd));
    out_.write(script);
    out_.write(program_.substr(end));
    out_.commit();
}

}  // namespace swivel::tools
