// SPDX-License-Identifier: MIT
//
// The promise: swivel_compare() names the mistake for which a pose and the caller's places disagree, in the words of
// approved/mistakes.txt, and no mistake where they agree. The places are of Eigen's forward kinematics.
#include <catch2/catch.hpp>

#include <functional>
#include <map>
#include <numbers>
#include <regex>

#include "tests/allocation_count.h"
#include "tests/approved_texts.h"
#include "tests/compared_rig.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr int kRigs = 200;

// Whether a kind of rig shows a mistake.
using Shows = bool (*)(const RigKind& kind);
bool any(const RigKind&) { return true; }
bool plain(const RigKind& k) { return !k.in_body && !k.translates && !k.scales; }
bool turns(const RigKind& k) { return !k.has_matrices() && !(k.in_body && k.translates); }  // in places
bool stretched(const RigKind& k) { return !k.has_matrices() && k.stretches; }
bool scaled(const RigKind& k) { return stretched(k) && k.scales; }
bool local(const RigKind& k) { return k.translates && !k.in_body; }
bool in_root(const RigKind& k) { return k.translates && k.in_body; }
bool turned_in_root(const RigKind& k) { return in_root(k) && !k.has_matrices(); }
bool rows(const RigKind& k) { return k.form == SWIVEL_MATRIX_ROWS; }
bool rows_in_root(const RigKind& k) { return rows(k) && k.in_body && !k.stretches; }
bool local_rows(const RigKind& k) { return rows(k) && !k.in_body; }
bool columns(const RigKind& k) { return k.form == SWIVEL_MATRIX_COLUMNS; }
bool columns3(const RigKind& k) { return k.form == SWIVEL_MATRIX_COLUMNS3; }
bool unstretched(const RigKind& k) { return columns3(k) && !k.stretches; }

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
    static const std::regex number("-?\\b[0-9]+([.][0-9]+)?(e[+-]?[0-9]+)?\\b");
    const std::string words =
        text.substr(0, std::min(text.find(" With that the three"), text.find(" With each of these")));
    const std::size_t factor = std::min(words.size(), words.find("the factor is"));
    return std::regex_replace(words.substr(0, factor), number, "#") + words.substr(factor);
}

// ---- ways to make a mistake: the places are right before

using V = Vector3d;
using Make = std::function<void(Rig& rig, LimbPlaces& places)>;

// The places are elsewhere: where(rig, place).
template <class Where>
Make placed(const Where& where)
{
    return [where](Rig& rig, LimbPlaces& places) {
        for (auto& place : places) place = Rig::numbers(where(rig, V(place.data())));
    };
}
Make times(double factor)
{
    return placed([factor](const Rig&, const V& v) -> V { return factor * v; });
}
Make times_from_root(double factor)
{
    return placed([factor](const Rig& r, const V& v) -> V { return r.root() + factor * (v - r.root()); });
}
// The root's place so often; its rotation and scale are there once more, or are missing (-1).
Make with_root(double places, int turns, int scales)
{
    return placed([=](const Rig& r, const V& v) -> V {
        const Quaterniond turn = turns > 0   ? r.root_turn()
                                 : turns < 0 ? r.root_turn().conjugate()
                                             : Quaterniond::Identity();
        return places * r.root() + std::pow(r.root_scale(), scales) * (turn * (v - r.root()));
    });
}
// The rotations or matrices of joints, of the root, or of all, are other ones.
enum class Which { joints, root, all };
Make turned(Which which, void (*change)(float*))
{
    return [=](Rig& rig, LimbPlaces&) {
        if (which != Which::root) rig.change_joints(change);
        if (which != Which::joints) rig.change_roots(change);
    };
}
void w_first(float* q) { std::rotate(q, q + 3, q + 4); }
void conjugate(float* q)
{
    for (int n = 0; n < 3; ++n) q[n] = -q[n];
}
void end_matrix(float* m) { m[3] = m[7] = m[11] = 0, m[15] = 1; }
void transpose(float* values, int size)
{
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < row; ++column) std::swap(values[4 * row + column], values[4 * column + row]);
}
void transpose3(float* values) { transpose(values, 3); }
void transpose4(float* values) { end_matrix(values), transpose(values, 4); }
Make said_to_be(swivel_pose_form form)
{
    return [form](Rig& rig, LimbPlaces&) {
        if (rig.pose.form == SWIVEL_MATRIX_COLUMNS) rig.change_joints(end_matrix);
        rig.pose.form = form;
    };
}
Make said_to_be(swivel_pose_space space)
{
    return [space](Rig& rig, LimbPlaces&) { rig.pose.space = space; };
}
// The root comes from where floats tell nothing of it to where it is seen, and the pose does not give it.
Make without_root(bool has_place, bool has_turn)
{
    return [=](Rig& rig, LimbPlaces& places) {
        if (!has_place) {
            rig.bodies[rig.body].root_position = {1, -2, 3};
            rig.poses.write(rig.body, rig.bodies[rig.body]);
            rig.view_poses();
            places = rig.places();
            rig.pose.root_position = {};
        }
        if (!has_turn) rig.pose.root_rotation = {};
    };
}

