// SPDX-License-Identifier: MIT
//
// What a run of the command measured: errors as worst and root mean square, flags as counts.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

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

struct Statistics {
    ErrorStat wrist;   // arm lengths, between wrist and target, of limbs that reach it
    ErrorStat missed;  // the same, of limbs out of reach
    ErrorStat hand;    // radians, between hand and wanted orientation
    // Against the motion the targets came from; empty when they came from elsewhere:
    ErrorStat elbow_bent, elbow_straight;                 // arm lengths; bent by more than 5 degrees, and the rest
    ErrorStat upper_arm_swing, upper_arm_twist, forearm;  // radians; of the first character
    std::array<std::uint64_t, 32> flags{};                // limbs with flag bit n
    std::uint64_t arm_count = 0;
    double solve_seconds = 0;

    void add_flags(std::uint32_t word)
    {
        ++arm_count;
        for (std::size_t bit = 0; bit < flags.size(); ++bit) flags[bit] += word >> bit & 1u;
    }
    void add(const Statistics& other)
    {
        wrist.add(other.wrist);
        missed.add(other.missed);
        hand.add(other.hand);
        elbow_bent.add(other.elbow_bent);
        elbow_straight.add(other.elbow_straight);
        upper_arm_swing.add(other.upper_arm_swing);
        upper_arm_twist.add(other.upper_arm_twist);
        forearm.add(other.forearm);
        for (std::size_t bit = 0; bit < flags.size(); ++bit) flags[bit] += other.flags[bit];
        arm_count += other.arm_count;
        solve_seconds += other.solve_seconds;
    }
};

}  // namespace swivel::tools
