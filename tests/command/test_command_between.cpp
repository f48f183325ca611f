// SPDX-License-Identifier: MIT
//
// A table with rows of some frames: what its limbs are asked for between them, and what the report says of limbs that
// were given targets. tests/command/test_command_targets.cpp has what becomes of what is asked.
#include <fmt/format.h>
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/target_table.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Eigen::Quaterniond;
using Eigen::Vector3d;
namespace {

constexpr std::size_t kFrames = 12;

// A folder with a clip of two arms.
struct BetweenStage {
    TempFolder folder;

    BetweenStage()
    {
        const std::size_t at = kTwoArms.find("Frames: 2"), frames = kTwoArms.find("\n1 2 3 0") + 1;
        std::string clip = kTwoArms.substr(0, at) + fmt::format("Frames: {}\nFrame Time: .01\n", kFrames);
        for (std::size_t n = 0; n < kFrames / 2; ++n) clip += kTwoArms.substr(frames);
        spill(folder / "clip.bvh", clip);
    }
    std::string solve(Words more) const
    {
        more.insert(more.begin(), {"solve", "clip.bvh"});
        const Outcome outcome = run_command(folder.path, more);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return outcome.out;
    }
    // What the run asks of all limbs.
    TargetTable asked(Words more) const
    {
        more.insert(more.end(), {"--export-targets", "asked.csv"});
        solve(more);
        return TargetTable(slurp(folder / "asked.csv"));
    }
};

// What a row asks of an arm.
struct Key {
    std::size_t frame = 0;
    Vector3d wrist = Vector3d::Zero();
    std::optional<Vector3d> pole{};
    std::optional<Quaterniond> hand{};
};

std::string row_of(const Key& key, std::size_t character = 0)
{
    const auto cells = [](const auto& v) { return fmt::format(",{},{},{}", v.x(), v.y(), v.z()); };
    return fmt::format("{},{},left_arm{}{}{}\n", key.frame, character, cells(key.wrist),
                       key.pole ? cells(*key.pole) : ",,,",
                       key.hand ? cells(*key.hand) + fmt::format(",{}", key.hand->w()) : ",,,,");
}

// What a frame asks, by what the documentation says; nothing: it follows the clip.
std::optional<Key> key_of(const std::vector<Key>& keys, const std::string& mode, std::size_t frame)
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
        const Eigen::AngleAxisd turn((before->hand->conjugate() * *after->hand).toRotationMatrix());
        key.hand = *before->hand * Eigen::AngleAxisd(share * turn.angle(), turn.axis());
    }
    return key;
}

// At least one, in order of frames.
std::vector<Key> random_keys(std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
    std::vector<Key> keys;
    for (std::size_t frame = 0; frame < kFrames; ++frame) {
        if (random() % 4 != 0 && (frame + 1 < kFrames || !keys.empty())) continue;
        Key& key = keys.emplace_back(Key{frame, 4 * vector()});
        if (random() % 3 != 0) key.pole = 9 * vector();
        if (random() % 3 != 0)
            key.hand = Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    }
    return keys;
}

}  // namespace

TEST_CASE("--between: frames without a row hold the last one, or go straight to the next")
{
    const BetweenStage stage;
    const TargetTable own = stage.asked({});  // a row for each arm in each frame
    rc::prop("random keys", [&](std::uint32_t seed) {
        std::mt19937_64 random(seed);
        const std::vector<Key> keys = random_keys(random);
        const std::string mode = std::array{"", "hold", "linear"}[random() % 3];
        std::string rows = kTargetHeader + std::string("\n");
        for (const Key& key : keys) rows += row_of(key);
        spill(stage.folder / "t.csv", rows);
        Words words = {"--targets", "t.csv"};
        if (!mode.empty()) words.insert(words.end(), {"--between", mode});
        const TargetTable table = stage.asked(words);
        RC_ASSERT(table.rows.size() == 2 * kFrames);
        for (std::size_t n = 0; n < table.rows.size(); ++n) {
            const Cells &row = table.rows[n], &clip = own.rows[n];
            const std::optional<Key> key = n % 2 == 0 ? key_of(keys, mode, n / 2) : std::nullopt;
            RC_ASSERT((point(row, "") - (key ? key->wrist : point(clip, ""))).norm() < 1e-12);
            RC_ASSERT((point(row, "pole_") - (key && key->pole ? *key->pole : point(clip, "pole_"))).norm() < 1e-12);
            const Eigen::Matrix3d hand = key && key->hand ? key->hand->toRotationMatrix() : hand_of(clip);
            RC_ASSERT((hand_of(row) - hand).norm() < 1e-12);
        }
    });
}

TEST_CASE("--between: characters have rows of their own")
{
    const BetweenStage stage;
    spill(stage.folder / "t.csv", kTargetHeader + std::string("\n") + row_of({2, {4, 0, 1}}) + row_of({6, {4, 2, 3}}) +
                                      row_of({4, {1e3, 0, 0}}, 1));
    const TargetTable table = stage.asked({"--targets", "t.csv", "--between", "linear", "--characters", "2"});
    REQUIRE(table.rows.size() == 4 * kFrames);
    for (std::size_t frame = 0; frame < kFrames; ++frame) {
        const double share = std::clamp((static_cast<double>(frame) - 2) / 4, 0.0, 1.0);
        CHECK((point(table.rows[4 * frame], "") - Vector3d(4, 2 * share, 1 + 2 * share)).norm() < 1e-12);
        CHECK((point(table.rows[4 * frame + 2], "") - Vector3d(1e3, 0, 0)).norm() < 1e-12);
    }
}

TEST_CASE("the elbow's distance from the clip's is reported where goals are given, and is no error")
{
    const BetweenStage stage;
    const PlainMotion clip = plain_motion_of(stage.folder / "clip.bvh");
    const PlainArm left = arms_of(clip)[0];
    const PlainArmPose at = arm_pose(clip, left, 3);
    spill(stage.folder / "t.csv", kTargetHeader + std::string("\n") +
                                      row_of({3, at.shoulder + Vector3d(3, 3, 3), at.shoulder + Vector3d(9, -9, 0)}));
    const auto report = nlohmann::json::parse(stage.solve({"--targets", "t.csv", "--json", "--out", "out.bvh"}));
    const PlainArmPose to = arm_pose(plain_motion_of(stage.folder / "out.bvh"), left, 3);
    const nlohmann::json& given = report.at("differences_from_clip").at("elbow_given");
    CHECK(given.at("count") == 1);
    CHECK(given.at("worst").get<double>() == Approx((to.elbow - at.elbow).norm() / left.length()).epsilon(1e-5));
    CHECK(given.at("worst_pose") == nlohmann::json{{"frame", 3}, {"character", 0}, {"limb", "left_arm"}});
    CHECK(report.at("differences_from_clip").at("elbow_bent").at("count") == 2 * kFrames - 1);
    CHECK_THAT(stage.solve({"--targets", "t.csv"}),
               Contains("differs  elbow from clip, goal given ") && !Contains("error    elbow"));
}
