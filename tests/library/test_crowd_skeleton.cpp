// SPDX-License-Identifier: MIT
//
// The promise: a limb bound by joints of a skeleton poses that skeleton. It may have joints in between, which stay at
// rest, and twist bones. Forward kinematics over all joints, by Eigen in double, finds the wrist on its target.
#include "tests/body_crowd.h"
#include "tests/test_whole_limb.h"

#include <cstring>
#include <numeric>
#include <string>

using namespace swivel;
using namespace swivel::test;

namespace {

// How many joints lie above the shoulder, and between those of the limb.
struct Shape {
    std::uint32_t above, upper, fore;
};
constexpr Shape kShapes[] = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 0, 1}, {3, 2, 3}};

// Every joint gets another index.
BodySkeleton shuffled(Random& random, const BodySkeleton& skeleton)
{
    std::vector<std::uint32_t> place(skeleton.size());
    std::iota(place.begin(), place.end(), 0u);
    for (std::uint32_t n = skeleton.size(); n > 1; --n) std::swap(place[n - 1], place[random.below(n)]);
    BodySkeleton moved = skeleton;
    for (std::uint32_t n = 0; n < skeleton.size(); ++n) {
        const std::int32_t parent = skeleton.parents[n];
        moved.parents[place[n]] =
            parent < 0 ? -1 : static_cast<std::int32_t>(place[static_cast<std::uint32_t>(parent)]);
        moved.rotations[place[n]] = skeleton.rotations[n];
        moved.translations[place[n]] = skeleton.translations[n];
    }
    BodyLimbJoints& limb = moved.limbs[0];
    for (std::uint32_t* const joint : {&limb.shoulder, &limb.elbow, &limb.wrist}) *joint = place[*joint];
    for (std::uint32_t& joint : limb.twist_bones) joint = place[joint];
    return moved;
}

// A limb that is hidden in a skeleton: rotations of any length, joints in any order, and others that nobody may look
// at.
BodySkeleton random_skeleton(Random& random, const Shape& shape, std::uint32_t twist_bone_count)
{
    BodySkeleton s;
    BodyLimbJoints limb{};
    std::uint32_t last = ~0u;
    const auto put = [&](std::uint32_t parent, const Float4& rotation, const Float3& translation) {
        s.parents.push_back(static_cast<std::int32_t>(parent));
        s.rotations.push_back(rotation);
        s.translations.push_back(translation);
        return last = s.size() - 1;
    };
    const auto turn = [&] { return floats(Quaterniond(random.spread(0.1, 10) * random.rotation().coeffs())); };
    const auto add = [&](std::uint32_t more) {  // some joints, and then one
        for (; more > 0; --more) put(last, turn(), floats(random.vector(0.2, 1)));
        return put(last, turn(), floats(random.vector(0.2, 1)));
    };
    limb.shoulder = add(shape.above), limb.elbow = add(shape.upper), limb.wrist = add(shape.fore);
    const auto at = [&] { return joints_at(s, s.rest()); };
    if (shape.fore == 0 && random.below(3) == 0) {  // the forearm lies along the upper arm
        const Vector3d upper = at()[limb.elbow].place - at()[limb.shoulder].place;
        s.translations[limb.wrist] =
            floats(Vector3d(at()[limb.elbow].rotation.conjugate() * (random.between(0.2, 1) * upper.normalized())));
    }
    // Twist bones below any of the forearm's joints, on a line beside the bone; some below a joint of their own.
    const std::vector<JointAt> rest = at();
    const Vector3d fore = rest[limb.wrist].place - rest[limb.elbow].place;
    for (std::uint32_t n = 0; n < twist_bone_count; ++n) {
        last = limb.elbow + random.below(limb.wrist - limb.elbow);
        const JointAt& from = rest[last];
        const Vector3d place =
            rest[limb.elbow].place + (n + 1.0) / (twist_bone_count + 1) * fore + 0.1 * random.across(fore);
        if (random.below(3) == 0) put(last, {0, 0, 0, 2}, {0, 0, 0});
        limb.twist_bones.push_back(
            put(last, turn(), floats(Vector3d(from.rotation.conjugate() * (place - from.place)))));
    }
    for (const std::uint32_t joint : {limb.shoulder, limb.elbow, limb.wrist, last})
        put(put(joint, {0, 0, 0, 0}, {NAN, 0, 0}), {NAN, 0, 0, 0}, {INFINITY, 0, 0});
    const Vector3d upper = rest[limb.elbow].place - rest[limb.shoulder].place;
    limb.bend = floats(Vector3d(rest[limb.shoulder].rotation.conjugate() *
                                (random.across(upper) + random.between(-1, 1) * upper.normalized())));
    s.limbs = {limb};
    return shuffled(random, s);
}

