// SPDX-License-Identifier: MIT
//
// Draws the pictures of docs/howto/feet.md: what swivel itself does with a foot that slides, and with legs that do not
// reach.
#include <array>
#include <cmath>
#include <functional>

#include "swivel/swivel.hpp"
#include "tools/site/picture.h"

namespace {

using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;

// Hips, and a leg of thigh, shin and foot on each side; seen from the side, forwards is +z. Knees go forwards.
constexpr std::array<std::int32_t, 7> kParents = {-1, 0, 1, 2, 0, 4, 5};
constexpr float kBone = 0.45f, kHips = 0.84f;
constexpr std::array<Float3, 7> kOffsets = {
    {{0, kHips, 0}, {0.1f, 0, 0}, {0, -kBone, 0}, {0, -kBone, 0}, {-0.1f, 0, 0}, {0, -kBone, 0}, {0, -kBone, 0}}};

struct Figure {
    std::array<Float4, 7> pose;
    std::array<Float3, 7> places;  // of joints, after a solve
    float shift = 0;               // of the root

    Figure()
    {
        pose.fill({0, 0, 0, 1});
        for (const std::size_t thigh : {1u, 4u}) {
            pose[thigh] = {-std::sin(0.2f), 0, 0, std::cos(0.2f)};
            pose[thigh + 1] = {std::sin(0.4f), 0, 0, std::cos(0.4f)};
        }
    }
};

swivel_limb_joints leg(std::uint32_t thigh)
{
    swivel_limb_joints joints = swivel_default_limb_joints(thigh, thigh + 1, thigh + 2);
    joints.bend[2] = -1;
    return joints;
}
swivel::Crowd crowd_of(const std::vector<swivel_group_def>& groups)
{
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = swivel::stream(kParents);
    skeleton.translations = swivel::stream(kOffsets);
    skeleton.joint_count = 7;
    return {skeleton, 1, groups};
}
void solve(swivel::Crowd& crowd, Figure& figure, float time, const Float3& root = {})
{
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {figure.pose.data(), sizeof figure.pose, sizeof(Float4), nullptr};
    pose.joint_places = {figure.places.data(), sizeof figure.places, sizeof(Float3), nullptr};
    pose.root_position = {root.data(), 0};
    pose.time = {&time, 0};
    crowd.solve({.pose = &pose});
}

// ---- a foot over time: where the animation has it, and where it is sent
struct Knot {
    double time, place, speed;
};
// The cubic through these knots.
double place_at(const std::vector<Knot>& knots, double time)
{
    std::size_t n = 1;
    while (n + 1 < knots.size() && knots[n].time < time) ++n;
    const Knot &a = knots[n - 1], &b = knots[n];
    const double h = b.time - a.time, u = (time - a.time) / h, v = 1 - u;
    return v * v * (1 + 2 * u) * a.place + u * u * (3 - 2 * u) * b.place + h * u * v * (v * a.speed - u * b.speed);
}
struct Moment {
    double time, animated, sent;
    std::uint32_t flags;
};
std::vector<Moment> foot_over_time(const std::vector<Knot>& knots, const std::function<bool(double)>& is_down)
{
    constexpr int kRate = 100;
    const swivel_limb_joints left = leg(1);
    swivel::Crowd crowd =
        crowd_of({swivel::body_group(left, SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT | SWIVEL_WITH_RECORD)});
    std::vector<Moment> moments;
    double ahead = 0;  // of the root
    for (int n = 0; n <= static_cast<int>(std::lround(knots.back().time * kRate)); ++n) {
        const double time = static_cast<double>(n) / kRate, place = place_at(knots, time);
        crowd.write_all(SWIVEL_CONTACT, 0, std::array{is_down(time) ? 1.0f : 0.0f});
        Figure figure;
        solve(crowd, figure, 1.0f / kRate, {0.0f, 0.0f, static_cast<float>(place)});
        std::array<float, 7> goal;
        std::uint32_t flags = 0;
        crowd.read(SWIVEL_GOAL, 0, std::span(&goal, 1));
        crowd.read(SWIVEL_FLAGS, 0, std::span(&flags, 1));
        if (n == 0) ahead = double{goal[2]} - place;
        moments.push_back({time, place, double{goal[2]} - ahead, flags});
    }
    return moments;
}

// A chart of a foot's place against time.
struct Chart {
    Picture picture;
    const std::vector<Moment>& moments;
    double from, to, low, high;  // s, m
    double bottom = 300, top = 40, left = 60, right = 740;

