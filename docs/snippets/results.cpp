// SPDX-License-Identifier: MIT
#include "check.h"

namespace {

void give_arms(swivel::Crowd& crowd)
{
    crowd.write(SWIVEL_TARGET, 0,
                std::array<Float3, 2>{{{0.3f, 0.1f, 0.3f}, {0, 0.2f, 9}}});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{0.30f, 0.26f});
}

}  // namespace

TEST_CASE("docs: flags")
{
    swivel::Crowd crowd({swivel::limbs(2)});
    give_arms(crowd);
    crowd.solve();
    std::uint32_t far = 0;
    // [flags]
    std::array<std::uint32_t, 2> flags;
    crowd.read(SWIVEL_FLAGS, 0, flags);
    for (const std::uint32_t flag : flags) {
        if (flag & SWIVEL_BAD_INPUT)
            continue;  // a bad number went in; the limb has its rest pose
        if (flag & SWIVEL_CLAMPED_FAR)
            ++far;  // out of reach: step closer, lean, let go
    }
    // [end]
    CHECK(far == 1);
    CHECK(flags[0] == SWIVEL_REACHED);
}

TEST_CASE("docs: forward kinematics and residuals")
{
    swivel::Crowd crowd({swivel::limbs(2)});
    give_arms(crowd);
    crowd.solve();
    // [forward]
    std::array<Double3, 2> elbows, wrists;  // in the targets' space
    std::array<double, 2> off;              // from target to wrist, in arm lengths
    crowd.elbows(0, elbows);
    crowd.wrists(0, wrists);
    crowd.residuals(0, off);
    // [end]
    CHECK(distance(wrists[0], Float3{0.3f, 0.1f, 0.3f}) < 1e-6);
    CHECK(vec(elbows[0]).norm() == Approx(0.30));
    CHECK(off[0] < 1e-6);
    CHECK(off[1] == Approx((std::hypot(0.2, 9.0) - 0.56) / 0.56));
}

TEST_CASE("docs: joint angles")
{
    swivel::Crowd crowd({swivel::limbs(2)});
    give_arms(crowd);
    crowd.solve();
    // [angles]
    // Radians: shoulder y, x, z; flexion; wrist (0 without a hand).
    std::array<std::array<double, 7>, 2> angles;
    crowd.joint_angles(0, SWIVEL_YXZ, SWIVEL_XYZ, 0, angles);
    // [end]
    using Eigen::AngleAxisd;
    const Eigen::Quaterniond shoulder =
        AngleAxisd(angles[0][0], Eigen::Vector3d::UnitY()) *
        AngleAxisd(angles[0][1], Eigen::Vector3d::UnitX()) *
        AngleAxisd(angles[0][2], Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d fore(0, 0.26 * std::sin(angles[0][3]),
                               0.26 * std::cos(angles[0][3]));
    CHECK((shoulder * (Eigen::Vector3d(0, 0, 0.30) + fore) -
           Eigen::Vector3d(0.3, 0.1, 0.3))
              .norm() < 1e-6);
}

TEST_CASE("docs: packed results")
{
    swivel::Crowd crowd({swivel::limbs(2)});
    give_arms(crowd);
    crowd.solve();
    // [pack]
    // 16-bit rows: keep these, send them, or give them to a GPU.
    const std::vector<std::uint16_t> words = crowd.pack(0);  // of group 0
    const std::uint32_t row = swivel_packed_row(crowd.get(), 0, SWIVEL_SHOULDER);
    Float4 shoulder;  // limb 1 of block 0
    swivel_unpack_rotation(words.data() + row * SWIVEL_LANES + 1, SWIVEL_LANES,
                           shoulder.data());
    // [end]
    std::array<Float4, 2> want;
    crowd.read(SWIVEL_SHOULDER, 0, want);
    CHECK(turn_between(shoulder, want[1]) < 1.54e-4);
}

TEST_CASE("docs: rows")
{
    swivel::Crowd crowd({swivel::limbs(2)});
    give_arms(crowd);
    // [rows]
    const swivel_rows in = swivel_input_rows(crowd.get(), 0);  // group 0
    const std::uint32_t row = swivel_field_first_row(crowd.get(), 0, SWIVEL_TARGET);
    const std::uint32_t limb = 1;  // of the group
    float* const x = in.base +
                     (limb / SWIVEL_LANES * in.row_count + row) * SWIVEL_LANES +
                     limb % SWIVEL_LANES;
    x[0] = 0.1f;
    x[SWIVEL_LANES] = 0.2f;      // y
    x[2 * SWIVEL_LANES] = 0.3f;  // z
    crowd.solve();
    // [end]
    std::array<Double3, 2> wrists;
    crowd.wrists(0, wrists);
    CHECK(distance(wrists[1], Float3{0.1f, 0.2f, 0.3f}) < 1e-6);
}
