// SPDX-License-Identifier: MIT
#include "tests/plain_motion.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <cstdlib>
#include <numbers>
#include <sstream>

namespace swivel::test {

namespace {

std::vector<std::string> words_of(const std::string& text)
{
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

void read_plain_joints(PlainMotion& motion)
{
    std::istringstream in(motion.header);
    std::vector<int> open;  // joints inside each other; -1 for an end site
    int next = -1;
    std::size_t channel_count = 0;
    for (std::string word; in >> word && word != "MOTION";) {
        if (word == "ROOT" || word == "JOINT") {
            in >> word;
            next = static_cast<int>(motion.joints.size());
            motion.joints.push_back({word, open.empty() ? -1 : open.back()});
        } else if (word == "End") {
            next = -1;
        } else if (word == "{") {
            open.push_back(next);
        } else if (word == "}") {
            open.pop_back();
        } else if (word == "OFFSET") {
            Eigen::Vector3d offset;
            in >> offset.x() >> offset.y() >> offset.z();
            if (open.back() >= 0) motion.joints[static_cast<std::size_t>(open.back())].offset = offset;
        } else if (word == "CHANNELS") {
            PlainJoint& joint = motion.joints[static_cast<std::size_t>(open.back())];
            std::size_t count = 0;
            in >> count;
            for (joint.channels.resize(count); std::string & channel : joint.channels) in >> channel;
            joint.first_channel = channel_count;
            channel_count += count;
        }
    }
}

Eigen::Matrix3d axis_matrix(char axis, double angle_deg)
{
    const double angle = angle_deg * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    Eigen::Matrix3d m;
    if (axis == 'X')
        m << 1, 0, 0, 0, c, -s, 0, s, c;
    else if (axis == 'Y')
        m << c, 0, s, 0, 1, 0, -s, 0, c;
    else
        m << c, -s, 0, s, c, 0, 0, 0, 1;
    return m;
}

}  // namespace

PlainMotion plain_motion(const std::string& text)
{
    PlainMotion motion;
    std::size_t at = text.find('\n', text.find("Frame Time")) + 1;
    motion.header = text.substr(0, at);
    read_plain_joints(motion);
    for (std::size_t end; at < text.size(); at = end) {
        end = std::min(text.find('\n', at), text.size() - 1) + 1;
        motion.lines.push_back(text.substr(at, end - at));
        std::vector<double>& values = motion.values.emplace_back();
        for (const std::string& word : words_of(motion.lines.back())) {
            values.push_back(std::strtod(word.c_str(), nullptr));
        }
    }
    return motion;
}

int joint_named(const PlainMotion& motion, std::string_view name)
{
    const auto found =
        std::find_if(motion.joints.begin(), motion.joints.end(), [&](const PlainJoint& j) { return j.name == name; });
    REQUIRE(found != motion.joints.end());
    return static_cast<int>(found - motion.joints.begin());
}

std::vector<PlainPose> pose_of(const PlainMotion& motion, std::size_t frame)
{
    std::vector<PlainPose> pose;
    for (const PlainJoint& joint : motion.joints) {
        Eigen::Vector3d translation = joint.offset;
        Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
        for (std::size_t c = 0; c < joint.channels.size(); ++c) {
            const std::string& channel = joint.channels[c];
            const double value = motion.values.at(frame).at(joint.first_channel + c);
            if (channel.ends_with("rotation"))
                rotation = rotation * axis_matrix(channel[0], value);
            else
                translation[channel[0] - 'X'] = value;
        }
        const PlainPose from = joint.parent < 0 ? PlainPose{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()}
                                                : pose[static_cast<std::size_t>(joint.parent)];
        pose.push_back({from.position + from.rotation * translation, from.rotation * rotation});
    }
    return pose;
}

std::vector<PlainArm> limbs_of(const PlainMotion& motion, const std::array<std::string, 3>& parts)
{
    std::vector<PlainArm> limbs;
    for (const std::string side : {"Left", "Right"}) {
        const int elbow = joint_named(motion, side + parts[1]), wrist = joint_named(motion, side + parts[2]);
        limbs.push_back({side == "Left" ? "left" : "right", joint_named(motion, side + parts[0]), elbow, wrist,
                         motion.joint(elbow).offset.norm(), motion.joint(wrist).offset.norm()});
    }
    return limbs;
}

PlainArmPose arm_pose(const PlainMotion& motion, const PlainArm& arm, std::size_t frame)
{
    const std::vector<PlainPose> pose = pose_of(motion, frame);
    const auto at = [&](int joint) -> const PlainPose& { return pose[static_cast<std::size_t>(joint)]; };
    return {at(arm.shoulder).position, at(arm.elbow).position, at(arm.wrist).position,
            at(motion.joint(arm.shoulder).parent).rotation, at(arm.wrist).rotation};
}

std::string rest_of(const std::string& line, const std::vector<std::size_t>& channels)
{
    std::string rest;
    std::size_t word = 0;
    for (std::size_t at = 0; at < line.size();) {
        const bool is_blank = std::isspace(static_cast<unsigned char>(line[at])) != 0;
        std::size_t end = at;
        while (end < line.size() && (std::isspace(static_cast<unsigned char>(line[end])) != 0) == is_blank) ++end;
        const bool is_solved = !is_blank && std::find(channels.begin(), channels.end(), word) != channels.end();
        rest += is_solved ? "*" : line.substr(at, end - at);
        word += !is_blank;
        at = end;
    }
    return rest;
}

std::string cut(const PlainMotion& motion, std::size_t first, std::size_t step, std::size_t repeats)
{
    std::string frames;
    std::size_t count = 0;
    for (std::size_t n = 0; n < repeats; ++n)
        for (std::size_t frame = first; frame < motion.lines.size(); frame += step, ++count)
            frames += motion.lines[frame];
    const std::size_t at = motion.header.find("Frames:") + 7, end = motion.header.find_first_of("\r\n", at);
    return std::string(motion.header).replace(at, end - at, " " + std::to_string(count)) + frames;
}

}  // namespace swivel::test
