// SPDX-License-Identifier: MIT
// Scenes made by hand, with parts that files seldom have, become glTF. They have keys without a rate, before 0, out of
// order or at one time, names that repeat, matrices that cannot be taken apart, and skins of all kinds. Khronos'
// validator and the plain reading judge.
#include <assimp/scene.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "tests/gltf_judges.h"
#include "tests/plain_gltf.h"
#include "tests/test_data.h"
#include "tools/formats/error.h"
#include "tools/formats/gltf.h"
#include "tools/formats/scene_gltf.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using swivel::formats::gltf_of;
using swivel::formats::GltfFile;
using swivel::formats::InputError;

namespace {

template <class Thing>
Thing** list_of(const std::vector<Thing*>& things)
{
    Thing** list = new Thing*[things.size()];
    std::copy(things.begin(), things.end(), list);
    return list;
}

// root > hips > hand, and beside them a mesh's node "skin". The scene owns everything.
struct MadeScene {
    std::unique_ptr<aiScene> scene = std::make_unique<aiScene>();
    aiNode *root = new aiNode("root"), *hips = new aiNode("hips"), *hand = new aiNode("hand"),
           *skin = new aiNode("skin");

    MadeScene()
    {
        scene->mRootNode = root;
        aiNode *under_root[] = {hips, skin}, *under_hips[] = {hand};
        root->addChildren(2, under_root);
        hips->addChildren(1, under_hips);
        hips->mTransformation.b4 = 1;
        hand->mTransformation.a4 = 2;
        skin->mTransformation.c4 = 5;
    }

    aiNodeAnim* animate(aiNode* node, const std::vector<aiVectorKey>& positions, double ticks)
    {
        aiNodeAnim* channel = new aiNodeAnim;
        channel->mNodeName = node->mName;
        channel->mNumPositionKeys = static_cast<unsigned>(positions.size());
        channel->mPositionKeys = new aiVectorKey[positions.size()];
        std::copy(positions.begin(), positions.end(), channel->mPositionKeys);
        aiAnimation* animation = new aiAnimation;
        animation->mName = "move";
        animation->mTicksPerSecond = ticks;
        animation->mNumChannels = 1;
        animation->mChannels = list_of<aiNodeAnim>({channel});
        scene->mNumAnimations = 1;
        scene->mAnimations = list_of<aiAnimation>({animation});
        return channel;
    }

    // A fan of triangles with `bones`: names, and weights as (vertex, weight).
    aiMesh* add_mesh(unsigned vertices, const std::vector<std::pair<aiNode*, std::vector<aiVertexWeight>>>& bones)
    {
        aiMesh* mesh = new aiMesh;
        mesh->mNumVertices = vertices;
        mesh->mVertices = new aiVector3D[vertices];
        for (unsigned n = 0; n < vertices; ++n)
            mesh->mVertices[n] = aiVector3D(static_cast<float>(n), static_cast<float>(n * n), 1);
        mesh->mNumFaces = vertices - 2;
        mesh->mFaces = new aiFace[mesh->mNumFaces];
        for (unsigned n = 0; n < mesh->mNumFaces; ++n) {
            mesh->mFaces[n].mNumIndices = 3;
            mesh->mFaces[n].mIndices = new unsigned[3]{0, n + 1, n + 2};
        }
        std::vector<aiBone*> list;
        for (const auto& [node, weights] : bones) {
            list.push_back(new aiBone);
            list.back()->mName = node->mName;
            list.back()->mNumWeights = static_cast<unsigned>(weights.size());
            list.back()->mWeights = new aiVertexWeight[weights.size()];
            std::copy(weights.begin(), weights.end(), list.back()->mWeights);
        }
        mesh->mNumBones = static_cast<unsigned>(list.size());
        mesh->mBones = list.empty() ? nullptr : list_of(list);
        return mesh;
    }

    void hang(const std::vector<aiMesh*>& meshes)
    {
        scene->mNumMeshes = skin->mNumMeshes = static_cast<unsigned>(meshes.size());
        scene->mMeshes = list_of(meshes);
        skin->mMeshes = new unsigned[meshes.size()];
        for (unsigned n = 0; n < meshes.size(); ++n) skin->mMeshes[n] = n;
        scene->mNumMaterials = 1;
        scene->mMaterials = list_of<aiMaterial>({new aiMaterial});
    }

