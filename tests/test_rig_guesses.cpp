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
    CHECK(problem(half, {0, 60}, up) ==
          "what lies between 'upperarm01_l' and 'lowerarm01_l' ('upperarm02_l') turns that bone by 30 degrees in frame "
          "1, so "
          "is no part of it; name the joints");
    CHECK(
        problem({0.2, 0.06, 0}, {0, 0}, up) ==
        "'upperarm02_l' is off the line from 'upperarm01_l' to 'lowerarm01_l' by 15 % of its length, so is no part of "
        "that bone; name the joints");
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
