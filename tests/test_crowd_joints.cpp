// SPDX-License-Identifier: MIT
//
// The promise: a crowd's results for skeletons agree with a walk down the skeleton's joints, by Eigen in double.
// Bindings are made of limbs alone.
#include "tests/test_crowd.h"
#include "tests/test_limb.h"

#include <functional>

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

enum class Rest { straight, bent, bent_by_itself };  // the last: no bend given, the rest pose shows it

// A shoulder, elbow and wrist with random rest rotations and bone axes.
swivel_chain random_chain(Random& random, Rest rest)
{
    swivel_chain chain = swivel_default_chain();
    const auto put3 = [](float(&to)[3], const Vector3d& v) { std::ranges::copy(floats(v), to); };
    const auto put4 = [&random](float(&to)[4], const Quaterniond& q) {
        std::ranges::copy(floats(Quaterniond(random.spread(0.1, 10) * q.coeffs())), to);
    };
    put4(chain.shoulder_rotation, random.rotation());
    put4(chain.elbow_rotation, random.rotation());
    put4(chain.wrist_rotation, random.rotation());
    const Vector3d upper = random.direction(), hinge = random.across(upper);
    const double flexion = rest == Rest::straight ? 0 : random.between(rest == Rest::bent ? 0.1 : 0.18, 2.5);
    const Vector3d fore = Eigen::AngleAxisd(-flexion, hinge) * upper;  // the bend is upper x hinge
    put3(chain.elbow_offset, random.spread(0.5, 5) * upper);
    put3(chain.wrist_offset, random.spread(0.5, 5) * (quat(chain.elbow_rotation).normalized().conjugate() * fore));
    if (rest != Rest::bent_by_itself)
        put3(chain.bend, random.spread(0.1, 10) * (upper.cross(hinge) + random.between(-1, 1) * upper));
    return chain;
}

// What the elbow turns about, in the shoulder joint's frame: flexion turns the forearm from the upper arm towards the
// bend, about the opposite of this.
Vector3d hinge_of(const swivel_chain& chain)
{
    const Vector3d fore = quat(chain.elbow_rotation).normalized() * vec(chain.wrist_offset);
    const Vector3d bend = vec(chain.bend).norm() > 0 ? vec(chain.bend) : fore;
    return bend.cross(vec(chain.elbow_offset)).normalized();
}

struct Joints {
    Quaterniond shoulder, elbow, wrist;  // local
};

// Down the skeleton from the parent joint: nothing of the arm frame is in it.
Places places_of(const swivel_chain& chain, const Parent& parent, const Joints& local)
{
    const Quaterniond shoulder_w = parent.rotation * local.shoulder, elbow_w = shoulder_w * local.elbow;
    const Vector3d elbow = parent.position + parent.scale * (shoulder_w * vec(chain.elbow_offset));
    return {elbow, elbow + parent.scale * (elbow_w * vec(chain.wrist_offset)), elbow_w * local.wrist};
}

Joints joints_of(const Crowd& crowd, std::uint32_t group, std::uint32_t n)
{
    Float4 q[3] = {{}, {}, {0, 0, 0, 1}};
    crowd.read(SWIVEL_SHOULDER, group, std::span(q, 1), n);
    crowd.read(SWIVEL_ELBOW, group, std::span(q + 1, 1), n);
    if (swivel_field_row_count(crowd.get(), 0, SWIVEL_WRIST)) crowd.read(SWIVEL_WRIST, group, std::span(q + 2, 1), n);
    for (const Float4& each : q) {
        CHECK(is_unit(each));
        CHECK(is_in_hemisphere(each));
    }
    return {quat(q[0]).normalized(), quat(q[1]).normalized(), quat(q[2]).normalized()};
}

// Without a world the arm frame is the space of the targets; the parent joint is then seen from it.
Parent parent_of(const Limb& limb, const swivel_binding& binding, swivel_features features)
{
    if (features & SWIVEL_WORLD) return limb.parent();
    return {Vector3d::Zero(), quat(binding.parent_from_arm).normalized().conjugate(), 1};
}

Joints rest_of(const swivel_chain& chain)
{
    return {quat(chain.shoulder_rotation).normalized(), quat(chain.elbow_rotation).normalized(),
            quat(chain.wrist_rotation).normalized()};
}

