// SPDX-License-Identifier: MIT
//
// A report as one HTML file: headings, sentences, tables and plots, light and dark, without scripts. All text is given
// as text and escaped here. So no name of a file or joint becomes markup.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/formats/output_file.h"
#include "tools/report/plot.h"

namespace swivel::tools {

// As HTML and XML hold it. Bytes that are no UTF-8, and control characters, become U+FFFD.
std::string escaped(std::string_view text);

// In place of a number that does not exist.
inline constexpr const char* kNoNumber = "–";

struct Cell {
    Cell(std::string shown) : text(std::move(shown)) {}
    Cell(const char* shown) : text(shown) {}
    Cell(std::string shown, std::string address) : text(std::move(shown)), link(std::move(address)) {}

    std::string text;
    std::string link{};   // an address; empty: none
    bool is_bad = false;  // to be seen at once
};

class Report {
public:
    // Opens the file. Throws InputError as OutputFile does.
    Report(const std::filesystem::path& path, std::string_view title);

    // Of what follows, up to the next one.
    void heading(std::string_view text);
    // Plain text; long words are broken.
    void paragraph(std::string_view text);
    // Rows as long as heads. Columns whose cells are numbers stand to the right.
    void table(const std::vector<std::string>& heads, const std::vector<std::vector<Cell>>& rows);
    // With its title below. A plot without points is left out.
    void plot(const Plot& plot);

    // Makes the file appear. To be called once, last.
    void commit();

private:
    std::string html_;
    formats::OutputFile out_;
};

// An address of a file beside another one, with what follows "#": "a%20b.html#frame=3".
std::string address_of(const std::filesystem::path& file, const std::filesystem::path& beside,
                       std::string_view fragment);

}  // namespace swivel::tools