    GltfFile read() const { return swivel::formats::read_gltf("made.fbx", gltf_of(*scene, "made.fbx"), {}); }

    // The file that becomes of it, which is valid.
    PlainGltf written() const
    {
        const TempFolder folder;
        spill(folder / "made.glb", glb_of(gltf_of(*scene, "made.fbx")));
        for (const std::string& error : gltf_errors(folder / "made.glb")) FAIL_CHECK(error);
        return plain_gltf_of(folder / "made.glb");
    }
};

std::vector<aiVectorKey> keys_at(const std::vector<double>& times)
{
    std::vector<aiVectorKey> keys;
    for (const double time : times) keys.emplace_back(time, aiVector3D(static_cast<float>(keys.size()), 0, 0));
    return keys;
}

// The first numbers of an accessor, as they lie in the buffer.
template <class Number>
std::vector<Number> bytes_of(const PlainGltf& plain, std::size_t accessor, std::size_t count)
{
    const std::size_t view = plain.json.at("accessors").at(accessor).at("bufferView");
    const std::size_t offset = plain.json.at("bufferViews").at(view).at("byteOffset");
    std::vector<Number> numbers(count);
    std::memcpy(numbers.data(), plain.buffers.at(0).data() + offset, count * sizeof(Number));
    return numbers;
}

// Times and x of the keys of a file's only channel.
using Keys = std::vector<std::pair<double, double>>;

Keys keys_of(const GltfFile& file)
{
    Keys keys;
    REQUIRE(file.samplers.size() == 1);
    for (std::size_t n = 0; n < file.samplers[0].time.size(); ++n)
        keys.emplace_back(file.samplers[0].time[n], file.samplers[0].value[n].x());
    return keys;
}

}  // namespace

TEST_CASE("Keys come in seconds from 0, in order, each at a time of its own")
{
    MadeScene made;
    SECTION("no ticks per second")
    {
        made.animate(made.hand, keys_at({0, 25, 50}), 0);
        CHECK(keys_of(made.read()) == Keys{{0, 0}, {1, 1}, {2, 2}});
    }
    SECTION("before 0")
    {
        made.animate(made.hand, keys_at({-30, 0, 30}), 30);
        CHECK(keys_of(made.read()) == Keys{{0, 0}, {1, 1}, {2, 2}});
    }
    SECTION("out of order")
    {
        made.animate(made.hand, keys_at({2, 0, 1}), 1);
        CHECK(keys_of(made.read()) == Keys{{0, 1}, {1, 2}, {2, 0}});
    }
    SECTION("a jump: two at one time")
    {
        made.animate(made.hand, keys_at({0, 1, 1, 2}), 1);
        const auto later = static_cast<double>(std::nextafter(1.0f, 2.0f));
        CHECK(keys_of(made.read()) == Keys{{0, 0}, {1, 1}, {later, 2}, {2, 3}});
    }
    SECTION("a jump late in a film")
    {
        std::vector<double> times;
        for (int tick = 0; tick < 500; ++tick) times.insert(times.end(), tick == 480 ? 2 : 1, tick);
        made.animate(made.hand, keys_at(times), 24);
        const GltfFile file = made.read();
        CHECK(file.clip.frame_count == 500);
        CHECK(file.clip.frame_time == Approx(1 / 24.0));
    }
    made.written();
}

