// SPDX-License-Identifier: MIT
// A whole motion written into a file: other frames, all joints, translations. What is written to glTF is posed by
// plain_gltf.h, which shares no code with readers and writers. test_retarget_clips.cpp does so with BVH.

#include <catch2/catch.hpp>

#include <algorithm>

#include "tests/bvh_samples.h"
#include "tests/complaint.h"
#include "tests/gltf_clip.h"
#include "tests/gltf_judges.h"
#include "tests/plain_gltf.h"
#include "tests/shared_figures.h"
#include "tests/test_data.h"
#include "tools/formats/bvh.h"

using namespace swivel::formats;
using namespace swivel::test;
using Catch::Matchers::Contains;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr std::size_t kStep = 3;  // of the clip's frames

// Every third frame of a clip, last one first, as new keys of all joints.
struct Backwards {
    std::vector<std::vector<Quaterniond>> rotation;
    std::vector<std::vector<Vector3d>> translation;
    std::vector<std::size_t> frames;  // of the clip

    explicit Backwards(const Clip& clip) : rotation(clip.joints.size()), translation(clip.joints.size())
    {
        for (std::size_t n = clip.frame_count; n-- > 0;)
            if (n % kStep == 0) frames.push_back(n);
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint)
            for (const std::size_t frame : frames) {
                rotation[joint].push_back(clip.rotation[frame * clip.joints.size() + joint]);
                if (clip.joints[joint].track >= 0) translation[joint].push_back(local_translation(clip, frame, joint));
            }
    }
    std::vector<JointKeys> keys(const auto& can_turn) const
    {
        std::vector<JointKeys> keys;
        for (std::size_t joint = 0; joint < rotation.size(); ++joint)
            if (can_turn(joint)) keys.push_back({static_cast<int>(joint), rotation[joint], translation[joint]});
        return keys;
    }
    NewFrames new_frames() const { return {frames.size(), 0.04, "walk \"home\""}; }
};

}  // namespace

TEST_CASE("new frames: what has no keys rests in BVH; what cannot hold them is refused")
{
    const TempFolder folder;
    const BvhFile file = read(folder, kTiny);
    const std::vector<Vector3d> place(3, Vector3d(-7, 0.125, 1e-10));
    const std::vector<Quaterniond> turned(3, Quaterniond(turn('X', 50)));
    write_bvh(folder / "w.bvh", file, {{{0, {}, place}}}, NewFrames{3, 0.25});
    const std::string row = "-7.000000000 0.125000000 0.000000000 0 0 0 0 0 0\n";
    CHECK(slurp(folder / "w.bvh") ==
          kTiny.substr(0, kTiny.find("Frames:")) + "Frames: 3\nFrame Time: 0.25\n" + row + row + row);
    write_bvh(folder / "w.bvh", file, {{{1, turned}}}, NewFrames{3, 0.25});
    CHECK_THAT(slurp(folder / "w.bvh"), Contains("\n1 2 3 0 0 0 0.000000000 50.000000000 0.000000000\n"));
    CHECK(complaint_of(folder, [&] {
              write_bvh(folder / "x.bvh", file, {{{1, {}, place}}}, NewFrames{3, 1});
          }) == "t.bvh:9: joint 'Arm' cannot take a new position: it has fewer than three position channels");
    CHECK_THROWS_AS(write_bvh(folder / "x.bvh", file, {{{0, {}, place}}}, NewFrames{2, 1}), std::invalid_argument);
    const std::vector<Vector3d> endless(3, Vector3d(0, HUGE_VAL, 0));
    CHECK_THROWS_AS(write_bvh(folder / "x.bvh", file, {{{0, {}, endless}}}, NewFrames{3, 1}), std::invalid_argument);
    CHECK_FALSE(fs::exists(folder / "x.bvh"));
}

TEST_CASE("new frames: a position in a clip's own frames leaves its other numbers alone")
{
    const TempFolder folder;
    const BvhFile file = read(folder, kTiny);
    const std::vector<Vector3d> place = {{1, 2, 3}, {4, 5, 6}};
    write_bvh(folder / "w.bvh", file, {{{0, {}, place}}});
    CHECK(slurp(folder / "w.bvh") == edited(edited(kTiny, "\n10 20 30 90", "\n1.000000000 2.000000000 3.000000000 90"),
                                            "\n10 20 30 0", "\n4.000000000 5.000000000 6.000000000 0"));
}

TEST_CASE("new frames: a glTF file keeps all but the chosen animation")
{
    const TempFolder folder;
    for (const SharedFigure& figure : kSharedFigures) {
        const fs::path path = find_or_warn(figure.name);
        if (path.empty()) continue;
        for (const char* to : {"new.glb", "new.gltf"}) {
            INFO(figure.name << " to " << to);
            const GltfFile file = read_clip(path);
            const Backwards motion(file.clip);
            const PlainGltf before = plain_gltf_of(path);
            const auto is_skinless = [&](std::size_t joint) {  // skinned meshes do not follow their nodes
                return !before.nodes()[static_cast<std::size_t>(file.clip.joints[joint].number)].contains("skin");
            };
            write_gltf(folder / to, file, motion.keys(is_skinless), motion.new_frames());
            const PlainGltf after = plain_gltf_of(folder / to);
            for (const char* list : {"meshes", "skins", "materials", "scenes"})
                CHECK(after.json.value(list, nlohmann::json()) == before.json.value(list, nlohmann::json()));
            const std::size_t count = before.json.value("animations", nlohmann::json::array()).size();
            REQUIRE(after.json["animations"].size() == std::max<std::size_t>(count, 1));
            for (std::size_t n = 1; n < count; ++n) CHECK(after.json["animations"][n] == before.json["animations"][n]);
            CHECK(after.json["animations"][0]["name"] == "walk \"home\"");
            double off = 0, size = 0;
            for (std::size_t n = 0; n < motion.frames.size(); ++n)
                for (const Joint& joint : file.clip.joints) {
                    const Eigen::Affine3d from = plain_world(before, file.animation, joint.number,
                                                             static_cast<double>(file.times[motion.frames[n]]));
                    const Eigen::Affine3d is = plain_world(after, 0, joint.number, 0.04 * static_cast<double>(n));
                    off = std::max(off, (from.matrix() - is.matrix()).norm());
                    size = std::max(size, from.matrix().norm());
                }
            CHECK(off < 1e-5 * size);  // keys are floats
            std::multiset<std::string> messages = new_gltf_messages(path, folder / to);
            messages.erase("DATA_URI_GLB /images/0/uri");  // of a .gltf, kept in the .glb
            CHECK(messages == std::multiset<std::string>());
        }
    }
}