struct Mistake {
    const char* name;
    Shows shows;
    Make make;
};
const Mistake mistakes[] = {
    {"joints with w first", turns, turned(Which::joints, w_first)},
    {"root with w first", turns, turned(Which::root, w_first)},
    {"all with w first", turns, turned(Which::all, w_first)},
    {"joints inverse", turns, turned(Which::joints, conjugate)},
    {"root inverse", turns, turned(Which::root, conjugate)},
    {"all inverse", turns, turned(Which::all, conjugate)},
    {"joints with w first, from the root", turned_in_root, turned(Which::joints, w_first)},
    {"joints inverse, from the root", turned_in_root, turned(Which::joints, conjugate)},
    {"matrices transposed, from the root", rows_in_root, turned(Which::joints, transpose3)},
    {"matrices transposed", local_rows, turned(Which::joints, transpose3)},
    {"4 x 4 columns as rows", columns, said_to_be(SWIVEL_MATRIX_ROWS)},
    {"4 x 4 columns as 3 x 4", columns, said_to_be(SWIVEL_MATRIX_COLUMNS3)},
    {"rows as 3 x 4 columns", rows, said_to_be(SWIVEL_MATRIX_COLUMNS3)},
    {"3 x 4 columns as rows", columns3, said_to_be(SWIVEL_MATRIX_ROWS)},
    {"4 x 4 rows as columns", columns, turned(Which::joints, transpose4)},
    {"centimetres for metres", any, times(100)},
    {"metres for centimetres", any, times(0.01)},
    {"millimetres for metres", any, times(1000)},
    {"centimetres for inches", any, times(2.54)},
    {"metres for inches", any, times(0.0254)},
    {"translations in another unit", stretched, times_from_root(100)},
    {"skeleton in another unit", plain, times_from_root(100)},
    {"root's place in another unit", any, with_root(100, 0, 0)},
    {"no root's place", any, with_root(0, 0, 0)},
    {"root's place twice", any, with_root(2, 0, 0)},
    {"no root's rotation", any, with_root(1, -1, 0)},
    {"root's rotation twice", any, with_root(1, 1, 0)},
    {"no root's scale", any, with_root(1, 0, -1)},
    {"root's scale twice", any, with_root(1, 0, 1)},
    {"in the root's frame", any, with_root(0, -1, -1)},
    {"y and z exchanged", any, placed([](auto&, const V& v) -> V { return V(v.x(), -v.z(), v.y()); })},
    {"x mirrored", any, placed([](auto&, const V& v) -> V { return V(-v.x(), v.y(), v.z()); })},
    {"z mirrored", any, placed([](auto&, const V& v) -> V { return V(v.x(), v.y(), -v.z()); })},
    {"bones as at rest", stretched,
     [](Rig& r, LimbPlaces& p) { r.bodies[r.body].translations = r.skeleton.translations, p = r.places(); }},
    {"joints without scales", scaled,
     [](Rig& r, LimbPlaces& p) {
         r.bodies[r.body].scales.assign(r.skeleton.size(), Float3{1, 1, 1}), p = r.places();
     }},
    {"in their parents' frames, said to be the root's", local, said_to_be(SWIVEL_IN_BODY)},
    {"in the root's frame, said to be their parents'", in_root, said_to_be(SWIVEL_LOCAL)},
    {"another group's limb", any,
     [](Rig& r, LimbPlaces& p) { p = r.places(r.skeleton.limbs[(r.group + 1) % r.skeleton.limbs.size()]); }},
    {"a shoulder too high", any,
     [](Rig& r, LimbPlaces& p) { p = r.places(r.above(r.limb().shoulder), r.limb().elbow, r.limb().wrist); }},
    {"a shoulder too low", any,
     [](Rig& r, LimbPlaces& p) { p = r.places(r.above(r.limb().elbow), r.limb().elbow, r.limb().wrist); }},
    {"a crowd's skeleton in another unit", unstretched,
     [](Rig& r, LimbPlaces&) {
         BodySkeleton large = r.skeleton;
         for (Float3& bone : large.translations) bone = floats(V(100 * vec(bone)));
         r.bind_to(large);
     }},
    {"three joints too high", any,
     [](Rig& r, LimbPlaces&) {
         BodySkeleton high = r.skeleton;
         high.limbs = {{r.above(r.limb().shoulder), r.limb().shoulder, r.limb().elbow, r.limb().bend, {}}};
         r.bind_to(high), r.group = 0;
     }},
    {"root's rotation not given", any, without_root(true, false)},
    {"root's place not given", any, without_root(false, true)},
    {"nothing of the root given", any, without_root(false, false)},
    {"a time in milliseconds", any, [](Rig& r, LimbPlaces&) { r.time = 16.7f; }},
    // Of the first body: memory of the last would be read past its end.
    {"a root in floats for doubles, or the other way round", any,
     [](Rig& r, LimbPlaces& p) { r.body = 0, p = r.places(), r.pose.root_is_double = !r.pose.root_is_double; }},
    {"quaternions of length 0", turns,
     [](Rig& r, LimbPlaces&) { r.change_joints([](float* q) { q[0] = q[1] = q[2] = q[3] = 0; }); }},
    {"no usual mistake, all elsewhere", plain, placed([](auto&, const V& v) -> V { return v + V(1, 2, 3); })},
    {"no usual mistake, all turned", plain,
     placed([](auto&, const V& v) -> V { return Eigen::AngleAxisd(1, V(2, 3, 6) / 7) * v; })},
};

}  // namespace

