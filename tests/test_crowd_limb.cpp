// SPDX-License-Identifier: MIT
//
// The promise: what swivel.h says of the whole limb holds in crowds, through skeletons and worlds: what is at rest
// changes nothing, incoming poses and effectors are the skeleton's own, limits made of angles are kept as angles, and
// the body's other side is its mirror image.
#include <map>

#include "tests/limit_oracle.h"
#include "tests/test_crowd.h"
#include "tests/test_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

using Matrix3d = Eigen::Matrix3d;

constexpr std::uint32_t kWorld = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND;
constexpr std::uint32_t kLimits = SWIVEL_LIMIT_FLEXION | SWIVEL_LIMIT_SHOULDER_CONE | SWIVEL_LIMIT_HUMERAL_TWIST |
                                  SWIVEL_LIMIT_SHOULDER_BOX | SWIVEL_LIMIT_HAND_CONE | SWIVEL_LIMIT_FOREARM_TWIST |
                                  SWIVEL_LIMIT_HAND_TWIST | SWIVEL_LIMIT_WRIST_BOX;

// A skeleton's limb with nothing aligned: random rest rotations, bones and hinge.
swivel_chain skewed_chain(Random& random)
{
    swivel_chain chain{};
    const Vector3d upper = random.direction(), hinge = random.across(upper);
    const Quaterniond elbow = random.rotation();
    const Vector3d fore = elbow.conjugate() * (Eigen::AngleAxisd(-random.between(0, 1), hinge) * upper);
    std::ranges::copy(floats(random.rotation()), chain.shoulder_rotation);
    std::ranges::copy(floats(elbow), chain.elbow_rotation);
    std::ranges::copy(floats(random.rotation()), chain.wrist_rotation);
    std::ranges::copy(floats(Vector3d(random.between(0.5, 1) * upper)), chain.elbow_offset);
    std::ranges::copy(floats(Vector3d(random.between(0.5, 1) * fore)), chain.wrist_offset);
    std::ranges::copy(floats(hinge), chain.hinge);
    return chain;
}

struct Chained {
    swivel_chain chain;
    BoundLimb bound;
};
Chained chained(Random& random)
{
    const swivel_chain chain = skewed_chain(random);
    return {chain, bind(chain)};
}

// The local rotations of one limb, and where the skeleton then has its wrist and its hand.
struct LocalPose {
    Quaterniond shoulder, elbow, wrist;

    Vector3d wrist_place(const swivel_chain& chain, const Parent& parent) const
    {
        const Vector3d fore = shoulder * (vec(chain.elbow_offset) + elbow * vec(chain.wrist_offset));
        return parent.position + parent.scale * (parent.rotation * fore);
    }
    Quaterniond hand(const Parent& parent) const { return parent.rotation * shoulder * elbow * wrist; }
};
LocalPose local_pose(const Crowd& crowd, std::uint32_t n)
{
    Float4 q[3];
    const swivel_field fields[] = {SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST};
    for (int f = 0; f < 3; ++f) {
        crowd.read(fields[f], 0, std::span(q + f, 1), n);
        CHECK(is_unit(q[f]));
    }
    return {quat(q[0]).normalized(), quat(q[1]).normalized(), quat(q[2]).normalized()};
}

template <class Value>
void put(Crowd& crowd, swivel_field field, std::uint32_t n, const Value& value)
{
    crowd.write(field, 0, std::span(&value, 1), n);
}

using Float7 = std::array<float, 7>;
using Float12 = std::array<float, 12>;

Float4 range_of(const AngleRange& range)
{
    Float4 value;
    CHECK(swivel_range(range.middle - range.half, range.middle + range.half, value.data()) == SWIVEL_OK);
    return value;
}

// The mirror image in the plane x = 0 of vectors, rotations, and of axes that something turns about.
Vector3d mirrored(const Vector3d& v) { return {-v.x(), v.y(), v.z()}; }
Quaterniond mirrored(const Quaterniond& q) { return {q.w(), q.x(), -q.y(), -q.z()}; }

}  // namespace

