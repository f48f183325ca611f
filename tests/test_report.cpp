// SPDX-License-Identifier: MIT
//
// The promise: reports show text as text, whatever names hold; plots put points where their axes say; numbers are those
// of
// --json; limbs link into the page.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"
#include "tools/report/html.h"

using namespace swivel::test;
using namespace swivel::tools;
using Catch::Matchers::Contains;
using Json = nlohmann::json;

namespace {

const std::string kHostile = "</script><img src=x onerror=alert(1)>\"'& \x01\xff";
const std::string kHostileShown =
    "&lt;/script&gt;&lt;img src=x onerror=alert(1)&gt;&quot;&#39;&amp; \xef\xbf\xbd\xef\xbf\xbd";

// XML's own parser must take it, and what it holds must be no markup of someone else's.
void require_well_formed(const TempFolder& folder, const std::string& name)
{
    const Outcome outcome = run_program(
        folder.path, {"/usr/bin/python3", "-c", "import sys, xml.dom.minidom as d; d.parse(sys.argv[1])", name});
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
    const std::string text = slurp(folder / name);
    for (const char* word : {"<img", "<script", "http://", "https://"}) CHECK_THAT(text, !Contains(word));
}

std::vector<std::smatch> matches(const std::string& text, const std::string& pattern)
{
    const std::regex regex(pattern);
    return {std::sregex_iterator(text.begin(), text.end(), regex), std::sregex_iterator()};
}

// What an axis's ticks say of a place in pixels.
double value_at(const std::map<double, double>& ticks, double place, bool log)
{
    REQUIRE(ticks.size() >= 2);
    const auto [first_place, first] = *ticks.begin();
    const auto [last_place, last] = *ticks.rbegin();
    const double share = (place - first_place) / (last_place - first_place);
    return log ? first * std::pow(last / first, share) : first + share * (last - first);
}

void check_plot(bool log_x, bool log_y, const std::vector<std::pair<double, double>>& points)
{
    const std::string svg = svg_of({"plot", "x", "y", log_x, log_y, {{"series", points}}});
    std::map<double, double> x_ticks, y_ticks;
    for (const std::smatch& m : matches(svg, "class=\"x\" x=\"([^\"]+)\"[^>]*>([^<]+)<"))
        x_ticks[std::stod(m[1])] = std::stod(m[2]);
    for (const std::smatch& m :
         matches(svg, "<path class=\"grid\" d=\"M[0-9.]+ ([0-9.]+)H[^/]*/><text class=\"y\"[^>]*>([^<]+)<"))
        y_ticks[std::stod(m[1])] = std::stod(m[2]);
    const std::vector<std::smatch> circles = matches(svg, "<circle cx=\"([^\"]+)\" cy=\"([^\"]+)\"");
    REQUIRE(circles.size() == points.size());
    for (std::size_t n = 0; n < points.size(); ++n) {
        const double x = value_at(x_ticks, std::stod(circles[n][1]), log_x);
        const double y = value_at(y_ticks, std::stod(circles[n][2]), log_y);
        CHECK(x == Approx(points[n].first).epsilon(2e-3).margin(2e-3));
        CHECK(y == Approx(points[n].second).epsilon(2e-2).margin(2e-3));
    }
}

Json run_json(const TempFolder& folder, std::vector<std::string> words)
{
    words.push_back("--json");
    const Outcome outcome = run_command(folder.path, words);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return Json::parse(outcome.out);
}

}  // namespace

TEST_CASE("text of any kind is text in a report")
{
    const TempFolder folder;
    CHECK(escaped(kHostile) == kHostileShown);
    CHECK(escaped("\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80") == "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80");
    CHECK(escaped("\xc0\xaf\xed\xa0\x80\xf8") == escaped(std::string(6, '\xff')));  // overlong, surrogate, none
    Report report(folder / "a.html", kHostile);
    report.heading(kHostile);
    report.paragraph(kHostile);
    report.table({kHostile}, {{Cell(kHostile, address_of(folder / kHostile.substr(9), folder / "a.html", "x=1&y=2"))}});
    report.plot({kHostile, kHostile, kHostile, false, false, {{kHostile, {{0, 0}, {1, 1}}}}, {kHostile, kHostile}});
    report.commit();
    require_well_formed(folder, "a.html");
    CHECK(matches(slurp(folder / "a.html"), "&lt;img src=x").size() >= 10);
}

