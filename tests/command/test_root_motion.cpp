// SPDX-License-Identifier: MIT
//
// `--root-motion`: a joint `root` on the ground takes the way and the heading of the hips, and no joint moves in the
// world. plain_motion.h and plain_gltf.h alone pose what is written.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <algorithm>

#include "tests/gltf_rig.h"
#include "tests/made_body.h"
#include "tests/plain_gltf.h"
#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

const fs::path kFigure = fs::path(SWIVEL_SOURCE_DIR) / "tools" / "view" / "figure.glb";

// Runs a command twice, without and with --root-motion.
void write_both(const TempFolder& folder, const Words& words, const std::string& suffix)
{
    for (const std::string name : {"plain", "rooted"}) {
        Words all = words;
        all.insert(all.end(), {"--out", name + suffix});
        if (name == "rooted") all.push_back("--root-motion");
        done(run_command(folder.path, all));
    }
}

// Checks every joint of every frame, and the root below the hips, in a world with this up. Returns the root's height.
double require_same_bvh(const TempFolder& folder, const Vector3d& up)
{
    const PlainMotion plain = plain_motion_of(folder / "plain.bvh"), rooted = plain_motion_of(folder / "rooted.bvh");
    REQUIRE(rooted.lines.size() == plain.lines.size());
    REQUIRE(rooted.joints.size() == plain.joints.size() + 1);
    const auto root = static_cast<std::size_t>(joint_named(rooted, "root"));
    const auto hips = static_cast<std::size_t>(joint_named(rooted, "Hips"));
    CHECK(rooted.joints[root].parent == -1);
    CHECK(rooted.joints[hips].parent == static_cast<int>(root));
    double place = 0, turn = 0, beside = 0, tilt = 0, left = 0;
    double lowest = 1e9, highest = -1e9;
    for (std::size_t frame = 0; frame < plain.lines.size(); ++frame) {
        const std::vector<PlainPose> before = pose_of(plain, frame), after = pose_of(rooted, frame);
        for (std::size_t n = 0; n < before.size(); ++n) {
            const PlainPose& same = after[static_cast<std::size_t>(joint_named(rooted, plain.joints[n].name))];
            place = std::max(place, (same.position - before[n].position).norm());
            turn = std::max(turn, turn_between(same.rotation, before[n].rotation));
        }
        const PlainPose &on_ground = after[root], &body = after[hips];
        beside = std::max(beside, up.cross(body.position - on_ground.position).norm());
        tilt = std::max(tilt, (on_ground.rotation * up - up).norm());
        // The hips have no turn about up of their own; BVH rests without rotation.
        const Eigen::Quaterniond own(Matrix3d(on_ground.rotation.transpose() * body.rotation));
        left = std::max(left, std::abs(own.vec().dot(up)));
        lowest = std::min(lowest, on_ground.position.dot(up));
        highest = std::max(highest, on_ground.position.dot(up));
    }
    CHECK(place < 1e-6);
    CHECK(turn < 1e-6);
    CHECK(beside < 1e-6);
    CHECK(tilt < 1e-6);
    CHECK(left < 1e-6);
    CHECK(highest - lowest < 1e-6);
    return highest;
}

// The same of glTF files, whose keys are floats. new_joints: how many nodes `rooted` has more. Returns the root's
// largest height.
double require_same_gltf(const TempFolder& folder, std::size_t new_joints)
{
    const PlainGltf plain = plain_gltf_of(folder / "plain.glb"), rooted = plain_gltf_of(folder / "rooted.glb");
    REQUIRE(rooted.nodes().size() == plain.nodes().size() + new_joints);
    const int root = rooted.node_named("root"), pelvis = rooted.node_named("pelvis");
    const std::vector<double> times = key_times(plain, pelvis, "translation");
    REQUIRE(key_times(rooted, root, "translation").size() == times.size());
    const Matrix3d root_rest = plain_world(rooted, -1, root, 0).linear(),
                   pelvis_rest = plain_world(rooted, -1, pelvis, 0).linear();
    double apart = 0, size = 1, height = 0, tilt = 0, left = 0;
    for (std::size_t n = 0; n < times.size(); n += 7) {
        for (int node = 0; node < static_cast<int>(plain.nodes().size()); ++node) {
            if (node == root) continue;
            const Eigen::Matrix4d before = plain_world(plain, 0, node, times[n]).matrix();
            apart = std::max(apart, (plain_world(rooted, 0, node, times[n]).matrix() - before).norm());
            size = std::max(size, before.norm());
        }
        // From rest the root turns about up alone, and leaves the pelvis no turn about up.
        const Matrix3d heading = plain_world(rooted, 0, root, times[n]).linear() * root_rest.inverse();
        const Matrix3d turn = plain_world(rooted, 0, pelvis, times[n]).linear() * pelvis_rest.inverse();
        tilt = std::max(tilt, (heading * Vector3d::UnitY() - Vector3d::UnitY()).norm());
        const Eigen::Quaterniond own(Matrix3d(heading.transpose() * turn));
        left = std::max(left, std::abs(own.vec().dot(Vector3d::UnitY())));
        const Vector3d root_w = plain_world(rooted, 0, root, times[n]).translation();
        const Vector3d above_w = plain_world(rooted, 0, pelvis, times[n]).translation() - root_w;
        CHECK(above_w.cross(Vector3d::UnitY()).norm() < 1e-6 * size);
        height = std::max(height, std::abs(root_w.y()));
    }
    CHECK(apart < 1e-6 * size);
    CHECK(tilt < 1e-5);
    CHECK(left < 1e-5);
    return height;
}

}  // namespace

