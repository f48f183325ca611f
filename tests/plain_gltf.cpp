// SPDX-License-Identifier: MIT
#include "tests/plain_gltf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>

#include "tests/plain_motion.h"
#include "tests/run_command.h"

namespace swivel::test {

std::string plain_base64(std::string_view text)
{
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text) {
        const std::size_t digit =
            std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
        if (digit == std::string_view::npos) break;
        bits = bits << 6 | static_cast<unsigned>(digit);
        if ((count += 6) < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xff);
    }
    return bytes;
}

PlainGltf plain_gltf_of(const fs::path& path)
{
    const std::string file = slurp(path);
    PlainGltf gltf;
    std::string chunk;
    if (file.starts_with("glTF")) {
        std::uint32_t length = 0;
        std::memcpy(&length, file.data() + 12, 4);
        gltf.json = nlohmann::json::parse(file.substr(20, length));
        if (file.size() > 28 + length) chunk = file.substr(28 + length);
    } else {
        gltf.json = nlohmann::json::parse(file);
    }
    for (const auto& buffer : gltf.json.value("buffers", nlohmann::json::array())) {
        std::string uri = buffer.value("uri", "");
        for (std::size_t at; (at = uri.find("%20")) != std::string::npos;) uri.replace(at, 3, " ");
        if (uri.empty())
            gltf.buffers.push_back(chunk);
        else if (uri.starts_with("data:"))
            gltf.buffers.push_back(plain_base64(std::string_view(uri).substr(uri.find(',') + 1)));
        else
            gltf.buffers.push_back(slurp(path.parent_path() / uri));
        REQUIRE(gltf.buffers.back().size() >= buffer.at("byteLength").get<std::size_t>());
    }
    gltf.parents.assign(gltf.json.value("nodes", nlohmann::json::array()).size(), -1);
    for (std::size_t n = 0; n < gltf.parents.size(); ++n)
        for (const int child : gltf.nodes()[n].value("children", std::vector<int>()))
            gltf.parents.at(static_cast<std::size_t>(child)) = static_cast<int>(n);
    return gltf;
}

const std::vector<double>& plain_numbers(const PlainGltf& gltf, int index)
{
    if (const auto known = gltf.accessors.find(index); known != gltf.accessors.end()) return known->second;
    const auto& accessor = gltf.json.at("accessors").at(static_cast<std::size_t>(index));
    REQUIRE(accessor.at("componentType") == 5126);
    REQUIRE_FALSE(accessor.contains("sparse"));
    const auto& view = gltf.json.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    const std::string& bytes = gltf.buffers.at(view.at("buffer").get<std::size_t>());
    const std::string type = accessor.at("type");
    const std::size_t width = type == "SCALAR" ? 1
                              : type == "VEC3" ? 3
                              : type == "MAT4" ? 16
                                               : 4,
                      count = accessor.at("count");
    const std::size_t begin = view.value("byteOffset", 0u) + accessor.value("byteOffset", 0u);
    const std::size_t stride = view.value("byteStride", 4 * width);
    REQUIRE(begin + (count - 1) * stride + 4 * width <= bytes.size());
    std::vector<double> numbers;
    numbers.reserve(count * width);
    for (std::size_t n = 0; n < count * width; ++n) {
        float number = 0;
        std::memcpy(&number, bytes.data() + begin + n / width * stride + n % width * 4, 4);
        numbers.push_back(number);
    }
    return gltf.accessors[index] = numbers;
}

std::vector<double> key_times(const PlainGltf& gltf, int node, const std::string& path, int animation)
{
    const auto& of = gltf.json.at("animations").at(static_cast<std::size_t>(animation));
    for (const auto& channel : of.at("channels"))
        if (channel.at("target").value("node", -1) == node && channel.at("target").at("path") == path)
            return plain_numbers(gltf, of.at("samplers").at(channel.at("sampler").get<std::size_t>()).at("input"));
    FAIL("node " << node << " has no keys of " << path);
    return {};
}

