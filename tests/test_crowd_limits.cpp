// SPDX-License-Identifier: MIT
//
// The promise: limits made of angles are kept as angles, through a skeleton. The other side of the body is the mirror
// image. The allowed arcs are where the limits are kept.
#include <map>

#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// The mirror image in the plane x = 0 of vectors, rotations, and of axes that something turns about.
Vector3d mirrored(const Vector3d& v) { return {-v.x(), v.y(), v.z()}; }
Quaterniond mirrored(const Quaterniond& q) { return {q.w(), q.x(), -q.y(), -q.z()}; }

}  // namespace

TEST_CASE("limits made of angles are kept through a skeleton")
{
    constexpr std::uint32_t count = 1000;
    Random random{4};
    const Chained limb = chained(random);
    swivel_group_def group = swivel::group(count, limb.bound, kWorldJointsHand | kLimits);
    group.shoulder_order = SWIVEL_YZX;
    group.wrist_order = SWIVEL_ZYX;
    Crowd crowd({group});
    struct Limited {
        Vector3d shoulder_axis, hand_axis, twist_axis;
        double shoulder, hand;
        AngleRange humeral, forearm, twist;
        AngleBox shoulder_box{{1, 2, 0}, {}}, wrist_box{{2, 1, 0}, {}};
    };
    std::vector<Limited> limits(count);
    for (std::uint32_t n = 0; n < count; ++n) {
        write_limb(crowd, 0, n, random_limb(random, kWorldJointsHand, {limb.bound.lengths[0], limb.bound.lengths[1]}));
        Limited& l = limits[n];
        // Each limb has one kind of limit that is narrow; the others are wide open.
        const std::uint32_t kind = n % 7;
        const auto range = [&](std::uint32_t mine) {
            return kind == mine ? AngleRange{random.between(-kPi, kPi), random.between(0.5, 2.5)} : AngleRange{};
        };
        l.shoulder_axis = random.direction(), l.hand_axis = random.direction(), l.twist_axis = random.direction();
        l.shoulder = kind == 0 ? random.between(0.3, 2) : kPi, l.hand = kind == 1 ? random.between(0.3, 2) : kPi;
        l.humeral = range(2), l.forearm = range(3), l.twist = range(4);
        for (int a = 0; a < 3; ++a) l.shoulder_box.range[a] = range(5), l.wrist_box.range[a] = range(6);
        Float4 cone;
        CHECK(swivel_cone(l.shoulder_axis.data(), l.shoulder, cone.data()) == SWIVEL_OK);
        put(crowd, SWIVEL_SHOULDER_CONE, n, cone);
        CHECK(swivel_cone(l.hand_axis.data(), l.hand, cone.data()) == SWIVEL_OK);
        put(crowd, SWIVEL_HAND_CONE, n, cone);
        put(crowd, SWIVEL_HUMERAL_TWIST, n, range_of(l.humeral));
        put(crowd, SWIVEL_FOREARM_TWIST, n, range_of(l.forearm));
        const Float3 axis = floats(l.twist_axis);
        const Float4 twist = range_of(l.twist);
        put(crowd, SWIVEL_HAND_TWIST, n, Float7{axis[0], axis[1], axis[2], twist[0], twist[1], twist[2], twist[3]});
        Float12 shoulder, wrist;
        for (std::size_t a = 0; a < 3; ++a) {
            std::ranges::copy(range_of(l.shoulder_box.range[a]), shoulder.begin() + 4 * a);
            std::ranges::copy(range_of(l.wrist_box.range[a]), wrist.begin() + 4 * a);
        }
        put(crowd, SWIVEL_SHOULDER_BOX, n, shoulder);
        put(crowd, SWIVEL_WRIST_BOX, n, wrist);
    }
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    const swivel_binding& b = limb.bound;
    const Quaterniond parent = quat(b.parent_from_arm), upper = quat(b.upper_from_arm), fore = quat(b.fore_from_arm);
    const Quaterniond hand_rest = fore.conjugate() * quat(b.wrist_rest);
    std::map<std::uint32_t, int> seen;
    for (std::uint32_t n = 0; n < count; ++n) {
        const LocalPose pose = local_pose(crowd, n);
        // What the joints add to rest, in the arm frame.
        const Quaterniond shoulder = (parent.conjugate() * pose.shoulder * upper).normalized();
        const Quaterniond wrist = (fore.conjugate() * pose.wrist * hand_rest.conjugate()).normalized();
        const Limited& l = limits[n];
        const Vector3d e3 = Vector3d::UnitZ();
        const double by = std::max({cone_violation(l.shoulder_axis, std::cos(l.shoulder), shoulder * e3),
                                    cone_violation(e3, std::cos(l.hand), wrist * l.hand_axis),
                                    twist_violation(e3, l.humeral, shoulder), twist_violation(e3, l.forearm, wrist),
                                    twist_violation(l.twist_axis, l.twist, wrist),
                                    box_violation(l.shoulder_box, shoulder.toRotationMatrix()),
                                    box_violation(l.wrist_box, wrist.toRotationMatrix())});
        INFO("limb " << n << ", kind " << n % 7 << ", flags " << flags[n]);
        if (!(flags[n] & SWIVEL_INFEASIBLE)) CHECK(by <= 2e-6);
        CHECK((flags[n] & (SWIVEL_REACHED)) != 0);
        for (std::uint32_t bit = 6; bit < 14; ++bit)
            if (flags[n] >> bit & 1) ++seen[bit];
    }
    for (std::uint32_t bit = 7; bit < 14; ++bit) CHECK(seen[bit] > 20);
}

