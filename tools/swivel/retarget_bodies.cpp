// SPDX-License-Identifier: MIT
#include "tools/swivel/retarget_bodies.h"

#include <fmt/format.h>

#include "tools/cli/command_error.h"
#include "tools/formats/printable.h"
#include "tools/rig/limbs.h"

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

}  // namespace

BodyChoice body_choice(const RetargetOptions& options, BodySide side)
{
    BodyChoice choice;
    const auto read = [&](const char* option, const std::vector<std::string>& texts, const auto& take) {
        if (!options.map.empty() && !texts.empty())
            throw CommandError(2, fmt::format("{}: --map says already which joints are whose; write them into the "
                                              "table, or leave --map out",
                                              option));
        for (const std::string& text : texts)
            if (const auto said = about(side, option, text)) take(*said);
    };
    read("--arm", options.arms,
         [&](std::string_view said) { choice.limbs.arms.push_back(limb_of_option(said, "--arm")); });
    read("--leg", options.legs,
         [&](std::string_view said) { choice.limbs.legs.push_back(limb_of_option(said, "--leg")); });
    read("--head", options.heads, [&](std::string_view said) {
        if (choice.head) throw CommandError(2, "--head: a body has one head, and two joints are given");
        choice.head = NamedJoint{std::string(said), {"--head"}};
    });
    return choice;
}

PartedBody parted_body(const formats::Clip& clip, const std::string& file, const BodyChoice& choice)
{
    return {clip, body_of(clip, file, choose_joints(clip, file, choice.limbs), choice.head)};
}

}  // namespace swivel::tools
