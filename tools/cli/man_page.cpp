// SPDX-License-Identifier: MIT
#include "tools/cli/man_page.h"

#include <fmt/format.h>

#include "swivel/swivel.h"

namespace swivel::tools {

namespace {

// Text as roff takes it: hyphens and tildes stay such as can be copied, lines stay lines, and the first starts no
// request.
std::string roff(const std::string& text)
{
    std::string out = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if (c == '~')
            out += "\\(ti";
        else if (c == '\n')
            out += "\n.br\n";
        else
            out += c;
    }
    return out;
}

std::string bold(const std::string& text) { return fmt::format("\\fB{}\\fR", roff(text)); }
std::string italic(const std::string& text) { return fmt::format("\\fI{}\\fR", roff(text)); }

std::string option_text(const OptionOutline& option)
{
    std::string names;
    for (const std::string& name : option.names)
        names += (names.empty() ? "" : ", ") + (option.is_positional ? italic(name) : bold(name));
    if (!option.is_positional && !option.value.empty()) names += " " + italic(option.value);
    std::string text = roff(option.text);
    if (!option.otherwise.empty()) text += fmt::format(". Default: {}", roff(option.otherwise));
    return fmt::format(".TP\n{}\n{}.\n", names, text);
}

std::string options_text(const CommandOutline& command)
{
    std::string text;
    for (const bool positional : {true, false})
        for (const OptionOutline& option : command.options)
            if (option.is_positional == positional) text += option_text(option);
    return text;
}

std::string command_text(const CommandOutline& command)
{
    std::string usage = fmt::format("swivel {} [OPTION]...", command.name);
    for (const OptionOutline& option : command.options)
        if (option.is_positional) usage += " " + (option.is_required ? option.names[0] : "[" + option.names[0] + "]");
    std::string text = fmt::format(".SS \"{}\"\n{}.\n{}", roff(usage), roff(command.text), options_text(command));
    if (!command.footer.empty()) text += fmt::format(".PP\n{}\n", roff(command.footer));
    return text;
}

}  // namespace

std::string man_page(const Outline& outline)
{
    std::string text = fmt::format(".TH SWIVEL 1 \"\" \"swivel {}.{}.{}\" \"User Commands\"\n", SWIVEL_VERSION_MAJOR,
                                   SWIVEL_VERSION_MINOR, SWIVEL_VERSION_PATCH);
    text += ".ad l\n.SH NAME\nswivel \\- solve the arms and legs of crowds\n";
    text += ".SH SYNOPSIS\n.B swivel\n.I COMMAND\n.RI [ OPTION ]...\n";
    text += fmt::format(".SH DESCRIPTION\n{}\n", roff(outline.whole.text));
    text += ".SH OPTIONS\n" + options_text(outline.whole) + ".SH COMMANDS\n";
    for (const CommandOutline& command : outline.commands) text += command_text(command);
    return text + fmt::format(".SH NOTES\n{}\n", roff(outline.whole.footer));
}

}  // namespace swivel::tools
