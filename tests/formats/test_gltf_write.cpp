// SPDX-License-Identifier: MIT
//
// Which frames a glTF animation has, and what is written at them. New rotations are where they belong; all else is as
// it was, value by value and byte by byte. Khronos' validator and three.js read the result.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>

#include "tests/gltf_rig.h"
#include "tests/plain_gltf.h"
#include "tests/test_data.h"
#include "tests/test_random.h"
#include "tools/formats/error.h"
#include "tools/formats/gltf.h"

using namespace swivel::test;
using namespace swivel::formats;
using Eigen::Quaterniond;
using nlohmann::json;
using namespace std::literals;

namespace {

std::vector<float> times_of(std::size_t count, double step)
{
    std::vector<float> times;
    for (std::size_t n = 0; n < count; ++n) times.push_back(static_cast<float>(step * static_cast<double>(n)));
    return times;
}

// Values for keys at these times, whatever they are; of rotations, and those turn or are still.
std::vector<float> values_of(const std::vector<float>& times, bool is_rotation, bool moves, bool is_cubic = false)
{
    std::vector<float> values;
    const auto add = [&](const std::vector<float>& part) { values.insert(values.end(), part.begin(), part.end()); };
    const std::vector<float> none(is_rotation ? 4 : 3, 0);
    for (std::size_t n = 0; n < times.size(); ++n) {
        if (is_cubic) add(none);
        if (is_rotation)
            add(moves && n % 2 ? std::vector<float>{0.6f, 0, 0, 0.8f} : std::vector<float>{0, 0, 0, 1});
        else
            add({1, 1, moves && n % 2 ? 2.0f : 1.0f});
        if (is_cubic) add(none);
    }
    return values;
}

// hips > spine > arm > twist > fore > hand, and beside them spine > head and hips > tail.
struct Body {
    enum : int { hips, spine, arm, twist, fore, hand, head, tail, count };
};

GltfRig body_rig()
{
    GltfRig rig;
    const std::map<int, int> parents = {{Body::hips, -1},          {Body::spine, Body::hips}, {Body::arm, Body::spine},
                                        {Body::twist, Body::arm},  {Body::fore, Body::twist}, {Body::hand, Body::fore},
                                        {Body::head, Body::spine}, {Body::tail, Body::hips}};
    for (const auto& [node, parent] : parents) REQUIRE(rig.add("", parent, {0, 1, 0}) == node);
    rig.add_animation("move");
    return rig;
}

void add_keys(GltfRig& rig, int node, const char* path, const std::vector<float>& times, const char* kind = "LINEAR")
{
    const bool is_cubic = std::string_view(kind) == "CUBICSPLINE";
    rig.add_keys(0, node, path, times, values_of(times, std::string_view(path) == "rotation", true, is_cubic), kind);
}

// Frames for the limb arm, fore, hand.
GltfFile frames_of(const GltfRig& rig, const GltfChoice& choice = {})
{
    const TempFolder folder;
    rig.write(folder / "rig.glb");
    GltfFile file = read_gltf(folder / "rig.glb", choice);
    CHECK(file.clip.frame_count == 0);
    std::vector<int> joints;
    for (const int node : {Body::arm, Body::fore, Body::hand})
        joints.push_back(find_joints(file.clip, "#" + std::to_string(node)).at(0));
    sample(file, joints);
    CHECK(file.clip.frame_count == file.times.size());
    return file;
}

// The interpolation of each of a written file's rotation channels, by node.
std::map<int, std::string> kinds_of(const PlainGltf& gltf)
{
    std::map<int, std::string> kinds;
    const json& animation = gltf.json["animations"][0];
    for (const json& channel : animation["channels"])
        kinds[channel["target"]["node"]] =
            animation["samplers"][channel["sampler"].get<std::size_t>()].value("interpolation", "LINEAR");
    return kinds;
}

}  // namespace

TEST_CASE("gltf frames: they are the keys of the limbs' joints, of joints in between and of all above, each once")
{
    rc::prop("any keys of any nodes", [](std::uint64_t seed) {
        Random random{seed};
        GltfRig rig = body_rig();
        std::set<float> wanted;
        for (int node = 0; node < Body::count; ++node)
            for (const char* path : {"translation", "rotation", "scale"}) {
                if (random.between(0, 1) < 0.6) continue;
                std::set<float> times;
                for (int n = 0; n < 4; ++n) times.insert(static_cast<float>(std::floor(random.between(0, 40))) / 16);
                const char* kinds[] = {"STEP", "LINEAR", "CUBICSPLINE"};
                add_keys(rig, node, path, {times.begin(), times.end()}, kinds[int(random.between(0, 2.99))]);
                if (node != Body::head && node != Body::tail) wanted.insert(times.begin(), times.end());
            }
        if (wanted.empty()) wanted = {0};
        const GltfFile file = frames_of(rig);
        REQUIRE(file.times == std::vector<float>(wanted.begin(), wanted.end()));
    });
}

TEST_CASE("gltf frames: even ones have a step, uneven ones none")
{
    const auto step = [](const std::vector<float>& times) {
        GltfRig rig = body_rig();
        add_keys(rig, Body::arm, "rotation", times);
        return frames_of(rig).clip.frame_time;
    };
    CHECK(step(times_of(25, 1 / 24.0)) == Approx(1 / 24.0));
    CHECK(step(times_of(5000, 1 / 60.0)) == Approx(1 / 60.0));
    CHECK(step({0, 0.5f}) == 0.5);
    CHECK(step({3}) > 0);
    CHECK(step({0, 0.5f, 1.1f}) == 0);
    CHECK(step({0, 0.5f, std::nextafter(0.5f, 1.0f), 1}) == 0);  // a jump is two frames
    CHECK(step({-3e38f, 3e38f}) > 0);
}

