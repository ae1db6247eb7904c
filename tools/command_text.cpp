#include "command_text.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

namespace calligraphy::tools {
namespace {

std::string full_name(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  return parent == nullptr ? command.get_name() : full_name(*parent) + " " + command.get_name();
}

/// CLI11 writes the values of an option as "TEXT:{both,vision,force}", and its range as "N:NUMBER". For such_as() the
/// list ends with "...".
void describe_value(const CLI::Option& option, ArgumentText& text) {
  if (option.get_type_size() == 0) return;
  const std::string type = option.get_type_name();
  text.value = type.substr(0, type.find(':'));
  const std::size_t begin = type.find(":{"), end = type.find('}', begin == std::string::npos ? 0 : begin);
  if (begin == std::string::npos || end == std::string::npos) return;
  std::istringstream list(type.substr(begin + 2, end - begin - 2));
  text.has_other_values = false;
  for (std::string choice; std::getline(list, choice, ',');) {
    if (choice == "...") {
      text.has_other_values = true;
    } else {
      text.choices.push_back(choice);
    }
  }
}

ArgumentText argument_text(const CLI::Option& option) {
  ArgumentText text;
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  if (text.names.empty()) text.names.push_back(option.get_name());
  describe_value(option, text);
  text.description = option.get_description();
  text.default_value = option.get_default_str();
  text.required = option.get_required();
  text.repeatable = option.get_items_expected_max() > 1;
  return text;
}

}  // namespace

CommandText command_text(const CLI::App& command) {
  CommandText text;
  text.name = full_name(command);
  text.description = command.get_description();
  for (const CLI::Option* const option : command.get_options()) {
    (option->get_positional() ? text.positional : text.options).push_back(argument_text(*option));
  }
  std::istringstream examples(command.get_footer());
  for (std::string line; std::getline(examples, line);) text.examples.push_back(line);
  for (const CLI::App* const each : command.get_subcommands(nullptr)) text.commands.push_back(command_text(*each));
  return text;
}

std::string summary(const std::string& description) {
  std::string text = description.substr(0, description.find(". "));
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string own_name(const CommandText& command) { return command.name.substr(command.name.rfind(' ') + 1); }

const CommandText* find_command(const CommandText& command, const std::string& name) {
  const auto found = std::find_if(command.commands.begin(), command.commands.end(),
                                  [&name](const CommandText& each) { return own_name(each) == name; });
  return found == command.commands.end() ? nullptr : &*found;
}

std::string signature(const ArgumentText& argument) {
  std::string text = fmt::format("{}", fmt::join(argument.names, ", "));
  if (text.front() != '-' || argument.value.empty()) return text;
  const std::string choices = fmt::format("{}", fmt::join(argument.choices, "|"));
  constexpr std::size_t short_enough = 30;
  return text + " " + (argument.has_other_values || choices.size() > short_enough ? argument.value : choices);
}

std::string usage(const CommandText& command) {
  std::string text = command.name + (command.commands.empty() ? "" : " [COMMAND]") + " [OPTIONS]";
  for (const ArgumentText& argument : command.positional) {
    text += fmt::format(fmt::runtime(argument.required ? " {}" : " [{}]"), argument.names.front());
  }
  for (const ArgumentText& option : command.options) {
    if (option.required) text += " " + option.names.back() + " " + option.value;
  }
  return text;
}

}  // namespace calligraphy::tools
