// SPDX-License-Identifier: MIT
//
// The writer of glTF. New rotations are where they belong. Everything else is as it was, value by value and byte by
// byte. Khronos' validator and three.js read the result.
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "tests/gltf_clip.h"
#include "tests/gltf_judges.h"
#include "tests/gltf_rig.h"
#include "tests/plain_gltf.h"
#include "tests/shared_figures.h"
#include "tools/formats/error.h"
#include "tools/formats/gltf.h"

using namespace swivel::test;
using namespace std::literals;
using namespace swivel::formats;
using Eigen::Quaterniond;
using nlohmann::json;

namespace {

constexpr std::string_view kPixel =  // a PNG of one pixel
    "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\6\0\0\0\x1f\x15\xc4\x89\0\0\0\rIDAT\x78\xda\x63\x64\xf8\xcf\x50"
    "\x0f\0"
    "\3\x86\1\x80\x5a\x34\x7d\x6b\0\0\0\0IEND\xae\x42\x60\x82"sv;

// A skeleton of four with a mesh, a material with a picture, extras and an extension nobody knows.
GltfRig furnished_rig()
{
    GltfRig rig;
    const int hips = rig.add("hips", -1, {0, 1, 0}), arm = rig.add("arm", hips, {0.2, 0.3, 0}),
              fore = rig.add("fore", arm, {0.3, 0, 0}), hand = rig.add("hand", fore, {0.25, 0, 0});
    rig.json["nodes"][static_cast<std::size_t>(fore)] = {
        {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.3, 0, 0, 1}},
        {"children", {hand}},
        {"extras", {{"note", "1.10 kept"}, {"deep", {1, 2.5, nullptr}}}}};
    const int wave = rig.add_animation("wave"), rest = rig.add_animation("rest");
    const std::vector<float> times = {0, 0.5f, 1};
    rig.add_keys(wave, arm, "rotation", times, {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1}, "STEP");
    rig.add_keys(wave, hips, "translation", times, {0, 1, 0, 0, 2, 0, 0, 1, 0});
    rig.add_keys(rest, arm, "rotation", times, {0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 1});
    // The hand shares the arm's sampler.
    rig.json["animations"][0]["channels"].push_back(
        {{"sampler", 0}, {"target", {{"node", hand}, {"path", "rotation"}}}});
    rig.json["animations"][0]["samplers"][0]["extras"] = "sampler's own";
    rig.json["images"] = {{{"uri", "pic%20ture.png"}}};
    rig.json["textures"] = {{{"source", 0}}};
    rig.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0.1}}}}};
    rig.json["extensionsUsed"] = {"VENDOR_unknown"};
    rig.json["extensions"] = {{"VENDOR_unknown", {{"answer", 42}}}};
    const int positions = rig.add_accessor({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    auto& accessor = rig.json["accessors"][static_cast<std::size_t>(positions)];
    accessor["min"] = {0, 0, 0};
    accessor["max"] = {1, 1, 0};
    const int uv = rig.add_accessor({0, 0, 1, 0, 0, 1}, "VEC2", 2);
    rig.json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uv}}}, {"material", 0}}}}}};
    rig.json["nodes"][0]["mesh"] = 0;
    return rig;
}

std::vector<Quaterniond> turns(std::size_t count, double step)
{
    std::vector<Quaterniond> all;
    for (std::size_t n = 0; n < count; ++n) {
        const double angle = step * static_cast<double>(n + 1);
        all.emplace_back(-std::cos(angle), 0, std::sin(angle), 0);
        if (n % 2) all.back().coeffs() *= -3;  // same rotations, on any side and of any length
    }
    return all;
}

int joint_of(const GltfFile& file, int node) { return find_joints(file.clip, "#" + std::to_string(node)).at(0); }

// Every third frame of a clip, last one first, as new keys of all nodes but skinned meshes, which do not follow theirs.
struct Backwards {
    std::vector<std::size_t> frames = {};  // of the clip
    std::vector<std::vector<Quaterniond>> rotation;
    std::vector<std::vector<Eigen::Vector3d>> translation;
    std::vector<JointKeys> keys = {};

