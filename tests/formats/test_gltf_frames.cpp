// SPDX-License-Identifier: MIT
//
// Which frames a glTF animation has: the times of the limbs' keys, or even ones; and what is written at them.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <set>

#include "tests/gltf_clip.h"
#include "tests/gltf_rig.h"
#include "tests/plain_gltf.h"
#include "tests/test_random.h"
#include "tools/formats/error.h"

using namespace swivel::test;
using namespace swivel::formats;
using Eigen::Quaterniond;
using nlohmann::json;

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

TEST_CASE("gltf frames: what the solver does not hold is refused at a limb's joint, with node and value")
{
    const auto refuses = [](const GltfRig& rig, const char* part) {
        CHECK_THROWS_WITH(frames_of(rig), Catch::Contains(part));
    };
    const auto at_rest = [&](int node, const char* member, const json& value) {
        GltfRig rig = body_rig();
        rig.json["nodes"][static_cast<std::size_t>(node)][member] = value;
        return rig;
    };
    refuses(at_rest(Body::arm, "scale", {1e30, 1e30, 1e30}), "node 2 is 1e+30 times its size at rest");
    refuses(at_rest(Body::spine, "scale", {1e-30, 1e-30, 1e-30}), "node 1 is 1e-30 times its size at rest");
    refuses(at_rest(Body::fore, "translation", {0, 1e20, 0}), "node 4 is 1e+20 from the origin at rest");
    CHECK(frames_of(at_rest(Body::head, "scale", {1e30, 1e30, 1e30})).clip.frame_count == 1);  // no limb's
    GltfRig two = at_rest(Body::hips, "scale", {1e10, 1e10, 1e10});
    two.json["nodes"][Body::spine]["scale"] = {1e10, 1e10, 1e10};
    refuses(two, "node 1 is 1e+20 times its size at rest");
    GltfRig rig = body_rig();
    rig.add_keys(0, Body::arm, "scale", {0, 1}, {1, 1, 1, 1e30f, 1e30f, 1e30f});
    refuses(rig, "node 2 is 1e+30 times its size in frame 1");
}