TEST_CASE("a wish that breaks a limit by more than rounding leaves is not granted")
{
    constexpr std::uint32_t count = 300;
    Random random{9};
    Crowd free = crowd_of(0, count), crowd = crowd_of(SWIVEL_WITH_SHOULDER_CONE, count);
    for (std::uint32_t n = 0; n < count; ++n) {
        const Limb limb = random_limb(random, 0, {1, 1.2f});
        write_limb(free, 0, n, limb);
        write_limb(crowd, 0, n, limb);
    }
    free.solve();
    std::vector<Vector3d> axes;
    std::vector<double> openings;
    for (std::uint32_t n = 0; n < count; ++n) {
        // Outside by 20 times what is tolerated.
        const Vector3d upper = quat(read<Float4>(free, SWIVEL_SHOULDER)[n]).normalized() * Vector3d::UnitZ();
        axes.push_back(vec(floats(random.direction())).normalized());
        openings.push_back(std::min(axes[n].dot(upper) + 1e-5, 1.0));
        Float4 cone;
        CHECK(swivel_cone(axes[n].data(), std::acos(openings[n]), cone.data()) == SWIVEL_OK);
        put(crowd, SWIVEL_SHOULDER_CONE, n, cone);
    }
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    const auto shoulders = read<Float4>(crowd, SWIVEL_SHOULDER);
    for (std::uint32_t n = 0; n < count; ++n) {
        INFO("limb " << n);
        CHECK((flags[n] & SWIVEL_LIMITED_SHOULDER_CONE) != 0);
        if (flags[n] & SWIVEL_INFEASIBLE) continue;
        const Vector3d upper = quat(shoulders[n]).normalized() * Vector3d::UnitZ();
        CHECK(cone_violation(axes[n], openings[n], upper) <= 1e-6);
    }
}