TEST_CASE("Keys that are no numbers, and names that say nothing, are refused")
{
    MadeScene made;
    std::string says;
    SECTION("a time")
    {
        made.animate(made.hand, keys_at({0, std::numeric_limits<double>::quiet_NaN()}), 1);
        says = "a key of animation 'move' for 'hand' is not finite";
    }
    SECTION("a place")
    {
        made.animate(made.hand, keys_at({0, 1}), 1)->mPositionKeys[1].mValue.y = std::numeric_limits<float>::infinity();
        says = "a key of animation 'move' for 'hand' is not finite";
    }
    SECTION("a rotation")
    {
        aiNodeAnim* channel = made.animate(made.hand, {}, 1);
        channel->mNumRotationKeys = 1;
        channel->mRotationKeys = new aiQuatKey[1]{{0, aiQuaternion(0, 0, 0, 0)}};
        says = "a key of animation 'move' for 'hand' is not finite or no rotation";
    }
    SECTION("a name of two")
    {
        made.animate(made.hand, keys_at({0, 1}), 1);
        made.skin->mName = "hand";
        says = "animation 'move' moves 'hand', and 2 nodes are called so";
    }
    SECTION("a bone of two")
    {
        made.hang({made.add_mesh(3, {{made.hand, {{0, 1}}}})});
        made.hips->mName = "hand";
        says = "a bone is called 'hand', and 2 nodes are called so";
    }
    CHECK_THROWS_WITH(gltf_of(*made.scene, "made.fbx"), Contains("made.fbx: ") && Contains(says));
}

TEST_CASE("What moves no node of the file is left out, and what nothing moves may be named twice")
{
    MadeScene made;
    made.animate(made.hand, keys_at({0, 1}), 1)->mNodeName = "camera's target";
    made.skin->mName = made.hand->mName;
    CHECK_FALSE(made.written().json.contains("animations"));
    CHECK(made.read().animation == -1);
}

TEST_CASE("Matrices stay whole: sheared, mirrored, flat")
{
    MadeScene made;
    aiMatrix4x4& matrix = made.hips->mTransformation;
    bool is_sheared = false;
    SECTION("sheared")
    {
        matrix.a2 = 0.5f;
        is_sheared = true;
    }
    SECTION("mirrored") { matrix.a1 = -2; }
    SECTION("nothing left of it") { matrix.a1 = matrix.b2 = matrix.c3 = 0; }
    const PlainGltf plain = made.written();
    const Eigen::Affine3d local = plain_local(plain, -1, plain.node_named("hips"), 0);
    for (unsigned row = 0; row < 3; ++row)
        for (unsigned column = 0; column < 4; ++column)
            CHECK(local(row, column) == Approx(static_cast<double>(matrix[row][column])).margin(1e-7));
    const GltfFile file = made.read();
    CHECK(file.clip.joints[static_cast<std::size_t>(find_joints(file.clip, "hips").at(0))].is_sheared == is_sheared);
}

TEST_CASE("Skins: every vertex follows bones that the file names, or stays")
{
    MadeScene made;
    // Vertex 0: no bone; 1: weights that do not add up; 2: one bone twice; 3: a weight that is no number.
    const float nan = std::numeric_limits<float>::quiet_NaN();
    made.hang({made.add_mesh(4, {{made.hips, {{1, 3}, {2, 0.5f}, {2, 0.5f}, {3, nan}, {77, 1}}}})});
    const PlainGltf plain = made.written();
    const auto& skin = plain.json.at("skins").at(0);
    const std::vector<int> joints = skin.at("joints");
    CHECK(joints == std::vector<int>{plain.node_named("hips"), plain.node_named("hand"), plain.node_named("skin")});
    const auto& attributes = plain.json.at("meshes").at(0).at("primitives").at(0).at("attributes");
    const std::vector<double>& weights = plain_numbers(plain, attributes.at("WEIGHTS_0"));
    const auto follows = bytes_of<std::uint16_t>(plain, attributes.at("JOINTS_0"), 16);
    for (std::size_t vertex = 0; vertex < 4; ++vertex) {
        CHECK(weights[4 * vertex] == 1);
        CHECK(follows[4 * vertex] == (vertex == 1 || vertex == 2 ? 0 : 2));
    }
    // A hand without vertices is a bone all the same.
    const GltfFile file = made.read();
    CHECK(file.clip.joints[static_cast<std::size_t>(find_joints(file.clip, "hand").at(0))].is_bone);
}