Float4 result_of(const Crowd& crowd, swivel_field field, std::uint32_t n, std::uint32_t component = 0)
{
    std::array<float, 28> value{};
    REQUIRE(swivel_read(crowd.get(), field, 0, n, 1, {value.data(), sizeof value}) == SWIVEL_OK);
    Float4 q;
    std::copy_n(value.begin() + component, 4, q.begin());
    CHECK(is_unit(q));
    return q;
}

// The limb's results in the skeleton's places; all other joints rest.
Body posed(const BodySkeleton& skeleton, const Crowd& crowd, std::uint32_t n)
{
    Body body = skeleton.rest();
    const BodyLimbJoints& limb = skeleton.limbs[0];
    body.rotations[limb.shoulder] = result_of(crowd, SWIVEL_SHOULDER, n);
    body.rotations[limb.elbow] = result_of(crowd, SWIVEL_ELBOW, n);
    if (swivel_field_row_count(crowd.get(), 0, SWIVEL_WRIST))
        body.rotations[limb.wrist] = result_of(crowd, SWIVEL_WRIST, n);
    if (swivel_field_row_count(crowd.get(), 0, SWIVEL_TWIST_BONES))
        for (std::uint32_t bone = 0; bone < limb.twist_bones.size(); ++bone)
            body.rotations[limb.twist_bones[bone]] = result_of(crowd, SWIVEL_TWIST_BONES, n, 4 * bone);
    return body;
}

// The root's place in a world in which the limb's shoulder and its parent are as the goal has them; without WORLD that
// is the arm frame.
JointAt root_of(const BodySkeleton& skeleton, const swivel_binding& bound, const Limb& limb, swivel_features features)
{
    Parent parent = limb.parent();
    if (!(features & SWIVEL_WORLD)) parent.rotation = quat(bound.parent_from_arm).normalized().conjugate();
    const std::vector<JointAt> rest = joints_at(skeleton, skeleton.rest());
    const std::uint32_t shoulder = skeleton.limbs[0].shoulder;
    const std::int32_t above = skeleton.parents[shoulder];
    const Quaterniond root =
        above < 0 ? parent.rotation : parent.rotation * rest[static_cast<std::size_t>(above)].rotation.conjugate();
    return {root, parent.position - parent.scale * (root * rest[shoulder].place), parent.scale};
}

struct Posed {
    BodySkeleton skeleton;
    BodyLimbJoints limb;
    swivel_binding bound;
    Crowd crowd;
    std::vector<Limb> limbs;
    std::vector<JointAt> roots;

    Posed(Random& random, const Shape& shape, swivel_features features, std::uint32_t count, std::uint32_t bones = 0)
        : skeleton(random_skeleton(random, shape, bones)),
          limb(skeleton.limbs[0]),
          bound(bind(skeleton.view(), skeleton.joints(0))),
          crowd(crowd_of(features, count, bound, bones))
    {
        for (std::uint32_t n = 0; n < count; ++n) {
            limbs.push_back(random_limb(random, features, {bound.lengths[0], bound.lengths[1]}));
            write_limb(crowd, 0, n, limbs[n]);
            roots.push_back(root_of(skeleton, bound, limbs[n], features));
        }
    }
    std::vector<JointAt> at(const Body& body, std::uint32_t n) const { return joints_at(skeleton, body, roots[n]); }
};

double turn_about(const Quaterniond& q, const Vector3d& axis)
{
    return std::remainder(2 * std::atan2(q.vec().dot(axis), q.w()), 2 * kPi);
}

}  // namespace