    Point at(double time, double place) const
    {
        return {left + (right - left) * (time - from) / (to - from),
                bottom - (bottom - top) * (place - low) / (high - low)};
    }
    template <class Of>
    std::vector<Point> curve(const Of& of) const
    {
        std::vector<Point> points;
        for (const Moment& m : moments)
            if (m.time >= from && m.time <= to) points.push_back(at(m.time, of(m)));
        return points;
    }
    void upright(double time, const char* words, double y, const char* anchor = "middle")
    {
        const double x = at(time, low).x;
        picture.line({{x, bottom}, {x, y + 6}}, kPale, 1, "3 4");
        picture.text({x, y}, words, kGrey, anchor);
    }
    void span(double start, double end, const char* words, double y)
    {
        const double a = at(start, low).x, b = at(end, low).x;
        picture.line({{a, y}, {b, y}}, kGreen, 2);
        for (const double x : {a, b}) picture.line({{x, y - 5}, {x, y + 5}}, kGreen, 2);
        picture.text({(a + b) / 2, y - 9}, words, kGreen, "middle");
    }
    void axes()
    {
        picture.line({{left, top - 10}, {left, bottom}, {right, bottom}}, kInk, 2);
        picture.text({right, bottom + 42}, "time", kInk, "end");
        picture.text({left + 8, top - 14}, "place of the foot along its way", kInk);
    }
    void label(double start, double end)
    {
        const Point a = at(std::fmax(start, from), low), b = at(std::fmin(end, to), low);
        picture.box({a.x, bottom + 8}, {b.x, bottom + 20}, kGreen, 0.45);
    }
    void curves()
    {
        picture.line(curve([](const Moment& m) { return m.animated; }), kPale, 3);
        picture.line(curve([](const Moment& m) { return m.sent; }), kOrange, 4);
    }
};

// The first moment from a time on that has a flag, or has it no more.
double when(const std::vector<Moment>& moments, double from, std::uint32_t flag, bool has = true)
{
    for (const Moment& m : moments)
        if (m.time >= from && ((m.flags & flag) != 0) == has) return m.time;
    return moments.back().time;
}

std::string locks_and_releases()
{
    const std::vector<Knot> knots = {
        {0, 0, 0}, {0.5, 0.5, 0.8}, {0.64, 0.54, -0.1}, {1.1, 0.44, -0.2}, {1.6, 1.0, 0.8}};
    constexpr double kDown = 0.5, kUp = 1.1;
    const std::vector<Moment> moments = foot_over_time(knots, [](double time) { return time >= kDown && time < kUp; });
    Chart chart{{"A foot that locks, stands and is released", 350}, moments, 0.3, 1.4, 0.25, 0.75};
    const double locked = when(moments, 0, SWIVEL_PLANTED), free = when(moments, locked, SWIVEL_RELEASED);
    const swivel_plant plant = swivel_default_plant();
    const double stop = locked + double{plant.stop}, back = free + double{plant.blend};
    chart.upright(locked, "locks", 62);
    chart.upright(free, "is released", 62);
    chart.span(locked, stop, "stop", 250);
    chart.span(free, back, "blend", 250);
    chart.curves();
    chart.axes();
    chart.label(kDown, kUp);
    chart.picture.text({chart.at(0.8, 0).x, chart.bottom + 42}, "the label says: in contact", kGreen, "middle");
    chart.picture.text({chart.at(0.82, 0).x, chart.at(0, 0.57).y}, "stands: it moves by no bit", kOrange, "middle");
    chart.picture.text({chart.at(0.86, 0).x, chart.at(0, 0.435).y}, "as animated: it slides", kGrey, "middle");
    return chart.picture.done();
}

std::string breaks_away()
{
    const std::vector<Knot> knots = {{0, 0, 0},          {0.3, 0, 0},    {0.5, 0.05, 0.45},
                                     {1.0, 0.275, 0.45}, {1.3, 0.34, 0}, {2, 0.34, 0}};
    const std::vector<Moment> moments = foot_over_time(knots, [](double time) { return time >= 0.1; });
    Chart chart{{"A foot that breaks away and locks anew", 350}, moments, 0.05, 1.8, -0.06, 0.4};
    const double broke = when(moments, 0, SWIVEL_BROKE_AWAY), anew = when(moments, broke + 0.02, SWIVEL_PLANTED);
    const swivel_plant plant = swivel_default_plant();
    const double unlock = 2 * double{kBone} * double{plant.unlock};
    chart.picture.box(chart.at(0.1, std::fmax(-unlock, chart.low)), chart.at(broke, unlock), kOrange, 0.09);
    chart.picture.line({chart.at(0.1, unlock), chart.at(broke, unlock)}, kPale, 1, "3 4");
    chart.picture.text({chart.at(0.12, 0).x, chart.at(0, unlock).y - 8}, "unlock", kGrey);
    chart.upright(broke, "breaks away", 62, "end");
    chart.upright(anew, "slower than again: locks anew", 62, "start");
    chart.span(broke, broke + double{plant.blend}, "blend", 270);
    chart.curves();
    chart.axes();
    chart.label(0.1, 1.8);
    chart.picture.text({chart.at(0.9, 0).x, chart.bottom + 42}, "the label says: in contact, all the time", kGreen,
                       "middle");
    chart.picture.text({chart.at(0.3, 0).x, chart.at(0, 0.02).y}, "stands", kOrange, "middle");
    chart.picture.text({chart.at(0.58, 0).x, chart.at(0, 0.13).y}, "as animated", kGrey, "end");
    return chart.picture.done();
}

// ---- legs from the side
constexpr float kAnkle = 0.08f, kBack = -0.2f, kAhead = 0.22f, kStep = 0.19f;

struct Legs {
    Picture picture{"A step down: too far, with a shift, and with a cap", 330};
    double middle = 0;  // of the panel

