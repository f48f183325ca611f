// SPDX-License-Identifier: MIT
//
// `swivel inspect`: judges each clip alone, as a viewer would, and prints its verdict (good, look or garbage), its
// doubts, and what it holds, in centimetres and degrees. People read the same words as machines.
//
// Doubts are those of clip_doubts(), and
// - garbage: no limb binds; if some do, a limb that does not is a doubt;
// - legs below 0.2 m or above 2.5 m in a file of metres;
// - frames are a T-pose: arms aside and legs down, within 25 degrees;
// - nothing moves;
// - it glides, see slide_of();
// - a foot skates above 0.3 leg lengths a second in the mean of its contacts; recorded feet are at 0.2;
// - a toe is more than 0.085 leg lengths under the floor, as far as a toe in contact may be above it;
// - a knee turns by four times as much as in the frames beside that, and above 720 degrees a second;
// - a joint trembles by a degree, at 49 frames a second or more. Recorded joints are at 0.7; toes are left out;
// - its keys lie at uneven times, so that most of the above is not judged.
// Root, feet, knees and loop are told of three even frames or more, noise of five.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "tools/cli/command_error.h"
#include "tools/cli/streams.h"
#include "tools/crowd/clip_loop.h"
#include "tools/feet/judge_feet.h"
#include "tools/formats/printable.h"
#include "tools/rig/clip_doubts.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/plain_units.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/motion_file.h"
#include "tools/swivel/report.h"
#include "tools/swivel/run_files.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using Places = BodyFrames::Places;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kT_deg = 25;                      // the legs of CMU's T-pose are 20 degrees from down
constexpr double kShortLeg = 0.2, kLongLeg = 2.5;  // metres: a child's, a giant's
constexpr double kSkate = 0.3;                     // leg lengths a second
constexpr double kStraight = 0.995;                // of both bones: a knee bent by 11 degrees
constexpr double kFast_deg = 720, kSnapRatio = 4;
constexpr double kTremble_deg = 1;
constexpr double kSlowest = 1.0 / 49;    // seconds a frame: in longer ones motion hides a tremble
constexpr std::size_t kFewestNoisy = 5;  // frames: fourth differences take five
constexpr double kStill = 0.001;         // radians that a joint turns, body sizes that it goes: less is no motion

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

Json json_of(const SomeFrames& frames)
{
    Json json = {{"frames", frames.count}, {"of", frames.all}};
    if (frames.count > 0) json["from_frame"] = frames.first;
    return json;
}

