// SPDX-License-Identifier: MIT
//
// The readers of files: any bytes are read or refused in one line. What is read is sound, and reads the same when it is
// written down again. The first byte picks the format.
#include <stdlib.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>

#include "tests/fuzz/bytes.h"
#include "tools/formats/agents_csv.h"
#include "tools/formats/bvh.h"
#include "tools/formats/contacts_csv.h"
#include "tools/formats/crowd_file.h"
#include "tools/formats/error.h"
#include "tools/formats/gltf.h"
#include "tools/formats/gltf_container.h"
#include "tools/formats/height_picture.h"
#include "tools/formats/targets_csv.h"
#include "tools/formats/text.h"

using namespace swivel::formats;
using namespace swivel::fuzz;
using Eigen::Quaterniond;

namespace {

// Files for readers, which take paths, in a folder of the fuzzer's own. It lives as long as the object.
struct ScratchFolder {
    std::filesystem::path path;

    ScratchFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "swivel-fuzz-XXXXXX").string();
        SWIVEL_REQUIRE(::mkdtemp(name.data()) != nullptr);
        path = name;
    }
    ~ScratchFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    // Writes a file of this name; its path.
    std::filesystem::path spill(const char* name, std::string_view text) const
    {
        std::ofstream out(path / name, std::ios::binary);
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
        SWIVEL_REQUIRE(out.flush().good());
        return path / name;
    }
};

