// SPDX-License-Identifier: MIT
//
// The crowd file: any text is read or refused in one line. What is read says where it stands, and what it asks of each
// limb.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include "tests/fuzz/check_clip.h"
#include "tests/fuzz/scratch_folder.h"
#include "tools/formats/crowd_file.h"

using namespace swivel::formats;
using namespace swivel::fuzz;

namespace {

void check_limit(const NumberRange& range) { SWIVEL_REQUIRE(range.least <= range.most); }
void check_limit(const ConeLimit& cone) { SWIVEL_REQUIRE(std::abs(cone.axis.norm() - 1) < 1e-12); }
void check_limit(const TwistLimit& twist)
{
    SWIVEL_REQUIRE(std::abs(twist.axis.norm() - 1) < 1e-12);
    check_limit(twist.range_deg);
}
void check_limit(const BoxLimit& box)
{
    for (const NumberRange& range : box.about_deg) check_limit(range);
}

// The values that take several checks each, in one limb's settings.
void check_settings(const LimbSettings& s)
{
    SWIVEL_REQUIRE(!s.joints || s.joints->value.size() == 3);
    SWIVEL_REQUIRE(!s.bend || std::abs(s.bend->value.norm() - 1) < 1e-12);
    if (s.region) {
        const RegionLimit& region = s.region->value;
        for (const std::vector<ConeLimit>* cones : {&region.cones, &region.forbidden})
            for (const ConeLimit& cone : *cones)
                SWIVEL_REQUIRE(std::abs(cone.axis.norm() - 1) < 1e-12 && cone.opening_deg > 0 &&
                               cone.opening_deg < 180);
        SWIVEL_REQUIRE(!region.cones.empty() || !region.polygons.empty() || region.clip_margin_deg > 0);
    }
    SWIVEL_REQUIRE(!s.effector || s.effector->value.allFinite());
    for (const Maybe<Limit>& limit : s.limits)
        if (limit) std::visit([](const auto& value) { check_limit(value); }, limit->value);
    for (const Maybe<double>& weight : s.weights) SWIVEL_REQUIRE(!weight || (weight->value >= 0 && weight->value <= 1));
    SWIVEL_REQUIRE(!(s.step_deg_per_frame && s.step_deg_per_second));
}

void check_file(const CrowdFile& file, std::size_t line_count)
{
    for (const LimbSection& section : file.sections) {
        SWIVEL_REQUIRE(section.line >= 1 && section.line <= line_count);
        SWIVEL_REQUIRE(std::any_of(kLimbNames.begin(), kLimbNames.end(),
                                   [&](LimbName limb) { return selects(section.selector, limb); }));
        check_settings(section.settings);
    }
    for (const LimbName limb : kLimbNames) check_settings(settings_of(file, limb));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const ScratchFolder folder;
    const std::string_view text = text_of(data, size);
    try {
        check_file(read_crowd_file(folder.spill("in.toml", text)),
                   static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1);
    } catch (const InputError& error) {
        check_message(error);
    }
    return 0;
}