constexpr std::uint32_t kGroups = 12, kLimbs = 21;

}  // namespace

TEST_CASE("skeletons: local rotations put the wrist on its target, the hand as wanted, the elbow on the pole's side")
{
    const swivel_features j = SWIVEL_JOINTS, w = SWIVEL_WORLD, h = SWIVEL_WITH_HAND, d = SWIVEL_POLE_DIRECTION;
    for (const swivel_features features : {j, j | h, j | w, j | w | h, j | w | d, j | w | h | d})
        for (const Rest rest : {Rest::straight, Rest::bent, Rest::bent_by_itself}) {
            Random random{features * 3 + static_cast<std::uint64_t>(rest)};
            std::vector<swivel_chain> chains;
            std::vector<swivel_group_def> groups;
            std::vector<swivel_binding> bound;
            for (std::uint32_t g = 0; g < kGroups; ++g) {
                chains.push_back(random_chain(random, rest));
                bound.push_back(bind(chains.back()));
                groups.push_back(swivel::group(kLimbs, bound.back(), features));
                CHECK(std::fabs(bound[g].lengths[0] - vec(chains[g].elbow_offset).norm()) <=
                      1e-6 * bound[g].lengths[0]);
                CHECK(std::fabs(bound[g].lengths[1] - vec(chains[g].wrist_offset).norm()) <=
                      1e-6 * bound[g].lengths[1]);
            }
            Crowd crowd = crowd_with(features, groups);
            std::vector<std::vector<Limb>> limbs(kGroups);
            for (std::uint32_t g = 0; g < kGroups; ++g)
                for (std::uint32_t n = 0; n < kLimbs; ++n) {
                    limbs[g].push_back(random_limb(random, features, {bound[g].lengths[0], bound[g].lengths[1]}));
                    write_limb(crowd, g, n, limbs[g].back());
                }
            crowd.solve();
            for (std::uint32_t g = 0; g < kGroups; ++g) {
                const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS, g);
                const Vector3d hinge = hinge_of(chains[g]);
                const Vector3d hinge_e = quat(chains[g].elbow_rotation).normalized().conjugate() * hinge;
                std::vector<Places> places;
                for (std::uint32_t n = 0; n < kLimbs; ++n) {
                    INFO("features " << features << ", rest " << static_cast<int>(rest) << ", group " << g << ", limb "
                                     << n);
                    const Joints local = joints_of(crowd, g, n);
                    const Parent parent = parent_of(limbs[g][n], bound[g], features);
                    places.push_back(places_of(chains[g], parent, local));
                    check_places(limbs[g][n], features, places.back(), flags[n]);
                    // The elbow joint turns about the hinge alone, and bends the forearm about -hinge.
                    CHECK((local.elbow * hinge_e - hinge).norm() <= 2e-6);
                    const Vector3d upper = vec(chains[g].elbow_offset),
                                   fore = local.elbow * vec(chains[g].wrist_offset);
                    CHECK(upper.cross(fore).dot(-hinge) > 0);
                }
                check_forward(crowd, g, limbs[g], places, 5e-7);
            }
        }
}

TEST_CASE("skeletons: the rest pose's own wrist and elbow give back the rest rotations")
{
    for (const Rest rest : {Rest::bent, Rest::bent_by_itself})
        for (std::uint64_t seed = 0; seed < 60; ++seed) {
            INFO("rest " << static_cast<int>(rest) << ", seed " << seed);
            Random random{seed};
            const swivel_chain chain = random_chain(random, rest);
            const swivel_binding bound = bind(chain);
            constexpr swivel_features features = SWIVEL_JOINTS | SWIVEL_WORLD | SWIVEL_WITH_HAND;
            Crowd crowd = crowd_of(features, 1, bound);
            Limb limb = random_limb(random, features, {bound.lengths[0], bound.lengths[1]});
            const Places places = places_of(chain, limb.parent(), rest_of(chain));
            limb.target = floats(places.wrist);
            limb.pole = floats(places.elbow);
            limb.hand = floats(places.hand);
            write_limb(crowd, 0, 0, limb);
            crowd.solve();
            const Joints got = joints_of(crowd, 0, 0), want = rest_of(chain);
            // The target's rounding, seen from a parent 5 units away, through a bend of down to 0.1.
            CHECK(distance(got.shoulder, want.shoulder) <= 1e-4);
            CHECK(distance(got.elbow, want.elbow) <= 1e-4);
            CHECK(distance(got.wrist, want.wrist) <= 1e-4);
        }
}

