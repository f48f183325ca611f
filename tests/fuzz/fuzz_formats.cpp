// SPDX-License-Identifier: MIT
//
// The readers of files: any bytes are read or refused in one line. What is read is sound, and reads the same when it is
// written down again. The first byte picks the format.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <variant>

#include "tests/fuzz/check_clip.h"
#include "tests/fuzz/gltf_of_bytes.h"
#include "tests/fuzz/scratch_folder.h"
#include "tools/formats/bvh.h"
#include "tools/formats/contacts_csv.h"
#include "tools/formats/crowd_file.h"
#include "tools/formats/height_picture.h"
#include "tools/formats/targets_csv.h"

using namespace swivel::formats;
using namespace swivel::fuzz;

namespace {

std::size_t line_count_of(std::string_view text)
{
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
}

// Whether the joint has one rotation channel about each axis, which new rotations need.
bool can_turn(const BvhJoint& joint)
{
    std::array<int, 3> count{};
    for (const Channel channel : joint.channels)
        if (!is_position(channel)) ++count[static_cast<std::size_t>(axis_of(channel))];
    return count == std::array{1, 1, 1};
}

void check_rotations(const BvhFile& file, const BvhFile& again)
{
    SWIVEL_REQUIRE(again.clip.frame_count == file.clip.frame_count);
    SWIVEL_REQUIRE(again.clip.rotation.size() == file.clip.rotation.size());
    for (std::size_t n = 0; n < file.clip.rotation.size(); ++n)
        SWIVEL_REQUIRE(file.clip.rotation[n].angularDistance(again.clip.rotation[n]) < 1e-9);
    SWIVEL_REQUIRE(again.clip.translation == file.clip.translation);
}

void check_writing(const BvhFile& file, const std::filesystem::path& to)
{
    write_bvh(to, file, {});
    SWIVEL_REQUIRE(slurp(to) == file.text);

    std::vector<std::vector<Eigen::Quaterniond>> rotations(file.joints.size());
    std::vector<JointKeys> overrides;
    for (std::size_t n = 0; n < file.joints.size(); ++n) {
        if (!can_turn(file.joints[n])) continue;
        rotations[n] = rotations_of(file.clip, n);
        overrides.push_back({static_cast<int>(n), rotations[n]});
    }
    write_bvh(to, file, overrides);
    check_rotations(file, read_bvh(to));
}

// A clip is written byte for byte, and keeps its rotations when they are written as new ones.
void check_bvh(std::string_view text, const ScratchFolder& folder)
{
    const auto file = read_or_refuse([&] { return read_bvh(folder.spill("in.bvh", text)); });
    if (!file) return;
    check_clip(file->clip);
    check_writing(*file, folder.path / "out.bvh");
}

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

void check_crowd_file(const CrowdFile& file, std::size_t line_count)
{
    for (const LimbSection& section : file.sections) {
        SWIVEL_REQUIRE(section.line >= 1 && section.line <= line_count);
        SWIVEL_REQUIRE(std::any_of(kLimbNames.begin(), kLimbNames.end(),
                                   [&](LimbName limb) { return selects(section.selector, limb); }));
        check_settings(section.settings);
    }
    for (const LimbName limb : kLimbNames) check_settings(settings_of(file, limb));
}

// A crowd file says where its values stand, and what it asks of each limb.
void check_crowd(std::string_view text, const ScratchFolder& folder)
{
    const auto file = read_or_refuse([&] { return read_crowd_file(folder.spill("in.toml", text)); });
    if (file) check_crowd_file(*file, line_count_of(text));
}

auto place_of(const Target& target) { return std::tuple(target.frame, target.character, target.limb); }

void check_target(const Target& target, std::size_t line_count)
{
    SWIVEL_REQUIRE(target.position.allFinite() && target.pole.allFinite());
    SWIVEL_REQUIRE(is_unit(target.orientation));
    SWIVEL_REQUIRE(target.line >= 2 && target.line <= line_count);
}

bool are_same(const Target& a, const Target& b)
{
    return place_of(a) == place_of(b) && a.position == b.position && a.pole == b.pole && a.has_pole == b.has_pole &&
           a.has_orientation == b.has_orientation && a.orientation.isApprox(b.orientation, 1e-15);
}

// Targets are finite and in order.
void check_targets(std::string_view text, const ScratchFolder& folder)
{
    const auto targets = read_or_refuse([&] { return read_targets_csv(folder.spill("in.csv", text)); });
    if (!targets) return;
    for (const Target& target : *targets) check_target(target, line_count_of(text));
    SWIVEL_REQUIRE(std::ranges::is_sorted(*targets, {}, place_of));
    TargetsCsv csv(folder.path / "again.csv");
    csv.append(*targets);
    csv.commit();
    SWIVEL_REQUIRE(std::ranges::equal(read_targets_csv(folder.path / "again.csv"), *targets, are_same));
}

// Contacts are in order.
void check_contacts(std::string_view text, const ScratchFolder& folder)
{
    const auto rows = read_or_refuse([&] { return read_contacts_csv(folder.spill("in.csv", text)); });
    if (!rows) return;
    const auto place = [](const ContactRow& row) { return std::tuple(row.frame, row.limb); };
    const auto are_alike = [&](const ContactRow& a, const ContactRow& b) {
        return place(a) == place(b) && a.is_on == b.is_on;
    };
    SWIVEL_REQUIRE(std::ranges::is_sorted(*rows, {}, place));
    write_contacts_csv(folder.path / "again.csv", *rows);
    SWIVEL_REQUIRE(std::ranges::equal(read_contacts_csv(folder.path / "again.csv"), *rows, are_alike));
}

// A picture has its pixels, from 0 to 1.
void check_heights(std::string_view text, const ScratchFolder& folder)
{
    const auto picture = read_or_refuse([&] { return read_height_picture(folder.spill("in.png", text)); });
    if (!picture) return;
    SWIVEL_REQUIRE(picture->columns >= 2 && picture->rows >= 2);
    SWIVEL_REQUIRE(picture->heights.size() == std::size_t{picture->columns} * picture->rows);
    SWIVEL_REQUIRE(std::ranges::all_of(picture->heights, [](float height) { return height >= 0 && height <= 1; }));
}

}  // namespace

// The first byte's letter: b BVH, c crowd file, g glTF, h heights, s contacts ("stands"), t targets. Others stand for
// one of them, too.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const ScratchFolder folder;
    constexpr std::string_view kLetters = "bcghst";
    Bytes bytes(data, size);
    const auto first = bytes.take<std::uint8_t>();
    const std::size_t letter = kLetters.find(static_cast<char>(first));
    switch (kLetters[letter == kLetters.npos ? first % kLetters.size() : letter]) {
        case 'b':
            check_bvh(bytes.rest(), folder);
            break;
        case 'c':
            check_crowd(bytes.rest(), folder);
            break;
        case 'g':
            check_gltf_of(bytes, folder);
            break;
        case 'h':
            check_heights(bytes.rest(), folder);
            break;
        case 's':
            check_contacts(bytes.rest(), folder);
            break;
        default:
            check_targets(bytes.rest(), folder);
    }
    return 0;
}
