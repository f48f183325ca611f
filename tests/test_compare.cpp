// SPDX-License-Identifier: MIT
//
// The promise: swivel_compare() names the mistake for which a pose and the caller's places disagree, and no mistake
// where they agree. The places are of Eigen's forward kinematics.
#include <catch2/catch.hpp>

#include <cstring>
#include <functional>
#include <numbers>

#include "tests/allocation_count.h"
#include "tests/body_crowd.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr int kRigs = 1000;

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
void nothing(float*) {}

int chance_count = 0;  // of rigs with a second cause

// One cause, which is this. By chance a second one is true, too: places may lie near the root.
void check_cause(const Crowd::Comparison& said, const std::string& start)
{
    INFO(said.text);
    REQUIRE(!said.agrees);
    const std::size_t other = said.text.find(" Or: ");
    const bool is_one = other == std::string::npos;
    REQUIRE((said.text.starts_with(start) || (!is_one && said.text.substr(other + 5).starts_with(start))));
    REQUIRE(said.text.find(is_one ? "With that the three places agree" : "With each of these the three places agree") !=
            std::string::npos);
    chance_count += !is_one;
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
// Tries many rigs.
template <class Try>
void for_each_rig(int count, const Try& attempt)
{
    chance_count = 0;
    for (int seed = 0; seed < count; ++seed) {
        INFO("rig " << seed);
        Random random{static_cast<std::uint64_t>(seed)};
        attempt(random);
    }
    CHECK(chance_count <= count / 200);
}

}  // namespace

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

TEST_CASE("quaternions in another order are named")
{
    for_each_rig(kRigs, [](Random& random) {
        Rig rig(random, quaternion_wish(random));
        const std::uint32_t which = 1 + random.below(3);
        rig.change_joints(which & 1 ? w_first : nothing);
        rig.change_roots(which & 2 ? w_first : nothing);
        check_cause(rig.compare(), which == 1   ? "The pose's joint rotations are stored as w, x, y, z"
                                   : which == 2 ? "The pose's root_rotation is stored as w, x, y, z"
                                                : "The pose's rotations, root_rotation among them, are stored as w");
    });
}

TEST_CASE("conjugate quaternions are named")
{
    for_each_rig(kRigs, [](Random& random) {
        Rig rig(random, quaternion_wish(random));
        const std::uint32_t which = 1 + random.below(3);
        rig.change_joints(which & 1 ? conjugate : nothing);
        rig.change_roots(which & 2 ? conjugate : nothing);
        check_cause(rig.compare(), which == 1   ? "The pose's joint rotations are the inverse ones"
                                   : which == 2 ? "The pose's root_rotation is the inverse one"
                                                : "The pose's rotations, root_rotation among them, are the inverse");
    });
}

TEST_CASE("in the body's space rotations that do not fit their bones are named")
{
    for_each_rig(kRigs, [](Random& random) {
        const bool is_matrix = random.below(2) == 0;
        Rig rig(random, {is_matrix ? SWIVEL_MATRIX_ROWS : SWIVEL_ROTATIONS, true, true, false, random.below(2) == 0});
        const bool is_inverse = is_matrix || random.below(2) == 0;
        rig.change_joints([&](float* values) {
            if (!is_matrix) return is_inverse ? conjugate(values) : w_first(values);
            std::swap(values[1], values[4]), std::swap(values[2], values[8]), std::swap(values[6], values[9]);
        });
        const auto said = rig.compare();
        INFO(said.text);
        REQUIRE(!said.agrees);
        REQUIRE(said.text.starts_with("The places agree, but the bones do not lie along them"));
        REQUIRE(said.text.find(is_matrix    ? "matrices is transposed"
                               : is_inverse ? "are the inverse ones"
                                            : "stored as w, x, y, z") != std::string::npos);
    });
}

TEST_CASE("another group's limb is named, with its joints")
{
    for_each_rig(kRigs, [](Random& random) {
        const Rig rig(random, any_wish(random));
        const auto other = static_cast<std::uint32_t>((rig.group + 1) % rig.skeleton.limbs.size());
        const BodyLimbJoints& limb = rig.skeleton.limbs[other];
        check_cause(rig.compare(rig.places(limb)),
                    "Your places are those of group " + std::to_string(other) + "'s limb, joints " +
                        std::to_string(limb.shoulder) + ", " + std::to_string(limb.elbow) + " and " +
                        std::to_string(limb.wrist) + ", but group " + std::to_string(rig.group) + " has joints " +
                        std::to_string(rig.limb().shoulder));
    });
}

