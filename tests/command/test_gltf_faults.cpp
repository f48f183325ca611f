// SPDX-License-Identifier: MIT
//
// glTF files that are large, endless or deep: they work, or end in one line, and take no more time and memory than
// their size asks for. And what the command says of frames at uneven times.
#include <catch2/catch.hpp>

#include "tests/gltf_clip.h"
#include "tests/gltf_rig.h"
#include "tests/plain_gltf.h"
#include "tests/run_command.h"

using namespace swivel::test;
using namespace swivel::formats;
using Catch::Contains;
using nlohmann::json;

namespace {

// A left arm that bends, keyed at these times.
GltfRig bending_arm(const std::vector<float>& times)
{
    GltfRig rig;
    const int arm = rig.add("LeftArm", -1, {0, 0, 0}), fore = rig.add("LeftForeArm", arm, {1, 0, 0.5});
    rig.add("LeftHand", fore, {1, 0, 0});
    std::vector<float> values;
    for (std::size_t n = 0; n < times.size(); ++n)
        for (const float part : n % 2 ? std::array{0.6f, 0.0f, 0.0f, 0.8f} : std::array{0.0f, 0.0f, 0.0f, 1.0f})
            values.push_back(part);
    rig.add_keys(rig.add_animation("move"), arm, "rotation", times, values);
    return rig;
}

// A GLB's header that promises so many bytes.
std::string glb_head(std::uint32_t size)
{
    std::string glb = GltfRig::glb("{}", "").substr(0, 12);
    for (std::size_t n = 0; n < 4; ++n) glb[8 + n] = static_cast<char>(size >> (8 * n) & 0xff);
    return glb;
}

}  // namespace

TEST_CASE("gltf faults: of a device or a pipe no more is read than the file says it has")
{
    const TempFolder folder;
    const auto refuses = [&](const Outcome& outcome, const char* part) {
        INFO(outcome.err);
        CHECK(outcome.exit_code == 1);
        CHECK_THAT(outcome.err, Contains(part));
        CHECK(outcome.peak_kib < 200'000);
    };
    fs::create_symlink("/dev/zero", folder / "zero.glb");
    refuses(spawn_command(folder.path, {"rig", "zero.glb"}), "begins with '\\x00\\x00");
    // Three GiB, of which the header says that twenty, or none, are the file.
    bending_arm({0, 1}).write(folder / "arm.glb");
    const std::string good = slurp(folder / "arm.glb");
    spill(folder / "long.glb", good);
    fs::resize_file(folder / "long.glb", std::uintmax_t{3} << 30);
    CHECK(read_clip(folder / "long.glb").clip.joints.size() == 3);
    const Outcome outcome = spawn_command(folder.path, {"rig", "long.glb"});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.peak_kib < 200'000);
    spill(folder / "empty.glb", glb_head(0));
    fs::resize_file(folder / "empty.glb", std::uintmax_t{3} << 30);
    refuses(spawn_command(folder.path, {"rig", "empty.glb"}), "the GLB says it has 0 bytes");
    // A header alone makes no room for what it promises.
    refuses(run_command(folder.path, {"rig", "-"}, glb_head(4'000'000'000)), "has 4000000000 bytes and has 12");
    CHECK(run_command(folder.path, {"rig", "-"}, good + "more than the GLB has").exit_code == 0);
    spill(folder / "long.gltf", "{");
    fs::resize_file(folder / "long.gltf", std::uintmax_t{3} << 30);
    CHECK_THROWS_WITH(read_gltf(folder / "long.gltf"), Contains("is longer than 2 GiB; cut it, or write it as .glb"));
}

// In square time it would take hours.
TEST_CASE("gltf faults: a chain of many nodes is read and written")
{
    const TempFolder folder;
    constexpr std::size_t kCount = 300'000;
    std::string text = R"({"asset":{"version":"2.0"},"nodes":[)";
    for (std::size_t n = 0; n + 1 < kCount; ++n)
        text += R"({"name":"bone","translation":[0,1,0],"children":[)" + std::to_string(n + 1) + "]},";
    spill(folder / "chain.gltf", text + R"({"name":"end"}]})");
    const GltfFile file = read_clip(folder / "chain.gltf");
    const int last = find_joints(file.clip, "end").at(0);
    CHECK(joint_path(file.clip, last).size() == 5 * kCount - 2);
    CHECK(world_pose(file.clip, 0).back().position.y() == kCount - 1);
    const std::vector<Eigen::Quaterniond> turn = {Eigen::Quaterniond(0, 1, 0, 0)};
    const JointKeys change[] = {{last, turn}};
    write_gltf(folder / "new.glb", file, change);
    CHECK(plain_gltf_of(folder / "new.glb").json["nodes"].size() == kCount);
}

TEST_CASE("gltf faults: uneven frames are solved, and what needs even ones asks for --fps")
{
    const TempFolder folder;
    bending_arm({0, 0.1f, 0.5f, 0.6f}).write(folder / "arm.glb");
    spill(folder / "second.toml", "[limb.left_arm]\n[limb.left_arm.swivel]\nmost_deg_per_second = 90\n");
    const auto solve = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"solve", "arm.glb", "--limbs", "arms"});
        return run_command(folder.path, options);
    };
    const Outcome one = solve({"--out", "new.glb"});
    INFO(one.err);
    REQUIRE(one.exit_code == 0);
    CHECK_THAT(one.out, Contains("4 frames, at the times of its keys"));
    CHECK(json::parse(solve({"--json"}).out).at("frame_time").is_null());
    const Outcome crowd = solve({"--characters", "2"}), limit = solve({"--crowd", "second.toml"});
    CHECK(crowd.exit_code == 1);
    CHECK_THAT(crowd.err, Contains("arm.glb: its keys lie at uneven times") && Contains("give --fps"));
    CHECK(limit.exit_code == 1);
    CHECK_THAT(limit.err, Contains("second.toml:3: ") && Contains("give --fps"));
    spill(folder / "look.toml", "[look]\ntarget = [1, 2, 3]\n");
    CHECK_THAT(solve({"--crowd", "look.toml"}).err,
               Contains("look.toml:1: look: the clip's keys lie at uneven times; give --fps"));
    CHECK(solve({"--characters", "2", "--fps", "30"}).exit_code == 0);
    CHECK(solve({"--crowd", "second.toml", "--fps", "30"}).exit_code == 0);
    CHECK(json::parse(solve({"--json", "--fps", "10"}).out).at("frames") == 7);
}
