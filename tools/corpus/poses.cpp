// SPDX-License-Identifier: MIT
#include "tools/corpus/poses.h"

#include "tools/corpus/bodies.h"
#include "tools/corpus/hard_cases.h"
#include "tools/corpus/vectors.h"

namespace swivel::corpus {

namespace {

template <class Values>
void append(std::vector<float>& to, const Values& values)
{
    to.insert(to.end(), values.begin(), values.end());
}

// A scaled rotation and a place, as 16 or 12 numbers.
void append_matrix(std::vector<float>& to, swivel_pose_form form, const Body& body, std::size_t joint)
{
    const Rotation q = unit(rotation_of(body.rotations[joint]));
    const double scale = body.scales[joint];
    const std::array<float, 3> columns[] = {floats(scale * turn(q, {1, 0, 0})), floats(scale * turn(q, {0, 1, 0})),
                                            floats(scale * turn(q, {0, 0, 1})), body.translations[joint]};
    if (form == SWIVEL_MATRIX_ROWS) {
        for (std::size_t row = 0; row < 3; ++row)
            for (const auto& column : columns) to.push_back(column[row]);
        return;
    }
    for (const auto& column : columns) {
        append(to, column);
        if (form == SWIVEL_MATRIX_COLUMNS) to.push_back(&column == &columns[3] ? 1.0f : 0.0f);
    }
}

void append_body(Poses& poses, const Recipe& recipe, const Body& body)
{
    for (std::size_t n = 0; n < poses.joint_count; ++n) {
        // Joints in another order: from the last on.
        const std::size_t joint = poses.offsets.empty() ? n : poses.joint_count - 1 - n;
        if (has_matrices(recipe))
            append_matrix(poses.rotations, recipe.form, body, joint);
        else
            append(poses.rotations, body.rotations[joint]);
        if (recipe.pose & kTranslations) append(poses.translations, body.translations[n]);
        if (recipe.pose & kScales) poses.scales.insert(poses.scales.end(), 3, body.scales[n]);
    }
    if (!(recipe.pose & kRoots)) return;
    for (const double x : body.root_position) {
        if (recipe.pose & kFar)
            poses.far_roots.push_back(x);
        else
            poses.root_positions.push_back(static_cast<float>(x));
    }
    append(poses.root_rotations, body.root_rotation);
    poses.root_scales.push_back(body.root_scale);
}

// Numbers of the bodies in every other run, one in 256.
void spoil_bodies(const Recipe& recipe, std::string_view name, std::uint32_t frame, std::uint32_t body_count,
                  std::vector<float>& values)
{
    Random random = stream(recipe.seed, 0, name, Use::spoil, frame);
    const std::size_t each = values.size() / body_count;
    for (std::uint32_t n = 0; n < body_count; ++n)
        if (is_spoilt_run(n)) spoil(random, std::span(values).subspan(n * each, each), 256);
}

}  // namespace

std::uint32_t Poses::rotation_floats() const
{
    return form == SWIVEL_ROTATIONS ? 4 : form == SWIVEL_MATRIX_COLUMNS ? 16 : 12;
}

std::array<const std::vector<float>*, 4> Poses::solved() const
{
    static const std::vector<float> none;
    const std::vector<float>& places = translation_results.empty() ? translations : translation_results;
    return {results.empty() ? &rotations : &results, is_in_body ? &places : &none, &joint_rotations, &joint_positions};
}

Poses make_poses(const Recipe& recipe, std::uint32_t body_count, std::uint32_t frame)
{
    const std::vector<Body> bodies = bodies_of(recipe, body_count, frame);
    Poses poses;
    poses.body_count = body_count;
    poses.joint_count = static_cast<std::uint32_t>(bodies[0].rotations.size());
    poses.form = recipe.form;
    poses.prop_group = prop_group(recipe);
    poses.look_group = look_group(recipe);
    poses.group_count = poses.look_group + (recipe.pose & kLooks ? kLookCount : 0);
    if (recipe.pose & kOffsets)
        for (std::size_t n = poses.joint_count; n-- > 0;)
            poses.offsets.push_back(n * poses.rotation_floats() * sizeof(float));
    poses.is_in_body = recipe.pose & kInBody;
    const Skeleton skeleton = skeleton_of(recipe);
    for (const Body& body : bodies) append_body(poses, recipe, poses.is_in_body ? in_body_space(skeleton, body) : body);
    const auto spoil_all = [&](std::string_view name, std::vector<float>& values) {
        spoil_bodies(recipe, name, frame, poses.body_count, values);
    };
    spoil_all("joint_rotation", poses.rotations);
    spoil_all("joint_translation", poses.translations);
    spoil_all("joint_scale", poses.scales);
    spoil_all("root_position", poses.root_positions);
    spoil_all("root_rotation", poses.root_rotations);
    spoil_all("root_scale", poses.root_scales);
    if (recipe.pose & kApart) poses.results.resize(poses.rotations.size());
    if ((recipe.pose & kApart) && poses.is_in_body) poses.translation_results.resize(poses.translations.size());
    if (recipe.pose & kAllJoints) {
        poses.joint_rotations.resize(std::size_t{4} * body_count * poses.joint_count);
        poses.joint_positions.resize(std::size_t{3} * body_count * poses.joint_count);
    }
    return poses;
}

}  // namespace swivel::corpus
