// SPDX-License-Identifier: MIT
//
// The promise of a crowd file's ground: a crowd walks over hills, and feet that the clip has down stand on them,
// whatever the size of their owners. Tests' own readers, formulas and kinematics judge.
#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tests/crowd_stage.h"
#include "tests/feet_motion.h"
#include "tests/test_data.h"
#include "tools/cache/cache_maker.h"
#include "tools/crowd/stands.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kMillimetres = 1e3 * 0.0254 / 0.45;  // a unit of the CMU library's skeletons
constexpr unsigned kReached = 1u << 0, kPlanted = 1u << 17;

const Vector3d kHillSize(400, 4, 300), kMiddle(90, 3, 70);
std::string crowd_on_hills(const std::string& more = "")
{
    return fmt::format(
        "[crowd]\nlimbs = \"all\"\nsize = [0.7, 1.3]\n{}\n[ground]\nheights = \"hills.png\"\nsize = [{}, {}, {}]\n"
        "middle = [{}, {}, {}]\n",
        more, kHillSize.x(), kHillSize.y(), kHillSize.z(), kMiddle.x(), kMiddle.y(), kMiddle.z());
}

// A walk of the CMU library's skeleton at 120 frames a second: recorded, where this machine keeps one. Else it is the
// walk of tools/view/figure.glb on the skeleton of that library's jump, round and round.
fs::path walk_in(const TempFolder& folder)
{
    if (fs::path recorded = find_data("cmu_02_01_walk.bvh"); !recorded.empty()) return recorded;
    const std::string figure = fs::path(SWIVEL_SOURCE_DIR) / "tools" / "view" / "figure.glb";
    spill(folder / "loop.toml", "[crowd]\nlimbs = \"legs\"\nloop = \"auto\"\n");
    for (const Words& words :
         {Words{"retarget", figure, must_find_jump(), "--fps", "120", "--out", "once.bvh"},
          Words{"solve", "once.bvh", "--crowd", "loop.toml", "--frames", "343", "--out", "on.bvh"}})
        done(run_command(folder.path, words));
    return folder / "on.bvh";
}

struct HillStage {
    TempFolder folder;
    double frame_time;
    PlainMotion clip;
    PlainContacts contacts;
    Hills hills = random_hills(kHillSize);
    double floor = 0;

    explicit HillStage(const Carried& to = {}) : frame_time(to.frame_time())
    {
        spill(folder / "walk.bvh", carried(plain_motion_of(walk_in(folder)), to));
        write_png(folder / "hills.png", hills, 16);
        clip = plain_motion_of(folder / "walk.bvh");
        REQUIRE(run_command(folder.path, {"feet", "walk.bvh", "--export-contacts", "c.csv"}).exit_code == 0);
        contacts = contacts_in_table(slurp(folder / "c.csv"), clip.lines.size());
        floor = floor_of(clip);
    }

    std::string solved(const std::string& toml, Words words) const
    {
        spill(folder / "c.toml", toml);
        words.insert(words.begin(), {"solve", "walk.bvh", "--crowd", "c.toml"});
        return done(run_command(folder.path, words)).out;
    }
    double ground(const Vector3d& at) const
    {
        return floor + kMiddle.y() + hills.height(at.x() - kMiddle.x(), at.z() - kMiddle.z());
    }
    PlainLegs legs_of(const std::string& file) const { return legs_path(plain_motion_of(folder / file), frame_time); }
    // The median height of a foot's toe over the clip's floor while it is down: between these two.
    std::array<double, 2> clearance(std::size_t side) const
    {
        const PlainLegs legs = legs_of("walk.bvh");
        std::vector<double> heights;
        for (std::size_t frame = 0; frame < legs.frame_count(); ++frame)
            if (contacts[side][frame]) heights.push_back(legs.legs[side].toe[frame].y() - floor);
        std::ranges::sort(heights);
        return {heights[(heights.size() - 1) / 2], heights[heights.size() / 2]};
    }
};