class Inspector {
public:
    Inspector(const MotionFile& file, const LimbSearch& search)
        : file_(file), clip_(file.clip()), search_(search), body_(clip_, search.body)
    {
    }
    // carrier: of carrier_of()
    Json run(const std::string& name, int carrier)
    {
        judge_file();
        judge_binding();
        std::ranges::move(clip_doubts(body_), std::back_inserter(doubts_.all));
        if (body_.has(0) && body_.has(2)) judge_t_pose();
        if (is_still()) doubts_.look("it has no motion");
        std::vector<Limb> legs;
        for (const LimbFinding& each : search_.findings)
            if (each.limb && each.name.kind == formats::LimbKind::leg) legs.push_back(*each.limb);
        if (std::ranges::none_of(doubts_.all, &ClipDoubt::is_up_wrong) && clip_.frame_time > 0 &&
            clip_.frame_count >= 3) {
            if (!legs.empty() && carrier >= 0) judge_motion(leg_motion(clip_, legs, carrier, body_.up_w()));
            if (clip_.frame_time < kSlowest && clip_.frame_count >= kFewestNoisy) judge_tremble();
        }
        const bool is_garbage = std::ranges::any_of(doubts_.all, &ClipDoubt::is_garbage);
        Json all = {
            {"file", name}, {"verdict", verdict_word(!doubts_.all.empty(), is_garbage)}, {"doubts", Json::array()}};
        for (const ClipDoubt& each : doubts_.all)
            all["doubts"].push_back({{"verdict", verdict_word(true, each.is_garbage)}, {"text", text_of(each)}});
        all.update(out_);
        return all;
    }

private:
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
            doubts_.look("feet, knees and noise are not judged: keys at uneven times; give --fps");
        }
        if (const auto notes = file_.notes(); !notes.empty()) out_["notes"] = notes;
        const double leg = body_.limbs()[2] || body_.limbs()[3] ? body_.leg_length() : 0;
        unit_ = length_unit(file_.is_in_metres(), leg);
        if (!unit_.is_guess && leg > 0 && (leg < kShortLeg || leg > kLongLeg))
            doubts_.look("its legs are {:.3g} m long by the format's unit; check the scale of the export", leg);
        out_["unit"] = {{"cm", unit_.centimetres > 0 ? Json(unit_.centimetres) : Json()},
                        {"is_guess", unit_.is_guess},
                        {"text", unit_text(unit_)}};
        out_["axes"] = {{"up", axis_name(body_.up_w())}, {"faces_at_rest", search_.facing.forwards_w}};
        if (body_.has(2)) out_["axes"]["in_frame_0"] = body_.front_w(body_.frames_w().front(), 2);
    }
    void judge_binding()
    {
        const auto& findings = search_.findings;
        const bool binds = std::ranges::any_of(findings, [](const auto& each) { return each.limb.has_value(); });
        if (!binds) doubts_.garbage("no arm or leg binds: {}", problem_text(findings.front()));
        out_["binds"] = Json::array();
        for (const LimbFinding& each : findings)
            if (each.limb)
                out_["binds"].push_back(limb_word(each.name));
            else if (binds)
                doubts_.look("the {} does not bind: {}", plain_name(each.name), problem_text(each));
    }
    void judge_t_pose()
    {
        const SomeFrames frames = body_.where([&](const Places& places_w) { return is_t_pose(places_w); });
        if (frames.count > 0 && frames.count < frames.all) doubts_.look("a T-pose {}", frames.words());
        if (frames.count == frames.all && frames.all > 1) doubts_.look("all {} frames are a T-pose", frames.all);
        out_["t_pose"] = json_of(frames);
    }
    // Whether no joint ever turns, and the body goes nowhere.
    bool is_still() const
    {
        if (clip_.frame_count < 2) return true;
        const std::size_t count = clip_.joints.size();
        for (std::size_t n = count; n < clip_.rotation.size(); ++n)
            if (clip_.rotation[n].angularDistance(clip_.rotation[n % count]) > kStill) return false;
        const Places& first_w = body_.frames_w().front();
        double size = 0;
        for (const Vector3d& place_w : first_w) size = std::max(size, (place_w - first_w.front()).norm());
        return std::ranges::all_of(body_.frames_w(), [&](const Places& places_w) {
            for (std::size_t n = 0; n < places_w.size(); ++n)
                if ((places_w[n] - first_w[n]).norm() > kStill * size) return false;
            return true;
        });
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
        const bool is_y_up = motion.up_w == Vector3d::UnitY();
        if (!is_y_up || clip_.frame_count > kMaxSearched)  // find_loop() takes neither
            out_["loop"]["text"] =
                is_y_up ? fmt::format("not searched: over {} frames", kMaxSearched) : "not searched: y is not up";
        else if (const FoundLoop found = find_loop(clip_, motion.carrier); std::isfinite(found.gap))
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
            doubts_.look("it glides, and does not walk: its feet slide with the body, by about {} a second",
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
                                {"skate_a_step", json(skating.step * leg)}};
        Json& foot = out_[side + "_foot"];
        if (in_contact.count > 0) {
            foot["drift_at_most"] = json(skating.drift * leg, skating.drift_frame);
            foot["off_floor_at_most"] = json(skating.off_ground * leg, skating.off_ground_frame);
        }
        foot["under_floor_at_most"] = json(depth.value, depth.frame);
        if (skating.mean_speed > kSkate)
            doubts_.look("the {} foot skates by {} a second in the mean of its contacts, and drifts by {} to frame {}",
                         side, text(skating.mean_speed * leg), text(skating.drift * leg), skating.drift_frame);
        if (depth.value > bars_.height * leg)
            doubts_.look("the {} foot is under the floor by up to {}, in frame {}", side, text(depth.value),
                         depth.frame);
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
            doubts_.look("the {} knee snaps by {:.0f} degrees, from frame {} to {}", side, snap.value, snap.frame - 1,
                         snap.frame);
    }
    void judge_tremble()
    {
        int most = -1;
        double max = 0;
        for (const BodyPart& part : search_.body) {
            if (part.name.ends_with("Toes")) continue;
            for (const int joint : part.joints) {
                const double deg = tremble_deg(clip_, joint);
                if (deg < max) continue;
                most = joint;
                max = deg;
            }
        }
        if (most < 0) return;
        out_["noise"] = {{"joint", joint_at(clip_, most).name}, {"trembles", {{"deg", max}}}};
        if (max > kTremble_deg)
            doubts_.look("'{}' trembles by {:.1f} degrees", printable_name(joint_at(clip_, most)), max);
    }

    const MotionFile& file_;
    const Clip& clip_;
    const LimbSearch& search_;
    const BodyFrames body_;
    const ContactBars bars_;
    LengthUnit unit_;
    DoubtList doubts_;
    Json out_;
};

std::string spaced(std::string key)
{
    std::ranges::replace(key, '_', ' ');
    return key;
}