TEST_CASE("skeletons: with a bend off the rest pose's own the elbow still turns about one axis of the upper arm")
{
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        INFO("seed " << seed);
        Random random{seed};
        swivel_chain chain = random_chain(random, Rest::bent);
        const Vector3d tilted = vec(chain.bend).normalized() + 0.5 * hinge_of(chain);
        std::ranges::copy(floats(tilted), chain.bend);
        const swivel_binding bound = bind(chain);
        constexpr std::uint32_t count = 16;
        constexpr swivel_features features = SWIVEL_JOINTS | SWIVEL_WORLD;
        Crowd crowd = crowd_of(features, count, bound);
        std::vector<Limb> limbs;
        for (std::uint32_t n = 0; n < count; ++n) {
            limbs.push_back(random_limb(random, features, {bound.lengths[0], bound.lengths[1]}));
            write_limb(crowd, 0, n, limbs.back());
        }
        crowd.solve();
        const Vector3d axis = hinge_of(chain);
        const Quaterniond first = joints_of(crowd, 0, 0).elbow;
        for (std::uint32_t n = 0; n < count; ++n) {
            const Joints local = joints_of(crowd, 0, n);
            const Places places = places_of(chain, limbs[n].parent(), local);
            check_places(limbs[n], features, places, SWIVEL_REACHED);
            CHECK((local.elbow * first.conjugate()).vec().cross(axis).norm() <= 2e-6);
        }
    }
}

TEST_CASE("skeletons: the negated bend bends the limb the other way")
{
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        INFO("seed " << seed);
        Random random{seed};
        swivel_chain chain = random_chain(random, Rest::straight);
        constexpr swivel_features features = SWIVEL_JOINTS | SWIVEL_WORLD;
        const swivel_binding one = bind(chain);
        for (float& x : chain.bend) x = -x;
        const swivel_binding other = bind(chain);
        const swivel_group_def groups[] = {swivel::group(1, one, features), swivel::group(1, other, features)};
        Crowd crowd = crowd_with(features, groups);
        const Limb limb = random_limb(random, features, {one.lengths[0], one.lengths[1]});
        write_limb(crowd, 0, 0, limb);
        write_limb(crowd, 1, 0, limb);
        crowd.solve();
        const Joints a = joints_of(crowd, 0, 0), b = joints_of(crowd, 1, 0);
        for (const Joints& local : {a, b})
            check_places(limb, features, places_of(chain, limb.parent(), local), SWIVEL_REACHED);
        const Quaterniond rest = quat(chain.elbow_rotation).normalized();
        // The same bend from straight, in opposite senses: one undoes the other.
        CHECK(distance(a.elbow * rest.conjugate(), (b.elbow * rest.conjugate()).conjugate()) <= 2e-6);
        CHECK(distance(a.elbow, b.elbow) > 0.01);
    }
}

