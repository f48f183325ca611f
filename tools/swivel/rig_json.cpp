// SPDX-License-Identifier: MIT
#include "tools/swivel/rig_json.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "tools/rig/clip_doubts.h"
#include "tools/rig/limb_axes.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

using formats::Clip;

// What the file calls a joint; null for the one above a root.
nlohmann::ordered_json number_of(const Clip& clip, int joint)
{
    return joint < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(joint_at(clip, joint).number);
}

std::vector<double> vector_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json json_of(const AngleRange& range) { return {range.least, range.most}; }

nlohmann::ordered_json json_of_frame(const Clip& clip, const Limb& limb, const Facing& facing)
{
    nlohmann::ordered_json out;
    for (int n = 0; n < 3; ++n) {
        const Eigen::Vector3d axis_w = limb.axes_w.col(n);
        out["axes"][std::array{"x", "y", "z"}[static_cast<std::size_t>(n)]] = {
            {"world", vector_of(axis_w)}, {"points", direction_words(axis_w, facing)}};
    }
    if (const std::optional<LimbRange> range = range_of(clip, limb))
        out["clip_range"] = {{"bend", vector_of(range->bend)},
                             {"upper_from_z_deg", json_of(range->from_z)},
                             {"shoulder_cone", {{"axis", vector_of(range->axis)}, {"opening_deg", range->opening_deg}}},
                             {"flexion_deg", json_of(range->flexion)}};
    return out;
}

// What bind() takes, field by field.
nlohmann::ordered_json json_of_chain(const swivel_chain& chain)
{
    return {{"elbow_offset", chain.elbow_offset},           {"wrist_offset", chain.wrist_offset},
            {"shoulder_rotation", chain.shoulder_rotation}, {"elbow_rotation", chain.elbow_rotation},
            {"wrist_rotation", chain.wrist_rotation},       {"bend", chain.bend}};
}

nlohmann::ordered_json json_of(const Clip& clip, const LimbFinding& finding, const Facing& facing)
{
    nlohmann::ordered_json out{{"limb", limb_word(finding.name)}, {"bound", finding.limb.has_value()}};
    if (!finding.limb) {
        out["problem"] = problem_text(finding);
        return out;
    }
    const Limb& limb = *finding.limb;
    const auto names = [&](const auto& joints) {
        auto all = nlohmann::ordered_json::array();
        for (const int joint : joints) all.push_back(joint_at(clip, joint).name);
        return all;
    };
    out["named_by"] = limb.from;
    out["joints"] = names(limb.joints);
    for (const int joint : limb.joints) out["numbers"].push_back(joint_at(clip, joint).number);
    out["lengths"] = {limb.bound.lengths[0], limb.bound.lengths[1]};
    out["scale"] = limb.scale;
    out["mirrored"] = limb.mirrored;
    out["upper_bone"] = vector_of(limb.upper_bone);
    out["lower_bone"] = vector_of(limb.lower_bone);
    out["bend"] = vector_of(limb.bend);
    out["bend_source"] = limb.bend_source;
    out["chain"] = json_of_chain(rest_chain(clip, limb.chain, limb.bend));
    out.update(json_of_frame(clip, limb, facing));
    out["joints_between"] = names(limb.chain.between());
    out["unevenness"] = limb.unevenness;
    if (!limb.notes.empty()) out["notes"] = limb.notes;
    return out;
}

}  // namespace

nlohmann::ordered_json json_of(const MotionFile& motion, const std::string& file, const LimbSearch& search,
                               bool with_joints)
{
    const Clip& clip = motion.clip();
    const Facing& facing = search.facing;
    nlohmann::ordered_json out{{"file", file},
                               {"motion", motion.describe()},
                               {"joints", clip.joints.size()},
                               {"frames", clip.frame_count},
                               {"frame_time", frame_time_of(clip)},
                               {"faces", vector_of(facing.forwards_w)},
                               {"faces_by", facing.forwards_source},
                               {"up", vector_of(facing.up_w)},
                               {"up_by", facing.up_source}};
    if (const auto notes = motion.notes(); !notes.empty()) out["notes"] = notes;
    if (const auto doubts = clip_doubts(clip, search.body); !doubts.empty()) out["doubts"] = doubts;
    for (const LimbFinding& finding : search.findings) out["limbs"].push_back(json_of(clip, finding, facing));
    for (const BodyPart& part : search.body)
        for (const int joint : part.joints) out["body"][part.name].push_back(joint_at(clip, joint).number);
    const std::vector<formats::JointPose> rest_w = formats::rest_pose(clip);
    if (with_joints)
        for (std::size_t n = 0; n < clip.joints.size(); ++n)
            out["joint_list"].push_back({{"number", clip.joints[n].number},
                                         {"name", clip.joints[n].name},
                                         {"parent", number_of(clip, clip.joints[n].parent)},
                                         {"place", vector_of(rest_w[n].position)},
                                         {"bone", clip.joints[n].is_bone}});
    return out;
}

}  // namespace swivel::tools
