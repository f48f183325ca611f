// SPDX-License-Identifier: MIT
//
// Which way limbs bend that rest straight or nearly so, as `swivel rig` tells it, and where it refuses to.
#include "tests/rig_body.h"

using namespace swivel::test;
using Eigen::Vector3d;
using nlohmann::json;

TEST_CASE("rig bends: straight arms that point ahead, behind or overhead, and legs that do not hang, are refused")
{
    const auto left_arm = [](const Vector3d& bone) {
        return limb_of(rig_report(rig_of({.left_bone = bone})), "left_arm");
    };
    const auto is_bound = [&](const Vector3d& bone) { return left_arm(bone).at("bound").get<bool>(); };
    const auto point = [](double degrees, const Vector3d& from, const Vector3d& to) -> Vector3d {
        return 0.3 * (std::cos(degrees * kDegree) * from + std::sin(degrees * kDegree) * to);
    };
    // Swings the arm forwards and back from hanging, about its own hinge. Then swings it level out of a T-pose, with a
    // hinge that stays upright.
    for (const double degrees : {-55.0, -20.0, 0.0, 20.0, 55.0}) {
        for (const auto& [start, hinge] : {std::pair(Vector3d(-kY), kX), std::pair(kX, kY)}) {
            const Vector3d bone = point(degrees, start, kZ);
            const json limb = left_arm(bone);
            INFO(limb.dump());
            REQUIRE(limb.at("bound").get<bool>());
            CHECK(limb.at("bend_source").get<std::string>().starts_with("elbows bend forwards"));
            CHECK(degrees_between(vector_of(limb.at("bend")), bone.cross(hinge)) < 1);
        }
    }
    for (const double degrees : {-115.0, -90.0, -65.0, 65.0, 90.0, 115.0})
        for (const Vector3d& start : {Vector3d(-kY), kX}) CHECK_FALSE(is_bound(point(degrees, start, kZ)));
    CHECK(is_bound(point(40, kX, kY)));
    CHECK_FALSE(is_bound(point(50, kX, kY)));
    CHECK_FALSE(is_bound(0.3 * kY));
    const std::string anywhere = "the arm points ahead, behind or overhead, where straight ones bend either way";
    CHECK(problem_of(rig_report(rig_of({.left_bone = 0.3 * kZ})), "left_arm")
              .starts_with("neither rest pose nor clip tells which way it bends, and " + anywhere));
    // A bend of 5 to 20 degrees has nothing to be held against; above, or with a clip, the limb tells itself.
    const Vector3d ahead = point(80, -kY, kZ);
    CHECK(problem_of(rig_report(rig_of({.left_bone = ahead, .elbow = 12})), "left_arm")
              .starts_with("at rest it bends by 12.0 degrees, too little to tell its way, no clip tells, and " +
                           anywhere));
    CHECK(problem_of(rig_report(rig_of({.left_bone = ahead, .elbow = 25})), "left_arm").empty());
    CHECK(problem_of(rig_report(rig_of({.left_bone = ahead, .clip_elbow = 25})), "left_arm").empty());
    // Inwards of ahead: an own arm's T-pose counts, not the other's.
    CHECK_FALSE(is_bound({-0.145, -0.078, 0.251}));
    CHECK_FALSE(is_bound({-0.145, -0.026, 0.261}));
    CHECK_FALSE(is_bound({0.19, 0.096, -0.213}));  // raised behind the shoulder: both swings agree, and not forwards
    // Of legs, one alone: two would put the front in doubt.
    const auto leg = [&](double degrees) {
        const json report = rig_report(
            rig_of({.leg_bone = 1.5 * point(degrees, -kY, kZ), .limbs = {"LeftArm", "RightArm", "LeftUpLeg"}}));
        CHECK(report.value("faces_in_doubt", "").empty());
        return problem_of(report, "left_leg");
    };
    CHECK(leg(0).empty());
    CHECK(leg(59).empty());
    CHECK(leg(61).ends_with("use a clip that bends it, or give limb.left_leg.bend in a crowd file"));
}

TEST_CASE("rig bends: a small bend at rest is believed where the figure tells as much, not beside the file's axes")
{
    for (const double bend : {6.0, 12.0, 19.0}) {
        CHECK(problem_of(rig_report(rig_of({.hips = -0.1, .knee = bend})), "left_leg").empty());
        const std::string problem =
            problem_of(rig_report(rig_of({.limbs = {"LeftArm"}, .turn = turned(180, kY), .elbow = bend})), "left_arm");
        CHECK(problem.find("degrees, too little to tell its way, no clip tells, and the left arm is not on its side") !=
              std::string::npos);
    }
    CHECK(problem_of(rig_report(rig_of({.limbs = {"LeftArm"}, .turn = turned(180, kY), .elbow = 21})), "left_arm")
              .empty());
    // Legs that lie along the file's +Z, of a figure that nothing tells: no way to face is up.
    const json lies = rig_report(rig_of({.hips = 0.001, .limbs = kLegs, .turn = turned(90, kX)}));
    CHECK(degrees_between(vector_of(lies.at("faces")), vector_of(lies.at("up"))) == Approx(90));
    CHECK(problem_of(lies, "left_leg").find("neither shoulders nor hips tell left from right") != std::string::npos);
}

