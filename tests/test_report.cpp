// SPDX-License-Identifier: MIT
//
// The promise: reports show text as text, whatever names hold; plots put points where their axes say; numbers are those
// of --json; the worst limbs are those that forward kinematics of the tables tells. tests/test_view.cpp has the links.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <tuple>

#include "tests/plain_motion.h"
#include "tests/pose_rows.h"
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

// What a pattern found: the whole, and then its groups.
using Found = std::vector<std::string>;

std::vector<Found> matches(const std::string& text, const std::string& pattern)
{
    const std::regex regex(pattern);
    std::vector<Found> all;
    for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
        all.emplace_back(at->begin(), at->end());
    return all;
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
    for (const Found& m : matches(svg, "class=\"x\" x=\"([^\"]+)\"[^>]*>([^<]+)<"))
        x_ticks[std::stod(m[1])] = std::stod(m[2]);
    for (const Found& m :
         matches(svg, "<path class=\"grid\" d=\"M[0-9.]+ ([0-9.]+)H[^/]*/><text class=\"y\"[^>]*>([^<]+)<"))
        y_ticks[std::stod(m[1])] = std::stod(m[2]);
    const std::vector<Found> circles = matches(svg, "<circle cx=\"([^\"]+)\" cy=\"([^\"]+)\"");
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

// A frame, a character and a limb.
using LimbPlace = std::tuple<std::size_t, std::size_t, std::string>;

// A row of the worst limbs: its place, the error and the flags.
const std::string kLimbRow =
    "<td[^>]*>frame (\\d+), character (\\d+), (\\w+)</td><td[^>]*>([^<]+)</td><td[^>]*>([^<]*)</td>";

// From the tables p.csv and t.csv of clip.bvh, by forward kinematics: how far wrists are from their targets, in limb
// lengths. offset: what the crowd file adds to all targets.
std::map<LimbPlace, double> errors_of_tables(const TempFolder& folder, const Eigen::Vector3d& offset)
{
    const PlainMotion clip = plain_motion_of(folder / "clip.bvh");
    std::map<LimbPlace, Eigen::Vector3d> targets;
    std::istringstream table(slurp(folder / "t.csv"));
    std::string line;
    for (std::getline(table, line); std::getline(table, line);) {
        const std::vector<std::string> cells = cells_of(line);
        targets[{std::stoul(cells[0]), std::stoul(cells[1]), cells[2]}] =
            Eigen::Vector3d(std::stod(cells[3]), std::stod(cells[4]), std::stod(cells[5])) + offset;
    }
    std::map<LimbPlace, double> errors;
    const std::vector<PlainArm> arms = arms_of(clip);
    for (const PoseLine& row : pose_lines(slurp(folder / "p.csv"))) {
        const PlainArm& arm = arms[row.limb == "left_arm" ? 0 : 1];
        const auto start = static_cast<std::size_t>(row.number("start"));
        const PlainArmPose at = arm_pose(clip, arm, (row.frame + start) % clip.values.size());
        const Eigen::Vector3d place(row.number("place_x"), row.number("place_y"), row.number("place_z"));
        const Eigen::Matrix3d upper = at.parent * row.joint[0].toRotationMatrix();
        const Eigen::Matrix3d fore = upper * row.joint[1].toRotationMatrix();
        const Eigen::Vector3d reach = upper * clip.joint(arm.elbow).offset + fore * clip.joint(arm.wrist).offset;
        const Eigen::Vector3d wrist = at.shoulder + place + row.number("size") * reach;
        errors[{row.frame, row.character, row.limb}] =
            (wrist - targets.at({row.frame, row.character, row.limb})).norm() / (row.number("size") * arm.length());
    }
    return errors;
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

TEST_CASE("a point without neighbours is a dot, however many points there are")
{
    Series series{"series", {}};
    for (int n = 0; n < 100; ++n) series.points.emplace_back(n, n == 50 ? 3 : n < 98 ? 0 : 5);
    const std::string svg = svg_of({"plot", "x", "y", false, true, {series}});  // 0 has no logarithm
    const std::vector<Found> circles = matches(svg, "<circle [^>]*><title>([^<]+)<");
    REQUIRE(circles.size() == 1);
    CHECK(circles[0][1] == "series: 50, 3");
    CHECK(matches(svg, "class=\"series[^>]*><path d=\"M[0-9. ]+L[0-9. ]+\"/>").size() == 1);  // the last two

    for (const bool is_bound : {false, true}) {
        const std::string lone = svg_of({"plot", "x", "y", false, true, {{"series", {{1, 2}}, true, is_bound}}});
        CHECK(matches(lone, "<circle ").size() == 1);
        CHECK(matches(lone, "class=\"series[^>]*><path").empty());
    }
    series.is_line = false;
    CHECK(matches(svg_of({"plot", "x", "y", false, true, {series}}), "<circle ").size() == 3);
}

TEST_CASE("a bound is below the frame's upper edge, and the key shows lines, dashes and dots in colours of their own")
{
    for (const bool log : {false, true}) {
        const std::string svg = svg_of(
            {"plot", "x", "y", false, log, {{"limit", {{0, 100}, {1, 100}}, true, true}, {"of", {{0, 1}, {1, 2}}}}});
        const auto edges = matches(svg, "<path class=\"grid\" d=\"M[0-9.]+ ([0-9.]+)H");
        const auto bound = matches(svg, "bound\"><path d=\"M[0-9.]+ ([0-9.]+)L");
        REQUIRE(bound.size() == 1);
        CHECK(std::stod(bound[0][1]) > std::stod(edges.back()[1]) + 1);
    }
    const TempFolder folder;
    Report report(folder / "a.html", "colours");
    Plot plot{"plot", "x", "y", false, false, {{"limit", {{0, 1}, {1, 1}}, true, true}, {"points", {{0, 1}}, false}}};
    for (int n = 0; n < 10; ++n) plot.series.push_back({"line", {{0, n}, {1, n}}});
    report.plot(plot);
    report.commit();
    const std::string text = slurp(folder / "a.html");
    CHECK_THAT(text, Contains("<li class=\"s0 bound\">") && Contains("<li class=\"s1 dots\">"));
    std::set<std::string> colours;
    for (const Found& m : matches(text, "\\.s\\d+ \\{ --c: (#[0-9a-f]{6})")) colours.insert(m[1]);
    CHECK(colours.size() == 12);
    CHECK(matches(text, "<li class=\"s11\">").size() == 1);
}

TEST_CASE("a table breaks long words alone, so that it is no wider than the page and short words stay whole")
{
    const TempFolder folder;
    Report report(folder / "a.html", "words");
    report.table({"what", "value"}, {{"passed", std::string(200, 'x')}, {"as recorded", "1,234"}});
    report.commit();
    const std::string text = slurp(folder / "a.html");
    CHECK_THAT(text, Contains("td.long { overflow-wrap: anywhere; }"));
    CHECK(matches(text, "<td class=\"[a-z ]*long\">x{200}</td>").size() == 1);
    CHECK(matches(text, "<td class=\"[a-z ]*long\">").size() == 1);
}

TEST_CASE("addresses are relative to the report, and hold no sign that ends them")
{
    const TempFolder folder;
    CHECK(address_of(folder / "a b\"<.html", folder / "r.html", "frame=1") == "a%20b%22%3C.html#frame=1");
    CHECK(address_of(folder.path / "pages/p.html", folder.path / "r.html", "x") == "pages/p.html#x");
    CHECK(address_of(folder.path / "p.html", folder.path / "reports/r.html", "x") == "../p.html#x");
}

TEST_CASE("a solve's report has the figures of --json, limbs that do not bind, and without a page no links")
{
    const TempFolder folder;
    const std::string name = "<img src=x onerror=alert(1)>\"'&.bvh";
    spill(folder / name, edited(kTwoArms, "JOINT LeftHand", "JOINT </script><img/src=x/onerror=alert(1)>'&"));
    spill(folder / "crowd.toml", "[limb.all]\ntarget.offset = [4, 4, 4]\n");
    const Json told = run_json(folder, {"solve", name, "--arm", "left:#1,#2,#3", "--characters", "20", "--crowd",
                                        "crowd.toml", "--limbs", "all", "--report", "r.html"});
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
    for (const Json& limb : told.at("missing"))
        CHECK_THAT(text, Contains(">" + limb.at("limb").get<std::string>() + "</td><td class=\"\">" +
                                  escaped(limb.at("problem").get<std::string>()) + "<"));
    CHECK(told.at("missing").size() == 2);  // the legs
    CHECK(matches(text, "<svg").size() == 2);
    CHECK_THAT(text, !Contains("<a href"));  // there is no page to link into
}

TEST_CASE("the worst limbs of a report are those of its tables, each in its worst frame")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    spill(folder / "crowd.toml", "[limb.all]\ntarget.offset = [4, 4, 4]\n");  // all of them are clamped far
    REQUIRE(run_command(folder.path, {"solve", "clip.bvh", "--characters", "200", "--crowd", "crowd.toml", "--out",
                                      "p.csv", "--export-targets", "t.csv", "--report", "r.html"})
                .exit_code == 0);
    const std::map<LimbPlace, double> errors = errors_of_tables(folder, Eigen::Vector3d(4, 4, 4));
    std::map<std::pair<std::size_t, std::string>, double> worst_of;
    for (const auto& [place, error] : errors) {
        double& worst = worst_of[{std::get<1>(place), std::get<2>(place)}];
        worst = std::max(worst, error);
    }
    std::vector<double> sorted;
    for (const auto& [limb, worst] : worst_of) sorted.push_back(worst);
    std::ranges::sort(sorted, std::greater());
    REQUIRE(sorted.size() == 400);

    const std::string text = slurp(folder / "r.html");
    const std::string worst = text.substr(text.find("The worst limbs"));
    const std::vector<Found> rows = matches(worst, kLimbRow);
    REQUIRE(rows.size() == 10);
    for (std::size_t n = 0; n < rows.size(); ++n) {
        const LimbPlace place{std::stoul(rows[n][1]), std::stoul(rows[n][2]), rows[n][3]};
        INFO(rows[n][0]);
        CHECK(std::stod(rows[n][4]) == Approx(sorted[n]).epsilon(1e-3));  // of four digits
        CHECK(errors.at(place) == Approx(sorted[n]).epsilon(1e-6));
        CHECK(worst_of.count({std::get<1>(place), std::get<2>(place)}) == 1);
        worst_of.erase({std::get<1>(place), std::get<2>(place)});  // no limb is there twice
        CHECK(rows[n][5] == "clamped far");
    }
}

TEST_CASE("limbs with bad input come first among the worst, with a dash for their distance and what is bad")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    spill(folder / "crowd.toml", "[limb.all]\ntarget.offset = [4, 4, 4]\n");  // all others are clamped far
    spill(folder / "far.csv", "frame,character,limb,x,y,z\n1,7,left_arm,1e30,0,0\n");
    const Outcome outcome = run_command(folder.path, {"solve", "clip.bvh", "--characters", "30", "--crowd",
                                                      "crowd.toml", "--targets", "far.csv", "--report", "r.html"});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const std::string text = slurp(folder / "r.html");
    const std::vector<Found> rows = matches(text.substr(text.find("The worst limbs")), kLimbRow);
    REQUIRE(rows.size() == 10);
    CHECK(rows[0][1] == "1");
    CHECK(rows[0][2] == "7");
    CHECK(rows[0][3] == "left_arm");
    CHECK(rows[0][4] == "–");
    CHECK(rows[0][5] == "bad input");
    for (std::size_t n = 1; n < rows.size(); ++n) CHECK(rows[n][5] == "clamped far");
    CHECK_THAT(text, Contains("Bad input: target (1e+30, "));
    CHECK_THAT(text, !Contains("nan"));
}

