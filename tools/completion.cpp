#include "completion.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace calligraphy::tools {
namespace {

bool may_be_file(const ArgumentText& argument) {
  return argument.value.ends_with("FILE") || argument.value == "PATH";  // also "NAME|FILE"
}

bool is_directory(const ArgumentText& argument) { return argument.value == "DIR"; }

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

/// With the single quotes of a shell, where `escape` stands for one.
std::string quoted(const std::string& text, const char* escape) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? escape : std::string(1, c);
  return result + "'";
}

/// "calligraphy_devices_probe": a name for a shell's function.
std::string identifier(const CommandText& command) {
  std::string name = command.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

/// Calls `each` with the command and all below it.
template <class Each>
void for_each_command(const CommandText& command, const Each& each) {
  each(command);
  for (const CommandText& below : command.commands) for_each_command(below, each);
}

/// A command that `help` describes, as one below `help`.
CommandText described(const CommandText& help, const CommandText& command) {
  CommandText words = help;
  words.name += " " + own_name(command);
  words.description = command.description;
  words.positional.clear();
  words.commands.clear();
  for (const CommandText& below : command.commands) words.commands.push_back(described(words, below));
  return words;
}

/// The program, in which a command whose argument names commands has them below it.
CommandText with_commands_as_words(const CommandText& program) {
  CommandText result = program;
  for (CommandText& command : result.commands) {
    if (command.positional.empty() || command.positional.front().names.front() != "COMMAND") continue;
    const CommandText alone = command;
    for (const CommandText& each : program.commands) command.commands.push_back(described(alone, each));
  }
  return result;
}

// bash

std::string bash_words(const std::vector<std::string>& words) {
  return "_calligraphy_offer -W " + quoted(joined(words), "'\\''");
}

std::string bash_values(const ArgumentText& argument) {
  if (is_directory(argument)) return "compopt -o dirnames";
  if (argument.choices.empty()) return may_be_file(argument) ? "compopt -o default" : ":";
  return bash_words(argument.choices) + (may_be_file(argument) ? "; compopt -o filenames; _calligraphy_offer -f" : "");
}

/// The words that may stand there, options aside.
std::string bash_plain_words(const CommandText& command) {
  if (!command.commands.empty()) {
    std::vector<std::string> names;
    for (const CommandText& each : command.commands) names.push_back(own_name(each));
    return bash_words(names);
  }
  return command.positional.empty() ? ":" : bash_values(command.positional.front());
}

std::string bash(const CommandText& program) {
  std::string commands, values, words;
  for_each_command(program, [&](const CommandText& command) {
    std::vector<std::string> options;
    for (const ArgumentText& option : command.options) {
      options.insert(options.end(), option.names.begin(), option.names.end());
      if (option.value.empty()) continue;
      for (const std::string& name : option.names) {
        values += fmt::format("{}'{} {}'", name == option.names.front() ? "    " : " | ", command.name, name);
      }
      values += ") " + bash_values(option) + "; return ;;\n";
    }
    for (const CommandText& below : command.commands) {
      commands += (commands.empty() ? "'" : " | '") + below.name + "'";
    }
    words += fmt::format(R"(    '{}')
      if [[ $current == -* ]]; then {}; else {}; fi ;;
)",
                         command.name, bash_words(options), bash_plain_words(command));
  });
  return R"(# Completion of calligraphy in bash. Made by `calligraphy completion bash`.
# Offers what compgen makes of its arguments. Bash completes only what is after the last colon.
_calligraphy_offer() {
  local word
  while IFS= read -r word; do COMPREPLY+=("${word#"$before"}"); done < <(compgen "$@" -- "$current")
}
_calligraphy() {
  local at=$COMP_CWORD current=${COMP_WORDS[COMP_CWORD]} before= previous command=calligraphy word
  COMPREPLY=()
  while [[ at -gt 1 && ( $current == :* || ${COMP_WORDS[at - 1]} == : ) ]]; do
    before=${COMP_WORDS[--at]}$before
    current=${COMP_WORDS[at]}$current
  done
  if [[ $current == *: ]]; then before=$current; fi
  previous=${COMP_WORDS[at - 1]}
  if [[ $current == = ]]; then
    current=
  elif [[ $previous == = && at -gt 1 ]]; then
    previous=${COMP_WORDS[at - 2]}
  fi
  for word in "${COMP_WORDS[@]:1:COMP_CWORD - 1}"; do
    case "$command $word" in
      )" + commands + R"() command="$command $word" ;;
    esac
  done
  case "$command $previous" in
)" + values + R"(  esac
  case "$command" in
)" + words + R"(  esac
}
complete -F _calligraphy calligraphy
)";
}

// zsh

std::string zsh_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_values(const ArgumentText& argument) {
  if (is_directory(argument)) return "_directories";
  if (argument.choices.empty()) return may_be_file(argument) ? "_files" : " ";
  // The space keeps _arguments from adding arguments of its own.
  return " _calligraphy_values " + zsh_escaped(joined(argument.choices)) + (may_be_file(argument) ? " FILE" : "");
}

