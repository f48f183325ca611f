// SPDX-License-Identifier: MIT
#include "tools/cli/command_outline.h"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace swivel::tools {

namespace {

std::vector<std::string> words_of(const std::string& value)
{
    if (value.find('|') == std::string::npos) return {};
    return CLI::detail::split(value, '|');
}

OptionOutline outline_of(const CLI::Option& option)
{
    OptionOutline outline;
    outline.is_positional = option.get_positional();
    if (outline.is_positional) outline.names.push_back(option.get_name(true));
    for (const std::string& name : option.get_snames()) outline.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) outline.names.push_back("--" + name);
    outline.is_required = option.get_required();
    outline.repeats = option.get_expected_max() == CLI::detail::expected_max_vector_size;
    if (option.get_expected_max() > 0) outline.value = option.get_type_name();
    outline.words = words_of(outline.value);
    outline.otherwise = option.get_default_str();
    outline.text = option.get_description();
    std::replace(outline.text.begin(), outline.text.end(), '\n', ' ');
    return outline;
}

CommandOutline outline_of_command(const CLI::App& command)
{
    const CLI::App* const whole = command.get_parent();  // whose footer others inherit
    const bool has_own_footer = !whole || command.get_footer() != whole->get_footer();
    CommandOutline outline{
        command.get_name(), command.get_description(), has_own_footer ? command.get_footer() : "", {}};
    for (const CLI::Option* option : command.get_options()) outline.options.push_back(outline_of(*option));
    return outline;
}

}  // namespace

Outline outline_of(const CLI::App& app)
{
    Outline outline{outline_of_command(app), {}};
    for (const CLI::App* command : app.get_subcommands({})) outline.commands.push_back(outline_of_command(*command));
    return outline;
}

}  // namespace swivel::tools
