// SPDX-License-Identifier: MIT
//
// The promise: swivel_compare() names the mistake for which a pose and the caller's places disagree, in the words of
// approved/mistakes.txt, and no mistake where they agree. The places are of Eigen's forward kinematics.
#include <catch2/catch.hpp>

#include <cstring>
#include <functional>
#include <map>
#include <numbers>
#include <regex>

#include "tests/allocation_count.h"
#include "tests/approved_texts.h"
#include "tests/body_crowd.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr int kRigs = 200;

using Places = std::array<std::array<double, 3>, 3>;

// Gives every limb a clavicle of its own.
void add_clavicles(Random& random, BodySkeleton& skeleton)
{
    for (const BodyLimbJoints& limb : skeleton.limbs) {
        skeleton.parents.push_back(skeleton.parents[limb.shoulder]);
        skeleton.rotations.push_back(floats(random.rotation()));
        skeleton.translations.push_back(floats(random.vector(0.05, 0.3)));
        skeleton.parents[limb.shoulder] = static_cast<std::int32_t>(skeleton.size() - 1);
    }
}
BodySkeleton clavicle_skeleton(Random& random)
{
    BodySkeleton skeleton =
        random_body_skeleton(random, {1 + random.below(5), 2 + random.below(2), random.below(3), random.below(2) == 0});
    add_clavicles(random, skeleton);
    return skeleton;
}

// What a rig is like; the rest is random.
struct RigWish {
    swivel_pose_form form = SWIVEL_ROTATIONS;
    bool in_body = false;
    // Translations and scales are in the pose, and those of bones as at rest or not.
    bool translates = false, stretches = false, scales = false;
};

// Bodies of a crowd, and the pose of one limb that is looked at.
struct Rig {
    BodySkeleton skeleton;
    std::vector<Body> bodies;
    PoseLayout layout;
    PoseBuffer poses;
    Crowd crowd;
    std::uint32_t group, body;
    swivel_pose pose;
    std::vector<std::array<double, 3>> far_roots;  // if they are doubles

    Rig(Random& random, const RigWish& wish)
        : skeleton(clavicle_skeleton(random)),
          bodies(random_bodies(random, wish)),
          layout{wish.form, wish.translates, wish.scales, true, random.below(60), wish.in_body ? &skeleton : nullptr},
          poses(layout, bodies),
          crowd(body_crowd(skeleton, SWIVEL_POLE_INCOMING, static_cast<std::uint32_t>(bodies.size()))),
          group(random.below(static_cast<std::uint32_t>(skeleton.limbs.size()))),
          body(random.below(static_cast<std::uint32_t>(bodies.size()))),
          pose(poses.view())
    {
        if (random.below(3) != 0) return;
        for (const Body& each : bodies) {
            const Vector3d far = vec(each.root_position) + 1e6 * random.direction();
            far_roots.push_back({far.x(), far.y(), far.z()});
        }
        pose.root_is_double = 1;
        pose.root_position = {far_roots.data(), sizeof far_roots[0]};
    }