TEST_CASE("skeletons by joints: the wrist is on its target, the hand as wanted, the elbow where pole and bend say")
{
    const swivel_features j = SWIVEL_JOINTS, w = SWIVEL_WORLD, h = SWIVEL_WITH_HAND, d = SWIVEL_POLE_DIRECTION;
    for (const swivel_features features :
         {j, j | h, j | w, j | w | h, j | w | h | d, j | w | h | SWIVEL_WITH_ANGLE, j | SWIVEL_WITH_ANGLE})
        for (const Shape& shape : kShapes)
            for (std::uint64_t seed = 0; seed < 4; ++seed) {
                Random random{features * 8 + seed};
                Posed p(random, shape, features, 21);
                p.crowd.solve();
                const auto flags = read<std::uint32_t>(p.crowd, SWIVEL_FLAGS);
                std::vector<Places> places;
                Quaterniond first = Quaterniond::Identity();  // the elbow's, as the upper arm has it
                for (std::uint32_t n = 0; n < 21; ++n) {
                    INFO("features " << features << ", between " << shape.upper << " and " << shape.fore << ", seed "
                                     << seed << ", limb " << n);
                    const std::vector<JointAt> at = p.at(posed(p.skeleton, p.crowd, n), n);
                    places.push_back({at[p.limb.elbow].place, at[p.limb.wrist].place, at[p.limb.wrist].rotation});
                    check_places(p.limbs[n], features, places[n], flags[n]);
                    // Flexion carries the forearm towards the bend, which goes along with the upper arm.
                    const JointAt& shoulder = at[p.limb.shoulder];
                    const Vector3d upper = places[n].elbow - shoulder.place, fore = places[n].wrist - places[n].elbow,
                                   bend = shoulder.rotation * vec(p.limb.bend);
                    CHECK(upper.cross(fore).normalized().dot(upper.cross(bend).normalized()) == Approx(1).margin(1e-6));
                    // The elbow turns about one axis of the upper arm.
                    const Quaterniond elbow = shoulder.rotation.conjugate() * at[p.limb.elbow].rotation;
                    if (n == 0) first = elbow;
                    const Vector3d hinge = shoulder.rotation.conjugate() * upper.cross(bend).normalized();
                    CHECK((elbow * first.conjugate()).vec().cross(hinge).norm() <= 3e-6);
                }
                check_forward(p.crowd, 0, p.limbs, places, 1e-6);
            }
}

TEST_CASE("skeletons by joints: the binding is that of the three joints alone, in any memory, bit for bit")
{
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Random random{seed};
        const BodySkeleton s = random_skeleton(random, {seed % 2 == 0 ? 3u : 0u, 0, 0}, 0);
        const BodyLimbJoints& limb = s.limbs[0];
        ThreeJoints alone;
        alone.rotations = {s.rotations[limb.shoulder], s.rotations[limb.elbow], s.rotations[limb.wrist]};
        alone.translations = {Float3{}, s.translations[limb.elbow], s.translations[limb.wrist]};
        alone.bend = limb.bend;
        struct Joint {
            Float3 place;
            std::int32_t parent;
            Float4 rotation;
            float more;
        };
        std::vector<Joint> joints;
        for (std::uint32_t n = 0; n < s.size(); ++n)
            joints.push_back({s.translations[n], s.parents[n], s.rotations[n], 0});
        swivel_skeleton apart = s.view();
        apart.parents = stream(joints, &Joint::parent);
        apart.translations = stream(joints, &Joint::place);
        apart.rotations = stream(joints, &Joint::rotation);
        const swivel_binding by_joints = bind(s.view(), s.joints(0)), by_three = alone.bound(),
                             by_apart = bind(apart, s.joints(0));
        CHECK(std::memcmp(&by_joints, &by_apart, sizeof by_apart) == 0);
        CHECK(std::memcmp(&by_joints, &by_three, sizeof by_three) == 0);
        CHECK(std::memcmp(by_three.elbow_parent_from_arm, by_three.upper_from_arm, 16) == 0);
        CHECK(std::memcmp(by_three.wrist_parent_from_arm, by_three.fore_from_arm, 16) == 0);
        CHECK(by_three.twist_bone_count == 0);
    }
}

