// SPDX-License-Identifier: MIT
//
// The tables that `swivel solve` takes and writes. Targets that are exported are the clip, and given back they change
// nothing; poles, orientations and frames may be left out. Poses have a row for every frame, character and limb.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <tuple>

#include "swivel/swivel.h"
#include "tests/crowd_stage.h"
#include "tests/plain_motion.h"
#include "tests/random_figure.h"
#include "tests/run_command.h"
#include "tests/solve_tables.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

const std::string kPlainCrowd = "[crowd]\n";

// A joint's own axes, before what its own scale turns round.
Matrix3d own_axes(const PlainGltf& gltf, int node, double time)
{
    const Eigen::Vector4d q = plain_value(gltf, 0, node, "rotation", time, Eigen::Vector4d(0, 0, 0, 1));
    return plain_axes(plain_world(gltf, 0, gltf.parent_of(node), time)) * Eigen::Quaterniond(q).toRotationMatrix();
}

// A table of all four limbs has places and orientations that a figure's nodes have in its first animation.
void require_clips_own(const TargetTable& table, const PlainGltf& clip, const Figure& figure,
                       const std::vector<double>& times)
{
    REQUIRE(table.rows.size() == 4 * times.size());
    double worst = 0;
    for (std::size_t n = 0; n < table.rows.size(); ++n) {
        const auto world = [&](std::size_t joint) {
            return plain_world(clip, 0, figure.limbs[n % 4][joint], times[n / 4]);
        };
        const double length = figure.upper[n % 4] + figure.lower[n % 4];
        const auto off = [&](const std::string& prefix, std::size_t joint) {
            return (point(table.rows[n], prefix) - Vector3d(world(joint).translation())).norm() / length;
        };
        // The axes of a mirrored node are a rotation's, some of them turned round.
        const Matrix3d turned = hand_of(table.rows[n]).transpose() * plain_axes(world(2));
        worst = std::max({worst, off("", 2), (turned.cwiseAbs() - Matrix3d::Identity()).norm()});
        CHECK(table.rows[n].at("pole_x").empty());  // elbows go as in the clip
    }
    CHECK(worst < 1e-5);
}

}  // namespace

TEST_CASE("exported targets, given back unchanged, change nothing")
{
    const CrowdStage stage;
    const auto run = [&](const std::string& toml, const std::string& out, Words more) {
        more.insert(more.end(), {"--limbs", "all"});
        return stage.output(toml, out, more);
    };
    const std::string plain = run(kPlainCrowd, "own.bvh", {"--export-targets", "t.csv"});
    CHECK(plain == run(kPlainCrowd, "again.bvh", {"--targets", "t.csv"}));  // to the last bit
    // Of all limbs, where only legs are solved.
    const Words legs{"--limbs", "legs", "--targets", "t.csv"};
    CHECK(stage.output(kPlainCrowd, "legs.bvh", {"--limbs", "legs"}) == stage.output(kPlainCrowd, "again.bvh", legs));
    CHECK_THAT(stage.run(kPlainCrowd, legs).out,
               Contains("note     t.csv: " + std::to_string(2 * stage.clip.lines.size()) +
                        " rows are left out, of limbs that are not solved\n"));
    for (const std::string toml :
         {"[crowd]\ncharacters = 5\n", "[limb.all.target]\noffset = [0.3, -0.2, 0.1]\n",
          "[limb.arms]\neffector = [1, 0.5, 0]\n", "[limb.left_arm.target]\npoint = [3, 20, 10]\n",
          "[limb.arms.pole]\nkind = \"direction\"\n", "[limb.legs.pole]\nkind = \"normal\"\n",
          "[limb.arms.pole]\nkind = \"incoming\"\n", "[limb.arms.pole]\nkind = \"point\"\nfixed = [0, -9, 1]\n",
          "[limb.arms.aim]\naxis = [0, 0, 1]\nflexion_deg = 40\n", "[limb.arms]\nhand = false\n"}) {
        INFO(toml);
        const std::vector<PoseLine> own = pose_lines(run(toml, "own.csv", {"--export-targets", "t.csv"}));
        const std::vector<PoseLine> again = pose_lines(run(toml, "again.csv", {"--targets", "t.csv"}));
        CHECK(worst_rotation(own, again) < 1e-5);
        CHECK(TargetTable(slurp(stage.folder / "t.csv")).rows.size() == own.size());
    }
}

