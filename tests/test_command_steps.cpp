// SPDX-License-Identifier: MIT
//
// The promise: `swivel steps` prints the lecture's entities of an arm.
#include <catch2/catch.hpp>

#include <Eigen/Core>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Json = nlohmann::json;

namespace {

Outcome run_words(Words words)
{
    const TempFolder folder;
    words.insert(words.begin(), "steps");
    return run_command(folder.path, words);
}

// What --json has of a run that must succeed.
Json told_steps(Words words)
{
    words.push_back("--json");
    const Outcome outcome = run_words(words);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return Json::parse(outcome.out);
}

}  // namespace

TEST_CASE("steps: without an option it is the lecture's example, whose answer is known")
{
    const Json json = told_steps({});
    std::map<std::string, std::map<std::string, double>> entities;  // blade by blade
    for (const Json& entity : json.at("entities"))
        entity.at("coefficients").get_to(entities[entity.at("name").get<std::string>()]);
    const auto vector = [&](const char* name) {
        std::map<std::string, double>& blade = entities.at(name);
        return Vector3d(blade["e1"], blade["e2"], blade["e3"]);
    };
    const auto rotor = [&](const char* name) {
        std::map<std::string, double>& blade = entities.at(name);
        return Vector4d(blade["1"], blade["i"], blade["j"], blade["k"]);
    };
    // By a program for dense multivectors, to six digits.
    CHECK((vector("p_e") - Vector3d(0.980883, 0.980883, -0.189039)).norm() < 2e-6);
    CHECK(std::abs(entities.at("c4")["1"] + 0.005494) < 1e-6);
    CHECK((rotor("q_e") - Vector4d(0.705162, -0.709047, 0, 0)).norm() < 2e-6);
    CHECK((rotor("q12") - Vector4d(0, 0.532689, 0.532689, 0.657637)).norm() < 2e-6);
    CHECK((rotor("q_s") - Vector4d(0.251667, 0.288289, 0.695991, 0.607577)).norm() < 2e-6);
    CHECK(json.at("closing_error").get<double>() < 1e-15);

    const Outcome text = run_words({});
    REQUIRE(text.exit_code == 0);
    CHECK_THAT(text.out,
               StartsWith("arm      target (1.1, 1.1, 1.1), pole (1.1, 1.1, 0), upper arm 1.4, forearm 1.3\n"));
    for (const char* step : {"\nstep 1 ", "\nstep 2 ", "\nstep 3 ", "\nstep 4 ", "\nstep 5 "})
        CHECK_THAT(text.out, Contains(step));
    CHECK_THAT(text.out, Contains("\np_e        = 0.98088") && Contains("\nq_e        = 0.70516") &&
                             Contains("the sphere about the target"));
    const Json given = told_steps({"--target", "1,0,0.5", "--pole", "0,1,0", "--lengths", "0.75,0.625"});
    CHECK(given.at("target") == Json({1.0, 0.0, 0.5}));
    CHECK(given.at("pole") == Json({0.0, 1.0, 0.0}));
    CHECK(given.at("lengths") == Json({0.75, 0.625}));
}

TEST_CASE("steps: what gives no steps is refused, with what to do")
{
    for (const auto& [words, exit_code, said] : std::vector<std::tuple<Words, int, std::string>>{
             {{"--target", "9,0,0"},
              1,
              "swivel: steps: S1 and S2 meet in no circle: the target is too far by 6.3; change --target"},
             {{"--pole", "2.2,2.2,2.2"}, 1, "; change --target, --pole or --lengths"},
             {{"--lengths", "1e30,1"}, 2, "--lengths 1e30,1: each number must be a bone's length, 1e-15"},
             {{"--lengths", "1,1e-30"}, 2, "--lengths 1,1e-30: each number"},
             {{"--target", "1,-1e30,0"}, 2, "--target 1,-1e30,0: each number must be a coordinate"},
             {{"--pole", "1e16,0,0"}, 2, "--pole 1e16,0,0: each number"},
             {{"--target", "1,0"}, 2, "'1,0' is not 3 numbers"},
             {{"--lengths", "0,1"}, 2, "above 0"}}) {
        const Outcome outcome = run_words(words);
        INFO(outcome.err);
        CHECK(outcome.exit_code == exit_code);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, StartsWith("swivel: ") && Contains(said) && !Contains("swivel_steps"));
    }
}