    const BodyLimbJoints& limb() const { return skeleton.limbs[group]; }
    std::uint32_t clavicle() const { return static_cast<std::uint32_t>(skeleton.parents[limb().shoulder]); }
    Vector3d root() const
    {
        return far_roots.empty() ? Vector3d(vec(bodies[body].root_position)) : Vector3d(far_roots[body].data());
    }
    // In the world.
    Vector3d place(std::uint32_t joint) const { return root() + joints_at(skeleton, bodies[body])[joint].place; }
    Places places(const BodyLimbJoints& of) const { return places(of.shoulder, of.elbow, of.wrist); }
    Places places(std::uint32_t shoulder, std::uint32_t elbow, std::uint32_t wrist) const
    {
        return {numbers(place(shoulder)), numbers(place(elbow)), numbers(place(wrist))};
    }
    static std::array<double, 3> numbers(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
    double length() const
    {
        return (place(limb().elbow) - place(limb().shoulder)).norm() +
               (place(limb().wrist) - place(limb().elbow)).norm();
    }
    Crowd::Comparison compare(const Places& of) const { return crowd.compare(group, body, pose, of[0], of[1], of[2]); }
    Crowd::Comparison compare() const { return compare(places(limb())); }

    // 1 where an elbow bends just as the limb's bend says, in the shoulder's frame, and -1 the other way.
    double bend_sense(const Body& made, const BodyLimbJoints& limb) const
    {
        Body rest;
        rest.rotations = skeleton.rotations, rest.translations = skeleton.translations;
        rest.scales.assign(skeleton.size(), Float3{1, 1, 1});
        const std::vector<JointAt> at = joints_at(skeleton, made), at_rest = joints_at(skeleton, rest);
        const Vector3d upper = at[limb.elbow].place - at[limb.shoulder].place,
                       fore = at[limb.wrist].place - at[limb.elbow].place,
                       bone = at_rest[limb.shoulder].rotation.conjugate() *
                              (at_rest[limb.elbow].place - at_rest[limb.shoulder].place);
        return upper.cross(fore).normalized().dot(at[limb.shoulder].rotation * bone.cross(vec(limb.bend)).normalized());
    }

    // Calls change(floats) for each joint's rotation or matrix of all bodies.
    void change_joints(const std::function<void(float*)>& change)
    {
        for (std::size_t n = 0; n < bodies.size(); ++n)
            for (std::uint32_t joint = 0; joint < skeleton.size(); ++joint)
                change_at(static_cast<char*>(pose.rotations.data) + n * pose.rotations.body_stride +
                              joint * pose.rotations.joint_stride,
                          pose.form == SWIVEL_ROTATIONS        ? 4
                          : pose.form == SWIVEL_MATRIX_COLUMNS ? 16
                                                               : 12,
                          change);
    }
    void change_roots(const std::function<void(float*)>& change)
    {
        for (std::size_t n = 0; n < bodies.size(); ++n)
            change_at(static_cast<char*>(const_cast<void*>(pose.root_rotation.data)) + n * pose.root_rotation.stride, 4,
                      change);
    }

private:
    static void change_at(char* at, std::size_t count, const std::function<void(float*)>& change)
    {
        float values[16];
        std::memcpy(values, at, count * sizeof(float));
        change(values);
        std::memcpy(at, values, count * sizeof(float));
    }
    // Limbs are about as long as at rest, and bend as there.
    bool is_plausible(const Body& made) const
    {
        Body rest = made;
        rest.translations = skeleton.translations;
        const std::vector<JointAt> at = joints_at(skeleton, made), at_rest = joints_at(skeleton, rest);
        const auto length = [](const std::vector<JointAt>& joints, const BodyLimbJoints& limb) {
            return (joints[limb.elbow].place - joints[limb.shoulder].place).norm() +
                   (joints[limb.wrist].place - joints[limb.elbow].place).norm();
        };
        return std::ranges::all_of(skeleton.limbs, [&](const BodyLimbJoints& limb) {
            const double ratio = length(at, limb) / length(at_rest, limb);
            return ratio > 0.6 && ratio < 1.7 && bend_sense(made, limb) > 0;
        });
    }
    std::vector<Body> random_bodies(Random& random, const RigWish& wish) const
    {
        // A scale may be by chance that of feet to metres, or of inches to centimetres. Such a body says nothing.
        const auto is_unit = [](double scale) {
            const auto is_near = [&](double unit) { return std::fabs(std::log(scale / unit)) < 0.01; };
            return is_near(3.28084) || is_near(1 / 3.28084) || is_near(2.54) || is_near(1 / 2.54);
        };
        std::vector<Body> made;
        while (made.size() < 3) {
            made.push_back(random_body(random, skeleton, {wish.translates && wish.stretches, wish.scales, true, 2.5}));
            if (is_unit(double{made.back().root_scale}) || !is_plausible(made.back())) made.pop_back();
        }
        return made;
    }
};

Places moved(const Places& places, const std::function<Vector3d(const Vector3d&)>& move)
{
    Places to;
    for (std::size_t n = 0; n < 3; ++n) to[n] = Rig::numbers(move(Vector3d(places[n].data())));
    return to;
}

void w_first(float* q) { std::rotate(q, q + 3, q + 4); }
void conjugate(float* q)
{
    for (int n = 0; n < 3; ++n) q[n] = -q[n];
}

// Poses of quaternions whose rotations show in places.
RigWish quaternion_wish(Random& random)
{
    RigWish wish;
    wish.in_body = random.below(2) == 0;
    wish.translates = !wish.in_body && random.below(2) == 0, wish.stretches = true;
    wish.scales = random.below(2) == 0;
    return wish;
}
RigWish matrix_wish(Random& random, swivel_pose_form form)
{
    return {form, random.below(2) == 0, true, true, random.below(2) == 0};
}
RigWish any_wish(Random& random)
{
    if (random.below(2) == 0) return matrix_wish(random, static_cast<swivel_pose_form>(1 + random.below(3)));
    RigWish wish = quaternion_wish(random);
    if (wish.in_body) wish.translates = random.below(2) == 0, wish.stretches = false;
    return wish;
}

template <class Try>
void for_each_rig(int count, const Try& attempt)
{
    for (int seed = 0; seed < count; ++seed) {
        INFO("rig " << seed);
        Random random{static_cast<std::uint64_t>(seed)};
        attempt(random);
    }
}

// A text as far as it is the same for all rigs: # for each number but a unit's factor, and no more than the mistake.
std::string words_of(const std::string& text)
{
    static const std::regex number("\\b-?[0-9]+([.][0-9]+)?(e[+-]?[0-9]+)?\\b");
    const std::string words =
        text.substr(0, std::min(text.find(" With that the three"), text.find(" With each of these")));
    const std::size_t factor = std::min(words.size(), words.find("the factor is"));
    return std::regex_replace(words.substr(0, factor), number, "#") + words.substr(factor);
}

// Moves places as they are from the root's.
template <class Move>
void move(const Rig& rig, Places& places, const Move& from_root)
{
    places = moved(places, [&](const Vector3d& v) -> Vector3d { return from_root(Vector3d(v - rig.root())); });
}
Quaterniond root_turn(const Rig& rig) { return quat(rig.bodies[rig.body].root_rotation).normalized(); }
double root_scale(const Rig& rig) { return double{rig.bodies[rig.body].root_scale}; }

// From where floats tell nothing of the root to where it is seen.
void come_near(Rig& rig, Places& places)
{
    rig.far_roots.clear();
    rig.pose = rig.poses.view();
    rig.bodies[rig.body].root_position = {1, -2, 3};
    rig.poses.write(rig.body, rig.bodies[rig.body]);
    places = rig.places(rig.limb());
}
// Makes the crowd anew with another skeleton.
void bind_to(Rig& rig, const BodySkeleton& skeleton)
{
    rig.crowd = body_crowd(skeleton, SWIVEL_POLE_INCOMING, static_cast<std::uint32_t>(rig.bodies.size()));
}
void end_matrix(float* m) { m[3] = m[7] = m[11] = 0, m[15] = 1; }
void transpose(float* values, int size)
{
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < row; ++column) std::swap(values[4 * row + column], values[4 * column + row]);
}
void transpose3(float* values) { transpose(values, 3); }
void transpose4(float* values) { end_matrix(values), transpose(values, 4); }

