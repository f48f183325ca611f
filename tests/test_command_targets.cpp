// SPDX-License-Identifier: MIT
//
// Tables of targets as `swivel solve` writes and takes them. What is exported is the clip, and given back it changes
// nothing. Poles and orientations may be left out. Frames between rows hold them or go on to the next.
#include <rapidcheck/catch.h>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <sstream>

#include "tests/crowd_stage.h"
#include "tests/random_figure.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Words = std::vector<std::string>;

namespace {

constexpr const char* kHeader = "frame,character,limb,x,y,z,pole_x,pole_y,pole_z,qx,qy,qz,qw";

// One row of a table, read by hand: cells by column.
using Cells = std::map<std::string, std::string>;
struct Table {
    std::vector<std::string> columns;
    std::vector<Cells> rows;

    explicit Table(const std::string& text)
    {
        std::istringstream in(text);
        std::string line;
        REQUIRE(std::getline(in, line));
        columns = cells_of(line);
        while (std::getline(in, line)) {
            const std::vector<std::string> cells = cells_of(line);
            REQUIRE(cells.size() == columns.size());
            Cells& row = rows.emplace_back();
            for (std::size_t n = 0; n < cells.size(); ++n) row[columns[n]] = cells[n];
        }
    }
    std::string text() const
    {
        std::string all;
        for (std::size_t n = 0; n < columns.size(); ++n) all += (n > 0 ? "," : "") + columns[n];
        for (const Cells& row : rows) {
            all += "\n";
            for (std::size_t n = 0; n < columns.size(); ++n) all += (n > 0 ? "," : "") + row.at(columns[n]);
        }
        return all + "\n";
    }
    void leave_out(const Words& names)
    {
        std::erase_if(columns, [&](const std::string& each) {
            return std::find(names.begin(), names.end(), each) != names.end();
        });
    }
};

double number(const Cells& row, const std::string& column) { return std::strtod(row.at(column).c_str(), nullptr); }
Vector3d point(const Cells& row, const std::string& prefix)
{
    return {number(row, prefix + "x"), number(row, prefix + "y"), number(row, prefix + "z")};
}
Matrix3d hand_of(const Cells& row)
{
    return Quaterniond(number(row, "qw"), number(row, "qx"), number(row, "qy"), number(row, "qz")).toRotationMatrix();
}

const std::string kPlainCrowd = "[crowd]\n";

// When the first animation has keys of a node's rotation.
std::vector<double> key_times(const PlainGltf& gltf, int node)
{
    const auto& animation = gltf.json.at("animations").at(0);
    for (const auto& channel : animation.at("channels"))
        if (channel.at("target").value("node", -1) == node && channel.at("target").at("path") == "rotation")
            return plain_numbers(gltf,
                                 animation.at("samplers").at(channel.at("sampler").get<std::size_t>()).at("input"));
    FAIL("node " << node << " has no rotation keys");
    return {};
}

// A table of all four limbs has places and orientations that a figure's nodes have in its first animation.
void require_clips_own(const Table& table, const PlainGltf& clip, const Figure& figure,
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
        worst = std::max({worst, off("", 2), off("pole_", 1), (turned.cwiseAbs() - Matrix3d::Identity()).norm()});
    }
    CHECK(worst < 1e-5);
}

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
        spill(folder / "t.csv", kHeader + ("\n" + rows));
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

TEST_CASE("exported targets are the clip's wrists, elbows and hands, of legs ankles, knees and feet")
{
    const CrowdStage stage;
    const Outcome outcome =
        run_command(stage.folder.path, {"solve", "clip.bvh", "--limbs", "all", "--export-targets", "t.csv", "--json"});
    REQUIRE(outcome.exit_code == 0);
    CHECK(nlohmann::json::parse(outcome.out).at("export_targets") == "t.csv");
    CHECK(stage.folder.file_count() == 2);  // no other is written
    const std::string text = slurp(stage.folder / "t.csv");
    CHECK_THAT(text, Catch::Matchers::StartsWith(std::string(kHeader) + "\n"));
    const Table table(text);
    REQUIRE(table.rows.size() == 4 * stage.clip.lines.size());
    double worst = 0;
    for (std::size_t n = 0; n < table.rows.size(); ++n) {
        const Cells& row = table.rows[n];
        const bool is_arm = n % 4 < 2;
        const PlainArm& limb = (is_arm ? stage.arms : stage.legs)[n % 2];
        REQUIRE(row.at("frame") == std::to_string(n / 4));
        REQUIRE(row.at("character") == "0");
        REQUIRE(row.at("limb") == limb.side + (is_arm ? "_arm" : "_leg"));
        const PlainArmPose at = arm_pose(stage.clip, limb, n / 4);
        worst = std::max({worst, (point(row, "") - at.wrist).norm(), (point(row, "pole_") - at.elbow).norm(),
                          (hand_of(row) - at.hand).norm()});
    }
    CHECK(worst < 1e-11);  // doubles, of places some 30 units away
}

TEST_CASE("exported targets, given back unchanged, change nothing")
{
    const CrowdStage stage;
    const auto run = [&](const std::string& toml, const std::string& out, Words more) {
        more.insert(more.end(), {"--limbs", "all"});
        return stage.output(toml, out, more);
    };
    const std::string plain = run(kPlainCrowd, "own.bvh", {"--export-targets", "t.csv"});
    CHECK(plain == run(kPlainCrowd, "again.bvh", {"--targets", "t.csv"}));  // to the last bit
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
        CHECK(Table(slurp(stage.folder / "t.csv")).rows.size() == own.size());
    }
}