TEST_CASE("whole limbs at rest are the plain arms")
{
    constexpr std::uint32_t count = 200;
    const std::uint32_t at_rest =
        SWIVEL_WITH_ANGLE | SWIVEL_WITH_REACH | SWIVEL_WITH_STEP | SWIVEL_WITH_EFFECTOR | kLimits;
    for (const std::uint32_t features :
         {0u, kWorld & ~std::uint32_t{SWIVEL_WORLD}, kWorld, kWorld | SWIVEL_POLE_DIRECTION,
          std::uint32_t{SWIVEL_WORLD | SWIVEL_WITH_HAND}})
        for (const std::uint32_t more :
             {std::uint32_t{SWIVEL_WITH_ANGLE}, features & SWIVEL_WITH_HAND ? at_rest : 0u}) {
            Random random{features + more};
            const Chained limb = chained(random);
            Crowd plain = crowd_of(features, count, limb.bound.binding),
                  whole = crowd_of(features | more, count, limb.bound.binding);
            for (std::uint32_t n = 0; n < count; ++n) {
                const Limb each = random_limb(random, features, {limb.bound.lengths[0], limb.bound.lengths[1]});
                write_limb(plain, 0, n, each);
                write_limb(whole, 0, n, each);
            }
            plain.solve();
            whole.solve();
            const auto flags = read<std::uint32_t>(whole, SWIVEL_FLAGS);
            for (const swivel_field field : {SWIVEL_SHOULDER, SWIVEL_WRIST}) {
                if (!swivel_field_row_count(plain.get(), field)) continue;
                const auto want = read<Float4>(plain, field), got = read<Float4>(whole, field);
                for (std::uint32_t n = 0; n < count; ++n) {
                    INFO("features " << features << ", more " << more << ", limb " << n << ", field " << field);
                    CHECK(distance(quat(got[n]), quat(want[n])) <= 4e-6);
                    CHECK(is_in_hemisphere(got[n]));
                    CHECK(flags[n] == SWIVEL_REACHED);
                }
            }
            std::vector<double> residuals(count);
            whole.residuals(0, residuals);
            for (const double residual : residuals) CHECK(residual <= kWristError);
        }
}

TEST_CASE("an incoming pose of the skeleton's own rotations, kept by weights of 0")
{
    constexpr std::uint32_t count = 100;
    Random random{2};
    const Chained limb = chained(random);
    Crowd crowd = crowd_of(kWorld | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS, count, limb.bound.binding);
    Crowd first = crowd_of(kWorld, count, limb.bound.binding);
    for (std::uint32_t n = 0; n < count; ++n) {
        const Float2 lengths = {limb.bound.lengths[0], limb.bound.lengths[1]};
        write_limb(first, 0, n, random_limb(random, kWorld, lengths));
        write_limb(crowd, 0, n, random_limb(random, kWorld, lengths));
    }
    first.solve();
    // Any of the two quaternions of each rotation may come in; the same comes out.
    for (const auto& [from, to] :
         {std::pair{SWIVEL_SHOULDER, SWIVEL_INCOMING_SHOULDER}, std::pair{SWIVEL_ELBOW, SWIVEL_INCOMING_ELBOW},
          std::pair{SWIVEL_WRIST, SWIVEL_INCOMING_WRIST}}) {
        auto values = read<Float4>(first, from);
        for (std::size_t n = 0; n < values.size(); n += 2)
            for (float& x : values[n]) x = -x;
        crowd.write(to, 0, values);
    }
    crowd.write_all(SWIVEL_WEIGHTS, 0, Float3{0, 0, 0});
    crowd.solve();
    for (const auto& [out, in] :
         {std::pair{SWIVEL_SHOULDER, SWIVEL_INCOMING_SHOULDER}, std::pair{SWIVEL_ELBOW, SWIVEL_INCOMING_ELBOW},
          std::pair{SWIVEL_WRIST, SWIVEL_INCOMING_WRIST}}) {
        const auto got = read<Float4>(crowd, out), want = read<Float4>(crowd, in);
        for (std::uint32_t n = 0; n < count; ++n) {
            INFO("limb " << n << ", field " << out);
            CHECK((quat(got[n]).coeffs() - quat(want[n]).coeffs()).norm() <= 2e-5);
        }
    }
}