TEST_CASE("each mistake is named as approved, whatever the rig")
{
    ApprovedTexts texts("mistakes.txt");
    texts.scene("what is said of a mistake, with # for numbers");
    for (const Mistake& mistake : mistakes) {
        INFO(mistake.name);
        std::map<std::string, int> said;
        int shown = 0, agreed = 0;
        bool moves = false;  // places, and not the pose
        for_each_rig(kRigs, [&](Random& random) {
            Rig rig(random, mistake.shows);
            const LimbPlaces right = rig.places();
            LimbPlaces places = right;
            mistake.make(rig, places);
            const auto comparison = rig.compare(places);
            moves = moves || places != right;
            REQUIRE((!comparison.agrees || places == right));
            ++(comparison.agrees ? agreed : shown);
            if (!comparison.agrees) ++said[words_of(comparison.text)];
        });
        CHECK(shown > kRigs / 4);
        CHECK((agreed == 0 || moves));
        for (const auto& [words, count] : said)
            if (50 * count > shown) texts.line(mistake.name, words);  // by chance a rig shows another mistake, too
    }
    texts.compare();
}

TEST_CASE("a right pose agrees, and no mistake is named")
{
    for_each_rig(kRigs, [](Random& random) {
        Rig rig(random, any);
        if (random.below(2)) rig.time = 1;
        const auto said = rig.compare();
        INFO(said.text);
        REQUIRE(said.agrees);
        REQUIRE(said.text.starts_with("The pose agrees"));
    });
}

TEST_CASE("joints of another group, or too high, are named by their numbers")
{
    Random random{2};
    const Rig rig(random, any);
    const auto other = static_cast<std::uint32_t>((rig.group + 1) % rig.skeleton.limbs.size());
    const BodyLimbJoints &limb = rig.limb(), &others = rig.skeleton.limbs[other];
    const auto n = [](std::uint32_t number) { return std::to_string(number); };
    CHECK_THAT(
        rig.compare(rig.places(others)).text,
        Catch::Contains("group " + n(other) + "'s limb, joints " + n(others.shoulder) + ", " + n(others.elbow) +
                        " and " + n(others.wrist) + ", but group " + n(rig.group) + " has joints " + n(limb.shoulder)));
    const std::uint32_t above = rig.above(limb.shoulder);
    CHECK_THAT(rig.compare(rig.places(above, limb.elbow, limb.wrist)).text,
               Catch::Contains("is joint " + n(above) + "'s, 1 too high; the group has joint " + n(limb.shoulder)));
}