std::string slurp(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// One line that can be printed as it is.
void check_message(const InputError& error)
{
    const std::string_view text = error.what();
    SWIVEL_REQUIRE(!text.empty());
    SWIVEL_REQUIRE(text.find_first_of("\n\r") == std::string_view::npos);
}

// What `read` returns; nothing if it refuses the file, in one line.
template <class Read>
auto read_or_refuse(const Read& read) -> std::optional<decltype(read())>
{
    try {
        return read();
    } catch (const InputError& error) {
        check_message(error);
        return std::nullopt;
    }
}

bool is_unit(const Quaterniond& q) { return std::abs(q.norm() - 1) < 1e-6; }

void check_joint(const Clip& clip, std::size_t n)
{
    const Joint& joint = clip.joints[n];
    SWIVEL_REQUIRE(joint.parent >= -1 && joint.parent < static_cast<int>(n));
    SWIVEL_REQUIRE(joint.track >= -1 && joint.track < static_cast<int>(clip.track_count));
    SWIVEL_REQUIRE(joint.scale_track >= -1 && joint.scale_track < static_cast<int>(clip.scale_track_count));
    SWIVEL_REQUIRE(joint.offset.allFinite());
    SWIVEL_REQUIRE(joint.rest_scale.allFinite());
    SWIVEL_REQUIRE(is_unit(joint.rest_rotation));
}

void check_clip(const Clip& clip)
{
    SWIVEL_REQUIRE(!clip.joints.empty() && clip.frame_count > 0);
    SWIVEL_REQUIRE(clip.frame_time >= 0 && std::isfinite(clip.frame_time));  // 0: uneven frames
    SWIVEL_REQUIRE(clip.rotation.size() == clip.frame_count * clip.joints.size());
    SWIVEL_REQUIRE(clip.translation.size() == clip.frame_count * clip.track_count);
    SWIVEL_REQUIRE(clip.scale.size() == clip.frame_count * clip.scale_track_count);
    for (std::size_t n = 0; n < clip.joints.size(); ++n) check_joint(clip, n);
    for (const Quaterniond& rotation : clip.rotation) SWIVEL_REQUIRE(is_unit(rotation));
    for (const Eigen::Vector3d& translation : clip.translation) SWIVEL_REQUIRE(translation.allFinite());
    for (const Eigen::Vector3d& scale : clip.scale) SWIVEL_REQUIRE(scale.allFinite());

    world_pose(clip, clip.frame_count - 1);
    rest_pose(clip);
    const int last = static_cast<int>(clip.joints.size()) - 1;
    const std::vector<int> found = find_joints(clip, joint_path(clip, last));
    SWIVEL_REQUIRE(std::find(found.begin(), found.end(), last) != found.end());
}

// The clip's rotations of one joint, as a writer takes them.
std::vector<Quaterniond> rotations_of(const Clip& clip, std::size_t joint)
{
    std::vector<Quaterniond> rotations;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        rotations.push_back(clip.rotation[frame * clip.joints.size() + joint]);
    return rotations;
}

// ---- BVH

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

    std::vector<std::vector<Quaterniond>> rotations(file.joints.size());
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

// ---- glTF

// Tiny files must not take long. Keys that are read again are up to 60 times as many, by the rate of frames.
constexpr std::size_t kMaxPoseBytes = 1 << 20;

// Frames are those of the last joint and of all above it, so that other joints have keys in between.
GltfFile read_sampled(const std::filesystem::path& path, const GltfChoice& choice)
{
    GltfFile file = read_gltf(path, choice);
    SWIVEL_REQUIRE(file.clip.frame_count == 0 && !file.clip.joints.empty());
    for (const auto& [name, joint] : file.clip.human_bones)
        SWIVEL_REQUIRE(joint >= 0 && static_cast<std::size_t>(joint) < file.clip.joints.size());
    const int last[] = {static_cast<int>(file.clip.joints.size()) - 1};
    sample(file, last);
    return file;
}

void check_channels(const GltfFile& file)
{
    for (const GltfChannel& channel : file.channels) {
        SWIVEL_REQUIRE(channel.joint >= 0 && static_cast<std::size_t>(channel.joint) < file.clip.joints.size());
        SWIVEL_REQUIRE(channel.sampler < file.samplers.size());
    }
    for (const GltfSampler& sampler : file.samplers) {
        const std::size_t each = sampler.interpolation == Interpolation::cubic ? 3 : 1;
        SWIVEL_REQUIRE(!sampler.time.empty() && sampler.value.size() == each * sampler.time.size());
        for (std::size_t n = 1; n < sampler.time.size(); ++n) SWIVEL_REQUIRE(sampler.time[n - 1] < sampler.time[n]);
        for (const Eigen::Vector4d& value : sampler.value) SWIVEL_REQUIRE(value.allFinite());
    }
}

void check_gltf_file(const GltfFile& file)
{
    check_clip(file.clip);
    SWIVEL_REQUIRE(file.times.size() == file.clip.frame_count);
    for (const float time : file.times) SWIVEL_REQUIRE(std::isfinite(time));
    for (std::size_t n = 1; n < file.times.size(); ++n) SWIVEL_REQUIRE(file.times[n - 1] < file.times[n]);
    SWIVEL_REQUIRE(file.animation >= -1 && file.animation < static_cast<int>(file.animation_names.size()));
    check_channels(file);
}

// The joint's rotation in `file` at a time, by its own keys.
Quaterniond rotation_at(const GltfFile& file, int joint, float time)
{
    for (const GltfChannel& channel : file.channels)
        if (channel.joint == joint && channel.path == GltfPath::rotation)
            return sample_rotation(file.samplers[channel.sampler], static_cast<double>(time));
    return file.clip.joints[static_cast<std::size_t>(joint)].rest_rotation;
}

// Nothing new written: all is as it was.
void check_copy(const GltfFile& file, const std::filesystem::path& to, const GltfChoice& choice)
{
    write_gltf(to, file, {});
    const GltfFile again = read_sampled(to, choice);
    SWIVEL_REQUIRE(again.times == file.times);
    SWIVEL_REQUIRE(again.clip.translation == file.clip.translation && again.clip.scale == file.clip.scale);
    SWIVEL_REQUIRE(again.clip.rotation.size() == file.clip.rotation.size());
    for (std::size_t n = 0; n < file.clip.rotation.size(); ++n)
        SWIVEL_REQUIRE(again.clip.rotation[n].coeffs() == file.clip.rotation[n].coeffs());
}

// Its own rotations as new ones: to the rounding of floats, they are what is read.
void check_new_keys(const GltfFile& file, const std::filesystem::path& to)
{
    std::vector<std::vector<Quaterniond>> rotations(file.clip.joints.size());
    std::vector<JointKeys> overrides;
    for (std::size_t n = 0; n < rotations.size(); ++n) {
        if (file.clip.joints[n].is_sheared) continue;
        rotations[n] = rotations_of(file.clip, n);
        overrides.push_back({static_cast<int>(n), rotations[n]});
    }
    write_gltf(to, file, overrides);
    if (overrides.empty()) return;
    const GltfFile again = read_sampled(to, {std::to_string(std::max(file.animation, 0)), 0, 64 * kMaxPoseBytes});
    check_gltf_file(again);
    SWIVEL_REQUIRE(again.clip.joints.size() == file.clip.joints.size());
    for (const JointKeys& change : overrides)
        for (std::size_t frame = 0; frame < file.times.size(); ++frame)
            SWIVEL_REQUIRE(rotation_at(again, change.joint, file.times[frame]).angularDistance(change.rotation[frame]) <
                           1e-6);
}

// rate: of the frames.
void check_gltf(const std::filesystem::path& path, const std::filesystem::path& written, double rate)
{
    const GltfChoice choice{"", rate, kMaxPoseBytes};
    const auto file = read_or_refuse([&] { return read_sampled(path, choice); });
    if (!file) return;
    check_gltf_file(*file);
    for (const char* name : {"out.gltf", "out.glb"}) {
        check_copy(*file, written / name, choice);
        check_new_keys(*file, written / name);
    }
}

// A container reads back as it was, its bytes padded.
void check_container(const std::filesystem::path& path, const GltfContainer& container)
{
    const GltfContainer again = read_gltf_container(path);
    const std::string json = container.json.substr(0, container.json.find_last_not_of(kBlanks) + 1);
    SWIVEL_REQUIRE(again.is_binary && again.json == json && again.other_chunks.empty());
    SWIVEL_REQUIRE(again.bytes.starts_with(container.bytes) && again.bytes.size() < container.bytes.size() + 4);
}

// glTF is read or refused in one line, and says the same after it was written. Bytes that start neither like a GLB nor
// like text are made into a GLB. The first is the rate of frames, and the next two are the length of the JSON. Then
// come the JSON and the binary chunk. So the sizes in the GLB fit, and the fuzzer reaches keys and accessors.
void check_gltf_or_parts(std::string_view text, const ScratchFolder& folder)
{
    if (is_gltf_begin(text.substr(0, 4096))) return check_gltf(folder.spill("in.gltf", text), folder.path, 0);
    Bytes bytes(text);
    const double rate = bytes.take<std::uint8_t>();
    GltfContainer container;
    container.json = bytes.take_text(bytes.take<std::uint16_t>());
    container.bytes = bytes.rest();
    const std::filesystem::path path = folder.spill("in.glb", glb_of(container));
    check_container(path, container);
    check_gltf(path, folder.path, rate);
}

// ---- crowd files, tables and pictures

void check_limit(const NumberRange& range) { SWIVEL_REQUIRE(range.min <= range.max); }
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

// Agents have names of their own, and are of a size.
void check_agents(std::string_view text, const ScratchFolder& folder)
{
    auto agents = read_or_refuse([&] { return read_agents_csv(folder.spill("in.csv", text)); });
    if (!agents) return;
    for (const Agent& agent : *agents) {
        SWIVEL_REQUIRE(agent.line >= 2 && agent.line <= line_count_of(text) && !agent.name.empty());
        SWIVEL_REQUIRE(agent.size > 0 && std::isfinite(agent.x + agent.y + agent.z + agent.heading_deg));
    }
    std::ranges::sort(*agents, {}, &Agent::name);
    SWIVEL_REQUIRE(std::ranges::adjacent_find(*agents, {}, &Agent::name) == agents->end());
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

// The first byte picks the reader by its letter. Other bytes stand for one of them, too. tests/fuzz/run counts the
// rows.
struct Reader {
    char letter;
    void (*check)(std::string_view text, const ScratchFolder& folder);
};
constexpr Reader kReaders[] = {
    {'a', check_agents},  {'b', check_bvh},      {'c', check_crowd},   {'g', check_gltf_or_parts},
    {'h', check_heights}, {'s', check_contacts}, {'t', check_targets},
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const ScratchFolder folder;
    Bytes bytes(data, size);
    const auto first = bytes.take<std::uint8_t>();
    const auto* reader = std::ranges::find(kReaders, static_cast<char>(first), &Reader::letter);
    if (reader == std::end(kReaders)) reader = &kReaders[first % std::size(kReaders)];
    reader->check(bytes.rest(), folder);
    return 0;
}
