// SPDX-License-Identifier: MIT
//
// The measurements of a run: distances as worst and root mean square, flags as counts, and the poses of the worst and
// the first of each. Ties go to the earlier pose, so that threads in any order give the same.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>

#include "swivel/swivel.h"
#include "tools/formats/limb_name.h"

namespace swivel::tools {

// One limb in one frame, named as in a row of poses.csv.
struct PoseName {
    std::uint64_t frame = 0;
    std::uint32_t character = 0;
    formats::LimbName limb;

    friend auto operator<=>(const PoseName&, const PoseName&) = default;
};
constexpr PoseName kNoPose{std::numeric_limits<std::uint64_t>::max(), 0, {}};  // after all others

// A NaN is as bad as infinity.
inline double rank_of(double error) { return std::isnan(error) ? std::numeric_limits<double>::infinity() : error; }

// Errors in limb lengths, each beside its limb's length, or in radians, beside 1.
struct ErrorStat {
    double max = 0, sum2 = 0;
    double length_of_max = 1, length_sum2 = 0;  // of that limb; of errors in the unit of lengths
    std::uint64_t count = 0;
    PoseName worst_pose = kNoPose;

    void add(double error, const PoseName& pose, double length = 1)
    {
        keep_worst(error, pose, length);
        sum2 += error * error;
        length_sum2 += error * error * length * length;
        ++count;
    }
    void add(const ErrorStat& other)
    {
        keep_worst(other.max, other.worst_pose, other.length_of_max);
        sum2 += other.sum2;
        length_sum2 += other.length_sum2;
        count += other.count;
    }
    void keep_worst(double error, const PoseName& pose, double length)
    {
        if (rank_of(error) < rank_of(max) || (rank_of(error) == rank_of(max) && worst_pose <= pose)) return;
        max = error;
        length_of_max = length;
        worst_pose = pose;
    }
    double rms() const { return root_of_mean(sum2); }
    // The same in the unit of lengths.
    double max_length() const { return max * length_of_max; }
    double rms_length() const { return root_of_mean(length_sum2); }

private:
    double root_of_mean(double sum) const { return count ? std::sqrt(sum / static_cast<double>(count)) : 0; }
};

struct FlagStat {
    std::uint64_t count = 0;
    PoseName first_pose = kNoPose;

    void add(const FlagStat& other)
    {
        count += other.count;
        first_pose = std::min(first_pose, other.first_pose);
    }
};

// Limbs that miss their target by more, in limb lengths, are out of reach. A straight limb at the very end of its reach
// may be clamped by rounding, and then misses by about 1e-7. A miss of 1e-4 is a tenth of a millimetre of a metre.
constexpr double kLostDistance = 1e-4;

// The statistics of one kind of limbs.
struct LimbStatistics {
    ErrorStat reached;      // limb lengths, between wrist, ankle or effector and target, of limbs that reach it
    ErrorStat missed;       // the same, of the others
    ErrorStat aimed;        // the same, between the hand's ray and the target, of limbs that aim and hit it
    ErrorStat aim_missed;   // the same, of limbs that aim and do not
    ErrorStat orientation;  // radians, between hand or foot and its wanted orientation
    // Differences from the clip, of elbow or knee in limb lengths:
    ErrorStat given;  // of limbs that were given another goal, pole or aim than the clip's; all others follow it
    ErrorStat bent, straight;                   // of those that follow it; bent by more than 5 degrees, and the rest
    ErrorStat upper_swing, upper_twist, lower;  // radians; of the first character
    std::array<FlagStat, 32> flags{};           // [bit]
    std::uint64_t limb_count = 0;
    std::uint64_t unreached = 0, bad = 0;  // of them: out of reach, with bad input
    bool has_effector = false;             // a point of hand or foot goes to the target

    // distance: in limb lengths, from the wrist, effector or ray to the target.
    void add_flags(std::uint32_t word, double distance, const PoseName& pose)
    {
        ++limb_count;
        const bool is_bad = (word & SWIVEL_BAD_INPUT) != 0;
        const bool is_clamped = (word & (SWIVEL_CLAMPED_FAR | SWIVEL_CLAMPED_NEAR)) != 0;
        bad += is_bad;
        unreached += !is_bad && is_clamped && distance > kLostDistance;
        for (std::size_t bit = 0; bit < flags.size(); ++bit)
            if (word >> bit & 1u) flags[bit].add({1, pose});
    }
    void add(const LimbStatistics& other)
    {
        using S = LimbStatistics;
        for (const auto error : {&S::reached, &S::missed, &S::aimed, &S::aim_missed, &S::orientation, &S::given,
                                 &S::bent, &S::straight, &S::upper_swing, &S::upper_twist, &S::lower})
            (this->*error).add(other.*error);
        for (std::size_t bit = 0; bit < flags.size(); ++bit) flags[bit].add(other.flags[bit]);
        limb_count += other.limb_count;
        unreached += other.unreached;
        bad += other.bad;
        has_effector = has_effector || other.has_effector;
    }
};

// The statistics of looking heads. Each meets its target, has it behind or too near, can turn no further, or is on its
// way.
struct LookStatistics {
    std::uint64_t count = 0, met = 0, faded = 0, limited = 0;

    void add_flags(std::uint32_t word)
    {
        const bool is_met = (word & SWIVEL_REACHED) != 0, is_faded = (word & SWIVEL_FADED) != 0;
        ++count;
        met += is_met;
        faded += is_faded && !is_met;
        limited += (word & SWIVEL_LIMITED_LOOK) != 0 && !is_met && !is_faded;
    }
    void add(const LookStatistics& other)
    {
        count += other.count, met += other.met, limited += other.limited, faded += other.faded;
    }
    std::uint64_t on_their_way() const { return count - met - faded - limited; }
};

struct Statistics {
    LimbStatistics arms, legs;
    LookStatistics looks;
    double solve_seconds = 0;

    void add(const Statistics& other)
    {
        arms.add(other.arms);
        legs.add(other.legs);
        looks.add(other.looks);
        solve_seconds += other.solve_seconds;
    }
    LimbStatistics& of(formats::LimbKind kind) { return kind == formats::LimbKind::arm ? arms : legs; }

    std::uint64_t limb_count() const { return arms.limb_count + legs.limb_count; }
    std::uint64_t unreached() const { return arms.unreached + legs.unreached; }
    std::uint64_t bad() const { return arms.bad + legs.bad; }
    std::uint64_t flagged(std::size_t bit) const { return arms.flags[bit].count + legs.flags[bit].count; }
};

// Whether most limbs are out of reach or have bad input, which its user hardly intended.
inline bool went_wrong(const Statistics& statistics)
{
    return 2 * (statistics.unreached() + statistics.bad()) > statistics.limb_count();
}

}  // namespace swivel::tools