Eigen::VectorXd plain_value(const PlainGltf& gltf, int animation, int node, const std::string& path, double time,
                            const Eigen::VectorXd& rest)
{
    if (animation < 0) return rest;
    const auto& from = gltf.json.at("animations").at(static_cast<std::size_t>(animation));
    for (const auto& channel : from.at("channels")) {
        const auto& target = channel.at("target");
        if (target.value("node", -1) != node || target.at("path") != path) continue;
        const auto& sampler = from.at("samplers").at(channel.at("sampler").get<std::size_t>());
        const auto &times = plain_numbers(gltf, sampler.at("input")),
                   &values = plain_numbers(gltf, sampler.at("output"));
        const std::string kind = sampler.value("interpolation", "LINEAR");
        const Eigen::Index width = rest.size(), step = kind == "CUBICSPLINE" ? 3 : 1;
        const auto at = [&](std::size_t key, Eigen::Index part) -> Eigen::VectorXd {
            return Eigen::Map<const Eigen::VectorXd>(
                values.data() + width * (step * static_cast<Eigen::Index>(key) + part), width);
        };
        std::size_t k = 0;
        while (k + 1 < times.size() && times[k + 1] <= time) ++k;
        const Eigen::VectorXd a = at(k, step / 3);
        if (k + 1 == times.size() || time <= times[k] || kind == "STEP") return a;
        const double seconds = times[k + 1] - times[k], t = (time - times[k]) / seconds;
        Eigen::VectorXd b = at(k + 1, step / 3);
        if (kind == "CUBICSPLINE")
            return (2 * t * t * t - 3 * t * t + 1) * a + seconds * (t * t * t - 2 * t * t + t) * at(k, 2) +
                   (-2 * t * t * t + 3 * t * t) * b + seconds * (t * t * t - t * t) * at(k + 1, 0);
        if (path != "rotation") return (1 - t) * a + t * b;
        if (a.dot(b) < 0) b = -b;
        const double angle = std::acos(std::min(a.normalized().dot(b.normalized()), 1.0));
        if (angle < 1e-7) return (1 - t) * a + t * b;
        return (std::sin((1 - t) * angle) * a.normalized() + std::sin(t * angle) * b.normalized()) / std::sin(angle);
    }
    return rest;
}

Eigen::Affine3d plain_local(const PlainGltf& gltf, int animation, int node, double time)
{
    const auto& at = gltf.nodes().at(static_cast<std::size_t>(node));
    if (at.contains("matrix")) {
        const std::vector<double> numbers = at.at("matrix");
        return Eigen::Affine3d(Eigen::Map<const Eigen::Matrix4d>(numbers.data()).matrix());
    }
    const auto value = [&](const char* path, std::vector<double> rest) {
        rest = at.value(path, rest);
        return plain_value(gltf, animation, node, path, time,
                           Eigen::Map<const Eigen::VectorXd>(rest.data(), static_cast<Eigen::Index>(rest.size())));
    };
    const Eigen::Vector3d translation = value("translation", {0, 0, 0}), scale = value("scale", {1, 1, 1});
    const Eigen::Vector4d rotation = value("rotation", {0, 0, 0, 1});
    return Eigen::Translation3d(translation) * Eigen::Quaterniond(rotation).normalized() * Eigen::Scaling(scale);
}

Eigen::Affine3d plain_world(const PlainGltf& gltf, int animation, int node, double time)
{
    Eigen::Affine3d world = plain_local(gltf, animation, node, time);
    for (int up = gltf.parent_of(node); up >= 0; up = gltf.parent_of(up))
        world = plain_local(gltf, animation, up, time) * world;
    return world;
}

void Closure::keep(const LimbJointsAt& before, const LimbJointsAt& after)
{
    const auto max = [](double& worst, double error) { worst = error <= worst ? worst : error; };  // NaN stays
    const Eigen::Vector3d upper = before.place[1] - before.place[0], lower = before.place[2] - before.place[1];
    const double length = upper.norm() + lower.norm(), sine = upper.normalized().cross(lower.normalized()).norm(),
                 allowed = 2e-6 + 4e-7 * length * length / (upper.norm() * lower.norm() * sine);
    const auto off = [&](std::size_t joint) { return (after.place[joint] - before.place[joint]).norm() / length; };
    if (sine > 0.02)
        max(lower_bent, off(1) / allowed);
    else if (upper.dot(lower) < 0)  // folded
        max(lower_bent, off(1) / (1e-5 + 4e-7 / sine));
    else
        max(lower_straight, off(1));
    max(end, off(2));
    max(orientation, (after.end_axes - before.end_axes).norm());
    max(others, off(0));
    for (std::size_t n = 0; n < 3; ++n) max(turn, turn_between(before.turn[n], after.turn[n]) / allowed);
}