TEST_CASE("a solve's report starts with what came out, in plain words, and says no key of --json")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    spill(folder / "far.csv", "frame,character,limb,x,y,z\n0,3,left_arm,70,0,0\n1,7,left_arm,1e30,0,0\n");
    spill(folder / "crowd.toml", "[limb.all]\ntarget.offset = [4, 4, 4]\n");
    const auto report = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"solve", "clip.bvh", "--report", "r.html"});
        REQUIRE(run_command(folder.path, words).exit_code == 0);
        const std::string text = slurp(folder / "r.html");
        for (const char* key :
             {"isa", "went wrong", "solve seconds", "bend source", "frame time", "upper arm swing</td>"})
            CHECK_THAT(text, !Contains(">" + std::string(key)));
        CHECK(matches(text, "<td[^>]*>[^<]*[1-9]\\d*\\.\\d{6,}").empty());  // of a table's cell: four digits
        CHECK(matches(text, "<td[^>]*>\\[").empty());
        return text.substr(text.find("</h1>"), 300);
    };
    CHECK_THAT(report({}), Contains("</h1>\n<p>All 4 arms reached their targets.</p>"));
    CHECK_THAT(report({"--targets", "far.csv", "--characters", "300"}),
               Contains("</h1>\n<p>All 1,200 arms reached their targets but for 2. The furthest is ") &&
                   Contains(" times its length away from its target. 1 has bad input.</p>"));
    CHECK_THAT(report({"--crowd", "crowd.toml"}), Contains("</h1>\n<p>None of the 4 arms reached its target. ") &&
                                                      Contains("Are the targets in the right place and unit?</p>"));
}

