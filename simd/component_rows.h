// SPDX-License-Identifier: MIT
//
// Vectors and rotors as blocks hold them: each component is a row, e1 e2 e3 or i j k and the scalar, one row after the
// other. `first` is where a slice's lanes lie in the row of the first component.
#pragma once

#include "core/conformal.h"
#include "simd/fields.h"
#include "simd/lanes.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
SWIVEL_ALWAYS_INLINE Vector<T> load_vector_rows(const float* first, LaneBlocks blocks = {})
{
    return vector(load_lanes<T>(first, blocks), load_lanes<T>(first + kLanes, blocks),
                  load_lanes<T>(first + 2 * kLanes, blocks));
}
template <class T>
SWIVEL_ALWAYS_INLINE Rotor<T> load_rotor_rows(const float* first, LaneBlocks blocks = {})
{
    return rotor(load_lanes<T>(first, blocks), load_lanes<T>(first + kLanes, blocks),
                 load_lanes<T>(first + 2 * kLanes, blocks), load_lanes<T>(first + 3 * kLanes, blocks));
}
// A number or a word, a vector or a rotor. how: what store_lanes() takes besides, that is, which lanes are stored and
// the blocks that they lie in.
template <class Value, class... How>
SWIVEL_ALWAYS_INLINE void store_rows(float* first, const Value& value, const How&... how)
{
    store_lanes(first, value, how...);
}
template <class T, class... How>
SWIVEL_ALWAYS_INLINE void store_rows(float* first, const Vector<T>& v, const How&... how)
{
    store_lanes(first, v.template at<kE1>(), how...);
    store_lanes(first + kLanes, v.template at<kE2>(), how...);
    store_lanes(first + 2 * kLanes, v.template at<kE3>(), how...);
}
template <class T, class... How>
SWIVEL_ALWAYS_INLINE void store_rows(float* first, const Rotor<T>& q, const How&... how)
{
    store_lanes(first, q.template at<kI>(), how...);
    store_lanes(first + kLanes, q.template at<kJ>(), how...);
    store_lanes(first + 2 * kLanes, q.template at<kK>(), how...);
    store_lanes(first + 3 * kLanes, q.template at<kScalar>(), how...);
}

// Rows of a block that lie one after the other, from the lanes of a slice on: those of a strip, a body or a joint.
template <class T>
struct RowView {
    float* first;

    SWIVEL_ALWAYS_INLINE float* at(std::uint32_t row) const { return first + row * kLanes; }
    SWIVEL_ALWAYS_INLINE T get(std::uint32_t row) const { return load_lanes<T>(at(row)); }
    SWIVEL_ALWAYS_INLINE Word<T> word(std::uint32_t row) const { return load_lane_word<T>(at(row)); }
    SWIVEL_ALWAYS_INLINE Vector<T> vector(std::uint32_t row) const { return load_vector_rows<T>(at(row)); }
    SWIVEL_ALWAYS_INLINE Rotor<T> rotor(std::uint32_t row) const { return load_rotor_rows<T>(at(row)); }
    template <class Value>
    SWIVEL_ALWAYS_INLINE void set(std::uint32_t row, const Value& value) const
    {
        store_rows(at(row), value);
    }
};

}  // namespace swivel::inline SWIVEL_ISA
