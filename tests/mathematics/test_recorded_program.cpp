// SPDX-License-Identifier: MIT
//
// The proof (docs/mathematics.md) is about a list of operations, proof/Program.v. This is the test that solve_plain
// does these operations and no others: it runs the library's own templates on numbers that write down what is done to
// them.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>

#include "core/solve_arm.h"

// A number type that computes nothing and writes down every operation of a formula. Formulas branch on data by select
// alone, so one list of operations covers all branches. An operation of the same numbers as an earlier one has its
// name.
namespace swivel::inline SWIVEL_ISA {

struct Recorded {
    std::string name;
    Recorded() = default;
    explicit Recorded(std::string text) : name(std::move(text)) {}
    // A constant, rounded to float, as mantissa and power of two.
    Recorded(double value);
};
struct RecordedMask {
    std::string text;
};
struct Recording {
    std::map<std::string, std::string> names;   // of operations that are written down
    std::map<std::string, Recorded> negatives;  // of names
};
inline Recording recording;
template <>
struct NumberTraits<Recorded> {
    using Mask = RecordedMask;
    using Word = std::uint32_t;
};

inline Recorded written_down(const std::string& operation)
{
    std::string& name = recording.names[operation];
    if (name.empty()) {
        name = "#" + std::to_string(recording.names.size());
    }
    return Recorded(name);
}
inline Recorded::Recorded(double value)
{
    int exponent = 0;
    long mantissa = std::lround(std::frexp(float(value), &exponent) * 0x1p24);
    exponent -= 24;
    for (; mantissa != 0 && mantissa % 2 == 0; mantissa /= 2) ++exponent;
    name = mantissa == 0 ? "Const 0 0" : "Const " + std::to_string(mantissa) + " " + std::to_string(exponent);
    if (value != 1) name = written_down(name).name;
}
// A factor of one, which unit blades bring, is no operation.
inline bool is_one(const Recorded& x) { return x.name == "Const 1 0"; }
inline Recorded operand(const Recorded& x) { return is_one(x) ? written_down(x.name) : x; }
inline Recorded two_operands(const char* operation, const Recorded& a, const Recorded& b)
{
    return written_down(operation + (" " + operand(a).name) + " " + operand(b).name);
}
inline Recorded operator*(const Recorded& a, const Recorded& b)
{
    return is_one(a) ? b : is_one(b) ? a : two_operands("Mul", a, b);
}
inline Recorded operator+(const Recorded& a, const Recorded& b) { return two_operands("Add", a, b); }
inline Recorded operator-(const Recorded& a, const Recorded& b) { return two_operands("Sub", a, b); }
inline Recorded operator/(const Recorded& a, const Recorded& b) { return two_operands("Div", a, b); }
// Turning a sign over twice is no operation.
inline Recorded operator-(const Recorded& a)
{
    Recorded& negative = recording.negatives[operand(a).name];
    if (negative.name.empty()) {
        negative = written_down("Neg " + operand(a).name);
        recording.negatives[negative.name] = a;
    }
    return negative;
}
inline Recorded sqrt(const Recorded& a) { return written_down("Sqrt " + operand(a).name); }
inline Recorded abs(const Recorded& a) { return written_down("Abs " + operand(a).name); }
inline Recorded copysign(const Recorded& x, const Recorded& sign) { return two_operands("Copysign", x, sign); }
inline Recorded flip_sign(const Recorded& x, const Recorded& sign) { return two_operands("Flip", x, sign); }
inline Recorded per_power_of_two(const Recorded& x) { return written_down("PerPower " + operand(x).name); }

inline RecordedMask compared(const char* relation, const Recorded& a, const Recorded& b)
{
    return {std::string("(") + relation + " " + operand(a).name + " " + operand(b).name + ")"};
}
inline RecordedMask operator<(const Recorded& a, const Recorded& b) { return compared("Lt", a, b); }
inline RecordedMask operator<=(const Recorded& a, const Recorded& b) { return compared("Le", a, b); }
inline RecordedMask operator>(const Recorded& a, const Recorded& b) { return compared("Lt", b, a); }
inline RecordedMask operator>=(const Recorded& a, const Recorded& b) { return compared("Le", b, a); }
inline RecordedMask operator==(const Recorded& a, const Recorded& b) { return compared("Eq", a, b); }
inline RecordedMask operator&(const RecordedMask& a, const RecordedMask& b)
{
    return {"(And " + a.text + " " + b.text + ")"};
}

inline Recorded select(const RecordedMask& mask, const Recorded& a, const Recorded& b)
{
    return written_down("Select " + mask.text + " " + operand(a).name + " " + operand(b).name);
}
// Flags are not recorded.
inline std::uint32_t select(const RecordedMask&, std::uint32_t, std::uint32_t) { return 0; }

}  // namespace swivel::inline SWIVEL_ISA

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
