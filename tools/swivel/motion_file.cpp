// SPDX-License-Identifier: MIT
#include "tools/swivel/motion_file.h"

#include <fmt/format.h>

#include "tools/formats/error.h"
#include "tools/formats/scene_import.h"
#include "tools/formats/text.h"
#include "tools/swivel/command_error.h"

namespace swivel::tools {

namespace {

using formats::BvhFile;
using formats::GltfFile;

std::variant<BvhFile, GltfFile> read(const std::filesystem::path& path, const MotionChoice& choice)
{
    if (is_gltf(path)) return formats::read_gltf(path, {choice.clip, choice.rate});
    if (formats::is_scene(path))
        return formats::read_gltf(path, formats::import_scene(path), {choice.clip, choice.rate});
    if (!choice.clip.empty())
        throw CommandError(2, "--clip chooses an animation of a glTF, FBX or DAE file; a BVH file has one");
    if (choice.rate > 0)
        throw CommandError(2, "--fps samples a glTF, FBX or DAE file; a BVH file has frames of its own");
    try {
        return formats::read_bvh(path);
    } catch (const formats::InputError& fault) {
        if (is_bvh(path) || !std::filesystem::is_regular_file(path)) throw;
        throw CommandError(1, fmt::format("{} (read as BVH: names of other formats end in .glb, .gltf, .vrm, .fbx or "
                                          ".dae)",
                                          fault.what()));
    }
}

const char* format_of(const std::filesystem::path& path)
{
    const std::string suffix = formats::lower_suffix(path);
    return is_gltf(path) ? "glTF" : suffix == ".fbx" ? "FBX" : suffix == ".dae" ? "DAE" : "BVH";
}

}  // namespace

bool is_bvh(const std::filesystem::path& path) { return formats::lower_suffix(path) == ".bvh"; }

bool is_gltf(const std::filesystem::path& path)
{
    const std::string suffix = formats::lower_suffix(path);
    return suffix == ".glb" || suffix == ".gltf" || suffix == ".vrm";
}

MotionFile::MotionFile(const std::filesystem::path& path, const MotionChoice& choice)
    : file_(read(path, choice)), format_(format_of(path))
{
}

const formats::Clip& MotionFile::clip() const
{
    return std::visit([](const auto& file) -> const formats::Clip& { return file.clip; }, file_);
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

std::size_t MotionFile::mended_vertex_count() const
{
    const GltfFile* gltf = std::get_if<GltfFile>(&file_);
    return gltf ? formats::mended_vertex_count(*gltf) : 0;
}

void MotionFile::require_can_write(const std::filesystem::path& path) const
{
    const bool is_bvh_clip = std::holds_alternative<BvhFile>(file_);
    if (is_bvh_clip ? !is_bvh(path) : !is_gltf(path))
        throw CommandError(2,
                           fmt::format("--out {}: this clip is {} {} file; its poses go to {} or .csv", path.string(),
                                       format_ == "FBX" ? "an" : "a", format_, is_bvh_clip ? ".bvh" : ".glb, .gltf"));
}

void MotionFile::require_can_key(int joint) const
{
    if (const GltfFile* gltf = std::get_if<GltfFile>(&file_)) formats::require_can_key(*gltf, joint);
}

void MotionFile::write(const std::filesystem::path& path, std::span<const formats::RotationOverride> overrides) const
{
    if (const GltfFile* gltf = std::get_if<GltfFile>(&file_))
        formats::write_gltf(path, *gltf, overrides);
    else
        formats::write_bvh(path, std::get<BvhFile>(file_), overrides);
}

}  // namespace swivel::tools
