// SPDX-License-Identifier: MIT
//
// A motion on another skeleton. Bodies are made up, so that what must come out is known without the code: the same body
// in another rest, of another size, in another world, or with other bones. plain_motion.h alone poses what is written.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <random>

#include "tests/gltf_rig.h"
#include "tests/made_body.h"
#include "tests/plain_gltf.h"
#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Any pose that its legs can stand in: knees are bent by 30 to 60 degrees.
std::vector<std::vector<double>> random_rows(const MadeBody& body, int count, double least_elbow = 20,
                                             double most_elbow = 70)
{
    std::mt19937 random(4);
    const auto between = [&](double least, double most) { return std::uniform_real_distribution(least, most)(random); };
    const PlainMotion motion = plain_motion(body.text());
    std::vector<std::vector<double>> rows;
    for (int n = 0; n < count; ++n) {
        std::vector<double>& row = rows.emplace_back(body.rest_row());
        for (const PlainJoint& joint : motion.joints)
            for (std::size_t c = 0; c < joint.channels.size(); ++c) {
                double& value = row[joint.first_channel + c];
                if (joint.channels[c].ends_with("position"))
                    value = between(0, 2);
                else if (joint.name.ends_with("Leg") && !joint.name.ends_with("UpLeg"))
                    value = joint.channels[c] == "Xrotation" ? between(30, 60) : 0;
                else if (joint.name.ends_with("ForeArm"))
                    value = joint.channels[c] == "Yrotation"
                                ? between(least_elbow, most_elbow) * (joint.name[0] == 'L' ? -1 : 1)
                                : 0;
                else
                    value = between(-20, 20);
            }
    }
    return rows;
}

Outcome retarget(const TempFolder& folder, const Words& words, const Words& more = {})
{
    Words all = {"retarget"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), more.begin(), more.end());
    return run_command(folder.path, all);
}

struct Made {
    TempFolder folder{};
    PlainMotion source{}, out{};
    std::string report{};

    Made(const std::string& from, const std::string& to, const Words& options = {})
    {
        spill(folder / "source.bvh", from);
        spill(folder / "target.bvh", to);
        const Outcome outcome = retarget(folder, {"source.bvh", "target.bvh", "--out", "out.bvh"}, options);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        report = outcome.out;
        source = plain_motion_of(folder / "source.bvh");
        out = plain_motion_of(folder / "out.bvh");
        REQUIRE(out.lines.size() == source.lines.size());
    }
    // How far the joint is at most from `expected` of the source's pose.
    double off(const std::string& joint, const auto& expected) const
    {
        double most = 0;
        for (std::size_t frame = 0; frame < out.lines.size(); ++frame)
            most = std::max(most, (at(out, joint, frame).position - expected(frame)).norm());
        return most;
    }
    static PlainPose at(const PlainMotion& motion, const std::string& joint, std::size_t frame)
    {
        return pose_of(motion, frame)[static_cast<std::size_t>(joint_named(motion, joint))];
    }
};

Vector3d in_middle(const PlainMotion& motion, const std::string& joint, std::size_t frame)
{
    return (Made::at(motion, "Left" + joint, frame).position + Made::at(motion, "Right" + joint, frame).position) / 2;
}

}  // namespace

TEST_CASE("retarget: the same body in another rest, size and world takes every place and direction of the source")
{
    const MadeBody source;
    MadeBody target;
    target.size = 40;
    target.arms_down_deg = 50;
    target.legs_out_deg = 15;
    target.toes_out_deg = 20;
    target.world << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // z is up, x ahead, y left
    const Made made(source.text(random_rows(source, 50)), target.text());
    for (const PlainJoint& joint : made.out.joints) {
        INFO(joint.name);
        CHECK(made.off(joint.name, [&](std::size_t frame) {
            return Vector3d(40 * (target.world * Made::at(made.source, joint.name, frame).position));
        }) < 40 * 1e-6);
    }
    CHECK_THAT(made.out.header, Contains("Frame Time: 0.02"));
    CHECK_THAT(made.report, Contains("lengths   40 of TARGET for 1 of SOURCE, by the legs\n"));
    CHECK_THAT(made.report, Contains("at rest   of TARGET: none\nunused    of SOURCE: none\n"));
}