TEST_CASE("Skins: the strongest four of a vertex's bones")
{
    MadeScene made;
    std::vector<std::pair<aiNode*, std::vector<aiVertexWeight>>> bones;
    for (int n = 0; n < 6; ++n) {
        aiNode* node = new aiNode("finger" + std::to_string(n));
        made.hand->addChildren(1, &node);
        bones.push_back({node, {{0, 0.1f * static_cast<float>(n + 1)}}});
    }
    made.hang({made.add_mesh(3, bones)});
    const PlainGltf plain = made.written();
    const auto& attributes = plain.json.at("meshes").at(0).at("primitives").at(0).at("attributes");
    const std::vector<double> weights = plain_numbers(plain, attributes.at("WEIGHTS_0"));
    for (std::size_t n = 0; n < 4; ++n) CHECK(weights[n] == Approx((6.0 - static_cast<double>(n)) / 18));
}

TEST_CASE("A node's meshes: rigid ones together, each skinned one with its own skin")
{
    MadeScene made;
    made.hang({made.add_mesh(3, {}), made.add_mesh(4, {{made.hips, {{0, 1}}}}),
               made.add_mesh(5, {{made.hand, {{0, 1}}}}), made.add_mesh(6, {})});
    const PlainGltf plain = made.written();
    CHECK(plain.json.at("skins").size() == 2);
    REQUIRE(plain.json.at("meshes").size() == 3);
    CHECK(plain.nodes().size() == 6);
    const auto& at = plain.nodes()[static_cast<std::size_t>(plain.node_named("skin"))];
    CHECK(at.at("children").size() == 2);
    CHECK(at.contains("skin"));
    CHECK(plain.json.at("meshes").at(2).at("primitives").size() == 2);
}

TEST_CASE("A mesh's own node may be its bone, bound as the file says; a mesh that two nodes carry is kept once")
{
    MadeScene made;
    made.hang({made.add_mesh(3, {{made.skin, {{0, 1}, {1, 1}, {2, 1}}}}), made.add_mesh(3, {})});
    made.scene->mMeshes[0]->mBones[0]->mOffsetMatrix.a4 = 7;
    made.hips->mNumMeshes = 1;
    made.hips->mMeshes = new unsigned[1]{1};
    const PlainGltf plain = made.written();
    const auto& skin = plain.json.at("skins").at(0);
    CHECK(skin.at("joints") == std::vector<int>{plain.node_named("skin")});
    const auto bind = bytes_of<float>(plain, skin.at("inverseBindMatrices"), 16);
    CHECK(bind == std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1});
    const auto& meshes = plain.json.at("meshes");
    REQUIRE(meshes.size() == 3);
    CHECK(meshes.at(0).at("primitives") == meshes.at(2).at("primitives"));
}

TEST_CASE("A material's colour, and its picture beside the file, not from elsewhere")
{
    // One grey pixel.
    const std::string png =
        plain_base64("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==");
    const TempFolder folder;
    fs::create_directories(folder / "model/maps");
    const auto [name, kept_at, is_found] = GENERATE(table<std::string, std::string, bool>({
        {"maps\\skin.png", "model/maps/skin.png", true},
        {"C:\\work\\skin.png", "model/skin.png", true},
        {"../skin.png", "skin.png", false},
        {"skin.png", "model/other.png", false},
    }));
    spill(folder / kept_at, png);
    MadeScene made;
    made.hang({made.add_mesh(3, {})});
    aiMaterial& material = *made.scene->mMaterials[0];
    const aiColor3D colour(0.25f, 7, 0.5f);
    const float opacity = 0.5f;
    const aiString image(name);
    material.AddProperty(&colour, 1, AI_MATKEY_COLOR_DIFFUSE);
    material.AddProperty(&opacity, 1, AI_MATKEY_OPACITY);
    material.AddProperty(&image, AI_MATKEY_TEXTURE_DIFFUSE(0));
    spill(folder / "model/made.glb", glb_of(gltf_of(*made.scene, folder / "model/made.fbx")));
    for (const std::string& error : gltf_errors(folder / "model/made.glb")) FAIL_CHECK(error);
    const PlainGltf plain = plain_gltf_of(folder / "model/made.glb");
    const auto& surface = plain.json.at("materials").at(0).at("pbrMetallicRoughness");
    CHECK(surface.at("baseColorFactor") == std::vector<float>{0.25f, 1, 0.5f, 0.5f});
    CHECK(surface.contains("baseColorTexture") == is_found);
    CHECK(plain.json.contains("images") == is_found);
}
