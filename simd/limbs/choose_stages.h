// SPDX-License-Identifier: MIT
//
// The stages that choose the swivel: the wish, if the limits allow it; else nearest_end(), and where no end is allowed
// min_violation() (core/choose_swivel.h). A slice takes as long as its slowest lane, and a search takes much longer
// than the test of the wish. So lanes that need a long search are gathered from the whole strip into slices of their
// own, and the swivels that are found go back to their rows.
#pragma once

#include <bit>

#include "core/region.h"
#include "simd/limbs/strip.h"

namespace swivel::inline SWIVEL_ISA {

// The swivel's limits that a group has: lines, then boxes, with the flag of each.
struct LimitList {
    int line_count = 0, box_count = 0;
    std::uint32_t line_flag[kMaxLimitLines] = {}, box_flag[kMaxLimitBoxes] = {};
    swivel_field box_field[kMaxLimitBoxes] = {};

    explicit LimitList(swivel_features features)
    {
        for (const FlagRow& row : kFlags) {
            if (row.limit == SWIVEL_INPUT_END || !(features & row_of(row.limit).needs)) continue;
            if (row_of(row.limit).needs & kLineFeatures) {
                line_flag[line_count++] = row.flag;
            } else {
                box_field[box_count] = row.limit;
                box_flag[box_count++] = row.flag;
            }
        }
    }
};

// Loads limits. line(row) and range(box, row) load a row of the strip, and one of a box's ranges.
template <class T, int Boxes, class Line, class RangeRow>
SWIVEL_INLINE Limits<T, Boxes> load_limits(int line_count, int box_count, const Line& line, const RangeRow& range)
{
    const auto line_at = [&](std::uint32_t row) SWIVEL_INLINE_LAMBDA {
        return OnCircle<T>{line(row), line(row + 1), line(row + 2)};
    };
    Limits<T, Boxes> limits;
    limits.line_count = line_count;
    for (int n = 0; n < line_count; ++n) limits.line[n] = line_at(kLimitRow + 3 * static_cast<std::uint32_t>(n));
    if constexpr (Boxes > 0) {
        limits.box_count = box_count;
        SWIVEL_KEEP_LOOP
        for (int n = 0; n < box_count; ++n) {
            const std::uint32_t row = kBoxRow + 15 * static_cast<std::uint32_t>(n);
            const auto range_at = [&](int first) SWIVEL_INLINE_LAMBDA {
                return Range<T>{{range(n, first), range(n, first + 1)}, {range(n, first + 2), range(n, first + 3)}};
            };
            limits.box[n].curves = {line_at(row), line_at(row + 3), line_at(row + 6), line_at(row + 9),
                                    line_at(row + 12)};
            limits.box[n].ranges = euler_ranges(range_at(0), range_at(4), range_at(8));
        }
    }
    return limits;
}
template <int Boxes, class S>
SWIVEL_INLINE Limits<typename S::T, Boxes> load_limits(const S& s, int line_count, const LimitList& list)
{
    return load_limits<typename S::T, Boxes>(
        line_count, list.box_count, [&](std::uint32_t row) SWIVEL_INLINE_LAMBDA { return s.rows.get(row); },
        [&](int box, int row) SWIVEL_INLINE_LAMBDA { return s.io.load(list.box_field[box], row); });
}

// The same for where an upper arm with a region points.
template <class S>
SWIVEL_INLINE RegionOnCircle<typename S::T> load_region(const S& s)
{
    const auto line_at = [&](std::uint32_t row) SWIVEL_INLINE_LAMBDA {
        return OnCircle<typename S::T>{s.rows.get(row), s.rows.get(row + 1), s.rows.get(row + 2)};
    };
    return {s.strip.run.region, line_at(kRegionRows[0]), line_at(kRegionRows[1]), line_at(kRegionRows[2])};
}

// Lanes of a strip.
struct LaneList {
    std::uint8_t lane[kStripBlocks * kLanes];
    std::uint32_t count = 0;

    SWIVEL_INLINE void add(std::uint32_t first, std::uint32_t lanes)
    {
        for (; lanes != 0; lanes &= lanes - 1)
            lane[count++] = static_cast<std::uint8_t>(first + static_cast<std::uint32_t>(std::countr_zero(lanes)));
    }
};

// The limits of some lanes, a few at a time: rows of lines, of the boxes' curves, and of the boxes' ranges.
template <class T, int Boxes>
struct GatheredLimits {
    static constexpr std::uint32_t lanes = lane_count<T>;
    const Strip& strip;
    const LimitList& list;
    alignas(64) float rows[(3 * kMaxLines + 27 * Boxes) * lanes];

