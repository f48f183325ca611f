// SPDX-License-Identifier: MIT
//
// The crowd file: any text is read or refused in one line. What is read is within the ranges that crowd_file.h says.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/fuzz/check_clip.h"
#include "tests/fuzz/scratch_folder.h"
#include "tools/formats/crowd_file.h"
#include "tools/formats/limits.h"

using namespace swivel::formats;
using namespace swivel::fuzz;

namespace {

std::size_t line_count = 0;  // of the text at hand

// A value that is there: it knows where it stands, and is within the range.
template <class T, class Test>
void check_value(const Maybe<T>& value, Test&& test)
{
    if (!value) return;
    SWIVEL_REQUIRE(value->line >= 1 && value->line <= line_count && !value->key.empty());
    SWIVEL_REQUIRE(test(value->value));
}

template <class Number>
void check_within(const Maybe<Number>& value, Number least, Number most)
{
    check_value(value, [&](Number number) { return number >= least && number <= most; });
}

bool is_range(const NumberRange& range, double least, double most)
{
    return range.least >= least && range.least <= range.most && range.most <= most;
}
void check_range(const Maybe<NumberRange>& range, double least, double most)
{
    check_value(range, [&](const NumberRange& ends) { return is_range(ends, least, most); });
}

bool is_turn(const NumberRange& range) { return is_range(range, -360, 360) && range.most - range.least <= 360; }
bool is_axis(const Eigen::Vector3d& axis) { return std::abs(axis.norm() - 1) < 1e-12; }
bool is_point(const Eigen::Vector3d& point) { return point.stableNorm() <= kMaxNorm * (1 + 1e-12); }
bool is_cone(const ConeLimit& cone) { return is_axis(cone.axis) && cone.opening_deg >= 0 && cone.opening_deg <= 180; }
bool is_twist(const TwistLimit& twist) { return is_axis(twist.axis) && is_turn(twist.range_deg); }
bool is_box(const BoxLimit& box)
{
    return box.order <= EulerOrder::zyx && std::all_of(box.about_deg.begin(), box.about_deg.end(), is_turn);
}

void check_limits(const LimbSettings& s)
{
    check_range(s.flexion_deg, 0, 180);
    check_value(s.humeral_twist_deg, is_turn);
    check_value(s.forearm_twist_deg, is_turn);
    check_value(s.shoulder_cone, is_cone);
    check_value(s.hand_cone, is_cone);
    check_value(s.hand_twist, is_twist);
    check_value(s.shoulder_box, is_box);
    check_value(s.wrist_box, is_box);
}

void check_settings(const LimbSettings& s)
{
    check_value(s.joints, [](const std::vector<std::string>& names) { return names.size() == 3; });
    check_value(s.bend, is_axis);
    for (const auto* point : {&s.target_point, &s.target_offset, &s.effector, &s.pole_fixed})
        check_value(*point, is_point);
    check_value(s.aim,
                [](const AimGoal& aim) { return is_axis(aim.axis) && aim.flexion_deg >= 0 && aim.flexion_deg <= 180; });
    check_value(s.pole_kind, [](PoleKind kind) { return kind <= PoleKind::incoming; });
    check_within(s.pole_angle_deg, -360.0, 360.0);
    for (const auto* share : {&s.clavicle_share, &s.position_weight, &s.hand_weight, &s.pole_weight, &s.soft_far,
                              &s.soft_near, &s.least_distance})
        check_within(*share, 0.0, 1.0);
    check_within(s.most_stretch, 1.0, 1000.0);
    check_within(s.most_swivel_deg_per_frame, 0.0, 180.0);
    check_within(s.most_swivel_deg_per_second, 0.0, 1e6);
    SWIVEL_REQUIRE(!(s.most_swivel_deg_per_frame && s.most_swivel_deg_per_second));
    check_limits(s);
    check_within(s.twist_bones, std::int64_t{0}, std::int64_t{7});
    check_within(s.priority, 0.0, 1e15);
}

void check_file(const CrowdFile& file)
{
    check_within(file.characters, std::int64_t{1}, std::int64_t{10'000'000});
    check_within(file.seed, std::int64_t{0}, std::int64_t{INT64_MAX});
    check_within(file.spacing, 0.0, 1e6);
    check_range(file.size, 0.01, 100);
    check_value(file.limbs, [](const std::string& word) { return word == "arms" || word == "legs" || word == "all"; });
    check_value(file.targets, [](const std::string& name) { return !name.empty(); });
    check_within(file.budget_blocks, std::int64_t{1}, std::int64_t{UINT32_MAX});
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
    line_count = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
    try {
        check_file(read_crowd_file(folder.spill("in.toml", text)));
    } catch (const InputError& error) {
        check_message(error);
    }
    return 0;
}
