#pragma once
// SPDX-License-Identifier: MIT
// A second reading of FBX and DAE files: assimp's scene as its own documentation describes it, with whole matrices in
// double. FBX pivots are nodes of their own, and DAE nodes have their ids. swivel has assimp read them in another way.

#include <assimp/scene.h>
#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tests/test_data.h"

namespace swivel::test {

struct JudgedScene {
    Assimp::Importer importer;
    const aiScene* scene = nullptr;

    explicit JudgedScene(const fs::path& path) : scene(importer.ReadFile(path.string(), 0))
    {
        INFO(path << ": " << importer.GetErrorString());
        REQUIRE(scene);
    }
};

inline Eigen::Vector3d judged(const aiVector3D& v) { return {v.x, v.y, v.z}; }
inline Eigen::Quaterniond judged(const aiQuaternion& q) { return {q.w, q.x, q.y, q.z}; }

inline Eigen::Vector3d judged_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double t)
{
    return a + t * (b - a);
}
inline Eigen::Quaterniond judged_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double t)
{
    return a.slerp(t, b);
}

// The value of keys at a time in ticks: evenly between two of them, the first before all, the last after.
template <class Key>
auto judged_value(const Key* keys, unsigned count, double ticks)
{
    unsigned k = 0;
    while (k + 1 < count && keys[k + 1].mTime <= ticks) ++k;
    const auto value = judged(keys[k].mValue);
    if (k + 1 == count || ticks <= keys[k].mTime) return value;
    const double t = (ticks - keys[k].mTime) / (keys[k + 1].mTime - keys[k].mTime);
    return judged_between(value, judged(keys[k + 1].mValue), t);
}

inline Eigen::Affine3d judged_local(const aiNode& node, const aiAnimation* animation, double seconds)
{
    for (const aiNodeAnim* at :
         std::span(animation ? animation->mChannels : nullptr, animation ? animation->mNumChannels : 0)) {
        if (at->mNodeName != node.mName) continue;
        const double ticks = seconds * animation->mTicksPerSecond;
        return Eigen::Translation3d(judged_value(at->mPositionKeys, at->mNumPositionKeys, ticks)) *
               judged_value(at->mRotationKeys, at->mNumRotationKeys, ticks).normalized() *
               Eigen::Scaling(judged_value(at->mScalingKeys, at->mNumScalingKeys, ticks));
    }
    Eigen::Matrix4d matrix;
    for (unsigned row = 0; row < 4; ++row)
        for (unsigned column = 0; column < 4; ++column)
            matrix(row, column) = static_cast<double>(node.mTransformation[row][column]);
    return Eigen::Affine3d(matrix);
}

// World transforms of all nodes but the inner ones of pivots, parents first, children in the scene's order.
inline void judge_worlds(const aiNode& node, const Eigen::Affine3d& above, const aiAnimation* animation, double seconds,
                         std::vector<Eigen::Affine3d>& worlds)
{
    const Eigen::Affine3d world = above * judged_local(node, animation, seconds);
    if (std::string_view(node.mName.C_Str()).find("_$AssimpFbx$_") == std::string_view::npos) worlds.push_back(world);
    for (const aiNode* child : std::span(node.mChildren, node.mNumChildren))
        judge_worlds(*child, world, animation, seconds, worlds);
}

}  // namespace swivel::test