TEST_CASE("matrices of rows for columns are named")
{
    const auto transpose = [](float* values, int size) {
        for (int row = 0; row < size; ++row)
            for (int column = 0; column < row; ++column) std::swap(values[4 * row + column], values[4 * column + row]);
    };
    const auto end_matrix = [](float* values) { values[3] = values[7] = values[11] = 0, values[15] = 1; };
    const auto stored = [](const char* as, const char* not_as) {
        return std::string("The pose's matrices are stored as ") + as + ", but its form is " + not_as + ".";
    };
    for_each_rig(kRigs, [&](Random& random) {
        const std::uint32_t which = random.below(6);
        const swivel_pose_form form = which == 1   ? SWIVEL_MATRIX_ROWS
                                      : which == 2 ? SWIVEL_MATRIX_COLUMNS3
                                      : which == 5 ? SWIVEL_MATRIX_ROWS
                                                   : SWIVEL_MATRIX_COLUMNS;
        Rig rig(random, matrix_wish(random, form));
        switch (which) {
            case 0:  // 4 x 4 columns as rows
            case 3:  // and as 3 x 4
                rig.change_joints(end_matrix);
                rig.pose.form = which == 0 ? SWIVEL_MATRIX_ROWS : SWIVEL_MATRIX_COLUMNS3;
                return check_cause(rig.compare(), stored("SWIVEL_MATRIX_COLUMNS",
                                                         which == 0 ? "SWIVEL_MATRIX_ROWS" : "SWIVEL_MATRIX_COLUMNS3"));
            case 1:
                rig.pose.form = SWIVEL_MATRIX_COLUMNS3;
                return check_cause(rig.compare(), stored("SWIVEL_MATRIX_ROWS", "SWIVEL_MATRIX_COLUMNS3"));
            case 2:
                rig.pose.form = SWIVEL_MATRIX_ROWS;
                return check_cause(rig.compare(), stored("SWIVEL_MATRIX_COLUMNS3", "SWIVEL_MATRIX_ROWS"));
            case 4:  // 4 x 4 rows as columns
                rig.change_joints([&](float* values) { end_matrix(values), transpose(values, 4); });
                return check_cause(rig.compare(), stored("SWIVEL_MATRIX_ROWS", "SWIVEL_MATRIX_COLUMNS"));
            default:
                if (rig.layout.in_body) return;  // where places do not depend on it
                rig.change_joints([&](float* values) { transpose(values, 3); });
                return check_cause(rig.compare(), "The 3 x 3 part of the pose's matrices is transposed");
        }
    });
}

TEST_CASE("another unit is named, with its factor")
{
    for_each_rig(kRigs, [](Random& random) {
        Rig rig(random, any_wish(random));
        struct Factor {
            double value;
            const char *name, *number;
        };
        constexpr Factor factors[] = {{100, "centimetres instead of metres", "100."},
                                      {0.01, "metres instead of centimetres", "1 / 100."},
                                      {1000, "millimetres instead of metres", "1000."},
                                      {2.54, "centimetres instead of inches", "2.54."},
                                      {0.0254, "metres instead of inches", "1 / 39.3701."}};
        const Factor& of = factors[random.below(5)];
        const double factor = of.value;
        const Vector3d root = rig.root();
        const std::uint32_t what = random.below(3);  // all; translations; the root
        const Places places = moved(rig.places(rig.limb()), [&](const Vector3d& v) {
            if (what == 0) return Vector3d(factor * v);
            return what == 1 ? Vector3d(root + factor * (v - root)) : Vector3d(factor * root + (v - root));
        });
        const bool has_lengths = rig.pose.translations.data || rig.pose.form != SWIVEL_ROTATIONS;
        check_cause(
            rig.compare(places),
            std::string(what == 0   ? "Your places are in another unit than the pose, such as "
                        : what == 1 ? has_lengths
                                          ? "Your places are in another unit than the pose's translations, such as "
                                          : "Your places are in another unit than the skeleton, such as "
                                    : "Your places and the pose's joints are in another unit than "
                                      "root_position, such as ") +
                (what < 2 ? std::string(of.name) + ": the factor is " + of.number : std::string()));
    });
}

