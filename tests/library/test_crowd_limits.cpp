// SPDX-License-Identifier: MIT
//
// The promise: limits made of angles are kept as angles, through a skeleton. The other side of the body is the mirror
// image. How limits hold for arms in their own frame is in test_limits.cpp.
#include <map>
#include <set>
#include <span>
#include <string_view>

#include "simd/fields.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// Puts a place, or a rotation x, y, z, w, where its mirror image in the plane x = 0 is.
void mirror_place(auto& v) { v[0] = -v[0]; }
void mirror_turn(auto& q) { q[1] = -q[1], q[2] = -q[2]; }
Quaterniond mirrored(const Quaterniond& q) { return {q.w(), q.x(), -q.y(), -q.z()}; }

}  // namespace

TEST_CASE("the tests' limits of the swivel are all that the library has a flag for")
{
    for (const swivel_field field : every_field())
        CHECK((flag_of(field) != 0) == (std::ranges::find(kOpenLimits, field, &Limit::field) != kOpenLimits.end()));
    std::set<std::string_view> others;  // flags of limits that are no field of the swivel's
    for (std::uint32_t flag = 1; flag != 0; flag <<= 1) {
        const char* const name = swivel_flag_name(flag);
        if (!name || !std::string_view(name).starts_with("LIMITED_")) continue;
        if (std::ranges::none_of(kOpenLimits, [&](const Limit& limit) { return flag_of(limit.field) == flag; }))
            others.insert(name);
    }
    CHECK(others == std::set<std::string_view>{"LIMITED_FLEXION", "LIMITED_LOOK", "LIMITED_REGION", "LIMITED_STEP"});
}

TEST_CASE("limits made of angles are kept through a skeleton")
{
    constexpr std::uint32_t count = 1000;
    Random random{4};
    const BoundLimb limb = bound_limb(random);
    swivel_limb_def def = limbs(count, kWorldJointsHand | kLimits);
    def.binding = limb.bound;
    def.shoulder_order = SWIVEL_YZX;
    def.wrist_order = SWIVEL_ZYX;
    Crowd crowd(def);
    std::vector<LimbLimits> limits;
    for (std::uint32_t n = 0; n < count; ++n) {
        write_limb(crowd, 0, n, random_limb(random, kWorldJointsHand, {limb.bound.lengths[0], limb.bound.lengths[1]}));
        LimbLimits& l = limits.emplace_back(random, def.shoulder_order, def.wrist_order);
        // Each limb has one kind of limit that is narrow; the others are wide open.
        const swivel_field narrow = kOpenLimits[n % kOpenLimits.size()].field;
        l.draw([&](const Limit& limit) { return limit.field == narrow ? random.between(0.3, 2) : kPi; },
               [&](const Limit& limit) {
                   return limit.field == narrow ? AngleRange{random.between(-kPi, kPi), random.between(0.5, 2.5)}
                                                : AngleRange{};
               });
        each_limit(l, [&](swivel_field field, const auto& value) { put(crowd, field, n, value); });
    }
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    std::map<swivel_field, int> seen;
    for (std::uint32_t n = 0; n < count; ++n) {
        const double by = violation_of(limits[n], kLimits, added_to_rest(local_pose(crowd, n), limb.bound));
        INFO("limb " << n << ", kind " << n % kOpenLimits.size() << ", flags " << flags[n]);
        if (!(flags[n] & SWIVEL_INFEASIBLE)) CHECK(by <= 2e-6);
        CHECK((flags[n] & (SWIVEL_REACHED)) != 0);
        for (const Limit& each : kOpenLimits) seen[each.field] += (flags[n] & flag_of(each.field)) != 0;
    }
    for (const Limit& each : kOpenLimits) CHECK(seen[each.field] > 20);
}

TEST_CASE("the other side's value of an input that is no limit and no turn is the same")
{
    int same = 0;
    for (const FieldRow& row : kFields) {
        const bool has_turn = std::ranges::find(row.value.parts, ValuePart::turn) != std::end(row.value.parts);
        if (row.kind != kInput || has_turn || flag_of(row.field)) continue;
        INFO(row.name);
        std::array<float, kMaxComponents> value, other = {};
        value.fill(0.5f);
        CHECK(swivel_mirror(row.field, SWIVEL_XYZ, value.data(), other.data()) == SWIVEL_OK);
        CHECK(std::ranges::count(other, 0.5f) == row.component_count);
        ++same;
    }
    CHECK(same > 20);
}