TEST_CASE(
    "retarget: on other bones toes go where the source's are, bent arms reach from the chest, straight ones alike")
{
    const MadeBody source;
    MadeBody target;
    target.forearm = 0.32;
    target.shin = 0.36;
    target.foot = 0.17;
    const double by_leg = (0.45 + 0.36) / (0.45 + 0.42), by_arm = (0.3 + 0.32) / (0.3 + 0.26);
    for (const bool is_bent : {true, false}) {
        INFO(is_bent);
        const auto rows = is_bent ? random_rows(source, 50, 95, 120) : random_rows(source, 50, 10, 35);
        const Made made(source.text(rows), target.text());
        for (const std::string side : {"Left", "Right"}) {
            INFO(side);
            CHECK(made.off(side + "ToeBase", [&](std::size_t frame) {
                return Vector3d(by_leg * Made::at(made.source, side + "ToeBase", frame).position);
            }) < 3e-6);
            CHECK(made.off(side + "Hand", [&](std::size_t frame) {
                const auto from = [&](const PlainMotion& motion) -> Vector3d {
                    return is_bent ? in_middle(motion, "Arm", frame) : Made::at(motion, side + "Arm", frame).position;
                };
                return Vector3d(from(made.out) +
                                by_arm * (Made::at(made.source, side + "Hand", frame).position - from(made.source)));
            }) < 3e-6);
            double turn = 0;
            for (std::size_t frame = 0; frame < 50; ++frame)  // hands keep the source's orientation
                turn = std::max(turn, (Made::at(made.out, side + "Hand", frame).rotation -
                                       Made::at(made.source, side + "Hand", frame).rotation)
                                          .norm());
            CHECK(turn < 1e-5);
        }
    }
}

TEST_CASE("retarget: knees bend as the source's, whatever its bones")
{
    const MadeBody source;
    MadeBody target;
    target.shin = 0.15;  // at the source's places its knees would bend by up to 16 degrees more
    target.foot = 0.19;
    const PlainMotion motion = plain_motion(source.text());
    std::vector<std::vector<double>> rows;
    for (const double knee : {0.0, 5.0, 20.0, 45.0, 80.0}) {
        std::vector<double>& row = rows.emplace_back(source.rest_row());
        for (const std::string side : {"Left", "Right"}) {
            row[motion.joint(joint_named(motion, side + "UpLeg")).first_channel + 1] = -knee / 2;
            row[motion.joint(joint_named(motion, side + "Leg")).first_channel + 1] = knee;
            row[motion.joint(joint_named(motion, side + "Foot")).first_channel + 1] = -knee / 2;
        }
    }
    const Made made(source.text(rows), target.text());
    const PlainArm leg = legs_of(made.source)[0], to = legs_of(made.out)[0];
    for (std::size_t frame = 0; frame < rows.size(); ++frame)
        CHECK(std::abs(arm_pose(made.source, leg, frame).bend() - arm_pose(made.out, to, frame).bend()) < 3 * kRad);
}

TEST_CASE("retarget: spines of other counts divide the turns of the source's evenly")
{
    for (const int count : {1, 2, 3, 6}) {
        INFO(count);
        MadeBody source, target;
        target.spine = count;
        const PlainMotion rest = plain_motion(source.text());
        std::vector<double> row = source.rest_row();
        const double turns[] = {10, -30, 25};
        for (int n = 0; n < 3; ++n) {
            const PlainJoint& joint = rest.joint(joint_named(rest, fmt::format("Spine{}", n + 1)));
            row[joint.first_channel + 1] = turns[n];  // about x
        }
        const Made made(source.text({row}), target.text());
        for (int n = 1; n <= count; ++n) {
            const double place = 3.0 * n / count;  // of the three turns
            double turn = 0;
            for (int k = 0; k < 3; ++k) turn += turns[k] * std::clamp(place - k, 0.0, 1.0);
            CHECK((Made::at(made.out, fmt::format("Spine{}", n), 0).rotation - about(Vector3d::UnitX(), turn)).norm() <
                  1e-6);
        }
    }
}

TEST_CASE("retarget: feet that rest near height 0 stand there again, however the source counts heights")
{
    MadeBody source, target;
    target.size = 0.5;
    target.spine = 3;
    std::string text = target.text();
    const double toe = 0.5 * (0.05 + 0.45 + 0.42 + 0.06);                           // below the hips
    text = edited(text, "OFFSET 0 0 0", fmt::format("OFFSET 0 {} 0", toe + 0.01));  // toes 0.01 over the ground
    std::vector<double> row = source.rest_row();
    row[1] = 7;  // the source's ground is anywhere
    const Made made(source.text({row, row}), text);
    CHECK(std::abs(Made::at(made.out, "LeftToeBase", 1).position.y() - 0.01) < 1e-6);
}