TEST_CASE("a solve's flags are plotted without those that reached their targets, and its errors say of what")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    spill(folder / "far.csv", "frame,character,limb,x,y,z\n0,3,left_arm,70,0,0\n");
    REQUIRE(run_command(folder.path,
                        {"solve", "clip.bvh", "--report", "r.html", "--targets", "far.csv", "--characters", "30"})
                .exit_code == 0);
    const std::string text = slurp(folder / "r.html");
    CHECK_THAT(text, Contains(">distance from target, in limb lengths</text>"));
    const std::string flags = text.substr(text.find(">Flags<"));
    CHECK_THAT(flags, Contains("</i>clamped far</li>") && !Contains("</i>reached</li>"));
    CHECK_THAT(flags, Contains("<title>clamped far: 0, 0.0166667</title>"));  // one of 60
    CHECK(matches(flags, "class=\"y\"[^>]*>1</text>").empty());               // on a scale of its own
}

// Texts of 11.5 pixels, of which a sign takes about 6, on one line of a plot.
void check_names_are_apart(const std::string& svg)
{
    double end = 0;
    for (const Found& m : matches(svg, "<text class=\"x\" x=\"([0-9.]+)\"[^>]*>([^<]+)<")) {
        const double half = 3 * static_cast<double>(m[2].length());
        INFO(m[2]);
        CHECK(std::stod(m[1]) - half > end);
        end = std::stod(m[1]) + half;
    }
}