TEST_CASE("skeletons by joints: twist bones, wherever they hang, share the hand's twist about the forearm")
{
    constexpr std::uint32_t count = 24, features = kWorldJointsHand;
    for (const Shape& shape : kShapes)
        for (const std::uint32_t bones : {1u, 3u, 7u}) {
            Random random{bones + 10 * shape.fore};
            Posed p(random, shape, features, count, bones);
            p.crowd.write(SWIVEL_TARGET, 0, std::vector<Float3>{{kNan, 0, 0}}, count - 1);
            p.crowd.solve();
            int twisted = 0;
            for (std::uint32_t n = 0; n < count; ++n) {
                INFO("between " << shape.fore << ", bones " << bones << ", limb " << n);
                const Body body = posed(p.skeleton, p.crowd, n);
                Body carried = body;  // the forearm as it is, with all that is below it at rest
                carried.rotations[p.limb.wrist] = p.skeleton.rotations[p.limb.wrist];
                for (const std::uint32_t bone : p.limb.twist_bones)
                    carried.rotations[bone] = p.skeleton.rotations[bone];
                const std::vector<JointAt> at = p.at(body, n), at_rest = p.at(carried, n);
                const Vector3d axis = (at[p.limb.wrist].place - at[p.limb.elbow].place).normalized();
                const auto added = [&](std::uint32_t joint) {
                    return Quaterniond(at[joint].rotation * at_rest[joint].rotation.conjugate());
                };
                const double twist = n == count - 1 ? 0 : turn_about(added(p.limb.wrist), axis);
                if (std::fabs(twist) > 3.1) continue;
                if (std::fabs(twist) > 0.5) ++twisted;
                for (std::uint32_t bone = 0; bone < bones; ++bone) {
                    const Quaterniond turn = added(p.limb.twist_bones[bone]);
                    CHECK(turn.vec().cross(axis).norm() <= 2e-6);
                    CHECK(turn_about(turn, axis) == Approx(twist * (bone + 1) / (bones + 1)).margin(2.1e-3));
                }
            }
            CHECK(twisted > 10);
        }
}

TEST_CASE("skeletons by joints: an incoming pose is read as it was written, and kept without weights")
{
    constexpr std::uint32_t count = 20;
    constexpr std::pair<swivel_field, swivel_field> kIncoming[] = {{SWIVEL_SHOULDER, SWIVEL_INCOMING_SHOULDER},
                                                                   {SWIVEL_ELBOW, SWIVEL_INCOMING_ELBOW},
                                                                   {SWIVEL_WRIST, SWIVEL_INCOMING_WRIST}};
    for (const Shape& shape : kShapes) {
        Random random{shape.above + 20};
        Posed p(random, shape, kWorldJointsHand, count);
        p.crowd.solve();
        Crowd kept = crowd_of(kWorldJointsHand | SWIVEL_WITH_INCOMING | SWIVEL_POLE_INCOMING | SWIVEL_WITH_WEIGHTS,
                              count, p.bound);
        for (std::uint32_t n = 0; n < count; ++n) {
            Limb other = p.limbs[n];
            other.target = floats(Vector3d(vec(other.position) + 0.9 * (vec(other.target) - vec(other.position))));
            other.hand = floats(random.rotation());
            write_limb(kept, 0, n, other);
        }
        for (const auto& [result, incoming] : kIncoming) {  // any of the two quaternions of each rotation
            std::vector<Float4> values = read<Float4>(p.crowd, result);
            for (std::size_t n = 0; n < count; n += 2)
                for (float& x : values[n]) x = -x;
            kept.write(incoming, 0, values);
        }
        kept.write_all(SWIVEL_WEIGHTS, 0, Float3{0, 0, 0});
        kept.solve();
        for (std::uint32_t n = 0; n < count; ++n) {
            INFO("between " << shape.upper << " and " << shape.fore << ", limb " << n);
            const Body before = posed(p.skeleton, p.crowd, n), after = posed(p.skeleton, kept, n);
            for (const std::uint32_t joint : {p.limb.shoulder, p.limb.elbow, p.limb.wrist})
                CHECK(distance(quat(before.rotations[joint]).normalized(), quat(after.rotations[joint]).normalized()) <=
                      2e-4);
        }
        for (const auto& [result, incoming] : kIncoming) {  // and the same comes out
            const auto got = read<Float4>(kept, result), want = read<Float4>(kept, incoming);
            for (std::uint32_t n = 0; n < count; ++n)
                CHECK((quat(got[n]).coeffs() - quat(want[n]).coeffs()).norm() <= 2e-5);
        }
    }
}

