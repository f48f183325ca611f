// SPDX-License-Identifier: MIT
//
// The buffers of glTF files, and what becomes of them and of all other addresses in a file that is written. Files that
// are large, endless or deep work, or end in one line, and take no more time and memory than their size asks for. Which
// files are read is in tests/transcripts/gltf.txt.
#include <catch2/catch.hpp>

#include <sys/stat.h>
#include <fstream>

#include "tests/gltf_rig.h"
#include "tests/plain_gltf.h"
#include "tests/run_command.h"
#include "tools/formats/gltf.h"

using namespace swivel::test;
using namespace swivel::formats;
using Catch::Contains;
using nlohmann::json;

namespace {

// Two keys in a .gltf and a .bin beside it.
GltfRig moving_rig()
{
    GltfRig rig;
    const int node = rig.add("a", -1, {0, 0, 0});
    rig.add_keys(rig.add_animation("move"), node, "translation", {0, 1 / 24.0f}, {0, 0, 0, 0, 1, 0});
    return rig;
}

const std::string kBase64 = "AAAAAKuqKj0AAAAAAAAAAAAAAAAAAAAAAACAPwAAAAA";  // of its bytes

// A file of zeros that takes no room on the disk.
void spill_zeros(const fs::path& path, std::uintmax_t size)
{
    spill(path, "");
    fs::resize_file(path, size);
}

}  // namespace

TEST_CASE("gltf buffers: a file may be longer than its buffer, not shorter")
{
    const TempFolder folder;
    const GltfRig rig = moving_rig();
    rig.write(folder / "rig.gltf");
    std::ofstream(folder / "rig.bin", std::ios::app | std::ios::binary) << "more";
    const GltfFile file = read_gltf(folder / "rig.gltf");
    CHECK(file.buffers == std::vector<std::string_view>{rig.bytes});
    for (const char* out : {"new.glb", "new.gltf"}) {
        write_gltf(folder / out, file, {});
        CHECK(plain_gltf_of(folder / out).json["buffers"][0]["byteLength"] == rig.bytes.size());
        CHECK(read_gltf(folder / out).buffers == file.buffers);
    }
    spill(folder / "rig.bin", rig.bytes.substr(4));
    CHECK_THROWS_WITH(read_gltf(folder / "rig.gltf"), Contains("buffer 0 has 32 bytes by its byteLength and 28 in "
                                                               "'rig.bin'; the file is cut short"));
}

TEST_CASE("gltf buffers: a GLB's chunk is its first buffer's alone")
{
    const TempFolder folder;
    json whole = moving_rig().json;
    const auto read = [&](const json& buffers, const std::string& chunk) {
        whole["buffers"] = buffers;
        spill(folder / "rig.glb", GltfRig::glb(whole.dump(), chunk));
        const GltfFile file = read_gltf(folder / "rig.glb");
        return file.buffers == std::vector<std::string_view>{moving_rig().bytes};
    };
    const json own = {{"byteLength", 32}};
    const std::string bytes = moving_rig().bytes;
    CHECK(read(json::array({own}), bytes));
    CHECK(read(json::array({own}), bytes + "padding."));
    CHECK_THROWS_WITH(read(json::array({own, own}), bytes), Contains("buffer 1 has no uri"));
    CHECK_THROWS_WITH(read(json::array({own}), ""),
                      Contains("buffer 0 has 32 bytes by its byteLength and 0 in the GLB's chunk"));
    CHECK_THROWS_WITH(read(json::array({{{"byteLength", 1u << 31}}}), bytes),
                      Contains("2147483648 bytes by its byteLength"));
}