// Where a row of the table has a leg's toe, or its ankle.
Vector3d toe_of(const PlainMotion& clip, const PoseLine& row, bool is_ankle = false)
{
    const std::string side = row.limb == "left_leg" ? "Left" : "Right";
    const auto frame = static_cast<std::size_t>(row.number("start") + row.number("frame")) % clip.lines.size();
    const std::vector<PlainPose> pose = pose_of(clip, frame);
    const auto at = [&](const std::string& name) { return joint_named(clip, side + name); };
    const int hip = at("UpLeg");
    Matrix3d turn = pose[static_cast<std::size_t>(clip.joint(hip).parent)].rotation;
    Vector3d place = pose[static_cast<std::size_t>(hip)].position;
    const std::array below{at("Leg"), at("Foot"), at("ToeBase")};
    for (std::size_t n = 0; n < (is_ankle ? 2 : 3); ++n) {
        turn = turn * row.joint[n].toRotationMatrix();
        place += turn * clip.joint(below[n]).offset;
    }
    return Vector3d(row.number("place_x"), row.number("place_y"), row.number("place_z")) + row.number("size") * place;
}

}  // namespace

TEST_CASE("feet of a crowd on hills stand where they touch, on the ground")
{
    const HillStage stage;
    stage.solved(crowd_on_hills("characters = 12"), {"--out", "out.csv", "--quiet"});
    std::vector<PoseLine> rows = pose_lines(slurp(stage.folder / "out.csv"));
    std::erase_if(rows, [](const PoseLine& row) { return !row.limb.ends_with("leg"); });
    std::ranges::sort(rows, {}, [](const PoseLine& row) { return std::tuple(row.character, row.limb, row.frame); });
    constexpr std::size_t kRunIn = 12;  // frames: it comes to rest, and what interrupts it fades
    const std::array clearance{stage.clearance(0), stage.clearance(1)};
    std::size_t down = 0, standing = 0, since = 0;
    double slide = 0, gap = 0, below = 0, float_max = 0, slide_max = 0;
    for (std::size_t n = 1; n < rows.size(); ++n) {
        const PoseLine &row = rows[n], &last = rows[n - 1];
        const std::size_t side = row.limb == "left_leg" ? 0 : 1, count = stage.clip.lines.size();
        const auto frame = (row.frame + static_cast<std::size_t>(row.number("start"))) % count;
        const double size = row.number("size");
        const Vector3d toe = toe_of(stage.clip, row);
        const auto [min, max] = clearance[side];
        const double height = (toe.y() - stage.ground(toe)) / size,
                     over = size * (height - std::clamp(height, min, max));
        below = std::max(below, -over);
        const bool goes_on = last.limb == row.limb && last.character == row.character && frame > 0;
        since = goes_on && stage.contacts[side][frame] ? since + 1 : 0;
        if (since <= kRunIn) continue;
        ++down;
        float_max = std::max(float_max, std::fabs(over));
        slide_max = std::max(slide_max, (toe - toe_of(stage.clip, last)).norm());
        if ((row.flags & kPlanted) == 0 || (row.flags & kReached) == 0) continue;
        ++standing;
        gap = std::max(gap, std::fabs(over));
        slide = std::max(slide, (toe - toe_of(stage.clip, last)).norm());
    }
    CHECK(down > 1000);
    // Where a leg cannot reach down a slope of 20 degrees, its foot still is near its place.
    CHECK(static_cast<double>(standing) > 0.85 * static_cast<double>(down));
    CHECK(kMillimetres * slide_max < 3);
    CHECK(kMillimetres * float_max < 3);
    CHECK(kMillimetres * slide < 0.1);
    CHECK(kMillimetres * gap < 1);
    CHECK(kMillimetres * below < 0.1);
}

// The largest change of a velocity from frame to frame, in leg lengths a second.
double jump_of(const PlainLegs& legs, std::span<const std::vector<Vector3d>* const> paths)
{
    double max = 0;
    for (const std::vector<Vector3d>* path : paths)
        for (std::size_t n = 2; n < path->size(); ++n)
            max = std::max(max, ((*path)[n] - 2 * (*path)[n - 1] + (*path)[n - 2]).norm());
    return max / legs.frame_time / legs.leg_length(0);
}

