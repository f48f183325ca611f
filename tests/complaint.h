#pragma once
// SPDX-License-Identifier: MIT
// What readers of files say when they refuse one.

#include <catch2/catch.hpp>

#include <string>

#include "tests/test_data.h"
#include "tools/formats/error.h"

namespace swivel::test {

// What the InputError of `read` says, in one line, without the folder; empty if there is none.
template <class Read>
std::string complaint_of(const TempFolder& folder, const Read& read)
{
    try {
        read();
    } catch (const formats::InputError& error) {
        const std::string what = error.what();
        const std::string place = (folder.path / "").string();
        REQUIRE(what.starts_with(place));
        REQUIRE(what.find_first_of("\n\r") == std::string::npos);
        return what.substr(place.size());
    }
    return {};
}

}  // namespace swivel::test