TEST_CASE("exported targets of figures that are mirrored, scaled and have twist bones")
{
    const TempFolder folder;
    std::mt19937 random(11);
    const FigureWish wish{.twist_bones = 0.5, .scales = 0.5, .mirrors = 0.7};
    std::size_t mirrored = 0;
    for (int n = 0; n < 8; ++n) {
        const Figure figure = random_figure(random, wish, figure_names()[0]);
        INFO("figure " << n);
        figure.rig.write(folder / "in.glb");
        const PlainGltf clip = plain_gltf_of(folder / "in.glb");
        const auto solved = [&](const std::string& option, const std::string& table) {
            const Words words = {"solve", "in.glb", "--limbs", "all", "--out", "out.glb", option, table};
            const Outcome outcome = run_command(folder.path, words);
            INFO(outcome.err);
            REQUIRE(outcome.exit_code == 0);
            return plain_gltf_of(folder / "out.glb");
        };
        const auto require_closed_by = [&](const Table& table) {
            spill(folder / "given.csv", table.text());
            require_closed(
                closure(clip, solved("--targets", "given.csv"), 0, {figure.limbs.begin(), figure.limbs.end()}));
        };
        const std::vector<double> times = key_times(solved("--export-targets", "t.csv"), figure.limbs[0][0]);
        Table table(slurp(folder / "t.csv"));
        require_clips_own(table, clip, figure, times);
        require_closed_by(table);
        table.leave_out({"pole_x", "pole_y", "pole_z", "qx", "qy", "qz", "qw"});
        require_closed_by(table);
        mirrored += figure.is_mirrored;
    }
    CHECK(mirrored > 2);
    CHECK(mirrored < 7);
}

TEST_CASE("an edit of one exported row moves that wrist alone")
{
    const CrowdStage stage;
    const std::string own = stage.output(kPlainCrowd, "own.bvh", {"--export-targets", "t.csv"});
    Table table(slurp(stage.folder / "t.csv"));
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

TEST_CASE("a row without a pole has the clip's, column or cells left out")
{
    const CrowdStage stage;
    const Words pole = {"pole_x", "pole_y", "pole_z"};
    stage.output(kPlainCrowd, "own.bvh", {"--export-targets", "t.csv"});
    Table table(slurp(stage.folder / "t.csv"));
    for (Cells& row : table.rows) {  // so that an elbow that goes elsewhere would be seen
        const PlainArmPose at = arm_pose(stage.clip, stage.arms[row.at("limb") == "right_arm"],
                                         static_cast<std::size_t>(number(row, "frame")));
        const Vector3d moved = at.wrist + 0.1 * (at.shoulder - at.wrist);
        for (int axis = 0; axis < 3; ++axis) row[std::string(1, "xyz"[axis])] = std::to_string(moved[axis]);
    }
    const auto solved = [&](const Table& given) {
        spill(stage.folder / "t.csv", given.text());
        return stage.output(kPlainCrowd, "out.bvh", {"--targets", "t.csv"});
    };
    const std::string own = solved(table);  // with the clip's poles, written down
    Table bare = table;
    bare.leave_out(pole);
    CHECK(solved(bare) == own);
    Table empty = table;
    for (Cells& row : empty.rows)
        for (const std::string& column : pole) row[column] = "";
    CHECK(solved(empty) == own);
    Table other = table;
    for (Cells& row : other.rows) row["pole_y"] = "99";
    CHECK(solved(other) != own);
}

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
    const Table table(slurp(stage.folder / "all.csv"));
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

TEST_CASE("the columns size and start say how a character's poses come from the clip's, in the table and in JSON")
{
    const CrowdStage stage;
    const std::string toml = "[crowd]\ncharacters = 6\nsize = [0.5, 2]\n";
    const std::vector<PoseLine> rows = stage.rows(toml, "left_arm");
    const nlohmann::json each = stage.json(toml).at("each_character");
    REQUIRE(each.size() == 6);
    const std::size_t frames = stage.clip.lines.size();
    REQUIRE(rows.size() == 6 * frames);
    std::size_t bent = 0, starts = 0;
    for (std::size_t frame = 0; frame < frames; ++frame)
        for (std::size_t c = 0; c < 6; ++c) {
            const PoseLine& row = rows[6 * frame + c];
            const auto start = static_cast<std::size_t>(row.number("start"));
            CHECK(each.at(c).at("size") == row.number("size"));
            CHECK(each.at(c).at("start") == start);
            CHECK(each.at(c).at("place") ==
                  nlohmann::json({row.number("place_x"), row.number("place_y"), row.number("place_z")}));
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
    CHECK_THAT(
        solve(far + beyond_floats, {}),
        Contains("note     most arms are not where they should be: of 4, 2 are out of reach and 1 have bad input"));
    CHECK_THAT(solve(far, {}), !Contains("most arms"));  // half of them
    CHECK_THAT(solve(beyond_floats, {}), Contains("flag     bad input 1") && !Contains("most arms"));
    const nlohmann::json wrong = nlohmann::json::parse(solve(far + beyond_floats, {"--json"}));
    CHECK(wrong.at("went_wrong") == true);
    CHECK(wrong.at("out_of_reach") == 2);
    CHECK(wrong.at("bad_input") == 1);
    CHECK(nlohmann::json::parse(solve(far, {"--json"})).at("went_wrong") == false);
}