TEST_CASE("a joint that is too high is named")
{
    for_each_rig(kRigs, [](Random& random) {
        const Rig rig(random, any_wish(random));
        const BodyLimbJoints& limb = rig.limb();
        check_cause(rig.compare(rig.places(rig.clavicle(), limb.elbow, limb.wrist)),
                    "Your place of the shoulder is joint " + std::to_string(rig.clavicle()) +
                        "'s, 1 too high; the group has joint " + std::to_string(limb.shoulder) + ".");
        // The crowd's own joint is too high where the caller's is below it.
        const auto between = static_cast<std::uint32_t>(rig.skeleton.parents[limb.elbow]);
        if (between == limb.shoulder) return;
        const auto said = rig.compare(rig.places(between, limb.elbow, limb.wrist));
        INFO(said.text);
        REQUIRE(said.text.starts_with("Your place of the shoulder is joint " + std::to_string(between) + "'s, "));
        REQUIRE(said.text.find("too low; the group has") != std::string::npos);
    });
}

TEST_CASE("what counts twice or not at all is named")
{
    const auto number = [](const float& x) { return static_cast<double>(x); };
    for_each_rig(kRigs, [&](Random& random) {
        RigWish wish = any_wish(random);
        const std::uint32_t which = random.below(9);
        if (which == 7) wish = {SWIVEL_ROTATIONS, false, true, true, random.below(2) == 0};
        if (which == 8) wish = {SWIVEL_ROTATIONS, false, true, true, true};
        Rig rig(random, wish);
        const Body& body = rig.bodies[rig.body];
        const Vector3d root = rig.root();
        const Quaterniond turn = quat(body.root_rotation).normalized();
        const double scale = number(body.root_scale);
        const auto said = [&](const std::function<Vector3d(const Vector3d&)>& move) {  // of places from the root
            return rig.compare(moved(rig.places(rig.limb()), [&](const Vector3d& v) { return move(v - root); }));
        };
        const auto with = [&](const std::function<void(Body&)>& change) {
            change(rig.bodies[rig.body]);
            return rig.compare();
        };
        switch (which) {
            case 0:
                return check_cause(said([&](const Vector3d& v) { return v; }), "Your places are without root_position");
            case 1:
                return check_cause(said([&](const Vector3d& v) { return Vector3d(2 * root + v); }),
                                   "Your places have root_position twice");
            case 2:
                return check_cause(said([&](const Vector3d& v) { return Vector3d(root + turn.conjugate() * v); }),
                                   "Your places are without root_rotation");
            case 3:
                return check_cause(said([&](const Vector3d& v) { return Vector3d(root + turn * v); }),
                                   "Your places have root_rotation twice");
            case 4:
                return check_cause(said([&](const Vector3d& v) { return Vector3d(root + v / scale); }),
                                   "Your places are without root_scale");
            case 5:
                return check_cause(said([&](const Vector3d& v) { return Vector3d(root + scale * v); }),
                                   "Your places have root_scale twice");
            case 6:
                return check_cause(said([&](const Vector3d& v) { return Vector3d(turn.conjugate() * v / scale); }),
                                   "Your places are in the root's frame");
            case 7:
                return check_cause(with([&](Body& of) { of.translations = rig.skeleton.translations; }),
                                   "Your places are those of bones as the skeleton rests");
            default: {
                bool is_any = false;  // scaled, above a joint of the limb
                for (std::uint32_t joint = 0; joint < rig.skeleton.size(); ++joint)
                    is_any |= std::fabs(number(body.scales[joint][0]) - 1) > 0.02 && joint != rig.limb().wrist &&
                              rig.skeleton.is_above(joint, rig.limb().wrist);
                if (is_any)
                    check_cause(with([&](Body& of) {
                                    of.scales.assign(of.scales.size(), Float3{1, 1, 1});
                                }),
                                "Your places are those of joints without the pose's scales");
            }
        }
    });
}