TEST_CASE("root motion: a recorded body moves as without it, by retarget and by feet")
{
    const TempFolder folder;
    spill(folder / "jump.bvh", cut(plain_motion_of(must_find_jump()), 2600, 1));
    for (const Words& words : {Words{"retarget", "jump.bvh", "jump.bvh"}, Words{"feet", "jump.bvh"}}) {
        INFO(words[0]);
        write_both(folder, words, ".bvh");
        const double height = require_same_bvh(folder, Vector3d::UnitY());
        const PlainMotion motion = plain_motion_of(folder / "plain.bvh");
        const PlainArm leg = legs_of(motion)[0];
        const auto toe = static_cast<std::size_t>(joint_named(motion, "LeftToeBase"));
        CHECK(std::abs(pose_of(motion, 150)[toe].position.y() - height) < 0.05 * leg.length());  // it stands there
    }
}

TEST_CASE("root motion: up is the figure's, and the heading is the hips' turn about it")
{
    const MadeBody body;
    MadeBody target;
    target.world = about(Vector3d::UnitX(), 90);  // up is z
    std::vector<std::vector<double>> rows;
    for (int n = 0; n < 50; ++n) {
        rows.push_back(body.rest_row());
        rows.back()[0] = 0.01 * std::max(n - 12, 0);
        rows.back()[5] = 4 * n;  // Yrotation, through 180
    }
    const TempFolder folder;
    spill(folder / "source.bvh", body.text(rows));
    spill(folder / "target.bvh", target.text());
    write_both(folder, {"retarget", "source.bvh", "target.bvh"}, ".bvh");
    const Vector3d up = target.world * Vector3d::UnitY();
    CHECK(require_same_bvh(folder, up) == Approx(-0.98).epsilon(1e-3));  // where toes are in the source
    const PlainMotion rooted = plain_motion_of(folder / "rooted.bvh");
    for (std::size_t frame = 0; frame < rows.size(); ++frame)
        CHECK(turn_between(pose_of(rooted, frame)[0].rotation, about(up, 4.0 * static_cast<double>(frame))) < 1e-6);
    // Hips that cannot move are told by their line in the file that was read.
    const std::string fixed = edited(body.text(), "CHANNELS 6 Xposition Yposition Zposition ", "CHANNELS 3 ");
    spill(folder / "fixed.bvh", edited(fixed, "Frame Time: 0.02\n0 0 0 ", "Frame Time: 0.02\n"));
    const Outcome outcome =
        run_command(folder.path, {"retarget", "source.bvh", "fixed.bvh", "--root-motion", "--out", "out.bvh"});
    CHECK(outcome.exit_code == 1);
    CHECK(outcome.err ==
          "swivel: fixed.bvh:5: joint 'Hips' cannot take a new position: it has fewer than three position channels; "
          "export the clip with three position channels for it, of X, Y and Z\n");
}

TEST_CASE("root motion: a glTF's new root is a joint of its skin, and one that is there already takes the motion")
{
    const TempFolder folder;
    spill(folder / "jump.bvh", cut(plain_motion_of(must_find_jump()), 2600, 1));
    spill(folder / "base.glb", edited(slurp(kFigure), "\"root\"", "\"base\""));
    write_both(folder, {"retarget", "jump.bvh", "base.glb"}, ".glb");
    CHECK(require_same_gltf(folder, 1) < 1e-6);  // the figure rests on the ground
    CHECK(new_gltf_messages(folder / "base.glb", folder / "rooted.glb") == std::multiset<std::string>());
    const PlainGltf before = plain_gltf_of(folder / "base.glb"), after = plain_gltf_of(folder / "rooted.glb");
    const auto &old_skin = before.json["skins"][0], &skin = after.json["skins"][0];
    CHECK(skin["joints"].size() == old_skin["joints"].size() + 1);
    CHECK(skin["joints"].back() == after.node_named("root"));
    CHECK(after.parent_of(after.node_named("root")) == after.node_named("base"));
    const auto binds = [](const PlainGltf& gltf, const nlohmann::json& of, std::size_t count) {
        const auto& accessor = gltf.json["accessors"][of["inverseBindMatrices"].get<std::size_t>()];
        const auto& view = gltf.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        const std::size_t begin = view.value("byteOffset", 0u) + accessor.value("byteOffset", 0u);
        CHECK(accessor["count"] == of["joints"].size());
        return gltf.buffers.at(0).substr(begin, 64 * count);
    };
    CHECK(binds(after, skin, old_skin["joints"].size()) == binds(before, old_skin, old_skin["joints"].size()));
    // In a clip's own frames, where all else of its animation stays.
    fs::rename(folder / "plain.glb", folder / "clip.glb");
    write_both(folder, {"feet", "clip.glb"}, ".glb");
    CHECK(require_same_gltf(folder, 1) < 0.03);  // where toes stand
    // The figure's own root is right above its hips. It rests turned by -90 degrees about x.
    write_both(folder, {"retarget", "jump.bvh", kFigure.string()}, ".glb");
    CHECK(require_same_gltf(folder, 0) < 1e-6);
}

