// SPDX-License-Identifier: MIT
//
// Any skeleton gets a binding that gives the clip back, or a refusal that says why. The command solves the files. A
// forward kinematics of the test's own and Khronos' validator judge them. Made-up figures are also judged by what they
// were made of.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <string>

#include "tests/gltf_judges.h"
#include "tests/random_figure.h"
#include "tests/rig_report.h"
#include "tests/run_command.h"

using namespace swivel::test;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

constexpr std::array<const char*, 4> kLimbs = {"left_arm", "right_arm", "left_leg", "right_leg"};

json rig_report(const fs::path& path, std::vector<std::string> options = {}, int exit_code = 0)
{
    options.insert(options.begin(), {"rig", path.string(), "--json"});
    const Outcome outcome = run_command(path.parent_path(), options);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == exit_code);
    CHECK(outcome.err.empty() == (exit_code == 0));
    return json::parse(outcome.out);
}

std::vector<LimbNodes> bound_limbs(const json& report)
{
    std::vector<LimbNodes> limbs;
    for (const json& limb : report.at("limbs"))
        if (limb.at("bound") == true) limbs.push_back(limb.at("numbers"));
    return limbs;
}

// Solves one animation of a file back from its own wrists, to `out`, and holds the result against it. index -1: it has
// none.
void solve_back(const fs::path& path, int index, const std::string& limbs, const fs::path& out,
                std::vector<std::string> options = {})
{
    INFO(path << ", animation " << index);
    options.insert(options.end(), {"--limbs", limbs});
    if (index >= 0) options.insert(options.end(), {"--clip", std::to_string(index)});
    const std::vector<LimbNodes> bound = bound_limbs(rig_report(path, options));
    REQUIRE_FALSE(bound.empty());
    options.insert(options.begin(), {"solve", path.string(), "--targets", "clip", "--out", out.string()});
    const Outcome outcome = run_command(out.parent_path(), options);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const Closure worst = closure(plain_gltf_of(path), plain_gltf_of(out), index, bound);
    require_closed(worst);
    CHECK(worst.lower_straight <= 1e-5);  // holds for these files; what a float knows of a straight limb is less
}

// No file has an error, whatever errors its source had.
void require_no_errors(const std::vector<fs::path>& files)
{
    std::vector<std::string> arguments = {"validate"};
    for (const fs::path& file : files) arguments.push_back(file.string());
    for (const json& report : ask_check(arguments)) {
        INFO(report.dump());
        CHECK(report.at("errors") == 0);
    }
}

void solve_back_alone(const fs::path& path, int index, const std::vector<std::string>& options = {})
{
    const TempFolder folder;
    solve_back(path, index, "all", folder / "out.glb", options);
    require_no_errors({folder / "out.glb"});
}

// A real file, or an empty path where this machine keeps none; a folder that was named must have it.
fs::path find_or_warn(const char* name)
{
    const fs::path path = find_data(name);
    if (!path.empty()) return path;
    INFO(name << " is in none of the folders of tests/test_data.h");
    REQUIRE(std::getenv("SWIVEL_TEST_DATA") == nullptr);
    WARN("not judged: " << name << ", which this machine has not; figures made up by the test are");
    return path;
}

// Random figures through the command: each gives its clip back or is refused for the reason it was given.
struct Tally {
    int solved = 0, refused = 0;
};

Tally solve_figures(const FigureWish& wish, int count, unsigned seed)
{
    const TempFolder folder;
    std::mt19937 random(seed);
    Tally tally;
    std::vector<std::string> written = {"validate"};
    for (int n = 0; n < count; ++n) {
        const FigureNames& names = figure_names()[random() % figure_names().size()];
        const Figure figure = random_figure(random, wish, names);
        const std::string name = std::to_string(n) + (n % 2 ? ".glb" : ".gltf"), out = "out" + name;
        figure.rig.write(folder / name);
        INFO("figure " << n << " of seed " << seed << ", " << names.habit);
        const Outcome outcome = run_command(folder.path, {"solve", name, "--limbs", "all", "--out", out});
        INFO(outcome.err);
        if (outcome.exit_code == 1) {
            ++tally.refused;
            CHECK(figure.is_uneven);
            CHECK(outcome.err.find("is scaled unevenly, so its bones change shape") != std::string::npos);
            CHECK_FALSE(fs::exists(folder / out));
            continue;
        }
        REQUIRE(outcome.exit_code == 0);
        CHECK_FALSE(figure.is_uneven);
        ++tally.solved;
        const std::vector<LimbNodes> limbs(figure.limbs.begin(), figure.limbs.end());
        require_closed(closure(plain_gltf_of(folder / name), plain_gltf_of(folder / out), wish.moves ? 0 : -1, limbs));
        written.push_back((folder / out).string());
    }
    for (const json& report : ask_check(written)) {
        INFO(report.dump());
        CHECK(report.at("errors") == 0);
    }
    return tally;
}

}  // namespace

