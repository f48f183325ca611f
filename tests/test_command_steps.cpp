// SPDX-License-Identifier: MIT
//
// The promise: `swivel steps` prints the lecture's entities of an arm that is given, or of a clip's limb in a frame.
// The clip's arms are held against plain forward kinematics and against their mirror images.
#include <catch2/catch.hpp>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/plain_motion.h"
#include "tests/rig_body.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Eigen::Vector3d;
using Json = nlohmann::json;

namespace {

using Words = std::vector<std::string>;

// What --json has.
struct ToldSteps {
    Vector3d target, pole;
    std::vector<double> lengths;
    std::map<std::string, std::map<std::string, double>> entity;  // blade by blade
    double closing_error;

    double at(const std::string& name, const std::string& blade) const
    {
        const auto found = entity.at(name).find(blade);
        return found == entity.at(name).end() ? 0 : found->second;
    }
    Vector3d vector(const std::string& name) const { return {at(name, "e1"), at(name, "e2"), at(name, "e3")}; }
    Eigen::Vector4d rotor(const std::string& name) const
    {
        return {at(name, "1"), at(name, "i"), at(name, "j"), at(name, "k")};
    }
};

Vector3d vector3(const Json& numbers)
{
    const auto values = numbers.get<std::vector<double>>();
    REQUIRE(values.size() == 3);
    return {values[0], values[1], values[2]};
}

// A folder with a clip of two arms, whose right one does what the left one does in a mirror.
struct StepsStage {
    TempFolder folder;
    PlainMotion motion;

    StepsStage()
    {
        const std::string clip = edited(kTwoArms, "1 2 3 0 10 0 0 20 0 0 -30 0 5 0 0 0 20 0 0 30 0 5 0 0\n",
                                        "1 2 3 7 10 4 15 20 -8 0 -40 0 5 0 0 -15 -20 -8 0 40 0 -5 0 0\n");
        spill(folder / "clip.bvh", clip);
        motion = plain_motion(clip);
    }
    Outcome run(Words words) const
    {
        words.insert(words.begin(), "steps");
        return run_command(folder.path, words);
    }
    ToldSteps told(Words words) const
    {
        words.push_back("--json");
        const Outcome outcome = run(words);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        REQUIRE(outcome.err.empty());
        const Json json = Json::parse(outcome.out);
        ToldSteps steps{vector3(json.at("target")), vector3(json.at("pole")), {}, {}, 0};
        json.at("lengths").get_to(steps.lengths);
        for (const Json& entity : json.at("entities"))
            entity.at("coefficients").get_to(steps.entity[entity.at("name").get<std::string>()]);
        REQUIRE(steps.entity.size() == json.at("entities").size());
        steps.closing_error = json.at("closing_error");
        return steps;
    }
    void require_refused(const Words& words, int exit_code, const std::string& said) const
    {
        const Outcome outcome = run(words);
        INFO(outcome.err);
        CHECK(outcome.exit_code == exit_code);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, StartsWith("swivel: ") && Contains(said));
    }
};

// At rest these arms lie along x and -x, which is their e3; both bend towards +z, which is their e2.
Vector3d in_arm_frame(const PlainArmPose& at, const Vector3d& place, bool is_right)
{
    const Vector3d local = at.parent.transpose() * (place - at.shoulder);
    return is_right ? Vector3d(-local.y(), local.z(), -local.x()) : Vector3d(local.y(), local.z(), local.x());
}

}  // namespace