RigWish in_root(Random& random) { return {SWIVEL_ROTATIONS, true, true, false, random.below(2) == 0}; }
RigWish rows_in_root(Random& random) { return {SWIVEL_MATRIX_ROWS, true, true, false, random.below(2) == 0}; }
RigWish stretched(Random& random) { return {SWIVEL_ROTATIONS, false, true, true, random.below(2) == 0}; }
RigWish scaled(Random&) { return {SWIVEL_ROTATIONS, false, true, true, true}; }
RigWish untranslated(Random&) { return {}; }
RigWish rows(Random& random) { return matrix_wish(random, SWIVEL_MATRIX_ROWS); }
RigWish local_rows(Random& random)
{
    RigWish wish = rows(random);
    wish.in_body = false;  // where places depend on rotations
    return wish;
}
RigWish columns(Random& random) { return matrix_wish(random, SWIVEL_MATRIX_COLUMNS); }
RigWish columns3(Random& random) { return matrix_wish(random, SWIVEL_MATRIX_COLUMNS3); }
RigWish unstretched(Random& random)
{
    RigWish wish = columns3(random);
    wish.stretches = false;
    return wish;
}
template <bool is_in_body>
RigWish translated(Random& random)
{
    RigWish wish = any_wish(random);
    wish.form = random.below(2) == 0 ? SWIVEL_ROTATIONS : SWIVEL_MATRIX_COLUMNS3;
    wish.translates = true, wish.in_body = is_in_body;
    return wish;
}

