// SPDX-License-Identifier: MIT
//
// The reader of glTF. Node hierarchies, matrices, mirrors and every kind of key agree with an independent evaluation of
// the same accessors, and with three.js. A wrong file is refused in one line.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "tests/gltf_clip.h"
#include "tests/gltf_judges.h"
#include "tests/gltf_rig.h"
#include "tests/plain_gltf.h"
#include "tools/formats/error.h"
#include "tools/formats/gltf.h"

using namespace swivel::test;
using namespace swivel::formats;
using Eigen::Quaterniond;
using Eigen::Vector3d;

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
    return rig;
}

std::string refusal(const std::function<void()>& call)
{
    try {
        call();
    } catch (const InputError& error) {
        CHECK(std::string_view(error.what()).find('\n') == std::string_view::npos);
        return error.what();
    }
    return "read";
}

std::string refusal_of(const GltfRig& rig, const GltfChoice& choice = {})
{
    const TempFolder folder;
    rig.write(folder / "rig.glb");
    return refusal([&] { read_clip(folder / "rig.glb", choice); });
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

TEST_CASE("gltf: the animation is chosen by name, else by index")
{
    GltfRig rig = keyed_rig();
    CHECK(refusal_of(rig, {"none"}).find("it has 0 other, 1 main") != std::string::npos);
    CHECK(refusal_of(rig, {"2"}).find("no animation '2'") != std::string::npos);
    CHECK(refusal_of(rig, {"0"}) == "read");
    rig.json["animations"][0]["name"] = "main";
    CHECK(refusal_of(rig, {"main"}).find("2 animations are called 'main'; give the index") != std::string::npos);
    CHECK(refusal_of(GltfRig(rig), {"1"}) == "read");
    rig.json.erase("animations");
    CHECK(refusal_of(rig, {"1"}).find("it has no animation; leave out --clip") != std::string::npos);
    CHECK(refusal_of(rig) == "read");
}

TEST_CASE("gltf: what is wrong is refused in one line")
{
    const auto with = [](const std::string& pointer, const nlohmann::json& value) {
        GltfRig rig = keyed_rig();
        rig.json[nlohmann::json::json_pointer(pointer)] = value;
        return refusal_of(rig, {"main"});
    };
    const auto says = [](const std::string& text, const char* part) {
        INFO(text);
        CHECK(text.find(part) != std::string::npos);
    };
    says(with("/nodes/3/children", {1}), "child of two nodes");
    says(with("/nodes/3/children", {0}), "nodes are each other's children, in a circle; export the file again");
    says(with("/nodes/3/children", {9}), "a child node 9 does not exist; there are 4; export the file again");
    says(with("/nodes/1/rotation", {0, 0, 0, 0}), "node 1 has a zero rotation");
    says(with("/nodes/1/translation", {1, 2}), "node 1 has a bad translation");
    says(with("/animations/1/channels/0/target/node", 7),
         "a channel's node 7 does not exist; there are 4; export the file again");
    says(with("/animations/1/channels/0/sampler", 7), "a channel's sampler 7 does not exist");
    says(with("/animations/1/samplers/0/output", 77), "an animation's accessor 77 does not exist");
    says(with("/animations/1/samplers/0/input", 1), "wrong type");
    says(with("/animations/1/samplers/0/interpolation", "MAGIC"),
         "interpolation 'MAGIC' is unknown; export the file again");
    says(with("/animations/1/channels/1/target/node", 1), "two channels of animation 1 are for the rotation of node 1");
    says(with("/nodes/1/rotation", "0 0 1 0"),
         "node 1 has a bad rotation: a list of 4 numbers that floats can hold is needed");
    says(with("/nodes/1/translation", {{"x", 5}}), "node 1 has a bad translation");
    says(with("/nodes/1/children", {1.5}), "node 1 has a bad children");
    says(with("/nodes/1", 5), "node 1 is no object");
    says(with("/skins", {{{"joints", "all"}}}), "skin 0 has a bad joints");
    says(with("/animations/1/channels/0", 5), "animation 1, channel 0 is no object");
    says(with("/animations/1/channels/0", {{"target", {{"path", "rotation"}}}}), "channel 0 has a bad sampler");
    says(with("/animations/1/channels/0/target/path", 5), "the target of animation 1, channel 0 has a bad path");
    says(with("/accessors/2/componentType", 5124), "component type 5124 of an accessor in buffer view 2");
    says(with("/accessors/2", {{"componentType", 5126}, {"count", 9}, {"type", "SCALAR"}}), "has no buffer view");
    says(with("/accessors/3", {{"componentType", 5126}, {"count", 1 << 28}, {"type", "VEC4"}}), "different numbers");
    says(with("/accessors/2/count", 3), "different numbers of keys");
    says(with("/accessors/2/count", 400), "reads beyond the end of buffer view 2");
    says(with("/accessors/2/bufferView", 40), "an accessor's buffer view 40 does not exist");
    says(with("/extensionsRequired", {"EXT_meshopt_compression"}), "compressed");
    says(with("/asset", nlohmann::json::object()), "its asset has a bad version: \"2.0\" is needed, not nothing");
    says(with("/asset/version", "1.0"), "its asset has a bad version: \"2.0\" is needed, not \"1.0\"");
    GltfRig rig = keyed_rig();
    const float bad[2] = {2, std::nanf("")};
    std::memcpy(rig.bytes.data() + rig.json["bufferViews"][2]["byteOffset"].get<std::size_t>(), bad, 8);
    says(refusal_of(rig, {"main"}), "not finite");
    rig = keyed_rig();
    std::memcpy(rig.bytes.data() + rig.json["bufferViews"][2]["byteOffset"].get<std::size_t>(), bad, 4);
    says(refusal_of(rig, {"main"}), "do not grow; export the file again");
    says(refusal_of(GltfRig()), "no nodes");

    const TempFolder folder;
    const auto text = [&](const std::string& bytes) {
        spill(folder / "bad.glb", bytes);
        return refusal([&] { read_clip(folder / "bad.glb"); });
    };
    keyed_rig().write(folder / "good.glb");
    const std::string good = slurp(folder / "good.glb");
    says(text(""), "empty");
    says(text("HIERARCHY"), "is not glTF: it starts neither with 'glTF' nor with '{'");
    says(text("[]"), "is not glTF: it starts neither");
    says(text("{\"asset\":}"), "is not glTF: parse error at line 1, column 10");
    says(text(good.substr(0, 10)), "cut short");
    says(text(good.substr(0, 15)), "bytes and has 15");
    says(text(good.substr(0, good.size() - 4)), "bytes and has");
    says(text(std::string("glTF\1\0\0\0", 8) + good.substr(8)), "version 1");
    says(text("{\"a\":" + std::string(100'000, '[')), "nested deeper");
    says(refusal([&] { read_clip(folder / "missing.glb"); }), "cannot be opened");
    spill(folder / "bin.gltf",
          R"({"asset":{"version":"2.0"},"nodes":[{}],"buffers":[{"uri":"gone.bin","byteLength":4}]})");
    says(refusal([&] { read_clip(folder / "bin.gltf"); }), "gone.bin");
}

TEST_CASE("gltf: a broken file is read or refused, never worse")
{
    const TempFolder folder;
    keyed_rig().write(folder / "good.glb");
    const std::string good = slurp(folder / "good.glb");
    std::mt19937 random(11);
    std::size_t refused = 0;
    for (int round = 0; round < 1500; ++round) {
        spill(folder / "bad.glb", mutated(good, random));
        const std::string said = refusal([&] {
            const GltfFile file = read_clip(folder / "bad.glb", {"1"});
            const std::vector<Quaterniond> still(file.clip.frame_count, Quaterniond::Identity());
            const RotationOverride change[] = {{0, still}};
            write_gltf("/dev/null", file, change);
        });
        refused += said != "read";
    }
    CHECK(refused > 500);
    CHECK(refused < 1500);
}

TEST_CASE("gltf: real files come out as the plain reading says")
{
    for (const char* name : {"RobotExpressive.glb", "m2m_human_ymca.glb", "m2m_human_male.glb", "cesium_man.gltf",
                             "rigged_simple.gltf", "interpolation_test.gltf", "simple_skin/simple_skin.gltf"}) {
        const fs::path path = find_data(name);
        if (path.empty()) {
            WARN("skipped: this machine has no " << name);
            continue;
        }
        const PlainGltf plain = plain_gltf_of(path);
        for (int n = 0; n < static_cast<int>(read_clip(path).animation_names.size()); ++n) {
            INFO(name << ", animation " << n);
            const GltfFile file = read_clip(path, {std::to_string(n), 100});
            // A hundred thousandth of uneven scale goes for even.
            CHECK(difference(file, plain) < 3e-5);
        }
    }
}
