// SPDX-License-Identifier: MIT
//
// Any figure that binds gives its clip back, and one that does not says why. The command solves the files. A forward
// kinematics of the test's own and Khronos' validator judge them. Made-up figures are also judged by what they were
// made of, and recorded motion by the words of its file.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>
#include <string>

#include "tests/plain_gltf.h"
#include "tests/plain_motion.h"
#include "tests/random_figure.h"
#include "tests/solve_tables.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

json rig_of_file(const fs::path& path, Words options = {}, int exit_code = 0)
{
    options.insert(options.begin(), {"rig", path.string()});
    return report_of(path.parent_path(), options, exit_code);
}

std::vector<LimbNodes> bound_limbs(const json& report)
{
    std::vector<LimbNodes> limbs;
    for (const json& limb : report.at("limbs"))
        if (limb.at("bound") == true) limbs.push_back(limb.at("numbers"));
    return limbs;
}

// Solves all limbs of a file's animation from where the clip has their ends. index -1: it has none.
void solve(const fs::path& path, int index, const fs::path& out, Words options = {})
{
    INFO(path << ", animation " << index);
    if (index >= 0) options.insert(options.end(), {"--clip", std::to_string(index)});
    options.insert(options.begin(),
                   {"solve", path.string(), "--limbs", "all", "--targets", "clip", "--out", out.string()});
    done(run_command(out.parent_path(), options));
}

// Files as they were read and as they were written.
using WrittenFiles = std::vector<std::pair<fs::path, fs::path>>;

// Khronos' validator has no error or warning about a written file that it has not about its source. (But a GLB says
// that it goes on using a picture in the text.)
void require_no_new_messages(const WrittenFiles& files)
{
    const std::vector<std::multiset<std::string>> news = new_gltf_messages(files);
    for (std::size_t n = 0; n < files.size(); ++n) {
        INFO(files[n].second);
        std::multiset<std::string> said = news[n];
        said.erase("DATA_URI_GLB /images/0/uri");
        CHECK(said == std::multiset<std::string>());
    }
}

// Which way a figure faces, by where its left and right shoulders are at rest; all shared figures stand along +y.
Vector3d front_of(const PlainGltf& plain, const json& report)
{
    const auto shoulder = [&](const char* limb) {
        return Vector3d(plain_world(plain, -1, limb_of(report, limb).at("numbers")[0], 0).translation());
    };
    return (shoulder("left_arm") - shoulder("right_arm")).cross(kY);
}

// An elbow bends forwards, a knee backwards, whatever tells it. bend: in the world at rest.
void judge_bend(const json& limb, const Vector3d& bend, const Vector3d& front, const SharedFigure& file)
{
    const bool is_arm = limb.at("limb").get<std::string>().ends_with("arm");
    const std::string said = limb.at("bend_source");
    INFO(limb.at("limb") << ": " << said);
    CHECK(degrees_between(bend, is_arm ? front : Vector3d(-front)) < 60);
    CHECK_THAT(said, Catch::Matchers::Contains(is_arm ? file.arms_by : file.legs_by));
}

}  // namespace

TEST_CASE("rigs: every animation of the shared figures comes back, and bends the right way")
{
    const TempFolder folder;
    WrittenFiles files;
    for (const SharedFigure& file : kSharedFigures) {
        const fs::path path = find_or_warn(file.name);
        if (path.empty()) continue;
        const PlainGltf plain = plain_gltf_of(path);
        for (int index = file.animations > 0 ? 0 : -1; index < file.animations; ++index) {
            files.emplace_back(path, folder / (file.name + std::to_string(index) + ".glb"));
            INFO(file.name << ", animation " << index);
            Words options = file.options;
            if (index > 0) options.insert(options.end(), {"--clip", std::to_string(index)});
            const json report = rig_of_file(path, options);
            for (const json& limb : report.at("limbs")) {
                if (limb.at("bound") == false) continue;
                const Eigen::Affine3d upper = plain_world(plain, -1, limb.at("numbers")[0], 0);
                judge_bend(limb, upper.linear() * vector_of(limb.at("bend")), front_of(plain, report), file);
            }
            const std::vector<LimbNodes> bound = bound_limbs(report);
            CHECK(bound.size() == file.limbs);
            solve(path, index, files.back().second, file.options);
            require_closed(closure(plain, plain_gltf_of(files.back().second), index, bound));
            if (index > 0 && index % 5) files.pop_back();  // the validator is slow
        }
    }
    require_no_new_messages(files);
}

