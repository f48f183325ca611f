// SPDX-License-Identifier: MIT
#include "tools/swivel/given_targets.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/formats/error.h"
#include "tools/swivel/limb_words.h"

namespace swivel::tools {

namespace {

// Why a row speaks of a limb that is not solved, and what to do.
std::string no_limb(const formats::Clip& clip, formats::LimbName name)
{
    const LimbWords& words = words_of(name.kind);
    if (limb_by_name(clip, name).joints)
        return fmt::format("the {} is not solved; take it in with --limbs", plain_name(name));
    return fmt::format("the skeleton has no {}; name it with {} {}", plain_name(name), words.option, words.joints);
}

}  // namespace

GivenTargets::GivenTargets(const std::string& source, const formats::Clip& clip, std::span<const Limb> limbs,
                           std::uint32_t characters)
{
    if (source == "clip") return;
    targets_ = formats::read_targets_csv(source);
    for (const formats::Target& target : targets_) {
        const auto refuse = [&](const std::string& cause) { throw formats::InputError(source, target.line, cause); };
        if (target.frame >= clip.frame_count)
            refuse(fmt::format("frame {} does not exist; the clip has frames 0 to {}", target.frame,
                               clip.frame_count - 1));
        if (target.character >= characters)
            refuse(fmt::format("character {} does not exist; there are {} (--characters), counted from 0",
                               target.character, characters));
        if (std::none_of(limbs.begin(), limbs.end(), [&](const Limb& limb) { return limb.name == target.limb; }))
            refuse(no_limb(clip, target.limb));
    }
}

std::span<const formats::Target> GivenTargets::of_frame(std::size_t frame)
{
    const std::size_t begin = next_;
    while (next_ < targets_.size() && targets_[next_].frame == frame) ++next_;
    return std::span(targets_).subspan(begin, next_ - begin);
}

}  // namespace swivel::tools
