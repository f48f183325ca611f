// SPDX-License-Identifier: MIT
//
// Help says every command and option in few words. What bench says is whole, on every instruction set. What users type
// and see is in tests/transcripts.
#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Json = nlohmann::json;

namespace {

Outcome run(const Words& words)
{
    const TempFolder folder;
    return run_command(folder.path, words);
}

std::string output(const Words& words)
{
    const Outcome outcome = done(run(words));
    REQUIRE(outcome.err.empty());
    return outcome.out;
}

// The first words of the lines below a heading of a help text.
Words listed(const std::string& help, const std::string& heading)
{
    Words words;
    std::istringstream lines(help.substr(help.find("\n" + heading + ":\n") + heading.size() + 3));
    for (std::string line; std::getline(lines, line) && !line.empty();)
        if (line.starts_with("  ") && line[2] != ' ') words.push_back(line.substr(2, line.find(' ', 2) - 2));
    return words;
}

// Every option by its names, as help texts list them: "-o" and "--out".
std::map<std::string, Words> options_of_commands()
{
    std::map<std::string, Words> all;
    for (const std::string& command : listed(output({"--help"}), "Subcommands"))
        for (const std::string& names : listed(output({command, "--help"}), "Options")) {
            std::istringstream in(names);
            for (std::string name; std::getline(in, name, ',');) all[command].push_back(name);
        }
    return all;
}

}  // namespace

TEST_CASE("help: help COMMAND says what COMMAND --help says")
{
    CHECK(output({"help"}) == output({"--help"}));
    const Words commands = listed(output({"--help"}), "Subcommands");
    CHECK(commands.size() > 6);
    for (const std::string& command : commands) CHECK(output({"help", command}) == output({command, "--help"}));
}

TEST_CASE("help: what options take is said in a word, and nothing takes many to say")
{
    Words texts = {output({"--help"})};
    for (const std::string& command : listed(texts[0], "Subcommands")) texts.push_back(output({command, "--help"}));
    for (const std::string& text : texts) {
        INFO(text);
        for (const char* const type : {"TEXT", "UINT", "INT:", "FLOAT", "{"}) CHECK_THAT(text, !Contains(type));
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            int count = 0;
            for (std::string word; words >> word; ++count) {
                if (word.starts_with("-")) count = 0;  // an option's name
                CHECK(count < 25);
                if (word.ends_with('.') || word.ends_with(';')) count = -1;
            }
        }
    }
    CHECK_THAT(texts[2], Contains("--characters NUMBER=1 ") && Contains("--limbs arms|legs|all"));
}

TEST_CASE("help: a letter left out of any option is told")
{
    for (const auto& [command, options] : options_of_commands())
        for (const std::string& option : options) {
            if (option.size() < 6) continue;  // with a letter less, too short to be told from others
            for (std::size_t n = 2; n < option.size(); ++n) {
                std::string slip = option;
                slip.erase(n, 1);
                INFO(command << " " << slip);
                const Outcome outcome = run({command, slip});
                CHECK(outcome.exit_code == 2);
                CHECK(outcome.out.empty());
                CHECK_THAT(outcome.err, Contains("there is no option " + slip + "; did you mean " + option));
            }
        }
}

#ifdef SWIVEL_WITH_BENCH
TEST_CASE("command: bench has rows for swivel on every instruction set, and for rivals")
{
    const TempFolder folder;
    const Json info = Json::parse(output({"info", "--json"}));
    const Outcome measured = spawn_command(folder.path, {"lab", "bench", "--json", "--seconds", "0.1"});
    REQUIRE(measured.exit_code == 0);
    const Json out = Json::parse(measured.out);
    CHECK(out.at("context").at("cpu") == info.at("cpu"));
    std::map<std::string, double> median;
    for (const Json& row : out.at("benchmarks"))
        if (row.at("aggregate_name") == "median") median[row.at("run_name")] = row.at("time/arm");
    for (const auto& [isa, state] : info.at("built").items())
        for (const char* row : {"P/{}/L2", "resident/{}/L2", "frame/{}/in_one"})
            if (state == "runs here") CHECK(median.at(fmt::format(fmt::runtime(row), isa)) > 0);
    for (const char* rival : {"loop_trig/", "single_glm/", "frame_glm/"})
        CHECK(std::ranges::any_of(median, [&](const auto& row) { return row.first.starts_with(rival); }));
    const Outcome text = spawn_command(folder.path, {"lab", "bench", "--seconds", "0.1"});
    CHECK(text.exit_code == 0);
    CHECK_THAT(text.out, StartsWith("cpu ") && Contains(info.at("cpu").get<std::string>()) && Contains(" ns an arm"));
    for (const auto& [row, ns] : median)
        CHECK_THAT(text.out, Contains("\n" + row.substr(0, row.find("/real_time")) + " "));
}
#endif
