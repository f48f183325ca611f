// SPDX-License-Identifier: MIT
//
// Skeletons whose names or rest poses say one thing and mean another: knock-knees, a clavicle that is called as the
// upper arm is, two figures in one file. What `swivel rig` takes of them is the truth, or it refuses.
#include "tests/rig_report.h"

using namespace swivel::test;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

// Standing legs, whose shins are turned at rest about `axis` by these degrees. If degrees are given for the clip, it
// bends the knees to them about +x, as knees bend.
GltfRig legs(const Vector3d& axis, double at_rest, const std::vector<double>& clip)
{
    GltfRig rig;
    const int hips = rig.add("Hips", -1, {0, 1, 0});
    const int animation = clip.empty() ? -1 : rig.add_animation("walk");
    for (const std::string side : {"Left", "Right"}) {
        const int thigh = rig.add(side + "UpLeg", hips, {side == "Left" ? 0.1 : -0.1, 0, 0});
        const int shin = rig.add(side + "Leg", thigh, {0, -0.5, 0}, Quaterniond(AngleAxisd(at_rest * kDegree, axis)));
        rig.add(side + "Toe", rig.add(side + "Foot", shin, {0, -0.5, 0}), {0, 0, 0.1});
        std::vector<float> times;
        for (std::size_t n = 0; n < clip.size(); ++n) times.push_back(static_cast<float>(n) / 30);
        if (animation >= 0) rig.add_keys(animation, shin, "rotation", times, turns(Vector3d::UnitX(), clip));
    }
    return rig;
}

json left_knee(const GltfRig& rig) { return limb_of(rig_report(rig), "left_leg"); }
double off_knee(const json& limb) { return degrees_between(vector_of(limb.at("bend")), -Vector3d::UnitZ()); }
}  // namespace

TEST_CASE("rigs: a clip that bends a limb more and otherwise than its rest pose says the bend")
{
    const Vector3d across = Vector3d::UnitZ(), along = Vector3d::UnitX();
    const std::vector<double> walk = {10, 40, 60, 40};
    for (const double valgus : {5.5, 8.0, 10.0}) {  // knock-knees
        const json knee = left_knee(legs(across, valgus, walk));
        CHECK(knee.at("bend_source") == "mean bend of the clip");
        CHECK(off_knee(knee) < 1e-3);
    }
    // A rest pose that bends little is believed where the clip bends as it does, however little that is.
    for (const double little : {6.0, 12.0, 19.0})
        for (const std::vector<double>& idle : {std::vector<double>{3, 4, 6, 4}, {2, 2, 3}}) {
            CHECK(left_knee(legs(along, -little, idle)).at("bend_source") == "mean bend of the clip");
            CHECK(off_knee(left_knee(legs(along, -little, idle))) < 1e-3);
            CHECK(left_knee(legs(along, little, idle)).at("bend_source").get<std::string>().starts_with("bend of the"));
            CHECK(left_knee(legs(across, little, idle)).at("bend_source") == "mean bend of the clip");
        }
    for (const double back : {-7.0, -25.0}) {  // pressed through
        const json knee = left_knee(legs(along, back, walk));
        CHECK(knee.at("bend_source") == "mean bend of the clip");
        CHECK(off_knee(knee) < 1e-3);
    }

    const auto rests = [](const json& limb) {
        return limb.at("bend_source").get<std::string>().starts_with("bend of the rest pose");
    };
    CHECK(rests(left_knee(legs(along, 10, walk))));                 // both agree
    CHECK(rests(left_knee(legs(across, 25, {5, 10, 15, 10}))));     // the clip bends less
    CHECK(rests(left_knee(legs(across, 25, walk))));                // or hardly more
    CHECK(rests(left_knee(legs(across, 25, {}))));                  // there is no clip
    CHECK(rests(left_knee(legs(across, 25, {-60, 60, -60, 60}))));  // the clip says nothing
}

