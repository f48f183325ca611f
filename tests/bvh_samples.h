#pragma once
// SPDX-License-Identifier: MIT
// Small BVH files for tests.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>
#include <string>
#include <string_view>

#include "tests/test_data.h"
#include "tools/formats/bvh.h"

namespace swivel::test {
using formats::BvhFile;

inline const std::string kTiny =  // line
    "HIERARCHY\n"                 // 1
    "ROOT Hips\n"                 // 2
    "{\n"                         // 3
    "  OFFSET 1 2 3\n"            // 4
    "  CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n"
    "  JOINT Arm\n"        // 6
    "  {\n"                // 7
    "    OFFSET 0 10 0\n"  // 8
    "    CHANNELS 3 Zrotation Xrotation Yrotation\n"
    "    JOINT Hand\n"           // 10
    "    {\n"                    // 11
    "      OFFSET 5 0 0\n"       // 12
    "      End Site\n"           // 13
    "      {\n"                  // 14
    "        OFFSET 1 0 0\n"     // 15
    "      }\n"                  // 16
    "    }\n"                    // 17
    "  }\n"                      // 18
    "}\n"                        // 19
    "MOTION\n"                   // 20
    "Frames: 2\n"                // 21
    "Frame Time: .5\n"           // 22
    "10 20 30 90 0 0 0 0 0\n"    // 23
    "10 20 30 0 0 0 90 0 90\n";  // 24

inline BvhFile read(const TempFolder& folder, std::string_view text)
{
    spill(folder / "t.bvh", text);
    return formats::read_bvh(folder / "t.bvh");
}

// A file with one joint of the given channels; one line of values per frame.
inline std::string one_joint(const std::string& channels, const std::string& values, std::size_t frame_count)
{
    return fmt::format("HIERARCHY\nROOT A\n{{\nOFFSET 0 0 0\nCHANNELS {}\n}}\nMOTION\nFrames: {}\nFrame Time: 1\n{}",
                       channels, frame_count, values);
}

inline Eigen::Matrix3d turn(char axis, double angle_deg)
{
    return Eigen::AngleAxisd(angle_deg * std::numbers::pi / 180, Eigen::Vector3d::Unit(axis - 'X')).toRotationMatrix();
}

}  // namespace swivel::test
