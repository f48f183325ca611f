// SPDX-License-Identifier: MIT
#include "tools/cli/command_help.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "tools/cli/command_error.h"
#include "tools/cli/option_checks.h"
#include "tools/cli/streams.h"
#include "tools/formats/suggestion.h"

namespace swivel::tools {

namespace {

std::vector<std::string> command_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
}

// The innermost subcommand that is given; the command itself where none is.
const CLI::App& used_command(const CLI::App& app)
{
    const std::vector<CLI::App*> used = app.get_subcommands();
    return used.empty() ? app : used_command(*used.front());
}

// A command's name after the names of those above it: "swivel rig".
std::string words_of(const CLI::App& command)
{
    return command.get_parent() ? words_of(*command.get_parent()) + " " + command.get_name() : command.get_name();
}

std::string help_of(const CLI::App& command) { return fmt::format("see {} --help", words_of(command)); }

// The option meant by a wrong one, dashes left out of the count.
std::string meant_by(const std::string& wrong, const CLI::App& command)
{
    std::vector<std::string> known;
    for (const CLI::Option* option : command.get_options())
        known.insert(known.end(), option->get_lnames().begin(), option->get_lnames().end());
    const std::string bare = wrong.substr(std::min(wrong.find_first_not_of('-'), wrong.size()));
    const auto nearest = formats::nearest_word(bare, known);
    return nearest ? fmt::format("did you mean --{}?", *nearest) : help_of(command);
}

// An option that was given more often than it may be, as one word of the command line; empty: there is none.
std::string repeated_option(const CLI::App& command)
{
    for (const CLI::Option* option : command.get_options())
        if (option->get_expected_max() == 1 && option->count() > 1) return option->get_name();
    return {};
}

std::string no_command(const std::string& wrong, const std::vector<std::string>& known)
{
    return fmt::format("there is no command '{}'; {}", wrong, formats::suggestion(wrong, known));
}

// What is wrong with words that nobody takes; empty: there is none.
std::string unknown_words(const CLI::App& app)
{
    const CLI::App& used = used_command(app);
    for (const CLI::App* command = &used; command; command = command->get_parent()) {
        const std::vector<std::string> words = command->remaining(), commands = command_names(*command);
        if (command == &used && !commands.empty() && !words.empty() && !words[0].starts_with('-'))
            return no_command(words[0], commands);
        const auto option = std::ranges::find_if(words, [](const auto& word) { return word.starts_with('-'); });
        if (option != words.end()) {
            const std::string bare = option->substr(0, option->find('='));
            return fmt::format("there is no option {}; {}", bare, meant_by(bare, *command));
        }
        if (!words.empty()) return fmt::format("'{}' is one word too many; {}", words[0], help_of(used));
    }
    return {};
}

}  // namespace

void add_help(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("help", "Print help on the whole or on a command, as COMMAND --help does");
    auto names = std::make_shared<std::array<std::string, 2>>();
    takes(command->add_option("COMMAND", (*names)[0], "On which command"), one_of(command_names(app)))
        ->option_text(" ");
    command->add_option("PART", (*names)[1], "On which command of lab")->option_text(" ");
    command->callback([&app, names] {
        if ((*names)[0].empty()) {
            say_text(stdout, app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal));
            return;
        }
        const CLI::App* about = app.get_subcommand((*names)[0]);
        if (const std::string& part = (*names)[1]; !part.empty()) {
            const std::vector<std::string> parts = command_names(*about);
            if (parts.empty())
                throw CommandError(2, fmt::format("'{}' is one word too many; {}", part, help_of(*about)));
            if (std::ranges::find(parts, part) == parts.end()) throw CommandError(2, no_command(part, parts));
            about = about->get_subcommand(part);
        }
        say_text(stdout, about->help(words_of(*about->get_parent())));
    });
}

std::string cause_of(const CLI::App& app, const CLI::ParseError& error)
{
    if (const std::string unknown = unknown_words(app); !unknown.empty()) return unknown;
    if (const std::string repeated = repeated_option(used_command(app)); !repeated.empty())
        return fmt::format("{} is given twice; give it once", repeated);
    const std::string cause = error.what();
    return cause.ends_with('?') ? cause : fmt::format("{}; {}", cause, help_of(used_command(app)));
}

}  // namespace swivel::tools