    Backwards(const Clip& clip, const json& nodes) : rotation(clip.joints.size()), translation(clip.joints.size())
    {
        for (std::size_t n = clip.frame_count; n-- > 0;)
            if (n % 3 == 0) frames.push_back(n);
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
            if (nodes[static_cast<std::size_t>(clip.joints[joint].number)].contains("skin")) continue;
            for (const std::size_t frame : frames) {
                rotation[joint].push_back(clip.rotation[frame * clip.joints.size() + joint]);
                if (clip.joints[joint].track >= 0) translation[joint].push_back(local_translation(clip, frame, joint));
            }
            keys.push_back({static_cast<int>(joint), rotation[joint], translation[joint]});
        }
    }
};

// What must survive of a file: its JSON without what the writer owns.
json kept(json whole, std::size_t accessors, std::size_t views)
{
    whole.erase("buffers");
    whole.erase("images");
    whole["animations"][0].erase("samplers");
    whole["animations"][0].erase("channels");
    whole["nodes"][2] = {{"children", whole["nodes"][2]["children"]}, {"extras", whole["nodes"][2]["extras"]}};
    whole["accessors"].get_ref<json::array_t&>().resize(accessors);
    whole["bufferViews"].get_ref<json::array_t&>().resize(views);
    return whole;
}

}  // namespace

TEST_CASE("gltf write: rotations go in, all else stays, in every shape of file")
{
    const TempFolder folder;
    fs::create_directory(folder / "in");
    fs::create_directory(folder / "out put");
    const GltfRig rig = furnished_rig();
    rig.write(folder / "in/rig.gltf");
    rig.write(folder / "in/rig.glb");
    spill(folder / "in/pic ture.png", kPixel);
    for (const char* from : {"in/rig.gltf", "in/rig.glb"})
        for (const char* to : {"out put/new.gltf", "out put/new.glb", "in/new.gltf"}) {
            INFO(from << " to " << to);
            const GltfFile file = read_clip(folder / from, {"wave", 2});
            const auto arm = turns(3, 0.4), fore = turns(3, -0.3), hand = turns(3, 0.1);
            const JointKeys changes[] = {
                {joint_of(file, 1), arm}, {joint_of(file, 2), fore}, {joint_of(file, 3), hand}};
            write_gltf(folder / to, file, changes);
            const PlainGltf before = plain_gltf_of(folder / from), after = plain_gltf_of(folder / to);
            const std::size_t accessors = rig.json["accessors"].size(), views = rig.json["bufferViews"].size();
            json wanted = kept(before.json, accessors, views), found = kept(after.json, accessors, views);
            CHECK(found == wanted);
            CHECK(after.buffers[0].substr(0, rig.bytes.size()) == rig.bytes);
            CHECK(after.json["animations"][1] == before.json["animations"][1]);
            CHECK(after.json["animations"][0]["channels"].size() == 4);

            for (const int node : {1, 2, 3}) {
                const std::vector<double> keys = key_times(after, node);
                CHECK(std::vector<float>(keys.begin(), keys.end()) == file.times);
            }
            const auto poses = three_poses(folder / to, 0, {0.5});
            for (std::size_t n = 0; n < 3; ++n) {
                const double time = static_cast<double>(file.times[n]);
                const auto wanted_of = [&](const Quaterniond& q) { return q.normalized().toRotationMatrix(); };
                CHECK((plain_local(after, 0, 1, time).linear() - wanted_of(arm[n])).norm() < 1e-6);
                CHECK((plain_local(after, 0, 2, time).linear() - wanted_of(fore[n])).norm() < 1e-6);
                CHECK((plain_local(after, 0, 3, time).linear() - wanted_of(hand[n])).norm() < 1e-6);
                CHECK(plain_local(after, 0, 0, time).isApprox(plain_local(before, 0, 0, time), 1e-15));
                CHECK(plain_local(after, 0, 2, time).translation() == Eigen::Vector3d(0.3, 0, 0));
            }
            CHECK((poses[0][3] - plain_world(after, 0, 3, 0.5).matrix()).norm() < 1e-5);
            CHECK(new_gltf_messages(folder / from, folder / to).empty());
            const json& image = after.json["images"][0];
            CHECK(image["uri"] ==
                  (std::string_view(to).starts_with("in/") ? "pic%20ture.png" : "../in/pic%20ture.png"));
            // The arm moved by steps and shared its sampler with the hand: each has its own now, still by steps.
            for (const auto& channel : after.json["animations"][0]["channels"])
                if (channel["target"]["path"] == "rotation")
                    CHECK(after.json["animations"][0]["samplers"][channel["sampler"].get<std::size_t>()]
                                    ["interpolation"] == "STEP");
        }
}