// Ground by the way along it, in millimetres.
struct Profile {
    const char* name;
    double edge;  // the highest
    double (*height)(double);
};
constexpr Profile kProfiles[] = {
    {"18 cm up", 180, [](double way) { return 180 * std::floor(way / 280); }},
    {"10 cm up", 100, [](double way) { return 100 * std::floor(way / 280); }},
    {"18 cm down", 180, [](double way) { return -180 * std::floor(way / 280); }},
    {"10 cm down", 100, [](double way) { return -100 * std::floor(way / 280); }},
    {"a kerb of 15 cm", 150, [](double way) { return way > 700 ? 150.0 : 0.0; }},
    {"a gap of 10 cm", 340, [](double way) { return way > 700 && way < 800 ? -340.0 : 0.0; }}};

TEST_CASE("a crowd climbs steps without a jump, and its feet stand on them")
{
    const std::size_t every = GENERATE(1u, 2u, 4u);
    const HillStage stage({.every = every});
    const PlainLegs before = stage.legs_of("walk.bvh");
    const auto jumps = [](const PlainLegs& legs) {
        return std::array{jump_of(legs, std::array{&legs.body}),
                          jump_of(legs, std::array{&legs.legs[0].toe, &legs.legs[1].toe})};
    };
    for (const Profile& profile : kProfiles) {
        const Hills ground = ground_along(before.body.back() - before.body.front(), [&](double way) {
            return profile.height(kMillimetres * way) / kMillimetres;
        });
        write_png(stage.folder / "steps.png", ground, 16);
        stage.solved(fmt::format("[crowd]\nlimbs = \"all\"\n[ground]\nheights = \"steps.png\"\nsize = [{}, {}, {}]\n",
                                 ground.size.x(), ground.size.y(), ground.size.z()),
                     {"--out", "out.bvh", "--quiet"});
        const PlainLegs after = stage.legs_of("out.bvh");
        double gap = 0, depth = 0;
        for (std::size_t side = 0; side < 2; ++side) {
            const auto [min, max] = stage.clearance(side);
            std::size_t since = 0;
            for (std::size_t frame = 0; frame < after.frame_count(); ++frame) {
                const Vector3d& toe = after.legs[side].toe[frame];
                const double height = toe.y() - stage.floor - ground.height(toe.x(), toe.z());
                depth = std::max(depth, min - height);
                since = stage.contacts[side][frame] ? since + 1 : 0;
                if (static_cast<double>(since) * stage.frame_time > 0.1)
                    gap = std::max(gap, std::fabs(height - std::clamp(height, min, max)));
            }
        }
        const auto [hips, toes] = jumps(after);
        const auto [own_hips, own_toes] = jumps(before);
        INFO(profile.name << ", " << 1 / stage.frame_time << " frames a second");
        CHECK(hips < 2 * own_hips);
        CHECK(toes < 2 * own_toes);
        CHECK(kMillimetres * gap < 3);
        CHECK(kMillimetres * depth < 0.6 * profile.edge);  // of a toe in the air, at an edge that it has just passed
    }
}

TEST_CASE("a leg's stands are its contacts, and frames between that no swing is longer than a second")
{
    const auto frames = [](std::initializer_list<std::pair<int, bool>> runs) {
        std::vector<bool> contact;
        for (const auto& [count, is_down] : runs)
            contact.insert(contact.end(), static_cast<std::size_t>(count), is_down);
        return contact;
    };
    const auto stands = [](const std::vector<bool>& contact, double frame_time) {
        std::string text;
        for (const swivel::tools::Contact& stand : swivel::tools::stands_of(contact, frame_time))
            text += fmt::format("{}-{} ", stand.first, stand.end);
        return text;
    };
    CHECK(stands(frames({{3, true}, {4, false}, {2, true}}), 0.1) == "0-3 7-9 ");
    CHECK(stands(frames({{1, false}}), 0.1) == "0-1 ");                                  // no contact
    CHECK(stands(frames({{1, true}}), 0.1) == "0-1 ");                                   // one frame
    CHECK(stands(frames({{3, false}, {2, true}, {3, false}}), 0.03) == "3-5 ");          // 0.09 s
    CHECK(stands(frames({{3, false}, {2, true}, {3, false}}), 0.04) == "0-1 3-5 7-8 ");  // 0.12 s
    CHECK(stands(frames({{1, true}, {25, false}, {1, true}}), 0.1) == "0-1 9-10 17-18 26-27 ");
    CHECK(stands(frames({{1, true}, {2, false}, {1, true}}), 5) == "0-1 1-2 2-3 3-4 ");  // frames of 5 s
}

