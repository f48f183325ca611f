#pragma once
// SPDX-License-Identifier: MIT
// Keyframes as glTF 2.0 has them, and their value at any time (specification, appendix C: STEP, LINEAR with the
// shorter arc for rotations, CUBICSPLINE). Before the first key and after the last their value holds.

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace swivel::formats {

enum class Interpolation : std::uint8_t { step, linear, cubic };

struct GltfSampler {
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> time;            // seconds, strictly increasing, at least one
    std::vector<Eigen::Vector4d> value;  // one per key, or with cubic three: in-tangent, value, out-tangent
};

// The sampler's vector at a time: the first three components.
Eigen::Vector3d sample_vector(const GltfSampler& sampler, double time);

// The sampler's rotation, values being x, y, z, w: a unit quaternion; zero where a spline passes through zero.
Eigen::Quaterniond sample_rotation(const GltfSampler& sampler, double time);

// Whether its value is not the same at all times: keys differ, or tangents between them lead away and back.
bool is_moving(const GltfSampler& sampler);

}  // namespace swivel::formats