TEST_CASE("a scan of the circle finds no nearer allowed swivel, and none better where none is allowed")
{
    constexpr std::uint32_t count = 600;
    constexpr swivel_features limits = SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST;
    Random random{10};
    Crowd wished = crowd_of(0, count), crowd = crowd_of(limits | SWIVEL_WITH_SHOULDER_BOX, count);
    struct Limited {
        Vector3d line, axis;
        double opening = kPi;
        AngleRange twist;
        AngleBox box;
        bool has_box;
    };
    std::vector<Limited> limited;
    for (std::uint32_t n = 0; n < count; ++n) {
        const Limb limb = random_limb(random, 0, {1, 1.2f});
        write_limb(wished, 0, n, limb);
        write_limb(crowd, 0, n, limb);
        Limited l{vec(limb.target).normalized(), vec(floats(random.direction())).normalized(), kPi, {}, {}, n % 2 == 0};
        if (l.has_box) {
            for (AngleRange& range : l.box.range) range = {random.between(-kPi, kPi), random.between(0.5, 2.5)};
        } else {
            l.opening = random.between(0.2, 2.5);
            l.twist = {random.between(-kPi, kPi), random.between(0.2, 2.5)};
        }
        Float4 cone;
        CHECK(swivel_cone(l.axis.data(), l.opening, cone.data()) == SWIVEL_OK);
        put(crowd, SWIVEL_SHOULDER_CONE, n, cone);
        put(crowd, SWIVEL_HUMERAL_TWIST, n, range_of(l.twist));
        Float12 box;
        for (std::size_t k = 0; k < 3; ++k) std::ranges::copy(range_of(l.box.range[k]), box.begin() + 4 * k);
        put(crowd, SWIVEL_SHOULDER_BOX, n, box);
        limited.push_back(l);
    }
    wished.solve();
    crowd.solve();
    const auto wishes = read<Float4>(wished, SWIVEL_SHOULDER), got = read<Float4>(crowd, SWIVEL_SHOULDER);
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    int moved = 0, none = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        const Limited& l = limited[n];
        const Quaterniond wish = quat(wishes[n]).normalized(), pose = quat(got[n]).normalized();
        const auto violation = [&](const Quaterniond& q) {
            if (l.has_box) return box_violation(l.box, q.toRotationMatrix());
            return std::max(cone_violation(l.axis, std::cos(l.opening), q * Vector3d::UnitZ()),
                            twist_violation(Vector3d::UnitZ(), l.twist, q));
        };
        const double swivel = wish.angularDistance(pose), by = violation(pose);
        double nearest = 2 * kPi, least = 2;
        for (int step = -1800; step <= 1800; ++step) {
            const double angle = kPi * step / 1800, there = violation(Eigen::AngleAxisd(angle, l.line) * wish);
            if (there <= -1e-6) nearest = std::min(nearest, std::fabs(angle));
            least = std::min(least, there);
        }
        INFO("limb " << n << ", flags " << flags[n] << ", swivel " << swivel << ", broken by " << by);
        if (flags[n] & SWIVEL_INFEASIBLE) {
            ++none;
            CHECK(least > -1e-6);
            if (!l.has_box) CHECK(by <= least + 2e-6);  // outside of a box there is no one way to measure how far
        } else {
            moved += swivel > 0.01;
            CHECK(by <= 2e-6);
            CHECK(swivel <= nearest + 1e-3);  // an arc's end may be flat
        }
    }
    CHECK(moved > 100);
    CHECK(none > 100);
}

