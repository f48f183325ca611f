// SPDX-License-Identifier: MIT
//
// What `swivel view`, `solve --view` and `demo --view` write into a page: the clip's joints by forward kinematics of
// the tests' own, characters and goals, names that try to end the script. tests/page looks at the page itself, which
// must have the command's digests, and tests/transcripts/view.txt says what is refused.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"
#include "tools/crowd/limb_setup.h"
#include "tools/formats/base64.h"

using namespace swivel::test;
using Eigen::Vector3d;
using Json = nlohmann::json;

namespace {

const std::string kBefore = "<!doctype html><script data-digest=\"", kBegin = "\">start(", kAfter = ")</script>\n";
const std::string kEvil = "</script><img/src=x/onerror=alert(1)>\"'&";

// FNV-1a of 64 bits.
std::string digest_of_script(const std::string& script)
{
    std::uint64_t digest = 14695981039346656037u;
    for (const char byte : script) {
        digest ^= static_cast<unsigned char>(byte);
        digest *= 1099511628211u;
    }
    return fmt::format("{:016x}", digest);
}

// An installed command with a page's program beside it.
struct Stage {
    TempFolder folder;

    Stage()
    {
        for (const char* name : {"bin", "share", "share/swivel", "work"}) fs::create_directory(folder / name);
        fs::copy_file(SWIVEL_COMMAND, folder / "bin/swivel");
        spill(folder / "share/swivel/view.html", kBefore + kBegin + "/*crowd*/null" + kAfter);
        spill(folder / "work/clip.bvh", kTwoArms);
    }
    Outcome run(Words words) const
    {
        words.insert(words.begin(), (folder / "bin/swivel").string());
        return run_program(folder / "work", words);
    }
    fs::path at(const std::string& name) const { return folder / ("work/" + name); }
    // What the page holds; its program must be around it, unchanged.
    Json page(const std::string& name) const
    {
        const std::string text = slurp(at(name));
        REQUIRE(text.starts_with(kBefore));
        REQUIRE(text.ends_with(kAfter));
        const std::size_t begin = kBefore.size() + 16 + kBegin.size();
        REQUIRE(text.substr(kBefore.size() + 16, kBegin.size()) == kBegin);
        const std::string json = text.substr(begin, text.size() - begin - kAfter.size());
        CHECK(json.find('<') == std::string::npos);
        CHECK(text.substr(kBefore.size(), 16) == digest_of_script("start(" + json + ")"));
        return Json::parse(json);
    }
    Json view(Words words, const std::string& name = "clip.bvh.html") const
    {
        words.insert(words.begin(), {"view", "clip.bvh"});
        const Outcome outcome = done(run(words));
        CHECK(outcome.err.empty());
        return page(name);
    }
};

template <class Value>
std::vector<Value> values_of(const Json& text)
{
    const std::string bytes = swivel::formats::bytes_of_base64(text.get<std::string>()).value();
    REQUIRE(bytes.size() % sizeof(Value) == 0);
    std::vector<Value> values(bytes.size() / sizeof(Value));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

}  // namespace

TEST_CASE("a page holds the clip's joints, its characters and a digest of each frame")
{
    const Stage stage;
    const Json page = stage.view({"--characters", "40"});
    CHECK(page.at("title") == "clip.bvh");
    CHECK(page.at("frame_count") == 2);
    CHECK(page.at("frame_seconds") == 0.01);
    const PlainMotion motion = plain_motion_of(stage.at("clip.bvh"));
    const auto positions = values_of<float>(page.at("positions"));
    const std::size_t joint_count = page.at("joints").size();
    REQUIRE(joint_count == motion.joints.size());
    REQUIRE(positions.size() == 2 * joint_count * 3);
    for (std::size_t frame = 0; frame < 2; ++frame) {
        const std::vector<PlainPose> pose = pose_of(motion, frame);
        for (std::size_t n = 0; n < joint_count; ++n) {
            CHECK(page.at("joints")[n].at("name") == motion.joints[n].name);
            CHECK(page.at("joints")[n].at("parent") == motion.joints[n].parent);
            const float* at = &positions[(frame * joint_count + n) * 3];
            CHECK((Vector3d(at[0], at[1], at[2]) - pose[n].position).norm() < 1e-5);
        }
    }
    const auto characters = values_of<goal_character>(page.at("characters"));
    REQUIRE(characters.size() == 40);
    CHECK(characters[0].size == 1);
    CHECK(characters[0].start == 0);
    for (const Json& limb : page.at("limbs")) CHECK(values_of<goal_source>(limb.at("sources")).size() == 2);
    CHECK(page.at("limbs")[0].at("joints") == Json({1, 2, 3}));
    CHECK(page.at("digests").size() == 2);
}

TEST_CASE("targets of one's own are in the page as the solver takes them, up to the last frame that it has")
{
    const Stage stage;
    spill(stage.at("t.csv"), "frame,character,limb,x,y,z\n0,1,left_arm,7,8,3\n1,0,right_arm,-6,6,4\n");
    const Outcome outcome =
        stage.run({"solve", "clip.bvh", "--characters", "2", "--targets", "t.csv", "--view", "a.html"});
    REQUIRE(outcome.exit_code == 0);
    struct Given {
        std::uint32_t frame, character, limb;
        float pole_weight;
        double target[3], pole[3];
        float hand[4];
    };
    const Json page = stage.page("a.html");
    const auto given = values_of<Given>(page.at("given"));
    REQUIRE(given.size() == 2);
    CHECK(given[0].character == 1);
    CHECK(given[1].frame == 1);
    CHECK(given[1].limb == 1);
    CHECK(given[0].pole_weight == 0);
    CHECK(std::ranges::equal(given[0].target, std::array{7.0, 8.0, 3.0}));
    CHECK(
        values_of<Given>(stage.view({"--characters", "2", "--targets", "t.csv", "--frames", "1"}).at("given")).size() ==
        1);
}

TEST_CASE("names cannot end a page's script")
{
    const Stage stage;
    spill(stage.at("clip.bvh"), edited(kTwoArms, "ROOT Hips", "ROOT " + kEvil));
    CHECK(stage.view({}).at("joints")[0].at("name") == kEvil);
    const std::string name = "<img src=x onerror=alert(1)>\"'&.bvh";
    fs::copy_file(stage.at("clip.bvh"), stage.at(name));
    REQUIRE(stage.run({"view", name}).exit_code == 0);
    CHECK(stage.page(name + ".html").at("title") == name);
}

TEST_CASE("without a file the page shows the figure that is installed, in its own skin")
{
    const Stage stage;
    const fs::path source = SWIVEL_SOURCE_DIR;
    for (const char* name : {"tools/view/figure.glb", "tools/view/figure.toml", "examples/hills.png"})
        fs::copy_file(source / name, stage.folder / "share/swivel" / fs::path(name).filename());
    done(stage.run({"view"}));
    const Json page = stage.page("figure.glb.html"), skin = page.at("skin");
    CHECK(page.at("character_count") == 300);
    CHECK(page.at("frame_count") == 300);
    CHECK(page.contains("ground"));
    const std::string glb = swivel::formats::bytes_of_base64(skin.at("glb").get<std::string>()).value();
    REQUIRE(glb.starts_with("glTF"));
    std::uint32_t json_size = 0;
    std::memcpy(&json_size, &glb[12], sizeof json_size);
    const Json gltf = Json::parse(glb.substr(20, json_size));
    CHECK_FALSE(gltf.contains("animations"));
    CHECK(gltf.at("buffers").size() == 1);
    // Joints have their names' nodes, and turns that are unit and not scaled.
    const Json& joints = page.at("joints");
    REQUIRE(skin.at("nodes").size() == joints.size());
    for (std::size_t n = 0; n < joints.size(); ++n)
        CHECK(gltf.at("nodes")[skin.at("nodes")[n].get<std::size_t>()].at("name") == joints[n].at("name"));
    CHECK(joints[skin.at("head").back().get<std::size_t>()].at("name") == "head");
    const auto turns = values_of<float>(skin.at("turns"));
    REQUIRE(turns.size() == 5 * values_of<float>(page.at("positions")).size() / 3);
    for (std::size_t n = 0; n < turns.size(); n += 5) {
        CHECK(std::hypot(std::hypot(turns[n], turns[n + 1]), std::hypot(turns[n + 2], turns[n + 3])) ==
              Approx(1).margin(1e-5));
        CHECK(turns[n + 4] == Approx(1).margin(1e-4));
    }
    CHECK_FALSE(stage.view({}).contains("skin"));  // a BVH file has none
}
