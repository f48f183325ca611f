// SPDX-License-Identifier: MIT
//
// `swivel rig`: what a file's skeleton is to the solver, limb by limb, and why.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/cli/command_error.h"
#include "tools/rig/limbs.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/motion_file.h"
#include "tools/swivel/report.h"
#include "tools/swivel/rig_report.h"

namespace swivel::tools {

void run_rig(const RigOptions& options)
{
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const std::string& file = options.clip.file;
    const LimbChoice choice = choice_of(options.clip);
    MotionFile motion(file, options.clip.motion);
    const FigureJoints joints = choose_joints(motion.clip(), file, choice);
    motion.sample(joints_of(joints));
    motion.stand(known_limbs(joints));
    const LimbSearch search = bind_limbs(motion.clip(), joints, choice);
    const std::vector<LimbFinding>& findings = search.findings;
    if (options.json)
        print_json(json_of(motion, file, search, options.joints));
    else
        print_rig(motion, file, search, options.joints);
    if (std::any_of(findings.begin(), findings.end(), [](const LimbFinding& each) { return each.limb.has_value(); }))
        return;
    throw CommandError(
        1, fmt::format("{}: nothing binds: {}{}", file, problem_text(findings[0]),
                       findings[0].advice.empty() ? "; name joints with --arm and --leg, --joints lists them" : ""));
}

}  // namespace swivel::tools