TEST_CASE("an effector in the hand joint's own frame is at the target")
{
    constexpr std::uint32_t count = 100;
    Random random{3};
    const Chained limb = chained(random);
    Crowd crowd = crowd_of(kWorld | SWIVEL_WITH_EFFECTOR, count, limb.bound.binding);
    std::vector<Limb> limbs;
    std::vector<Vector3d> effectors;
    for (std::uint32_t n = 0; n < count; ++n) {
        Limb each = random_limb(random, kWorld, {limb.bound.lengths[0], limb.bound.lengths[1]});
        effectors.push_back(vec(floats(Vector3d(random.between(0, 0.3) * random.direction()))));
        const Parent parent = each.parent();
        each.target = floats(Vector3d(vec(each.target) + parent.scale * (quat(each.hand).normalized() * effectors[n])));
        write_limb(crowd, 0, n, each);
        put(crowd, SWIVEL_EFFECTOR, n, floats(effectors[n]));
        limbs.push_back(each);
    }
    crowd.solve();
    std::vector<double> residuals(count);
    crowd.residuals(0, residuals);
    for (std::uint32_t n = 0; n < count; ++n) {
        const Parent parent = limbs[n].parent();
        const LocalPose pose = local_pose(crowd, n);
        const Vector3d at = pose.wrist_place(limb.chain, parent) + parent.scale * (pose.hand(parent) * effectors[n]);
        const double length = parent.scale * (limb.bound.lengths[0] + limb.bound.lengths[1]);
        CHECK((at - vec(limbs[n].target)).norm() <= 3e-6 * length);
        CHECK(residuals[n] <= 3e-6);
    }
}

TEST_CASE("stretched bones reach and give their stretch back; no wrist is nearer than the least distance")
{
    Crowd crowd = crowd_of(SWIVEL_WITH_REACH, 3);
    crowd.write_all(SWIVEL_REACH, 0, Float4{0.05f, 0, 1.5f, 0});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    const Float3 targets[] = {{0, 0, 1.2f}, {0, 0, 2.5f}, {0, 0, 4}};
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.solve();
    const auto stretch = read<Float1>(crowd, SWIVEL_STRETCH);
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    std::vector<double> residuals(3);
    crowd.residuals(0, residuals);
    CHECK(stretch[0][0] == 1);
    CHECK(flags[0] == SWIVEL_REACHED);
    CHECK(stretch[1][0] == Approx(1.25));
    CHECK(flags[1] == (SWIVEL_REACHED | SWIVEL_STRETCHED));
    CHECK(residuals[1] <= 1e-6);
    CHECK(stretch[2][0] == 1.5f);
    CHECK(flags[2] == (SWIVEL_CLAMPED_FAR | SWIVEL_STRETCHED));
    CHECK(residuals[2] == Approx(0.5));  // of two bones of length 1, stretched to 3

    crowd.write_all(SWIVEL_REACH, 0, Float4{0, 0, 1, 0.5f});  // no nearer than half of the arm
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 0, 0.25f});
    crowd.solve();
    crowd.residuals(0, residuals);
    CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS)[0] == SWIVEL_CLAMPED_NEAR);
    CHECK(residuals[0] == Approx(0.375));
}

