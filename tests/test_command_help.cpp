// SPDX-License-Identifier: MIT
//
// Help in all its shapes has every option of every command: `help COMMAND`, the man page, the shells' completions; and
// a word that nobody knows is met with the one that was meant.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;

namespace {

using Words = std::vector<std::string>;

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

// The part of a text from one mark to another.
std::string between(const std::string& text, const std::string& from, const std::string& to)
{
    const std::size_t begin = text.find(from);
    INFO(from);
    REQUIRE(begin != std::string::npos);
    return text.substr(begin, text.find(to, begin + from.size()) - begin);
}

std::string roff(std::string text)
{
    for (std::size_t at = 0; (at = text.find('-', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    return text;
}

// Runs a program on a file; its complaints.
std::string complaints(const TempFolder& folder, const Words& words)
{
    const Outcome outcome = run_program(folder.path, words);
    CHECK(outcome.exit_code == 0);
    return outcome.err;
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
    CHECK_THAT(said({"dance"}),
               Contains("there is no command 'dance'; known are demo, solve, view, store, fill, check, replay, rig"));
    CHECK(said({"--verison"}) == "swivel: there is no option --verison; did you mean --version?\n");
    CHECK(said({"solve", "x", "--foo"}) == "swivel: there is no option --foo; see swivel solve --help\n");
    CHECK(said({"solve", "x", "--trgets=y"}) == "swivel: there is no option --trgets; did you mean --targets?\n");
    CHECK(said({"solve", "x", "y"}) == "swivel: 'y' is one word too many; see swivel solve --help\n");
    CHECK(said({"slove", "--limbs", "arms"}) == "swivel: there is no command 'slove'; did you mean solve?\n");
    for (const Words& early :
         std::vector<Words>{{"--characters", "5", "demo"}, {"--characters=5", "demo"}, {"--characters", "5"}})
        CHECK(said(early) == "swivel: --characters is an option of a command; write it after the command\n");
    CHECK(said({"-o", "y", "solve", "x"}) == "swivel: -o is an option of a command; write it after the command\n");
    CHECK(said({"--joints", "demo"}) == "swivel: there is no option --joints; see swivel --help\n");  // demo has none
    CHECK(said({"solve", "x", "--limbs", "arms", "--limbs", "legs"}) ==
          "swivel: --limbs is given twice; give it once\n");
    CHECK(said({"solve", "x", "-o", "a.csv", "--out", "b.csv"}) == "swivel: --out is given twice; give it once\n");
    CHECK(said({"solve", "x", "--limbs", "arm"}) == "swivel: --limbs: there is no 'arm'; did you mean arms?\n");
    for (const auto& [command, options] : options_of_commands())
        for (const std::string& option : options) {
            if (option.size() < 5) continue;  // too short to be told from others
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

TEST_CASE("help: the man page and the completions have every option of every command")
{
    const std::string man = output({"help", "--man"}), bash = output({"completion", "bash"}),
                      zsh = output({"completion", "zsh"}), fish = output({"completion", "fish"});
    const auto commands = options_of_commands();
    CHECK(commands.at("solve").size() > 15);
    for (const auto& [command, options] : commands) {
        const std::string section = between(man, ".SS \"swivel " + command + " ", "\n.S");
        const std::string bash_case = between(bash, "        " + command + ")\n", "esac ;;");
        const std::string zsh_case = between(zsh, "        " + command + ") ", " ;;\n");
        for (const std::string& option : options) {
            INFO(command << " " << option);
            CHECK_THAT(section, Contains("\\fB" + roff(option) + "\\fR"));
            CHECK((bash_case.find("'" + option + " ") != std::string::npos ||
                   bash_case.find(" " + option + " ") != std::string::npos ||
                   bash_case.find(" " + option + "'") != std::string::npos));
            CHECK_THAT(zsh_case, Contains(")" + option + "[") || Contains("*" + option + "["));
            const std::string named =
                (option.starts_with("--") ? " -l " + option.substr(2) : " -s " + option.substr(1));
            std::istringstream lines(fish);
            bool is_there = false;
            for (std::string line; std::getline(lines, line);)
                is_there = is_there || (line.starts_with("complete -c swivel -n '__swivel_command " + command + "'") &&
                                        line.find(named + " ") != std::string::npos);
            CHECK(is_there);
        }
        CHECK_THAT(fish, Contains(" -a " + command + " "));
        CHECK_THAT(zsh, Contains("'" + command + ":"));
    }
}

TEST_CASE("help: man and the shells accept what is made for them")
{
    const TempFolder folder;
    spill(folder / "swivel.1", output({"help", "--man"}));
    for (const char* shell : {"bash", "zsh", "fish"}) spill(folder / shell, output({"completion", shell}));
    for (const std::string program : {"groff", "bash", "zsh", "fish"}) {
        INFO(program << " is one of test_packages in tools/packages");
        REQUIRE(fs::exists("/usr/bin/" + program));
    }
    CHECK(complaints(folder, {"/usr/bin/groff", "-man", "-ww", "-Tutf8", "swivel.1"}).empty());
    for (const std::string shell : {"bash", "zsh", "fish"})
        CHECK(complaints(folder, {"/usr/bin/" + shell, "-n", shell}).empty());
}

TEST_CASE("help: bash completes commands, options and their values")
{
    const TempFolder folder;
    spill(folder / "swivel.bash", output({"completion", "bash"}));
    // Each line: what is typed, the last word in the making, and what it may become.
    const std::vector<std::pair<std::string, std::string>> lines = {{"swivel so", "solve"},
                                                                    {"swivel --ver", "--version"},
                                                                    {"swivel solve --cr", "--crowd"},
                                                                    {"swivel solve x.bvh --st", "--strict"},
                                                                    {"swivel solve --limbs a", "arms all"},
                                                                    {"swivel solve --limbs = l", "legs"},
                                                                    {"swivel solve --limbs =", "arms legs all"},
                                                                    {"swivel solve --fps 3", ""},
                                                                    {"swivel solve --form", "--format"},
                                                                    {"swivel completion z", "zsh"},
                                                                    {"swivel help ver", "verify"}};
    std::string script = "source ./swivel.bash\n", expected;
    for (const auto& [typed, completed] : lines) {
        script +=
            "COMP_WORDS=(" + typed + "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _swivel; echo \"${COMPREPLY[*]}\"\n";
        expected += completed + "\n";
    }
    spill(folder / "try.bash", script);
    const Outcome outcome = run_program(folder.path, {"/usr/bin/bash", "try.bash"});
    CHECK(outcome.err.empty());
    CHECK(outcome.out == expected);
}