using V = Vector3d;

struct Mistake {
    const char* name;
    RigWish (*wish)(Random& random);
    void (*make)(Rig& rig, Places& places);  // the places are right before
};
const Mistake mistakes[] = {
    {"joints with w first", quaternion_wish, [](Rig& r, Places&) { r.change_joints(w_first); }},
    {"root with w first", quaternion_wish, [](Rig& r, Places&) { r.change_roots(w_first); }},
    {"all with w first", quaternion_wish, [](Rig& r, Places&) { r.change_joints(w_first), r.change_roots(w_first); }},
    {"joints inverse", quaternion_wish, [](Rig& r, Places&) { r.change_joints(conjugate); }},
    {"root inverse", quaternion_wish, [](Rig& r, Places&) { r.change_roots(conjugate); }},
    {"all inverse", quaternion_wish, [](Rig& r, Places&) { r.change_joints(conjugate), r.change_roots(conjugate); }},
    {"joints with w first, from the root", in_root, [](Rig& r, Places&) { r.change_joints(w_first); }},
    {"joints inverse, from the root", in_root, [](Rig& r, Places&) { r.change_joints(conjugate); }},
    {"matrices transposed, from the root", rows_in_root, [](Rig& r, Places&) { r.change_joints(transpose3); }},
    {"matrices transposed", local_rows, [](Rig& r, Places&) { r.change_joints(transpose3); }},
    {"4 x 4 columns as rows", columns,
     [](Rig& r, Places&) { r.change_joints(end_matrix), r.pose.form = SWIVEL_MATRIX_ROWS; }},
    {"4 x 4 columns as 3 x 4", columns,
     [](Rig& r, Places&) { r.change_joints(end_matrix), r.pose.form = SWIVEL_MATRIX_COLUMNS3; }},
    {"rows as 3 x 4 columns", rows, [](Rig& r, Places&) { r.pose.form = SWIVEL_MATRIX_COLUMNS3; }},
    {"3 x 4 columns as rows", columns3, [](Rig& r, Places&) { r.pose.form = SWIVEL_MATRIX_ROWS; }},
    {"4 x 4 rows as columns", columns, [](Rig& r, Places&) { r.change_joints(transpose4); }},
    {"centimetres for metres", any_wish,
     [](Rig&, Places& p) { p = moved(p, [](const V& v) -> V { return 100 * v; }); }},
    {"metres for centimetres", any_wish,
     [](Rig&, Places& p) { p = moved(p, [](const V& v) -> V { return 0.01 * v; }); }},
    {"millimetres for metres", any_wish,
     [](Rig&, Places& p) { p = moved(p, [](const V& v) -> V { return 1000 * v; }); }},
    {"centimetres for inches", any_wish,
     [](Rig&, Places& p) { p = moved(p, [](const V& v) -> V { return 2.54 * v; }); }},
    {"metres for inches", any_wish, [](Rig&, Places& p) { p = moved(p, [](const V& v) -> V { return 0.0254 * v; }); }},
    {"translations in another unit", stretched,
     [](Rig& r, Places& p) { move(r, p, [&](const V& v) -> V { return r.root() + 100 * v; }); }},
    {"skeleton in another unit", untranslated,
     [](Rig& r, Places& p) { move(r, p, [&](const V& v) -> V { return r.root() + 100 * v; }); }},
    {"root's place in another unit", any_wish,
     [](Rig& r, Places& p) { move(r, p, [&](const V& v) -> V { return 100 * r.root() + v; }); }},
    {"no root's place", any_wish, [](Rig& r, Places& p) { move(r, p, [](const V& v) -> V { return v; }); }},
    {"root's place twice", any_wish,
     [](Rig& r, Places& p) { move(r, p, [&](const V& v) -> V { return 2 * r.root() + v; }); }},
    {"no root's rotation", any_wish,
     [](Rig& r, Places& p) { move(r, p, [&](const V& v) -> V { return r.root() + root_turn(r).conjugate() * v; }); }},
    {"root's rotation twice", any_wish,
     [](Rig& r, Places& p) { move(r, p, [&](const V& v) -> V { return r.root() + root_turn(r) * v; }); }},
    {"no root's scale", any_wish,
     [](Rig& r, Places& p) { move(r, p, [&](const V& v) -> V { return r.root() + v / root_scale(r); }); }},
    {"root's scale twice", any_wish,
     [](Rig& r, Places& p) { move(r, p, [&](const V& v) -> V { return r.root() + root_scale(r) * v; }); }},
    {"in the root's frame", any_wish,
     [](Rig& r, Places& p) {
         move(r, p, [&](const V& v) -> V { return root_turn(r).conjugate() * v / root_scale(r); });
     }},
    {"y and z exchanged", any_wish,
     [](Rig&, Places& p) { p = moved(p, [](const V& v) -> V { return V(v.x(), -v.z(), v.y()); }); }},
    {"x mirrored", any_wish,
     [](Rig&, Places& p) { p = moved(p, [](const V& v) -> V { return V(-v.x(), v.y(), v.z()); }); }},
    {"z mirrored", any_wish,
     [](Rig&, Places& p) { p = moved(p, [](const V& v) -> V { return V(v.x(), v.y(), -v.z()); }); }},
    {"bones as at rest", stretched,
     [](Rig& r, Places& p) { r.bodies[r.body].translations = r.skeleton.translations, p = r.places(r.limb()); }},
    {"joints without scales", scaled,
     [](Rig& r, Places& p) {
         r.bodies[r.body].scales.assign(r.skeleton.size(), Float3{1, 1, 1});
         p = r.places(r.limb());
     }},
    {"in their parents' frames, said to be the root's", translated<false>,
     [](Rig& r, Places&) { r.pose.space = SWIVEL_IN_BODY; }},
    {"in the root's frame, said to be their parents'", translated<true>,
     [](Rig& r, Places&) { r.pose.space = SWIVEL_LOCAL; }},
    {"another group's limb", any_wish,
     [](Rig& r, Places& p) { p = r.places(r.skeleton.limbs[(r.group + 1) % r.skeleton.limbs.size()]); }},
    {"a shoulder too high", any_wish,
     [](Rig& r, Places& p) { p = r.places(r.clavicle(), r.limb().elbow, r.limb().wrist); }},
    {"a shoulder too low", any_wish,
     [](Rig& r, Places& p) {
         const std::int32_t between = r.skeleton.parents[r.limb().elbow];
         p = r.places(static_cast<std::uint32_t>(between), r.limb().elbow, r.limb().wrist);
     }},
    {"a crowd's skeleton in another unit", unstretched,
     [](Rig& r, Places&) {
         BodySkeleton large = r.skeleton;
         for (Float3& bone : large.translations) bone = floats(Vector3d(100 * vec(bone)));
         bind_to(r, large);
     }},
    {"three joints too high", any_wish,
     [](Rig& r, Places&) {
         BodySkeleton high = r.skeleton;
         BodyLimbJoints& named = high.limbs[r.group];
         named = {r.clavicle(), r.limb().shoulder, r.limb().elbow, named.bend, {}};
         bind_to(r, high);
     }},
    {"root's rotation not given", any_wish, [](Rig& r, Places&) { r.pose.root_rotation = {}; }},
    {"root's place not given", any_wish, [](Rig& r, Places& p) { come_near(r, p), r.pose.root_position = {}; }},
    {"nothing of the root given", any_wish,
     [](Rig& r, Places& p) { come_near(r, p), r.pose.root_position = r.pose.root_rotation = {}; }},
};

}  // namespace

