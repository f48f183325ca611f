// SPDX-License-Identifier: MIT
#include "tools/formats/bvh.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "tools/formats/error.h"
#include "tools/formats/euler.h"
#include "tools/formats/output_file.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

constexpr int kKept = -1;

// One override on its way into the text.
struct EulerTrack {
    std::span<const Eigen::Quaterniond> rotation;
    EulerAxes axes;
    Eigen::Vector3d angle_deg;  // of the frame written last; before the first frame the file's own
};

struct Plan {
    std::vector<EulerTrack> tracks;
    std::vector<int> slot;  // per channel of a line: 3 * track + angle, or kKept
};

void check_override(const BvhFile& file, const RotationOverride& change)
{
    if (change.joint < 0 || static_cast<std::size_t>(change.joint) >= file.joints.size()) {
        throw std::invalid_argument("write_bvh: no such joint");
    }
    if (change.rotation.size() != file.clip.frame_count) {
        throw std::invalid_argument("write_bvh: an override needs one rotation per frame");
    }
    for (const Eigen::Quaterniond& rotation : change.rotation) {
        const double length = rotation.norm();
        if (!(length > 0) || !std::isfinite(length)) {
            throw std::invalid_argument("write_bvh: a rotation is zero or not finite");
        }
    }
}

[[noreturn]] void refuse(const BvhFile& file, int joint, std::string_view cause)
{
    const auto at = static_cast<std::size_t>(joint);
    const std::string name = printable(file.clip.joints[at].name);
    throw InputError(file.path, file.joints[at].line,
                     fmt::format("joint '{}' cannot take a new rotation: {}", name, cause));
}

// Plans the joint's rotation channels as the angles of one more track.
EulerAxes claim_channels(const BvhFile& file, int joint, Plan& plan)
{
    const BvhJoint& at = file.joints[static_cast<std::size_t>(joint)];
    EulerAxes axes{};
    std::size_t count = 0;
    for (std::size_t c = 0; c < at.channels.size(); ++c) {
        if (is_position(at.channels[c])) continue;
        if (count == 3) refuse(file, joint, "it has more than three rotation channels");
        int& slot = plan.slot[at.first_channel + c];
        if (slot != kKept) throw std::invalid_argument("write_bvh: two overrides for one joint");
        slot = static_cast<int>(3 * plan.tracks.size() + count);
        axes[count++] = axis_of(at.channels[c]);
    }
    if (count < 3) refuse(file, joint, "it has fewer than three rotation channels");
    const bool repeats = axes[0] == axes[1] || axes[1] == axes[2] || axes[0] == axes[2];
    if (repeats) refuse(file, joint, "its rotation channels repeat an axis");
    return axes;
}

Plan make_plan(const BvhFile& file, std::span<const RotationOverride> overrides)
{
    Plan plan;
    plan.slot.assign(file.channel_count, kKept);
    for (const RotationOverride& change : overrides) {
        check_override(file, change);
        const EulerAxes axes = claim_channels(file, change.joint, plan);
        plan.tracks.push_back({change.rotation, axes, Eigen::Vector3d::Zero()});
    }
    return plan;
}

double& angle_of(Plan& plan, int slot) { return plan.tracks[static_cast<std::size_t>(slot / 3)].angle_deg[slot % 3]; }

// The file's own angles in its first frame, which the reader has checked.
void start_from_file(const BvhFile& file, Plan& plan)
{
    std::string_view rest = std::string_view(file.text).substr(file.frame_begin.front());
    for (const int slot : plan.slot) {
        const std::string_view word = take_word(rest);
        if (slot != kKept) angle_of(plan, slot) = parse_number(word).value();
    }
}

void solve_frame(Plan& plan, std::size_t frame)
{
    for (EulerTrack& track : plan.tracks) {
        track.angle_deg = nearest_euler(track.rotation[frame].normalized(), track.axes, track.angle_deg);
    }
}

// Nine decimals of a degree: 9e-12 rad an angle.
void write_angle(OutputFile& out, double angle_deg)
{
    const double shown = std::abs(angle_deg) < 5e-10 ? 0.0 : angle_deg;  // no "-0.000000000"
    fmt::memory_buffer digits;
    fmt::format_to(std::back_inserter(digits), "{:.9f}", shown);
    out.write({digits.data(), digits.size()});
}

// Writes the text from `done` through the frame's last new angle; what lies between new angles is copied.
std::size_t write_frame(OutputFile& out, std::string_view text, std::size_t begin, std::size_t done, Plan& plan)
{
    std::string_view rest = text.substr(begin);
    for (const int slot : plan.slot) {
        const std::string_view word = take_word(rest);
        if (slot == kKept) continue;
        const auto word_begin = static_cast<std::size_t>(word.data() - text.data());
        out.write(text.substr(done, word_begin - done));
        write_angle(out, angle_of(plan, slot));
        done = word_begin + word.size();
    }
    return done;
}

}  // namespace

void write_bvh(const std::filesystem::path& path, const BvhFile& file, std::span<const RotationOverride> overrides)
{
    Plan plan = make_plan(file, overrides);
    OutputFile out(path);
    const std::string_view text = file.text;
    std::size_t done = 0;
    start_from_file(file, plan);
    for (std::size_t frame = 0; frame < file.clip.frame_count && !plan.tracks.empty(); ++frame) {
        solve_frame(plan, frame);
        done = write_frame(out, text, file.frame_begin[frame], done, plan);
    }
    out.write(text.substr(done));
    out.commit();
}

}  // namespace swivel::formats
