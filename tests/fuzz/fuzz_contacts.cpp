// SPDX-License-Identifier: MIT
//
// The table of contacts: any text is read or refused in one line. What is read is in order, and reads the same when it
// is written down again.
#include <algorithm>
#include <cstdint>
#include <tuple>

#include "tests/fuzz/check_clip.h"
#include "tests/fuzz/scratch_folder.h"
#include "tools/formats/contacts_csv.h"

using namespace swivel::formats;
using namespace swivel::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const ScratchFolder folder;
    std::vector<ContactRow> rows;
    try {
        rows = read_contacts_csv(folder.spill("in.csv", text_of(data, size)));
    } catch (const InputError& error) {
        check_message(error);
        return 0;
    }
    const auto place = [](const ContactRow& row) { return std::tuple(row.frame, row.limb); };
    SWIVEL_REQUIRE(std::ranges::is_sorted(rows, {}, place));
    write_contacts_csv(folder.path / "again.csv", rows);
    const auto same = [&](const ContactRow& a, const ContactRow& b) {
        return place(a) == place(b) && a.is_on == b.is_on;
    };
    SWIVEL_REQUIRE(std::ranges::equal(read_contacts_csv(folder.path / "again.csv"), rows, same));
    return 0;
}
