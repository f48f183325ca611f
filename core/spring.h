// SPDX-License-Identifier: MIT
//
// A critically damped spring, which eases a height or a direction over time without exp().
#pragma once

#include "core/arm.h"
#include "core/group_rules.h"

namespace swivel::inline SWIVEL_ISA {

// Value: T, or a vector of it.
template <class Value>
struct Spring {
    Value at, rate;
};
// exp(-x) for x from 0 to kSettled: (1 + y + y^2/2 + y^3/6 + y^4/24)^-4 with y = x/4.
template <class T>
SWIVEL_INLINE constexpr T falling(const T& x)
{
    const T y = T(0.25) * x;
    const T e = T(1) / (T(1) + y * (T(1) + y * (T(0.5) + y * (T(1.0 / 6) + y * T(1.0 / 24)))));
    return (e * e) * (e * e);
}
template <class Value, class T>
SWIVEL_INLINE constexpr Spring<Value> sprung(const Spring<Value>& s, const Value& goal, const T& time,
                                             const SpringRule& rule)
{
    const T stiffness = T(rule.stiffness), t = lo(time, T(rule.longest)), share = falling(stiffness * t);
    const Value way = s.at - goal, push = s.rate + stiffness * way;
    return {goal + share * (way + t * push), share * (s.rate - t * (stiffness * push))};
}

}  // namespace swivel::inline SWIVEL_ISA
