// SPDX-License-Identifier: MIT
//
// An input or a result of one limb, in the rows of its group.
#pragma once

#include <cmath>
#include <cstdint>

#include "batch/crowd/crowd.h"
#include "core/conformal.h"
#include "simd/rows.h"

namespace swivel {

struct LimbValue {
    float* first;

    LimbValue(const Group& group, std::size_t limb, swivel_field field)
    {
        const bool is_in = is_input(field);
        first = (is_in ? group.input : group.results) +
                row_offset(limb, is_in ? group.input_row_count : group.result_row_count,
                           field_first_row(group.features, field));
    }
    float number(std::uint32_t c) const { return first[c * kLanes]; }
    double operator[](std::uint32_t c) const { return double{number(c)}; }
    void set(std::uint32_t c, double x) const { first[c * kLanes] = static_cast<float>(x); }
    double length(std::uint32_t from, std::uint32_t count) const
    {
        double sum = 0;
        for (std::uint32_t c = from; c < from + count; ++c) sum += (*this)[c] * (*this)[c];
        return std::sqrt(sum);
    }
};

// Stores a vector, or a quaternion, from a component on.
inline void store(const Vector<double>& v, const LimbValue& to, std::uint32_t first = 0)
{
    for (std::uint32_t c = 0; c < 3; ++c) to.set(first + c, v.c[c]);
}
inline void store(const Rotor<double>& q, const LimbValue& to, std::uint32_t first = 0)
{
    store(vector(q.at<kI>(), q.at<kJ>(), q.at<kK>()), to, first);
    to.set(first + 3, q.at<kScalar>());
}

inline std::uint32_t flags_of(const Group& group, std::size_t limb)
{
    return bit_cast<std::uint32_t>(LimbValue(group, limb, SWIVEL_FLAGS).number(0));
}
inline Vector<double> vector_of(const LimbValue& value, std::uint32_t first = 0)
{
    return vector(value[first], value[first + 1], value[first + 2]);
}
// The stored quaternion, of any length.
inline Rotor<double> rotor_of(const LimbValue& value, std::uint32_t first = 0)
{
    return rotor(value[first], value[first + 1], value[first + 2], value[first + 3]);
}

}  // namespace swivel
