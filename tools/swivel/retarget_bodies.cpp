// SPDX-License-Identifier: MIT
#include "tools/swivel/retarget_bodies.h"

#include <fmt/format.h>

#include <charconv>

#include "tools/cli/command_error.h"
#include "tools/formats/printable.h"
#include "tools/rig/limbs.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

// What the option says behind "source:" or "target:", if it is about this side.
std::optional<std::string_view> about(BodySide side, const char* option, std::string_view text)
{
    for (const BodySide each : {BodySide::source, BodySide::target}) {
        const std::string_view prefix = each == BodySide::source ? "source:" : "target:";
        if (!text.starts_with(prefix)) continue;
        if (each != side) return std::nullopt;
        return text.substr(prefix.size());
    }
    throw CommandError(2, fmt::format("{} {}: does not say whose; write source: or target: in front", option,
                                      formats::printable(text, formats::kMostQuoted)));
}

std::size_t frame_of_option(std::string_view said)
{
    std::uint32_t frame = 0;
    const auto [end, error] = std::from_chars(said.data(), said.data() + said.size(), frame);
    if (error == std::errc() && end == said.data() + said.size()) return frame;
    throw CommandError(2, fmt::format("--rest: {} is not a frame; give a whole number, counted from 0",
                                      formats::printable(said, formats::kMostQuoted)));
}

Eigen::Vector3d axis_of_option(std::string_view said)
{
    const auto axis = axis_of(said);
    if (!axis)
        throw CommandError(2, fmt::format("--up: {} is not an axis; give x, y, z, -x, -y or -z",
                                          formats::printable(said, formats::kMostQuoted)));
    return *axis;
}

}  // namespace

BodyChoice body_choice(const RetargetOptions& options, BodySide side)
{
    BodyChoice choice;
    const auto read = [&](const char* option, const std::vector<std::string>& texts, const auto& take) {
        for (const std::string& text : texts)
            if (const auto said = about(side, option, text)) take(*said);
    };
    const auto read_joints = [&](const char* option, const std::vector<std::string>& texts, const auto& take) {
        if (!options.map.empty() && !texts.empty())
            throw CommandError(2, fmt::format("{}: --map says already which joints are whose; write them into the "
                                              "table, or leave --map out",
                                              option));
        read(option, texts, take);
    };
    const auto require_once = [&](bool is_given, const char* option) {
        if (is_given) throw CommandError(2, fmt::format("{}: it is given twice for one body; give it once", option));
    };
    read_joints("--arm", options.arms,
                [&](std::string_view said) { choice.limbs.arms.push_back(limb_of_option(said, "--arm")); });
    read_joints("--leg", options.legs,
                [&](std::string_view said) { choice.limbs.legs.push_back(limb_of_option(said, "--leg")); });
    read_joints("--head", options.heads, [&](std::string_view said) {
        if (choice.head) throw CommandError(2, "--head: a body has one head, and two joints are given");
        choice.head = NamedJoint{std::string(said), {"--head"}};
    });
    read("--rest", options.rests, [&](std::string_view said) {
        require_once(choice.rest.frame.has_value(), "--rest");
        choice.rest.frame = frame_of_option(said);
    });
    read("--up", options.ups, [&](std::string_view said) {
        require_once(choice.rest.up_w.has_value(), "--up");
        choice.rest.up_w = axis_of_option(said);
    });
    return choice;
}

PartedBody parted_body(const formats::Clip& clip, const std::string& file, const BodyChoice& choice)
{
    return {clip, body_of(clip, file, choose_joints(clip, file, choice.limbs), choice.head)};
}

}  // namespace swivel::tools
