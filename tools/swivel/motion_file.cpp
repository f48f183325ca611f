// SPDX-License-Identifier: MIT
#include "tools/swivel/motion_file.h"

#include <fmt/format.h>

#include "tools/formats/text.h"
#include "tools/swivel/command_error.h"

namespace swivel::tools {

namespace {

using formats::BvhFile;
using formats::GltfFile;

std::variant<BvhFile, GltfFile> read(const std::filesystem::path& path, const MotionChoice& choice)
{
    if (is_gltf(path)) return formats::read_gltf(path, {choice.clip, choice.rate});
    if (!choice.clip.empty()) throw CommandError(2, "--clip chooses an animation of a glTF file; a BVH file has one");
    if (choice.rate > 0) throw CommandError(2, "--fps samples a glTF file; a BVH file has frames of its own");
    return formats::read_bvh(path);
}

}  // namespace

bool is_bvh(const std::filesystem::path& path) { return path.extension() == ".bvh"; }

bool is_gltf(const std::filesystem::path& path)
{
    const std::filesystem::path suffix = path.extension();
    return suffix == ".glb" || suffix == ".gltf" || suffix == ".vrm";
}

MotionFile::MotionFile(const std::filesystem::path& path, const MotionChoice& choice) : file_(read(path, choice)) {}

const formats::Clip& MotionFile::clip() const
{
    return std::visit([](const auto& file) -> const formats::Clip& { return file.clip; }, file_);
}

std::string MotionFile::describe() const
{
    const GltfFile* gltf = std::get_if<GltfFile>(&file_);
    if (!gltf) return "BVH";
    if (gltf->animation < 0) return "glTF without animation: its rest pose";
    const std::string& name = gltf->animation_names[static_cast<std::size_t>(gltf->animation)];
    return fmt::format("glTF, animation {}{} of {}", gltf->animation,
                       name.empty() ? "" : fmt::format(" '{}'", formats::printable(name)),
                       gltf->animation_names.size());
}

std::size_t MotionFile::mended_vertex_count() const
{
    const GltfFile* gltf = std::get_if<GltfFile>(&file_);
    return gltf ? formats::mended_vertex_count(*gltf) : 0;
}

void MotionFile::require_can_write(const std::filesystem::path& path) const
{
    const bool is_own = std::holds_alternative<GltfFile>(file_) ? is_gltf(path) : is_bvh(path);
    if (!is_own)
        throw CommandError(
            2, fmt::format("--out {}: this clip is {}; its poses go to {} or .csv", path.string(),
                           is_bvh(path) ? "a glTF file" : "a BVH file", is_bvh(path) ? ".glb, .gltf" : ".bvh"));
}

void MotionFile::write(const std::filesystem::path& path, std::span<const formats::RotationOverride> overrides) const
{
    if (const GltfFile* gltf = std::get_if<GltfFile>(&file_))
        formats::write_gltf(path, *gltf, overrides);
    else
        formats::write_bvh(path, std::get<BvhFile>(file_), overrides);
}

}  // namespace swivel::tools
