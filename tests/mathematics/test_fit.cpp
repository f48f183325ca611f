// SPDX-License-Identifier: MIT
//
// The promise: one shift of a body lets all its limbs reach, where any does, and is the nearest to the wish that does.
// It is eased without overshoot, at any frame rate. A capped limb gets no straighter than its margin allows, and meets
// every target that is no farther than the incoming limb. Shifts are checked by a scan, in double.
#include "core/fit.h"

#include <catch2/catch.hpp>

#include <vector>

#include <rapidcheck/catch.h>

#include "core/group_rules.h"
#include "core/limb_bones.h"
#include "core/spring.h"
#include "tests/formula_arm.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// 200 of a seed make 20,000. RC_PARAMS=max_success=5000 makes a million.
constexpr int kSeedBodies = 200;
constexpr double kStep = 2e-3;  // m: of the scan

struct Leg {
    Vector3d away;  // from its target to its root
    double reach;
};
struct Figure {
    Vector3d up;
    std::vector<Leg> legs;

    // The most that a leg is out of reach from a shift; 0 or less: none is.
    double beyond(double shift) const
    {
        double worst = -1e9;
        for (const Leg& leg : legs) worst = std::max(worst, (leg.away + shift * up).norm() - leg.reach);
        return worst;
    }
    ShiftSpan<double> span() const
    {
        ShiftSpan<double> all{-kAnyShift, kAnyShift, true};
        for (const Leg& leg : legs) all = all & shift_span(mv<double>(leg.away), mv<double>(up), leg.reach);
        return all;
    }
};
// Human-size legs, whose feet are apart in height by up to `apart`.
Figure random_figure(Random& random, double apart)
{
    Figure figure{random.direction(), {}};
    for (std::uint32_t n = 2 + random.below(5); n > 0; --n) {
        const double height = 0.85 + random.between(-0.5, 0.5) * apart;
        const double beside = random.between(0, 0.8);
        figure.legs.push_back({height * figure.up + beside * random.across(figure.up), random.between(0.75, 0.95)});
    }
    return figure;
}
template <class Take>
void scan(const Take& take)
{
    for (double shift = -1.5; shift <= 1.5; shift += kStep) take(shift);
}

Spring<double> exact(const Spring<double>& s, double goal, double time, double half)
{
    const double k = 1.6783469900166605 / half, way = s.at - goal, push = s.rate + k * way, share = std::exp(-k * time);
    return {goal + (way + push * time) * share, (s.rate - k * push * time) * share};
}

}  // namespace

TEST_CASE("the shift lets all limbs reach, and none does that is nearer to the wish")
{
    rc::prop("by a scan of shifts", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedBodies; ++n) {
            const Figure figure = random_figure(random, random.below(2) ? 0.3 : 1.2);
            const double wish = random.below(2) ? 0 : random.between(-0.3, 0.3);
            const FittedShift<double> fitted = fitted_shift(figure.span(), wish, 10.0, 10.0);
            double nearest = 1e9;
            scan([&](double shift) {
                if (figure.beyond(shift) <= 0) nearest = std::min(nearest, std::fabs(shift - wish));
            });
            if (fitted.all_reach) RC_ASSERT(figure.beyond(fitted.shift) <= 1e-12);
            RC_ASSERT(fitted.all_reach || nearest == 1e9);
            if (nearest < 1e9) RC_ASSERT(std::fabs(fitted.shift - wish) <= nearest + 1e-12);
        }
    });
}

TEST_CASE("drop and rise bound the shift, and the flag says whether all reach from there")
{
    rc::prop("in double", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedBodies; ++n) {
            const Figure figure = random_figure(random, 0.6);
            const double drop = random.below(4) ? random.between(0, 0.3) : 0,
                         rise = random.below(4) ? random.between(0, 0.2) : 0;
            const FittedShift<double> fitted = fitted_shift(figure.span(), random.between(-1, 1), drop, rise);
            RC_ASSERT(fitted.shift >= -drop && fitted.shift <= rise);
            const double beyond = figure.beyond(fitted.shift);
            if (std::fabs(beyond) > 1e-12) RC_ASSERT(fitted.all_reach == (beyond < 0));
        }
    });
}

TEST_CASE("where limbs conflict, none is much farther out of reach than it must be")
{
    Random random{1};
    double sum = 0, max = 0;
    int count = 0;
    while (count < 2000) {
        const Figure figure = random_figure(random, 2);
        const ShiftSpan<double> span = figure.span();
        if (span.low <= span.high) continue;
        double min = 1e9;
        scan([&](double shift) { min = std::min(min, figure.beyond(shift)); });
        const double more = figure.beyond(fitted_shift(span, 0.0, 10.0, 10.0).shift) - min;
        sum += more, max = std::max(max, more), ++count;
    }
    INFO("mean " << sum / count << ", most " << max);
    CHECK(sum / count <= 0.030);
    CHECK(max <= 0.219);  // m; of 20,000 figures the most was 0.224
}

