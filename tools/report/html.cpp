// SPDX-License-Identifier: MIT
#include "tools/report/html.h"

#include <fmt/format.h>

#include <algorithm>

namespace swivel::tools {

namespace {

constexpr std::string_view kStyle = R"(
:root { --text: #1d2733; --soft: #5c6875; --paper: #fff; --edge: #d5dae0; --bad: #b3261e; --link: #1f6fd1; color-scheme: light dark; }
@media (prefers-color-scheme: dark) { :root { --text: #e4e9ef; --soft: #9aa6b4; --paper: #12161c; --edge: #323b46; --bad: #ff8a80; --link: #79b2ff; } }
body { margin: 2em auto; max-width: 920px; padding: 0 20px; background: var(--paper); color: var(--text); font: 15px/1.5 system-ui, sans-serif; }
h1 { font-size: 24px; overflow-wrap: anywhere; } h2 { font-size: 18px; margin-top: 2em; }
a { color: var(--link); } p { max-width: 46em; overflow-wrap: anywhere; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-size: 13.5px; font-variant-numeric: tabular-nums; margin: 1em 0; }
th, td { text-align: left; padding: 3px 14px 3px 0; border-bottom: 1px solid var(--edge); vertical-align: top; }
td.long { overflow-wrap: anywhere; }
th { color: var(--soft); font-weight: 600; } .number { text-align: right; white-space: nowrap; } .bad { color: var(--bad); font-weight: 600; }
figure { margin: 1.2em 0; } figcaption { color: var(--soft); font-size: 13.5px; } svg { width: 100%; height: auto; font-size: 11.5px; }
svg text { fill: var(--soft); } svg .x { text-anchor: middle; } svg .y { text-anchor: end; } svg .label { font-size: 12.5px; }
.grid { stroke: var(--edge); fill: none; } .series path { stroke: var(--c); fill: none; stroke-width: 2; } .series circle { fill: var(--c); }
.bound path { stroke-dasharray: 6 5; stroke-width: 1.5; }
.s0 { --c: #1f77d0; } .s1 { --c: #e07b1f; } .s2 { --c: #2d9a57; } .s3 { --c: #c8508f; } .s4 { --c: #8a63d2; } .s5 { --c: #d0342c; } .s6 { --c: #169b9b; } .s7 { --c: #8a8f98; }
.s8 { --c: #a88a00; } .s9 { --c: #7d5230; } .s10 { --c: #5c66d6; } .s11 { --c: #6f8f1f; }
.key { display: flex; flex-wrap: wrap; gap: 4px 18px; list-style: none; padding: 0; margin: 4px 0; font-size: 13.5px; }
.key i { display: inline-block; width: 14px; height: 4px; border-radius: 2px; background: var(--c); margin-right: 7px; vertical-align: middle; }
.key .bound i { background: repeating-linear-gradient(90deg, var(--c) 0 5px, transparent 5px 8px); border-radius: 0; }
.key .dots i { width: 8px; height: 8px; border-radius: 50%; }
@media print { body { margin: 0; max-width: none; } figure, tr { break-inside: avoid; } }
)";

// How many bytes the UTF-8 character at the text's start takes; 0: it is none.
std::size_t character_length(std::string_view text)
{
    const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
    const std::size_t length = byte(0) < 0x80   ? 1
                               : byte(0) < 0xc2 ? 0
                               : byte(0) < 0xe0 ? 2
                               : byte(0) < 0xf0 ? 3
                               : byte(0) < 0xf5 ? 4
                                                : 0;
    if (length == 0 || length > text.size()) return 0;
    for (std::size_t n = 1; n < length; ++n)
        if ((byte(n) & 0xc0) != 0x80) return 0;
    const bool is_too_long = (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xf0 && byte(1) < 0x90);
    const bool is_none = (byte(0) == 0xed && byte(1) > 0x9f) || (byte(0) == 0xf4 && byte(1) > 0x8f);
    return is_too_long || is_none ? 0 : length;
}

// Whether a word is so long that a cell had better break it than be as wide. 32: a joint's name, a digest and a path of
// two folders stay whole.
bool has_long_word(std::string_view text)
{
    std::size_t length = 0;
    for (const char c : text) {
        length = c == ' ' ? 0 : length + 1;
        if (length > 32) return true;
    }
    return false;
}

bool is_number(const std::string& text)
{
    return text == kNoNumber || (!text.empty() && text.find_first_not_of("0123456789.,e+-×% ") == std::string::npos);
}

}  // namespace

std::string escaped(std::string_view text)
{
    std::string safe;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = character_length(text.substr(at));
        const char c = text[at];
        const bool is_control =
            length == 1 && ((static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t') || c == 127);
        if (length == 0 || is_control)
            safe += "\xef\xbf\xbd";
        else if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '>')
            safe += "&gt;";
        else if (c == '"')
            safe += "&quot;";
        else if (c == '\'')
            safe += "&#39;";
        else
            safe += text.substr(at, length);
        at += std::max<std::size_t>(length, 1);
    }
    return safe;
}

Report::Report(const std::filesystem::path& path, std::string_view title) : out_(path)
{
    const std::string shown = escaped(title);
    html_ = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/><title>{}</title><style>{}</style>"
        "</head>\n<body><h1>{}</h1>\n",
        shown, kStyle, shown);
}

void Report::heading(std::string_view text) { html_ += fmt::format("<h2>{}</h2>\n", escaped(text)); }
void Report::paragraph(std::string_view text) { html_ += fmt::format("<p>{}</p>\n", escaped(text)); }

void Report::table(const std::vector<std::string>& heads, const std::vector<std::vector<Cell>>& rows)
{
    std::vector<const char*> classes(heads.size(), "number");
    for (const std::vector<Cell>& row : rows)
        for (std::size_t n = 0; n < row.size(); ++n)
            if (!row[n].text.empty() && !is_number(row[n].text)) classes[n] = "";
    html_ += "<div class=\"wide\"><table><thead><tr>";
    for (std::size_t n = 0; n < heads.size(); ++n)
        html_ += fmt::format("<th class=\"{}\">{}</th>", classes[n], escaped(heads[n]));
    html_ += "</tr></thead><tbody>\n";
    for (const std::vector<Cell>& row : rows) {
        html_ += "<tr>";
        for (std::size_t n = 0; n < row.size(); ++n) {
            const std::string text = escaped(row[n].text);
            const std::string shown =
                row[n].link.empty() ? text : fmt::format("<a href=\"{}\">{}</a>", escaped(row[n].link), text);
            html_ += fmt::format("<td class=\"{}{}{}\">{}</td>", classes[n], row[n].is_bad ? " bad" : "",
                                 has_long_word(row[n].text) ? " long" : "", shown);
        }
        html_ += "</tr>\n";
    }
    html_ += "</tbody></table></div>\n";
}

void Report::plot(const Plot& plot)
{
    const std::string svg = svg_of(plot);
    if (svg.empty()) return;
    html_ += fmt::format("<figure>{}<ul class=\"key\">", svg);
    for (std::size_t n = 0; n < plot.series.size(); ++n) {
        const Series& series = plot.series[n];
        html_ += fmt::format("<li class=\"s{}{}\"><i></i>{}</li>", n % kColourCount,
                             series.is_bound  ? " bound"
                             : series.is_line ? ""
                                              : " dots",
                             escaped(series.name));
    }
    html_ += fmt::format("</ul><figcaption>{}</figcaption></figure>\n", escaped(plot.title));
}

void Report::commit()
{
    out_.write(html_);
    out_.write("</body></html>\n");
    out_.commit();
}

std::string address_of(const std::filesystem::path& file, const std::filesystem::path& beside,
                       std::string_view fragment)
{
    namespace fs = std::filesystem;
    const fs::path folder = fs::absolute(beside).parent_path();
    const fs::path relative = fs::absolute(file).lexically_normal().lexically_relative(folder.lexically_normal());
    std::string address;
    for (const char c : relative.generic_string()) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                              std::string_view("-._~/").find(c) != std::string_view::npos;
        address += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return address + "#" + std::string(fragment);
}

}  // namespace swivel::tools
