// SPDX-License-Identifier: MIT
#include "tools/formats/scene_nodes.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "tools/formats/error.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

std::optional<double> number_of(const aiMetadata& metadata, const char* key)
{
    double real = 0;
    float single = 0;
    std::int32_t whole = 0;
    if (metadata.Get(key, real)) return real;
    if (metadata.Get(key, single)) return static_cast<double>(single);
    if (metadata.Get(key, whole)) return static_cast<double>(whole);
    return {};
}

// Fills a row of the turn from a file's axes to glTF's: the file's axis of this use, with its sign.
bool set_axis(const aiMetadata& metadata, const std::string& use, Matrix3d& turn, Eigen::Index row)
{
    const auto axis = number_of(metadata, (use + "Axis").c_str()),
               sign = number_of(metadata, (use + "AxisSign").c_str());
    if (!axis || !sign || !(*axis == 0 || *axis == 1 || *axis == 2) || std::abs(*sign) != 1) return false;
    turn(row, static_cast<Eigen::Index>(*axis)) = *sign;
    return true;
}

// From an FBX file's axes and unit (a number of centimetres) to glTF's: a mirror, too, where the file's axes are a left
// hand's. Identity where the file does not say.
Matrix4d to_gltf(const aiScene& scene, const std::filesystem::path& path)
{
    Matrix4d change = Matrix4d::Identity();
    if (!scene.mMetaData) return change;
    Matrix3d turn = Matrix3d::Zero();
    const bool says_axes = set_axis(*scene.mMetaData, "Coord", turn, 0) && set_axis(*scene.mMetaData, "Up", turn, 1) &&
                           set_axis(*scene.mMetaData, "Front", turn, 2);
    if (says_axes && turn.determinant() == 0)
        throw InputError(path, "its UpAxis, FrontAxis and CoordAxis are not three; export the file again, or as glTF");
    if (says_axes) change.topLeftCorner<3, 3>() = turn;
    const auto unit = number_of(*scene.mMetaData, "UnitScaleFactor");
    if (unit && *unit > 0 && std::isfinite(*unit)) change.topLeftCorner<3, 3>() *= *unit / 100;
    return change;
}

}  // namespace

SceneNodes nodes_of(const aiScene& scene, const std::filesystem::path& path)
{
    SceneNodes found;
    found.path = path;
    std::vector<std::pair<const aiNode*, int>> open{{scene.mRootNode, -1}};
    while (!open.empty()) {  // no recursion: files decide how deep it goes
        const auto [node, parent] = open.back();
        open.pop_back();
        const int number = static_cast<int>(found.nodes.size());
        found.nodes.push_back(node);
        found.parents.push_back(parent);
        found.local.push_back(matrix_of(node->mTransformation));
        found.by_name.emplace(node->mName.C_Str(), number);
        for (unsigned n = node->mNumChildren; n-- > 0;) open.emplace_back(node->mChildren[n], number);
    }
    // A root that turns or scales is assimp's own answer to the file's axes.
    if (found.local[0].isIdentity(0)) found.local[0] = to_gltf(scene, path);
    return found;
}

int node_named(const SceneNodes& nodes, const std::string& name, const std::string& use)
{
    const auto count = nodes.by_name.count(name);
    if (count > 1)
        throw AmbiguousName(nodes.path, fmt::format("{} '{}', and {} nodes are called so; give each its own name", use,
                                                    printable(name), count));
    return count == 0 ? -1 : nodes.by_name.find(name)->second;
}

Matrix4d world_of(const SceneNodes& nodes, int node)
{
    Matrix4d world = Matrix4d::Identity();
    for (; node >= 0; node = nodes.parents[static_cast<std::size_t>(node)])
        world = nodes.local[static_cast<std::size_t>(node)] * world;
    return world;
}

NodeParts parts_of(const Matrix4d& transform)
{
    NodeParts parts;
    Matrix3d linear = transform.topLeftCorner<3, 3>();
    parts.translation = transform.topRightCorner<3, 1>();
    parts.scale = linear.colwise().norm();
    if (parts.scale.isZero(0)) return parts;
    parts.is_whole = parts.scale.minCoeff() > 0;
    if (!parts.is_whole) return parts;
    if (linear.determinant() < 0) parts.scale = -parts.scale;
    linear = linear * parts.scale.cwiseInverse().asDiagonal();
    // 1e-5: far above the noise of assimp's floats, and what the reader calls a shear.
    parts.is_whole = (linear.transpose() * linear).isIdentity(1e-5);
    parts.rotation = Eigen::Quaterniond(linear).normalized();
    return parts;
}

}  // namespace swivel::formats