TEST_CASE("skeletons: a mirrored limb with mirrored goals has mirrored rotations")
{
    const auto mirror3 = [](const Float3& v) { return Float3{-v[0], v[1], v[2]}; };
    const auto mirror4 = [](const Float4& q) { return Float4{q[0], -q[1], -q[2], q[3]}; };
    const auto as3 = [](const float(&v)[3]) { return Float3{v[0], v[1], v[2]}; };
    const auto as4 = [](const float(&q)[4]) { return Float4{q[0], q[1], q[2], q[3]}; };
    const auto mirrored = [&](const Quaterniond& q) { return Quaterniond(q.w(), q.x(), -q.y(), -q.z()); };
    for (const Rest rest : {Rest::straight, Rest::bent, Rest::bent_by_itself})
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            INFO("rest " << static_cast<int>(rest) << ", seed " << seed);
            Random random{seed};
            const swivel_chain left = random_chain(random, rest);
            swivel_chain right = left;
            std::ranges::copy(mirror4(as4(left.shoulder_rotation)), right.shoulder_rotation);
            std::ranges::copy(mirror4(as4(left.elbow_rotation)), right.elbow_rotation);
            std::ranges::copy(mirror4(as4(left.wrist_rotation)), right.wrist_rotation);
            std::ranges::copy(mirror3(as3(left.elbow_offset)), right.elbow_offset);
            std::ranges::copy(mirror3(as3(left.wrist_offset)), right.wrist_offset);
            std::ranges::copy(mirror3(as3(left.bend)), right.bend);
            const swivel_binding l = bind(left), r = bind(right);
            constexpr swivel_features features = SWIVEL_JOINTS | SWIVEL_WORLD | SWIVEL_WITH_HAND;
            const swivel_group_def groups[] = {swivel::group(1, l, features), swivel::group(1, r, features)};
            Crowd crowd = crowd_with(features, groups);
            const Limb limb = random_limb(random, features, {l.lengths[0], l.lengths[1]});
            Limb other = limb;
            other.target = mirror3(limb.target);
            other.pole = mirror3(limb.pole);
            other.position = mirror3(limb.position);
            other.rotation = mirror4(limb.rotation);
            other.hand = mirror4(limb.hand);
            write_limb(crowd, 0, 0, limb);
            write_limb(crowd, 1, 0, other);
            crowd.solve();
            const Joints a = joints_of(crowd, 0, 0), b = joints_of(crowd, 1, 0);
            CHECK(distance(mirrored(a.shoulder), b.shoulder) <= 1e-5);
            CHECK(distance(mirrored(a.elbow), b.elbow) <= 1e-5);
            CHECK(distance(mirrored(a.wrist), b.wrist) <= 1e-5);
        }
}

TEST_CASE("skeletons: bad input leaves the skeleton's own rest rotations")
{
    Random random{4};
    const swivel_chain chain = random_chain(random, Rest::bent);
    Crowd crowd = crowd_of(SWIVEL_JOINTS | SWIVEL_WITH_HAND, 3, bind(chain));
    crowd.write(SWIVEL_TARGET, 0, std::vector<Float3>{{0, 0, 1}, {kInf, 0, 0}, {0, 0, 1}});
    crowd.solve();
    CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS)[1] == SWIVEL_BAD_INPUT);
    const Joints got = joints_of(crowd, 0, 1), rest = rest_of(chain);
    CHECK(distance(got.shoulder, rest.shoulder) <= 1e-7);
    CHECK(distance(got.elbow, rest.elbow) <= 1e-7);
    CHECK(distance(got.wrist, rest.wrist) <= 1e-7);
    CHECK(distance(joints_of(crowd, 0, 0).shoulder, rest.shoulder) > 1e-3);
}

TEST_CASE("a rest pose bent by more than 10 degrees shows where the limb bends to")
{
    Random random{12};
    for (const double degrees : {10.01, 45.0, 170.0}) {
        swivel_chain chain = random_chain(random, Rest::straight);
        const Vector3d hinge = hinge_of(chain), upper = vec(chain.elbow_offset);
        const Quaterniond elbow = quat(chain.elbow_rotation).normalized();
        const Vector3d fore = elbow.conjugate() * (Eigen::AngleAxisd(-degrees * kDegree, hinge) * upper);
        std::ranges::copy(floats(fore), chain.wrist_offset);
        const swivel_binding given = bind(chain);
        std::ranges::fill(chain.bend, 0.0f);
        const swivel_binding shown = bind(chain);
        CHECK(distance(quat(given.parent_from_arm), quat(shown.parent_from_arm)) <= 2e-6);
        CHECK(distance(quat(given.fore_from_arm), quat(shown.fore_from_arm)) <= 2e-6);
    }
}

TEST_CASE("a chain of an older header is read as far as it goes")
{
    Random random{13};
    swivel_chain chain = random_chain(random, Rest::bent_by_itself);
    const swivel_binding whole = bind(chain);
    std::ranges::fill(chain.bend, kNan);
    chain.size = offsetof(swivel_chain, bend);
    const swivel_binding shorter = bind(chain);
    CHECK(std::memcmp(&whole, &shorter, sizeof whole) == 0);
}

