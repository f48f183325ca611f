// SPDX-License-Identifier: MIT
#include "tools/formats/bvh_scanner.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

constexpr std::string_view kTokenEnds = " \t\r\n\v\f{}:";

}  // namespace

std::string_view next_token(Scanner& scan)
{
    const std::size_t begin = std::min(scan.text.find_first_not_of(kBlanks, scan.at), scan.text.size());
    skip_to(scan, begin);
    std::size_t end = std::min(scan.text.find_first_of(kTokenEnds, begin), scan.text.size());
    const bool takes_stop = end < scan.text.size() && (scan.text[end] == ':' || end == begin);
    if (takes_stop) ++end;
    scan.at = end;
    return scan.text.substr(begin, end - begin);
}

std::string_view rest_of_line(Scanner& scan)
{
    const std::size_t end = std::min(scan.text.find_first_of("\n{}", scan.at), scan.text.size());
    const std::string_view rest = scan.text.substr(scan.at, end - scan.at);
    scan.at = end;
    return trimmed(rest);
}

void skip_to(Scanner& scan, std::size_t place)
{
    const std::size_t counted = std::max(std::min(place, scan.text.size() - 1), scan.at);
    const std::string_view passed = scan.text.substr(scan.at, counted - scan.at);
    scan.line += static_cast<std::size_t>(std::count(passed.begin(), passed.end(), '\n'));
    scan.at = place;
}

void expect(Scanner& scan, std::string_view word)
{
    const std::string_view token = next_token(scan);
    if (!same_ignoring_case(token, word)) fail_expected(scan, word, token);
}

void fail(const Scanner& scan, std::string_view cause) { throw InputError(scan.path, scan.line, cause); }

void fail_expected(const Scanner& scan, std::string_view wanted, std::string_view found)
{
    if (found.empty()) fail(scan, fmt::format("the file ends where {} should be; is it cut short?", wanted));
    fail(scan,
         fmt::format("'{}' where {} should be; correct it, or export the clip as BVH again", printable(found), wanted));
}

}  // namespace swivel::formats