TEST_CASE("a limb asks for its share of a shift, and allows more")
{
    rc::prop("one that counts half asks for half", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedBodies; ++n) {
            Figure figure = random_figure(random, 1);
            figure.legs.resize(1);
            const ShiftSpan<double> whole = figure.span();
            const double share = random.unit();
            const ShiftSpan<double> part = counted(whole, share);
            const auto shift = [](const ShiftSpan<double>& limb) { return fitted_shift(limb, 0.0, 10.0, 10.0).shift; };
            RC_ASSERT(std::fabs(shift(part) - share * shift(whole)) <= 1e-12);
            RC_ASSERT(part.low <= whole.low + 1e-12 || whole.low > 0);
            RC_ASSERT(part.high >= whole.high - 1e-12 || whole.high < 0);
            const ShiftSpan<double> all = counted(whole, 1.0), none = counted(whole, 0.0);
            RC_ASSERT(all.low == whole.low && all.high == whole.high && all.reaches == whole.reaches);
            RC_ASSERT(none.low == -kAnyShift && none.high == kAnyShift && none.reaches);
        }
    });
}

TEST_CASE("a shift is eased as a critically damped spring")
{
    for (const double per_second : {30.0, 60.0, 144.0, 600.0}) {
        Random random{3};
        Spring<double> want{0, 0}, eased{0, 0};
        Spring<float> rounded{0, 0};
        double error = 0, float_error = 0, last = 0;
        for (double t = 0; t < 2;) {
            const double time = static_cast<float>(random.between(0.7, 1) / per_second);
            t += time;
            want = exact(want, 1, time, 0.1);
            eased = sprung(eased, 1.0, time, spring_rule(0.1f));
            rounded = sprung(rounded, 1.0f, static_cast<float>(time), spring_rule(0.1f));
            error = std::max(error, std::fabs(eased.at - want.at));
            float_error = std::max(float_error, std::fabs(double{rounded.at} - want.at));
            REQUIRE((eased.at >= last && eased.at <= 1 + 1e-15 && eased.rate >= -1e-15));
            last = eased.at;
        }
        INFO(per_second << " a second: " << error << ", in float " << float_error);
        CHECK(error <= 5e-6);
        CHECK(float_error <= 6e-6);
        CHECK(last == Approx(1).margin(1e-9));
    }
    CHECK(exact({0, 0}, 1, 0.1, 0.1).at == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("no step is so long that the spring overshoots")
{
    for (const float half : {0.0f, 1e-3f, 0.1f, 1000.0f})
        for (const float goal : {1.0f, 2e15f})
            for (double time = 1e-6; time <= 1e15; time *= 1.7) {
                const Spring<float> eased =
                    sprung(Spring<float>{0, 0}, goal, static_cast<float>(time), spring_rule(half));
                INFO("half " << half << ", time " << time);
                REQUIRE((eased.at >= -5e-7f * goal && eased.at <= goal && eased.rate >= 0));
                REQUIRE((time < 100 * std::max(double{half}, kShortestHalf) || eased.at == goal));
            }
}

TEST_CASE("a capped limb meets what is no farther than it was, and gets straighter by its margin at most")
{
    rc::prop("to the last bit", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 1000; ++n) {
            const auto length = static_cast<float>(random.spread(0.1, 10)), near = length * 0.1f;
            const auto incoming = static_cast<float>(random.between(0.1, 1) * length);
            const auto share = [&](double max) {
                return random.below(3) ? static_cast<float>(random.between(0, max)) : 0;
            };
            const Cap<float> cap{share(0.1), share(1), 0, incoming};
            const CappedReach<float> capped = capped_reach(cap, length, length);
            const auto wanted = static_cast<float>(random.between(0.1, 1.3) * length);
            const SoftReach<float> got = soft_reach(wanted, {near, capped.far, 0, capped.zone, 1});
            const float from = std::max(incoming, cap.min * length);
            if (wanted <= incoming && capped.zone <= 0.5f * (capped.far - near)) {
                RC_ASSERT(got.distance == wanted);
                RC_ASSERT(!got.softened && !got.too_far);
            }
            RC_ASSERT(got.distance <= std::min(length, from + cap.margin * length));
            RC_ASSERT(got.distance <= wanted);
            if (wanted > from * 1.00001f && wanted > capped.far) RC_ASSERT(got.softened || got.too_far);
        }
    });
}

TEST_CASE("a zone of a cap eases a straight limb, and bends it by a quarter of the zone at most")
{
    const Cap<double> cap{0.01, 0, 0.08, 0.999};
    const CappedReach<double> capped = capped_reach(cap, 1.0, 1.0);
    CHECK(capped.far == 1.0);
    CHECK(capped.zone == 0.08);
    const double still = soft_reach(0.999, ReachRange<double>{0, capped.far, 0, capped.zone, 1}).distance;
    CHECK(0.999 - still <= 0.02);
    CHECK(0.999 - still >= 0.019);
}
