// SPDX-License-Identifier: MIT
//
// The promise: between its keys a glTF channel goes as the specification says. Judged by motions that each kind of key
// can hold exactly: cubics by their values and slopes, straight ways, even turns, jumps.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <functional>

#include "tests/test_random.h"
#include "tools/formats/gltf_sampler.h"

namespace {

using namespace swivel::formats;
using Eigen::Quaterniond;
using Eigen::Vector4d;
using swivel::test::Random;

Vector4d random_vector(Random& random)
{
    return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
}

// Keys some uneven time apart.
GltfSampler sampler_of(Random& random, Interpolation interpolation, const std::function<Vector4d(double)>& value)
{
    GltfSampler sampler;
    sampler.interpolation = interpolation;
    double time = random.between(-2, 2);
    for (int n = 0; n < 6; ++n, time += random.between(0.05, 3)) {
        sampler.time.push_back(time);
        sampler.value.push_back(value(time));
    }
    return sampler;
}

// Of two unit quaternions of one rotation or two; both signs are the same.
double off(const Quaterniond& a, const Quaterniond& b) { return a.angularDistance(b); }

}  // namespace

TEST_CASE("gltf sampler: cubics come back from their values and slopes")
{
    rc::prop("vectors, and rotations by their direction", [](std::uint64_t seed) {
        Random random{seed};
        const Vector4d a = random_vector(random), b = random_vector(random), c = random_vector(random),
                       d = random_vector(random);
        const auto at = [&](double t) -> Vector4d { return a + t * b + t * t * c + t * t * t * d; };
        const auto slope = [&](double t) -> Vector4d { return b + 2 * t * c + 3 * t * t * d; };
        GltfSampler sampler = sampler_of(random, Interpolation::cubic, at);
        sampler.value.clear();
        for (const double t : sampler.time) {
            sampler.value.push_back(slope(t));
            sampler.value.push_back(at(t));
            sampler.value.push_back(slope(t));
        }
        for (int n = 0; n < 20; ++n) {
            const double t = random.between(sampler.time.front(), sampler.time.back());
            const double size = 1 + std::pow(std::abs(t) + 3, 3);  // of what is added up; keys are 3 apart at most
            REQUIRE((sample_vector(sampler, t) - at(t).head<3>()).norm() <= 1e-13 * size);
            if (at(t).norm() > 0.1)
                REQUIRE(off(sample_rotation(sampler, t), Quaterniond(at(t).normalized())) <= 1e-11 * size);
        }
    });
}

TEST_CASE("gltf sampler: straight ways and even turns come back from their keys, whichever sign a quaternion has")
{
    rc::prop("up to half a turn from key to key", [](std::uint64_t seed) {
        Random random{seed};
        const Vector4d start = random_vector(random), velocity = random_vector(random);
        const auto at = [&](double t) -> Vector4d { return start + t * velocity; };
        const GltfSampler way = sampler_of(random, Interpolation::linear, at);
        const Eigen::Vector3d axis = random.direction();
        const double speed = random.between(-1, 1);  // 3 radians at most in 3 seconds
        const auto turned = [&](double t) { return Quaterniond(Eigen::AngleAxisd(speed * t, axis)); };
        const GltfSampler turn = sampler_of(random, Interpolation::linear, [&](double t) -> Vector4d {
            return (random.between(-1, 1) < 0 ? -1 : 1) * turned(t).coeffs();
        });
        for (int n = 0; n < 20; ++n) {
            const double t = random.between(way.time.front(), way.time.back());
            REQUIRE((sample_vector(way, t) - at(t).head<3>()).norm() <= 1e-13 * (1 + std::abs(t)));
            const double u = random.between(turn.time.front(), turn.time.back());
            REQUIRE(off(sample_rotation(turn, u), turned(u)) <= 1e-7);
        }
    });
}

TEST_CASE("gltf sampler: steps hold a key up to the next, and every kind holds its first and last")
{
    Random random{1};
    for (const Interpolation kind : {Interpolation::step, Interpolation::linear, Interpolation::cubic}) {
        GltfSampler sampler = sampler_of(random, kind, [&](double) { return random_vector(random); });
        const std::vector<Vector4d> keys = sampler.value;
        if (kind == Interpolation::cubic) {
            sampler.value.clear();
            for (const Vector4d& key : keys) {
                sampler.value.push_back(random_vector(random));
                sampler.value.push_back(key);
                sampler.value.push_back(random_vector(random));
            }
        }
        const auto holds = [&](double time, const Vector4d& key) {
            CHECK((sample_vector(sampler, time) - key.head<3>()).norm() <= 1e-15);
            CHECK(off(sample_rotation(sampler, time), Quaterniond(key.normalized())) <= 1e-7);
        };
        holds(sampler.time.front() - 1, keys.front());
        holds(sampler.time.back() + 1, keys.back());
        for (std::size_t n = 0; n < keys.size(); ++n) {
            holds(sampler.time[n], keys[n]);
            if (kind != Interpolation::step || n + 1 == keys.size()) continue;
            holds(0.5 * (sampler.time[n] + sampler.time[n + 1]), keys[n]);
            holds(std::nextafter(sampler.time[n + 1], -HUGE_VAL), keys[n]);
        }
    }
}
