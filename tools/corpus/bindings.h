// SPDX-License-Identifier: MIT
//
// How the arm frame lies in the skeletons of the corpus, a binding for each group: written out, so that no change of
// how bindings are made moves a bit.
#pragma once

#include <cstdint>

namespace swivel::corpus {

struct Quaternion {
    float x, y, z, w;
};
struct Binding {
    Quaternion parent_from_arm, upper_from_arm, fore_from_arm, shoulder_rest, elbow_rest, wrist_rest;
};

inline constexpr std::uint32_t kGroupCount = 3;
inline constexpr std::uint32_t kLookCount = 2;  // groups more: the trunk's look, and the eye's
inline constexpr Binding kBindings[kGroupCount] = {
    {
        {0.1f, 0.7f, 0.7f, 0.1f},
        {0.5f, 0.5f, 0.5f, 0.5f},
        {0.7f, 0.1f, 0.7f, 0.1f},
        {0.0f, 0.0f, 0.6f, 0.8f},
        {0.28f, 0.0f, 0.0f, 0.96f},
        {-0.8f, 0.0f, 0.0f, 0.6f},
    },
    {
        {-0.82f, 0.46f, 0.34f, 0.02f},
        {0.5f, -0.5f, -0.5f, 0.5f},
        {0.34f, -0.82f, -0.02f, 0.46f},
        {0.36f, -0.48f, 0.0f, 0.8f},
        {0.0f, 0.0f, 0.352f, 0.936f},
        {0.0f, 0.28f, 0.0f, 0.96f},
    },
    {
        {0x1.524aap-2f, -0x1.4ed5dcp-3f, -0x1.739d5cp-2f, 0x1.b62e38p-1f},
        {0x1.07cac8p-1f, -0x1.10bc72p-1f, -0x1.110066p-1f, 0x1.a1d14ep-2f},
        {0x1.d1836cp-2f, -0x1.84d942p-2f, -0x1.3c97f2p-1f, 0x1.087448p-1f},
        {-0.2f, 0.4f, 0.4f, 0.8f},
        {0.0f, 0.28f, 0.0f, 0.96f},
        {0.1f, -0.5f, 0.5f, 0.7f},
    },
};

}  // namespace swivel::corpus
