// SPDX-License-Identifier: MIT
#include "tools/swivel/motion_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "tools/cli/command_error.h"
#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"
#include "tools/rig/name_search.h"

namespace swivel::tools {

namespace {

using formats::BvhFile;
using formats::GltfFile;

using Motion = std::variant<BvhFile, GltfFile>;

// A GLB's header, which says its length. Nothing beyond it may be read yet: from a pipe, it may never come.
constexpr std::size_t kGlbHead = 12;
// A text shows its format within this, even after blank lines.
constexpr std::size_t kTextHead = 4096;
constexpr std::size_t kShownHead = 20;  // bytes of it in a message

// The file's first bytes, by which formats are told apart.
std::string read_begin(const std::filesystem::path& path, std::FILE* input)
{
    std::string begin;
    formats::append_bytes(path, input, kGlbHead, begin);
    if (!formats::is_gltf_begin(begin)) formats::append_bytes(path, input, kTextHead - kGlbHead, begin);
    if (begin.empty()) throw formats::InputError(path, "is empty; check how it was written");
    return begin;
}

Motion read(const std::filesystem::path& path, const MotionChoice& choice)
{
    const formats::TextFile input = formats::open_text(path);
    std::string begin = read_begin(path, input.get());
    if (formats::is_gltf_begin(begin)) {
        formats::GltfContainer container = formats::read_gltf_container(path, input.get(), std::move(begin));
        return formats::read_gltf(path, std::move(container), {choice.clip, choice.rate});
    }
    if (!formats::is_bvh_text(begin))
        throw formats::InputError(
            path, fmt::format("begins with '{}'; swivel reads BVH, which begins with HIERARCHY, and glTF, which begins "
                              "with glTF or {{; export the file as glTF, for example from Blender",
                              formats::printable(begin, kShownHead)));
    if (!choice.clip.empty())
        throw CommandError(2, "--clip chooses an animation of a glTF file; a BVH file has one; leave it out");
    BvhFile file = formats::bvh_of(path, formats::read_text(path, input.get(), std::move(begin)));
    return choice.rate > 0 ? formats::at_rate(file, choice.rate) : std::move(file);
}

}  // namespace

MotionFile::MotionFile(const std::filesystem::path& path, const MotionChoice& choice)
    : file_(read(path, choice)), path_(path), rest_(choice.rest)
{
}

FigureJoints MotionFile::find_limbs(const LimbChoice& choice)
{
    const FigureJoints figure = choose_joints(clip(), path_, choice);
    sample(joints_of(figure));
    fix_rest_pose(known_limbs(figure));
    return figure;
}

void MotionFile::sample(std::span<const int> limb_joints)
{
    if (GltfFile* gltf = std::get_if<GltfFile>(&file_)) formats::sample(*gltf, limb_joints);
}

void MotionFile::fix_rest_pose(const KnownLimbs& limbs, bool is_replaced)
{
    try {
        if (!is_replaced) rest_notes_[0] = size_at_rest(own_clip(), limbs);
        rest_notes_[1] = stand_at_rest(own_clip(), limbs, rest_);
    } catch (const CannotBind& fault) {
        throw formats::InputError(path_, fmt::format("{}; {}", fault.what(), fault.advice));
    }
}

void MotionFile::cut(std::size_t frame_count) { formats::keep_frames(own_clip(), frame_count); }

void MotionFile::replace(formats::Clip clip) { own_clip() = std::move(clip); }

std::vector<std::filesystem::path> MotionFile::files_beside() const
{
    if (!gltf()) return {};
    return gltf()->files_beside;
}

std::string MotionFile::figure_glb() const { return gltf() ? formats::figure_glb(*gltf()) : std::string(); }

std::string MotionFile::describe() const
{
    if (!gltf()) return "BVH";
    if (!has_motion()) return "glTF without animation: its rest pose";
    const std::vector<std::string>& names = gltf()->animation_names;
    const std::string& name = names[static_cast<std::size_t>(gltf()->animation)];
    return fmt::format("glTF, animation {}{} of {}", gltf()->animation,
                       name.empty() ? "" : fmt::format(" '{}'", formats::printable(name)), names.size());
}

std::vector<std::string> MotionFile::notes() const
{
    std::vector<std::string> notes;
    std::ranges::copy_if(rest_notes_, std::back_inserter(notes), [](const auto& note) { return !note.empty(); });
    const BvhFile* bvh = std::get_if<BvhFile>(&file_);
    if (bvh && bvh->surplus_count > 0) {
        const std::size_t count = bvh->announced_count;
        notes.push_back(
            fmt::format("the file has {} rows of values, and Frames: in line {} says {}; the last {} {} left out",
                        count + bvh->surplus_count, bvh->frames_line, count, bvh->surplus_count,
                        bvh->surplus_count == 1 ? "is" : "are"));
    }
    const std::vector<bool> is_repeated = repeated_joints(clip());
    std::size_t figures = 1;
    for (std::size_t n = 0; n < is_repeated.size(); ++n) figures += is_repeated[n] && clip().joints[n].parent < 0;
    if (figures > 1) notes.push_back(fmt::format("the file has {} figures alike; the first of them counts", figures));
    return notes;
}

void MotionFile::require_can_write(const std::filesystem::path& out, bool is_target, std::string_view others) const
{
    const std::string suffix = formats::lower_suffix(out);
    if (gltf() ? is_gltf(suffix) : is_bvh(suffix)) return;
    throw CommandError(
        2, fmt::format(
               "--out {}: {} is a {} file; its poses go to {}{}{}", out.string(), is_target ? "TARGET" : "this clip",
               gltf() ? "glTF" : "BVH", gltf() ? ".glb, .gltf, .vrm" : ".bvh", others,
               is_gltf(suffix) && !is_target ? "; swivel retarget puts its motion on the figure of a glTF file" : ""));
}

void MotionFile::require_can_key(int joint) const
{
    std::visit([joint](const auto& file) { formats::require_can_key(file, joint); }, file_);
}

std::string MotionFile::suffix() const
{
    if (!gltf()) return ".bvh";
    const std::string own = formats::lower_suffix(path_);
    return is_gltf(own) ? own : ".glb";
}

bool MotionFile::can_key(int joint) const
{
    try {
        require_can_key(joint);
        return true;
    } catch (const formats::InputError&) {
        return false;
    }
}

void MotionFile::write(const std::filesystem::path& out, std::span<const formats::JointKeys> keys,
                       const std::optional<formats::NewFrames>& frames,
                       const std::optional<formats::NewJoint>& above) const
{
    if (gltf())
        formats::write_gltf(out, *gltf(), keys, frames, formats::lower_suffix(out) != ".gltf", above);
    else
        formats::write_bvh(out, std::get<BvhFile>(file_), keys, frames, above);
}

void MotionFile::write(const std::filesystem::path& out, std::span<const formats::GltfCharacter> characters,
                       const std::optional<formats::NewFrames>& frames) const
{
    if (characters.size() > 1 || !characters.front().name.empty())
        formats::write_gltf_crowd(out, std::get<GltfFile>(file_), characters, *frames);
    else
        write(out, characters.front().keys, frames);
}

}  // namespace swivel::tools