/// "'(-o --out)'{-o+,--out=}'[Directory for the results]:DIR:_directories'": a value may be in the same word.
std::string zsh_option(const ArgumentText& option) {
  std::vector<std::string> names = option.names;
  if (!option.value.empty()) {
    for (std::string& name : names) name += name.starts_with("--") ? "=" : "+";
  }
  std::string spec = "[" + zsh_escaped(summary(option.description)) + "]";
  if (!option.value.empty()) spec += ":" + option.value + ":" + zsh_values(option);
  const bool is_alone = names.size() == 1;
  return (is_alone ? names.front() : fmt::format("'({})'{{{}}}", joined(option.names), fmt::join(names, ","))) +
         quoted(spec, "'\\''");
}

std::string zsh_function(const CommandText& command) {
  std::string arguments;
  for (const ArgumentText& option : command.options) arguments += " \\\n    " + zsh_option(option);
  if (command.commands.empty()) {
    for (const ArgumentText& each : command.positional) {
      arguments += " \\\n    " + quoted(":" + each.names.front() + ":" + zsh_values(each), "'\\''");
    }
    return fmt::format("_{}() {{\n  _arguments{}\n}}\n\n", identifier(command), arguments);
  }
  std::string names, calls;
  for (const CommandText& each : command.commands) {
    names += "\n        " + quoted(own_name(each) + ":" + zsh_escaped(summary(each.description)), "'\\''");
    calls += fmt::format("        {}) _{} ;;\n", own_name(each), identifier(each));
  }
  return fmt::format(R"(_{0}() {{
  local context state state_descr line
  local -a commands
  typeset -A opt_args
  _arguments -C{1} \
    '1: :->command' \
    '*::argument:->arguments'
  case $state in
    command)
      commands=({2})
      _describe command commands ;;
    arguments)
      case $line[1] in
{3}      esac ;;
  esac
}}

)",
                     identifier(command), arguments, names, calls);
}

std::string zsh(const CommandText& program) {
  std::string text = R"(#compdef calligraphy
# Completion of calligraphy in zsh. Made by `calligraphy completion zsh`.

# Offers words, and for FILE file names.
_calligraphy_values() {
  local failed=1
  compadd -- ${@:#FILE} && failed=0
  (( $@[(Ie)FILE] )) && _files && failed=0
  return failed
}

)";
  for_each_command(program, [&text](const CommandText& command) { text += zsh_function(command); });
  // The same file serves as a function of fpath, which is called, and for `source`.
  return text +
         "if [[ $funcstack[1] == _calligraphy ]]; then\n  _calligraphy \"$@\"\nelse\n  compdef _calligraphy "
         "calligraphy\nfi\n";
}

// fish

std::string fish_quoted(const std::string& text) { return quoted(text, "\\'"); }

/// The choices, each with an empty description: otherwise fish would repeat that of the option.
std::string fish_words(const ArgumentText& argument) {
  std::string text;
  for (const std::string& word : argument.choices) text += (text.empty() ? "" : " ") + word + "\\t";
  return text;
}

std::string fish_values(const ArgumentText& argument) {
  if (argument.value.empty()) return "";
  if (is_directory(argument)) return " -x -a '(__fish_complete_directories)'";
  const std::string files = may_be_file(argument) ? " -r -F" : " -x";
  return files + (argument.choices.empty() ? "" : " -a " + fish_quoted(fish_words(argument)));
}

std::string fish(const CommandText& program) {
  std::string commands, text;
  for_each_command(program, [&](const CommandText& command) {
    for (const CommandText& below : command.commands) {
      commands += " '" + below.name + "'";
      text += fmt::format("complete -c calligraphy -n \"__calligraphy_at '{}'\" -a {} -d {}\n", command.name,
                          own_name(below), fish_quoted(summary(below.description)));
    }
    for (const ArgumentText& option : command.options) {
      text += fmt::format("complete -c calligraphy -n \"__calligraphy_at '{}'\"", command.name);
      for (const std::string& name : option.names) {
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      text += fish_values(option) + " -d " + fish_quoted(summary(option.description)) + "\n";
    }
    for (const ArgumentText& argument : command.positional) {
      std::string values = may_be_file(argument) ? " -F" : "";
      if (!argument.choices.empty()) values += " -a " + fish_quoted(fish_words(argument));
      if (values.empty()) continue;
      text += fmt::format("complete -c calligraphy -n \"__calligraphy_at '{}'\"{}\n", command.name, values);
    }
  });
  return R"(# Completion of calligraphy in fish. Made by `calligraphy completion fish`.
# Whether the words before the cursor name this command.
function __calligraphy_at
    set -l at calligraphy
    for word in (commandline -opc)[2..-1]
        if contains -- "$at $word")" +
         commands + R"(
            set at "$at $word"
        end
    end
    test "$at" = "$argv[1]"
end
complete -c calligraphy -f
)" + text;
}

}  // namespace

std::string completion(const CommandText& program, const std::string& shell) {
  const CommandText commands = with_commands_as_words(program);
  if (shell == "bash") return bash(commands);
  return shell == "zsh" ? zsh(commands) : fish(commands);
}

}  // namespace calligraphy::tools
