// SPDX-License-Identifier: MIT
//
// C++ on top of swivel_explain.h.
#pragma once

#include "swivel.hpp"
#include "swivel_explain.h"

#ifdef SWIVEL_NAMESPACE  // C++20; swivel.hpp refuses older C++
namespace SWIVEL_NAMESPACE {

// swivel_explain(): why a limb is as it is, in words.
inline std::string explain(const Crowd& crowd, std::uint32_t group, std::uint32_t limb)
{
    std::string text(SWIVEL_EXPLANATION_BYTES, '\0');
    check(swivel_explain(crowd.get(), group, limb, text.data(), text.size()));
    return text.c_str();
}

// swivel_compare(): which input of a body's pose disagrees with where the caller has its limb, in words.
struct Comparison {
    bool agrees;
    std::string text;
};
inline Comparison compare(const Crowd& crowd, std::uint32_t group, std::uint32_t body, const swivel_pose& pose,
                          std::span<const double, 3> shoulder, std::span<const double, 3> elbow,
                          std::span<const double, 3> wrist)
{
    std::string text(SWIVEL_EXPLANATION_BYTES, '\0');
    int agrees = 0;
    check(swivel_compare(crowd.get(), group, body, &pose, shoulder.data(), elbow.data(), wrist.data(), text.data(),
                         text.size(), &agrees));
    return {agrees != 0, text.c_str()};
}

}  // namespace SWIVEL_NAMESPACE
#endif
