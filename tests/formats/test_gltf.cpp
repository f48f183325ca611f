// SPDX-License-Identifier: MIT
//
// The reader of glTF. Node hierarchies, matrices, mirrors and every kind of key agree with an independent evaluation of
// the same accessors, and with three.js. A wrong file is refused in one line; what is no glTF at all is in
// tests/transcripts/gltf.txt.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <map>
#include <random>

#include "tests/gltf_rig.h"
#include "tests/plain_gltf.h"
#include "tests/test_data.h"
#include "tools/formats/error.h"
#include "tools/formats/gltf.h"

using namespace swivel::test;
using namespace swivel::formats;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

const Quaterniond kTurn = Quaterniond(0.5, 0.1, -0.7, 0.4).normalized();

Eigen::Affine3d matrix_of(const JointPose& pose)
{
    const Vector3d mirror(pose.mirrored ? -1 : 1, 1, 1);
    return Eigen::Translation3d(pose.position) * pose.rotation * Eigen::Scaling(pose.scale) * Eigen::Scaling(mirror);
}

// The worst difference between the clip's frames and the plain reading, of all joints without uneven scales.
double difference(const GltfFile& file, const PlainGltf& plain)
{
    double worst = 0;
    for (std::size_t frame = 0; frame < file.clip.frame_count; frame += 1 + file.clip.frame_count / 8) {
        const std::vector<JointPose> pose_w = world_pose(file.clip, frame);
        for (std::size_t joint = 0; joint < pose_w.size(); ++joint) {
            if (pose_w[joint].unevenness > 3e-5) continue;
            const Eigen::Affine3d wanted = plain_world(plain, file.animation, file.clip.joints[joint].number,
                                                       static_cast<double>(file.times[frame]));
            const double size = 1 + wanted.matrix().cwiseAbs().maxCoeff();
            worst = std::max(worst, (matrix_of(pose_w[joint]).matrix() - wanted.matrix()).cwiseAbs().maxCoeff() / size);
        }
    }
    return worst;
}

// A chain with every kind of key, under an armature of scale 100.
GltfRig keyed_rig()
{
    GltfRig rig;
    const int armature = rig.add("Armature", -1, {1, 2, 3}, kTurn, {100, 100, 100});
    const int a = rig.add("a", armature, {0.1, 0, 0}), b = rig.add("", a, {0, 0.2, 0}, kTurn),
              c = rig.add("c", b, {0, 0, 0.3});
    const float h = std::sqrt(0.5f);
    const int other = rig.add_animation("other"), main = rig.add_animation("main");
    rig.add_keys(other, c, "rotation", {0.5f}, {0, 0, h, h});
    rig.add_keys(main, a, "rotation", {0, 0.25f, 0.5f, 1}, {0, 0, 0, 1, h, 0, 0, h, 0, -h, 0, -h, 0, 0, 1, 0});
    rig.add_keys(main, b, "rotation", {0.25f, 0.75f}, {0, 0, 0, 1, 0, h, 0, h}, "STEP");
    rig.add_keys(main, c, "rotation", {0, 0.5f, 1}, {0, 0, 0, 0, 0,  0,    0, 1, 0.5f, 0, 0, 0, 0, 1, 0, 0, h, 0,
                                                     0, h, 0, 0, -1, 0.3f, 1, 0, 0,    0, h, h, 0, 0, 0, 0, 0, 0},
                 "CUBICSPLINE");
    rig.add_keys(main, b, "translation", {0, 1}, {0, 0, 0, 0, 0.2f, 0, 0, 1, 0, 1, 0, 0, 0, 0.4f, 0.1f, 0, 0, 0},
                 "CUBICSPLINE");
    rig.add_keys(main, a, "scale", {0, 1}, {1, 1, 1, 3, 3, 3});
    rig.add_keys(main, c, "translation", {0, 0.4f, 1}, {0, 0, 0.3f, 0, 0.1f, 0.3f, 0, 0, 0.2f}, "STEP");
    return rig;
}

// What the reader says against a rig; empty if it reads it.
std::string refusal_of(const GltfRig& rig, const GltfChoice& choice = {})
{
    const TempFolder folder;
    rig.write(folder / "rig.glb");
    return complaint_of(folder, [&] { read_clip(folder / "rig.glb", choice); });
}

}  // namespace