TEST_CASE("retarget: the animation of a glTF target tells its ground")
{
    const MadeBody body;
    const PlainMotion rest = plain_motion(body.text());
    GltfRig rig;
    for (const PlainJoint& joint : rest.joints) rig.add(joint.name, joint.parent, joint.offset);
    const double toe = 0.05 + 0.45 + 0.42 + 0.06;  // below the hips
    const auto y = static_cast<float>(toe + 0.2);  // so the ground is at 0.2
    rig.add_keys(rig.add_animation("Stand"), 0, "translation", {0, 1}, {0, y, 0, 0, y, 0});
    std::vector<double> row = body.rest_row();
    row[1] = 7;  // the source's ground is elsewhere
    const TempFolder folder;
    rig.write(folder / "target.glb");
    spill(folder / "source.bvh", body.text({row, row}));
    const Outcome outcome = retarget(folder, {"source.bvh", "target.glb", "--out", "out.glb"});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const PlainGltf out = plain_gltf_of(folder / "out.glb");
    CHECK(std::abs(plain_world(out, 0, out.node_named("LeftToeBase"), 0).translation().y() - 0.2) < 1e-5);
}

TEST_CASE("retarget: a table on standard output has that to itself")
{
    const TempFolder folder;
    spill(folder / "a.bvh", MadeBody().text());
    spill(folder / "b.bvh", MadeBody().text());
    REQUIRE(retarget(folder, {"a.bvh", "b.bvh", "--export-map", "map.csv"}).exit_code == 0);
    const Outcome outcome = retarget(folder, {"a.bvh", "b.bvh", "--export-map", "-"});
    CHECK(outcome.out == slurp(folder / "map.csv"));
    CHECK_THAT(outcome.err, Contains("source    a.bvh") && Contains("written   to standard output\n"));
}

TEST_CASE("retarget: the table of pairs says who follows whom, and comes back")
{
    MadeBody source, target;
    source.spine = 2;
    const auto rows = random_rows(source, 5);
    const Made found(source.text(rows), target.text(), {"--export-map", "map.csv"});
    const std::string map = slurp(found.folder / "map.csv");
    CHECK_THAT(map, Contains("part,source,target\nhips,Hips,Hips\nspine,Spine1,Spine1\nspine,Spine2,Spine2\n"
                             "spine,,Spine3\n"));
    CHECK_THAT(map, Contains("leftShoulder,LeftShoulder,LeftShoulder\nleftUpperArm,LeftArm,LeftArm\n"));
    const auto again = [&](const std::string& table) {
        spill(found.folder / "map.csv", table);
        return retarget(found.folder, {"source.bvh", "target.bvh", "--map", "map.csv", "--out", "again.bvh"});
    };
    CHECK(again(map).exit_code == 0);
    CHECK(slurp(found.folder / "again.bvh") == slurp(found.folder / "out.bvh"));
    const Outcome headless = again(edited(map, "head,Head,Head\n", ""));
    CHECK(headless.exit_code == 0);
    CHECK_THAT(headless.out, Contains("at rest   of TARGET: Head\nunused    of SOURCE: Head\n"));
    const PlainMotion still = plain_motion_of(found.folder / "again.bvh");
    for (std::size_t n = 0; n < 3; ++n)
        CHECK(still.values[4][still.joint(joint_named(still, "Head")).first_channel + n] == 0);
    const auto complaint = [&](const std::string& table) { return again(table).err; };
    CHECK(complaint("part,from,to\n") == "swivel: map.csv:1: the first line must be part,source,target\n");
    CHECK(complaint("part,source,target\n\nhips,Hip,Hips\n") ==
          "swivel: map.csv:3: 'Hip' is no joint of its file; swivel rig FILE --joints lists them\n");
    CHECK(complaint(edited(map, "head,Head,Head", "head,Head,Neck")) ==
          "swivel: map.csv:7: 'Neck' is already in a line above; remove one\n");
    CHECK_THAT(complaint("part,source,target\nhips,Hips,Hips\nchest,Spine2,Spine3\n"),
               Contains("map.csv:3: 'chest' is no part of a body; take one of hips, spine, neck, head, leftShoulder, "
                        "leftUpperArm, ") &&
                   Contains(", rightFoot, rightToes, or leave it empty"));
    CHECK_THAT(complaint("part,source,target\nhips,Hips\n"), Contains("map.csv:2: 2 values; a row has 3"));
    CHECK_THAT(complaint("part,source,target\nhips,Hips,Hips\n"),
               Contains("source.bvh: no leg of it can be told by the names of its joints; swivel rig says why; name "
                        "them by --leg source:left:HIP,KNEE,ANKLE"));
}

