#pragma once
// SPDX-License-Identifier: MIT
// The nodes of an assimp scene, numbered as the glTF made of it numbers them, in glTF's axes and metres. Owns the
// names by which assimp's animations and bones mean nodes; knows neither keys nor meshes.

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tools/formats/error.h"

struct aiNode;
struct aiScene;

namespace swivel::formats {

struct SceneNodes {
    std::filesystem::path path;          // for messages
    std::vector<const aiNode*> nodes;    // parents before children; the root first
    std::vector<int> parents;            // -1: the root
    std::vector<Eigen::Matrix4d> local;  // against the parent, at rest
    std::multimap<std::string, int> by_name;
};

// Several nodes have a name that something means one of them by.
struct AmbiguousName : InputError {
    using InputError::InputError;
};

// A transform of assimp's, an aiMatrix4x4: its upper three rows, as its last says nothing in an affine scene.
template <class Matrix>
Eigen::Matrix4d matrix_of(const Matrix& from)
{
    Eigen::Matrix4d to = Eigen::Matrix4d::Identity();
    for (unsigned row = 0; row < 3; ++row)
        for (unsigned column = 0; column < 4; ++column) to(row, column) = static_cast<double>(from[row][column]);
    return to;
}

// Every node of the scene. An FBX file's own axes and unit, which assimp leaves to its caller, become the root's
// transform: +Y up and metres, mirrored where the axes are a left hand's. Throws InputError where they are not three.
SceneNodes nodes_of(const aiScene& scene, const std::filesystem::path& path);

// The node of a name; -1: none has it. Throws AmbiguousName where several have it: nothing says which is meant.
// use: what the name is for, "animation 'Walk' moves".
int node_named(const SceneNodes& nodes, const std::string& name, const std::string& use);

// From a node's space to the world's, at rest.
Eigen::Matrix4d world_of(const SceneNodes& nodes, int node);

// A transform in the parts that glTF animates.
struct NodeParts {
    Eigen::Vector3d translation = Eigen::Vector3d::Zero(), scale = Eigen::Vector3d::Ones();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    bool is_whole = true;  // false: a shear, or a scale of nothing along one axis, that the parts cannot say
};
NodeParts parts_of(const Eigen::Matrix4d& transform);

}  // namespace swivel::formats