TEST_CASE("the body's other side is the mirror image")
{
    constexpr std::uint32_t count = 300;
    const swivel_features features = kWorldJointsHand | SWIVEL_WITH_ANGLE | kLimits;
    Random random{5};
    const swivel_chain right = skewed_chain(random);
    swivel_chain left = right;
    const auto mirror3 = [](const float(&from)[3], float(&to)[3]) {
        std::ranges::copy(floats(mirrored(vec(from))), to);
    };
    const auto mirror4 = [](const float(&from)[4], float(&to)[4]) {
        std::ranges::copy(floats(mirrored(quat(from))), to);
    };
    mirror4(right.shoulder_rotation, left.shoulder_rotation);
    mirror4(right.elbow_rotation, left.elbow_rotation);
    mirror4(right.wrist_rotation, left.wrist_rotation);
    mirror3(right.elbow_offset, left.elbow_offset);
    mirror3(right.wrist_offset, left.wrist_offset);
    mirror3(right.bend, left.bend);
    Crowd r = crowd_of(features, count, bind(right)), l = crowd_of(features, count, bind(left));
    const swivel_binding bound = bind(right);
    const swivel_euler_order order = SWIVEL_XYZ;
    const auto both = [&](swivel_field field, std::uint32_t n, const auto& value) {
        auto other = value;
        CHECK(swivel_mirror(field, order, value.data(), other.data()) == SWIVEL_OK);
        put(r, field, n, value);
        put(l, field, n, other);
    };
    for (std::uint32_t n = 0; n < count; ++n) {
        const Limb limb = random_limb(random, kWorldJointsHand, {bound.lengths[0], bound.lengths[1]});
        Limb other = limb;
        other.target = floats(mirrored(vec(limb.target)));
        other.pole = floats(mirrored(vec(limb.pole)));
        other.position = floats(mirrored(vec(limb.position)));
        other.rotation = floats(mirrored(quat(limb.rotation)));
        other.hand = floats(mirrored(quat(limb.hand)));
        write_limb(r, 0, n, limb);
        write_limb(l, 0, n, other);
        Float2 turn;
        swivel_turn(random.between(-2, 2), turn.data());
        both(SWIVEL_ANGLE, n, turn);
        const auto range = [&] { return range_of({random.between(-1, 1), random.between(1, 3)}); };
        Float4 cone;
        const Vector3d axis = random.direction(), hand_axis = random.direction(), twist_axis = random.direction();
        CHECK(swivel_cone(axis.data(), random.between(1, 2.5), cone.data()) == SWIVEL_OK);
        both(SWIVEL_SHOULDER_CONE, n, cone);
        CHECK(swivel_cone(hand_axis.data(), random.between(1.5, 3), cone.data()) == SWIVEL_OK);
        both(SWIVEL_HAND_CONE, n, cone);
        both(SWIVEL_HUMERAL_TWIST, n, range());
        both(SWIVEL_FOREARM_TWIST, n, range());
        const Float4 twist = range();
        const Float3 a = floats(twist_axis);
        both(SWIVEL_HAND_TWIST, n, Float7{a[0], a[1], a[2], twist[0], twist[1], twist[2], twist[3]});
        for (const swivel_field box : {SWIVEL_SHOULDER_BOX, SWIVEL_WRIST_BOX}) {
            Float12 value;
            for (std::size_t k = 0; k < 3; ++k) std::ranges::copy(range(), value.begin() + 4 * k);
            both(box, n, value);
        }
    }
    r.solve();
    l.solve();
    const auto flags = read<std::uint32_t>(r, SWIVEL_FLAGS), other_flags = read<std::uint32_t>(l, SWIVEL_FLAGS);
    int same = 0, limited = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        INFO("limb " << n);
        const LocalPose pose = local_pose(r, n), image = local_pose(l, n);
        CHECK(flags[n] == other_flags[n]);
        limited += (flags[n] & ~std::uint32_t{SWIVEL_REACHED}) != 0;
        const double off =
            std::max({distance(mirrored(pose.shoulder), image.shoulder), distance(mirrored(pose.elbow), image.elbow),
                      distance(mirrored(pose.wrist), image.wrist)});
        same += off <= 1e-3;  // where an arc's end is flat, the two roundings of it may differ
    }
    CHECK(limited > 50);
    CHECK(same == count);
}