TEST_CASE("retarget: limbs and heads that names do not tell are named by hand, of either body")
{
    const MadeBody body;
    const Made known(body.text(random_rows(body, 5)), body.text());
    const TempFolder folder;
    // Every name says another thing, or nothing; a number says the same.
    const auto unnamed = [](std::string text) {
        for (const auto& [name, other] :
             {std::pair("LeftUpLeg", "a"), {"LeftLeg", "b"}, {"LeftFoot", "c"}, {"RightForeArm", "d"}, {"Head", "e"}})
            text = edited(text, fmt::format("JOINT {}\n", name), fmt::format("JOINT {}\n", other));
        return text;
    };
    spill(folder / "plain.bvh", slurp(known.folder / "source.bvh"));
    spill(folder / "unnamed.bvh", unnamed(slurp(known.folder / "source.bvh")));
    const auto lines = [&](const std::string& from, const std::string& to, const Words& more) {
        const Outcome outcome = retarget(folder, {from, to, "--out", "out.bvh"}, more);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        CHECK_THAT(outcome.out, Contains("at rest   of TARGET: none\nunused    of SOURCE: none\n"));
        return plain_motion_of(folder / "out.bvh").lines;
    };
    const auto by_hand = [](const std::string& whose) {
        return Words{"--leg", whose + "left:a,b,c", "--arm", whose + "RightArm,d,RightHand", "--head", whose + "e"};
    };
    const auto wanted = lines("plain.bvh", "plain.bvh", {});
    CHECK(lines("unnamed.bvh", "plain.bvh", by_hand("source:")) == wanted);
    CHECK(lines("plain.bvh", "unnamed.bvh", by_hand("target:")) == wanted);
    const auto complaint = [&](const Words& more, int exit_code) {
        const Outcome outcome = retarget(folder, {"unnamed.bvh", "plain.bvh"}, more);
        CHECK(outcome.exit_code == exit_code);
        return outcome.err;
    };
    CHECK(complaint({"--leg", "left:a,b,c"}, 2) ==
          "swivel: --leg left:a,b,c: does not say whose; write source: or target: in front\n");
    CHECK_THAT(complaint({"--head", "source:e", "--map", "map.csv"}, 2), Contains("--head: --map says already"));
    CHECK_THAT(complaint({"--head", "source:e", "--head", "source:Neck"}, 2), Contains("--head: a body has one head"));
    CHECK_THAT(complaint({"--head", "source:Kopf"}, 1),
               Contains("unnamed.bvh: no joint is called 'Kopf' (--head); swivel rig --joints lists them"));
    CHECK_THAT(complaint({"--head", "target:LeftHand"}, 1),
               Contains("plain.bvh: 'LeftHand' is the figure's leftHand (--head); name its head"));
}

TEST_CASE("retarget: garbage is said, and written only if it is asked for")
{
    const TempFolder folder;
    const MadeBody body;
    spill(folder / "a.bvh", body.text(random_rows(body, 1)));
    spill(folder / "b.bvh", body.text());
    // A table that takes the arms for the legs.
    REQUIRE(retarget(folder, {"a.bvh", "b.bvh", "--export-map", "map.csv"}).exit_code == 0);
    std::string map = slurp(folder / "map.csv");
    for (const auto& [leg, arm] :
         {std::pair("LeftUpLeg", "LeftArm"), {"LeftLeg", "LeftForeArm"}, {"LeftFoot", "LeftHand"}}) {
        map = edited(map, fmt::format(",{},", leg), ",?,");
        map = edited(edited(map, fmt::format(",{},", arm), fmt::format(",{},", leg)), ",?,", fmt::format(",{},", arm));
    }
    spill(folder / "wrong.csv", map);
    const Words words = {"a.bvh", "b.bvh", "--map", "wrong.csv", "--out", "c.bvh"};
    const Outcome garbage = retarget(folder, words);
    CHECK(garbage.exit_code == 1);
    CHECK_THAT(garbage.out, Contains("garbage   the left "));
    CHECK_THAT(garbage.err, Contains("; the motion is not written; ") && Contains("or give --force"));
    CHECK(!fs::exists(folder / "c.bvh"));
    CHECK(retarget(folder, words, {"--force"}).exit_code == 0);
    CHECK(fs::exists(folder / "c.bvh"));
}