TEST_CASE("skeletons by joints: effectors and aims are the wrist joint's own")
{
    constexpr std::uint32_t count = 20;
    for (const Shape& shape : kShapes)
        for (const swivel_features features :
             {kWorldJointsHand | SWIVEL_WITH_EFFECTOR, kWorldJointsHand | SWIVEL_WITH_AIM,
              swivel_features{SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_AIM}}) {
            Random random{shape.above + features};
            Posed p(random, shape, features, count);
            const Vector3d point = random.vector(0.1, 0.3), axis = random.direction();
            if (features & SWIVEL_WITH_EFFECTOR) p.crowd.write_all(SWIVEL_EFFECTOR, 0, floats(point));
            if (features & SWIVEL_WITH_AIM) p.crowd.write_all(SWIVEL_AIM, 0, aim({axis.x(), axis.y(), axis.z()}, 0.7));
            p.crowd.solve();
            const auto flags = read<std::uint32_t>(p.crowd, SWIVEL_FLAGS);
            std::vector<double> residuals(count);
            p.crowd.residuals(0, residuals);
            for (std::uint32_t n = 0; n < count; ++n) {
                INFO("features " << features << ", between " << shape.upper << " and " << shape.fore << ", limb " << n);
                const Body body = posed(p.skeleton, p.crowd, n);
                const JointAt wrist = p.at(body, n)[p.limb.wrist];
                const double scale = p.roots[n].scale,
                             length = scale * p.limbs[n].lengths[0] + scale * p.limbs[n].lengths[1];
                const Vector3d target = vec(p.limbs[n].target), line = wrist.rotation * axis;
                double off = (wrist.place + scale * (wrist.rotation * point) - target).norm();
                if (features & SWIVEL_WITH_AIM) {  // from the ray, which starts at the wrist
                    const Vector3d ahead = target - wrist.place;
                    off = ahead.dot(line) > 0 ? ahead.cross(line).norm() : ahead.norm();
                }
                if (flags[n] & SWIVEL_REACHED) CHECK(off <= 3e-6 * length);
                if (flags[n] & SWIVEL_REACHED)
                    CHECK((features & SWIVEL_WITH_EFFECTOR || (target - wrist.place).dot(line) > 0));
                CHECK(residuals[n] == Approx(off / length).margin(3e-6));
                if (features == (kWorldJointsHand | SWIVEL_WITH_AIM))
                    CHECK(distance(quat(body.rotations[p.limb.wrist]).normalized(),
                                   quat(p.limbs[n].hand).normalized()) <= 2e-6);
            }
        }
}

TEST_CASE("a rest pose bent by more than 10 degrees shows where the limb bends to, one bent by less must be told")
{
    Random random{12};
    for (const double bent : {10.01, 45.0, 170.0, 9.99, 0.5, 0.0, 180.0}) {
        INFO(bent << " degrees");
        ThreeJoints limb = skewed_joints(random);
        const Vector3d upper = vec(limb.translations[1]), hinge = vec(limb.bend).cross(upper).normalized();
        const Vector3d fore =
            quat(limb.rotations[1]).normalized().conjugate() * (Eigen::AngleAxisd(-bent * degrees(1), hinge) * upper);
        limb.translations[2] = floats(fore);
        const swivel_binding given = limb.bound();
        limb.bend = {};
        if (bent < 10 || bent == 180) {
            CHECK_THROWS_AS(limb.bound(), Error);
            continue;
        }
        const swivel_binding shown = limb.bound();
        CHECK(distance(quat(given.parent_from_arm), quat(shown.parent_from_arm)) <= 2e-6);
        CHECK(distance(quat(given.fore_from_arm), quat(shown.fore_from_arm)) <= 2e-6);
        swivel_limb_joints joints = limb.joints();
        joints.size = offsetof(swivel_limb_joints, bend);  // of an older header
        std::ranges::fill(joints.bend, kNan);
        const swivel_binding shorter = bind(limb.skeleton(), joints);
        CHECK(std::memcmp(&shown, &shorter, sizeof shown) == 0);
    }
}