TEST_CASE("root motion: below a mirrored node a new root and the figure's own take the way")
{
    PlainGltf figure = plain_gltf_of(kFigure);
    const auto node = [&](const char* name) -> nlohmann::json& {
        return figure.json["nodes"][static_cast<std::size_t>(figure.node_named(name))];
    };
    // The armature mirrors x, and the pelvis mirrors it back: all joints below stay where they are.
    const auto negate = [](nlohmann::json& number) { number = -number.get<double>(); };
    for (const char* const name : {"root", "pelvis"})
        for (const int n : {1, 2}) negate(node(name)["rotation"][static_cast<std::size_t>(n)]);
    negate(node("pelvis")["translation"][0]);
    for (const char* const name : {"Armature", "pelvis"}) node(name)["scale"] = {-1, 1, 1};
    figure.json.erase("animations");
    const TempFolder folder;
    spill(folder / "jump.bvh", cut(plain_motion_of(must_find_jump()), 2600, 1));
    for (const std::size_t new_joints : {0u, 1u}) {
        INFO(new_joints);
        if (new_joints > 0) node("root")["name"] = "base";
        spill(folder / "mirrored.glb", GltfRig::glb(figure.json.dump(), figure.buffers.at(0)));
        write_both(folder, {"retarget", "jump.bvh", "mirrored.glb"}, ".glb");
        CHECK(require_same_gltf(folder, new_joints) < 1e-6);
    }
}

TEST_CASE("root motion: a skin's matrices may be zeros without bytes, and must be as many as its joints")
{
    PlainGltf figure = plain_gltf_of(kFigure);
    figure.json["nodes"][static_cast<std::size_t>(figure.node_named("root"))]["name"] = "base";
    const auto number = figure.json["skins"][0]["inverseBindMatrices"].get<std::size_t>();
    nlohmann::json& matrices = figure.json["accessors"][number];
    matrices.erase("bufferView");
    const TempFolder folder;
    spill(folder / "jump.bvh", cut(plain_motion_of(must_find_jump()), 2600, 1));
    const auto run_on = [&] {
        spill(folder / "figure.glb", GltfRig::glb(figure.json.dump(), figure.buffers.at(0)));
        return run_command(folder.path, {"retarget", "jump.bvh", "figure.glb", "--root-motion", "--out", "out.glb"});
    };
    done(run_on());
    const PlainGltf written = plain_gltf_of(folder / "out.glb");
    const std::vector<double>& values = plain_numbers(written, written.json["skins"][0]["inverseBindMatrices"]);
    const std::size_t joint_count = figure.json["skins"][0]["joints"].size();
    REQUIRE(values.size() == 16 * (joint_count + 1));
    CHECK(std::ranges::count(values, 0.0) >= static_cast<std::ptrdiff_t>(16 * joint_count));
    matrices["count"] = joint_count - 1;
    const Outcome outcome = run_on();
    CHECK(outcome.exit_code == 1);
    CHECK(outcome.err == fmt::format("swivel: figure.glb: accessor {} and its skin have different numbers of joints: "
                                     "{} elements, {} are needed; export the file again\n",
                                     number, joint_count - 1, joint_count));
}

TEST_CASE("root motion: another joint of that name is told")
{
    const TempFolder folder;
    const std::string jump = cut(plain_motion_of(must_find_jump()), 2600, 1);
    spill(folder / "jump.bvh", jump);
    spill(folder / "taken.bvh", edited(jump, "JOINT LThumb", "JOINT Root"));
    const std::string line =
        "swivel: taken.bvh: 'Root' has the name that --root-motion gives the joint right above 'Hips'; rename it, or "
        "leave the option out\n";
    for (const Words& words : {Words{"feet", "taken.bvh"}, Words{"retarget", "jump.bvh", "taken.bvh"}}) {
        Words all = words;
        all.insert(all.end(), {"--root-motion", "--out", "out.bvh"});
        const Outcome outcome = run_command(folder.path, all);
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.err == line);
        CHECK_FALSE(fs::exists(folder / "out.bvh"));
    }
    spill(folder / "body.bvh", edited(jump, "ROOT Hips", "ROOT root"));
    const Outcome outcome = run_command(folder.path, {"feet", "body.bvh", "--root-motion", "--out", "out.bvh"});
    CHECK(outcome.exit_code == 1);
    CHECK(
        outcome.err ==
        "swivel: body.bvh: 'root' already carries the motion of the whole body, hips included; rename it to get a new "
        "root above it\n");
    CHECK_FALSE(fs::exists(folder / "out.bvh"));
}