namespace {

// Where a motion has a limb.
LimbJointsAt limb_pose(const PlainMotion& motion, const std::vector<PlainPose>& pose, const PlainArm& limb)
{
    const std::array joints{limb.shoulder, limb.elbow, limb.wrist};
    const auto at = [&](int joint) { return pose[static_cast<std::size_t>(joint)]; };
    LimbJointsAt is;
    for (std::size_t n = 0; n < 3; ++n) {
        is.place[n] = at(joints[n]).position;
        is.turn[n] = at(motion.joint(joints[n]).parent).rotation.transpose() * at(joints[n]).rotation;
    }
    is.end_axes = at(limb.wrist).rotation;
    return is;
}

// Solves limbs of a BVH file from where it has their ends. They come back, and all other words of the file stay.
void require_clip_back(const fs::path& path, std::size_t frame_count, bool has_arms, bool has_legs,
                       const Words& options)
{
    INFO(path << ": " << fmt::format("{}", fmt::join(options, " ")));
    const TempFolder folder;
    Words words = {"solve", path.string(), "--targets", "clip", "--out", "out.bvh"};
    words.insert(words.end(), options.begin(), options.end());
    CHECK(done(run_command(folder.path, words)).err.empty());
    REQUIRE(folder.file_count() == 1);
    const PlainMotion clip = plain_motion_of(path), written = plain_motion_of(folder / "out.bvh");
    REQUIRE(written.header == clip.header);
    REQUIRE(clip.lines.size() == frame_count);
    REQUIRE(written.lines.size() == frame_count);
    std::vector<PlainArm> limbs;
    for (const PlainArm& arm : arms_of(clip))
        if (has_arms) limbs.push_back(arm);
    for (const PlainArm& leg : legs_of(clip))
        if (has_legs) limbs.push_back(leg);
    std::vector<std::size_t> solved;  // channels
    for (const PlainArm& limb : limbs)
        for (const int joint : {limb.shoulder, limb.elbow, limb.wrist})
            for (std::size_t c = 0; c < clip.joint(joint).channels.size(); ++c)
                if (clip.joint(joint).channels[c].ends_with("rotation"))
                    solved.push_back(clip.joint(joint).first_channel + c);
    REQUIRE(solved.size() == 9 * limbs.size());
    Closure worst;
    for (std::size_t frame = 0; frame < frame_count; ++frame, ++worst.frames) {
        const std::vector<PlainPose> before = pose_of(clip, frame), after = pose_of(written, frame);
        for (const PlainArm& limb : limbs) worst.keep(limb_pose(clip, before, limb), limb_pose(written, after, limb));
        REQUIRE(rest_of(clip.lines[frame], solved) == rest_of(written.lines[frame], solved));
        REQUIRE(clip.lines[frame] != written.lines[frame]);  // else nothing was solved
    }
    require_closed(worst);
}

}  // namespace

TEST_CASE("rigs: recorded arms and legs come back, and all other words of their file stay")
{
    require_clip_back(must_find_jump(), 2752, true, false, {});
    require_clip_back(must_find_jump(), 2752, false, true, {"--limbs", "legs"});
    if (const fs::path walk = find_or_warn("cmu_02_01_walk.bvh"); !walk.empty()) {  // with CRLF
        require_clip_back(walk, 343, true, false, {});
        require_clip_back(walk, 343, false, true,
                          {"--leg", "RightUpLeg,RightLeg,RightFoot", "--leg", "LeftUpLeg,LeftLeg,LeftFoot"});
    }
    if (const fs::path dance = find_or_warn("cmu_05_06_dance.bvh"); !dance.empty())
        require_clip_back(dance, 885, true, true, {"--limbs", "all"});
}

TEST_CASE("rigs: the bends of the shared clips")
{
    for (const char* name : kSharedClips) {
        const fs::path path = find_or_warn(name);
        if (path.empty()) continue;
        INFO(name);
        const json report = rig_of_file(path);
        CHECK(bound_limbs(report).size() == 4);
        for (const json& limb : report.at("limbs"))  // BVH rests without rotations
            judge_bend(limb, vector_of(limb.at("bend")), kZ, {name, 1, 4, "clip", "clip"});
    }
}