TEST_CASE("rigs: a rest pose that bends little and otherwise than knees do is refused where no clip tells")
{
    const auto problem = [](const Vector3d& axis, double at_rest, const std::vector<double>& clip) {
        return left_knee(legs(axis, at_rest, clip)).value("problem", "");
    };
    const Vector3d across = Vector3d::UnitZ(), along = Vector3d::UnitX();
    CHECK(problem(along, -7, {}) ==
          "at rest it bends by 7.0 degrees, 180 degrees off the way that knees bend backwards, facing by the toes, and "
          "no clip tells which holds; use a clip that bends it, or give limb.left_leg.bend in a crowd file: "
          "[0.000, 0.000, 1.000] as at rest, [0.000, 0.000, -1.000] as knees bend backwards");
    for (const double valgus : {-19.0, -6.0, 6.0, 19.0}) {
        CHECK(problem(across, valgus, {}).find("90 degrees off the way that knees bend") != std::string::npos);
        CHECK(problem(across, valgus, {-60, 60, -60, 60}).find("no clip tells") != std::string::npos);
        CHECK(problem(across, valgus, {10, 60}).empty());
    }
    CHECK(left_knee(legs(along, 165, {})).at("bend_source") == "bend of the rest pose, 165.0 degrees");  // folded
    CHECK(problem(across, 178, {}).starts_with("neither rest pose nor clip tells"));  // by more than tells an axis
    for (const auto& [turn, is_refused] : {std::pair(55.0, false), {65.0, true}, {-55.0, false}, {-65.0, true}})
        CHECK(problem(AngleAxisd(turn * kDegree, Vector3d::UnitY()) * along, 12, {}).empty() != is_refused);

    // What the message has to choose from is what a crowd file takes.
    const TempFolder folder;
    legs(along, -7, {}).write(folder / "rig.glb");
    spill(folder / "crowd.toml",
          "[limb.left_leg]\nbend = [0.000, 0.000, -1.000]\n[limb.right_leg]\nbend = [0.000, 0.000, -1.000]\n");
    const Outcome outcome = run_command(folder.path, {"solve", "rig.glb", "--limbs", "legs", "--crowd", "crowd.toml"});
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
}

TEST_CASE("rigs: a slight bend at rest tells near the way that the limb bends, not across")
{
    const auto is_slight = [](const json& limb) {
        return limb.at("bend_source").get<std::string>().starts_with("slight bend");
    };
    for (const double turn : {-80.0, -50.0, 50.0, 80.0, 170.0}) {
        const json knee = left_knee(legs(AngleAxisd(turn * kDegree, Vector3d::UnitY()) * Vector3d::UnitX(), 3, {}));
        INFO(turn);
        CHECK_FALSE(is_slight(knee));
        CHECK(off_knee(knee) < 10);
    }
    for (const double turn : {-40.0, 0.0, 40.0})
        CHECK(is_slight(left_knee(legs(AngleAxisd(turn * kDegree, Vector3d::UnitY()) * Vector3d::UnitX(), 3, {}))));
}

TEST_CASE("rigs: what is called a part of a bone must be one by its place")
{
    // An arm, Unreal's names, in two parts; the second at `middle`, turned by these degrees in the clip.
    const auto problem = [](const Vector3d& middle, const std::vector<double>& degrees, const Vector3d& axis,
                            const std::vector<std::string>& options = {}) {
        GltfRig rig;
        const int first = rig.add("upperarm01_l", rig.add("Hips", -1, {0, 0, 0}), {0, 1, 0});
        const int second = rig.add("upperarm02_l", first, middle);
        rig.add("wrist_l", rig.add("lowerarm01_l", second, Vector3d(0.4, 0, 0) - middle), {0.3, 0, 0});
        const int animation = rig.add_animation("wave");
        rig.add_keys(animation, second, "rotation", {0, 1.0f / 30}, turns(axis, degrees));
        return limb_of(rig_report(rig, options), "left_arm").value("problem", "");
    };
    const Vector3d half = {0.2, 0, 0}, along = Vector3d::UnitX(), up = Vector3d::UnitZ();
    CHECK(problem(half, {0, 80}, along).empty());  // it twists
    CHECK(problem(half, {0, 20}, up).empty());     // half the bone by 20 degrees: the whole by 10
    CHECK(problem(half, {0, 29}, up).empty());
    CHECK(problem(half, {0, 31}, up).find("turns it by 16 degrees in frame 1") != std::string::npos);
    CHECK(
        problem(half, {0, 60}, up) ==
        "'upperarm02_l' on the bone from 'upperarm01_l' to 'lowerarm01_l' turns it by 30 degrees in frame 1; name the "
        "joints");
    CHECK(
        problem({0.2, 0.06, 0}, {0, 0}, up) ==
        "'upperarm02_l' on the bone from 'upperarm01_l' to 'lowerarm01_l' is off its line by 15 % of its length; name "
        "the joints");
    for (const double beyond : {-0.1, 0.5})  // on the line, not on the bone
        CHECK(problem({beyond, 0, 0}, {0, 0}, up).find("by 25 % of its length") != std::string::npos);
    CHECK(problem({0, 0, 0}, {0, 80}, up).empty());  // at the shoulder's place: it is the shoulder's turn
    CHECK(problem(half, {0, 60}, up, {"--arm", "left:upperarm01_l,lowerarm01_l,wrist_l"}).empty());
}