Closure closure(const PlainGltf& from, const PlainGltf& to, int animation, const std::vector<LimbNodes>& limbs)
{
    const int written = std::max(animation, 0);
    const auto limb_pose = [](const PlainGltf& gltf, int of, const LimbNodes& limb, double time) {
        LimbJointsAt pose;
        for (std::size_t n = 0; n < 3; ++n) {
            pose.place[n] = plain_world(gltf, of, limb[n], time).translation();
            pose.turn[n] = plain_axes(plain_local(gltf, of, limb[n], time));
        }
        pose.end_axes = plain_axes(plain_world(gltf, of, limb[2], time));
        return pose;
    };
    std::vector<bool> solved(to.nodes().size());
    for (const LimbNodes& limb : limbs)
        for (const int node : limb) solved.at(static_cast<std::size_t>(node)) = true;
    Closure worst;
    for (const double time : key_times(to, limbs.at(0)[0], "rotation", written)) {
        ++worst.frames;
        for (const LimbNodes& limb : limbs)
            worst.keep(limb_pose(from, animation, limb, time), limb_pose(to, written, limb, time));
        for (int node = 0; node < static_cast<int>(solved.size()); ++node)
            if (!solved[static_cast<std::size_t>(node)])
                worst.others = std::max(worst.others, (plain_local(to, written, node, time).matrix() -
                                                       plain_local(from, animation, node, time).matrix())
                                                          .norm());
    }
    return worst;
}

void require_closed(const Closure& worst)
{
    INFO("end " << worst.end << ", bent " << worst.lower_bent << ", straight " << worst.lower_straight
                << ", orientation " << worst.orientation << ", others " << worst.others << ", turn " << worst.turn);
    CHECK(worst.end <= 1e-5);
    CHECK(worst.lower_bent <= 1);
    CHECK(worst.lower_straight <= 2e-3);
    CHECK(worst.orientation <= 2e-5);
    CHECK(worst.others <= 1e-12);
    CHECK(worst.turn <= 1);
    CHECK(worst.frames > 0);
}

nlohmann::json ask_check(std::vector<std::string> arguments)
{
    const fs::path folder = fs::path(SWIVEL_SOURCE_DIR) / "tests" / "gltf";
    INFO("node and its packages are set up by tools/test: npm ci in tests/gltf");
    REQUIRE(fs::is_directory(folder / "node_modules"));
    arguments.insert(arguments.begin(), {"/usr/bin/env", "node", (folder / "check.mjs").string()});
    const Outcome outcome = run_program(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return nlohmann::json::parse(outcome.out);
}

std::multiset<std::string> gltf_errors(const fs::path& path)
{
    std::multiset<std::string> errors;
    const nlohmann::json reports = ask_check({"validate", path.string()});
    for (const auto& message : reports.at(0).at("messages"))
        if (message.at("severity") == 0) errors.insert(message.dump());
    return errors;
}

std::vector<std::multiset<std::string>> new_gltf_messages(const std::vector<std::pair<fs::path, fs::path>>& files)
{
    std::vector<std::string> arguments = {"validate"};
    for (const auto& [source, written] : files) arguments.insert(arguments.end(), {source.string(), written.string()});
    const nlohmann::json reports = ask_check(arguments);
    const auto said_of = [&](std::size_t n) {
        std::multiset<std::string> said;
        for (const auto& message : reports.at(n).at("messages"))
            if (message.at("severity") <= 1)
                said.insert(message.at("code").get<std::string>() + ' ' + message.value("pointer", ""));
        return said;
    };
    std::vector<std::multiset<std::string>> news;
    for (std::size_t n = 0; n < files.size(); ++n) {
        const std::multiset<std::string> before = said_of(2 * n), after = said_of(2 * n + 1);
        std::multiset<std::string>& added = news.emplace_back();
        std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                            std::inserter(added, added.end()));
    }
    return news;
}

std::multiset<std::string> new_gltf_messages(const fs::path& source, const fs::path& written)
{
    return new_gltf_messages({{source, written}})[0];
}

std::vector<std::vector<Eigen::Matrix4d>> three_poses(const fs::path& path, int animation,
                                                      const std::vector<double>& times)
{
    std::vector<std::string> arguments = {"pose", path.string(), std::to_string(animation)};
    for (const double time : times) arguments.push_back(nlohmann::json(time).dump());
    std::vector<std::vector<Eigen::Matrix4d>> poses;
    for (const auto& frame : ask_check(arguments)) {
        poses.emplace_back();
        for (const auto& matrix : frame) {
            const std::vector<double> numbers = matrix;
            poses.back().push_back(Eigen::Map<const Eigen::Matrix4d>(numbers.data()));
        }
    }
    return poses;
}

}  // namespace swivel::test
