// SPDX-License-Identifier: MIT
#include "tools/swivel/motion_file.h"

#include <fmt/format.h>

#include "tools/cli/command_error.h"
#include "tools/formats/error.h"
#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

using formats::BvhFile;
using formats::GltfFile;

using Motion = std::variant<BvhFile, GltfFile>;

void require_no_choice(const MotionChoice& choice)
{
    if (!choice.clip.empty())
        throw CommandError(2, "--clip chooses an animation of a glTF file; a BVH file has one; leave it out");
    if (choice.rate > 0)
        throw CommandError(2, "--fps samples a glTF file; a BVH file has frames of its own; leave it out");
}

// Told apart by the first bytes.
Motion read_standard_input(const std::filesystem::path& path, const MotionChoice& choice)
{
    const formats::TextFile input = formats::open_text(path);
    std::string bytes;
    formats::append_bytes(path, input.get(), 1000, bytes);
    if (bytes.empty()) throw formats::InputError(path, "is empty; check how it was written");
    const std::string_view start = formats::trimmed(formats::without_byte_order_mark(bytes));
    if (start.starts_with("glTF") || start.starts_with('{')) {
        formats::GltfContainer container = formats::read_gltf_container(path, input.get(), std::move(bytes));
        return formats::read_gltf(path, std::move(container), {choice.clip, choice.rate});
    }
    if (!formats::is_bvh_text(bytes))
        throw formats::InputError(path, "starts neither as BVH nor as glTF does; give other formats as files");
    require_no_choice(choice);
    formats::append_rest(path, input.get(), bytes);
    if (bytes.find('\0') != std::string::npos)
        throw formats::InputError(path, "starts neither as BVH nor as glTF does; give other formats as files");
    return formats::bvh_of(path, std::move(bytes));
}

Motion read(const std::filesystem::path& path, const MotionChoice& choice)
{
    if (formats::is_standard_stream(path)) return read_standard_input(path, choice);
    if (is_gltf(formats::lower_suffix(path))) return formats::read_gltf(path, {choice.clip, choice.rate});
    if (const std::string suffix = formats::lower_suffix(path); suffix == ".fbx" || suffix == ".dae")
        throw formats::InputError(path,
                                  "swivel reads no FBX and DAE; export the file as glTF, for example from Blender");
    require_no_choice(choice);
    try {
        return formats::read_bvh(path);
    } catch (const formats::InputError& fault) {
        if (is_bvh(formats::lower_suffix(path)) || !std::filesystem::is_regular_file(path)) throw;
        throw CommandError(
            1, fmt::format("{} (read as BVH: names of other formats end in .glb, .gltf or .vrm)", fault.what()));
    }
}

const char* format_of(const Motion& motion) { return std::holds_alternative<BvhFile>(motion) ? "BVH" : "glTF"; }

}  // namespace

MotionFile::MotionFile(const std::filesystem::path& path, const MotionChoice& choice)
    : file_(read(path, choice)), format_(format_of(file_))
{
}

void MotionFile::sample(std::span<const int> limb_joints)
{
    if (GltfFile* gltf = std::get_if<GltfFile>(&file_)) formats::sample(*gltf, limb_joints);
}

void MotionFile::cut(std::size_t frame_count)
{
    std::visit([&](auto& file) { formats::keep_frames(file.clip, frame_count); }, file_);
}

const formats::Clip& MotionFile::clip() const
{
    return std::visit([](const auto& file) -> const formats::Clip& { return file.clip; }, file_);
}

std::span<const std::filesystem::path> MotionFile::files_beside() const
{
    const GltfFile* gltf = std::get_if<GltfFile>(&file_);
    return gltf ? std::span<const std::filesystem::path>(gltf->files_beside) : std::span<const std::filesystem::path>();
}

std::string MotionFile::describe() const
{
    const GltfFile* gltf = std::get_if<GltfFile>(&file_);
    if (!gltf) return format_;
    if (gltf->animation < 0) return format_ + " without animation: its rest pose";
    const std::string& name = gltf->animation_names[static_cast<std::size_t>(gltf->animation)];
    return fmt::format("{}, animation {}{} of {}", format_, gltf->animation,
                       name.empty() ? "" : fmt::format(" '{}'", formats::printable(name)),
                       gltf->animation_names.size());
}

void MotionFile::require_can_write(const OutPlace& out) const
{
    const bool is_bvh_clip = std::holds_alternative<BvhFile>(file_);
    if (is_bvh_clip ? !is_bvh(out.suffix) : !is_gltf(out.suffix))
        throw CommandError(2, fmt::format("--out {}: this clip is a {} file; its poses go to {} or .csv",
                                          out.path.string(), format_, is_bvh_clip ? ".bvh" : ".glb, .gltf, .vrm"));
}

void MotionFile::require_can_key(int joint) const
{
    if (const GltfFile* gltf = std::get_if<GltfFile>(&file_)) formats::require_can_key(*gltf, joint);
}

void MotionFile::write(const OutPlace& out, std::span<const formats::RotationOverride> overrides) const
{
    if (const GltfFile* gltf = std::get_if<GltfFile>(&file_))
        formats::write_gltf(out.path, *gltf, overrides, out.suffix != ".gltf");
    else
        formats::write_bvh(out.path, std::get<BvhFile>(file_), overrides);
}

}  // namespace swivel::tools
