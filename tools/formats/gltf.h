#pragma once
// SPDX-License-Identifier: MIT
// glTF 2.0 and GLB. Reading takes the node hierarchy as a skeleton and one animation as its motion. Writing puts new
// keys into that animation; everything else of the asset stays as it is. Conventions:
// - Every node is a joint, so that nodes above a skeleton count, such as an armature with its scale. Nodes that a
//   skin names are bones; in a file without skins all are. A joint's number is its node's index; an unnamed node is
//   "#12".
// - The rest pose is the nodes' own transforms. A matrix becomes translation, rotation and scale.
// - Frames are the times at which the limbs' joints, or joints above them, have keys, each time once. A rate that is
//   asked for samples the whole animation instead.
// - Without keys the clip is one frame. Writing to a file without an animation adds one of one key.
// No mesh or image is read; of animations only nodes' own poses. All else is kept.

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/clip.h"
#include "tools/formats/gltf_container.h"
#include "tools/formats/joint_keys.h"

namespace swivel::formats {

enum class Interpolation : std::uint8_t { step, linear, cubic };

// Keyframes of glTF 2.0 (specification, appendix C: STEP, LINEAR with the shorter arc for rotations, CUBICSPLINE). The
// first key's value holds before it, the last key's after it.
struct GltfSampler {
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> time;            // seconds, strictly increasing, at least one
    std::vector<Eigen::Vector4d> value;  // one per key, or with cubic three: in-tangent, value, out-tangent
};

// The sampler's rotation at a time, values being x, y, z, w: a unit quaternion; zero where a spline passes through
// zero.
Eigen::Quaterniond sample_rotation(const GltfSampler& sampler, double time);

// Whether the sampler's value changes: keys differ, or tangents between them lead away and back.
bool is_moving(const GltfSampler& sampler);

enum class GltfPath : std::uint8_t { translation, rotation, scale };

struct GltfChannel {
    int joint = -1;  // of the clip
    GltfPath path = GltfPath::rotation;
    std::size_t sampler = 0;  // in GltfFile::samplers; channels may share one
};

struct GltfChoice {
    std::string animation = {};  // name or, counted from 0, index; empty: the first
    double rate = 0;             // frames a second, 0: see above
    // The max memory of decoded keys, and of sampled poses.
    std::size_t max_pose_bytes = std::size_t{8} << 30;
};

struct GltfFile {
    std::filesystem::path path;  // where it was read
    GltfChoice choice;
    std::vector<std::filesystem::path> files_beside;           // the files that it refers to, whether they exist or not
    GltfContainer container;                                   // the whole file, but for its chunk of bytes
    std::vector<std::string_view> buffers;                     // contents of the file's buffers, wherever they are kept
    std::vector<std::shared_ptr<const std::string>> contents;  // the memory that `buffers` points into
    std::vector<std::string> animation_names;                  // of all animations; may be empty or repeat
    int animation = -1;                                        // the chosen one; -1: there is none
    std::vector<GltfChannel> channels;                         // of that animation, those of nodes' own poses
    std::vector<GltfSampler> samplers;                         // of these channels, each once
    std::vector<float> times;                                  // of the clip's frames, strictly increasing seconds
    Clip clip;                                                 // without frames until sample()
};

inline double gibibytes(std::size_t bytes) { return static_cast<double>(bytes) / 0x1p30; }

// Reads and checks a whole file, but for its frames. Throws InputError for
// - anything malformed that concerns the skeleton or the chosen animation;
// - numbers that are not finite;
// - buffers that are missing, compressed or shorter than they say;
// - buffers that are neither in the file nor in plain files in its folder;
// - an animation that does not exist, or whose name is not unique;
// - buffers beyond 8 GiB, and keys beyond the choice's most.
// Meshes make it fail only if an accessor, buffer view or buffer has members of a wrong type.
// It holds the file once, a GLB twice while it takes it apart, and its JSON as a document while it reads. A key takes
// 40 bytes, with CUBICSPLINE 104; channels may share keys.
GltfFile read_gltf(const std::filesystem::path& path, const GltfChoice& choice = {});

// The same for a container in memory. path: its name in messages, beside which its files lie.
GltfFile read_gltf(const std::filesystem::path& path, GltfContainer container, const GltfChoice& choice);

// Makes the clip's frames, for limbs of these joints; see above for their times. A rate that the animation's length
// does not fit is adjusted, so that its last key is a frame: 1.7 s at 24 a second are 42 frames, at 24.1 a second.
// Throws InputError for
// - more poses than the choice's most, before it makes room;
// - a spline of rotations that passes through zero;
// - a joint of a limb, or one above, farther from the origin or larger than the solver holds (kMaxNorm).
// A frame takes 32 bytes a joint, and 24 for each translation and scale that has keys.
void sample(GltfFile& file, std::span<const int> limb_joints);

// Throws InputError for a joint whose matrix is sheared, because keys have no shear. joint: of the clip.
void require_can_key(const GltfFile& file, int joint);

// Writes `file` with these keys in place of the joints' own, at the clip's frames. A new joint is a node, and a joint
// of the skins that move the joint below it; it goes by STEP if that one does. A joint's keys go by STEP if its own
// rotations moved by steps, else LINEAR; a joint that did not turn goes by steps if all that did so did. With new
// frames the animation has these keys alone, LINEAR from time 0 on, and is given their name. Where several frames' keys
// lie apart, a viewer turns each joint evenly in between. All other JSON is kept value by value, all buffers byte by
// byte; keys that are no longer used stay in them. Joints whose node has a matrix get translation, rotation and scale
// instead, as animated nodes must. path: .glb or .gltf; may be the file that was read; appears whole or not at all (see
// OutputFile). binary: whether it is a .glb, where the path's suffix does not say it. A .glb takes in all buffers, one
// after the other. A .gltf holds the new keys itself. All other files that were referred to are, from wherever the new
// file is written; none is opened. Throws InputError on writing, and as require_can_key() does. Throws
// std::invalid_argument as require_keys() does.
void write_gltf(const std::filesystem::path& path, const GltfFile& file, std::span<const JointKeys> keys,
                const std::optional<NewFrames>& frames = {}, std::optional<bool> binary = {},
                const std::optional<NewJoint>& above = {});

// A GLB for a viewer: the file without its animations, with all buffers in it. Images beside the file stay there. Empty
// if the file has no mesh. Throws InputError for more than a GLB holds.
std::string figure_glb(const GltfFile& file);

// One character of a crowd in a file.
struct GltfCharacter {
    std::string name;       // of its node
    Eigen::Vector3d place;  // of the file's origin
    double size = 1;        // of all of it, above 0
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    std::vector<JointKeys> keys = {};  // at the new frames
};

// Writes a copy of the figure for each character, below a node of its own. One animation of all of them replaces the
// file's, because most viewers play only the first. Nodes rest in the first frame. Each figure has its own nodes and
// skins; meshes, materials and images are shared. Otherwise as write_gltf(). characters: one or more.
void write_gltf_crowd(const std::filesystem::path& path, const GltfFile& file,
                      std::span<const GltfCharacter> characters, const NewFrames& frames);

}  // namespace swivel::formats
