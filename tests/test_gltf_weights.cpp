// SPDX-License-Identifier: MIT
//
// Skin weights that do not add up to 1: in written files they do, by Khronos' validator, and nothing else has changed.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "tests/gltf_judges.h"
#include "tests/gltf_rig.h"
#include "tests/plain_gltf.h"
#include "tests/run_command.h"
#include "tools/formats/error.h"
#include "tools/formats/gltf.h"

using namespace swivel::test;
using namespace swivel::formats;
using nlohmann::json;

namespace {

constexpr int kByte = 5121, kShort = 5123, kFloat = 5126;

// A left arm with a mesh of points on it, each weighted to up to eight joints.
struct WeightedRig {
    GltfRig rig;
    std::size_t vertex_count;

    explicit WeightedRig(std::size_t vertices) : vertex_count(vertices)
    {
        int parent = rig.add("root", -1, {0, 0, 0});
        const int root = parent;
        for (const char* name : {"LeftArm", "LeftForeArm", "LeftHand", "a", "b", "c", "d"})
            parent = rig.add(name, parent, {0.3, 0, -0.01 * static_cast<double>(std::strlen(name))});
        rig.json["skins"] = {{{"joints", {0, 1, 2, 3, 4, 5, 6, 7}}}};
        rig.json["meshes"] = {{{"primitives", json::array()}}};
        const int body = rig.add("body", -1, {0, 0, 0});
        rig.json["nodes"][static_cast<std::size_t>(body)].update({{"mesh", 0}, {"skin", 0}});
        rig.add_keys(rig.add_animation("move"), root, "translation", {0, 1 / 24.0f}, {0, 0, 0, 0, 1, 0});
    }
    // An accessor over bytes as they are.
    int add_raw(const std::string& content, int type, bool is_normalized)
    {
        rig.bytes.resize((rig.bytes.size() + 3) / 4 * 4);
        rig.json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", rig.bytes.size()}, {"byteLength", content.size()}, {"target", 34962}});
        rig.bytes += content;
        json accessor = {{"bufferView", rig.json["bufferViews"].size() - 1},
                         {"componentType", type},
                         {"count", vertex_count},
                         {"type", "VEC4"}};
        if (is_normalized) accessor["normalized"] = true;
        rig.json["accessors"].push_back(accessor);
        return static_cast<int>(rig.json["accessors"].size()) - 1;
    }
    template <class T>
    int add_weights(const std::vector<T>& values)
    {
        const int type = sizeof(T) == 4 ? kFloat : sizeof(T) == 2 ? kShort : kByte;
        return add_raw({reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size()}, type, type != kFloat);
    }
    // A primitive of points with these sets of weights; joints without weight are 0, as glTF asks.
    json& add_primitive(const std::vector<int>& weights, const std::vector<std::vector<bool>>& is_used)
    {
        std::vector<float> places(3 * vertex_count);
        for (std::size_t n = 0; n < places.size(); ++n) places[n] = 0.01f * static_cast<float>(n);
        const int positions = rig.add_accessor(places, "VEC3", 3);
        auto& accessor = rig.json["accessors"].back();
        accessor["min"] = {places[0], places[1], places[2]};
        accessor["max"] = {places[3 * vertex_count - 3], places[3 * vertex_count - 2], places[3 * vertex_count - 1]};
        json primitive = {{"mode", 0}, {"attributes", {{"POSITION", positions}}}};
        for (std::size_t set = 0; set < weights.size(); ++set) {
            std::string joints(4 * vertex_count, '\0');
            for (std::size_t n = 0; n < joints.size(); ++n)
                if (is_used[set][n]) joints[n] = static_cast<char>(4 * set + n % 4);
            primitive["attributes"]["JOINTS_" + std::to_string(set)] = add_raw(joints, kByte, false);
            primitive["attributes"]["WEIGHTS_" + std::to_string(set)] = weights[set];
        }
        rig.json["meshes"][0]["primitives"].push_back(primitive);
        return rig.json["meshes"][0]["primitives"].back();
    }
    template <class T>
    json& add_primitive(const std::vector<std::vector<T>>& sets)
    {
        std::vector<int> weights;
        std::vector<std::vector<bool>> is_used;
        for (const std::vector<T>& set : sets) {
            weights.push_back(add_weights(set));
            is_used.emplace_back();
            for (const T weight : set) is_used.back().push_back(weight != 0);
        }
        return add_primitive(weights, is_used);
    }
};

std::size_t count_of(const std::multiset<std::string>& errors, const char* code)
{
    return static_cast<std::size_t>(std::count_if(
        errors.begin(), errors.end(), [&](const std::string& each) { return each.find(code) != std::string::npos; }));
}

std::vector<float> weights_of(const PlainGltf& gltf, std::size_t primitive, const char* set = "WEIGHTS_0")
{
    const json& attributes = gltf.json["meshes"][0]["primitives"][primitive]["attributes"];
    const std::vector<double>& numbers = plain_numbers(gltf, attributes.at(set));
    return {numbers.begin(), numbers.end()};
}

// The file read and written in one shape and the other, by the validator without errors; the plain reading of the GLB.
PlainGltf mended(const GltfRig& rig, const TempFolder& folder, std::size_t mended_count)
{
    rig.write(folder / "rig.gltf");
    const GltfFile file = read_gltf(folder / "rig.gltf");
    CHECK(mended_vertex_count(file) == mended_count);
    for (const char* out : {"new.gltf", "new.glb"}) {
        write_gltf(folder / out, file, {});
        INFO(out);
        std::multiset<std::string> warnings;
        CHECK(gltf_errors(folder / out, &warnings) == std::multiset<std::string>());
        CHECK(warnings.empty());
        CHECK(mended_vertex_count(read_gltf(folder / out)) == 0);
    }
    CHECK(weights_of(plain_gltf_of(folder / "new.gltf"), 0) == weights_of(plain_gltf_of(folder / "new.glb"), 0));
    return plain_gltf_of(folder / "new.glb");
}

}  // namespace

