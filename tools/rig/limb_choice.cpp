// SPDX-License-Identifier: MIT
#include "tools/rig/limb_choice.h"

#include <fmt/format.h>

#include "tools/formats/printable.h"
#include "tools/rig/limb_words.h"

namespace swivel::tools {

NamedLimb limb_of_option(std::string_view text, std::string_view option)
{
    NamedLimb limb{{}, std::nullopt, {std::string(option)}};
    for (const formats::Side side : {formats::Side::left, formats::Side::right}) {
        const std::string prefix = fmt::format("{}:", side_name(side));
        if (!text.starts_with(prefix)) continue;
        limb.side = side;
        text.remove_prefix(prefix.size());
    }
    for (std::size_t comma; (comma = text.find(',')) != std::string_view::npos; text.remove_prefix(comma + 1))
        limb.joints.emplace_back(text.substr(0, comma));
    limb.joints.emplace_back(text);
    return limb;
}

bool LimbChoice::looks_for(formats::LimbKind kind) const
{
    if (!kinds.empty()) return kinds == "all" || kinds == words_of(kind).limbs;
    return kind == formats::LimbKind::arm && arms.empty() && legs.empty();
}

std::string kinds_words(const LimbChoice& choice)
{
    const Source& source = choice.kinds_source;
    if (!source.is_file()) return fmt::format("{} {}", source.key, choice.kinds);
    return fmt::format("{} = \"{}\" in line {} of {}", source.key, choice.kinds, source.line,
                       formats::printable(source.file.string(), std::string::npos));
}

}  // namespace swivel::tools