TEST_CASE("swivel_bind refuses what is not a limb, and changes nothing")
{
    Random random{9};
    const auto refuse = [&](const char* what, Rest rest, auto spoil) {
        INFO(what);
        swivel_chain chain = random_chain(random, rest);
        swivel_binding binding = swivel_default_binding();
        REQUIRE(swivel_bind(&chain, &binding) == SWIVEL_OK);
        std::memset(&binding, 0x5a, sizeof binding);
        const swivel_binding untouched = binding;
        spoil(chain);
        CHECK_REFUSED(swivel_bind(&chain, &binding), SWIVEL_INVALID_ARGUMENT);
        CHECK(std::memcmp(&binding, &untouched, sizeof binding) == 0);
    };
    const auto fill = [](auto& values, float x) { std::ranges::fill(values, x); };
    for (const float bad : {0.0f, kNan, kInf, 1e-20f, 3e38f}) {
        refuse("shoulder rotation", Rest::bent, [&](swivel_chain& c) { fill(c.shoulder_rotation, bad); });
        refuse("elbow rotation", Rest::bent, [&](swivel_chain& c) { fill(c.elbow_rotation, bad); });
        refuse("wrist rotation", Rest::bent, [&](swivel_chain& c) { fill(c.wrist_rotation, bad); });
        refuse("upper arm", Rest::bent, [&](swivel_chain& c) { fill(c.elbow_offset, bad); });
        refuse("forearm", Rest::bent, [&](swivel_chain& c) { fill(c.wrist_offset, bad); });
    }
    for (const float bad : {kNan, kInf, 3e38f}) refuse("bend", Rest::bent, [&](swivel_chain& c) { fill(c.bend, bad); });
    for (const float one : {kNan, kInf}) {
        refuse("one number of a rotation", Rest::bent, [&](swivel_chain& c) { c.wrist_rotation[1] = one; });
        refuse("one number of an offset", Rest::bent, [&](swivel_chain& c) { c.wrist_offset[2] = one; });
    }
    refuse("bend along the upper arm", Rest::bent, [](swivel_chain& c) { std::ranges::copy(c.elbow_offset, c.bend); });
    refuse("bend against the upper arm", Rest::bent,
           [](swivel_chain& c) { std::ranges::copy(floats(Vector3d(-vec(c.elbow_offset))), c.bend); });
    const auto set_forearm = [](swivel_chain& c, const Vector3d& in_upper_axes) {
        const Quaterniond elbow = quat(c.elbow_rotation).normalized();
        std::ranges::copy(floats(Vector3d(elbow.conjugate() * in_upper_axes)), c.wrist_offset);
    };
    refuse("forearm along the axis that it turns about", Rest::bent,
           [&](swivel_chain& c) { set_forearm(c, hinge_of(c)); });
    refuse("straight without a bend", Rest::straight, [&](swivel_chain& c) { fill(c.bend, 0); });
    refuse("folded without a bend", Rest::straight, [&](swivel_chain& c) {
        set_forearm(c, -vec(c.elbow_offset));
        fill(c.bend, 0);
    });
    for (const double degrees : {0.5, 9.99, -9.99})
        refuse("nearly straight without a bend", Rest::straight, [&](swivel_chain& c) {
            set_forearm(c, Eigen::AngleAxisd(degrees * kDegree, hinge_of(c)) * vec(c.elbow_offset));
            fill(c.bend, 0);
        });
    refuse("of no size", Rest::bent, [](swivel_chain& c) { c.size = 0; });
    refuse("of a later header", Rest::bent, [](swivel_chain& c) { c.size += 8; });

    swivel_chain chain = random_chain(random, Rest::bent);
    swivel_binding binding = swivel_default_binding();
    CHECK_REFUSED(swivel_bind(nullptr, &binding), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_bind(&chain, nullptr), SWIVEL_INVALID_ARGUMENT);
    CHECK(swivel_bind(&chain, &binding) == SWIVEL_OK);
    for (const float(&q)[4] :
         {std::cref(binding.parent_from_arm), std::cref(binding.upper_from_arm), std::cref(binding.fore_from_arm),
          std::cref(binding.shoulder_rest), std::cref(binding.elbow_rest), std::cref(binding.wrist_rest)})
        CHECK(is_unit({q[0], q[1], q[2], q[3]}));
}