TEST_CASE("rigs: a joint at the place of the next is no stranger, but for rounding, one aside is")
{
    const auto problem = [](double aside) {
        GltfRig rig;
        const int upper = rig.add("LeftArm", rig.add("Hips", -1, {0, 0, 0}), {0.2, 1, 0});
        const int pivot = rig.add("LeftForeArm_$AssimpFbx$_PreRotation", upper, {0.3, 0, 0});
        const int elbow =
            rig.add("LeftForeArm", pivot, {0, aside, 0}, Quaterniond(AngleAxisd(-0.5, Vector3d::UnitY())));
        rig.add("LeftHand", elbow, {0.3, 0, 0});
        return problem_of(rig_report(rig), "left_arm");
    };
    for (const double rounding : {0.0, 5e-16, 1e-6}) CHECK(problem(rounding).empty());
    CHECK(problem(1e-3).ends_with("and is no twist bone by its name"));
}

TEST_CASE("rigs: twist bones do not count where the parts of a bone divide it evenly")
{
    GltfRig rig;
    const int upper = rig.add("DEF-upper_arm.L", rig.add("Hips", -1, {0, 0, 0}), {0.2, 1, 0});
    const int half = rig.add("DEF-upper_arm.L.001", upper, {0.2, 0, 0});
    const int twist = rig.add("upper_arm_twist.L", half, {0.16, 0, 0});
    const int elbow = rig.add("DEF-forearm.L", twist, {0.04, 0, 0}, Quaterniond(AngleAxisd(-0.5, Vector3d::UnitY())));
    rig.add("DEF-hand.L", elbow, {0.3, 0, 0});
    CHECK(problem_of(rig_report(rig), "left_arm").empty());
}

TEST_CASE("rigs: the parts of a bone are judged together")
{
    const auto problem = [](double each) {
        GltfRig rig;
        int at = rig.add("upperarm01_l", rig.add("Hips", -1, {0, 0, 0}), {0, 1, 0});
        const int animation = rig.add_animation("wave");
        for (const char* name : {"upperarm02_l", "upperarm03_l", "upperarm04_l"}) {
            at = rig.add(name, at, {0.05, 0, 0});
            rig.add_keys(animation, at, "rotation", {0, 1.0f / 30}, turns(Vector3d::UnitZ(), {0, each}));
        }
        const int elbow = rig.add("lowerarm01_l", at, {0.35, 0, 0}, Quaterniond(AngleAxisd(-0.5, Vector3d::UnitY())));
        rig.add("wrist_l", elbow, {0.3, 0, 0});
        return problem_of(rig_report(rig), "left_arm");
    };
    CHECK(problem(5).empty());
    CHECK(
        problem(14).starts_with("'upperarm02_l', 'upperarm03_l', 'upperarm04_l' on the bone from 'upperarm01_l' to "
                                "'lowerarm01_l' turn it by 3"));
}