// Skeletons with so few or so many members that one more makes their list of members move in memory.
TEST_CASE("gltf write: keys go into files that have nothing yet to hold them")
{
    const TempFolder folder;
    const json nodes = {{{"name", "root"}, {"children", {1}}}, {{"name", "arm"}, {"translation", {1, 0, 0}}}};
    const json least = {{"asset", {{"version", "2.0"}}}, {"nodes", nodes}};
    json six = least, named = least, pictured = least;
    six.update({{"scene", 0},
                {"scenes", {{{"nodes", {0}}}}},
                {"extras", {{"a", 1}}},
                {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}}}});
    named["animations"] = {{{"name", "x"}}};
    pictured["images"] = {{{"uri", "a.png"}}, {{"uri", "a.png"}}};
    spill(folder / "a.png", kPixel);
    const std::vector<Quaterniond> turn = {Quaterniond(0, 1, 0, 0)};
    const JointKeys changes[] = {{0, turn}, {1, turn}};
    for (const json& whole : {least, six, named, pictured})
        for (const char* to : {"new.glb", "new.gltf"}) {
            INFO(whole.dump() << " to " << to);
            spill(folder / "rig.gltf", whole.dump());
            write_gltf(folder / to, read_clip(folder / "rig.gltf"), changes);
            CHECK(gltf_errors(folder / to).empty());
            const PlainGltf after = plain_gltf_of(folder / to);
            CHECK(plain_local(after, 0, 1, 0).linear().isApprox(turn[0].toRotationMatrix(), 1e-7));
            if (!whole.contains("animations")) CHECK(after.json["animations"][0]["name"] == "swivel");
            for (const auto& [name, value] : whole.items())
                if (name != "animations" && name != "images") CHECK(after.json[name] == value);
            write_gltf(folder / to, read_clip(folder / "rig.gltf"), {});
            if (whole != pictured) CHECK(plain_gltf_of(folder / to).json == whole);
        }
}

TEST_CASE("gltf write: the caller's mistakes, and a folder that is not there")
{
    const TempFolder folder;
    furnished_rig().write(folder / "rig.glb");
    const GltfFile file = read_clip(folder / "rig.glb", {"wave", 2});
    const auto good = turns(3, 1), few = turns(2, 1);
    std::vector<Quaterniond> zero = good;
    zero[1].coeffs().setZero();
    const auto write = [&](std::vector<JointKeys> changes, const char* name = "new.glb") {
        write_gltf(folder / name, file, changes);
    };
    for (const std::vector<JointKeys>& changes :
         {std::vector<JointKeys>{{99, good}}, {{-1, good}}, {{1, few}}, {{1, zero}}, {{1, good}, {1, good}}})
        CHECK_THROWS_AS(write(changes), std::invalid_argument);
    CHECK_THROWS_AS(write({{1, good}}, "no/new.glb"), InputError);
    GltfFile sheared = file;
    sheared.clip.joints[1].is_sheared = true;
    const JointKeys change[] = {{1, good}};
    CHECK_THROWS_AS(write_gltf(folder / "new.glb", sheared, change), InputError);
    CHECK(folder.file_count() == 1);
}

TEST_CASE("gltf write: a whole motion in other frames leaves all but the chosen animation as it was")
{
    const TempFolder folder;
    for (const SharedFigure& figure : kSharedFigures) {
        const fs::path path = find_or_warn(figure.name);
        if (path.empty()) continue;
        for (const char* to : {"new.glb", "new.gltf"}) {
            INFO(figure.name << " to " << to);
            const GltfFile file = read_clip(path);
            const PlainGltf before = plain_gltf_of(path);
            const Backwards motion(file.clip, before.nodes());
            write_gltf(folder / to, file, motion.keys, NewFrames{motion.frames.size(), 0.04, "walk \"home\""});
            const PlainGltf after = plain_gltf_of(folder / to);
            for (const char* list : {"meshes", "skins", "materials", "scenes"})
                CHECK(after.json.value(list, json()) == before.json.value(list, json()));
            const std::size_t count = before.json.value("animations", json::array()).size();
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