    GatheredLimits(const Strip& in, const LimitList& limits) : strip(in), list(limits) {}

    SWIVEL_INLINE std::uint32_t line_rows() const { return 3 * static_cast<std::uint32_t>(list.line_count); }
    SWIVEL_INLINE std::uint32_t box_rows() const { return 15 * static_cast<std::uint32_t>(list.box_count); }
    SWIVEL_INLINE void gather(std::uint32_t to, std::uint32_t lane)
    {
        float* at = rows + to;
        const auto copy = [&](const float* from, std::uint32_t row_count) SWIVEL_INLINE_LAMBDA {
            for (std::uint32_t row = 0; row < row_count; ++row, at += lanes) *at = from[row * kLanes];
        };
        copy(strip.lane(lane) + kLimitRow * kLanes, line_rows());
        if constexpr (Boxes > 0) {
            copy(strip.lane(lane) + kBoxRow * kLanes, box_rows());
            for (int n = 0; n < list.box_count; ++n)
                copy(strip.input(lane) + std::size_t{strip.run.first_row[index_of(list.box_field[n])]} * kLanes, 12);
        }
    }
    SWIVEL_FLATTEN [[gnu::noinline]] Limits<T, Boxes> load() const  // with boxes it is long
    {
        const auto row_at = [&](std::uint32_t row) SWIVEL_INLINE_LAMBDA { return load_lanes<T>(rows + row * lanes); };
        return load_limits<T, Boxes>(
            list.line_count, list.box_count,
            [&](std::uint32_t row)
                SWIVEL_INLINE_LAMBDA { return row_at(row < kBoxRow ? row - kLimitRow : row - kBoxRow + line_rows()); },
            [&](int box, int row) SWIVEL_INLINE_LAMBDA {
                return row_at(line_rows() + box_rows() + static_cast<std::uint32_t>(12 * box + row));
            });
    }
};

// The same with a region: nine rows more.
template <class T, int Boxes>
struct GatheredInRegion {
    static constexpr std::uint32_t lanes = lane_count<T>;
    GatheredLimits<T, Boxes> limits;
    alignas(64) float rows[9 * lanes];

    GatheredInRegion(const Strip& in, const LimitList& list) : limits(in, list) {}

