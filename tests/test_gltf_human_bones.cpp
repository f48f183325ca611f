// SPDX-License-Identifier: MIT
//
// VRM's table of human bones, of 0.x and 1.0: each bone is the joint of the node that the table names.
#include <catch2/catch.hpp>

#include "tests/gltf_rig.h"
#include "tools/formats/error.h"
#include "tools/formats/gltf.h"

using namespace swivel::test;
using namespace swivel::formats;
using nlohmann::json;

namespace {

// Node 0 hangs on node 1, so joints and nodes have other numbers.
GltfRig two_nodes()
{
    GltfRig rig;
    const int hand = rig.add("bone 17", -1, {0, 0, 1}), arm = rig.add("bone 3", -1, {0, 0, 0});
    rig.json["scenes"][0]["nodes"] = {arm};
    rig.json["nodes"][static_cast<std::size_t>(arm)]["children"] = {hand};
    return rig;
}

const json kTable0 = {{{"bone", "leftHand"}, {"node", 0}}, {{"bone", "leftLowerArm"}, {"node", 1}}};
const json kTable1 = {{"leftHand", {{"node", 0}}}, {"leftLowerArm", {{"node", 1}}}};

Clip clip_of(const json& extensions)
{
    const TempFolder folder;
    GltfRig rig = two_nodes();
    if (!extensions.is_null()) rig.json["extensions"] = extensions;
    rig.write(folder / "rig.vrm");
    return read_gltf(folder / "rig.vrm").clip;
}

json vrm(const char* extension, const json& bones) { return {{extension, {{"humanoid", {{"humanBones", bones}}}}}}; }

}  // namespace

TEST_CASE("human bones: tables of VRM 0.x and 1.0 name joints")
{
    for (const json& extensions : {vrm("VRM", kTable0), vrm("VRMC_vrm", kTable1)}) {
        const Clip clip = clip_of(extensions);
        REQUIRE(clip.human_bones.size() == 2);
        CHECK(joint_at(clip, clip.human_bones.at("leftHand")).name == "bone 17");
        CHECK(joint_at(clip, clip.human_bones.at("leftLowerArm")).name == "bone 3");
    }
    CHECK(clip_of({}).human_bones.empty());
    CHECK(clip_of({{"VRM", {{"meta", 1}}}}).human_bones.empty());
    // Of a file that has both, the newer.
    json both = vrm("VRM", kTable0);
    both.update(vrm("VRMC_vrm", {{"hips", {{"node", 1}}}}));
    CHECK(clip_of(both).human_bones == std::map<std::string, int>{{"hips", 0}});
}

TEST_CASE("human bones: what is no such table is refused in one line")
{
    const auto refusal = [](const json& extensions) -> std::string {
        try {
            clip_of(extensions);
        } catch (const InputError& error) {
            CHECK(std::string_view(error.what()).find('\n') == std::string_view::npos);
            return error.what();
        }
        return "read";
    };
    const auto refuses = [&](const json& extensions, const char* part) {
        CHECK_THAT(refusal(extensions), Catch::Contains(part));
    };
    refuses(5, "/extensions is not an object");
    refuses({{"VRM", 5}}, "/extensions/VRM is not an object");
    refuses({{"VRMC_vrm", {{"humanoid", "all"}}}}, "/extensions/VRMC_vrm/humanoid is not an object");
    refuses(vrm("VRM", kTable1), "humanBones is not a list");
    refuses(vrm("VRMC_vrm", kTable0), "humanBones is not an object");
    for (const json& node : {json(2), json(-1), json(0.5), json("0"), json(1e300), json()}) {
        refuses(vrm("VRM", {{{"bone", "hips"}, {"node", node}}}), "humanBones/0/node is not a node of the file");
        refuses(vrm("VRMC_vrm", {{"hips", {{"node", node}}}}), "humanBones/hips/node is not a node of the file");
    }
    refuses(vrm("VRM", json::array({{{"bone", 3}, {"node", 0}}})), "humanBones/0/bone is not a bone's name");
    refuses(vrm("VRM", json::array({7})), "humanBones/0/bone is not a bone's name");
    refuses(vrm("VRMC_vrm", {{"hips", 1}}), "humanBones/hips is not an object");
    refuses(vrm("VRM", {kTable0[0], kTable0[0]}), "humanBones/1 is not the only bone of its name");
}