TEST_CASE("targets, effectors and aims of figures that are mirrored, scaled and have twist bones")
{
    const TempFolder folder;
    std::mt19937 random(11);
    const FigureWish wish{.twist_bones = 0.5, .scales = 0.5, .mirrors = 0.7};
    std::size_t mirrored = 0;
    for (int n = 0; n < 8; ++n) {
        const Figure figure = random_figure(random, wish);
        INFO("figure " << n);
        figure.rig.write(folder / "in.glb");
        const PlainGltf clip = plain_gltf_of(folder / "in.glb");
        const auto solved = [&](const std::string& toml, const std::string& option, const std::string& table) {
            spill(folder / "c.toml", "[limb.all]\n" + toml);
            done(run_command(folder.path, {"solve", "in.glb", "--limbs", "all", "--crowd", "c.toml", "--out", "out.glb",
                                           option, table}));
            return plain_gltf_of(folder / "out.glb");
        };
        const auto require_closed_by = [&](const TargetTable& table) {
            spill(folder / "given.csv", table.text());
            require_closed(
                closure(clip, solved("", "--targets", "given.csv"), 0, {figure.limbs.begin(), figure.limbs.end()}));
        };
        const std::vector<double> times = key_times(solved("", "--export-targets", "t.csv"), figure.limbs[0][0]);
        TargetTable table(slurp(folder / "t.csv"));
        require_clips_own(table, clip, figure, times);
        require_closed_by(table);
        table.leave_out({"pole_x", "pole_y", "pole_z", "qx", "qy", "qz", "qw"});
        require_closed_by(table);

        // Effectors and aims are in the hand joint's own axes.
        solved("effector = [0.03, 0.05, -0.02]\n", "--export-targets", "t.csv");
        const TargetTable touching(slurp(folder / "t.csv"));
        for (std::size_t row = 0; row < touching.rows.size(); ++row) {
            const int hand = figure.limbs[row % 4][2];
            const double time = times[row / 4];
            const Vector3d at = plain_world(clip, 0, hand, time).translation() +
                                own_axes(clip, hand, time) * Vector3d(0.03, 0.05, -0.02);
            CHECK((point(touching.rows[row], "") - at).norm() < 1e-5);
        }
        const Vector3d target(3, 4, 5);
        const PlainGltf aimed = solved("target.point = [3, 4, 5]\naim = {axis = [0.6, 0.8, 0], flexion_deg = 20}\n",
                                       "--export-targets", "t.csv");
        for (const auto& limb : figure.limbs) {
            const Vector3d way = target - plain_world(aimed, 0, limb[2], times[0]).translation();
            CHECK((own_axes(aimed, limb[2], times[0]) * Vector3d(0.6, 0.8, 0) - way.normalized()).norm() < 1e-4);
        }
        mirrored += figure.is_mirrored;
    }
    CHECK(mirrored > 2);
    CHECK(mirrored < 7);
}

TEST_CASE("an edit of one exported row moves that wrist alone")
{
    const CrowdStage stage;
    const std::string own = stage.output(kPlainCrowd, "own.bvh", {"--export-targets", "t.csv"});
    TargetTable table(slurp(stage.folder / "t.csv"));
    const PlainArm& left = stage.arms[0];
    constexpr std::size_t kFrame = 40;
    const PlainArmPose from = arm_pose(stage.clip, left, kFrame);
    const Vector3d moved = from.wrist + 0.2 * (from.shoulder - from.wrist);
    Cells& row = table.rows[2 * kFrame];
    REQUIRE(row.at("limb") == "left_arm");
    for (int axis = 0; axis < 3; ++axis) row[std::string(1, "xyz"[axis])] = std::to_string(moved[axis]);
    spill(stage.folder / "t.csv", table.text());
    const PlainMotion edited = stage.motion(kPlainCrowd, {"--targets", "t.csv"}), before = plain_motion(own);
    const PlainArmPose to = arm_pose(edited, left, kFrame);
    CHECK((to.wrist - moved).norm() < 1e-5 * left.length());
    CHECK((to.hand - from.hand).norm() < 1e-5);
    const PlainArmPose other = arm_pose(edited, stage.arms[1], kFrame),
                       other_before = arm_pose(before, stage.arms[1], kFrame);
    CHECK((other.wrist - other_before.wrist).norm() == 0);
    for (std::size_t frame = 0; frame < before.lines.size(); ++frame)
        if (frame != kFrame) CHECK(edited.lines[frame] == before.lines[frame]);
    CHECK(edited.lines[kFrame] != before.lines[kFrame]);
}

namespace {

// Below the first joint's first place, as low as any joint ever is.
Vector3d foot_of(const PlainMotion& motion)
{
    Vector3d foot = pose_of(motion, 0)[0].position;
    for (std::size_t frame = 0; frame < motion.lines.size(); ++frame)
        for (const PlainPose& joint : pose_of(motion, frame)) foot.y() = std::min(foot.y(), joint.position.y());
    return foot;
}
Vector3d place_of(const PoseLine& row) { return {row.number("place_x"), row.number("place_y"), row.number("place_z")}; }

}  // namespace

