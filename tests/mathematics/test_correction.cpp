// SPDX-License-Identifier: MIT
//
// The promise: a solve corrects the incoming pose. The wrist goes to its target wherever that is, also of bones that
// are straight or have no length. All is checked by forward kinematics of Eigen's, in double. test_bodies.cpp has whole
// bodies.
#include "core/correction.h"

#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/free_limb.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// An incoming limb: bones of joints whose rotations are any.
struct Posed {
    Vector3d upper, fore, hinge;
    Quaterniond shoulder, elbow;  // in the same space

    double size() const { return upper.norm() + fore.norm(); }
};
Posed random_posed(Random& random, double bend)
{
    const Vector3d line = random.direction(), axis = random.across(line);
    Posed in;
    in.upper = random.between(0.1, 1) * line;
    in.fore = random.between(0.1, 1) * (Eigen::AngleAxisd(bend, axis) * line);
    in.shoulder = random.rotation(), in.elbow = random.rotation();
    in.hinge = random.across(in.upper);
    return in;
}
template <class T>
BoneLines<T> posed_bones(const Posed& in)
{
    return bone_lines(mv<T>(in.upper), mv<T>(in.fore));
}
template <class T>
BendNormals<T> posed_normals(const Posed& in)
{
    return bend_normals(posed_bones<T>(in), mv<T>(in.hinge));
}

// A joint turns by what carries its incoming bone's frame to the solved one.
struct CorrectedLimb {
    Quaterniond shoulder, elbow;
    Vector3d wrist;  // where the bones then end

    CorrectedLimb(const Posed& in, const Vector3d& target, const Vector<float>& normal)
    {
        const BoneLines<float> bones = posed_bones<float>(in);
        FreeLimb limb({target, eigen(normal), bones.upper_length, bones.fore_length}, SWIVEL_POLE_NORMAL);
        const LimbPose pose = limb.solve();
        const BoneFrames<float> was = bone_frames(bones, normal);
        shoulder = (pose.shoulder * eigen(was.upper).conjugate() * in.shoulder).normalized();
        elbow = (pose.shoulder * pose.elbow * eigen(was.fore).conjugate() * in.elbow).normalized();
        wrist = shoulder * (in.shoulder.inverse() * in.upper) + elbow * (in.elbow.inverse() * in.fore);
    }
};

}  // namespace

TEST_CASE(
    "the wrist goes to any target in reach, with either normal, straight bones and bones without length among them")
{
    rc::prop("the bones end on it", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 50; ++n) {
            Posed in = random_posed(random, n % 5 ? random.between(-3.1, 3.1) : 0);
            if (n % 7 == 1) in.fore.setZero();
            if (n % 7 == 2) in.upper.setZero();
            const double near = std::fabs(in.upper.norm() - in.fore.norm());
            const Vector3d target = (near + random.between(0.02, 0.98) * (in.size() - near)) * random.direction();
            for (const bool is_steady : {false, true}) {
                const BendNormals<float> normals = posed_normals<float>(in);
                const CorrectedLimb got(in, target, is_steady ? normals.steady : normals.own);
                RC_ASSERT((got.wrist - target).norm() <= 2e-6 * in.size());
                // A bone without a length turns as the other one.
                const Quaterniond with_shoulder = got.shoulder * in.shoulder.inverse() * in.elbow;
                if (n % 7 == 1 || n % 7 == 2) RC_ASSERT(got.elbow.angularDistance(with_shoulder) <= 4e-6);
            }
        }
    });
}

TEST_CASE("the steady normal is the hinge of straight bones, their own of bent ones, and turns slowly between")
{
    Random random{3};
    for (int n = 0; n < 2000; ++n) {
        const Posed straight = random_posed(random, 0);
        Vector3d before = straight.hinge;
        const Vector3d axis = random.across(straight.upper);
        const double side = axis.dot(straight.hinge) < 0 ? -1 : 1;
        for (int step = 0; step <= 300; ++step) {
            Posed bent = straight;
            const double sine = 0.001 * step;
            bent.fore = Eigen::AngleAxisd(-std::asin(sine), axis) * straight.fore;
            const Vector3d normal = eigen(posed_normals<double>(bent).steady).normalized();
            if (sine < 0.05) REQUIRE((normal - straight.hinge).norm() <= 1e-12);
            if (sine > 0.17) REQUIRE((normal - side * axis).norm() <= 1e-9);
            // At most a right angle on the way. The steepest place of the blend is 1.5 times its mean, and a chord of
            // its length 1 is passed at distance sqrt(1/2).
            REQUIRE((normal - before).norm() <= 0.001 / 0.12 * 1.5 * 2 + 1e-9);
            before = normal;
        }
    }
}