    Point at(double z, double y) const { return {middle + 190 * z, 265 - 190 * y}; }
    Point at(const Float3& place, float shift = 0) const { return at(double{place[2]}, double{place[1] + shift}); }

    void ground(double step) { picture.line({at(-0.42, 0), at(0.08, 0), at(0.08, -step), at(0.46, -step)}, kInk, 2); }
    void leg(const Figure& figure, std::size_t thigh, const char* colour, double width, const char* dash = "")
    {
        const auto joint = [&](std::size_t n) { return at(figure.places[n], figure.shift); };
        const Float3& ankle = figure.places[thigh + 2];
        picture.line({joint(thigh), joint(thigh + 1), joint(thigh + 2)}, colour, width, dash);
        picture.line({at(double{ankle[2]}, double{ankle[1] + figure.shift}),
                      at(double{ankle[2]} - 0.05, double{ankle[1] + figure.shift - kAnkle}),
                      at(double{ankle[2]} + 0.17, double{ankle[1] + figure.shift - kAnkle})},
                     colour, width, dash);
        picture.dot(joint(thigh + 1), 5, colour);
    }
    void hips(const Figure& figure, const char* colour) { picture.dot(at(figure.places[0], figure.shift), 9, colour); }
    void words(const char* first, const char* second)
    {
        picture.text({middle + 5, 26}, first, kInk, "middle");
        picture.text({middle + 5, 46}, second, kInk, "middle");
    }
};

// A leg's point goes where it is written, in place of where the animation has it.
Figure stepping(swivel_features features, const Figure& animated, Float3 ahead)
{
    const swivel_limb_joints left = leg(1), right = leg(4);
    const bool fits = features & SWIVEL_WITH_FIT;
    features |= SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT;
    std::vector<swivel_group_def> groups = {swivel::body_group(left, features), swivel::body_group(right, features)};
    if (fits) groups.push_back(swivel_default_fit_group_def());
    swivel::Crowd crowd = crowd_of(groups);
    const Float3 back = {0.1f, kAnkle, kBack};
    ahead[0] = -0.1f;
    crowd.write_all(SWIVEL_TARGET, 0, back);
    crowd.write_all(SWIVEL_TARGET, 1, ahead);
    for (const std::uint32_t group : {0u, 1u}) crowd.write_all(SWIVEL_CONTACT, group, std::array{1.0f});
    Figure figure = animated;
    solve(crowd, figure, 0.01f);
    std::array<float, 3> shift{};
    if (fits) crowd.read(SWIVEL_SHIFT, 2, std::span(&shift, 1));
    figure.shift = shift[0];
    return figure;
}

std::string legs_that_reach()
{
    Legs legs;
    const Figure animated = stepping(0, Figure(), {0, kAnkle, kAhead});
    const Float3 lower = {0, kAnkle - kStep, kAhead}, farther = {0, kAnkle, 0.38f};
    const auto both = [&](const Figure& figure) {
        legs.leg(figure, 1, kPale, 6);
        legs.leg(figure, 4, kOrange, 6);
        legs.hips(figure, kInk);
    };
    legs.middle = 88;
    legs.words("as animated,", "on flat ground");
    legs.ground(0);
    both(animated);
    legs.middle = 272;
    legs.words("a step down:", "one leg is too short");
    legs.ground(double{kStep});
    both(stepping(0, animated, lower));
    legs.picture.dot(legs.at(lower), 5, kRed);
    legs.middle = 456;
    legs.words("with a shift", "both legs reach");
    legs.ground(double{kStep});
    const Figure shifted = stepping(SWIVEL_WITH_FIT, animated, lower);
    both(shifted);
    const Point was = legs.at(animated.places[0]), is = legs.at(shifted.places[0], shifted.shift);
    legs.picture.line({{was.x - 24, was.y}, {is.x - 24, is.y}}, kGreen, 2.5);
    legs.picture.line({{is.x - 29, is.y - 7}, {is.x - 24, is.y}, {is.x - 19, is.y - 7}}, kGreen, 2.5);
    legs.middle = 640;
    legs.words("a step too long: with a", "cap the knee stays bent");
    legs.ground(0);
    legs.leg(stepping(0, animated, farther), 4, kRed, 2.5, "6 5");
    both(stepping(SWIVEL_WITH_CAP, animated, farther));
    legs.picture.text({legs.middle, 312}, "dashed: without one", kRed, "middle");
    return legs.picture.done();
}

}  // namespace

std::vector<NamedPicture> feet_pictures()
{
    return {{"feet_plant.svg", locks_and_releases()},
            {"feet_break.svg", breaks_away()},
            {"feet_reach.svg", legs_that_reach()}};
}