TEST_CASE("a flexion of up to pi, as a double or as a float, is no limit")
{
    const Float2 none{1, 0};  // with which a limb starts
    CHECK(std::ranges::equal(none, std::span(row_of(SWIVEL_FLEXION_LIMIT).start, 2)));
    for (const double max : {kPi, double{std::numbers::pi_v<float>}}) {
        CHECK(flexion(0, max) == none);
        CHECK(flexion(max, max) == Float2{0, 0});
    }
}

TEST_CASE("the body's other side is the mirror image")
{
    constexpr std::uint32_t count = 300;
    // Besides limits, swivel_mirror() changes turns.
    std::vector<swivel_field> turns;
    swivel_features features = kWorldJointsHand | kLimits;
    for (const FieldRow& row : kFields) {
        if (std::ranges::find(row.value.parts, ValuePart::turn) == std::end(row.value.parts)) continue;
        REQUIRE(row.component_count == 2);  // nothing but the turn
        turns.push_back(row.field), features |= row.needs;
    }
    REQUIRE(!turns.empty());
    Random random{5};
    const ThreeJoints right = skewed_joints(random);
    ThreeJoints left = right;
    for (Float4& q : left.rotations) mirror_turn(q);
    for (Float3* const v : {&left.translations[1], &left.translations[2], &left.bend}) mirror_place(*v);
    const swivel_binding bound = right.bound();
    Crowd r = crowd_of(features, count, bound), l = crowd_of(features, count, left.bound());
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
        for (Float3* const v : {&other.target, &other.pole, &other.position}) mirror_place(*v);
        for (Float4* const q : {&other.rotation, &other.hand}) mirror_turn(*q);
        write_limb(r, 0, n, limb);
        write_limb(l, 0, n, other);
        for (const swivel_field turn : turns) both(turn, n, cos_sin(random.between(-2, 2)));
        LimbLimits limits(random);
        limits.draw(
            [&](const Limit& limit) {
                return limit.shape == LimitShape::axis_in_cone ? random.between(1.5, 3) : random.between(1, 2.5);
            },
            [&](const Limit&) {
                return AngleRange{random.between(-1, 1), random.between(1, 3)};
            });
        each_limit(limits, [&](swivel_field field, const auto& value) { both(field, n, value); });
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
            const double from = std::atan2(arc.from[1], arc.from[0]), end = std::atan2(arc.to[1], arc.to[0]);
            CHECK(from != end);  // which would be the whole circle
            CHECK(std::fabs(std::remainder(end - from, 2 * kPi)) <= 0.1);
            ++some;
        }
    }
    CHECK(some > 100);
}

TEST_CASE("a cone said in the character's axes holds in the character's axes")
{
    constexpr std::uint32_t count = 200;
    std::size_t kept = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Random random{seed + 50};
        const BoundLimb limb = bound_limb(random);
        Crowd crowd = crowd_of(kWorldJointsHand | SWIVEL_WITH_SHOULDER_CONE, count, limb.bound);
        const Quaterniond parent = random.rotation();  // at rest, and in every pose here
        const Vector3d direction = random.direction();
        const Vector3d scaled = random.spread(1e-3, 1e3) * direction;
        const Float4 q = floats(Quaterniond(random.spread(0.1, 10) * parent.coeffs()));
        const auto axis = arm_axis(limb.bound, q, {scaled.x(), scaled.y(), scaled.z()});
        std::array<double, 3> in_place = {scaled.x(), scaled.y(), scaled.z()};
        REQUIRE(swivel_arm_axis(&limb.bound, q.data(), in_place.data(), in_place.data()) == SWIVEL_OK);
        CHECK(in_place == axis);
        const double max = random.between(0.4, 2.5);
        crowd.write_all(SWIVEL_SHOULDER_CONE, 0, cone(axis, max));
        for (std::uint32_t n = 0; n < count; ++n) {
            Limb each = random_limb(random, kWorldJointsHand, {limb.bound.lengths[0], limb.bound.lengths[1]});
            each.rotation = q;
            write_limb(crowd, 0, n, each);
        }
        crowd.solve();
        const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
        for (std::uint32_t n = 0; n < count; ++n) {
            if (flags[n] & SWIVEL_INFEASIBLE) continue;
            const Vector3d upper = parent * (local_pose(crowd, n).shoulder * vec(limb.rest.translations[1]));
            CHECK(upper.normalized().dot(direction) >= std::cos(max) - 2e-6);
            ++kept;
        }
    }
    CHECK(kept > 300);
}
