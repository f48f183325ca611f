// SPDX-License-Identifier: MIT
//
// Explains what joint limits and the step did to an elbow, in degrees.
#include "batch/explain/explain.h"

#include <cmath>

#include "batch/explain/explain_probe.h"

namespace swivel {

namespace {

const char* limit_name(const FlagRow& row) { return row.flag == SWIVEL_LIMITED_REGION ? "region" : name_of(row.limit); }

// Whether this limit alone leaves the elbow no place.
bool forbids_all(Probe& probe, const FlagRow& limit)
{
    probe.take();
    for_each_limit([&](const FlagRow& other) {
        if (other.flag != limit.flag) probe.give_up(other);
    });
    return probe.solve() & SWIVEL_INFEASIBLE;
}

// Where the middle angle of a box is a right angle, the other two turn about one axis. So near it they change 1 / sin
// 15 = 3.9 times as fast as the arm, and faster.
constexpr double kNearPole = 15;
void explain_pole(Probe& probe, Text& text)
{
    probe.take();
    if (!probe.has(SWIVEL_STEP_WINS)) probe.solve();  // which else would go one step further
    const double degrees = 90 - in_degrees(std::fabs(probe.middle_angle()));
    if (degrees > kNearPole) return;
    text.add(
        " It is %.0f degrees from the pole of shoulder_box, near which the allowed place may jump: another "
        "shoulder_order has its pole elsewhere.",
        degrees);
}

// The elbow's turn from one pose to another about the unit axis that it swivels about, in degrees.
double swivel_between(const LimbPose& a, const LimbPose& b, const Vector<double>& axis)
{
    const Vector<double> n = cross(axis, a.elbow - a.shoulder), m = cross(axis, b.elbow - b.shoulder);
    return in_degrees(std::atan2(std::sqrt(len2(cross(n, m))), scalar_product(n, m)));
}

// For a pose whose limits no place keeps, but which is outside of them by less than can be read.
constexpr char kAtEdge[] = " Its pose violates them by less than 0.01 degrees: it is at the edge of what they allow.";

// How far the probe's pose is outside of each limit. if_none: said where no angle is large enough to be read.
void explain_violations(const Probe& probe, Text& text, const char* if_none)
{
    bool is_first = true;
    for_each_limit([&](const FlagRow& row) {
        const double degrees = probe.violation(row);
        if (degrees < 0.005) return;  // it would read 0.00
        text.add(" %s %s by %.2f degrees", is_first ? "Its pose violates" : "and", limit_name(row), degrees);
        is_first = false;
    });
    text.add("%s", is_first ? if_none : ".");
}

// The limits that the flags name, and of those the ones that alone leave the elbow no place.
struct Broken {
    char room[2][200];
    Text all{room[0]}, alone{room[1]};

    Broken(Probe& probe, std::uint32_t flags)
    {
        for_each_limit([&](const FlagRow& row) {
            if (!(flags & row.flag)) return;
            all.add("%s%s", all.is_empty() ? "" : " and ", limit_name(row));
            if (flags & SWIVEL_INFEASIBLE && forbids_all(probe, row))
                alone.add("%s%s", alone.is_empty() ? "" : " and ", limit_name(row));
        });
    }
    // No place keeps these.
    Broken(const Broken&) = delete;  // texts point into it
    const char* impossible() const { return alone.is_empty() ? room[0] : room[1]; }
};

// Says where an elbow is going that needs several steps, and the limits it violates meanwhile.
void explain_way(Probe& probe, std::uint32_t flags, const Broken& broken, Text& text)
{
    if (broken.all.is_empty())
        text.add(" The elbow is on its way to where it is wished.");
    else if (flags & SWIVEL_INFEASIBLE)
        text.add(" No place of the elbow keeps %s%s: it is on its way to the one that violates them least.",
                 broken.alone.is_empty() ? "all limits at once, as the wish breaks " : "", broken.impossible());
    else
        text.add(
            " Where the elbow was wished it breaks %s: it is on its way to the nearest place that keeps all limits.",
            broken.room[0]);
    probe.take();
    explain_violations(probe, text,
                       broken.all.is_empty()       ? ""
                       : flags & SWIVEL_INFEASIBLE ? kAtEdge
                                                   : " Its pose violates none of them by 0.01 degrees.");
    text.add(" The next solve goes one step further.");
}

// The elbow is where its limits let it.
void explain_place(Probe& probe, std::uint32_t flags, const Broken& broken, Text& text)
{
    const bool step_wins = probe.has(SWIVEL_STEP_WINS);
    const bool is_step = flags & SWIVEL_LIMITED_STEP;  // limits then forbid the place where the step ends
    probe.take();
    // Where the step wins, another solve would go one step further.
    if (!step_wins) probe.solve();
    if (flags & SWIVEL_INFEASIBLE) {
        text.add(" No place of the elbow keeps %s%s: the one that violates them least is taken.",
                 !broken.alone.is_empty() ? ""
                 : is_step                ? "all limits at once, as the step's end breaks "
                                          : "all limits at once, as the wish breaks ",
                 broken.impossible());
        return explain_violations(probe, text, kAtEdge);
    }
    const LimbPose solved = probe.pose();
    probe.take();
    probe.give_up_limits();
    probe.solve();
    text.add(" Where %s it breaks %s: the nearest place that keeps all limits is %.1f degrees away.",
             is_step ? "the step takes the elbow," : "the elbow was wished", broken.room[0],
             swivel_between(solved, probe.pose(), probe.swivel_axis()));
}

}  // namespace

void explain_limits(Probe& probe, std::uint32_t flags_were, std::uint32_t flags, Text& text)
{
    const bool step_wins = probe.has(SWIVEL_STEP_WINS);
    const std::uint32_t its = step_wins && flags_were != 0 ? flags_were : flags;
    const Broken broken(probe, its);
    if (step_wins && its & SWIVEL_LIMITED_STEP)
        explain_way(probe, its, broken, text);
    else if (!broken.all.is_empty())
        explain_place(probe, its, broken, text);
    if (its & SWIVEL_LIMITED_SHOULDER_BOX) explain_pole(probe, text);
    if (its & SWIVEL_JUMPED)
        text.add(" Joint limits turn the swivel further than a step may.");
    else if (its & SWIVEL_LIMITED_STEP && !step_wins)
        text.add(
            " The wish is further than one step from where the elbow is: the next solve goes as far as step and limits "
            "allow.");
}

}  // namespace swivel