TEST_CASE("a verification's report names every column once, and its bands of reach lie beside each other")
{
    const TempFolder folder;
    REQUIRE(run_command(folder.path, {"verify", "--arms", "500", "--report", "v.html"}).exit_code == 0);
    const std::string text = slurp(folder / "v.html");
    for (const Found& table : matches(text, "<thead>.*?</thead>")) {
        std::set<std::string> heads;
        const std::vector<Found> all = matches(table[0], "<th[^>]*>([^<]*)</th>");
        for (const Found& head : all) {
            CHECK(head[1].length() > 0);
            heads.insert(head[1]);
        }
        CHECK(heads.size() == all.size());
    }
    for (const Found& svg : matches(text, "<svg.*?</svg>")) check_names_are_apart(svg[0]);
    CHECK_THAT(text, Contains("production is the formula") && Contains("pipeline is the lecture"));
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

TEST_CASE("pages and reports take no name of a clip, a table or a crowd file, and replace none")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    for (const char* name : {"a.csv", "b.bvh", "c.GLB", "d.gltf", "e.vrm", "f.toml"}) {
        spill(folder / name, "of someone");
        for (std::vector<std::string> words : {std::vector<std::string>{"solve", "clip.bvh", "--report"},
                                               {"solve", "clip.bvh", "--view"},
                                               {"view", "clip.bvh", "--out"},
                                               {"demo", "--frames", "1", "--characters", "1", "--view"},
                                               {"verify", "--arms", "1", "--report"},
                                               {"bench", "--seconds", "1", "--report"}}) {
            const std::string option = words.back();
            words.push_back(name);
            const Outcome outcome = run_command(folder.path, words);
            INFO(words[0] << " " << outcome.err);
            CHECK(outcome.exit_code == 2);
            CHECK_THAT(outcome.err, Contains(option + " " + name + ": writes HTML") && Contains("name a .html"));
            CHECK(slurp(folder / name) == "of someone");
        }
    }
}
