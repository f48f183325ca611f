// SPDX-License-Identifier: MIT
#include "tools/python/skeletons.h"

#include <cstddef>

#include "tools/python/crowd.h"

namespace py = pybind11;

namespace swivel::python {

SkeletonArrays skeleton_of(const py::object& parents, const py::object& translations, const py::object& rotations)
{
    const std::size_t count = length_of("parents", parents);
    const auto floats = py::dtype::of<float>();
    SkeletonArrays made{swivel_default_skeleton(),
                        input({"parents", count, 1}, parents, py::dtype::of<std::int32_t>(), false),
                        input({"translations", count, 3}, translations, floats, false),
                        {}};
    if (!rotations.is_none()) made.rotations = input({"rotations", count, 4}, rotations, floats, false);
    made.view.joint_count = count_of("number of joints", static_cast<std::int64_t>(count));
    made.view.parents = made.parents.values;
    made.view.translations = made.translations.values;
    made.view.rotations = made.rotations.values;
    return made;
}

LimbJoints joints_of(std::int64_t shoulder, std::int64_t elbow, std::int64_t wrist,
                     const std::vector<std::int64_t>& twist_bones, const py::object& bend)
{
    LimbJoints made;
    made.view =
        swivel_default_limb_joints(count_of("shoulder", shoulder), count_of("elbow", elbow), count_of("wrist", wrist));
    for (const std::int64_t bone : twist_bones) made.twist_bones.push_back(count_of("twist_bones", bone));
    made.view.twist_bones = made.twist_bones.data();
    made.view.twist_bone_count = count_of("number of twist bones", static_cast<std::int64_t>(twist_bones.size()));
    copy("bend", bend, made.view.bend);
    return made;
}

}  // namespace swivel::python