TEST_CASE("each mistake is named as approved, whatever the rig")
{
    ApprovedTexts texts("mistakes.txt");
    texts.scene("what is said of a mistake, with # for numbers");
    for (const auto& [name, wish, make] : mistakes) {
        INFO(name);
        std::map<std::string, int> said;
        int shown = 0, agreed = 0;
        bool moves = false;  // places, and not the pose
        for_each_rig(kRigs, [&](Random& random) {
            Rig rig(random, wish(random));
            const Places right = rig.places(rig.limb());
            Places places = right;
            make(rig, places);
            const auto comparison = rig.compare(places);
            moves = moves || places != right;
            REQUIRE((!comparison.agrees || places == right));
            ++(comparison.agrees ? agreed : shown);
            if (!comparison.agrees) ++said[words_of(comparison.text)];
        });
        CHECK(shown > kRigs / 4);
        CHECK((agreed == 0 || moves));
        for (const auto& [words, count] : said)
            if (50 * count > shown) texts.line(name, words);  // by chance a rig shows another mistake, too
    }
    texts.compare();
}

TEST_CASE("a right pose agrees, and no mistake is named")
{
    for_each_rig(kRigs, [](Random& random) {
        const Rig rig(random, any_wish(random));
        const auto said = rig.compare();
        INFO(said.text);
        REQUIRE(said.agrees);
        REQUIRE(said.text.starts_with("The pose agrees"));
    });
}

