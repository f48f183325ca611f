// SPDX-License-Identifier: MIT
//
// Texts for people that a person has read and approved: a file of tests/approved, with a scene after its name and a
// line for each text. Words must be the same. Numbers may differ by two thousandths, because tests that calculate them
// judge them. With SWIVEL_RENEW=1 in the environment a test writes its file anew; then read what changed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "swivel/swivel.h"

namespace swivel::test {

class ApprovedTexts {
public:
    explicit ApprovedTexts(const std::string& file);
    // The lines after this are a scene of this name.
    void scene(const std::string& name);
    // when: what was done before it says this, in a few words.
    void line(const std::string& when, const std::string& text);
    // Fails where the file has other lines.
    void compare() const;

private:
    std::string path_;
    std::vector<std::string> lines_;
};

// That call(room, size) gives a text as far as there is room for it, with dots where it is cut, and writes no further.
void check_room(const std::string& whole, const std::function<swivel_status(char* room, std::size_t size)>& call);

// The number after these words, which must be there.
double number_after(const std::string& text, const std::string& words);

}  // namespace swivel::test