TEST_CASE("a joint that no mistake explains is named, with its way")
{
    for_each_rig(kRigs, [](Random& random) {
        const Rig rig(random, any);
        LimbPlaces places = rig.places();
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
        const Rig rig(random, any);
        for (const double share : {0.9, 1.1}) {
            LimbPlaces places = rig.places();
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
        Rig rig(random, plain);
        rig.view_poses();
        Body& body = rig.bodies[rig.body];
        body.root_position = floats(Vector3d(1e6 * random.direction())), body.root_scale = 1;
        rig.poses.write(rig.body, body);
        LimbPlaces places = rig.places();
        placed([](auto&, const V& v) { return rounded(v); })(rig, places);
        const auto said = rig.compare(places);
        INFO(said.text);
        REQUIRE(said.agrees);
    });
}

TEST_CASE("how much larger all is, or a bone, is said of an unknown mistake")
{
    for_each_rig(kRigs, [](Random& random) {
        Rig rig(random, plain);
        const double factor = random.between(1.3, 1.7);
        LimbPlaces large = rig.places(), longer = large;
        times_from_root(factor)(rig, large);
        REQUIRE(number_after(rig.compare(large).text, "The places are ") == Approx(factor).epsilon(1e-3));
        const V elbow(longer[1].data()), wrist(longer[2].data());
        longer[2] = Rig::numbers(elbow + factor * (wrist - elbow));
        const std::string text = rig.compare(longer).text;
        REQUIRE(number_after(text, "Your forearm is ") ==
                Approx(factor * number_after(text, "the pose's ")).epsilon(2e-3));
    });
}

TEST_CASE("an elbow bent against its bend is named, though the places agree")
{
    for_each_rig(kRigs / 2, [](Random& random) {
        Rig rig(random, any);
        BodySkeleton other = rig.skeleton;
        for (float& number : other.limbs[rig.group].bend) number = -number;
        rig.bind_to(other);
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

TEST_CASE("a pose that is read at wrong strides is named")
{
    Random random{2};
    Rig rig(random, plain);
    rig.body = 0;  // the last one would be read past its end
    rig.pose.rotations.joint_stride += sizeof(float);
    const auto said = rig.compare();
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
    const Body body{{{0, 0, 0.6f, 0.8f}, {0, 0, 0.28f, 0.96f}, {0, 0, 0, 1}},
                    skeleton.translations,
                    std::vector(3, Float3{1, 1, 1})};
    PoseBuffer poses({}, {body});
    const swivel_pose pose = poses.view();
    const auto at = joints_at(skeleton, body);
    LimbPlaces places;
    for (std::size_t n = 0; n < 3; ++n) places[n] = {at[n].place.x(), -at[n].place.y(), at[n].place.z()};
    const auto said = compare(crowd, 0, 0, pose, places[0], places[1], places[2]);
    INFO(said.text);
    CHECK(!said.agrees);
    CHECK(said.text.starts_with("The pose's joint rotations are the inverse ones"));
    CHECK(said.text.find(" Or: The places are mirrored") != std::string::npos);
    CHECK(said.text.find("With each of these the three places agree") != std::string::npos);
}

TEST_CASE("comparing a pose needs no memory, and keeps to the room for its text")
{
    Random random{5};
    Rig rig(random, turns);
    rig.change_joints(w_first);
    const LimbPlaces places = rig.places();
    const auto before = allocation_count();
    char text[SWIVEL_EXPLANATION_BYTES];
    REQUIRE(swivel_compare(rig.crowd.get(), rig.group, rig.body, &rig.pose, places[0].data(), places[1].data(),
                           places[2].data(), text, sizeof text, nullptr) == SWIVEL_OK);
    CHECK(allocation_count() == before);
    check_room(rig.compare(places).text, [&](char* room, std::size_t size) {
        return swivel_compare(rig.crowd.get(), rig.group, rig.body, &rig.pose, places[0].data(), places[1].data(),
                              places[2].data(), room, size, nullptr);
    });
}
