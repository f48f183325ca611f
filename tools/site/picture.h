// SPDX-License-Identifier: MIT
//
// A picture of lines and words as SVG, and the pictures of the pages that swivel itself draws.
#pragma once

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <string>
#include <vector>

inline constexpr char kInk[] = "#22324a", kGrey[] = "#5b6b80", kPale[] = "#a9b4c2", kOrange[] = "#c9761a",
                      kRed[] = "#b93a2b", kGreen[] = "#23834a";

struct Point {
    double x, y;
};

class Picture {
public:
    Picture(const char* title, int height)
    {
        add("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 %d\" font-family=\"DejaVu Sans, Helvetica, "
            "Arial, sans-serif\">\n  <title>%s</title>\n  <rect width=\"760\" height=\"%d\" rx=\"8\" "
            "fill=\"#fbfaf5\"/>\n",
            height, title, height);
    }
    void box(Point a, Point b, const char* colour, double opacity)
    {
        add("  <rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\" opacity=\"%.2f\"/>\n",
            std::fmin(a.x, b.x), std::fmin(a.y, b.y), std::fabs(b.x - a.x), std::fabs(b.y - a.y), colour, opacity);
    }
    void area(const std::vector<Point>& points, const char* colour, double opacity)
    {
        path(points);
        add(" Z\" fill=\"%s\" opacity=\"%.2f\"/>\n", colour, opacity);
    }
    void line(const std::vector<Point>& points, const char* colour, double width, const char* dash = "")
    {
        path(points);
        add("\" fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\" stroke-linejoin=\"round\" stroke-linecap=\"round\"",
            colour, width);
        if (*dash) add(" stroke-dasharray=\"%s\"", dash);
        add("/>\n");
    }
    void dot(Point at, double radius, const char* colour)
    {
        add("  <circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\"/>\n", at.x, at.y, radius, colour);
    }
    // anchor: start, middle or end.
    void text(Point at, const char* words, const char* colour, const char* anchor = "start")
    {
        add("  <text x=\"%.1f\" y=\"%.1f\" fill=\"%s\" font-size=\"14\" text-anchor=\"%s\">%s</text>\n", at.x, at.y,
            colour, anchor, words);
    }
    std::string done() const { return text_ + "</svg>\n"; }

private:
    void path(const std::vector<Point>& points)
    {
        add("  <path d=\"");
        for (std::size_t n = 0; n < points.size(); ++n)
            add("%s%.1f %.1f", n == 0 ? "M" : " L", points[n].x, points[n].y);
    }
    [[gnu::format(printf, 2, 3)]] void add(const char* format, ...)
    {
        char room[512];
        std::va_list arguments;
        va_start(arguments, format);
        std::vsnprintf(room, sizeof room, format, arguments);
        va_end(arguments);
        text_ += room;
    }
    std::string text_;
};

struct NamedPicture {
    const char* name;  // of the file
    std::string text;
};
std::vector<NamedPicture> feet_pictures();    // docs/howto/feet.md
std::vector<NamedPicture> look_pictures();    // docs/howto/look.md
std::vector<NamedPicture> region_pictures();  // docs/howto/limits.md