// A value of such JSON for people: "2.2 cm in frame 27", "94 of 152 frames (62 %), from frame 0".
std::string line_of(const Json& value)
{
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
    if (value.is_string()) return formats::printable(value.get<std::string>(), std::string::npos);
    if (!value.is_structured()) return value.dump();
    if (value.is_array() && value.size() == 3 && value[0].is_number())
        return vector_text({value[0].get<double>(), value[1].get<double>(), value[2].get<double>()});
    if (value.contains("text")) return value["text"].get<std::string>();
    std::string words;
    if (value.contains("cm"))
        words = length_text(value["cm"].get<double>(), {1});
    else if (value.contains("deg"))
        words = fmt::format("{:.3g} degrees", value["deg"].get<double>());
    else if (value.contains("of"))
        words = share_text(value["frames"].get<std::size_t>(), value["of"].get<std::size_t>(), "frames") +
                (value["frames"] > 0 ? ", from frame " + value["from_frame"].dump() : "");
    else
        for (const auto& [key, each] : value.items())
            words += (words.empty() ? "" : ", ") + (value.is_array() ? "" : spaced(key) + " ") + line_of(each);
    if (value.contains("frame")) words += " in frame " + value["frame"].dump();
    return words;
}

// One file: the verdict, its reasons, and a line for each thing that the clip holds.
void print_inspection(const Json& json)
{
    say(stdout, "{:<10} {}{}\n", json["verdict"].get<std::string>(), shown_file(json["file"].get<std::string>()),
        json["doubts"].empty() ? ": nothing stands out" : "");
    for (const Json& doubt : json["doubts"])
        say(stdout, "{:<10} {}\n", doubt["verdict"].get<std::string>(), line_of(doubt));
    for (const auto& [key, value] : json.items())
        if (value.is_structured() && key != "doubts") say(stdout, "{:<10} {}\n", spaced(key), line_of(value));
}

// The first doubt, or the first that makes the clip garbage; empty for a good one.
std::string first_doubt(const Json& json)
{
    for (const Json& each : json["doubts"])
        if (each["verdict"] == json["verdict"]) return line_of(each);
    return {};
}

// Many files: a line each.
void print_line(const Json& json)
{
    double skate_cm = 0;
    for (const char* const foot : {"left_foot", "right_foot"})
        if (json.contains(foot)) skate_cm = std::max(skate_cm, json[foot]["skate_a_step"]["cm"].get<double>());
    std::string doubts = json["doubts"].empty() ? "" : ": " + first_doubt(json);
    if (json["doubts"].size() > 1) doubts += fmt::format("; {} more", json["doubts"].size() - 1);
    const bool closes = json.contains("loop") && json["loop"].value("closes", false);
    say(stdout, "{:<8}{:>7}{:>9}{:>11}  {:<13}{}{}\n", json["verdict"].get<std::string>(),
        line_of(json["clip"].value("seconds", Json("-"))), json.contains("root") ? line_of(json["root"]["goes"]) : "-",
        skate_cm > 0 ? length_text(skate_cm, {1}) : "-",
        closes ? fmt::format("{} to {}", json["loop"]["first_frame"].dump(), json["loop"]["last_frame"].dump()) : "-",
        shown_file(json["file"].get<std::string>()), doubts);
}

Json inspected(const InspectOptions& options, const std::string& name)
{
    const LimbChoice choice = choice_of(options.clip);
    MotionFile file(name, options.clip.motion);
    const FigureJoints figure = file.find_limbs(choice);
    return Inspector(file, bind_limbs(file.clip(), figure, choice)).run(name, carrier_of(file.clip(), figure));
}

}  // namespace

void run_inspect(const InspectOptions& options)
{
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const bool is_one = options.files.size() == 1, prints = !options.json && !options.quiet;
    if (prints && !is_one)
        say(stdout, "{:<8}{:>7}{:>9}{:>11}  {:<13}{}\n", "", "seconds", "goes", "skate/step", "loop", "file");
    Json clips = Json::array();
    const auto print_clips = [&] {
        if (options.json) print_json({{"clips", clips}});
    };
    std::size_t bad = 0;
    for (const std::string& name : options.files) {
        bool is_bad = false;
        const auto run_one = [&] {
            try {
                clips.push_back(inspected(options, name));
            } catch (const std::exception& error) {
                clips.push_back(failed_json(name, error.what()));
                if (is_one) print_clips();
                throw;
            }
            const Json& json = clips.back();
            if (prints) is_one ? print_inspection(json) : print_line(json);
            is_bad = json["verdict"] == "garbage";
        };
        if (is_one)
            run_one();
        else if (run_to_end(run_one) != 0)
            is_bad = true;
        if (is_bad) ++bad;
    }
    print_clips();
    if (bad == 0) return;
    throw CommandError(1, is_one ? fmt::format("{}: garbage: {}", options.files.front(), first_doubt(clips.front()))
                                 : fmt::format("{} of {} clips failed or are garbage", bad, options.files.size()));
}

}  // namespace swivel::tools
