// SPDX-License-Identifier: MIT
//
// BVH: any text is read or refused in one line. What is read has a sound clip, is written byte for byte, and keeps its
// rotations when they are written as new ones.
#include <array>
#include <cstdint>

#include "tests/fuzz/check_clip.h"
#include "tests/fuzz/scratch_folder.h"
#include "tools/formats/bvh.h"

using namespace swivel::formats;
using namespace swivel::fuzz;

namespace {

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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const ScratchFolder folder;
    BvhFile file;
    try {
        file = read_bvh(folder.spill("in.bvh", text_of(data, size)));
    } catch (const InputError& error) {
        check_message(error);
        return 0;
    }
    check_clip(file.clip);
    check_writing(file, folder.path / "out.bvh");
    return 0;
}