TEST_CASE("gltf: every kind of key is evaluated as the specification says, and as three.js plays it")
{
    const TempFolder folder;
    keyed_rig().write(folder / "rig.gltf");
    keyed_rig().write(folder / "rig.glb");
    for (const char* name : {"rig.gltf", "rig.glb"}) {
        CHECK(gltf_errors(folder / name).empty());
        const GltfFile file = read_clip(folder / name, {"main", 37});
        REQUIRE(file.animation == 1);
        REQUIRE(file.times.size() == 38);
        CHECK(file.times.back() == 1.0f);
        CHECK(difference(file, plain_gltf_of(folder / name)) < 1e-12);

        const std::vector<double> times = {0, 0.1, 0.25, 0.6, 0.75, 0.99};
        const auto poses = three_poses(folder / name, 1, times);
        const PlainGltf plain = plain_gltf_of(folder / name);
        for (std::size_t n = 0; n < times.size(); ++n)
            for (int node = 0; node < 4; ++node) {
                const Eigen::Matrix4d wanted = plain_world(plain, 1, node, times[n]).matrix();
                INFO(times[n] << " s, node " << node);
                CHECK((poses[n][static_cast<std::size_t>(node)] - wanted).norm() < 2e-6 * wanted.norm());
            }
    }
}

TEST_CASE("gltf: matrices, mirrors and uneven scales")
{
    const TempFolder folder;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto turn = [&] { return Quaterniond(any(random), any(random), any(random), any(random)).normalized(); };
    for (int round = 0; round < 50; ++round) {
        GltfRig rig;
        int parent = -1;
        for (int n = 0; n < 6; ++n) {
            const double size = std::exp(2 * any(random));
            const auto sign = [&] { return any(random) < 0 ? -size : size; };
            const Vector3d place(any(random), any(random), any(random)), scale(sign(), sign(), sign());
            const Quaterniond q = turn();
            parent = rig.add("n", parent, place, q, scale);
            if (n % 2 == 1) continue;
            const Eigen::Affine3d whole = Eigen::Translation3d(place) * q * Eigen::Scaling(scale);
            auto& node = rig.json["nodes"].back();
            for (const char* name : {"translation", "rotation", "scale"}) node.erase(name);
            node["matrix"] = std::vector<double>(whole.data(), whole.data() + 16);
        }
        rig.write(folder / "rig.glb");
        const GltfFile file = read_clip(folder / "rig.glb");
        for (const JointPose& pose : world_pose(file.clip, 0)) CHECK(pose.unevenness < 3e-5);
        CHECK(difference(file, plain_gltf_of(folder / "rig.glb")) < 1e-9);
    }
    GltfRig rig;
    rig.add("child", rig.add("uneven", -1, {0, 0, 0}, kTurn, {1, 1, 1.01}), {1, 0, 0});
    rig.write(folder / "uneven.glb");
    for (const JointPose& pose : rest_pose(read_clip(folder / "uneven.glb").clip)) CHECK(pose.unevenness > 3e-5);
    rig.json["nodes"][0] = {{"matrix", {1, 0.1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"children", {1}}};
    rig.write(folder / "sheared.glb");
    for (const JointPose& pose : rest_pose(read_clip(folder / "sheared.glb").clip)) CHECK(pose.unevenness > 3e-5);
}

TEST_CASE("gltf: joints are the nodes, parents first, with the skin's marked and the unnamed numbered")
{
    const TempFolder folder;
    GltfRig rig;
    const int tip = rig.add("", -1, {0, 0, 1}), root = rig.add("root", -1, {0, 0, 0});
    rig.json["scenes"][0]["nodes"] = nlohmann::json::array({root});
    rig.json["nodes"][static_cast<std::size_t>(root)]["children"] = nlohmann::json::array({tip});
    rig.json["skins"] = {{{"joints", {tip}}}};
    rig.write(folder / "rig.glb");
    const Clip clip = read_clip(folder / "rig.glb").clip;
    REQUIRE(clip.joints.size() == 2);
    CHECK(clip.joints[0].name == "root");
    CHECK_FALSE(clip.joints[0].is_bone);
    CHECK(clip.joints[1].name == "#0");
    CHECK(clip.joints[1].parent == 0);
    CHECK(clip.joints[1].is_bone);
    CHECK(find_joints(clip, "#0") == std::vector<int>{1});
    CHECK(find_joints(clip, "#1") == std::vector<int>{0});
    CHECK(find_joints(clip, "root/#0") == std::vector<int>{1});
    CHECK(find_joints(clip, "#2").empty());
    CHECK(clip.frame_count == 1);
}

TEST_CASE("gltf: normalised integers and sparse keys")
{
    const TempFolder folder;
    GltfRig rig;
    const int node = rig.add("a", -1, {0, 0, 0});
    rig.add_keys(rig.add_animation(""), node, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 1});
    const std::size_t plain_size = rig.bytes.size();
    const std::int16_t turned[4] = {0, 32767, 0, -32768}, place[2] = {1, 0};
    rig.bytes.append(reinterpret_cast<const char*>(turned), 8).append(reinterpret_cast<const char*>(place), 4);
    rig.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", plain_size}, {"byteLength", 8}});
    rig.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", plain_size + 8}, {"byteLength", 4}});
    rig.json["accessors"][1] = {
        {"componentType", 5122},
        {"normalized", true},
        {"count", 2},
        {"type", "VEC4"},
        {"sparse",
         {{"count", 1}, {"indices", {{"bufferView", 3}, {"componentType", 5123}}}, {"values", {{"bufferView", 2}}}}}};
    rig.json["accessors"].push_back(
        {{"bufferView", 2}, {"componentType", 5122}, {"normalized", true}, {"count", 1}, {"type", "VEC4"}});
    rig.add_accessor({0.5f}, "SCALAR", 1);
    rig.json["animations"][0]["samplers"][0] = {{"input", 3}, {"output", 2}};
    rig.write(folder / "rig.glb");
    CHECK(read_clip(folder / "rig.glb").clip.rotation[0].isApprox(Quaterniond(-1, 0, 1, 0).normalized(), 1e-15));
    rig.json["animations"][0]["samplers"][0] = {{"input", 0}, {"output", 1}};
    CHECK(refusal_of(rig).find("zero rotation") != std::string::npos);  // the key the sparse list leaves at zero
}