TEST_CASE("allowed arcs are where the limits are kept, and the solver's choice is in one or at its end")
{
    constexpr std::uint32_t count = 200;
    Random random{8};
    Crowd crowd = crowd_of(
        SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST | SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_ANGLE, count);
    int some = 0, none = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        write_limb(crowd, 0, n, random_limb(random, 0, {1, 1.2f}));
        const Vector3d axis = random.direction();
        Float4 cone;
        CHECK(swivel_cone(axis.data(), random.between(0.5, 3), cone.data()) == SWIVEL_OK);
        put(crowd, SWIVEL_SHOULDER_CONE, n, cone);
        put(crowd, SWIVEL_HUMERAL_TWIST, n, range_of({random.between(-kPi, kPi), random.between(1, 3.14)}));
        if (n % 2) {
            Float12 box;
            for (std::size_t k = 0; k < 3; ++k)
                std::ranges::copy(range_of({random.between(-kPi, kPi), random.between(1.5, 3.1)}), box.begin() + 4 * k);
            put(crowd, SWIVEL_SHOULDER_BOX, n, box);
        }
    }
    std::vector<std::vector<swivel_arc>> arcs(count);
    for (std::uint32_t n = 0; n < count; ++n) {
        std::uint32_t arc_count = 0, again = 0;
        REQUIRE(swivel_allowed_arcs(crowd.get(), 0, n, nullptr, 0, &arc_count) == SWIVEL_OK);
        arcs[n].resize(arc_count);
        REQUIRE(swivel_allowed_arcs(crowd.get(), 0, n, arcs[n].data(), arc_count, &again) == SWIVEL_OK);
        CHECK(again == arc_count);
        none += arc_count == 0, some += arc_count > 0;
    }
    CHECK(some > 50);
    CHECK(none > 10);
    // Wishes all around the circle: one is granted just where an arc has it.
    for (int k = 0; k < 90; ++k) {
        const double angle = -kPi + 2 * kPi * (k + 0.5) / 90;
        Float2 turn;
        swivel_turn(angle, turn.data());
        crowd.write_all(SWIVEL_ANGLE, 0, turn);
        crowd.solve();
        const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
        for (std::uint32_t n = 0; n < count; ++n) {
            bool inside = false, near_end = false;
            for (const swivel_arc& arc : arcs[n]) {
                const double from = std::atan2(arc.from[1], arc.from[0]), to = std::atan2(arc.to[1], arc.to[0]);
                const auto ahead = [](double a, double b) { return std::fmod(b - a + 4 * kPi, 2 * kPi); };
                const double width = from == to ? 2 * kPi : ahead(from, to);
                inside = inside || ahead(from, angle) <= width;
                for (const double end : {from, to})
                    near_end = near_end || std::fabs(std::remainder(angle - end, 2 * kPi)) < 2e-3;
            }
            if (near_end) continue;
            INFO("limb " << n << ", wish " << angle);
            CHECK((flags[n] == SWIVEL_REACHED) == inside);
        }
    }
}

TEST_CASE("arcs of locked axes are as short as what they allow")
{
    Crowd crowd = crowd_of(SWIVEL_WITH_SHOULDER_BOX, 441);
    const Float4 free = range(-kPi, kPi), locked = range(0, 0);
    Float12 box;
    for (std::size_t k = 0; k < 3; ++k) std::ranges::copy(k == 2 ? locked : free, box.begin() + 4 * k);
    crowd.write_all(SWIVEL_SHOULDER_BOX, 0, box);
    std::vector<Float3> targets;
    for (int x = -10; x <= 10; ++x)
        for (int y = -10; y <= 10; ++y) targets.push_back({0.1f * float(x), 0.1f * float(y), 1});
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    int some = 0;
    for (std::uint32_t n = 0; n < targets.size(); ++n) {
        INFO("target " << targets[n][0] << ", " << targets[n][1]);
        const std::vector<swivel_arc> arcs = crowd.allowed_arcs(0, n);
        CHECK(arcs.empty() == ((flags[n] & SWIVEL_INFEASIBLE) != 0));
        for (const swivel_arc& arc : arcs) {
            const double from = std::atan2(arc.from[1], arc.from[0]), to = std::atan2(arc.to[1], arc.to[0]);
            CHECK(from != to);  // which would be the whole circle
            CHECK(std::fabs(std::remainder(to - from, 2 * kPi)) <= 0.1);
            ++some;
        }
    }
    CHECK(some > 100);
}