TEST_CASE("joints of another group, or too high, are named by their numbers")
{
    const Rig rig = [] {
        Random random{2};
        return Rig(random, any_wish(random));
    }();
    const auto other = static_cast<std::uint32_t>((rig.group + 1) % rig.skeleton.limbs.size());
    const BodyLimbJoints &limb = rig.limb(), &others = rig.skeleton.limbs[other];
    const auto n = [](std::uint32_t number) { return std::to_string(number); };
    CHECK_THAT(
        rig.compare(rig.places(others)).text,
        Catch::Contains("group " + n(other) + "'s limb, joints " + n(others.shoulder) + ", " + n(others.elbow) +
                        " and " + n(others.wrist) + ", but group " + n(rig.group) + " has joints " + n(limb.shoulder)));
    CHECK_THAT(
        rig.compare(rig.places(rig.clavicle(), limb.elbow, limb.wrist)).text,
        Catch::Contains("is joint " + n(rig.clavicle()) + "'s, 1 too high; the group has joint " + n(limb.shoulder)));
}

TEST_CASE("a joint that no mistake explains is named, with its way")
{
    for_each_rig(kRigs, [](Random& random) {
        Rig rig(random, any_wish(random));
        Places places = rig.places(rig.limb());
        const std::size_t first = random.below(3);
        constexpr const char* names[] = {"shoulder", "elbow", "wrist"};
        Vector3d way = Vector3d::Zero();
        for (std::size_t n = first; n < 3; ++n) {
            const Vector3d off = rig.length() * random.vector(0.05, 0.5);
            if (n == first) way = off;
            places[n] = Rig::numbers(Vector3d(places[n].data()) + off);
        }
        const auto said = rig.compare(places);
        INFO(said.text);
        REQUIRE(!said.agrees);
        REQUIRE(said.text.starts_with("No usual mistake explains it. The first joint that is off is the " +
                                      std::string(names[first]) + ", joint "));
        REQUIRE(number_after(said.text, "your place is ") == Approx(way.norm()).epsilon(2e-3));
        REQUIRE(number_after(said.text, "in the direction (") == Approx(way.normalized().x()).margin(1e-2));
    });
}