TEST_CASE("a plot's points are where its ticks say, on both kinds of axes")
{
    check_plot(false, false, {{0, 0}, {1, 3}, {2.5, 7}, {10, 1}});
    check_plot(false, false, {{-4, 0.001}, {3, 0.0042}});
    check_plot(true, true, {{64, 2e-8}, {1000, 3.3e-7}, {1048576, 9.1e-5}});
    check_plot(true, false, {{64, 1.7}, {4096, 3.1}, {262144, 11}});
    check_plot(false, true, {{0, 1e-3}, {240, 40}});
    CHECK(svg_of({"none", "x", "y", false, true, {{"zeros", {{1, 0}, {2, NAN}}}}}).empty());
}

TEST_CASE("addresses are relative to the report, and hold no sign that ends them")
{
    const TempFolder folder;
    CHECK(address_of(folder / "a b\"<.html", folder / "r.html", "frame=1") == "a%20b%22%3C.html#frame=1");
    CHECK(address_of(folder.path / "pages/p.html", folder.path / "r.html", "x") == "pages/p.html#x");
    CHECK(address_of(folder.path / "p.html", folder.path / "reports/r.html", "x") == "../p.html#x");
}

TEST_CASE("a solve's report has the figures of --json, and links its worst limbs into the page")
{
    const TempFolder folder;
    const std::string name = "<img src=x onerror=alert(1)>\"'&.bvh";
    spill(folder / name, edited(kTwoArms, "JOINT LeftHand", "JOINT </script><img/src=x/onerror=alert(1)>'&"));
    spill(folder / "crowd.toml", "[limb.all]\ntarget.offset = [4, 4, 4]\n");
    const Json told = run_json(folder, {"solve", name, "--arm", "left:#1,#2,#3", "--characters", "20", "--crowd",
                                        "crowd.toml", "--report", "r.html"});
    require_well_formed(folder, "r.html");
    const std::string text = slurp(folder / "r.html");
    CHECK_THAT(text, Contains("&lt;/script&gt;&lt;img/src=x/onerror=alert(1)&gt;&#39;&amp;<"));
    for (const char* meaning : {"errors", "missed", "differences_from_clip"})
        if (told.contains(meaning))
            for (const auto& [key, stat] : told.at(meaning).items()) {
                char worst[32];
                std::snprintf(worst, sizeof worst, "%.3e", stat.at("worst").get<double>());
                INFO(key);
                CHECK_THAT(text, Contains(">" + std::string(worst) + "<"));
            }
    for (const auto& [flag, count] : told.at("flags").items())
        if (count > 0) CHECK_THAT(text, Contains(">" + flag + "</td><td class=\"number\">" + count.dump() + "<"));
    CHECK_THAT(text, Contains("too far") || Contains("out of reach"));
    CHECK(matches(text, "<svg").size() == 2);
    CHECK_THAT(text, !Contains("<a href"));  // there is no page to link into
}

TEST_CASE("a verification's report has the figures of --json")
{
    const TempFolder folder;
    const Json told = run_json(folder, {"verify", "--arms", "500", "--report", "v.html"});
    require_well_formed(folder, "v.html");
    const std::string text = slurp(folder / "v.html");
    for (const Json& check : told.at("checks")) {
        char largest[32];
        std::snprintf(largest, sizeof largest, "%.3e", check.at("max").get<double>());
        CHECK_THAT(text, Contains(largest) && Contains(escaped(check.at("name").get<std::string>())));
    }
    for (const Json& digest : told.at("digests")) CHECK_THAT(text, Contains(digest.at("limbs").get<std::string>()));
    CHECK(matches(text, "<svg").size() >= 3);  // wrists, hinges and rotors by band
}

TEST_CASE("a report that cannot be written fails before the work, and replaces no input")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"solve", "clip.bvh", "--report", "none/r.html"},
          {"verify", "--report", "none/r.html"}}) {
        const Outcome outcome = run_command(folder.path, words);
        CHECK(outcome.exit_code == 1);
        CHECK_THAT(outcome.err, Contains("none"));
    }
    CHECK(run_command(folder.path, {"solve", "clip.bvh", "--report", "clip.bvh"}).exit_code == 2);
    CHECK(run_command(folder.path, {"verify", "--report", "-"}).exit_code == 2);
    CHECK(slurp(folder / "clip.bvh") == kTwoArms);
}