TEST_CASE("gltf frames: a rate samples the whole animation evenly")
{
    GltfRig rig = body_rig();
    add_keys(rig, Body::arm, "rotation", {0.5f, 0.7f, 1.5f});
    add_keys(rig, Body::head, "rotation", {0.25f, 2.25f});
    const GltfFile file = frames_of(rig, {"", 10});
    REQUIRE(file.times.size() == 21);
    for (std::size_t n = 0; n < 21; ++n) CHECK(file.times[n] == Approx(0.25 + 0.1 * static_cast<double>(n)));
    CHECK(file.clip.frame_time == Approx(0.1));
    CHECK(frames_of(rig, {"", 1e-9}).times == std::vector<float>{0.25f, 2.25f});
    CHECK(frames_of(body_rig(), {"", 10}).times == std::vector<float>{0});
}

TEST_CASE("gltf frames: twelve keys hours apart are twelve frames, and a rate is counted before room is made")
{
    GltfRig rig = body_rig();
    add_keys(rig, Body::arm, "rotation", times_of(12, 10'000));
    CHECK(frames_of(rig).times.size() == 12);
    CHECK_THROWS_WITH(frames_of(rig, {"", 1e9}), Catch::Contains("frames of 8 joints, more than 8 GiB; cut it or give "
                                                                 "a lower --fps"));
    CHECK_THROWS_WITH(frames_of(rig, {"", 60, 1 << 20}), Catch::Contains("the animation has 6600001 frames"));
    CHECK_THROWS_WITH(frames_of(rig, {"", 0, 1024}), Catch::Contains("the animation has 12 frames of 8 joints"));
    CHECK_THROWS_WITH(frames_of(rig, {"", 0, 64}), Catch::Contains("the keys of animation 0 come to more than"));
}

TEST_CASE("gltf frames: new keys go by steps or evenly as the joint did, and as all others if it did not move")
{
    const TempFolder folder;
    const auto times = times_of(4, 1 / 24.0);
    for (const bool is_mixed : {true, false}) {
        GltfRig rig = body_rig();
        rig.add_keys(0, 0, "rotation", times, values_of(times, true, true), "STEP");
        rig.add_keys(0, 1, "rotation", times, values_of(times, true, true), is_mixed ? "LINEAR" : "STEP");
        rig.add_keys(0, 2, "rotation", times, values_of(times, true, false), is_mixed ? "STEP" : "LINEAR");
        rig.write(folder / "rig.glb");
        const GltfFile file = read_clip(folder / "rig.glb");
        std::vector<Quaterniond> turn(file.clip.frame_count, Quaterniond(0, 1, 0, 0));
        for (std::size_t n = 0; n < turn.size(); n += 2) turn[n].coeffs() *= -3;  // on another side, of another length
        const JointKeys changes[] = {{0, turn}, {1, turn}, {2, turn}};
        write_gltf(folder / "new.glb", file, changes);
        const std::string second = is_mixed ? "LINEAR" : "STEP";
        const std::map<int, std::string> wanted = {{0, "STEP"}, {1, second}, {2, second}};
        const PlainGltf plain = plain_gltf_of(folder / "new.glb");
        CHECK(kinds_of(plain) == wanted);
        for (const json& sampler : plain.json["animations"][0]["samplers"]) {  // successive keys lie on one side
            const std::vector<double>& keys = plain_numbers(plain, sampler["output"]);
            for (std::size_t n = 0; n < keys.size(); n += 4) CHECK(keys[n] * keys[0] > 0.99);
        }
    }
}

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

            // Keys in frames of their own, under another name: of all motion that the animation had they alone are
            // left.
            write_gltf(folder / to, file, changes, NewFrames{3, 0.04, "walk \"home\""});
            const PlainGltf renamed = plain_gltf_of(folder / to);
            found = kept(renamed.json, accessors, views);
            wanted["animations"][0]["name"] = "walk \"home\"";
            CHECK(found == wanted);
            CHECK(renamed.buffers[0].substr(0, rig.bytes.size()) == rig.bytes);
            CHECK(renamed.json["animations"][1] == before.json["animations"][1]);
            CHECK(renamed.json["animations"][0]["channels"].size() == 3);
            for (const int node : {1, 2, 3})
                CHECK(key_times(renamed, node) == std::vector<double>{0, double{0.04f}, double{0.08f}});
        }
}

// Skeletons with so few or so many members that one more makes their list of members move in memory.
TEST_CASE("gltf write: keys go into files that have nothing yet to hold them")
{
    const TempFolder folder;
    const json nodes = {{{"name", "root"}, {"children", {1}}}, {{"name", "arm"}, {"translation", {1, 0, 0}}}};
    const json min = {{"asset", {{"version", "2.0"}}}, {"nodes", nodes}};
    json six = min, named = min, pictured = min;
    six.update({{"scene", 0},
                {"scenes", {{{"nodes", {0}}}}},
                {"extras", {{"a", 1}}},
                {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}}}});
    named["animations"] = {{{"name", "x"}}};
    pictured["images"] = {{{"uri", "a.png"}}, {{"uri", "a.png"}}};
    spill(folder / "a.png", kPixel);
    const std::vector<Quaterniond> turn = {Quaterniond(0, 1, 0, 0)};
    const JointKeys changes[] = {{0, turn}, {1, turn}};
    for (const json& whole : {min, six, named, pictured})
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
