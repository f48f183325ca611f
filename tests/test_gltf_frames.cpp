// SPDX-License-Identifier: MIT
//
// Which frames a glTF animation has, so that nothing of it is lost between them, and what is written at them.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/gltf_judges.h"
#include "tests/gltf_rig.h"
#include "tests/plain_gltf.h"
#include "tools/formats/error.h"
#include "tools/formats/gltf.h"

using namespace swivel::test;
using namespace swivel::formats;
using Eigen::Quaterniond;
using nlohmann::json;

namespace {

const std::vector<float> kStill = {0, 0, 0, 1}, kNone = {0, 0, 0, 0};

std::vector<float> times_of(std::size_t count, double step)
{
    std::vector<float> times;
    for (std::size_t n = 0; n < count; ++n) times.push_back(static_cast<float>(step * static_cast<double>(n)));
    return times;
}

// Rotations in turn one way and the other, or still; for CUBICSPLINE with tangents.
std::vector<float> values_of(std::size_t count, bool is_cubic, bool moves, std::vector<float> tangent = kNone)
{
    std::vector<float> values;
    const auto add = [&](const std::vector<float>& part) { values.insert(values.end(), part.begin(), part.end()); };
    for (std::size_t n = 0; n < count; ++n) {
        if (is_cubic) add(tangent);
        add(moves && n % 2 ? std::vector<float>{0.6f, 0, 0, 0.8f} : kStill);
        if (is_cubic) add(tangent);
    }
    return values;
}

GltfRig arm_rig()
{
    GltfRig rig;
    rig.add("hand", rig.add("fore", rig.add("arm", -1, {0, 0, 0}), {0, 1, 0}), {0, 1, 0});
    rig.add_animation("move");
    return rig;
}

// The frames of one joint's keys.
std::vector<float> frames(const char* kind, const std::vector<float>& times, bool moves,
                          const std::vector<float>& tangent = kNone, double rate = 0)
{
    const TempFolder folder;
    GltfRig rig = arm_rig();
    const bool is_cubic = std::string_view(kind) == "CUBICSPLINE";
    rig.add_keys(0, 0, "rotation", times, values_of(times.size(), is_cubic, moves, tangent), kind);
    rig.write(folder / "rig.glb");
    const GltfFile file = read_gltf(folder / "rig.glb", {"", rate});
    CHECK(file.clip.frame_count == file.times.size());
    return file.times;
}

bool has_all(const std::vector<float>& all, const std::vector<float>& some)
{
    return std::all_of(some.begin(), some.end(),
                       [&](float time) { return std::find(all.begin(), all.end(), time) != all.end(); });
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

TEST_CASE("gltf frames: keys on an even grid are frames where it is fine enough for what moves")
{
    const auto film = times_of(25, 1 / 24.0), games = times_of(31, 1 / 60.0), coarse = times_of(3, 0.5);
    CHECK(frames("LINEAR", film, true) == film);
    CHECK(frames("LINEAR", games, true) == games);
    CHECK(frames("CUBICSPLINE", games, true) == games);
    CHECK(frames("STEP", coarse, true) == coarse);
    CHECK(frames("LINEAR", coarse, false) == coarse);
    CHECK(frames("CUBICSPLINE", coarse, false) == coarse);
}

TEST_CASE("gltf frames: a coarser grid is divided so that its keys stay frames, others are sampled 60 times a second")
{
    const auto film = times_of(25, 1 / 24.0), coarse = times_of(3, 0.5), slow = times_of(16, 1 / 15.0);
    const std::vector<float> odd = {0.1f, 0.45f, 1.1f};
    CHECK(frames("LINEAR", coarse, true).size() == 61);
    CHECK(frames("LINEAR", slow, true).size() == 61);
    CHECK(frames("CUBICSPLINE", film, true).size() == 73);
    CHECK(frames("CUBICSPLINE", coarse, false, {1, 0, 0, 0}).size() == 61);  // its tangents lead away and back
    for (const auto& [kind, times] : {std::pair{"LINEAR", coarse}, {"LINEAR", slow}, {"CUBICSPLINE", film}})
        CHECK(has_all(frames(kind, times, true), times));
    const auto sampled = frames("STEP", odd, true);
    CHECK(sampled.size() == 61);
    CHECK(sampled.front() == odd.front());
    CHECK(sampled.back() == odd.back());
    CHECK(frames("LINEAR", film, true, kNone, 10).size() == 11);
    CHECK(frames("STEP", coarse, true, kNone, 10).size() == 11);
}

TEST_CASE("gltf frames: a jump, two keys a float's last digit apart, is no step of the grid, however late")
{
    const auto film = times_of(500, 1 / 24.0), coarse = times_of(21, 1);
    for (const std::size_t at : {1u, 16u, 20u}) {
        auto jumping = coarse;
        jumping.insert(jumping.begin() + static_cast<std::ptrdiff_t>(at) + 1, std::nextafter(coarse[at], HUGE_VALF));
        CHECK(frames("LINEAR", jumping, true).size() == 1201);
        CHECK(frames("STEP", jumping, true) == coarse);
    }
    auto jumping = film;
    jumping.insert(jumping.begin() + 481, std::nextafter(film[480], HUGE_VALF));
    CHECK(frames("LINEAR", jumping, true) == film);
}

TEST_CASE("gltf frames: a grid has up to 1000 frames a second, else 60")
{
    const auto finest = times_of(11, 0.001), finer = times_of(1001, 0.0009);
    CHECK(frames("LINEAR", finest, true) == finest);
    CHECK(frames("LINEAR", finer, true).size() == 55);
    CHECK(frames("LINEAR", {0, 0.0005f, 100}, true).size() == 6001);
    CHECK(frames("STEP", {0, 0.0005f}, true).size() == 2);
}

TEST_CASE("gltf frames: a curve between two keys is written as the source has it")
{
    const TempFolder folder;
    GltfRig rig = arm_rig();
    rig.add_keys(0, 0, "rotation", {0, 1},
                 {0, 0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 3, 0, 0, 0.6f, 0, 0, 0.8f, 0, 0, 0, 0}, "CUBICSPLINE");
    rig.write(folder / "rig.glb");
    const GltfFile file = read_gltf(folder / "rig.glb");
    std::vector<Quaterniond> turn;
    for (std::size_t frame = 0; frame < file.clip.frame_count; ++frame)
        turn.push_back(file.clip.rotation[frame * file.clip.joints.size()]);
    const RotationOverride change[] = {{0, turn}};
    write_gltf(folder / "new.glb", file, change);
    CHECK(gltf_errors(folder / "new.glb").empty());
    const PlainGltf from = plain_gltf_of(folder / "rig.glb"), to = plain_gltf_of(folder / "new.glb");
    double worst = 0;
    for (double time = 0; time <= 1; time += 1 / 240.0)
        worst = std::max(worst, (plain_local(to, 0, 0, time).linear() - plain_local(from, 0, 0, time).linear()).norm());
    CHECK(worst < 2e-3);  // 60 times a second, of a curve that turns some 20 rad/s^2 faster each second: 7e-4
}

TEST_CASE("gltf frames: each joint goes by steps or evenly as it did, and one that did not move as all the others do")
{
    const TempFolder folder;
    const auto times = times_of(4, 1 / 24.0);
    for (const bool is_mixed : {true, false}) {
        GltfRig rig = arm_rig();
        rig.add_keys(0, 0, "rotation", times, values_of(4, false, true), "STEP");
        rig.add_keys(0, 1, "rotation", times, values_of(4, false, true), is_mixed ? "LINEAR" : "STEP");
        rig.add_keys(0, 2, "rotation", times, values_of(4, false, false), is_mixed ? "STEP" : "LINEAR");
        rig.write(folder / "rig.glb");
        const GltfFile file = read_gltf(folder / "rig.glb");
        const std::vector<Quaterniond> turn(file.clip.frame_count, Quaterniond(0, 1, 0, 0));
        const RotationOverride changes[] = {{0, turn}, {1, turn}, {2, turn}};
        write_gltf(folder / "new.glb", file, changes);
        const std::string second = is_mixed ? "LINEAR" : "STEP";
        const std::map<int, std::string> wanted = {{0, "STEP"}, {1, second}, {2, second}};
        CHECK(kinds_of(plain_gltf_of(folder / "new.glb")) == wanted);
    }
}

TEST_CASE("gltf frames: channels with the same keys share them, and all that frames hold is counted")
{
    const TempFolder folder;
    GltfRig rig;
    rig.add_animation("long");
    for (int node = 0; node < 1000; ++node) rig.add("", node - 1, {0, 1, 0});
    rig.add_keys(0, 0, "translation", {0, 2800}, {0, 0, 0, 0, 1, 0});
    json& animation = rig.json["animations"][0];
    const json sampler = animation["samplers"][0];
    for (int node = 1; node < 1000; ++node) {
        animation["channels"].push_back({{"sampler", node % 2}, {"target", {{"node", node}, {"path", "translation"}}}});
        animation["channels"].push_back({{"sampler", node % 2}, {"target", {{"node", node}, {"path", "scale"}}}});
    }
    animation["samplers"].push_back(sampler);
    rig.write(folder / "rig.glb");
    const GltfFile file = read_gltf(folder / "rig.glb", {"", 0.001});
    CHECK(file.channels.size() == 1999);
    CHECK(file.samplers.size() == 1);
    // 168,001 frames of 1000 joints: rotations alone are 5 GiB, with all else 12.5.
    CHECK_THROWS_WITH(read_gltf(folder / "rig.glb"), Catch::Contains("168001 frames of 1000 joints, more than 8 GiB"));
}

TEST_CASE("gltf frames: keys and poses that take more than the choice allows are refused")
{
    const TempFolder folder;
    GltfRig rig = arm_rig();
    rig.add_keys(0, 0, "rotation", times_of(3, 1), values_of(3, false, true));
    rig.write(folder / "rig.glb");
    const auto read = [&](double rate, std::size_t most) { return read_gltf(folder / "rig.glb", {"", rate, most}); };
    CHECK_THROWS_WITH(read(0, 64), Catch::Contains("the keys of animation 0 come to more than"));
    CHECK_THROWS_WITH(read(1000, 4096), Catch::Contains("the animation has 2001 frames of 3 joints, more than"));
    CHECK_NOTHROW(read(1000, 1 << 20));
}
