// SPDX-License-Identifier: MIT
#include "bench/rivals/ozz_frame.h"

#include <algorithm>

#include "bench/rivals/check.h"

namespace bench {

namespace {

struct Joint {
    Vec position;
    Vec axes[3];  // of its own frame, in the world, scaled
};

// A joint at an offset in its parent's frame, turned there by a rotation.
Joint child(const Joint& parent, Vec offset, const float (&rotation)[4])
{
    const auto to_world = [&](Vec v) { return v.x * parent.axes[0] + v.y * parent.axes[1] + v.z * parent.axes[2]; };
    const Vec unit[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Joint joint{parent.position + to_world(offset), {}};
    for (int axis = 0; axis < 3; ++axis) joint.axes[axis] = to_world(turn(rotation, unit[axis]));
    return joint;
}

Matrix matrix(const Joint& joint)
{
    Matrix m{};
    const auto put = [&](int column, Vec v, float w) {
        float(&to)[4] = m.columns[column];
        to[0] = static_cast<float>(v.x), to[1] = static_cast<float>(v.y), to[2] = static_cast<float>(v.z), to[3] = w;
    };
    for (int axis = 0; axis < 3; ++axis) put(axis, joint.axes[axis], 0);
    put(3, joint.position, 1);
    return m;
}

}  // namespace

OzzFrame::OzzFrame(const FrameView& frame) : models_(frame.character_count), before_(frame.character_count)
{
    const float straight[4] = {0, 0, 0, 1};
    for (std::size_t n = 0; n < frame.character_count; ++n)
        for (std::size_t side = 0; side < kArms; ++side) {
            const JointPose& chest = frame.world[n].chest;
            const Rig& rig = frame.rigs[side];
            const double scale = chest.scale[0];
            const Joint parent{vec(frame.world[n].arm[side].shoulder.position),
                               {scale * turn(chest.rotation, {1, 0, 0}), scale * turn(chest.rotation, {0, 1, 0}),
                                scale * turn(chest.rotation, {0, 0, 1})}};
            // Half of 30 degrees; bones along +x close about -y, those along -x about +y.
            const float bent[4] = {0, side == 0 ? -0.258819f : 0.258819f, 0, 0.965926f};
            const Joint shoulder = child(parent, {0, 0, 0}, straight);
            const Joint elbow = child(shoulder, vec(rig.elbow_offset), bent);
            const Joint wrist = child(elbow, vec(rig.wrist_offset), straight);
            models_[n].arm[side] = {matrix(shoulder), matrix(elbow), matrix(wrist)};
            std::copy_n(straight, 4, before_[n].arm[side].shoulder.rotation);
            std::copy_n(bent, 4, before_[n].arm[side].elbow.rotation);
        }
}

}  // namespace bench