TEST_CASE("retarget: rest poses and up are chosen for either body")
{
    const TempFolder folder;
    const MadeBody body;
    const auto rows = random_rows(body, 3);
    spill(folder / "a.bvh", body.text(rows));
    spill(folder / "b.bvh", body.text(rows));
    const auto report = [&](const Words& options) {
        const Outcome outcome = retarget(folder, {"a.bvh", "b.bvh"}, options);
        return outcome.out.substr(0, outcome.out.find("paired")) + outcome.err;
    };
    const std::string note = "note      frame 1 is taken as the rest pose, and y is up\n";
    CHECK_THAT(report({"--rest", "source:1"}), Contains(note + "target"));
    CHECK_THAT(report({"--rest", "target:1"}), Contains("target") && !Contains(note + "target") && Contains(note));
    CHECK_THAT(report({"--up", "source:x"}),
               Contains("a.bvh: no frame stands along x; --rest says which frame is the rest pose, besides --up"));
    CHECK_THAT(report({"--up", "target:x"}), Contains("b.bvh: no frame stands along x; --rest says which frame"));
    for (const auto& [words, said] : std::vector<std::pair<Words, std::string>>{
             {{"--rest", "1"}, "--rest 1: does not say whose; write source: or target: in front"},
             {{"--rest", "source:y"}, "--rest: y is not a frame"},
             {{"--rest", "source:99999"}, "--rest 99999: it has"},
             {{"--up", "source:up"}, "--up: up is not an axis; give x, y, z, -x, -y or -z"},
             {{"--up", "source:y", "--up", "source:z"}, "--up: it is given twice for one body"}})
        CHECK_THAT(report(words), Contains(said));
}

TEST_CASE("retarget: what cannot be is refused in one line, and nothing is lost")
{
    const TempFolder folder;
    spill(folder / "a.bvh", MadeBody().text());
    spill(folder / "b.bvh", MadeBody().text());
    spill(folder / "rig.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"name":"Hips"}]})");
    const auto complaint = [&](const Words& words) {
        const Outcome outcome = retarget(folder, words);
        CHECK(outcome.exit_code != 0);
        return outcome.err;
    };
    CHECK(complaint({"a.bvh", "b.bvh", "--out", "c.glb"}) ==
          "swivel: --out c.glb: TARGET is a BVH file; its poses go to .bvh\n");
    CHECK_THAT(complaint({"a.bvh", "b.bvh", "--out", "b.bvh"}), Contains("b.bvh: is TARGET, too"));
    CHECK_THAT(complaint({"a.bvh", "b.bvh", "--export-map", "a.bvh"}), Contains("a.bvh: is SOURCE, too"));
    CHECK_THAT(complaint({"-", "-"}), Contains("more than one of SOURCE, TARGET and --map is -"));
    CHECK_THAT(complaint({"a.bvh", "rig.gltf"}), Contains("rig.gltf: no leg of it can be told"));
    CHECK(folder.file_count() == 3);
    MadeBody no_shin, no_forearm;
    no_shin.shin = no_forearm.forearm = 0;
    spill(folder / "no_shin.bvh", no_shin.text());
    spill(folder / "no_forearm.bvh", no_forearm.text());
    const char* const leg = "no_shin.bvh: the bone from LeftLeg to LeftFoot has no length at rest";
    CHECK_THAT(complaint({"no_shin.bvh", "b.bvh", "--out", "c.bvh"}), Contains(leg));
    CHECK_THAT(complaint({"a.bvh", "no_shin.bvh", "--out", "c.bvh"}), Contains(leg));
    const char* const arm = "no_forearm.bvh: the bone from LeftForeArm to LeftHand has no length at rest";
    CHECK_THAT(complaint({"no_forearm.bvh", "b.bvh", "--out", "c.bvh"}), Contains(arm));
    CHECK_THAT(complaint({"a.bvh", "no_forearm.bvh", "--out", "c.bvh"}), Contains(arm));
    CHECK(!fs::exists(folder / "c.bvh"));
}
