// SPDX-License-Identifier: MIT
#include "tools/swivel/motion_keys.h"

namespace swivel::tools {

void MotionKeys::add(const ClipCrowd& crowd)
{
    for (std::size_t limb = 0; limb < limbs_.size(); ++limb) {
        const formats::PoseRow row = crowd.pose(limb, 0);
        for (std::size_t n = 0; n < 3; ++n) {
            const auto& q = n == 0 ? row.shoulder : n == 1 ? row.elbow : row.wrist;
            keys_[3 * limb + n].emplace_back(q[3], q[0], q[1], q[2]);
        }
        if (plans_[limb].has(SWIVEL_WITH_CLAVICLE)) clavicles_[limb].push_back(crowd.clavicle(limb, 0));
    }
    for (std::size_t n = 0; n < looking_.size(); ++n) looking_[n].push_back(crowd.looking(n, 0));
}

std::vector<formats::JointKeys> MotionKeys::overrides(const formats::Clip& clip) const
{
    std::vector<formats::JointKeys> overrides;
    for (std::size_t limb = 0; limb < limbs_.size(); ++limb) {
        for (std::size_t n = 0; n < (plans_[limb].has(SWIVEL_WITH_HAND) ? 3 : 2); ++n)
            overrides.push_back({limbs_[limb].joints[n], keys_[3 * limb + n]});
        const int above = joint_at(clip, limbs_[limb].upper()).parent;
        if (plans_[limb].has(SWIVEL_WITH_CLAVICLE)) overrides.push_back({above, clavicles_[limb]});
    }
    for (std::size_t n = 0; n < looking_.size(); ++n) overrides.push_back({look_joints_[n], looking_[n]});
    return overrides;
}

void MotionKeys::require_can_write(const MotionFile& file) const
{
    for (const formats::JointKeys& each : overrides(file.clip())) file.require_can_key(each.joint);
}

void MotionKeys::write(const std::filesystem::path& out, const MotionFile& file) const
{
    file.write(out, overrides(file.clip()));
}

}  // namespace swivel::tools
