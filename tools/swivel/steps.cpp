// SPDX-License-Identifier: MIT
//
// `swivel lab steps`: the lecture's five steps for one arm, as multivectors.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "swivel/lecture.h"
#include "tools/cli/command_error.h"
#include "tools/cli/streams.h"
#include "tools/formats/text.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

constexpr const char* kTitles[] = {"the elbow point", "the elbow quaternion", "the middle line", "rotate to the elbow",
                                   "rotate to the wrist"};

// Blades as people list them: vectors before the units i, j and k; einf and e0 last.
constexpr auto kBladeOrder = [] {
    std::array<std::uint32_t, 32> order{};
    std::size_t n = 0;
    for (const std::uint32_t null_part : {0u, 8u, 16u, 24u})
        for (const std::uint32_t euclidean : {0u, 1u, 2u, 4u, 6u, 5u, 3u, 7u}) order[n++] = null_part | euclidean;
    return order;
}();

// The steps of an arm in its arm frame.
struct Steps {
    std::array<double, 3> target, pole;
    double upper, fore;
    std::array<swivel_entity, SWIVEL_ENTITY_COUNT> entities{};
    double closing_error = 0;
};

// Throws CommandError for a value that swivel_steps() does not take, and names its option. The library says what is
// undefined; this says what to do.
Steps steps_of(const StepsOptions& options)
{
    constexpr double kShortest = 1e-15, kLongest = 1e15;  // as lecture.h has them
    const auto require_all = [](const char* option, const std::string& text, auto fits, const char* range) {
        if (!std::ranges::all_of(formats::numbers_of(text), fits))
            throw CommandError(2, fmt::format("{} {}: each number must be {}", option, text, range));
    };
    const auto is_length = [](double x) { return x >= kShortest && x <= kLongest; };
    const auto is_place = [](double x) { return std::fabs(x) <= kLongest; };
    require_all("--lengths", options.lengths, is_length, "a bone's length, 1e-15 to 1e15");
    require_all("--target", options.target, is_place, "a coordinate, -1e15 to 1e15");
    require_all("--pole", options.pole, is_place, "a coordinate, -1e15 to 1e15");
    const auto vector = [](const std::string& text) {
        const std::vector<double> v = formats::numbers_of(text);
        return std::array{v[0], v[1], v[2]};
    };
    const std::vector<double> lengths = formats::numbers_of(options.lengths);
    Steps steps{vector(options.target), vector(options.pole), lengths[0], lengths[1]};
    const char* const why = swivel_steps(steps.target.data(), steps.pole.data(), steps.upper, steps.fore,
                                         steps.entities.data(), &steps.closing_error);
    if (why) throw CommandError(1, fmt::format("steps: {}; change --target, --pole or --lengths", why));
    return steps;
}

// Leaves out coefficients that are rounding beside the largest. 1e-14 of that is 45 roundings of a double, more than
// sums of a few products have where they should be 0.
std::string text_of(const swivel_entity& entity)
{
    double max = 0;
    for (const double c : entity.coefficients) max = std::max(max, std::fabs(c));
    std::string text;
    for (const std::uint32_t blade : kBladeOrder) {
        const double c = entity.coefficients[blade];
        if (std::fabs(c) <= 1e-14 * max) continue;
        const std::string unit = blade == 0 ? "" : fmt::format(" {}", swivel_blade_name(blade));
        text += text.empty() ? fmt::format("{:.9g}{}", c, unit)
                             : fmt::format(" {} {:.9g}{}", c < 0 ? '-' : '+', std::fabs(c), unit);
    }
    return text.empty() ? "0" : text;
}

Json json_of(const Steps& steps)
{
    Json out{{"target", steps.target}, {"pole", steps.pole}, {"lengths", {steps.upper, steps.fore}}};
    for (const swivel_entity& entity : steps.entities) {
        Json coefficients = Json::object();
        for (const std::uint32_t blade : kBladeOrder)
            if (entity.coefficients[blade] != 0) coefficients[swivel_blade_name(blade)] = entity.coefficients[blade];
        out["entities"].push_back({{"name", entity.name},
                                   {"step", entity.step},
                                   {"meaning", entity.meaning},
                                   {"coefficients", coefficients}});
    }
    out["closing_error"] = steps.closing_error;
    return out;
}

void print_steps(const Steps& steps)
{
    const auto shown = [](const std::array<double, 3>& v) {
        return fmt::format("({:.9g}, {:.9g}, {:.9g})", v[0], v[1], v[2]);
    };
    say(stdout, "arm      target {}, pole {}, upper arm {:.9g}, forearm {:.9g}\n", shown(steps.target),
        shown(steps.pole), steps.upper, steps.fore);
    std::uint32_t step = 0;
    for (const swivel_entity& entity : steps.entities) {
        if (entity.step != step) {
            step = entity.step;
            say(stdout, "\nstep {}   {}\n", step, kTitles[step - 1]);
        }
        say(stdout, "{:<10} = {}\n{:<12} {}\n", entity.name, text_of(entity), "", entity.meaning);
    }
    say(stdout, "\nclosing  q_s and q_e put the wrist {:.1e} arm lengths from the target\n", steps.closing_error);
}

}  // namespace

void run_steps(const StepsOptions& options)
{
    const Steps steps = steps_of(options);
    options.json ? print_json(json_of(steps)) : print_steps(steps);
}

}  // namespace swivel::tools
