// SPDX-License-Identifier: MIT
//
// The table of targets: any text is read or refused in one line. What is read is finite and in order, and reads the
// same when it is written down again.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "tests/fuzz/check_clip.h"
#include "tests/fuzz/scratch_folder.h"
#include "tools/formats/targets_csv.h"

using namespace swivel::formats;
using namespace swivel::fuzz;

namespace {

auto place_of(const Target& target) { return std::tuple(target.frame, target.character, target.limb); }

void check_target(const Target& target, std::size_t line_count)
{
    SWIVEL_REQUIRE(target.position.allFinite() && target.pole.allFinite());
    SWIVEL_REQUIRE(is_unit(target.orientation));
    SWIVEL_REQUIRE(target.line >= 2 && target.line <= line_count);
}

bool are_same(const Target& a, const Target& b)
{
    return place_of(a) == place_of(b) && a.position == b.position && a.pole == b.pole && a.has_pole == b.has_pole &&
           a.has_orientation == b.has_orientation && a.orientation.isApprox(b.orientation, 1e-15);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const ScratchFolder folder;
    const std::string_view text = text_of(data, size);
    std::vector<Target> targets;
    try {
        targets = read_targets_csv(folder.spill("in.csv", text));
    } catch (const InputError& error) {
        check_message(error);
        return 0;
    }
    const auto line_count = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
    for (const Target& target : targets) check_target(target, line_count);
    const auto is_before = [](const Target& a, const Target& b) { return place_of(a) < place_of(b); };
    SWIVEL_REQUIRE(std::is_sorted(targets.begin(), targets.end(), is_before));

    TargetsCsv csv(folder.path / "again.csv");
    csv.append(targets);
    csv.commit();
    const std::vector<Target> again = read_targets_csv(folder.path / "again.csv");
    SWIVEL_REQUIRE(std::equal(targets.begin(), targets.end(), again.begin(), again.end(), are_same));
    return 0;
}