TEST_CASE("rigs: the page shows what the command prints")
{
    const fs::path path = find_or_warn("RobotExpressive.glb");
    if (path.empty()) return;
    const std::string command = "    $ swivel rig RobotExpressive.glb\n",
                      page = slurp(fs::path(SWIVEL_SOURCE_DIR) / "docs/rigs.md");
    const std::string printed = "\n" + run_command(path.parent_path(), {"rig", path.filename().string()}).out;
    REQUIRE(page.find(command) != std::string::npos);
    std::istringstream shown(page.substr(page.find(command) + command.size()));
    std::size_t lines = 0;
    for (std::string line; std::getline(shown, line) && line.starts_with("    "); ++lines) {
        INFO(line);
        const bool is_cut = line == "    ...";
        CHECK((is_cut || printed.find("\n" + line.substr(4) + "\n") != std::string::npos));
    }
    CHECK(lines > 10);
}

TEST_CASE("rigs: any figure gives its clip back")
{
    const TempFolder folder;
    WrittenFiles files;
    rc::prop("random rest poses, scales, mirrors and joints in between that twist", [&](std::uint32_t seed) {
        INFO("seed " << seed);
        std::mt19937 random(seed);
        const FigureWish wish{.moves = seed % 8 != 0,
                              .bent = seed % 3 != 0,
                              .twist_bones = seed % 2 * 0.4,
                              .scales = seed % 5 * 0.1,
                              .mirrors = seed % 7 * 0.07};
        const Figure figure = random_figure(random, wish);
        const std::string name = std::to_string(files.size()) + (seed % 2 ? ".glb" : ".gltf");
        figure.rig.write(folder / name);
        files.emplace_back(folder / name, folder / ("out" + name));
        const int index = wish.moves ? 0 : -1;
        solve(folder / name, index, files.back().second);
        const PlainGltf from = plain_gltf_of(folder / name), to = plain_gltf_of(files.back().second);
        require_closed(closure(from, to, index, {figure.limbs.begin(), figure.limbs.end()}));
    });
    files.resize(std::min<std::size_t>(files.size(), 20));  // the validator is slow
    require_no_new_messages(files);
}

// What is scaled unevenly by more is refused: tests/command/test_rig_table.cpp.
TEST_CASE("rigs: what is scaled unevenly by little is off by no more than the report says")
{
    const TempFolder folder;
    std::size_t off = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        INFO("seed " << seed);
        std::mt19937 random(seed);
        const FigureWish wish{.scales = 0.3, .uneven = 1, .uneven_by = 1e-4};
        const Figure figure = random_figure(random, wish);
        figure.rig.write(folder / "in.glb");
        const json report = rig_of_file(folder / "in.glb");
        const PlainGltf plain = plain_gltf_of(folder / "in.glb");
        const auto solved = [&](const std::string& option) {
            const Words words{"solve", "in.glb", "--limbs", "all", "--out", "out.glb", option, "t.csv"};
            REQUIRE(run_command(folder.path, words).exit_code == 0);
            return plain_gltf_of(folder / "out.glb");
        };
        const std::vector<double> times = key_times(solved("--export-targets"), figure.limbs[0][0]);
        TargetTable table(slurp(folder / "t.csv"));
        std::vector<Vector3d> asked;  // others than the clip's, which would come back by themselves
        for (std::size_t n = 0; n < table.rows.size(); ++n) {
            const LimbNodes& limb = figure.limbs[n % 4];
            const auto place = [&](std::size_t joint) {
                return Vector3d(plain_world(plain, 0, limb[joint], times[n / 4]).translation());
            };
            const Vector3d arm = place(2) - place(0);
            asked.push_back(place(0) + Eigen::AngleAxisd(0.2, arm.unitOrthogonal()) * arm);
            for (int axis = 0; axis < 3; ++axis)
                table.rows[n][std::string(1, "xyz"[axis])] = fmt::format("{}", asked.back()[axis]);
        }
        spill(folder / "t.csv", table.text());
        const PlainGltf written = solved("--targets");
        for (std::size_t n = 0; n < asked.size(); ++n) {
            const Vector3d end = plain_world(written, 0, figure.limbs[n % 4][2], times[n / 4]).translation();
            const double miss = (end - asked[n]).norm() / (figure.upper[n % 4] + figure.lower[n % 4]);
            CHECK(miss <= limb_of(report, kLimbs[n % 4]).at("unevenness").get<double>() + 1e-5);
            off += miss > 1e-5;
        }
    }
    CHECK(off > 10);  // else there was nothing to bound
}
