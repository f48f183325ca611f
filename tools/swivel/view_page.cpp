// SPDX-License-Identifier: MIT
#include "tools/swivel/view_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "swivel/swivel.h"
#include "tools/cli/command_error.h"
#include "tools/formats/base64.h"

namespace swivel::tools {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kPlace = "/*crowd*/null";  // the crowd's, in the page's program

// Installed beside the command, or built in the folder of builds.
std::string page_program()
{
    const fs::path bin = fs::read_symlink("/proc/self/exe").parent_path();
    for (const char* place : {"../share/swivel/view.html", "../../view/view.html"}) {
        std::ifstream file(bin / place, std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(file), {}};
        if (text.find(kPlace) != std::string::npos) return text;
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

// The joints that are drawn: bones, and the limbs' own.
std::vector<std::size_t> drawn_joints(const formats::Clip& clip, std::span<const Limb> limbs)
{
    std::vector<std::size_t> drawn;
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        const auto has = [&](const Limb& limb) { return std::ranges::count(limb.joints, static_cast<int>(n)) > 0; };
        if (clip.joints[n].is_bone || std::ranges::any_of(limbs, has)) drawn.push_back(n);
    }
    return drawn;
}

// A joint's place among those that are drawn, or of the nearest one above it; -1 where there is none.
int drawn_at(const formats::Clip& clip, std::span<const std::size_t> drawn, int joint)
{
    for (; joint >= 0; joint = joint_at(clip, joint).parent) {
        const auto at = std::ranges::lower_bound(drawn, static_cast<std::size_t>(joint));
        if (at != drawn.end() && *at == static_cast<std::size_t>(joint)) return static_cast<int>(at - drawn.begin());
    }
    return -1;
}

Json json_of_joints(const formats::Clip& clip, std::span<const std::size_t> drawn)
{
    Json list = Json::array();
    for (const std::size_t n : drawn)
        list.push_back({{"name", clip.joints[n].name}, {"parent", drawn_at(clip, drawn, clip.joints[n].parent)}});
    return list;
}

std::vector<float> positions_of(const formats::Clip& clip, std::span<const std::size_t> drawn)
{
    std::vector<float> positions;
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        for (const std::size_t n : drawn)
            for (const double coordinate : pose_w[n].position) positions.push_back(static_cast<float>(coordinate));
    }
    return positions;
}

Json json_of_limb(const Limb& limb, const GoalCrowd& crowd, std::size_t n)
{
    const LimbCrowds::Place& place = crowd.crowds().place(n);
    const LimbSetup& setup = crowd.limbs()[n];
    Json out{{"name", formats::limb_word(limb.name)},
             {"mirrored", limb.mirrored},
             {"crowd", place.crowd},
             {"group", place.group},
             {"binding", base64_of(std::span(&setup.binding, 1))},
             {"plan", base64_of(std::span(&setup.goals, 1))},
             {"sources", base64_of(crowd.sources(n))},
             {"effector", setup.goals.effector},
             {"priority", setup.priority},
             {"fixed", Json::array()}};
    for (const FixedField& fixed : setup.fields)
        out["fixed"].push_back({{"field", fixed.field}, {"value", fixed.value}});
    return out;
}

Json json_of(const LimbCrowds::Shape& shape)
{
    return {{"features", fmt::format("{}", shape.features)},
            {"shoulder_order", shape.shoulder_order},
            {"wrist_order", shape.wrist_order}};
}

// As a script may hold it: without the sign that could end it. Bytes that are no UTF-8 are replaced.
std::string script_text(const Json& json)
{
    std::string text;
    for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
        c == '<' ? text += "\\u003c" : text += c;
    return text;
}

}  // namespace

ViewPage::ViewPage(const fs::path& path) : before_(page_program()), out_(path)
{
    const std::size_t place = before_.find(kPlace);
    after_ = before_.substr(place + kPlace.size());
    before_.resize(place);
}

void ViewPage::add_frame(const ClipCrowd& crowd)
{
    const auto frame = static_cast<std::uint32_t>(digests_.size());
    for (const ClipCrowd::GivenPlace& at : crowd.given_places()) {
        Given& given = given_.emplace_back();
        const goal_input& input = crowd.goal_crowd().input(at.limb, at.character);
        given = {frame, at.character, static_cast<std::uint32_t>(at.limb), 0, {}, {}, {}};
        std::ranges::copy(input.target, given.target);
        std::ranges::copy(input.pole, given.pole);
        std::ranges::copy(input.hand, given.hand);
    }
    digests_.push_back(crowd.goal_crowd().crowds().digests());
}

void ViewPage::commit(const PageNames& names, const formats::Clip& clip, std::span<const Limb> limbs,
                      const CrowdPlan& plan, const ClipCrowd& crowd)
{
    const std::vector<std::size_t> drawn = drawn_joints(clip, limbs);
    Json page{{"version", fmt::format("{}.{}.{}", SWIVEL_VERSION_MAJOR, SWIVEL_VERSION_MINOR, SWIVEL_VERSION_PATCH)},
              {"title", names.title},
              {"clip", names.clip},
              {"frame_seconds", clip.frame_time},
              {"frame_count", clip.frame_count},
              {"joints", json_of_joints(clip, drawn)},
              {"positions", base64_of(std::span<const float>(positions_of(clip, drawn)))},
              {"character_count", crowd.character_count()},
              {"characters", base64_of(crowd.goal_crowd().characters())},
              {"limbs", Json::array()},
              {"crowds", Json::array()},
              {"budget_blocks", plan.budget_blocks},
              {"given", base64_of(std::span<const Given>(given_))},
              {"digests", Json::array()}};
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        Json limb = json_of_limb(limbs[n], crowd.goal_crowd(), n);
        for (const int joint : limbs[n].joints) limb["joints"].push_back(drawn_at(clip, drawn, joint));
        page["limbs"].push_back(std::move(limb));
    }
    for (const LimbCrowds::Shape& shape : crowd.goal_crowd().crowds().shapes())
        page["crowds"].push_back(json_of(shape));
    for (const std::vector<std::uint64_t>& of_frame : digests_) {
        Json digests = Json::array();
        for (const std::uint64_t digest : of_frame) digests.push_back(fmt::format("{:016x}", digest));
        page["digests"].push_back(std::move(digests));
    }
    out_.write(before_);
    out_.write(script_text(page));
    out_.write(after_);
    out_.commit();
}

}  // namespace swivel::tools
