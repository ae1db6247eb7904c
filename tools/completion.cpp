#include "completion.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace calligraphy::tools {
namespace {

enum class ValueKind { none, one_of, file, directory, other };

ValueKind kind_of(const ArgumentText& argument) {
  if (argument.value.empty()) return ValueKind::none;
  if (!argument.choices.empty()) return ValueKind::one_of;
  if (argument.value == "DIR") return ValueKind::directory;
  return argument.value == "FILE" || argument.value == "PATH" ? ValueKind::file : ValueKind::other;
}

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

// bash

std::string bash_values(const ArgumentText& argument) {
  switch (kind_of(argument)) {
    case ValueKind::one_of:
      return "COMPREPLY=($(compgen -W " + quoted(joined(argument.choices), "'\\''") + " -- \"$current\"))";
    case ValueKind::file:
      return "compopt -o default";
    case ValueKind::directory:
      return "compopt -o dirnames";
    default:
      return ":";
  }
}

/// The words that may stand there, options aside.
std::string bash_plain_words(const CommandText& command) {
  if (!command.commands.empty()) {
    std::vector<std::string> names;
    for (const CommandText& each : command.commands) names.push_back(own_name(each));
    return "COMPREPLY=($(compgen -W '" + joined(names) + "' -- \"$current\"))";
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
      if [[ $current == -* ]]; then COMPREPLY=($(compgen -W '{}' -- "$current")); else {}; fi ;;
)",
                         command.name, joined(options), bash_plain_words(command));
  });
  return R"(# Completion of calligraphy in bash. Made by `calligraphy completion bash`.
_calligraphy() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=calligraphy word
  COMPREPLY=()
  if [[ $current == = ]]; then
    current=
  elif [[ $previous == = && COMP_CWORD -gt 1 ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
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
  switch (kind_of(argument)) {
    case ValueKind::one_of:
      return "(" + joined(argument.choices) + ")";
    case ValueKind::file:
      return "_files";
    case ValueKind::directory:
      return "_directories";
    default:
      return " ";
  }
}

/// "'(-o --out)'{-o,--out}'[Directory for the results]:DIR:_directories'".
std::string zsh_option(const ArgumentText& option) {
  const bool has_synonym = option.names.size() > 1;
  std::string spec = "[" + zsh_escaped(summary(option.description)) + "]";
  if (!option.value.empty()) spec += ":" + option.value + ":" + zsh_values(option);
  const std::string names = has_synonym ? fmt::format("'({})'{{{}}}", joined(option.names), fmt::join(option.names, ","))
                                        : option.names.front();
  return names + quoted(spec, "'\\''");
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
  std::string text = "#compdef calligraphy\n# Completion of calligraphy in zsh. Made by `calligraphy completion zsh`.\n\n";
  for_each_command(program, [&text](const CommandText& command) { text += zsh_function(command); });
  // The same file serves as a function of fpath, which is called, and for `source`.
  return text +
         "if [[ $funcstack[1] == _calligraphy ]]; then\n  _calligraphy \"$@\"\nelse\n  compdef _calligraphy "
         "calligraphy\nfi\n";
}

// fish

std::string fish_quoted(const std::string& text) { return quoted(text, "\\'"); }

std::string fish_values(const ArgumentText& argument) {
  switch (kind_of(argument)) {
    case ValueKind::none:
      return "";
    case ValueKind::one_of:
      return " -x -a " + fish_quoted(joined(argument.choices));
    case ValueKind::file:
      return " -r -F";
    case ValueKind::directory:
      return " -x -a '(__fish_complete_directories)'";
    case ValueKind::other:
      return " -x";
  }
  return "";
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
      const ValueKind kind = kind_of(argument);
      if (kind != ValueKind::file && kind != ValueKind::one_of) continue;
      const std::string values = kind == ValueKind::file ? " -F" : " -a " + fish_quoted(joined(argument.choices));
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
  if (shell == "bash") return bash(program);
  return shell == "zsh" ? zsh(program) : fish(program);
}

}  // namespace calligraphy::tools
