// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_sampler.h"

#include <algorithm>

namespace swivel::formats {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector4d;

// Two neighbouring keys and how far between them a time is, 0 to 1; twice the same key at and beyond the ends.
struct Span {
    std::size_t from, to;
    double share, seconds;
};

Span span_at(const GltfSampler& sampler, double time)
{
    const std::vector<double>& times = sampler.time;
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return {0, 0, 0, 0};
    const auto from = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end()) return {from, from, 0, 0};
    const double seconds = times[from + 1] - times[from];
    return {from, from + 1, (time - times[from]) / seconds, seconds};
}

const Vector4d& key(const GltfSampler& sampler, std::size_t n)
{
    return sampler.value[sampler.interpolation == Interpolation::cubic ? 3 * n + 1 : n];
}

Vector4d spline(const GltfSampler& sampler, const Span& at)
{
    const double t = at.share, t2 = t * t, t3 = t2 * t;
    const Vector4d &out_tangent = sampler.value[3 * at.from + 2], &in_tangent = sampler.value[3 * at.to];
    return (2 * t3 - 3 * t2 + 1) * key(sampler, at.from) + at.seconds * (t3 - 2 * t2 + t) * out_tangent +
           (3 * t2 - 2 * t3) * key(sampler, at.to) + at.seconds * (t3 - t2) * in_tangent;
}

}  // namespace

Eigen::Vector3d sample_vector(const GltfSampler& sampler, double time)
{
    const Span at = span_at(sampler, time);
    const Vector4d &from = key(sampler, at.from), &to = key(sampler, at.to);
    if (at.share == 0 || sampler.interpolation == Interpolation::step) return from.head<3>();
    if (sampler.interpolation == Interpolation::cubic) return spline(sampler, at).head<3>();
    return ((1 - at.share) * from + at.share * to).head<3>();
}

Eigen::Quaterniond sample_rotation(const GltfSampler& sampler, double time)
{
    const Span at = span_at(sampler, time);
    const Quaterniond from = Quaterniond(key(sampler, at.from)).normalized();
    if (at.share == 0 || sampler.interpolation == Interpolation::step) return from;
    if (sampler.interpolation == Interpolation::cubic) return Quaterniond(spline(sampler, at)).normalized();
    return from.slerp(at.share, Quaterniond(key(sampler, at.to)).normalized()).normalized();
}

bool is_moving(const GltfSampler& sampler)
{
    const bool is_cubic = sampler.interpolation == Interpolation::cubic;
    for (std::size_t n = 1; n < sampler.time.size(); ++n) {
        if (key(sampler, n) != key(sampler, 0)) return true;
        if (is_cubic && !(sampler.value[3 * n - 1].isZero(0) && sampler.value[3 * n].isZero(0))) return true;
    }
    return false;
}

}  // namespace swivel::formats
