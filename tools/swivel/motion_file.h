// SPDX-License-Identifier: MIT
//
// A file with a skeleton and its motion, whatever its format: the one place of the command that tells formats apart.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/formats/bvh.h"
#include "tools/formats/gltf.h"
#include "tools/rig/limbs.h"
#include "tools/rig/standing_rest.h"
#include "tools/swivel/commands.h"

namespace swivel::tools {

class MotionFile {
public:
    // Reads a file, or standard input ("-"), as glTF or BVH. Its first bytes say which; its name says nothing.
    // Throws InputError as the readers do, and CommandError (bad usage) for a choice that a BVH file does not have.
    // The clip has no frames until sample().
    MotionFile(const std::filesystem::path& path, const MotionChoice& choice);

    // Finds the joints of the chosen limbs, makes the clip's frames for them, and fixes its rest pose. Throws
    // InputError as choose_joints() and the next two do. choice: must outlive the result.
    FigureJoints find_limbs(const LimbChoice& choice);

    // Makes the clip's frames, for limbs of these joints; throws InputError as formats::sample() does. A BVH file has
    // its frames already.
    void sample(std::span<const int> limb_joints);

    // Replaces the clip's rest pose by a standing one if need be: see stand_at_rest(). First gives it the clip's size,
    // by size_at_rest(), unless the motion will be replaced. Throws InputError.
    void fix_rest_pose(const KnownLimbs& limbs, bool is_replaced = false);

    // Drops all but the first frames, for a motion that will not be written. frame_count: at most the clip's.
    void cut(std::size_t frame_count);
    // Takes another motion of the clip's joints. The file's own keys stay; write() writes the keys it is given.
    void replace(formats::Clip clip);

    const formats::Clip& clip() const
    {
        return std::visit([](const auto& file) -> const formats::Clip& { return file.clip; }, file_);
    }
    // The files that it refers to, such as a glTF file's buffers and images.
    std::vector<std::filesystem::path> files_beside() const;
    // The GLB from which a viewer draws the figure, as formats::figure_glb() makes it; empty where the file has no
    // mesh.
    std::string figure_glb() const;
    // Describes the clip for people: "glTF, animation 0 'Walk' of 3", "BVH", "glTF without animation: its rest pose".
    std::string describe() const;
    // Whether the format says that lengths are metres, as glTF does.
    bool is_in_metres() const { return gltf() != nullptr; }
    // False for a glTF file without an animation: the clip is its rest pose.
    bool has_motion() const { return !gltf() || gltf()->animation >= 0; }
    // Notes for the user on how the file was read, a line each; mostly none.
    std::vector<std::string> notes() const;
    // The suffix of a file that can hold this motion: its own, or .bvh or .glb where it has another.
    std::string suffix() const;
    // Throws CommandError (bad usage) for an output file that cannot hold this motion. is_target: the motion comes from
    // another file. others: formats that the command writes besides, for the message.
    void require_can_write(const std::filesystem::path& out, bool is_target = false,
                           std::string_view others = {}) const;
    // Throws InputError for a joint whose rotation the file cannot store.
    void require_can_key(int joint) const;
    bool can_key(int joint) const;  // whether it would not throw
    // In the format that the suffix of `out` says; as write_bvh() and write_gltf() do.
    void write(const std::filesystem::path& out, std::span<const formats::JointKeys> keys,
               const std::optional<formats::NewFrames>& frames = {},
               const std::optional<formats::NewJoint>& above = {}) const;
    // One character, or with new frames a crowd in a glTF file, below nodes of the characters' names. A character alone
    // may be without a name, and then has no such node.
    void write(const std::filesystem::path& out, std::span<const formats::GltfCharacter> characters,
               const std::optional<formats::NewFrames>& frames) const;

private:
    const formats::GltfFile* gltf() const { return std::get_if<formats::GltfFile>(&file_); }  // null: it is BVH
    formats::Clip& own_clip()
    {
        return std::visit([](auto& file) -> formats::Clip& { return file.clip; }, file_);
    }

    std::variant<formats::BvhFile, formats::GltfFile> file_;
    std::filesystem::path path_;
    RestChoice rest_;
    std::array<std::string, 2> rest_notes_;  // empty: there is nothing to say
};

// Whether files with this suffix, in lower case, are of one of these formats.
inline bool is_bvh(std::string_view suffix) { return suffix == ".bvh"; }
inline bool is_gltf(std::string_view suffix) { return suffix == ".glb" || suffix == ".gltf" || suffix == ".vrm"; }

}  // namespace swivel::tools