TEST_CASE("steps: without an option it is the lecture's example, whose answer is known")
{
    const StepsStage stage;
    const ToldSteps steps = stage.told({});
    // By a program for dense multivectors, to six digits.
    CHECK((steps.vector("p_e") - Vector3d(0.980883, 0.980883, -0.189039)).norm() < 2e-6);
    CHECK(std::abs(steps.at("c4", "1") + 0.005494) < 1e-6);
    CHECK((steps.rotor("q_e") - Eigen::Vector4d(0.705162, -0.709047, 0, 0)).norm() < 2e-6);
    CHECK((steps.rotor("q12") - Eigen::Vector4d(0, 0.532689, 0.532689, 0.657637)).norm() < 2e-6);
    CHECK((steps.rotor("q_s") - Eigen::Vector4d(0.251667, 0.288289, 0.695991, 0.607577)).norm() < 2e-6);
    CHECK(steps.closing_error < 1e-15);

    const Outcome text = stage.run({});
    REQUIRE(text.exit_code == 0);
    CHECK_THAT(text.out,
               StartsWith("arm      target (1.1, 1.1, 1.1), pole (1.1, 1.1, 0), upper arm 1.4, forearm 1.3\n"));
    for (const char* step : {"\nstep 1 ", "\nstep 2 ", "\nstep 3 ", "\nstep 4 ", "\nstep 5 "})
        CHECK_THAT(text.out, Contains(step));
    CHECK_THAT(text.out, Contains("\np_e        = 0.98088") && Contains("\nq_e        = 0.70516") &&
                             Contains("the sphere about the target"));
    const ToldSteps given = stage.told({"--target", "1,0,0.5", "--pole", "0,1,0", "--lengths", "0.75,0.625"});
    CHECK(given.target == Vector3d(1, 0, 0.5));
    CHECK(given.pole == Vector3d(0, 1, 0));
    CHECK(given.lengths == std::vector{0.75, 0.625});
}

TEST_CASE("steps: a clip's limb in a frame is seen from its arm frame, a right arm in the mirror")
{
    const StepsStage stage;
    const std::vector<PlainArm> arms = arms_of(stage.motion);
    for (const std::size_t frame : {0u, 1u})
        for (const PlainArm& arm : arms) {
            INFO(arm.side << " " << frame);
            const bool is_right = arm.side == "right";
            const PlainArmPose at = arm_pose(stage.motion, arm, frame);
            const ToldSteps steps =
                stage.told({"clip.bvh", "--limb", arm.side + "_arm", "--frame", std::to_string(frame)});
            // The frame's own rotation is of floats.
            CHECK((steps.target - in_arm_frame(at, at.wrist, is_right)).norm() < 1e-6 * arm.length());
            CHECK((steps.pole - in_arm_frame(at, at.elbow, is_right)).norm() < 1e-6 * arm.length());
            CHECK(steps.lengths.at(0) == Approx(arm.upper).epsilon(1e-12));
            CHECK(steps.lengths.at(1) == Approx(arm.fore).epsilon(1e-12));
            CHECK((steps.vector("p_e") - steps.pole).norm() < 1e-9 * arm.length());  // the clip's own elbow
            CHECK(steps.closing_error < (frame == 0 ? 1e-12 : 1e-7));  // c3 is -1 in the second one: half the digits
        }
    const ToldSteps left = stage.told({"clip.bvh"}), right = stage.told({"clip.bvh", "--limb", "right_arm"});
    const Eigen::Vector4d in_mirror(1, 1, -1, -1);         // e1 turned over; the first frame's arms are mirror images
    for (const char* rotor : {"q_e", "q12", "q3", "q_s"})  // q and -q are one rotation
        CHECK(std::abs(left.rotor(rotor).dot(right.rotor(rotor).cwiseProduct(in_mirror))) > 1 - 1e-12);
    const ToldSteps named = stage.told({"clip.bvh", "--arm", "left:#1,#2,#3"});
    CHECK(named.target == left.target);
}

