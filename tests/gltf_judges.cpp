// SPDX-License-Identifier: MIT
#include "tests/gltf_judges.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <iterator>

namespace swivel::test {

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
