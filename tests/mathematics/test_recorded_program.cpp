// SPDX-License-Identifier: MIT
//
// The proof (docs/proof.md) is about a list of operations, proof/Program.v. This is the test that solve_plain
// does these operations and no others: it runs the library's own templates on numbers that write down what is done to
// them.
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>

#include "core/solve_arm.h"
#include "tests/recorded_number.h"

using namespace swivel;

namespace {

std::string list_of_the_proof()
{
    std::ifstream file(SWIVEL_SOURCE_DIR "/proof/Program.v");
    return {std::istreambuf_iterator<char>(file), {}};
}

// A Coq term with the recorded names in place of the list's; brackets about a negative number go.
std::string in_recorded_names(const std::string& term, const std::map<std::string, std::string>& names)
{
    static const std::regex name("\"(\\w+)\""), negative("\\((-\\d+)\\)"), blanks("\\s+");
    std::string text;
    auto rest = term.cbegin();
    for (std::sregex_iterator found(term.begin(), term.end(), name), end; found != end; ++found) {
        text.append(rest, (*found)[0].first);
        const auto known = names.find((*found)[1]);
        text += known != names.end() ? known->second : "nothing";
        rest = (*found)[0].second;
    }
    text.append(rest, term.cend());
    return std::regex_replace(std::regex_replace(text, negative, "$1"), blanks, " ");
}

Recorded input(const char* name) { return Recorded(std::string(name)); }

}  // namespace

TEST_CASE("solve_plain does the operations that the proof is about")
{
    const PlainArm<Recorded> arm =
        solve_plain(ArmGoal<Recorded>{vector(input("w1"), input("w2"), input("w3")),
                                      vector(input("p1"), input("p2"), input("p3")), input("upper"), input("fore")});

    const std::string list = list_of_the_proof();
    std::map<std::string, std::string> names;  // of the list, as recorded
    for (const char* name : {"w1", "w2", "w3", "p1", "p2", "p3", "upper", "fore"}) names[name] = name;
    static const std::regex line("\\n  \\(\"(\\w+)\", (.*)\\)[;\\n]");
    for (std::sregex_iterator found(list.begin(), list.end(), line), end; found != end; ++found) {
        INFO("the library does not do the operation " << (*found)[1] << " := " << (*found)[2]);
        const auto recorded = recording.names.find(in_recorded_names((*found)[2], names));
        REQUIRE(recorded != recording.names.end());
        names[(*found)[1]] = recorded->second;
    }
    REQUIRE(names.size() > 100);

    const Rotor<Recorded>& shoulder = arm.pose.shoulder;
    CHECK(shoulder.at<kScalar>().name == names["qw"]);
    CHECK(shoulder.at<kI>().name == names["qx"]);
    CHECK(shoulder.at<kJ>().name == names["qy"]);
    CHECK(shoulder.at<kK>().name == names["qz"]);
    CHECK(arm.pose.cos_half.name == names["cos_half"]);
    CHECK(arm.pose.sin_half.name == names["sin_half"]);

    std::smatch holds;
    REQUIRE(std::regex_search(list, holds, std::regex("Definition holds :=\\s+([^.]*)\\.")));
    CHECK(arm.holds.text == "(" + in_recorded_names(holds[1], names) + ")");
}
