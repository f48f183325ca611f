// SPDX-License-Identifier: MIT
#include "tools/cli/completions.h"

#include <fmt/format.h>

#include <algorithm>

namespace swivel::tools {

namespace {

// The first clause of what an option is for: shells show one short line.
std::string short_text(const std::string& text)
{
    return text.substr(0, std::min({text.find(';'), text.find(": "), text.find(". ")}));
}

// Within single quotes of bash and zsh.
std::string quoted(const std::string& text)
{
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'')
            out += "'\\''";
        else
            out += c;
    }
    return out + "'";
}

std::vector<std::string> option_names(const CommandOutline& command)
{
    std::vector<std::string> names;
    for (const OptionOutline& option : command.options)
        if (!option.is_positional) names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

std::vector<std::string> command_names(const Outline& outline)
{
    std::vector<std::string> names;
    for (const CommandOutline& command : outline.commands) names.push_back(command.name);
    return names;
}

// What a positional or an option's value completes to, in bash.
std::string bash_value(const OptionOutline& option)
{
    if (option.takes_file()) return "compopt -o default";
    return option.words.empty() ? ":"
                                : fmt::format("words={}", quoted(fmt::format("{}", fmt::join(option.words, " "))));
}

std::string bash_command(const CommandOutline& command)
{
    std::string text = fmt::format("        {})\n            case $before in\n", command.name), first = ":";
    for (const OptionOutline& option : command.options) {
        if (option.is_positional)
            first = bash_value(option);
        else if (!option.value.empty())
            text += fmt::format("                {}) {} ;;\n", fmt::join(option.names, "|"), bash_value(option));
    }
    return text + fmt::format(
                      "                *) if [[ $word == -* ]]; then words={}; else {}; fi ;;\n"
                      "            esac ;;\n",
                      quoted(fmt::format("{}", fmt::join(option_names(command), " "))), first);
}

// In brackets or after a colon of an argument of _arguments.
std::string zsh_escaped(const std::string& text)
{
    std::string out;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

std::string zsh_value(const OptionOutline& option)
{
    const std::string what = zsh_escaped(option.words.empty() ? option.value : "word");
    if (option.takes_file()) return fmt::format(":{}:_files", what);
    return option.words.empty() ? fmt::format(":{}: ", what)
                                : fmt::format(":{}:({})", what, fmt::join(option.words, " "));
}

// One word of zsh for each name of an option: zsh joins these in braces itself.
std::string zsh_option(const OptionOutline& option)
{
    if (option.is_positional) return " \\\n            " + quoted("1" + zsh_value(option));
    std::string text;
    for (const std::string& name : option.names) {
        const std::string once = option.repeats ? "*" : fmt::format("({})", fmt::join(option.names, " "));
        const std::string value = option.value.empty() ? "" : zsh_value(option);
        text += " \\\n            " +
                quoted(fmt::format("{}{}[{}]{}", once, name, zsh_escaped(short_text(option.text)), value));
    }
    return text;
}

// Within single quotes of fish.
std::string fish_quoted(const std::string& text)
{
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') out += '\\';
        out += c;
    }
    return out + "'";
}

std::string fish_option(const std::string& condition, const OptionOutline& option)
{
    std::string text = fmt::format("complete -c swivel -n {}", fish_quoted(condition));
    for (const std::string& name : option.names) {
        if (option.is_positional) continue;
        const bool is_long = name.starts_with("--");
        text += (is_long ? " -l " : " -s ") + name.substr(is_long ? 2 : 1);
    }
    if (!option.is_positional && !option.value.empty()) text += option.takes_file() ? " -r" : " -x";
    if (option.takes_file()) text += " -F";
    if (!option.words.empty()) text += " -a " + fish_quoted(fmt::format("{}", fmt::join(option.words, " ")));
    return text + fmt::format(" -d {}\n", fish_quoted(short_text(option.text)));
}

}  // namespace

std::string bash_completion(const Outline& outline)
{
    std::string text =
        "# bash completion of swivel; made by: swivel completion bash\n"
        "_swivel() {\n"
        "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=''\n"
        "    if [[ $word == = ]]; then word=''; fi\n"
        "    if [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi\n"
        "    COMPREPLY=()\n"
        "    if ((COMP_CWORD == 1)); then\n"
        "        words=";
    std::vector<std::string> first = command_names(outline);
    for (const std::string& name : option_names(outline.whole)) first.push_back(name);
    text += quoted(fmt::format("{}", fmt::join(first, " "))) + "\n    else\n        case ${COMP_WORDS[1]} in\n";
    for (const CommandOutline& command : outline.commands) text += bash_command(command);
    return text +
           "        esac\n"
           "    fi\n"
           "    if [[ $words ]]; then mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\"); fi\n"
           "}\n"
           "complete -F _swivel swivel\n";
}

std::string zsh_completion(const Outline& outline)
{
    std::string text =
        "#compdef swivel\n"
        "# made by: swivel completion zsh\n"
        "_swivel() {\n"
        "    if (( CURRENT == 2 )); then\n"
        "        local -a commands=(";
    for (const CommandOutline& command : outline.commands)
        text += "\n            " + quoted(command.name + ":" + zsh_escaped(short_text(command.text)));
    text += ")\n        _describe -t commands command commands\n        _arguments";
    for (const OptionOutline& option : outline.whole.options) text += zsh_option(option);
    text += "\n        return\n    fi\n    shift words\n    (( CURRENT-- ))\n    case $words[1] in\n";
    for (const CommandOutline& command : outline.commands) {
        text += fmt::format("        {}) _arguments", command.name);
        for (const OptionOutline& option : command.options) text += zsh_option(option);
        text += " ;;\n";
    }
    return text + "    esac\n}\n_swivel \"$@\"\n";
}

std::string fish_completion(const Outline& outline)
{
    std::string text =
        "# fish completion of swivel; made by: swivel completion fish\n"
        "function __swivel_command\n"
        "    set -l words (commandline -opc)\n"
        "    test (count $words) -gt 1; and contains -- $words[2] $argv\n"
        "end\n"
        "complete -c swivel -f\n";
    const std::string none = fmt::format("not __swivel_command {}", fmt::join(command_names(outline), " "));
    for (const CommandOutline& command : outline.commands)
        text += fmt::format("complete -c swivel -n {} -a {} -d {}\n", fish_quoted(none), command.name,
                            fish_quoted(short_text(command.text)));
    for (const OptionOutline& option : outline.whole.options) text += fish_option(none, option);
    for (const CommandOutline& command : outline.commands)
        for (const OptionOutline& option : command.options)
            text += fish_option("__swivel_command " + command.name, option);
    return text;
}

}  // namespace swivel::tools