TEST_CASE("gltf buffers: a file of several buffers is read once, and no more than 8 GiB of all")
{
    const TempFolder folder;
    constexpr std::size_t kSize = 64u << 20;
    spill_zeros(folder / "big.bin", kSize);
    json whole = {{"asset", {{"version", "2.0"}}}, {"nodes", {{{"name", "LeftArm"}}}}};
    for (std::size_t n = 0; n < 16; ++n)
        whole["buffers"].push_back({{"byteLength", kSize - n % 2}, {"uri", "big.bin"}});
    spill(folder / "rig.gltf", whole.dump());
    const GltfFile file = read_gltf(folder / "rig.gltf");
    REQUIRE(file.buffers.size() == 16);
    for (std::size_t n = 0; n < 16; ++n) CHECK(file.buffers[n].size() == kSize - n % 2);
    const Outcome outcome = spawn_command(folder.path, {"rig", "rig.gltf"});
    INFO(outcome.peak_kib);
    CHECK(outcome.peak_kib > 60'000);
    CHECK(outcome.peak_kib < 300'000);

    whole["buffers"] = json::array();
    for (const char* name : {"a.bin", "b.bin", "c.bin"}) {
        whole["buffers"].push_back({{"byteLength", std::uintmax_t{3} << 30}, {"uri", name}});
        spill_zeros(folder / name, std::uintmax_t{3} << 30);
    }
    spill(folder / "rig.gltf", whole.dump());
    CHECK_THROWS_WITH(read_gltf(folder / "rig.gltf"), Contains("its buffers come to more than 8 GiB"));
}

TEST_CASE("gltf buffers: a .glb takes in all buffers of a .gltf, and a .gltf goes on using them")
{
    const TempFolder folder;
    fs::create_directory(folder / "in");
    fs::create_directory(folder / "out");
    const std::string bytes = moving_rig().bytes;
    json whole = moving_rig().json;
    // The first buffer is of an odd length, and the keys' views are in the second and third.
    whole["buffers"] = {{{"byteLength", 5}, {"uri", "odd.bin"}},
                        {{"byteLength", 32}, {"uri", "data:;base64," + kBase64}},
                        {{"byteLength", 32}, {"uri", "keys.bin"}}};
    whole["bufferViews"][0]["buffer"] = 1;
    whole["bufferViews"][1]["buffer"] = 2;
    whole["bufferViews"][1]["extensions"]["VENDOR_packed"] = {{"buffer", 0}, {"byteOffset", 1}, {"byteLength", 4}};
    whole["extensionsUsed"] = {"VENDOR_packed"};
    spill(folder / "in/odd.bin", "odd..");
    spill(folder / "in/keys.bin", bytes);
    spill(folder / "in/rig.gltf", whole.dump());
    const GltfFile file = read_gltf(folder / "in/rig.gltf");
    for (const char* out : {"out/new.glb", "out/new.gltf"}) {
        INFO(out);
        write_gltf(folder / out, file, {});
        CHECK(new_gltf_messages(folder / "in/rig.gltf", folder / out).empty());
        const PlainGltf before = plain_gltf_of(folder / "in/rig.gltf"), after = plain_gltf_of(folder / out);
        for (const int accessor : {0, 1}) CHECK(plain_numbers(after, accessor) == plain_numbers(before, accessor));
        const json& packed = after.json["bufferViews"][1]["extensions"]["VENDOR_packed"];
        CHECK(after.buffers.at(packed["buffer"].get<std::size_t>()).substr(packed["byteOffset"], 4) == "dd..");
    }
    CHECK(plain_gltf_of(folder / "out/new.glb").json["buffers"].size() == 1);
    CHECK(plain_gltf_of(folder / "out/new.gltf").json["buffers"][2]["uri"] == "../in/keys.bin");
}

TEST_CASE("gltf buffers: every other address is rewritten for the new place, and none is opened")
{
    const TempFolder folder;
    fs::create_directory(folder / "in put");
    fs::create_directory(folder / "out");
    REQUIRE(mkfifo((folder / "in put/pipe").c_str(), 0600) == 0);  // who opens it waits for ever
    json whole = moving_rig().json;
    whole["buffers"] = {{{"byteLength", 32}, {"uri", "rig.bin"}}};
    whole["images"] = {{{"uri", "pipe"}}, {{"uri", "/etc/passwd"}}, {{"uri", "https://a.org/b.png"}}};
    whole["extensions"]["VENDOR_sounds"]["sounds"] = {{{"uri", "../up/a%20b.ogg"}}, {{"uri", 5}}};
    whole["extras"] = {{"uri", "mine"}};
    spill(folder / "in put/rig.bin", moving_rig().bytes);
    spill(folder / "in put/rig.gltf", whole.dump());
    const GltfFile file = read_gltf(folder / "in put/rig.gltf");
    for (const char* out : {"out/new.glb", "out/new.gltf", "in put/new.glb"}) {
        INFO(out);
        const std::string way = std::string_view(out).starts_with("out") ? "../in%20put/" : "";
        write_gltf(folder / out, file, {});
        const json after = plain_gltf_of(folder / out).json;
        CHECK(after["images"][0]["uri"] == way + "pipe");
        CHECK(after["images"][1] == whole["images"][1]);
        CHECK(after["images"][2] == whole["images"][2]);
        CHECK(after["extensions"]["VENDOR_sounds"]["sounds"][0]["uri"] == way + "../up/a%20b.ogg");
        CHECK(after["extensions"]["VENDOR_sounds"]["sounds"][1]["uri"] == 5);
        CHECK(after["extras"] == whole["extras"]);
    }
}

namespace {

// A GLB's header that promises so many bytes.
std::string glb_head(std::uint32_t size)
{
    std::string glb = GltfRig::glb("{}", "").substr(0, 12);
    for (std::size_t n = 0; n < 4; ++n) glb[8 + n] = static_cast<char>(size >> (8 * n) & 0xff);
    return glb;
}

}  // namespace

TEST_CASE("gltf faults: of a device or a pipe no more is read than the file says it has")
{
    const TempFolder folder;
    const auto refuses = [&](const Outcome& outcome, const char* part) {
        INFO(outcome.err);
        CHECK(outcome.exit_code == 1);
        CHECK_THAT(outcome.err, Contains(part));
        CHECK(outcome.peak_kib < 200'000);
    };
    fs::create_symlink("/dev/zero", folder / "zero.glb");
    refuses(spawn_command(folder.path, {"rig", "zero.glb"}), "begins with '\\x00\\x00");
    // Three GiB, of which the header says that twenty, or none, are the file.
    const std::string good = slurp(fs::path(SWIVEL_SOURCE_DIR) / "tools/view/figure.glb");
    spill(folder / "long.glb", good);
    fs::resize_file(folder / "long.glb", std::uintmax_t{3} << 30);
    const Outcome outcome = spawn_command(folder.path, {"rig", "long.glb"});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.peak_kib < 200'000);
    spill(folder / "empty.glb", glb_head(0));
    fs::resize_file(folder / "empty.glb", std::uintmax_t{3} << 30);
    refuses(spawn_command(folder.path, {"rig", "empty.glb"}), "the GLB says it has 0 bytes");
    // A header alone makes no room for what it promises.
    refuses(run_command(folder.path, {"rig", "-"}, glb_head(4'000'000'000)), "has 4000000000 bytes and has 12");
    CHECK(run_command(folder.path, {"rig", "-"}, good + "more than the GLB has").exit_code == 0);
    spill(folder / "long.gltf", "{");
    fs::resize_file(folder / "long.gltf", std::uintmax_t{3} << 30);
    CHECK_THROWS_WITH(read_gltf(folder / "long.gltf"), Contains("is longer than 2 GiB; cut it, or write it as .glb"));
}

// In square time it would take hours.
TEST_CASE("gltf faults: a chain of many nodes is read and written")
{
    const TempFolder folder;
    constexpr std::size_t kCount = 300'000;
    std::string text = R"({"asset":{"version":"2.0"},"nodes":[)";
    for (std::size_t n = 0; n + 1 < kCount; ++n)
        text += R"({"name":"bone","translation":[0,1,0],"children":[)" + std::to_string(n + 1) + "]},";
    spill(folder / "chain.gltf", text + R"({"name":"end"}]})");
    const GltfFile file = read_clip(folder / "chain.gltf");
    const int last = find_joints(file.clip, "end").at(0);
    CHECK(joint_path(file.clip, last).size() == 5 * kCount - 2);
    CHECK(world_pose(file.clip, 0).back().position.y() == kCount - 1);
    const std::vector<Eigen::Quaterniond> turn = {Eigen::Quaterniond(0, 1, 0, 0)};
    const JointKeys change[] = {{last, turn}};
    write_gltf(folder / "new.glb", file, change);
    CHECK(plain_gltf_of(folder / "new.glb").json["nodes"].size() == kCount);
}