    SWIVEL_INLINE void gather(std::uint32_t to, std::uint32_t lane)
    {
        limits.gather(to, lane);
        float* at = rows + to;
        for (const std::uint32_t first : kRegionRows)
            for (std::uint32_t row = first; row < first + 3; ++row, at += lanes)
                *at = limits.strip.lane(lane)[row * kLanes];
    }
    SWIVEL_INLINE LimitsInRegion<T, Boxes> load() const
    {
        const auto line_at = [&](std::uint32_t first) SWIVEL_INLINE_LAMBDA {
            const auto row_at = [&](std::uint32_t row)
                                    SWIVEL_INLINE_LAMBDA { return load_lanes<T>(rows + row * lanes); };
            return OnCircle<T>{row_at(first), row_at(first + 1), row_at(first + 2)};
        };
        return {limits.load(), {limits.strip.run.region, line_at(0), line_at(3), line_at(6)}};
    }
};
template <class T, int Boxes, bool InRegion>
using Gathered = std::conditional_t<InRegion, GatheredInRegion<T, Boxes>, GatheredLimits<T, Boxes>>;

// Searches for some lanes, and writes their swivels. Lanes without an allowed one go to `left`, if there is such a
// list; else they are infeasible.
template <class T, int Boxes, bool InRegion, class Find>
SWIVEL_INLINE void search(const Strip& strip, const LimitList& list, const LaneList& searched, LaneList* left,
                          const Find& find)
{
    constexpr std::uint32_t lanes = lane_count<T>;
    Gathered<T, Boxes, InRegion> gathered(strip, list);
    for (std::uint32_t first = 0; first < searched.count; first += lanes) {
        const std::uint32_t count = searched.count - first < lanes ? searched.count - first : lanes;
        for (std::uint32_t n = 0; n < lanes; ++n) gathered.gather(n, searched.lane[first + (n < count ? n : 0)]);
        const FoundSwivel<T> found = find(gathered.load());
        alignas(64) float cos[lanes], sin[lanes];
        store_lanes(cos, found.swivel.cos);
        store_lanes(sin, found.swivel.sin);
        const std::uint32_t allowed = lane_bits(found.allowed);
        for (std::uint32_t n = 0; n < count; ++n) {
            const std::uint32_t lane = searched.lane[first + n];
            float* const rows = strip.lane(lane);
            rows[kSwivelRow * kLanes] = cos[n];
            rows[(kSwivelRow + 1) * kLanes] = sin[n];
            if (allowed >> n & 1) continue;
            if (left) {
                left->add(lane, 1);
            } else {
                float& flags = rows[kFlagsRow * kLanes];
                flags = bit_cast<float>(bit_cast<std::uint32_t>(flags) | std::uint32_t{SWIVEL_INFEASIBLE});
            }
        }
    }
}
template <class T, int Boxes, bool InRegion>
SWIVEL_FLATTEN [[gnu::noinline]] void search_end(const Strip& strip, const LimitList& list, const LaneList& searched,
                                                 LaneList& left)
{
    search<T, Boxes, InRegion>(strip, list, searched, &left,
                               [](const auto& limits) SWIVEL_INLINE_LAMBDA { return nearest_end(limits); });
}
// This search is rare, so limbs without boxes share the code of those with boxes.
template <class T, bool InRegion>
SWIVEL_FLATTEN [[gnu::noinline]] void search_min(const Strip& strip, const LimitList& list, const LaneList& searched)
{
    search<T, kMaxBoxes, InRegion>(strip, list, searched, nullptr,
                                   [](const auto& limits) SWIVEL_INLINE_LAMBDA { return min_violation(limits); });
}

// Lines: how many limits are lines; 0: as many as the group has. The nearest end of an allowed arc of lines is found
// where the lanes lie. That takes about as long as gathering them.
template <class T, int Lines, int Boxes, bool InRegion = false>
SWIVEL_FLATTEN [[gnu::noinline]] void choose(Strip& strip)
{
    constexpr bool is_long = Boxes > 0 || InRegion;  // the search for an end
    const LimitList list(strip.run.features);
    LaneList for_end, for_min;
    for_each_slice<T, 0, 0>(strip, [&](const auto& s) SWIVEL_INLINE_LAMBDA {
        const int line_count = Lines > 0 ? Lines : list.line_count;
        const Limits<T, Boxes> limits = load_limits<Boxes>(s, line_count, list);
        const Turned<T> wish{T(1), T(0)};
        Word<T> flags = s.rows.word(kFlagsRow);
        T min_room = T(kMaxRoom);
        const auto test_limit = [&](const T& room_left, std::uint32_t flag) SWIVEL_INLINE_LAMBDA {
            flags = flags | word_where(room_left < T(kNoRoom), flag);
            min_room = lo(room_left, min_room);
        };
        for (int n = 0; n < line_count; ++n) test_limit(limits.line[n].at(wish), list.line_flag[n]);
        for (int n = 0; n < limits.box_count; ++n) test_limit(room(limits.box[n], wish), list.box_flag[n]);
        if constexpr (InRegion) test_limit(room(load_region(s), wish), SWIVEL_LIMITED_REGION);
        const Mask<T> granted = min_room >= T(kNoRoom);
        const std::uint32_t forbidden = s.good() & lane_bits(!granted);
        const std::uint32_t first = s.block * kLanes + s.lane;
        Turned<T> swivel = wish;
        if (forbidden != 0) {
            if constexpr (is_long) {
                for_end.add(first, forbidden);
            } else {
                const FoundSwivel<T> end = nearest_end(limits);
                swivel = select(granted, wish, end.swivel);
                for_min.add(first, forbidden & lane_bits(!end.allowed));
            }
        }
        s.rows.set(kSwivelRow, swivel.cos);
        s.rows.set(kSwivelRow + 1, swivel.sin);
        s.rows.set(kFlagsRow, flags);
    });
    if constexpr (is_long)
        if (for_end.count > 0) search_end<T, Boxes, InRegion>(strip, list, for_end, for_min);
    if (for_min.count > 0) search_min<T, InRegion>(strip, list, for_min);
}

}  // namespace swivel::inline SWIVEL_ISA