TEST_CASE("the other space is named")
{
    for_each_rig(kRigs, [](Random& random) {
        RigWish wish = any_wish(random);
        wish.form = random.below(2) == 0 ? SWIVEL_ROTATIONS : SWIVEL_MATRIX_COLUMNS3, wish.translates = true;
        Rig rig(random, wish);
        rig.pose.space = wish.in_body ? SWIVEL_LOCAL : SWIVEL_IN_BODY;
        check_cause(rig.compare(), wish.in_body ? "The pose's joints are relative to the root"
                                                : "The pose's joints are relative to their parents");
    });
}

TEST_CASE("other axes are named")
{
    for_each_rig(kRigs, [](Random& random) {
        const Rig rig(random, any_wish(random));
        const int mirrored = static_cast<int>(random.below(3));
        const bool is_up = random.below(2) == 0;
        const Places places = moved(rig.places(rig.limb()), [&](Vector3d v) {
            if (is_up) return Vector3d(v.x(), -v.z(), v.y());
            v[mirrored] = -v[mirrored];
            return v;
        });
        check_cause(rig.compare(places),
                    is_up ? "The places have y and z exchanged" : "The places are mirrored: one side");
    });
}

namespace {

double number_after(const std::string& text, const std::string& words)
{
    const std::size_t at = text.find(words);
    INFO(text);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + words.size()));
}

}  // namespace

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
    CHECK(number_after(text([&](const Vector3d& v) { return Vector3d(root + 1.5 * (v - root)); }), "The places are ") ==
          Approx(1.5));
    const Quaterniond turn = random.rotation();
    CHECK(has(text([&](const Vector3d& v) { return Vector3d(turn * v); }), "The limb's own shape is right"));
    Places longer = places;
    longer[2] =
        Rig::numbers(Vector3d(places[1].data()) + 1.7 * (Vector3d(places[2].data()) - Vector3d(places[1].data())));
    const std::string says = rig.compare(longer).text;
    CHECK(number_after(says, "Your forearm is ") == Approx(1.7 * number_after(says, "the pose's ")).epsilon(1e-3));
    rig.change_joints([](float* q) { q[0] = q[1] = q[2] = q[3] = 0; });
    CHECK(has(rig.compare(places).text, "is a quaternion of length 0."));
}

TEST_CASE("a skeleton in another unit than the pose is named, though the places agree")
{
    for_each_rig(kRigs / 10, [](Random& random) {
        RigWish wish = matrix_wish(random, static_cast<swivel_pose_form>(1 + random.below(3)));
        wish.stretches = false;
        Rig rig(random, wish);
        BodySkeleton large = rig.skeleton;
        for (Float3& bone : large.translations)
            for (float& number : bone) number *= 100;
        rig.crowd = body_crowd(large, SWIVEL_POLE_INCOMING, static_cast<std::uint32_t>(rig.bodies.size()));
        const auto said = rig.compare();
        INFO(said.text);
        REQUIRE(!said.agrees);
        REQUIRE(
            said.text.starts_with("The places agree, but something else is wrong. The skeleton's bones are 100 times"));
    });
}

TEST_CASE("a time in milliseconds is named, though the places agree")
{
    Random random{1};
    Rig rig(random, {});
    for (const float time : {0.0167f, 1.0f, 16.7f}) {
        rig.pose.time = {&time, 0};
        CHECK(rig.compare().agrees == (time <= 1));
    }
    CHECK_THAT(rig.compare().text, Catch::Contains("The pose's time is 16.7, which are that many seconds"));
}