TEST_CASE("rigs: what may be the joint that a bone turns in must show in a clip that it is none")
{
    // An arm, a joint `at` on its upper or lower bone; joint and bone's own turned about `axis` and z in the clip's
    // second key.
    struct Between {
        std::string name = "LeftArmRoll";
        bool lower = false;
        double at = 0.3, own = 40, turn = 0;
        Vector3d axis = Vector3d::UnitX();
        std::vector<float> times = {0, 1.0f / 30};
        std::vector<std::string> options = {};
    };
    const auto problem = [](const Between& with) {
        GltfRig rig;
        const bool blender = with.name.ends_with(".001");
        const int upper = rig.add(blender ? "Arm.L" : "LeftArm", rig.add("Hips", -1, {0, 0, 0}), {0.2, 1, 0});
        const double before = with.lower ? 0 : with.at, after = with.lower ? with.at : 0;
        const int first = with.lower ? upper : rig.add(with.name, upper, {before, 0, 0});
        const int elbow = rig.add(blender ? "ForeArm.L" : "LeftForeArm", first, {1 - before, 0, 0},
                                  Quaterniond(AngleAxisd(-0.5, Vector3d::UnitY())));
        const int second = with.lower ? rig.add(with.name, elbow, {after, 0, 0}) : elbow;
        rig.add(blender ? "Hand.L" : "LeftHand", second, {1 - after, 0, 0});
        if (!with.times.empty()) {
            const int animation = rig.add_animation("wave");
            const auto keys = [&](double degrees) {
                return std::vector<double>(with.times.size() == 1 ? std::vector{degrees} : std::vector{0.0, degrees});
            };
            const Quaterniond rest(AngleAxisd(with.lower ? -0.5 : 0, Vector3d::UnitY()));
            std::vector<float> own;
            for (const double degrees : keys(with.own))
                for (const double part :
                     Eigen::Vector4d((Quaterniond(AngleAxisd(degrees * kDegree, Vector3d::UnitZ())) * rest).coeffs()))
                    own.push_back(static_cast<float>(part));
            rig.add_keys(animation, with.lower ? elbow : upper, "rotation", with.times, own);
            rig.add_keys(animation, with.lower ? second : first, "rotation", with.times,
                         turns(with.axis, keys(with.turn)));
        }
        return problem_of(rig_report(rig, with.options), "left_arm");
    };
    const Vector3d up = Vector3d::UnitZ();
    CHECK(problem({.turn = 80}).empty());
    CHECK(problem({.turn = 14, .axis = up}).empty());
    CHECK(problem({.own = -40, .turn = 16, .axis = up}) ==
          "'LeftArmRoll' on the bone from 'LeftArm' to 'LeftForeArm' swings what hangs on it by 16 degrees in frame 1; "
          "name the joints");
    const std::string unshown =
        "'LeftArmRoll' on the bone from 'LeftArm' to 'LeftForeArm' may be the joint that it turns in, and the clip "
        "does "
        "not show that it is none; use a clip that swings it, or name the joints";
    CHECK(problem({.own = 14, .turn = 80}) == unshown);
    CHECK(problem({.own = 16, .turn = 80}).empty());
    CHECK(problem({.times = {}}) == unshown);
    CHECK(problem({.at = 0.5, .times = {}}).empty());  // it divides the bone evenly
    CHECK_FALSE(problem({.at = 0.5, .turn = 16, .axis = up}).empty());
    CHECK(problem({.times = {0}}) == unshown);  // one pose is no motion
    CHECK(problem({.own = -40, .turn = 16, .axis = up, .options = {"--arm", "left:LeftArm,LeftForeArm,LeftHand"}})
              .empty());
    CHECK(problem({.name = "LeftForeArmRoll", .lower = true, .turn = 80}).empty());
    CHECK_FALSE(problem({.name = "LeftForeArmRoll", .lower = true, .turn = 16, .axis = up}).empty());
    CHECK_FALSE(problem({.name = "LeftForeArmRoll", .lower = true, .own = 10}).empty());
    // A twist bone by name is one unless it swings.
    CHECK(problem({.name = "LeftArmTwist", .times = {}}).empty());
    CHECK(problem({.name = "LeftArmTwist", .own = 10, .turn = 80}).empty());
    CHECK(problem({.name = "LeftArmTwist", .own = 10, .turn = 14, .axis = up}).empty());
    CHECK(problem({.name = "LeftArmTwist", .turn = 16, .axis = up}).find("hangs on it by 16 degrees") !=
          std::string::npos);
    // Rigify divides its bones evenly; a clavicle called as the upper arm is does not.
    for (const double even : {0.46, 0.5, 0.54}) CHECK(problem({.name = "Arm.L.001", .at = even, .times = {}}).empty());
    for (const double uneven : {0.33, 0.44, 0.56, 0.8}) {
        CHECK(problem({.name = "Arm.L.001", .at = uneven, .times = {}}).find("may be the joint") != std::string::npos);
        CHECK(problem({.name = "Arm.L.001", .at = uneven}).empty());
        CHECK_FALSE(problem({.name = "Arm.L.001", .at = uneven, .turn = 16, .axis = up}).empty());
    }
}