TEST_CASE("rigs: RobotExpressive, every animation")
{
    const fs::path path = find_or_warn("RobotExpressive.glb");
    if (path.empty()) return;
    const TempFolder folder;
    std::vector<fs::path> files;
    for (int index = 0; index < 14; ++index) {
        files.push_back(folder / (std::to_string(index) + ".glb"));
        solve_back(path, index, "arms", files.back());
    }
    require_no_errors(files);
    const json report = rig_report(path);
    CHECK(report["limbs"][0]["named_as"] == "Quaternius");
    CHECK(report["limbs"][0]["scale"].get<double>() == Approx(100));
    CHECK(report["limbs"][2]["problem"] == "'Foot.L' is not below 'LowerLeg.L' in the hierarchy");
}

TEST_CASE("rigs: Mesh2Motion's figures, with animations and without")
{
    for (const auto& [name, index] :
         {std::pair{"m2m_human_ymca.glb", 0}, {"m2m_human_skeleton_tpose.glb", 0}, {"m2m_human_male.glb", -1}})
        if (const fs::path path = find_or_warn(name); !path.empty()) solve_back_alone(path, index);
}

TEST_CASE("rigs: cesium_man, whose joints have no names, by number")
{
    const fs::path path = find_or_warn("cesium_man.gltf");
    if (path.empty()) return;
    solve_back_alone(path, 0,
                     {"--arm", "left:#16,#17,#18", "--arm", "right:#13,#14,#15", "--leg", "left:#7,#8,#9", "--leg",
                      "right:#3,#4,#5"});
    const json report = rig_report(path, {}, 1);
    CHECK(report["limbs"][0]["problem"] == "no joints have names in use for such a limb");
}

TEST_CASE("rigs: what is no figure is refused")
{
    for (const char* name : {"rigged_simple.gltf", "interpolation_test.gltf"}) {
        const fs::path path = find_or_warn(name);
        if (path.empty()) continue;
        INFO(name);
        const TempFolder folder;
        const json report = rig_report(path, {}, 1);
        for (const json& limb : report.at("limbs"))
            CHECK(limb.at("problem").get<std::string>().starts_with("a limb takes three bones below each other"));
        const Outcome outcome = run_command(folder.path, {"solve", path.string(), "--out", "out.glb"});
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.err.find("no arms found by the usual joint names (a limb takes three bones") !=
              std::string::npos);
        CHECK(folder.file_count() == 0);
    }
}

TEST_CASE("rigs: figures under every name, with any joint axes")
{
    const Tally tally = solve_figures({}, 20, 1);
    CHECK(tally.solved == 20);
}

TEST_CASE("rigs: scaled and mirrored figures, stretched bones, twist bones in between and beside")
{
    FigureWish wish;
    wish.scales = 0.5;
    wish.mirrors = 0.5;
    wish.twist_bones = 0.4;
    const Tally tally = solve_figures(wish, 40, 2);
    CHECK(tally.solved == 40);
}

TEST_CASE("rigs: uneven scales at or above a limb are refused, and nothing else is")
{
    FigureWish wish;
    wish.uneven = 0.4;
    wish.scales = 0.3;
    wish.twist_bones = 0.2;
    const Tally tally = solve_figures(wish, 30, 3);
    CHECK(tally.solved > 3);
    CHECK(tally.refused > 3);
}

TEST_CASE("rigs: figures without motion, straight")
{
    FigureWish wish;
    wish.moves = wish.bent = false;
    wish.scales = wish.mirrors = 0.4;
    const Tally tally = solve_figures(wish, 10, 4);
    CHECK(tally.solved == 10);
}

TEST_CASE("rigs: lengths, habits and the way joints bend are what the figure was made of")
{
    const TempFolder folder;
    std::mt19937 random(5);
    for (int round = 0; round < 24; ++round) {
        FigureWish wish;
        wish.moves = false;
        wish.bent = round % 2 == 0;
        wish.toes = round % 3 == 0;
        wish.scales = wish.mirrors = round % 4 == 0 ? 0 : 0.3;
        const FigureNames& names = figure_names()[static_cast<std::size_t>(round) % figure_names().size()];
        const Figure figure = random_figure(random, wish, names);
        figure.rig.write(folder / "rig.glb");
        // A mirror may have exchanged left and right, or be there to make a left hand's axes a right one's.
        const auto is_open = [&](double bend) { return figure.is_mirrored && !wish.toes && bend == 0; };
        const bool none_binds = std::all_of(figure.bend.begin(), figure.bend.end(), is_open);
        const json report = rig_report(folder / "rig.glb", {}, none_binds ? 1 : 0);
        const PlainGltf plain = plain_gltf_of(folder / "rig.glb");
        REQUIRE(report.at("limbs").size() == 4);
        for (std::size_t n = 0; n < 4; ++n) {
            const json& limb = report["limbs"][n];
            INFO("round " << round << ", " << names.habit << ": " << limb.dump());
            REQUIRE(limb.at("limb") == kLimbs[n]);
            REQUIRE(limb.at("bound") == !is_open(figure.bend[n]));
            if (limb.at("bound") == false) {
                CHECK(limb.at("problem").get<std::string>().find("leaves open whether left and right are exchanged") !=
                      std::string::npos);
                continue;
            }
            CHECK(limb.at("numbers").get<LimbNodes>() == figure.limbs[n]);
            CHECK(limb["lengths"][0].get<double>() == Approx(figure.upper[n]).epsilon(1e-5));
            CHECK(limb["lengths"][1].get<double>() == Approx(figure.lower[n]).epsilon(1e-5));
            // An elbow bends forwards, a knee backwards.
            const int parent = plain.parent_of(figure.limbs[n][0]);
            const Eigen::Matrix3d to_world =
                plain_world(plain, -1, parent, 0).linear() * plain_local(plain, -1, figure.limbs[n][0], 0).rotation();
            const json& at = plain.nodes()[static_cast<std::size_t>(figure.limbs[n][0])];
            const bool own_mirror =
                at.contains("scale") && (at["scale"][0] < 0 || at["scale"][1] < 0 || at["scale"][2] < 0);
            if (own_mirror) continue;  // the plain reading's axes are turned over there
            const Vector3d flexion_w = (to_world * vector_of(limb["bend"])).normalized();
            CHECK(flexion_w.dot(n < 2 ? figure.front : Vector3d(-figure.front)) > 0.9);
        }
    }
}