TEST_CASE("a character of another size is the clip's whole body in that size, targets and the way that it goes too")
{
    const CrowdStage stage;
    const std::string toml = "[crowd]\ncharacters = 4\nsize = [0.5, 2]\nlimbs = \"legs\"\n";
    const std::vector<PoseLine> rows = stage.rows(toml, "left_leg", "", {"--export-targets", "targets.csv"});
    TargetTable targets(slurp(stage.folder / "targets.csv"));
    std::erase_if(targets.rows, [](const Cells& row) { return row.at("limb") != "left_leg"; });
    const std::size_t frames = stage.clip.lines.size();
    REQUIRE(rows.size() == 4 * frames);
    REQUIRE(targets.rows.size() == rows.size());
    for (std::size_t n = 0; n < rows.size(); ++n) {
        const std::size_t clip_frame = (n / 4 + static_cast<std::size_t>(rows[n].number("start"))) % frames;
        const Vector3d ankle = arm_pose(stage.clip, stage.legs[0], clip_frame).wrist, is = point(targets.rows[n], "");
        CHECK((is - (place_of(rows[n]) + rows[n].number("size") * ankle)).norm() < 1e-4);
    }
}

TEST_CASE("every frame, character and limb is in order, on the grid, and posed as its size and start say; so says JSON")
{
    const CrowdStage stage;
    const std::string toml = "[crowd]\ncharacters = 6\nsize = [0.5, 2]\n";
    std::vector<PoseLine> rows = pose_lines(stage.output(toml, "out.csv"));
    const std::vector<PoseLine> alone = pose_lines(stage.output("[crowd]\n", "alone.csv"));
    REQUIRE(rows.size() == 6 * alone.size());
    for (std::size_t n = 0; n < rows.size(); ++n) {
        const std::string limb = n % 2 == 0 ? "left_arm" : "right_arm";
        CHECK(rows[n].place() == std::tuple(n / 12, n / 2 % 6, limb));
        CHECK((rows[n].flags & SWIVEL_REACHED) != 0);
        for (std::size_t j = 0; j < 3; ++j) {
            CHECK(std::abs(rows[n].joint[j].norm() - 1) < 1e-6);
            if (n % 12 < 2)  // the first character has the bits of one alone
                CHECK(rows[n].joint[j].coeffs() == alone[n / 12 * 2 + n % 12].joint[j].coeffs());
        }
    }
    std::erase_if(rows, [](const PoseLine& row) { return row.limb != "left_arm"; });
    const nlohmann::json fifty = stage.json("[crowd]\n", {"--characters", "50"});
    for (const nlohmann::json& any : fifty.at("each_character"))
        CHECK((any.at("size") >= 0.85 && any.at("size") <= 1.15));
    const nlohmann::json each = stage.json(toml).at("each_character");
    REQUIRE(each.size() == 6);
    const std::size_t frames = stage.clip.lines.size();
    REQUIRE(rows.size() == 6 * frames);
    const double span = 2 * std::max(stage.arms[0].length(), stage.arms[1].length());
    const Vector3d foot = foot_of(stage.clip);
    std::size_t bent = 0, starts = 0;
    for (std::size_t frame = 0; frame < frames; ++frame)
        for (std::size_t c = 0; c < 6; ++c) {
            const PoseLine& row = rows[6 * frame + c];
            const auto start = static_cast<std::size_t>(row.number("start"));
            CHECK(each.at(c).at("size") == row.number("size"));
            CHECK(each.at(c).at("start") == start);
            CHECK(each.at(c).at("place") ==
                  nlohmann::json({row.number("place_x"), row.number("place_y"), row.number("place_z")}));
            // On the grid stands what is below the root at first, on the ground.
            const Vector3d stands = row.number("size") * foot + place_of(row);
            CHECK((stands - foot - 3 * span * Vector3d(static_cast<double>(c % 3), 0, static_cast<double>(c / 3)))
                      .norm() < 1e-5 * span);
            if (c == 0) CHECK((start == 0 && row.number("size") == 1));
            starts += frame == 0 && start > 0;
            const std::size_t clip_frame = (frame + start) % frames;
            if (arm_pose(stage.clip, stage.arms[0], clip_frame).bend() < 0.1) continue;
            for (std::size_t j = 0; j < 3; ++j)
                CHECK(row.joint[j].angularDistance(rows[6 * clip_frame].joint[j]) < 1e-4);
            ++bent;
        }
    CHECK(bent > 100);
    CHECK(starts > 3);
}

namespace {

constexpr std::size_t kFrames = 12;

// A folder with a clip of two arms.
struct BetweenStage {
    TempFolder folder;

    BetweenStage() { spill(folder / "clip.bvh", cut(plain_motion(kTwoArms), 0, 1, kFrames / 2)); }
    std::string solve(Words more) const
    {
        more.insert(more.begin(), {"solve", "clip.bvh"});
        return done(run_command(folder.path, more)).out;
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
               Contains("differs  elbows from the clip's: ") && !Contains("error    elbow"));
}