TEST_CASE("a foot that a table sends beside its clip stands on the ground there")
{
    const HillStage stage;
    stage.solved(crowd_on_hills(), {"--export-targets", "t.csv", "--quiet"});
    TargetTable table(slurp(stage.folder / "t.csv"));
    for (Cells& row : table.rows)
        if (row.at("limb") == "left_leg") row["x"] = fmt::format("{}", number(row, "x") + 4);
    spill(stage.folder / "beside.csv", table.text());
    stage.solved(crowd_on_hills(), {"--targets", "beside.csv", "--out", "out.bvh", "--quiet"});
    const PlainLegs legs = stage.legs_of("out.bvh"), own = stage.legs_of("walk.bvh");
    const auto [min, max] = stage.clearance(0);
    double aside = 0, below = 0;
    for (std::size_t frame = 12; frame < legs.frame_count(); ++frame) {
        const Vector3d& toe = legs.legs[0].toe[frame];
        aside = std::max(aside, toe.x() - own.legs[0].toe[frame].x());
        below = std::max(below, min - (toe.y() - stage.ground(toe)));
    }
    CHECK(aside > 3);
    CHECK(kMillimetres * below < 0.1);
}

TEST_CASE("a clip that is written stands as its table says")
{
    const HillStage stage;
    stage.solved(crowd_on_hills(), {"--out", "out.csv", "--quiet"});
    stage.solved(crowd_on_hills(), {"--out", "out.bvh", "--quiet"});
    const PlainLegs legs = legs_path(plain_motion_of(stage.folder / "out.bvh"), kCarriedTime);
    for (const PoseLine& row : pose_lines(slurp(stage.folder / "out.csv"))) {
        if (!row.limb.ends_with("leg")) continue;
        const std::size_t side = row.limb == "left_leg" ? 0 : 1;
        REQUIRE((legs.legs[side].toe[row.frame] - toe_of(stage.clip, row)).norm() < 2e-4);  // six digits of degrees
    }
}

TEST_CASE("strides that leave the clip of a cache are refused, though their digests are right")
{
    const HillStage stage;
    spill(stage.folder / "c.toml", "[crowd]\nlimbs = \"all\"\n[ground]\n");
    const auto run = [&](const Words& words) { return run_command(stage.folder.path, words); };
    REQUIRE(run({"store", "walk.bvh", "--crowd", "c.toml", "good", "--quiet"}).exit_code == 0);
    const swivel::tools::Cache good(stage.folder / "good");
    const auto is_leg = [](const swivel::tools::CachedLimb& limb) { return limb.setup.has(SWIVEL_WITH_GROUND); };
    constexpr std::uint32_t kFar = 1000;
    int made = 0;
    for (const goal_stride& bad : {goal_stride{kFar, 2, 3, 3}, goal_stride{0, kFar, kFar, 0},
                                   goal_stride{0, 2, 3, kFar}, goal_stride{0, 1, 1, 0}, goal_stride{0, 0, 0, 0}}) {
        swivel::tools::CachedCrowd crowd = good.crowd();
        std::ranges::find_if(crowd.limbs, is_leg)->sources[1].stride = bad;
        const std::string name = fmt::format("bad{}", ++made);
        swivel::tools::CacheMaker maker(stage.folder / name, crowd);
        for (std::uint32_t column = 0; column < crowd.column_count(); ++column)
            maker.write_characters(column, good.characters(column));
        maker.commit();
        const Outcome outcome = run({"check", name});
        CHECK(outcome.exit_code == 1);
        CHECK_THAT(outcome.err, Contains("has strides that are not within the clip"));
    }
}

