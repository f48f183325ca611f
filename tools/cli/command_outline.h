// SPDX-License-Identifier: MIT
//
// What the command takes, as plain data: taken from the parser's own definitions, so that what is made of it (the man
// page, completions) knows every option and no parser.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace swivel::tools {

struct OptionOutline {
    std::vector<std::string> names;  // "-o", "--out"; a positional's own, "FILE"
    bool is_positional = false, is_required = false, repeats = false;
    std::string value;               // what it takes, "FILE" or "arms|legs"; empty: nothing
    std::vector<std::string> words;  // that it takes, where only these do
    std::string otherwise;           // the value without it; may be empty
    std::string text;                // what it is for

    bool takes_file() const { return value == "FILE"; }
};

struct CommandOutline {
    std::string name, text, footer;
    std::vector<OptionOutline> options;
};

struct Outline {
    CommandOutline whole;  // what comes without a subcommand
    std::vector<CommandOutline> commands;
};

Outline outline_of(const CLI::App& app);

}  // namespace swivel::tools