TEST_CASE("angles that make no limit are refused")
{
    float value[4] = {7, 7, 7, 7};
    const double axis[3] = {0, 0, 2}, none[3] = {0, 0, 0};
    CHECK_REFUSED(swivel_range(1, 0, value), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_range(0, 6.4, value), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_range(std::nan(""), 1, value), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_range(0, 1, nullptr), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_cone(none, 1, value), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_cone(axis, -0.1, value), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_cone(axis, 3.2, value), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_flexion(-0.1, 1, value), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_flexion(1, 0.5, value), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_flexion(1, 3.2, value), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_mirror(SWIVEL_RESULT_END, SWIVEL_XYZ, value, value), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_mirror(SWIVEL_ELBOW, SWIVEL_XYZ, value, value), SWIVEL_INVALID_ARGUMENT);
    for (const float x : value) CHECK(x == 7);
    CHECK(swivel_range(-kPi, kPi, value) == SWIVEL_OK);
    CHECK(swivel_cone(axis, kPi, value) == SWIVEL_OK);
    CHECK(swivel_flexion(0, kPi, value) == SWIVEL_OK);
    CHECK(value[0] == 1);
    CHECK(value[1] == 0);
}

TEST_CASE("a cone said in the character's axes holds in the character's axes")
{
    constexpr std::uint32_t count = 200;
    std::size_t kept = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Random random{seed + 50};
        const Chained limb = chained(random);
        Crowd crowd = crowd_of(kWorldJointsHand | SWIVEL_WITH_SHOULDER_CONE, count, limb.bound);
        const Quaterniond parent = random.rotation();  // at rest, and in every pose here
        const Vector3d direction = random.direction();
        const Vector3d scaled = random.spread(1e-3, 1e3) * direction;
        const Float4 q = floats(Quaterniond(random.spread(0.1, 10) * parent.coeffs()));
        const auto axis = arm_axis(limb.bound, q, {scaled.x(), scaled.y(), scaled.z()});
        const double most = random.between(0.4, 2.5);
        crowd.write_all(SWIVEL_SHOULDER_CONE, 0, cone(axis, most));
        for (std::uint32_t n = 0; n < count; ++n) {
            Limb each = random_limb(random, kWorldJointsHand, {limb.bound.lengths[0], limb.bound.lengths[1]});
            each.rotation = q;
            write_limb(crowd, 0, n, each);
        }
        crowd.solve();
        const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
        for (std::uint32_t n = 0; n < count; ++n) {
            if (flags[n] & SWIVEL_INFEASIBLE) continue;
            const Vector3d upper = parent * (local_pose(crowd, n).shoulder * vec(limb.chain.elbow_offset));
            CHECK(upper.normalized().dot(direction) >= std::cos(most) - 2e-6);
            ++kept;
        }
    }
    CHECK(kept > 300);
}

TEST_CASE("swivel_arm_axis refuses what has no direction, and takes its own output")
{
    Random random{9};
    const swivel_binding binding = chained(random).bound;
    const Float4 turned = floats(random.rotation()), none{};
    const double up[3] = {0, 1, 0}, nothing[3] = {}, bad[3] = {0, std::nan(""), 0};
    double axis[3] = {7, 7, 7};
    const auto wrong = SWIVEL_INVALID_ARGUMENT;
    CHECK_REFUSED(swivel_arm_axis(nullptr, turned.data(), up, axis), wrong);
    CHECK_REFUSED(swivel_arm_axis(&binding, nullptr, up, axis), wrong);
    CHECK_REFUSED(swivel_arm_axis(&binding, turned.data(), nullptr, axis), wrong);
    CHECK_REFUSED(swivel_arm_axis(&binding, turned.data(), up, nullptr), wrong);
    CHECK_REFUSED(swivel_arm_axis(&binding, none.data(), up, axis), wrong);
    for (const double* direction : {nothing, bad})
        CHECK_REFUSED(swivel_arm_axis(&binding, turned.data(), direction, axis), wrong);
    const swivel_binding zeros = swivel_default_binding();
    CHECK_REFUSED(swivel_arm_axis(&zeros, turned.data(), up, axis), wrong);
    CHECK((axis[0] == 7 && axis[1] == 7 && axis[2] == 7));
    REQUIRE(swivel_arm_axis(&binding, turned.data(), up, axis) == SWIVEL_OK);
    double in_place[3] = {0, 1, 0};
    REQUIRE(swivel_arm_axis(&binding, turned.data(), in_place, in_place) == SWIVEL_OK);
    CHECK(std::equal(axis, axis + 3, in_place));
}