TEST_CASE("places agree up to a thousandth of the limb's length")
{
    for_each_rig(100, [](Random& random) {
        const Rig rig(random, any_wish(random));
        for (const double share : {0.9, 1.1}) {
            Places places = rig.places(rig.limb());
            const Vector3d off = share * 1e-3 * rig.length() * random.direction();
            places[1] = Rig::numbers(Vector3d(places[1].data()) + off);
            const auto said = rig.compare(places);
            INFO(said.text);
            REQUIRE(said.agrees == (share < 1));
        }
    });
}

TEST_CASE("far from the origin, places agree up to the rounding of floats")
{
    for_each_rig(100, [](Random& random) {
        Rig rig(random, {});
        rig.far_roots.clear(), rig.pose = rig.poses.view();
        Body& body = rig.bodies[rig.body];
        body.root_position = floats(Vector3d(1e6 * random.direction())), body.root_scale = 1;
        rig.poses.write(rig.body, body);
        const Places rounded =
            moved(rig.places(rig.limb()), [](const Vector3d& v) { return Vector3d(v.cast<float>().cast<double>()); });
        const auto said = rig.compare(rounded);
        INFO(said.text);
        REQUIRE(said.agrees);
    });
}

TEST_CASE("what is known of an unknown mistake is said")
{
    Random random{7};
    Rig rig(random, {});
    const Places places = rig.places(rig.limb());
    const auto text = [&](const std::function<Vector3d(const Vector3d&)>& move) {
        return rig.compare(moved(places, move)).text;
    };
    const auto has = [](const std::string& all, const char* words) { return all.find(words) != std::string::npos; };
    CHECK(has(text([](const Vector3d& v) { return Vector3d(v + Vector3d(1, 2, 3)); }), "Look at root_position"));
    const Vector3d root = rig.root();
    CHECK(number_after(text([&](const Vector3d& v) -> Vector3d { return Vector3d(root + 1.5 * (v - root)); }),
                       "The places are ") == Approx(1.5));
    const Quaterniond turn = random.rotation();
    CHECK(
        has(text([&](const Vector3d& v) -> Vector3d { return Vector3d(turn * v); }), "The limb's own shape is right"));
    Places longer = places;
    longer[2] =
        Rig::numbers(Vector3d(places[1].data()) + 1.7 * (Vector3d(places[2].data()) - Vector3d(places[1].data())));
    const std::string says = rig.compare(longer).text;
    CHECK(number_after(says, "Your forearm is ") == Approx(1.7 * number_after(says, "the pose's ")).epsilon(1e-3));
    rig.change_joints([](float* q) { q[0] = q[1] = q[2] = q[3] = 0; });
    CHECK(has(rig.compare(places).text, "is a quaternion of length 0."));
}

TEST_CASE("a time in milliseconds is named, though the places agree")
{
    Random random{1};
    Rig rig(random, {});
    float time = 0.0167f;
    rig.pose.time = {&time, 0};
    CHECK(rig.compare().agrees);
    time = 1;
    CHECK(rig.compare().agrees);
    time = 16.7f;
    CHECK(!rig.compare().agrees);
    CHECK_THAT(rig.compare().text, Catch::Contains("The pose's time is 16.7, which are that many seconds"));
}

TEST_CASE("an elbow bent against its bend is named, though the places agree")
{
    for_each_rig(kRigs / 2, [](Random& random) {
        Rig rig(random, any_wish(random));
        BodySkeleton other = rig.skeleton;
        for (float& number : other.limbs[rig.group].bend) number = -number;
        rig.crowd = body_crowd(other, SWIVEL_POLE_INCOMING, static_cast<std::uint32_t>(rig.bodies.size()));
        const Vector3d upper = rig.place(rig.limb().elbow) - rig.place(rig.limb().shoulder),
                       fore = rig.place(rig.limb().wrist) - rig.place(rig.limb().elbow);
        const double bend = angle_between(upper, fore);
        if (bend < 0.4 || bend > 3.1 || rig.bend_sense(rig.bodies[rig.body], rig.limb()) < 0.05) return;
        const auto said = rig.compare();
        INFO(said.text);
        REQUIRE(!said.agrees);
        REQUIRE(number_after(said.text, "is bent by ") == Approx(bend * 180 / std::numbers::pi).epsilon(1e-2));
    });
}

