// calligraphy help and calligraphy completion: the commands in words, for people and for shells.
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "command_text.hpp"
#include "commands.hpp"
#include "completion.hpp"
#include "help_page.hpp"
#include "man_page.hpp"
#include "mistyped.hpp"
#include "output_file.hpp"

namespace calligraphy::tools {
namespace {

struct HelpArguments {
  std::vector<std::string> command;
  bool man = false;
  std::string out = standard_output;
};

struct CompletionArguments {
  std::string shell;
  std::string out = standard_output;
};

std::string help(const CLI::App& program, const HelpArguments& options) {
  const CommandText all = command_text(program);
  if (options.man) {
    if (!options.command.empty()) throw UsageError("--man: the manual page is of all commands");
    return man_page(all, CALLIGRAPHY_VERSION);
  }
  const CommandText* chosen = &all;
  for (const std::string& name : options.command) chosen = &chosen_command(*chosen, name);
  return help_page(*chosen, help_width());
}

}  // namespace

void add_help(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("help", "Describe a command, or print the manual page.");
  command->footer("calligraphy help write\ncalligraphy help --man | man -l -");
  const auto options = std::make_shared<HelpArguments>();
  command->add_option("COMMAND", options->command, "Command to describe, as in `devices probe` (default: all)");
  command->add_flag("--man", options->man, "Print the manual page, in the format of man(1)")->disable_flag_override();
  add_out_file(*command, options->out);
  command->callback([options, &program] { write_output(options->out, help(program, *options)); });
}

void add_completion(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("completion",
                             "Print a script that completes commands, options and values in a shell. Packages install "
                             "it; otherwise add the line below to ~/.bashrc, ~/.zshrc or ~/.config/fish/config.fish.");
  command->footer(
      "source <(calligraphy completion bash)     # in ~/.bashrc\n"
      "source <(calligraphy completion zsh)      # in ~/.zshrc, after compinit\n"
      "calligraphy completion fish | source      # in ~/.config/fish/config.fish");
  const auto options = std::make_shared<CompletionArguments>();
  command->add_option("SHELL", options->shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(shells.begin(), shells.end())));
  add_out_file(*command, options->out);
  command->callback(
      [options, &program] { write_output(options->out, completion(command_text(program), options->shell)); });
}

}  // namespace calligraphy::tools