TEST_CASE("rig bends: limbs that bend otherwise than the figure faces put it in doubt, and are bound themselves")
{
    CHECK(doubt_of({.clip_elbow = 40}).empty());
    CHECK(doubt_of({.clip_knee = 40}).empty());
    CHECK(doubt_of({.elbow = 40, .clip_knee = 40}).empty());
    const std::string by = "does not bend as in a figure that faces by left and right shoulder";
    CHECK(doubt_of({.clip_elbow = -40}) == "the left arm " + by);
    CHECK(doubt_of({.clip_knee = -40}) == "the left leg " + by);
    CHECK(doubt_of({.shoulders = -0.2, .hips = -0.1, .left_bone = {-0.3, 0, 0}, .clip_knee = 40}) ==
          "the left leg " + by);
    // Left and right exchanged, known by little; knees pressed through, of which no toes say that they are no more.
    CHECK(doubt_of({.shoulders = -0.2, .hips = -0.1, .left_bone = {-0.3, 0, 0}, .knee = 3}) == "the left leg " + by);
    CHECK(doubt_of({.shoulders = -0.2, .hips = -0.1, .left_bone = {-0.3, 0, 0}, .elbow = 3}) == "the left arm " + by);
    const Body exchanged = {
        .shoulders = -0.2, .hips = -0.1, .left_bone = {-0.3, 0, 0}, .on_foot = {{"Heel", {0, 0, -0.1}}}, .knee = 3};
    CHECK(doubt_of(exchanged) == "the left leg does not bend as in a figure that faces by the toes");  // a heel is none
    CHECK(doubt_of({.knee = -2.1}) == "the left leg " + by);
    CHECK(doubt_of({.knee = -1.9}).empty());
    CHECK(doubt_of({.knee = 3, .knee_axis = kZ}).empty());  // aside
    CHECK(doubt_of({.on_foot = {{"Toe", {0, 0, 0.1}}}, .knee = -3}).empty());
    // Others bend more, and as they should.
    CHECK(doubt_of({.elbow = 40, .knee = -3}).empty());
    CHECK(doubt_of({.knee = -3, .clip_knee = 60}).empty());
    CHECK(doubt_of({.knee = 2.5, .right_knee = -3}) == "the right leg " + by);
    CHECK(doubt_of({.knee = -2.5, .right_knee = 3}).empty());
    CHECK(doubt_of({.knee = -3, .clip_elbow = 40}).empty());
    CHECK(doubt_of({.knee = -3, .clip_elbow = -40}) == "the left arm " + by);
    // It speaks for itself, with both ways to choose from.
    CHECK(problem_of(rig_report(rig_of({.limbs = {"LeftArm"}, .elbow = -12})), "left_arm").find("] as at rest, [") !=
          std::string::npos);
}

TEST_CASE("rig bends: a clip that leaves a limb as it rests does not say how it bends")
{
    // Knees pressed through, that a clip of the arms keeps so.
    const auto knees = [](double rest, double turn) {
        GltfRig rig = rig_of({.on_foot = {{"Toe", {0, 0, 0.1}}}, .knee = rest, .clip_elbow = 40});
        if (turn != 0)
            for (std::size_t n = 0; n < rig.json["nodes"].size(); ++n)
                if (rig.json["nodes"][n]["name"].get<std::string>().ends_with("Leg") &&
                    rig.json["nodes"][n]["name"].get<std::string>().find("Up") == std::string::npos)
                    rig.add_keys(0, static_cast<int>(n), "rotation", {0, 1.0f / 30},
                                 turns(kX, {rest + turn, rest + 2 * turn}));
        return limb_of(rig_report(rig), "left_leg");
    };
    CHECK(knees(-12, 0).at("problem").get<std::string>().starts_with("at rest it bends by 12.0 degrees, 180 degrees"));
    CHECK(knees(-3, 0).at("bend_source").get<std::string>().starts_with("knees bend backwards"));
    CHECK(knees(-3, 0.5).at("bend_source").get<std::string>().starts_with("knees bend backwards"));
    CHECK(knees(-12, 30).at("bend_source") == "mean bend of the clip");
}