TEST_CASE("a root in floats for doubles, or in doubles for floats, is named")
{
    int doubles = 0, floats = 0;
    for_each_rig(kRigs / 2, [&](Random& random) {
        Rig rig(random, any_wish(random));
        const bool is_double = rig.pose.root_is_double;
        if (!is_double && rig.pose.root_position.stride < 3 * sizeof(double)) return;
        if (is_double && rig.body + 1 == rig.bodies.size()) return;  // it may not read so far
        const Places places = rig.places(rig.limb());
        rig.pose.root_is_double = !is_double;
        REQUIRE_THAT(rig.compare(places).text,
                     Catch::Contains(is_double ? "root_position is in doubles, but it is read as floats"
                                               : "root_position is in floats, but root_is_double says doubles"));
        ++(is_double ? doubles : floats);
    });
    CHECK(std::min(doubles, floats) > 5);
}

TEST_CASE("a pose that is read at wrong strides is named")
{
    Random random{2};
    Rig rig(random, {});
    rig.pose.rotations.joint_stride += sizeof(float);
    const Places places = rig.places(rig.limb());
    const auto said = rig.crowd.compare(rig.group, 0, rig.pose, places[0], places[1], places[2]);
    INFO(said.text);
    CHECK(!said.agrees);
    CHECK(said.text.find("look at its strides and offsets") != std::string::npos);
}

TEST_CASE("two mistakes that fit alike are both named")
{
    BodySkeleton skeleton;  // bones along x, turned about z: the inverse turns mirror it in y
    skeleton.parents = {-1, 0, 1};
    skeleton.rotations.assign(3, Float4{0, 0, 0, 1});
    skeleton.translations = {{0, 0, 0}, {0.3f, 0, 0}, {0.25f, 0, 0}};
    skeleton.limbs = {{0, 1, 2, {0, 1, 0}, {}}};
    const Crowd crowd = body_crowd(skeleton, SWIVEL_POLE_INCOMING, 1);
    Body body;
    body.rotations = {{0, 0, 0.6f, 0.8f}, {0, 0, 0.28f, 0.96f}, {0, 0, 0, 1}};
    body.translations = skeleton.translations;
    body.scales.assign(3, Float3{1, 1, 1});
    PoseBuffer poses({}, {body});
    const swivel_pose pose = poses.view();
    const auto at = joints_at(skeleton, body);
    Places places;
    for (std::size_t n = 0; n < 3; ++n) places[n] = {at[n].place.x(), -at[n].place.y(), at[n].place.z()};
    const auto said = crowd.compare(0, 0, pose, places[0], places[1], places[2]);
    INFO(said.text);
    CHECK(!said.agrees);
    CHECK(said.text.starts_with("The pose's joint rotations are the inverse ones"));
    CHECK(said.text.find(" Or: The places are mirrored") != std::string::npos);
    CHECK(said.text.find("With each of these the three places agree") != std::string::npos);
}

TEST_CASE("comparing a pose needs no memory, and keeps to the room for its text")
{
    Random random{5};
    Rig rig(random, quaternion_wish(random));
    rig.pose.time = {}, rig.change_joints(w_first);
    const Places places = rig.places(rig.limb());
    const std::string whole = rig.compare(places).text;
    std::vector<char> room(whole.size() + 1);
    const swivel_crowd* const crowd = rig.crowd.get();
    const double* const elbow = places[1].data();
    for (std::size_t size = 1; size <= room.size(); ++size) {
        const auto before = allocation_count();
        REQUIRE(swivel_compare(crowd, rig.group, rig.body, &rig.pose, places[0].data(), elbow, places[2].data(),
                               room.data(), size, nullptr) == SWIVEL_OK);
        REQUIRE(allocation_count() == before);
        std::string wanted = whole.substr(0, size - 1);
        if (size < room.size()) wanted.replace(wanted.size() - std::min<std::size_t>(3, wanted.size()), 3, "...");
        if (size < 4) wanted = std::string(size - 1, '.');
        REQUIRE(std::string(room.data()) == wanted);
    }
}