TEST_CASE("an elbow bent against its bend is named, though the places agree")
{
    for_each_rig(kRigs / 10, [](Random& random) {
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
    int doubles = 0;
    for_each_rig(kRigs / 10, [&](Random& random) {
        Rig rig(random, any_wish(random));
        const bool is_double = rig.pose.root_is_double;
        if (!is_double && rig.pose.root_position.stride < 3 * sizeof(double)) return;
        if (is_double && rig.body + 1 == rig.bodies.size()) return;  // it may not read so far
        const Places places = rig.places(rig.limb());
        rig.pose.root_is_double = !is_double;
        const auto said = rig.compare(places);
        INFO(said.text);
        REQUIRE(!said.agrees);
        REQUIRE(said.text.find(is_double ? "root_position is in doubles, but it is read as floats"
                                         : "root_position is in floats, but root_is_double says doubles") !=
                std::string::npos);
        doubles += is_double;
    });
    CHECK(doubles > 10);
}

TEST_CASE("a root that was not given is named")
{
    for_each_rig(kRigs / 10, [](Random& random) {
        Rig rig(random, any_wish(random));
        const Places places = rig.places(rig.limb());
        const std::uint32_t what = random.below(3);
        if (what != 0 && !rig.far_roots.empty()) return;  // floats tell nothing there
        if (what != 0) rig.pose.root_position = {}, rig.pose.root_is_double = 0;
        if (what != 1) rig.pose.root_rotation = {};
        const auto said = rig.compare(places);
        INFO(said.text);
        REQUIRE(!said.agrees);
        REQUIRE(said.text.find(what == 0   ? "gives no root_rotation"
                               : what == 1 ? "gives no root_position"
                                           : "gives neither root_position nor root_rotation") != std::string::npos);
    });
}

TEST_CASE("three joints that are all too high are named")
{
    for_each_rig(kRigs / 10, [](Random& random) {
        Rig rig(random, any_wish(random));
        const BodyLimbJoints limb = rig.limb();
        BodySkeleton high = rig.skeleton;
        BodyLimbJoints& named = high.limbs[rig.group];
        named.shoulder = rig.clavicle(), named.elbow = limb.shoulder, named.wrist = limb.elbow;
        named.twist_bones.clear();
        rig.crowd = body_crowd(high, SWIVEL_POLE_INCOMING, static_cast<std::uint32_t>(rig.bodies.size()));
        const auto said = rig.compare(rig.places(limb));
        INFO(said.text);
        REQUIRE(!said.agrees);
        REQUIRE(said.text.starts_with("Your shoulder and elbow are joints " + std::to_string(limb.shoulder) + " and " +
                                      std::to_string(limb.elbow) + ", but the group has joints "));
    });
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

TEST_CASE("comparing a pose needs no memory, keeps to the room for its text, and refuses what a job would")
{
    Random random{5};
    Rig rig(random, quaternion_wish(random));
    rig.pose.time = {}, rig.change_joints(w_first);
    const Places places = rig.places(rig.limb());
    const std::string whole = rig.compare(places).text;
    std::vector<char> room(whole.size() + 1);
    const auto call = [&](const swivel_crowd* crowd, std::uint32_t group, std::uint32_t body, const swivel_pose* pose,
                          const double* elbow, char* text, std::size_t size) {
        int agrees = -1;
        const swivel_status status =
            swivel_compare(crowd, group, body, pose, places[0].data(), elbow, places[2].data(), text, size, &agrees);
        CHECK((agrees == -1) == (status != SWIVEL_OK));
        return status;
    };
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
    char* const text = room.data();
    CHECK_REFUSED(call(nullptr, 0, 0, &rig.pose, elbow, text, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(call(crowd, 9, 0, &rig.pose, elbow, text, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(call(crowd, 0, 3, &rig.pose, elbow, text, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(call(crowd, 0, 0, nullptr, elbow, text, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(call(crowd, 0, 0, &rig.pose, nullptr, text, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(call(crowd, 0, 0, &rig.pose, elbow, nullptr, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(call(crowd, 0, 0, &rig.pose, elbow, text, 0), SWIVEL_INVALID_ARGUMENT);
    const double bad[3] = {0, NAN, 0}, far[3] = {0, 2e15, 0};
    CHECK_REFUSED(call(crowd, 0, 0, &rig.pose, bad, text, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(call(crowd, 0, 0, &rig.pose, far, text, 8), SWIVEL_INVALID_ARGUMENT);
    swivel_pose pose = rig.pose;
    pose.rotations.data = nullptr;
    CHECK_REFUSED(call(crowd, 0, 0, &pose, elbow, text, 8), SWIVEL_INVALID_ARGUMENT);
    const Crowd free({group(1)});
    CHECK_REFUSED(call(free.get(), 0, 0, &rig.pose, elbow, text, 8), SWIVEL_INVALID_ARGUMENT);
    const swivel_limb_joints joints = rig.skeleton.joints(0);
    const std::array groups = {body_group(joints, SWIVEL_WITH_FIT), fit_group()};
    const Crowd fitted(rig.skeleton.view(), 3, groups);
    CHECK_REFUSED(call(fitted.get(), 1, 0, &rig.pose, elbow, text, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK(call(fitted.get(), 0, 0, &rig.pose, elbow, text, 8) == SWIVEL_OK);  // without a time
}