TEST_CASE("a foot stands on the point that the file says, and arms that go along are in no table of targets")
{
    const HillStage stage;
    stage.solved("[crowd]\nlimbs = \"all\"\n[ground]\n[limb.legs]\neffector = [0, 0, 0]\n",
                 {"--out", "out.csv", "--export-targets", "t.csv", "--quiet"});
    CHECK(slurp(stage.folder / "t.csv").find("arm") == std::string::npos);
    CHECK(slurp(stage.folder / "t.csv").find("left_leg") != std::string::npos);
    std::vector<PoseLine> rows = pose_lines(slurp(stage.folder / "out.csv"));
    std::erase_if(rows, [](const PoseLine& row) { return row.limb != "left_leg"; });
    std::vector<double> heights;  // of the clip's ankle while the foot is down
    const PlainLegs legs = legs_path(stage.clip, kCarriedTime);
    for (std::size_t frame = 0; frame < legs.frame_count(); ++frame)
        if (stage.contacts[0][frame]) heights.push_back(legs.legs[0].ankle[frame].y());
    std::ranges::sort(heights);
    std::size_t standing = 0;
    for (std::size_t n = 1, since = 0; n < rows.size(); ++n) {
        since = stage.contacts[0][rows[n].frame] ? since + 1 : 0;
        if (since <= 12 || (rows[n].flags & kPlanted) == 0 || (rows[n].flags & kReached) == 0) continue;
        const Vector3d ankle = toe_of(stage.clip, rows[n], true), last = toe_of(stage.clip, rows[n - 1], true);
        ++standing;
        CHECK(kMillimetres * (ankle - last).norm() < 0.1);
        CHECK(ankle.y() > heights[(heights.size() - 1) / 2] - 1e-3);
        CHECK(ankle.y() < heights[heights.size() / 2] + 1e-3);
    }
    CHECK(standing > 20);
}

TEST_CASE("level ground changes a walk less than hills do, and its feet do not slide")
{
    const HillStage stage;
    stage.solved("[crowd]\nlimbs = \"legs\"\n[ground]\n", {"--out", "out.bvh", "--quiet"});
    const PlainSkating before = plain_skating(legs_path(stage.clip, kCarriedTime), stage.contacts),
                       after = plain_skating(legs_path(plain_motion_of(stage.folder / "out.bvh"), kCarriedTime),
                                             stage.contacts);
    CHECK(after.step < 0.5 * before.step);
    CHECK(after.mean < 0.5 * before.mean);
}

TEST_CASE("a table says when feet are down: of the file's frames, however the clip goes on")
{
    const HillStage stage;
    const std::string ground = "[crowd]\nlimbs = \"legs\"\n", table = "[ground]\ncontacts = \"c.csv\"\n";
    stage.solved(ground + "[ground]\n", {"--out", "found.csv", "--quiet"});
    CHECK_THAT(stage.solved(ground + table, {"--out", "given.csv"}),
               Contains("ground   level; feet stand when c.csv says"));
    CHECK(slurp(stage.folder / "found.csv") == slurp(stage.folder / "given.csv"));

    // A part of one step alone, where the foot does stand.
    const std::vector<bool>& left = stage.contacts[0];
    const auto begin = static_cast<std::size_t>(std::search_n(left.begin() + 20, left.end(), 12, true) - left.begin());
    REQUIRE(begin + 40 < left.size());
    spill(stage.folder / "c.csv",
          fmt::format("frame,limb,contact\n{},left_leg,on\n{},left_leg,off\n0,right_leg,on\n", begin, begin + 12));
    stage.solved(fmt::format("{}loop = [{}, {}]\n{}", ground, begin - 10, begin + 40, table),
                 {"--out", "given.csv", "--frames", "200", "--quiet"});
    for (const PoseLine& row : pose_lines(slurp(stage.folder / "given.csv"))) {
        if (row.limb != "left_leg") continue;
        const std::size_t shown = begin - 10 + static_cast<std::size_t>(row.number("frame")) % 50;
        INFO("frame " << row.number("frame"));
        CHECK(((row.flags & kPlanted) != 0) == (shown >= begin && shown < begin + 12));
    }
    spill(stage.folder / "c.csv", "frame,limb,contact\n0,right_leg,on\n");  // who stands on one leg
    stage.solved(ground + table, {"--out", "given.csv", "--quiet"});
    std::array<std::size_t, 2> planted{};
    for (const PoseLine& row : pose_lines(slurp(stage.folder / "given.csv")))
        planted[row.limb == "left_leg" ? 0 : 1] += (row.flags & kPlanted) != 0;
    CHECK((planted[0] == 0 && planted[1] > 20));
}