TEST_CASE("rigs: the limbs of two figures are not taken for one's")
{
    // Each figure has these limbs under usual names.
    using Limbs = std::vector<std::string>;
    const auto report_of = [](const std::vector<Limbs>& figures, const std::string& trunk = "Hips",
                              const std::vector<std::string>& options = {}) {
        GltfRig rig;
        const int root = rig.add("Scene", -1, {0, 0, 0});
        for (std::size_t n = 0; n < figures.size(); ++n) {
            const int hips = rig.add(n == 0 ? "Hips" : trunk, root, {2.0 * static_cast<double>(n), 1, 0});
            for (const std::string& limb : figures[n]) {
                const double x = limb.starts_with("Left") ? 1 : -1;
                const bool arm = limb.ends_with("Arm");
                const std::string side = x > 0 ? "Left" : "Right";
                const Vector3d bone = arm ? Vector3d(0.3 * x, 0, 0) : Vector3d(0, -0.4, 0);
                const int upper = rig.add(side + (arm ? "Arm" : "UpLeg"), hips, {0.2 * x, arm ? 0.5 : 0, 0});
                const int lower = rig.add(side + (arm ? "ForeArm" : "Leg"), upper, bone);
                rig.add(side + (arm ? "Hand" : "Foot"), lower, bone);
            }
        }
        return rig_report(rig, options);
    };
    const json sides = report_of({{"LeftArm", "LeftLeg"}, {"RightArm", "RightLeg"}});
    for (const char* limb : {"left_arm", "right_arm", "left_leg", "right_leg"})
        CHECK(problem_of(sides, limb).ends_with(": two figures"));
    CHECK(problem_of(sides, "right_arm") == "it hangs on 'Hips' (#8), the left arm on 'Hips' (#1): two figures");
    const json levels = report_of({{"LeftArm", "RightArm"}, {"LeftLeg", "RightLeg"}}, "b:Hips");
    CHECK(problem_of(levels, "left_leg") == "it hangs on 'b:Hips' (#8), the left arm on 'Hips' (#1): two figures");
    // Arms alone are one figure's, and do not face by the legs of the other.
    const json arms = report_of({{"LeftArm", "RightArm"}, {"LeftLeg", "RightLeg"}}, "Hips", {"--limbs", "arms"});
    CHECK(problem_of(arms, "left_arm").empty());
    CHECK(arms.at("up_by") == "the file's +Y");
    // What the user names is taken; the other side by its names is another figure's.
    const json named = report_of({{"LeftArm"}, {"RightArm"}}, "Hips", {"--arm", "left:LeftArm,LeftForeArm,LeftHand"});
    CHECK(problem_of(named, "left_arm").empty());
    CHECK(problem_of(named, "right_arm").ends_with(": two figures"));
    // One figure whose arms hang on the chest.
    const json one = report_of({{"LeftArm", "RightArm", "LeftLeg", "RightLeg"}});
    for (const char* limb : {"left_arm", "right_arm", "left_leg", "right_leg"}) CHECK(problem_of(one, limb).empty());
}

TEST_CASE("rigs: nodes moved by KHR_animation_pointer are not taken to rest")
{
    const TempFolder folder;
    GltfRig rig = legs(Vector3d::UnitX(), 0, {0, 40});
    auto& channel = rig.json["animations"][0]["channels"][0];
    rig.json["extensionsUsed"] = {"KHR_animation_pointer"};
    const auto solve = [&](const std::string& pointer) {
        channel["target"] = {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
        rig.write(folder / "rig.glb");
        return run_command(folder.path, {"solve", "rig.glb", "--limbs", "legs"});
    };
    const Outcome refused = solve("/nodes/2/rotation");
    CHECK(refused.exit_code == 1);
    CHECK(
        refused.err ==
        "swivel: rig.glb: animation 0 moves /nodes/2/rotation by KHR_animation_pointer, which is not read; export the "
        "motion of nodes as plain channels\n");
    CHECK(solve("/materials/0/emissiveFactor").exit_code == 0);
    CHECK(solve("/nodes/2/extensions/KHR_lights_punctual/intensity").exit_code == 0);
}
