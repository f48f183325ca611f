// SPDX-License-Identifier: MIT
#include "tools/swivel/inspection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tools/crowd/clip_loop.h"
#include "tools/feet/judge_feet.h"
#include "tools/rig/clip_doubts.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/plain_units.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using Json = nlohmann::ordered_json;
using Places = BodyFrames::Places;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kT_deg = 25;                      // the legs of CMU's T-pose are 20 degrees from down
constexpr double kShortLeg = 0.2, kLongLeg = 2.5;  // metres: a child's, a giant's
constexpr double kSkate = 0.3;                     // leg lengths a second
constexpr double kStraight = 0.995;                // of both bones: a knee bent by 11 degrees
constexpr double kFast_deg = 720, kSnapRatio = 4;
constexpr double kTremble_deg = 1;
constexpr double kSlowest = 1.0 / 49;  // seconds a frame: in longer ones motion hides a tremble

// How far a joint trembles, in degrees. Motion is smooth, so fourth differences of rotations are noise: the root of 70
// times its deviation about each axis. The median of their lengths is 1.54 times that.
double tremble_deg(const Clip& clip, int joint)
{
    const auto rotation = [&](std::size_t frame) {
        return clip.rotation[frame * clip.joints.size() + static_cast<std::size_t>(joint)];
    };
    std::vector<Vector3d> turns;
    for (std::size_t frame = 1; frame < clip.frame_count; ++frame) {
        const Eigen::AngleAxisd turn(rotation(frame - 1).conjugate() * rotation(frame));
        turns.push_back(turn.angle() * turn.axis());
    }
    std::vector<double> changes;
    for (std::size_t n = 3; n < turns.size(); ++n)
        changes.push_back((turns[n] - 3 * turns[n - 1] + 3 * turns[n - 2] - turns[n - 3]).norm());
    return changes.empty() ? 0 : quantile(std::move(changes), 0.5) / (1.54 * std::sqrt(70.0)) * kDegrees;
}