TEST_CASE("gltf: a member of a wrong type, or one that is missing, is refused by its place")
{
    GltfRig sound = keyed_rig();
    sound.json["accessors"][3]["sparse"] = {
        {"count", 1}, {"indices", {{"bufferView", 0}, {"componentType", 5125}}}, {"values", {{"bufferView", 1}}}};
    sound.json["skins"] = {{{"joints", {1}}}};
    const auto said = [&](const std::string& pointer, const json& value) {
        GltfRig rig = sound;
        const json::json_pointer at(pointer);
        if (value.is_discarded())
            rig.json[at.parent_pointer()].erase(at.back());
        else
            rig.json[at] = value;
        return refusal_of(rig, {"main"});
    };
    const json missing = json(json::value_t::discarded);
    const auto each_refused = [&](const std::string& pointer, const std::vector<json>& values) {
        for (const json& value : values)
            CHECK_THAT(said(pointer, value),
                       Catch::Contains(pointer + " is bad: ") && Catch::Contains("is needed, not "));
    };
    const std::vector<json> no_numbers = {"4", -4, 4.5, 4.0, 1e300, nullptr, json::array({4}), true};
    for (const char* place : {"/accessors/3/bufferView", "/accessors/3/byteOffset", "/bufferViews/1/byteOffset",
                              "/bufferViews/1/byteStride", "/animations/1/channels/0/target/node"})
        each_refused(place, no_numbers);
    for (const char* place :
         {"/accessors/3/componentType", "/accessors/3/count", "/accessors/3/sparse/count", "/bufferViews/1/buffer",
          "/accessors/3/sparse/indices/bufferView", "/accessors/3/sparse/values/bufferView",
          "/bufferViews/1/byteLength", "/animations/1/channels/0/sampler", "/animations/1/samplers/0/input"}) {
        each_refused(place, no_numbers);
        each_refused(place, {missing});
    }
    each_refused("/accessors/3/type", {5, missing});
    each_refused("/accessors/3/normalized", {1, "true"});
    each_refused("/bufferViews/1/byteStride", {2, 6, 256});
    each_refused("/nodes/1/translation", {json{1, 2}, {{"x", 5}}, "0 0 1", json{1, 2, 1e39}});
    each_refused("/nodes/1/rotation", {json{0, 0, 1}, json{1e308, 0, 0, 1}});
    each_refused("/nodes/1/children", {json{1.5}, 2});
    each_refused("/skins/0/joints", {"all"});
    each_refused("/animations/1/channels/0/target/path", {5, missing});
    for (const char* list : {"/nodes", "/skins", "/animations/1/channels", "/accessors", "/bufferViews"})
        each_refused(list, {6, json{5}});
    each_refused("/asset/version", {"1.0", missing});
    CHECK_THAT(said("/asset/version", "1.0"), Catch::Contains("\"2.0\" is needed, not \"1.0\""));
}