TEST_CASE("limits made of angles are kept through a skeleton")
{
    constexpr std::uint32_t count = 1000;
    Random random{4};
    const Chained limb = chained(random);
    swivel_group_def group{count, limb.bound.binding};
    swivel_crowd_def def = swivel_default_crowd_def();
    def.features = kWorld | kLimits;
    def.groups = &group;
    def.group_count = 1;
    def.shoulder_order = SWIVEL_YZX;
    def.wrist_order = SWIVEL_ZYX;
    Crowd crowd(def);
    struct Limited {
        Vector3d shoulder_axis, hand_axis, twist_axis;
        double shoulder, hand;
        AngleRange humeral, forearm, twist;
        AngleBox shoulder_box{{1, 2, 0}, {}}, wrist_box{{2, 1, 0}, {}};
    };
    std::vector<Limited> limits(count);
    for (std::uint32_t n = 0; n < count; ++n) {
        write_limb(crowd, 0, n, random_limb(random, kWorld, {limb.bound.lengths[0], limb.bound.lengths[1]}));
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
    const swivel_binding& b = limb.bound.binding;
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

TEST_CASE("the body's other side is the mirror image")
{
    constexpr std::uint32_t count = 300;
    const std::uint32_t features = kWorld | SWIVEL_WITH_ANGLE | kLimits;
    Random random{5};
    const swivel_chain right = skewed_chain(random);
    swivel_chain left = right;
    const auto mirror3 = [](const float(&from)[3], float(&to)[3], double sign) {
        std::ranges::copy(floats(Vector3d(sign * mirrored(vec(from)))), to);
    };
    const auto mirror4 = [](const float(&from)[4], float(&to)[4]) {
        std::ranges::copy(floats(mirrored(quat(from))), to);
    };
    mirror4(right.shoulder_rotation, left.shoulder_rotation);
    mirror4(right.elbow_rotation, left.elbow_rotation);
    mirror4(right.wrist_rotation, left.wrist_rotation);
    mirror3(right.elbow_offset, left.elbow_offset, 1);
    mirror3(right.wrist_offset, left.wrist_offset, 1);
    mirror3(right.hinge, left.hinge, -1);  // an axis that the forearm turns about
    Crowd r = crowd_of(features, count, bind(right).binding), l = crowd_of(features, count, bind(left).binding);
    const BoundLimb bound = bind(right);
    const swivel_euler_order order = SWIVEL_XYZ;
    const auto both = [&](swivel_field field, std::uint32_t n, const auto& value) {
        auto other = value;
        CHECK(swivel_mirror(field, order, value.data(), other.data()) == SWIVEL_OK);
        put(r, field, n, value);
        put(l, field, n, other);
    };
    for (std::uint32_t n = 0; n < count; ++n) {
        const Limb limb = random_limb(random, kWorld, {bound.lengths[0], bound.lengths[1]});
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
        if (flags[n] & SWIVEL_INFEASIBLE) continue;  // two violations may be least
        CHECK(flags[n] == other_flags[n]);
        limited += (flags[n] & ~std::uint32_t{SWIVEL_REACHED}) != 0;
        const double off =
            std::max({distance(mirrored(pose.shoulder), image.shoulder), distance(mirrored(pose.elbow), image.elbow),
                      distance(mirrored(pose.wrist), image.wrist)});
        same += off <= 1e-3;  // where an arc's end is flat, the two roundings of it may differ
    }
    CHECK(limited > 50);
    int feasible = 0;
    for (const std::uint32_t f : flags) feasible += !(f & SWIVEL_INFEASIBLE);
    CHECK(same == feasible);
}

TEST_CASE("twist bones share the hand's twist about the forearm")
{
    constexpr std::uint32_t count = 100, bones = 3;
    Random random{6};
    const Chained limb = chained(random);
    Crowd crowd = crowd_of(kWorld | bones * SWIVEL_TWIST_BONES, count, limb.bound.binding);
    for (std::uint32_t n = 0; n < count; ++n)
        write_limb(crowd, 0, n, random_limb(random, kWorld, {limb.bound.lengths[0], limb.bound.lengths[1]}));
    crowd.solve();
    const auto twists = read<Float12>(crowd, SWIVEL_TWIST);
    const swivel_binding& b = limb.bound.binding;
    const Quaterniond fore = quat(b.fore_from_arm), hand_rest = fore.conjugate() * quat(b.wrist_rest);
    for (std::uint32_t n = 0; n < count; ++n) {
        const Quaterniond wrist = fore.conjugate() * local_pose(crowd, n).wrist * hand_rest.conjugate();
        // The rotation's matrix, its swing from e3 taken out: what is left turns e1 about e3.
        const Quaterniond swing = Quaterniond::FromTwoVectors(Vector3d::UnitZ(), wrist * Vector3d::UnitZ());
        const Vector3d turned = (swing.conjugate() * wrist) * Vector3d::UnitX();
        const double twist = std::atan2(turned.y(), turned.x());
        for (std::size_t bone = 0; bone < bones; ++bone) {
            const Float4 q = {twists[n][4 * bone], twists[n][4 * bone + 1], twists[n][4 * bone + 2],
                              twists[n][4 * bone + 3]};
            const Vector3d axis = fore * Vector3d::UnitZ();
            const Quaterniond want(Eigen::AngleAxisd(twist * double(bone + 1) / (bones + 1), axis));
            INFO("limb " << n << ", bone " << bone << ", twist " << twist);
            CHECK(quat(q).angularDistance(want) <= (std::fabs(twist) > 3.1 ? 7 : 2e-3));
        }
    }
}

TEST_CASE("the swivel carried from solve to solve is forgotten on reset")
{
    Crowd crowd = crowd_of(SWIVEL_WITH_STEP, 2);
    Float2 most;
    swivel_turn(0.1, most.data());
    crowd.write_all(SWIVEL_MOST_SWIVEL, 0, most);
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 0, 1});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    crowd.solve();
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, 1, 0.1f});
    CHECK(swivel_reset(crowd.get(), 0, 1, 1) == SWIVEL_OK);
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    const auto normals = read<Float3>(crowd, SWIVEL_NORMAL);
    CHECK(flags[0] == (SWIVEL_REACHED | SWIVEL_LIMITED_STEP));
    CHECK(std::fabs(normals[0][0] - std::cos(0.1)) <= 1e-6);
    CHECK(flags[1] == SWIVEL_REACHED);
    CHECK(std::fabs(normals[1][0] + 1) <= 1e-6);
    CHECK_REFUSED(swivel_reset(crowd.get(), 0, 1, 2), SWIVEL_INVALID_ARGUMENT);
}