Json json_of(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json json_of(const SomeFrames& frames)
{
    return {{"frames", frames.count}, {"of", frames.all}, {"from_frame", frames.first}};
}

class Inspector {
public:
    Inspector(const MotionFile& file, const LimbSearch& search)
        : file_(file), clip_(file.clip()), search_(search), body_(clip_, search.body)
    {
    }
    Json run(const std::string& name, const FigureJoints& figure)
    {
        judge_file();
        judge_binding();
        BodyDoubts of_body = clip_doubts(body_, search_.body);
        std::ranges::move(of_body.doubts, std::back_inserter(doubts_));
        if (body_.has(0) && body_.has(2)) judge_t_pose();
        std::vector<Limb> legs;
        for (const LimbFinding& each : search_.findings)
            if (each.limb && each.name.kind == formats::LimbKind::leg) legs.push_back(*each.limb);
        const int carrier = carrier_of(clip_, figure);
        if (!of_body.is_up_wrong && clip_.frame_time > 0 && clip_.frame_count >= 3) {
            if (!legs.empty() && carrier >= 0) judge_motion(leg_motion(clip_, legs, carrier, body_.up_w()));
            if (clip_.frame_time < kSlowest) judge_tremble();
        }
        const bool is_garbage = std::ranges::any_of(doubts_, &ClipDoubt::is_garbage);
        Json all = {{"file", name},
                    {"verdict", is_garbage ? "garbage" : (doubts_.empty() ? "good" : "look")},
                    {"doubts", Json::array()}};
        for (const ClipDoubt& each : doubts_)
            all["doubts"].push_back({{"verdict", each.is_garbage ? "garbage" : "look"}, {"text", text_of(each)}});
        all.update(out_);
        return all;
    }

private:
    template <class... Words>
    void doubt(fmt::format_string<Words...> text, Words&&... words)
    {
        doubts_.push_back({fmt::format(text, std::forward<Words>(words)...)});
    }
    std::string text(double length) const { return length_text(length, unit_); }
    Json json(double length) const { return {{"cm", length * unit_.centimetres}}; }
    Json json(double length, std::size_t frame) const { return {{"cm", length * unit_.centimetres}, {"frame", frame}}; }
    std::string text_of(const ClipDoubt& doubt) const
    {
        if (doubt.leg_lengths == 0) return doubt.text;
        return fmt::format("{}: {}", doubt.text, text(doubt.leg_lengths * body_.leg_length()));
    }

    void judge_file()
    {
        Json& clip = out_["clip"];
        clip = {{"format", file_.describe()}, {"joints", clip_.joints.size()}, {"frames", clip_.frame_count}};
        if (clip_.frame_time > 0) {
            clip["seconds"] = static_cast<double>(clip_.frame_count - 1) * clip_.frame_time;
            clip["frames_a_second"] = 1 / clip_.frame_time;
        } else if (clip_.frame_count > 1) {
            clip["keys"] = "at uneven times; --fps tells root, feet, knees, noise and loop, too";
        }
        if (const auto notes = file_.notes(); !notes.empty()) out_["notes"] = notes;
        const double leg = body_.limbs()[2] || body_.limbs()[3] ? body_.leg_length() : 0;
        unit_ = length_unit(file_.is_in_metres(), leg);
        if (!unit_.is_guess && leg > 0 && (leg < kShortLeg || leg > kLongLeg))
            doubt("its legs are {:.3g} m long by the format's unit; check the scale of the export", leg);
        out_["unit"] = {{"cm", unit_.centimetres > 0 ? Json(unit_.centimetres) : Json()},
                        {"is_guess", unit_.is_guess},
                        {"text", unit_text(unit_)}};
        out_["axes"] = {{"up", axis_name(body_.up_w())}, {"faces_at_rest", json_of(search_.facing.forwards_w)}};
        if (body_.has(2)) out_["axes"]["in_frame_0"] = json_of(body_.front_w(body_.frames_w().front(), 2));
    }
    void judge_binding()
    {
        const auto& findings = search_.findings;
        const bool binds = std::ranges::any_of(findings, [](const auto& each) { return each.limb.has_value(); });
        if (!binds) doubts_.push_back({"no arm or leg binds: " + problem_text(findings.front()), true});
        out_["binds"] = Json::array();
        for (const LimbFinding& each : findings)
            if (each.limb)
                out_["binds"].push_back(limb_word(each.name));
            else if (binds)
                doubt("the {} does not bind: {}", plain_name(each.name), problem_text(each));
    }
    void judge_t_pose()
    {
        const SomeFrames frames = body_.where([&](const Places& places_w) { return is_t_pose(places_w); });
        if (frames.count > 0 && frames.count < frames.all) doubt("a T-pose {}", frames.words());
        out_["t_pose"] = json_of(frames);
    }
    bool is_t_pose(const Places& places_w) const
    {
        const Vector3d left_w = body_.to_left_w(places_w, 0);
        const Vector3d ways_w[] = {left_w, -left_w, -body_.up_w(), -body_.up_w()};
        for (std::size_t limb = 0; limb < 4; ++limb)
            for (std::size_t bone = 0; bone < 2; ++bone)
                if (degrees_between(body_.bone_w(places_w, limb, bone), ways_w[limb]) > kT_deg) return false;
        return true;
    }

    void judge_motion(const LegMotion& motion)
    {
        const auto slide = slide_of(motion, bars_);
        judge_root(motion, slide);
        // Feet that slide all the time are never in contact.
        const Contacts contacts =
            slide ? Contacts(motion.legs.size(), std::vector<bool>(clip_.frame_count)) : find_contacts(motion, bars_);
        const bool stands =
            std::ranges::any_of(contacts, [](const auto& leg) { return std::ranges::count(leg, true) > 0; });
        for (std::size_t n = 0; n < contacts.size(); ++n) {
            if (stands) judge_foot(motion, n, contacts, {motion.up_w, floor_level(motion, contacts), nullptr});
            judge_knee(motion.legs[n]);
        }
        if (motion.up_w != Vector3d::UnitY() || clip_.frame_count > kMaxSearched) return;  // as find_loop() takes it
        if (const FoundLoop found = find_loop(clip_, motion.carrier); std::isfinite(found.gap))
            out_["loop"] = {{"first_frame", found.loop.first},
                            {"last_frame", found.loop.last},
                            {"gap", {{"deg", found.gap * kDegrees}}},
                            {"closes", found.gap <= kWideGap}};
    }
    void judge_root(const LegMotion& motion, const std::optional<Slide>& slide)
    {
        Json& root = out_["root"];
        root = {{"joint", joint_at(clip_, motion.carrier).name},
                {"goes", json(motion.level(motion.carrier_w.back() - motion.carrier_w.front()).norm())}};
        if (body_.has(2)) {
            const Vector3d first_w = body_.front_w(body_.frames_w().front(), 2),
                           last_w = body_.front_w(body_.frames_w().back(), 2);
            const double turn = std::atan2(first_w.cross(last_w).dot(motion.up_w), first_w.dot(last_w));
            root["turns_left"] = {{"deg", turn * kDegrees}};
        }
        root["walks_in_place"] = slide && !slide->with_body;
        if (!slide) return;
        root["feet_slide_a_second"] = json(slide->velocity_w.norm());
        if (slide->with_body)
            doubt("it glides, and does not walk: its feet slide with the body, by {} a second in the mean",
                  text(slide->velocity_w.norm()));
    }
    void judge_foot(const LegMotion& motion, std::size_t n, const Contacts& contacts, const Floor& floor)
    {
        const LegPath& path = motion.legs[n];
        const LegMotion alone{motion.up_w, motion.frame_time, motion.carrier, motion.carrier_w, {path}};
        const Skating skating = skating_of(alone, {contacts[n]}, floor);
        const double leg = path.length;
        SomeFrames in_contact{clip_.frame_count};
        Peak depth;
        for (std::size_t frame = 0; frame < clip_.frame_count; ++frame) {
            if (contacts[n][frame]) in_contact.add(frame);
            depth.raise(frame, -floor.over(path.toe_w[frame]));
        }
        const std::string side(side_name(path.name.side));
        out_[side + "_foot"] = {{"joint", joint_at(clip_, path.toe).name},
                                {"contacts", contacts_of(contacts[n]).size()},
                                {"in_contact", json_of(in_contact)},
                                {"skate_a_step", json(skating.step * leg)},
                                {"drift_at_most", json(skating.drift * leg, skating.drift_frame)},
                                {"off_floor_at_most", json(skating.off_ground * leg, skating.off_ground_frame)},
                                {"under_floor_at_most", json(depth.value, depth.frame)}};
        if (skating.mean_speed > kSkate)
            doubt("the {} foot skates by {} a second in the mean of its contacts, and drifts by {} to frame {}", side,
                  text(skating.mean_speed * leg), text(skating.drift * leg), skating.drift_frame);
        if (depth.value > bars_.height * leg)
            doubt("the {} foot is under the floor by up to {}, in frame {}", side, text(depth.value), depth.frame);
    }
    void judge_knee(const LegPath& path)
    {
        double min = 180, max = 0;
        SomeFrames straight{clip_.frame_count};
        Peak turn, snap;
        for (std::size_t frame = 0; frame < clip_.frame_count; ++frame) {
            min = std::min(min, bend_deg(path, frame));
            max = std::max(max, bend_deg(path, frame));
            if ((path.ankle_w[frame] - path.hip_w[frame]).norm() > kStraight * path.length) straight.add(frame);
            if (frame > 0) turn.raise(frame, knee_turn_deg(path, frame));
            if (frame < 2 || frame + 1 == clip_.frame_count) continue;
            const double now = knee_turn_deg(path, frame),
                         beside = std::max(knee_turn_deg(path, frame - 1), knee_turn_deg(path, frame + 1));
            if (now > kFast_deg * clip_.frame_time && now > kSnapRatio * beside) snap.raise(frame, now);
        }
        const std::string side(side_name(path.name.side));
        out_[side + "_knee"] = {{"bent_from", {{"deg", min}}},
                                {"to", {{"deg", max}}},
                                {"straight", json_of(straight)},
                                {"turns_a_frame_at_most", {{"deg", turn.value}, {"frame", turn.frame}}}};
        if (snap.value > 0)
            doubt("the {} knee snaps by {:.0f} degrees, from frame {} to {}", side, snap.value, snap.frame - 1,
                  snap.frame);
    }
    void judge_tremble()
    {
        int most = -1;
        double max = 0;
        for (const BodyPart& part : search_.body)
            for (const int joint : part.joints) {
                const double deg = part.name.ends_with("Toes") ? -1 : tremble_deg(clip_, joint);
                if (deg < max) continue;
                most = joint;
                max = deg;
            }
        if (most < 0) return;
        out_["noise"] = {{"joint", joint_at(clip_, most).name}, {"trembles", {{"deg", max}}}};
        if (max > kTremble_deg) doubt("'{}' trembles by {:.1f} degrees", printable_name(joint_at(clip_, most)), max);
    }

    const MotionFile& file_;
    const Clip& clip_;
    const LimbSearch& search_;
    const BodyFrames body_;
    const ContactBars bars_;
    LengthUnit unit_;
    std::vector<ClipDoubt> doubts_;
    Json out_;
};

}  // namespace

Json inspection_of(const std::string& name, const MotionFile& file, const FigureJoints& figure,
                   const LimbSearch& search)
{
    return Inspector(file, search).run(name, figure);
}

}  // namespace swivel::tools
