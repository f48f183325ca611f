// SPDX-License-Identifier: MIT
//
// What a run of the command measured: errors as worst and root mean square, flags as counts.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "tools/formats/limb_name.h"

namespace swivel::tools {

struct ErrorStat {
    double max = 0, sum2 = 0;
    std::uint64_t count = 0;

    void add(double error)
    {
        keep_worst(error);
        sum2 += error * error;
        ++count;
    }
    void add(const ErrorStat& other)
    {
        keep_worst(other.max);
        sum2 += other.sum2;
        count += other.count;
    }
    void keep_worst(double error)
    {
        if (!std::isnan(max) && !(error <= max)) max = error;  // a NaN is the worst of all
    }
    double rms() const { return count ? std::sqrt(sum2 / static_cast<double>(count)) : 0; }
};

// Of the limbs of one kind.
struct LimbStatistics {
    ErrorStat reached;      // limb lengths, between wrist or ankle and target, of limbs that reach it
    ErrorStat missed;       // the same, of limbs out of reach
    ErrorStat aimed;        // the same, between the hand's ray and the target, of limbs that aim
    ErrorStat orientation;  // radians, between hand or foot and its wanted orientation
    // Against the motion the targets came from; empty when they came from elsewhere:
    ErrorStat bent, straight;  // limb lengths, of elbow or knee; bent by more than 5 degrees, and the rest
    ErrorStat upper_swing, upper_twist, lower;  // radians; of the first character
    std::uint64_t turned_over = 0;              // poses of the first character with an upper_twist above pi / 2
    std::array<std::uint64_t, 32> flags{};      // limbs with flag bit n
    std::uint64_t limb_count = 0;

    void add_flags(std::uint32_t word)
    {
        ++limb_count;
        for (std::size_t bit = 0; bit < flags.size(); ++bit) flags[bit] += word >> bit & 1u;
    }
    void add(const LimbStatistics& other)
    {
        reached.add(other.reached);
        missed.add(other.missed);
        aimed.add(other.aimed);
        orientation.add(other.orientation);
        bent.add(other.bent);
        straight.add(other.straight);
        upper_swing.add(other.upper_swing);
        upper_twist.add(other.upper_twist);
        lower.add(other.lower);
        turned_over += other.turned_over;
        for (std::size_t bit = 0; bit < flags.size(); ++bit) flags[bit] += other.flags[bit];
        limb_count += other.limb_count;
    }
};

struct Statistics {
    LimbStatistics arms, legs;
    double solve_seconds = 0;

    LimbStatistics& of(formats::LimbKind kind) { return kind == formats::LimbKind::arm ? arms : legs; }
};

}  // namespace swivel::tools