TEST_CASE("joint angles turn back into the rotations they are of, in every order and both families")
{
    constexpr std::uint32_t count = 60;
    Random random{7};
    const Chained limb = chained(random);
    Crowd crowd = crowd_of(kWorld, count, limb.bound.binding);
    for (std::uint32_t n = 0; n < count; ++n)
        write_limb(crowd, 0, n, random_limb(random, kWorld, {limb.bound.lengths[0], limb.bound.lengths[1]}));
    crowd.solve();
    const swivel_binding& b = limb.bound.binding;
    const Quaterniond parent = quat(b.parent_from_arm), upper = quat(b.upper_from_arm), fore = quat(b.fore_from_arm);
    const Quaterniond hand_rest = fore.conjugate() * quat(b.wrist_rest);
    const int axes[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
    for (int order = 0; order < 6; ++order)
        for (const int family : {0, 1}) {
            std::vector<std::array<double, 7>> angles(count);
            REQUIRE(swivel_joint_angles(crowd.get(), 0, 0, count, static_cast<swivel_euler_order>(order),
                                        static_cast<swivel_euler_order>(5 - order), family,
                                        {angles.data(), sizeof angles[0]}) == SWIVEL_OK);
            for (std::uint32_t n = 0; n < count; ++n) {
                const auto rotation = [&](int o, int first) {
                    Quaterniond q = Quaterniond::Identity();
                    for (int k = 0; k < 3; ++k)
                        q = q * Quaterniond(Eigen::AngleAxisd(angles[n][static_cast<std::size_t>(first + k)],
                                                              Vector3d::Unit(axes[o][k])));
                    return q;
                };
                const LocalPose pose = local_pose(crowd, n);
                INFO("limb " << n << ", order " << order << ", family " << family);
                CHECK(distance(rotation(order, 0), parent.conjugate() * pose.shoulder * upper) <= 1e-6);
                CHECK(distance(rotation(5 - order, 4), fore.conjugate() * pose.wrist * hand_rest.conjugate()) <= 1e-6);
                const Quaterniond elbow(Eigen::AngleAxisd(-angles[n][3], Vector3d::UnitX()));
                CHECK(distance(elbow, upper.conjugate() * pose.elbow * fore) <= 1e-6);
                CHECK((std::fabs(angles[n][1]) <= kPi / 2) == (family == 0));
            }
        }
}

TEST_CASE("allowed arcs are where the limits are kept, and the solver's choice is in one or at its end")
{
    constexpr std::uint32_t count = 200;
    Random random{8};
    Crowd crowd = crowd_of(
        SWIVEL_LIMIT_SHOULDER_CONE | SWIVEL_LIMIT_HUMERAL_TWIST | SWIVEL_LIMIT_SHOULDER_BOX | SWIVEL_WITH_ANGLE, count);
    int some = 0, whole = 0, none = 0;
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
        whole += arc_count == 1 && arcs[n][0].from[0] == arcs[n][0].to[0] && arcs[n][0].from[1] == arcs[n][0].to[1];
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
    Crowd crowd = crowd_of(SWIVEL_LIMIT_SHOULDER_BOX, 441);
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
    CHECK_REFUSED(swivel_mirror(SWIVEL_FIELD_COUNT, SWIVEL_XYZ, value, value), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_mirror(SWIVEL_ELBOW, SWIVEL_XYZ, value, value), SWIVEL_INVALID_ARGUMENT);
    for (const float x : value) CHECK(x == 7);
    CHECK(swivel_range(-kPi, kPi, value) == SWIVEL_OK);
    CHECK(swivel_cone(axis, kPi, value) == SWIVEL_OK);
    CHECK(swivel_flexion(0, kPi, value) == SWIVEL_OK);
    CHECK(value[0] == 1);
    CHECK(value[1] == 0);
}
