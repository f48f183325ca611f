// SPDX-License-Identifier: MIT
//
// Skeletons whose names or rest poses say one thing and mean another: knock-knees, a clavicle that is called as the
// upper arm is, a heel where toes would be, two figures in one file. What `swivel rig` takes of them is the truth, or
// it refuses.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

#include "tests/gltf_rig.h"
#include "tests/run_command.h"

using namespace swivel::test;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::vector<float> turns(const Vector3d& axis, const std::vector<double>& degrees)
{
    std::vector<float> keys;
    for (const double angle : degrees) {
        const Quaterniond q(AngleAxisd(angle * kDegree, axis));
        for (const double value : {q.x(), q.y(), q.z(), q.w()}) keys.push_back(static_cast<float>(value));
    }
    return keys;
}

json rig_report(const GltfRig& rig, const std::vector<std::string>& options = {})
{
    const TempFolder folder;
    rig.write(folder / "rig.glb");
    std::vector<std::string> words = {"rig", "rig.glb", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run_command(folder.path, words);
    INFO(outcome.err);
    REQUIRE(!outcome.out.empty());
    return json::parse(outcome.out);
}

json limb_of(const json& report, const std::string& name)
{
    for (const json& limb : report.at("limbs"))
        if (limb.at("limb") == name) return limb;
    FAIL("no limb " + name);
    return {};
}

Vector3d vector_of(const json& numbers) { return Vector3d(numbers[0], numbers[1], numbers[2]); }

double degrees_between(const Vector3d& a, const Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

// Legs that stand, their shins turned at rest about `axis` by these degrees; the clip bends the knees about +x, as
// knees bend, to these degrees, where there are any.
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

// A knee's hinge: flexion, which turns the shin about +x, turns it about minus this.
json left_knee(const GltfRig& rig) { return limb_of(rig_report(rig), "left_leg"); }
double off_knee(const json& limb) { return degrees_between(vector_of(limb.at("hinge")), -Vector3d::UnitX()); }

}  // namespace

TEST_CASE("rigs: a clip that bends a limb more and otherwise than its rest pose says the hinge")
{
    const Vector3d across = Vector3d::UnitZ(), along = Vector3d::UnitX();
    const std::vector<double> walk = {10, 40, 60, 40};
    for (const double valgus : {5.5, 8.0, 10.0}) {  // knock-knees
        const json knee = left_knee(legs(across, valgus, walk));
        CHECK(knee.at("hinge_source") == "mean bend of the clip");
        CHECK(off_knee(knee) < 1e-3);
    }
    for (const double back : {-7.0, -25.0}) {  // pressed through
        const json knee = left_knee(legs(along, back, walk));
        CHECK(knee.at("hinge_source") == "mean bend of the clip");
        CHECK(off_knee(knee) < 1e-3);
    }

    const auto rests = [](const json& limb) {
        return limb.at("hinge_source").get<std::string>().starts_with("bend of the rest pose");
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
          "no clip tells which holds; choose an animation that bends it, or give limb.left_leg.hinge in a crowd file: "
          "[1.000, 0.000, 0.000] as at rest, [-1.000, 0.000, 0.000] as knees bend backwards");
    for (const double valgus : {-19.0, -6.0, 6.0, 19.0}) {
        CHECK(problem(across, valgus, {}).find("90 degrees off the way that knees bend") != std::string::npos);
        CHECK(problem(across, valgus, {-60, 60, -60, 60}).find("no clip tells") != std::string::npos);
        CHECK(problem(across, valgus, {10, 60}).empty());
    }
    for (const auto& [turn, is_refused] : {std::pair(55.0, false), {65.0, true}, {-55.0, false}, {-65.0, true}})
        CHECK(problem(AngleAxisd(turn * kDegree, Vector3d::UnitY()) * along, 12, {}).empty() != is_refused);
}

TEST_CASE("rigs: straight limbs of a figure of which nothing says where its front is are refused")
{
    // Straight arms at +-x of a chest that stands on hips, the whole turned; a root above may be scaled.
    const auto arms = [](const Quaterniond& turn, const std::vector<std::string>& sides, const Vector3d& scale,
                         double bend) {
        GltfRig rig;
        const int root = rig.add("Root", -1, {0, 0, 0}, Quaterniond::Identity(), scale);
        const int chest = rig.add("Chest", rig.add("Hips", root, {0, 0, 0}, turn), {0, 0.5, 0});
        for (const std::string& side : sides) {
            const double x = side == "Left" ? 1 : -1;
            const int upper = rig.add(side + "Arm", chest, {0.2 * x, 0.1, 0});
            const int lower = rig.add(side + "ForeArm", upper, {0.3 * x, 0, 0},
                                      Quaterniond(AngleAxisd(-bend * x * kDegree, Vector3d::UnitY())));
            rig.add(side + "Hand", lower, {0.3 * x, 0, 0});
        }
        const json said = rig_report(rig);
        const json limb = limb_of(said, sides[0] == "Left" ? "left_arm" : "right_arm");
        CHECK(said.contains("faces_in_doubt") == (bend > 0 || limb.contains("problem")));
        return limb.value("problem", "");
    };
    const auto turned = [](double degrees, const Vector3d& axis) {
        return Quaterniond(AngleAxisd(degrees * kDegree, axis));
    };
    const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ(), even = {1, 1, 1};
    const std::vector<std::string> both = {"Left", "Right"}, left = {"Left"}, right = {"Right"};
    const auto says = [](const std::string& problem, const char* part) {
        INFO(problem);
        return problem.find(part) != std::string::npos;
    };
    CHECK(arms(Quaterniond::Identity(), both, even, 0).empty());
    CHECK(arms(turned(180, y), both, even, 0).empty());
    CHECK(arms(turned(50, x), both, even, 0).empty());
    for (const double back : {-90.0, 70.0, 90.0, 180.0}) {  // +z is up, or the figure lies
        CHECK(says(arms(turned(back, x), both, even, 0), "does not stand along the file's +Y; choose an animation"));
        CHECK(arms(turned(back, x), both, even, 25).empty());  // the rest pose tells
    }
    CHECK(says(arms(turned(90, z) * turned(90, y), both, even, 0), "does not stand along"));
    CHECK(says(arms(turned(90, z), both, even, 0), "its shoulders lie above each other"));
    CHECK(says(arms(Quaterniond::Identity(), both, {-1, 1, 1}, 0), "leaves open whether left and right are exchanged"));
    for (const auto& side : {left, right}) {
        CHECK(arms(Quaterniond::Identity(), side, even, 0).empty());
        CHECK(arms(turned(40, y), side, even, 0).empty());
        for (const double away : {90.0, 180.0, 270.0})
            CHECK(says(arms(turned(away, y), side, even, 0), "it is not on its side of a figure that faces"));
    }
}

TEST_CASE("rigs: a roll bone between two joints must show in a clip that it only rolls")
{
    // A shoulder turned by `shoulder` degrees, a roll bone on its upper arm turned about `axis` by `roll`; 0, 0: no
    // clip.
    const auto problem = [](double shoulder, const Vector3d& axis, double roll, const std::string& name = "LeftArmRoll",
                            const std::vector<std::string>& options = {}) {
        GltfRig rig;
        const int upper = rig.add("LeftArm", rig.add("Hips", -1, {0, 0, 0}), {0.2, 1, 0});
        const int between = rig.add(name, upper, {0.1, 0, 0});
        const int lower =
            rig.add("LeftForeArm", between, {0.2, 0, 0}, Quaterniond(AngleAxisd(-0.5, Vector3d::UnitY())));
        rig.add("LeftHand", lower, {0.3, 0, 0});
        if (shoulder != 0 || roll != 0) {
            const int animation = rig.add_animation("wave");
            rig.add_keys(animation, upper, "rotation", {0, 1.0f / 30}, turns(Vector3d::UnitZ(), {0, shoulder}));
            rig.add_keys(animation, between, "rotation", {0, 1.0f / 30}, turns(axis, {0, roll}));
        }
        return limb_of(rig_report(rig, options), "left_arm").value("problem", "");
    };
    const Vector3d along = Vector3d::UnitX(), up = Vector3d::UnitZ();
    CHECK(problem(40, along, 80).empty());
    CHECK(problem(40, up, 10).empty());
    CHECK(problem(-40, up, 20) ==
          "'LeftArmRoll' turns the bone from 'LeftArm' to 'LeftForeArm' by 20 degrees in frame 1, so is no part of it; "
          "name the joints");
    const std::string unshown =
        "'LeftArmRoll' on the bone from 'LeftArm' to 'LeftForeArm' may be the joint that it turns in, and no clip "
        "shows "
        "that it only rolls; name the joints";
    CHECK(problem(0, along, 0) == unshown);
    CHECK(problem(10, along, 80) == unshown);  // nothing here swings
    CHECK(problem(0, along, 0, "LeftArmTwist").empty());
    CHECK(problem(10, up, 80, "LeftArmTwist").empty());
    CHECK(problem(-40, up, 20, "LeftArmRoll", {"--arm", "left:LeftArm,LeftForeArm,LeftHand"}).empty());
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
    const auto problem = [](const json& report, const char* limb) {
        return limb_of(report, limb).value("problem", "");
    };
    const json sides = report_of({{"LeftArm", "LeftLeg"}, {"RightArm", "RightLeg"}});
    for (const char* limb : {"left_arm", "right_arm", "left_leg", "right_leg"})
        CHECK(problem(sides, limb).ends_with(": two figures"));
    CHECK(problem(sides, "right_arm") == "it hangs on 'Hips' (#8), the left arm on 'Hips' (#1): two figures");
    const json levels = report_of({{"LeftArm", "RightArm"}, {"LeftLeg", "RightLeg"}}, "Hips_1");
    CHECK(problem(levels, "left_leg") == "it hangs on 'Hips_1' (#8), the left arm on 'Hips' (#1): two figures");
    // Arms alone are one figure's, and do not face by the legs of the other.
    const json arms = report_of({{"LeftArm", "RightArm"}, {"LeftLeg", "RightLeg"}}, "Hips", {"--limbs", "arms"});
    CHECK(problem(arms, "left_arm").empty());
    CHECK(arms.at("up_by") == "the file's +Y");
    // What the user names is taken; the other side by its names is another figure's.
    const json named = report_of({{"LeftArm"}, {"RightArm"}}, "Hips", {"--arm", "left:LeftArm,LeftForeArm,LeftHand"});
    CHECK(problem(named, "left_arm").empty());
    CHECK(problem(named, "right_arm").ends_with(": two figures"));
    // One figure whose arms hang on the chest.
    const json one = report_of({{"LeftArm", "RightArm", "LeftLeg", "RightLeg"}});
    for (const char* limb : {"left_arm", "right_arm", "left_leg", "right_leg"}) CHECK(problem(one, limb).empty());
}

TEST_CASE("rigs: a slight bend at rest tells near the way that the limb bends, not across")
{
    const auto is_slight = [](const json& limb) {
        return limb.at("hinge_source").get<std::string>().starts_with("slight bend");
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

TEST_CASE("rigs: what hangs on a foot and points elsewhere is no toe")
{
    // Straight legs that face +z, these joints below each foot.
    const auto faces = [](const std::vector<std::pair<std::string, Vector3d>>& below, bool mirrored = false) {
        GltfRig rig;
        const int hips = rig.add("Hips", -1, {0, 1, 0});
        for (const std::string side : {"Left", "Right"}) {
            const double x = (side == "Left") == mirrored ? -0.1 : 0.1;
            int at = rig.add(side + "UpLeg", hips, {x, 0, 0});
            at = rig.add(side + "Foot", rig.add(side + "Leg", at, {0, -0.5, 0}), {0, -0.5, 0});
            for (const auto& [name, step] : below) rig.add(side + name, at, {10 * x * step.x(), step.y(), step.z()});
        }
        const json report = rig_report(rig);
        return std::pair(vector_of(report.at("faces")), report.at("faces_by").get<std::string>());
    };
    const std::string by_hips = "left and right hip", by_toes = "the toes";
    const auto is = [](const std::pair<Vector3d, std::string>& said, const Vector3d& way, const std::string& by) {
        CHECK(degrees_between(said.first, way) < 1e-3);
        CHECK(said.second == by);
    };
    const Vector3d front = Vector3d::UnitZ();
    is(faces({{"Heel", {0, -0.02, -0.05}}}), front, by_hips);
    is(faces({{"Socket", {0.05, 0, -0.01}}}), front, by_hips);
    is(faces({{"Bone", {0.02, -0.02, 0.1}}}), front, by_toes);  // turned out, both alike
    is(faces({{"ToeBack", {0, 0, -0.16}}, {"ToeInner", {0, 0, 0.1}}}), front, by_hips);
    is(faces({{"ToeBack", {0, 0, -0.1}}, {"ToeInner", {0.01, 0, 0.1}}}), front, by_hips);
    is(faces({{"ToeBack", {0, 0, -0.16}}, {"ToeInner", {0, 0, 0.1}}, {"ToeOuter", {0.02, 0, 0.1}}}), front, by_toes);
    // A mirror that was baked into the joints: the toes know.
    is(faces({{"Toe", {0, 0, 0.1}}}, true), front, by_toes);
    is(faces({{"Bone", {0, 0, 0.1}}}, true), -front, by_hips);
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
    CHECK(problem(half, {0, 31}, up).find("by 16 degrees in frame 1, so is no part of it") != std::string::npos);
    CHECK(problem(half, {0, 60}, up) ==
          "'upperarm02_l' turns the bone from 'upperarm01_l' to 'lowerarm01_l' by 30 degrees in frame 1, so is no part "
          "of it; name the joints");
    CHECK(
        problem({0.2, 0.06, 0}, {0, 0}, up) ==
        "'upperarm02_l' is off the line from 'upperarm01_l' to 'lowerarm01_l' by 15 % of its length, so is no part of "
        "it; name the joints");
    for (const double beyond : {-0.1, 0.5})  // on the line, not on the bone
        CHECK(problem({beyond, 0, 0}, {0, 0}, up).find("by 25 % of its length, so is no part of") != std::string::npos);
    CHECK(problem({0, 0, 0}, {0, 80}, up).empty());  // at the shoulder's place: it is the shoulder's turn
    CHECK(problem(half, {0, 60}, up, {"--arm", "left:upperarm01_l,lowerarm01_l,wrist_l"}).empty());
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
