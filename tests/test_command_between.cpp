// SPDX-License-Identifier: MIT
//
// A table with rows of some frames: what limbs do between them, and what the report says of limbs that were given
// targets.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <random>

#include "tests/crowd_stage.h"
#include "tests/target_table.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Words = std::vector<std::string>;

namespace {

// Twelve frames in which two arms move and all else stands still.
struct StillStage {
    static constexpr std::size_t kFrames = 12;
    TempFolder folder;
    PlainMotion clip;
    std::vector<PlainArm> arms;

    StillStage()
    {
        std::string frames;
        for (std::size_t n = 0; n < kFrames; ++n) {
            const auto turned = [&](int by) { return std::to_string(by * static_cast<int>(n)); };
            frames += "1 2 3 0 10 0 0 2" + std::to_string(n % 10) + " 0 " + turned(1) + " -40 " + turned(2) + " " +
                      turned(3) + " 0 0 0 20 " + turned(2) + " 0 3" + std::to_string(n % 10) + " 0 5 0 " + turned(1) +
                      "\n";
        }
        spill(folder / "clip.bvh", kTwoArms.substr(0, kTwoArms.find("Frames: 2")) +
                                       "Frames: " + std::to_string(kFrames) + "\nFrame Time: .01\n" + frames);
        clip = plain_motion_of(folder / "clip.bvh");
        arms = arms_of(clip);
    }
    Outcome run(Words more) const
    {
        more.insert(more.begin(), {"solve", "clip.bvh"});
        return run_command(folder.path, more);
    }
    std::string report(const std::string& rows, Words more) const
    {
        spill(folder / "t.csv", kTargetHeader + ("\n" + rows));
        more.insert(more.end(), {"--targets", "t.csv"});
        const Outcome outcome = run(more);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return outcome.out;
    }
    PlainMotion motion(const std::string& rows, Words more = {}) const
    {
        more.insert(more.end(), {"--out", "out.bvh"});
        report(rows, more);
        return plain_motion_of(folder / "out.bvh");
    }
};

// What a row asks of the left arm.
struct Key {
    std::size_t frame = 0;
    Vector3d wrist;
    std::optional<Vector3d> pole;
    std::optional<Matrix3d> hand;
};

std::string row_of(const Key& key, double scale = 1, const std::string& limb = "left_arm")
{
    const auto cells = [](const std::string& text) { return "," + text.substr(1, text.size() - 2); };
    std::string row = std::to_string(key.frame) + ",0," + limb + cells(text_of(key.wrist)) +
                      (key.pole ? cells(text_of(*key.pole)) : ",,,");
    if (!key.hand) return row + ",,,,\n";
    const Quaterniond q(*key.hand);
    char w[40];
    std::snprintf(w, sizeof w, ",%.17g\n", scale * q.w());
    return row + cells(text_of(scale * q.vec())) + w;
}

// What a frame asks, by what the documentation says; nothing: it follows the clip.
std::optional<Key> asked(const std::vector<Key>& keys, const std::string& mode, std::size_t frame)
{
    const Key *before = nullptr, *after = nullptr;
    for (const Key& key : keys) {
        if (key.frame == frame) return key;
        if (key.frame < frame) before = &key;
        if (key.frame > frame && !after) after = &key;
    }
    if (mode.empty()) return std::nullopt;
    if (!before || !after || mode == "hold") return before ? *before : *after;
    const double share = static_cast<double>(frame - before->frame) / static_cast<double>(after->frame - before->frame);
    Key key = *before;
    key.wrist += share * (after->wrist - before->wrist);
    if (before->pole && after->pole) *key.pole += share * (*after->pole - *before->pole);
    if (before->hand && after->hand) {  // by the logarithm: at most half a turn
        const Eigen::AngleAxisd turn(Matrix3d(before->hand->transpose() * *after->hand));
        key.hand = *before->hand * Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix();
    }
    return key;
}

Vector3d random_direction(std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

// At least one, in order of frames, where the arm reaches.
std::vector<Key> random_keys(std::mt19937_64& random, const Vector3d& shoulder)
{
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Key> keys;
    for (std::size_t frame = 0; frame < StillStage::kFrames; ++frame) {
        if (random() % 4 != 0 && (frame + 1 < StillStage::kFrames || !keys.empty())) continue;
        Key& key = keys.emplace_back();
        key.frame = frame;
        key.wrist = shoulder + (3 + 4 * unit(random)) * random_direction(random);
        if (random() % 3 != 0) key.pole = shoulder + 9 * random_direction(random);
        if (random() % 3 != 0) {
            const Eigen::AngleAxisd turn(3 * unit(random), random_direction(random));
            key.hand = turn.toRotationMatrix();
        }
    }
    return keys;
}

}  // namespace

TEST_CASE("--between: frames without a row hold the last one, or go straight to the next, by forward kinematics")
{
    const StillStage stage;
    const PlainArm &left = stage.arms[0], &right = stage.arms[1];
    const Vector3d shoulder = arm_pose(stage.clip, left, 0).shoulder;
    std::size_t wrists = 0, elbows = 0, hands = 0;
    const auto worst = [](double difference, double limit, std::size_t& count) {
        RC_ASSERT(difference < limit);
        ++count;
    };
    rc::prop("random keys", [&](std::uint32_t seed) {
        std::mt19937_64 random(seed);
        const std::vector<Key> keys = random_keys(random, shoulder);
        const std::string mode = std::array{"", "hold", "linear"}[random() % 3];
        std::string rows;
        for (const Key& key : keys) rows += row_of(key, random() % 2 == 0 ? 1 : -1.5);  // q and -q are one turn
        const PlainMotion solved = stage.motion(rows, mode.empty() ? Words() : Words{"--between", mode});
        for (std::size_t frame = 0; frame < StillStage::kFrames; ++frame) {
            const PlainArmPose from = arm_pose(stage.clip, left, frame), to = arm_pose(solved, left, frame);
            const std::optional<Key> key = asked(keys, mode, frame);
            const Vector3d wrist = key ? key->wrist : from.wrist, pole = key && key->pole ? *key->pole : from.elbow;
            worst((to.hand - (key && key->hand ? *key->hand : from.hand)).norm(), 1e-5, hands);
            const PlainArmPose other = arm_pose(solved, right, frame);
            RC_ASSERT((other.wrist - arm_pose(stage.clip, right, frame).wrist).norm() < 1e-5);
            const Vector3d line = wrist - shoulder;
            if (line.norm() < 2.1 || line.norm() > 7.9) continue;  // out of reach
            worst((to.wrist - wrist).norm(), 1e-5, wrists);
            const Vector3d u = line.normalized();
            const auto across = [&](const Vector3d& v) { return Vector3d(v - v.dot(u) * u); };
            const Vector3d elbow = across(to.elbow - shoulder), towards = across(pole - shoulder);
            if (elbow.norm() < 0.3 || towards.norm() < 0.3) continue;
            worst((elbow.normalized() - towards.normalized()).norm(), 1e-4, elbows);
        }
    });
    CHECK(hands == 100 * StillStage::kFrames);
    CHECK(wrists > 80 * StillStage::kFrames);
    CHECK(elbows > 60 * StillStage::kFrames);
}

TEST_CASE("--between goes into what is exported, and characters have rows of their own")
{
    const StillStage stage;
    const Vector3d shoulder = arm_pose(stage.clip, stage.arms[0], 0).shoulder;
    const std::string rows = row_of({2, shoulder + Vector3d(4, 0, 1), {}, {}}) +
                             row_of({6, shoulder + Vector3d(4, 2, 3), {}, {}}) +
                             "4,1,left_arm,1e3,0,0,,,,,,,\n";  // far away, of another character
    stage.report(rows, {"--between", "linear", "--characters", "2", "--export-targets", "all.csv"});
    const TargetTable table(slurp(stage.folder / "all.csv"));
    REQUIRE(table.rows.size() == 4 * StillStage::kFrames);
    const auto place = [&](std::size_t frame, std::size_t character) {
        const Cells& row = table.rows[4 * frame + 2 * character];
        REQUIRE(row.at("frame") == std::to_string(frame));
        REQUIRE(row.at("character") == std::to_string(character));
        REQUIRE(row.at("limb") == "left_arm");
        return point(row, "");
    };
    CHECK((place(5, 0) - (shoulder + Vector3d(4, 1.5, 2.5))).norm() < 1e-12);
    CHECK((place(0, 0) - (shoulder + Vector3d(4, 0, 1))).norm() < 1e-12);
    CHECK((place(11, 0) - (shoulder + Vector3d(4, 2, 3))).norm() < 1e-12);
    for (std::size_t frame = 0; frame < StillStage::kFrames; ++frame)
        CHECK((place(frame, 1) - Vector3d(1e3, 0, 0)).norm() < 1e-12);
}

TEST_CASE("the elbow's distance from the clip's is reported where goals are given, and is no error")
{
    const StillStage stage;
    const PlainArm& left = stage.arms[0];
    const PlainArmPose at = arm_pose(stage.clip, left, 3);
    const Key key{3, at.shoulder + Vector3d(3, 3, 3), at.shoulder + Vector3d(9, -9, 0), {}};
    const auto solve = [&](Words more) { return nlohmann::json::parse(stage.report(row_of(key), more)); };
    const nlohmann::json report = solve({"--json", "--out", "out.bvh"});
    const PlainArmPose to = arm_pose(plain_motion_of(stage.folder / "out.bvh"), left, 3);
    const nlohmann::json& given = report.at("differences_from_clip").at("elbow_given");
    CHECK(given.at("count") == 1);
    CHECK(given.at("worst").get<double>() == Approx((to.elbow - at.elbow).norm() / left.length()).epsilon(1e-5));
    CHECK(given.at("worst").get<double>() > 0.1);
    CHECK(given.at("worst_pose") == nlohmann::json{{"frame", 3}, {"character", 0}, {"limb", "left_arm"}});
    const std::size_t others = 2 * StillStage::kFrames - 1;
    CHECK(report.at("differences_from_clip").at("elbow_bent").at("count") == others);
    for (const auto& [name, error] : report.at("errors").items()) {
        INFO(name);
        CHECK(error.at("worst").get<double>() < 1e-5);
    }
    const std::string text = stage.report(row_of(key), {});
    CHECK_THAT(text, Contains("differs  elbow from clip, goal given ") && !Contains("error    elbow"));
}

TEST_CASE("a note says so where most limbs are out of reach or have bad input, with numbers")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);  // two frames of two arms
    const std::string head = "frame,character,limb,x,y,z\n", far = "0,0,left_arm,500,0,0\n0,0,right_arm,500,0,0\n",
                      beyond_floats = "1,0,left_arm,1e300,0,0\n";
    const auto solve = [&](const std::string& rows, const Words& more) {
        spill(folder / "t.csv", head + rows);
        Words words = {"solve", "clip.bvh", "--targets", "t.csv"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run_command(folder.path, words);
        CHECK(outcome.exit_code == 0);
        return outcome.out;
    };
    CHECK_THAT(solve(far + beyond_floats, {}),
               Contains("note     most arms are not where they should be: of 4 arms, 2 are out of reach; are the "
                        "targets in the right place and unit? 1 has bad "
                        "input;"));
    CHECK_THAT(solve(far, {}), !Contains("most arms"));  // half of them
    CHECK_THAT(solve(beyond_floats, {}), Contains("flag     bad input 1") && !Contains("most arms"));
    const nlohmann::json wrong = nlohmann::json::parse(solve(far + beyond_floats, {"--json"}));
    CHECK(wrong.at("went_wrong") == true);
    CHECK(wrong.at("out_of_reach") == 2);
    CHECK(wrong.at("bad_input") == 1);
    CHECK(nlohmann::json::parse(solve(far, {"--json"})).at("went_wrong") == false);
}