TEST_CASE("gltf weights: those that do not add up are divided by their sum, all else stays")
{
    const TempFolder folder;
    WeightedRig made(6);
    const std::vector<float> weights = {0.25f, 0.25f, 0, 0,    0.7f, 0.2f, 0.1f, 0, 0.6f, 0.6f,  0.6f, 0.6f,
                                        0,     0,     0, 0.3f, 0,    0,    0,    0, 1.0f, 1e-7f, 0,    0};
    json& primitive = made.add_primitive<float>({weights});
    primitive["extras"] = "kept";
    const int old = primitive["attributes"]["WEIGHTS_0"];
    made.rig.write(folder / "bad.glb");
    CHECK(count_of(gltf_errors(folder / "bad.glb"), "WEIGHTS_NON_NORMALIZED") == 4);
    const PlainGltf after = mended(made.rig, folder, 4);
    const std::vector<float> found = weights_of(after, 0);
    const std::vector<float> wanted = {0.5f, 0.5f, 0, 0, 0.7f, 0.2f, 0.1f, 0, 0.25f, 0.25f, 0.25f, 0.25f,
                                       0,    0,    0, 1, 1,    0,    0,    0, 1.0f,  1e-7f, 0,     0};
    CHECK(found == wanted);  // those that were right bit by bit
    CHECK(after.buffers[0].substr(0, made.rig.bytes.size()) == made.rig.bytes);
    json whole = after.json;
    CHECK(whole["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] == made.rig.json["accessors"].size());
    whole["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = old;
    for (const auto& [name, size] : {std::pair{"accessors", 1u}, {"bufferViews", 1u}}) {
        CHECK(whole[name].size() == made.rig.json[name].size() + size);
        whole[name].get_ref<json::array_t&>().resize(made.rig.json[name].size());
    }
    CHECK(after.json["bufferViews"].back()["target"] == 34962);
    whole.erase("buffers");
    CHECK(whole == made.rig.json);
}

TEST_CASE("gltf weights: a vertex' sets count together; random ones keep their ratios")
{
    const TempFolder folder;
    constexpr std::size_t count = 3000;
    WeightedRig made(count);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> any(0, 1);
    std::vector<std::vector<float>> sets(2, std::vector<float>(4 * count));
    for (std::size_t vertex = 0; vertex < count; ++vertex) {
        const float size = std::pow(10.0f, 8 * any(random) - 4);
        for (std::size_t n = 0; n < 8; ++n)
            if (n == vertex % 8 || any(random) < 0.6f) sets[n / 4][4 * vertex + n % 4] = size * any(random) + 1e-9f;
    }
    made.add_primitive(sets);
    const PlainGltf after = mended(made.rig, folder, count);
    const std::vector<std::vector<float>> found = {weights_of(after, 0), weights_of(after, 0, "WEIGHTS_1")};
    double worst = 0;
    for (std::size_t vertex = 0; vertex < count; ++vertex) {
        const auto at = [&](const auto& from, std::size_t n) {
            return static_cast<double>(from[n / 4][4 * vertex + n % 4]);
        };
        double sum = 0;
        for (std::size_t n = 0; n < 8; ++n) sum += at(sets, n);
        for (std::size_t n = 0; n < 8; ++n) worst = std::max(worst, std::abs(at(found, n) - at(sets, n) / sum));
    }
    CHECK(worst < 6e-8);
}

TEST_CASE("gltf weights: those are mended that the validator complains of, and no others")
{
    const TempFolder folder;
    constexpr std::size_t count = 2000;
    WeightedRig made(count);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> any(-1, 1);
    std::vector<float> weights(4 * count);
    for (std::size_t n = 0; n < weights.size(); n += 4) {
        const double first = 0.5 + 0.4 * any(random);
        weights[n] = static_cast<float>(first);
        weights[n + 1] = static_cast<float>(1 - first + 1e-6 * any(random));  // 4e-7 is allowed
    }
    made.add_primitive<float>({weights});
    made.rig.write(folder / "bad.glb");
    const std::size_t bad = count_of(gltf_errors(folder / "bad.glb"), "WEIGHTS_NON_NORMALIZED");
    CHECK(bad > count / 4);
    CHECK(bad < count);
    const std::vector<float> found = weights_of(mended(made.rig, folder, bad), 0);
    std::size_t changed = 0;
    for (std::size_t n = 0; n < weights.size(); n += 4)
        changed += found[n] != weights[n] || found[n + 1] != weights[n + 1];
    CHECK(changed <= bad);
}

TEST_CASE("gltf weights: normalised integers and sparse weights")
{
    const TempFolder folder;
    WeightedRig made(2);
    made.add_primitive<std::uint8_t>({{100, 100, 0, 0, 255, 0, 0, 0}});
    made.add_primitive<std::uint16_t>({{30000, 0, 10000, 0, 65535, 0, 0, 0}});
    made.add_primitive<std::uint8_t>({{55, 200, 0, 0, 255, 0, 0, 0}});  // well
    made.add_primitive<float>({{1, 0, 0, 0, 1, 0, 0, 0}});
    // The last one's second vertex is patched, and from then on wrong.
    const int place = made.add_raw(std::string(1, '\1'), kByte, false),
              patch = made.add_weights(std::vector<float>{0.5f, 0, 0, 0});
    auto& accessors = made.rig.json["accessors"];
    const auto view_of = [&](int accessor) { return accessors[static_cast<std::size_t>(accessor)]["bufferView"]; };
    const json sparse = {{"count", 1},
                         {"indices", {{"bufferView", view_of(place)}, {"componentType", kByte}}},
                         {"values", {{"bufferView", view_of(patch)}}}};
    for (const json& view : {view_of(place), view_of(patch)})
        made.rig.json["bufferViews"][view.get<std::size_t>()].erase("target");
    accessors.get_ref<json::array_t&>().resize(accessors.size() - 2);
    const std::size_t last = made.rig.json["meshes"][0]["primitives"][3]["attributes"]["WEIGHTS_0"];
    accessors[last]["sparse"] = sparse;
    const PlainGltf after = mended(made.rig, folder, 3);
    CHECK(weights_of(after, 0) == std::vector<float>{0.5f, 0.5f, 0, 0, 1, 0, 0, 0});
    CHECK(weights_of(after, 1) == std::vector<float>{0.75f, 0, 0.25f, 0, 1, 0, 0, 0});
    CHECK(weights_of(after, 3) == std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0});
    CHECK(after.json["meshes"][0]["primitives"][2] == made.rig.json["meshes"][0]["primitives"][2]);
}

TEST_CASE("gltf weights: primitives that share weights share the new ones")
{
    const TempFolder folder;
    WeightedRig made(1);
    const int half = made.add_weights(std::vector<float>{0.5f, 0, 0, 0}),
              rest = made.add_weights(std::vector<float>{0.5f, 0, 0, 0});
    const std::vector<bool> first = {true, false, false, false};
    made.add_primitive({half}, {first});
    made.add_primitive({half}, {first});
    made.add_primitive({half, rest}, {first, first});  // together they add up
    const PlainGltf after = mended(made.rig, folder, 1);
    const auto weights = [&](std::size_t n) -> json {
        return after.json["meshes"][0]["primitives"][n]["attributes"]["WEIGHTS_0"];
    };
    CHECK(weights(0) == made.rig.json["accessors"].size());
    CHECK(weights(1) == weights(0));
    CHECK(weights(2) == half);
    CHECK(after.json["accessors"].size() == made.rig.json["accessors"].size() + 1);
}

TEST_CASE("gltf weights: what cannot be read or has no sum is left as it is")
{
    const TempFolder folder;
    const auto is_left = [&](const std::function<void(json & primitive, json & accessor)>& spoil) {
        WeightedRig made(1);
        made.add_primitive<float>({{0.5f, 0, 0, 0}, {0.2f, 0, 0, 0}});
        json& primitive = made.rig.json["meshes"][0]["primitives"][0];
        spoil(primitive, made.rig.json["accessors"][primitive["attributes"]["WEIGHTS_0"].get<std::size_t>()]);
        made.rig.write(folder / "rig.glb");
        const GltfFile file = read_gltf(folder / "rig.glb");
        write_gltf(folder / "new.glb", file, {});
        CHECK((mended_vertex_count(file) == 0) == file.weights.empty());
        return plain_gltf_of(folder / "new.glb").json["meshes"] == made.rig.json["meshes"];
    };
    CHECK_FALSE(is_left([](json&, json&) {}));
    CHECK(is_left([](json& primitive, json&) { primitive["extensions"]["KHR_draco_mesh_compression"] = {1}; }));
    CHECK(is_left([](json& primitive, json&) { primitive["attributes"]["WEIGHTS_0"] = 99; }));
    CHECK(is_left([](json& primitive, json&) { primitive["attributes"]["WEIGHTS_1"] = "one"; }));
    CHECK(is_left([](json& primitive, json&) { primitive["attributes"] = {1, 2}; }));
    CHECK(is_left([](json& primitive, json&) { primitive = 5; }));
    CHECK(is_left([](json&, json& accessor) { accessor["type"] = "VEC3"; }));
    CHECK(is_left([](json&, json& accessor) { accessor["count"] = 2; }));
    CHECK(is_left([](json&, json& accessor) { accessor["componentType"] = kByte; }));  // not normalised
    CHECK(is_left([](json&, json& accessor) { accessor["bufferView"] = 99; }));
    for (const float bad : {-0.2f, std::nanf(""), HUGE_VALF}) {
        WeightedRig made(1);
        made.add_primitive<float>({{0.5f, bad, 0, 0}});
        made.rig.write(folder / "rig.glb");
        CHECK(read_gltf(folder / "rig.glb").weights.empty());
    }
}

TEST_CASE("gltf weights: the first GiB of them is looked at, the rest takes no room")
{
    constexpr std::size_t kVertices = 1 << 18;  // 4 MiB a set
    const TempFolder folder;
    WeightedRig made(kVertices);
    std::string whole(4 * kVertices, '\0');
    for (std::size_t n = 0; n < whole.size(); n += 4) whole[n] = '\xff';
    const int well = made.add_raw(whole, kByte, true), zero = well + 1;
    made.rig.json["accessors"].push_back({{"componentType", kFloat}, {"count", kVertices}, {"type", "VEC4"}});
    json& primitives = made.rig.json["meshes"][0]["primitives"];
    const auto add = [&](const std::vector<int>& sets) {
        json attributes;
        for (std::size_t n = 0; n < sets.size(); ++n) attributes["WEIGHTS_" + std::to_string(n)] = sets[n];
        primitives.push_back({{"attributes", attributes}});
    };
    const auto count = [&] {
        made.rig.write(folder / "rig.glb");
        return mended_vertex_count(read_gltf(folder / "rig.glb"));
    };
    add(std::vector<int>(257, zero));
    CHECK(count() == 0);
    const Outcome outcome = spawn_command(folder.path, {"rig", "rig.glb", "--arm", "LeftArm,LeftForeArm,LeftHand"});
    INFO(outcome.err << outcome.peak_kib);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.peak_kib < 400'000);
    add({zero});
    CHECK(count() == kVertices);
    // Sets that are well: 255 and then 256 in all.
    primitives.clear();
    add({zero, well, zero});
    for (std::size_t size = 2; size < 23; ++size) {
        add(std::vector<int>(size, zero));
        primitives.back()["attributes"]["WEIGHTS_0"] = well;
    }
    add({zero});
    CHECK(count() == kVertices);
    primitives.erase(primitives.size() - 1);
    add({well});
    add({zero});
    CHECK(count() == 0);
}

TEST_CASE("gltf weights: a broken mesh is read or refused, never worse")
{
    const TempFolder folder;
    WeightedRig made(3);
    made.add_primitive<float>({{0.5f, 0, 0, 0, 0.2f, 0, 0, 0, 1, 0, 0, 0}, {0.2f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}});
    made.add_primitive<std::uint8_t>({{100, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0}});
    made.rig.write(folder / "good.glb");
    const std::string good = slurp(folder / "good.glb");
    std::mt19937 random(5);
    const std::size_t all = mended_vertex_count(read_gltf(folder / "good.glb"));
    int read = 0, mended = 0, others = 0;
    for (int round = 0; round < 1000; ++round) {
        spill(folder / "bad.glb", mutated(good, random));
        try {
            const GltfFile file = read_gltf(folder / "bad.glb");
            ++read;
            mended += mended_vertex_count(file) > 0;
            others += mended_vertex_count(file) != all;
            write_gltf(folder / "new.glb", file, {});
            CHECK(mended_vertex_count(read_gltf(folder / "new.glb")) == 0);
        } catch (const InputError& error) {
            CHECK(std::string_view(error.what()).find('\n') == std::string_view::npos);
        }
    }
    CHECK(mended > 50);
    CHECK(others > 0);  // the mutations reach the weights
    CHECK(read < 1000);
}

TEST_CASE("gltf weights: solve says what it mended, where it writes the file")
{
    const TempFolder folder;
    WeightedRig made(2);
    made.add_primitive<float>({{0.5f, 0, 0, 0, 0.2f, 0, 0, 0}});
    made.rig.write(folder / "rig.glb");
    const auto said = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"solve", "rig.glb"});
        const Outcome outcome = run_command(folder.path, options);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return outcome.out;
    };
    const char* line = "weights  the skin weights of 2 vertices did not add up to 1, as glTF asks; in the written file";
    CHECK(said({"--out", "new.glb"}).find(line) != std::string::npos);
    CHECK(gltf_errors(folder / "new.glb").empty());
    CHECK(json::parse(said({"--out", "new.glb", "--json"})).at("mended_vertices") == 2);
    CHECK(said({"--out", "new.csv"}).find("weights") == std::string::npos);
    CHECK(said({}).find("weights") == std::string::npos);
}

TEST_CASE("gltf weights: real files come out without errors")
{
    for (const auto& [name, vertices] :
         {std::pair{"RobotExpressive.glb", 752}, {"cesium_man.gltf", 210}, {"m2m_human_ymca.glb", 0}}) {
        const fs::path path = find_data(name);
        if (path.empty()) {
            WARN("skipped: this machine has no " << name);
            continue;
        }
        INFO(name);
        const TempFolder folder;
        const GltfFile file = read_gltf(path);
        CHECK(mended_vertex_count(file) == static_cast<std::size_t>(vertices));
        CHECK(count_of(gltf_errors(path), "WEIGHTS_NON_NORMALIZED") == static_cast<std::size_t>(vertices));
        write_gltf(folder / "new.glb", file, {});
        CHECK(gltf_errors(folder / "new.glb").empty());
    }
}
