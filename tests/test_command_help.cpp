// SPDX-License-Identifier: MIT
//
// Help says every command and option in few words, and a word that nobody knows is met with the one that was meant.
#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;

namespace {

Outcome run(const Words& words)
{
    const TempFolder folder;
    return run_command(folder.path, words);
}

std::string output(const Words& words)
{
    const Outcome outcome = run(words);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
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
    const Outcome wrong = run({"help", "slove"});
    CHECK(wrong.exit_code == 2);
    CHECK(wrong.err == "swivel: COMMAND: there is no 'slove'; did you mean solve?\n");
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

TEST_CASE("help: a slip in a command or an option is told")
{
    const auto said = [](const Words& words) {
        const Outcome outcome = run(words);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.out.empty());
        return outcome.err;
    };
    CHECK(said({"slove", "x"}) == "swivel: there is no command 'slove'; did you mean solve?\n");
    CHECK(said({"veiw", "x"}) == "swivel: there is no command 'veiw'; did you mean view?\n");
    CHECK(said({"stpes"}) == "swivel: there is no command 'stpes'; did you mean steps?\n");
    CHECK_THAT(
        said({"dance"}),
        Contains(
            "there is no command 'dance'; known are demo, solve, view, store, fill, check, replay, retarget, rig"));
    CHECK(said({"--verison"}) == "swivel: there is no option --verison; did you mean --version?\n");
    CHECK(said({"solve", "x", "--foo"}) == "swivel: there is no option --foo; see swivel solve --help\n");
    CHECK(said({"solve", "x", "--trgets=y"}) == "swivel: there is no option --trgets; did you mean --targets?\n");
    CHECK(said({"solve", "x", "y"}) == "swivel: 'y' is one word too many; see swivel solve --help\n");
    CHECK(said({"slove", "--limbs", "arms"}) == "swivel: there is no command 'slove'; did you mean solve?\n");
    CHECK(said({"--joints", "demo"}) == "swivel: there is no option --joints; see swivel --help\n");
    CHECK(said({"solve", "x", "--limbs", "arms", "--limbs", "legs"}) ==
          "swivel: --limbs is given twice; give it once\n");
    CHECK(said({"solve", "x", "-o", "a.csv", "--out", "b.csv"}) == "swivel: --out is given twice; give it once\n");
    CHECK(said({"solve", "x", "--limbs", "arm"}) == "swivel: --limbs: there is no 'arm'; did you mean arms?\n");
    for (const auto& [command, options] : options_of_commands())
        for (const std::string& option : options) {
            if (option.size() < 6) continue;  // with a letter less, too short to be told from others
            for (std::size_t n = 2; n < option.size(); ++n) {
                std::string slip = option;
                slip.erase(n, 1);
                INFO(command << " " << slip);
                CHECK_THAT(said({command, slip}), Contains("there is no option " + slip + "; did you mean " + option));
            }
        }
}

TEST_CASE("help: empty names say what is empty and what to do")
{
    for (const auto& [option, cause] : {std::pair("--clip", "the name is empty; name an animation, or leave"),
                                        {"--targets", "the file name is empty; give one, or leave the option out"},
                                        {"--crowd", "the file name is empty"},
                                        {"--out", "the file name is empty"}}) {
        const Outcome outcome = run({"solve", "x.bvh", option, ""});
        CHECK(outcome.exit_code == 2);
        CHECK_THAT(outcome.err, Contains(std::string("swivel: ") + option + ": " + cause));
    }
}