TEST_CASE("rigs: names that repeat, lie elsewhere or have strangers in between are refused in one line")
{
    const TempFolder folder;
    const auto problem = [&](const std::function<void(GltfRig&)>& build) {
        GltfRig rig;
        build(rig);
        rig.write(folder / "rig.glb");
        return rig_report(folder / "rig.glb", {"--limbs", "arms"}, 1)["limbs"][0]["problem"].get<std::string>();
    };
    const auto chain = [](GltfRig& rig, const std::vector<std::string>& names, double step = 1) {
        int parent = rig.add("root", -1, {0, 0, 0});
        for (const std::string& name : names) parent = rig.add(name, parent, {step, 0, 0});
        return parent;
    };
    CHECK(problem([&](GltfRig& rig) {
              chain(rig, {"LeftArm", "LeftForeArm", "LeftHand", "LeftForeArm"});
          }) == "2 joints are called 'LeftForeArm'");
    CHECK(problem([&](GltfRig& rig) {
              chain(rig, {"LeftArm", "LeftHand", "LeftForeArm"});
          }) == "'LeftHand' lies between 'LeftArm' and 'LeftForeArm' and is no twist bone by its name");
    CHECK(problem([&](GltfRig& rig) {
              chain(rig, {"LeftArm", "Gadget", "LeftForeArm", "LeftHand"});
          }) == "'Gadget' lies between 'LeftArm' and 'LeftForeArm' and is no twist bone by its name");
    CHECK(problem([&](GltfRig& rig) {
              chain(rig, {"LeftArm", "LeftForeArm", "Claw"});
          }) == "no joint is called 'lefthand' or alike for its wrist");
    CHECK(problem([&](GltfRig& rig) {
              chain(rig, {"LeftArm", "LeftForeArm", "LeftHand"}, 0);
          }) == "the bone from 'LeftArm' to 'LeftForeArm' has no length; name other joints");
    CHECK(problem([&](GltfRig& rig) {
              chain(rig, {"tail1", "tail2", "tail3", "tail4"});
          }) == "no joints have names in use for such a limb");
}

TEST_CASE("rigs: the animation and its rate are chosen, and what a file cannot hold is said")
{
    const TempFolder folder;
    std::mt19937 random(6);
    random_figure(random, {}, figure_names()[0]).rig.write(folder / "rig.glb");
    const auto run = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"solve", "rig.glb"});
        return run_command(folder.path, options);
    };
    CHECK(run({"--clip", "motion", "--fps", "30", "--out", "new.glb"}).exit_code == 0);
    CHECK(plain_gltf_of(folder / "new.glb").json["animations"].size() == 1);
    const auto refused = [&](const std::vector<std::string>& options, int code, const char* part) {
        const Outcome outcome = run(options);
        INFO(outcome.err);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.err.find(part) != std::string::npos);
    };
    refused({"--clip", "dance"}, 1, "it has no animation 'dance'; it has 0 motion");
    refused({"--out", "new.bvh"}, 2, "this clip is a glTF file; its poses go to .glb, .gltf or .csv");
    refused({"--out", "new.glb", "--characters", "2"}, 2, "a glTF file holds one character, not 2");
    refused({"--arm", "#1,#2,#99"}, 1, "no joint is called '#99' (--arm); swivel rig --joints lists them");
    const Outcome rig = run_command(folder.path, {"rig", "rig.glb", "--joints"});
    CHECK_THAT(rig.out, Catch::Matchers::Matches("[^]*#3 +\\([-0-9. ]+\\) +Armature/hips/chest/mixamorig:LeftArm[^]*"));
    CHECK(run({"--characters", "5", "--out", "crowd.csv"}).exit_code == 0);
}