TEST_CASE("gltf: values that do not fit are refused in one line")
{
    struct Fault {
        const char* pointer;
        json value;
        const char* said;
    };
    const std::vector<Fault> faults = {
        {"/nodes/3/children", {1}, "child of two nodes"},
        {"/nodes/3/children", {0}, "nodes are each other's children, in a circle; export the file again"},
        {"/nodes/3/children", {9}, "a child node 9 does not exist; there are 4; export the file again"},
        {"/nodes/1/rotation", {0, 0, 0, 0}, "node 1 has a zero rotation"},
        {"/animations/1/channels/0/target/node", 7, "a channel's node 7 does not exist; there are 4"},
        {"/animations/1/channels/0/sampler", 7, "a channel's sampler 7 does not exist"},
        {"/animations/1/samplers/0/output", 77, "an animation's accessor 77 does not exist"},
        {"/animations/1/samplers/0/input", 1, "wrong type"},
        {"/animations/1/samplers/0/interpolation", "MAGIC", "interpolation 'MAGIC' is unknown; export the file again"},
        {"/animations/1/channels/1/target/node", 1, "two channels of animation 1 are for the rotation of node 1"},
        {"/accessors/2/componentType", 5124, "component type 5124 of an accessor in buffer view 2"},
        {"/accessors/2", {{"componentType", 5126}, {"count", 9}, {"type", "SCALAR"}}, "has no buffer view"},
        {"/accessors/3", {{"componentType", 5126}, {"count", 1 << 28}, {"type", "VEC4"}}, "different numbers"},
        {"/accessors/2/count", 400, "reads beyond the end of buffer view 2"},
        {"/accessors/2/bufferView", 40, "an accessor's buffer view 40 does not exist"},
        {"/bufferViews/2/buffer", 3, "buffer 3 does not exist"},
        {"/extensionsRequired", {"EXT_meshopt_compression"}, "compressed"},
    };
    for (const Fault& fault : faults) {
        GltfRig rig = keyed_rig();
        rig.json[json::json_pointer(fault.pointer)] = fault.value;
        CHECK_THAT(refusal_of(rig, {"main"}), Catch::Contains(fault.said));
    }
    const auto with_times = [](std::initializer_list<float> times) {
        GltfRig rig = keyed_rig();
        const std::size_t place = rig.json["bufferViews"][2]["byteOffset"];
        std::memcpy(rig.bytes.data() + place, times.begin(), 4 * times.size());
        return refusal_of(rig, {"main"});
    };
    CHECK_THAT(with_times({2, std::nanf("")}), Catch::Contains("not finite"));
    CHECK_THAT(with_times({2}), Catch::Contains("do not grow; export the file again"));
    CHECK_THAT(refusal_of(GltfRig()), Catch::Contains("no nodes"));
}

TEST_CASE("gltf: tables of human bones of VRM 0.x and 1.0 name joints")
{
    const auto vrm = [](const char* extension, const json& bones) {
        return json{{extension, {{"humanoid", {{"humanBones", bones}}}}}};
    };
    const TempFolder folder;
    const auto clip_of = [&](const json& extensions) {
        GltfRig rig;  // node 0 hangs on node 1, so joints and nodes have other numbers
        const int hand = rig.add("bone 17", -1, {0, 0, 1}), arm = rig.add("bone 3", -1, {0, 0, 0});
        rig.json["scenes"][0]["nodes"] = {arm};
        rig.json["nodes"][static_cast<std::size_t>(arm)]["children"] = {hand};
        rig.json["extensions"] = extensions;
        rig.write(folder / "rig.vrm");
        return read_gltf(folder / "rig.vrm").clip;
    };
    const json old_table = {{{"bone", "leftHand"}, {"node", 0}}, {{"bone", "leftLowerArm"}, {"node", 1}}};
    const json new_table = {{"leftHand", {{"node", 0}}}, {"leftLowerArm", {{"node", 1}}}};
    for (const json& extensions : {vrm("VRM", old_table), vrm("VRMC_vrm", new_table)}) {
        const Clip clip = clip_of(extensions);
        REQUIRE(clip.human_bones.size() == 2);
        CHECK(joint_at(clip, clip.human_bones.at("leftHand")).name == "bone 17");
        CHECK(joint_at(clip, clip.human_bones.at("leftLowerArm")).name == "bone 3");
    }
    CHECK(clip_of({{"VRM", {{"meta", 1}}}}).human_bones.empty());
    // Of a file that has both, the newer.
    json both = vrm("VRM", old_table);
    both.update(vrm("VRMC_vrm", {{"hips", {{"node", 1}}}}));
    CHECK(clip_of(both).human_bones == std::map<std::string, int>{{"hips", 0}});
    std::vector<json> faults = {vrm("VRM", new_table), vrm("VRM", json::array({7})),
                                vrm("VRM", json::array({{{"bone", 3}, {"node", 0}}})),
                                vrm("VRM", {old_table[0], old_table[0]}), vrm("VRMC_vrm", {{"hips", 1}})};
    for (const json& node : {json(2), json(-1), json(0.5), json("0"), json(1e300), json()})
        faults.push_back(vrm("VRMC_vrm", {{"hips", {{"node", node}}}}));
    for (const json& fault : faults)
        CHECK_THAT(complaint_of(folder, [&] { clip_of(fault); }),
                   Catch::Contains("its humanBones do not name each bone once"));
}