TEST_CASE("steps: a limb of a mirrored figure has the steps of its mirror image")
{
    const StepsStage stage;
    Body body;
    body.rest = {20, 35, 15, 40};
    body.turn = Eigen::AngleAxisd(0.3, Vector3d(1, 2, -1).normalized());
    for (const bool is_mirrored : {false, true}) {
        if (is_mirrored) body.scale = {-1, 1, 1};
        GltfRig rig;
        const BodyNodes nodes = add_body(rig, body);
        const int animation = rig.add_animation("swing");
        for (const LimbNodes& limb : nodes)
            rig.add_keys(animation, limb[0], "rotation", {0, 1}, turns(Vector3d(1, -2, 3).normalized(), {10, 50}));
        rig.write(stage.folder / (is_mirrored ? "mirrored.glb" : "plain.glb"));
    }
    for (const std::string limb : kLimbs) {
        INFO(limb);
        const ToldSteps plain = stage.told({"plain.glb", "--limb", limb, "--frame", "1"});
        const ToldSteps mirrored = stage.told({"mirrored.glb", "--limb", limb, "--frame", "1"});
        CHECK(plain.target.norm() > 0.1);
        CHECK((plain.target - mirrored.target).norm() < 1e-6);
        CHECK((plain.pole - mirrored.pole).norm() < 1e-6);
        CHECK((plain.rotor("q_e") - mirrored.rotor("q_e")).norm() < 1e-6);
    }
}

TEST_CASE("steps: what gives no steps is refused, with what to do")
{
    const StepsStage stage;
    stage.require_refused({"clip.bvh", "--frame", "2"}, 1, "frame 2 does not exist; the clip has frames 0 to 1");
    stage.require_refused({"clip.bvh", "--limb", "left_leg"}, 1, "left leg");
    stage.require_refused({"none.bvh"}, 1, "none.bvh");
    stage.require_refused({"--target", "9,0,0"}, 1, "the target is too far by 6.3; change --target");
    stage.require_refused({"--lengths", "1e30,1"}, 2, "--lengths 1e30,1: each number must be a bone's length, 1e-15");
    stage.require_refused({"--lengths", "1,1e-30"}, 2, "--lengths 1,1e-30: each number");
    stage.require_refused({"--target", "1,-1e30,0"}, 2, "--target 1,-1e30,0: each number must be a coordinate");
    stage.require_refused({"--pole", "1e16,0,0"}, 2, "--pole 1e16,0,0: each number");
    stage.require_refused({"--target", "1,0"}, 2, "'1,0' is not 3 numbers");
    stage.require_refused({"--lengths", "0,1"}, 2, "above 0");
    stage.require_refused({"clip.bvh", "--target", "1,0,0"}, 2, "--target");
    for (const Words& about_file : std::vector<Words>{{"--arm", "a,b,c"},
                                                      {"--leg", "a,b,c"},
                                                      {"--clip", "0"},
                                                      {"--fps", "30"},
                                                      {"--frame", "1"},
                                                      {"--limb", "left_leg"}}) {
        stage.require_refused(about_file, 2, about_file.front());
        stage.require_refused(about_file, 2, "FILE");
    }
    stage.require_refused({"clip.bvh", "--leg", "#1,#2,#3"}, 2, "--leg names a leg, but --limb left_arm is an arm");
    stage.require_refused({"clip.bvh", "--limb", "left_leg", "--arm", "#1,#2,#3"}, 2,
                          "--arm names an arm, but --limb left_leg is a leg");
}

TEST_CASE("steps: of a limb without steps it names file, frame, limb and reason, and no function")
{
    const StepsStage stage;
    const std::string straight = edited(kTwoArms, "1 2 3 0 10 0 0 20 0 0 -30 0 5 0 0 0 20 0 0 30 0 5 0 0\n",
                                        "1 2 3 0 10 0 0 20 0 0 0 0 5 0 0 0 20 0 0 30 0 5 0 0\n");
    spill(stage.folder / "straight.bvh", straight);
    const Outcome left = stage.run({"straight.bvh"});
    INFO(left.err);
    CHECK(left.exit_code == 1);
    CHECK_THAT(left.err, StartsWith("swivel: straight.bvh: frame 0, left_arm: ") &&
                             Contains("; take another --frame or --limb\n") && !Contains("swivel_steps"));
    CHECK(stage.run({"straight.bvh", "--limb", "right_arm"}).exit_code == 0);
    CHECK_THAT(stage.run({"--pole", "2.2,2.2,2.2"}).err,
               !Contains("swivel_steps") && Contains("change --target, --pole"));
}
