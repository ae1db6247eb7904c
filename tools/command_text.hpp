// The commands and their options in words: the one description that help, manual page, completion and the messages about
// mistyped words are made from.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace calligraphy::tools {

/// An option or a positional argument.
struct ArgumentText {
  std::vector<std::string> names;    ///< "-o" and "--out"; of a positional argument "TEXT"
  std::string value;                 ///< what its value is, as in "DIR"; empty: a flag, which has none
  std::vector<std::string> choices;  ///< values that it may have
  bool has_other_values = true;      ///< than `choices`
  std::string description;
  std::string default_value;  ///< empty: none, or told in the description
  bool required = false;
  bool repeatable = false;
};

struct CommandText {
  std::string name;  ///< with those above it: "calligraphy devices probe"
  std::string description;
  std::vector<ArgumentText> positional;
  std::vector<ArgumentText> options;
  std::vector<std::string> examples;  ///< lines
  std::vector<CommandText> commands;
};

CommandText command_text(const CLI::App& command);

/// The first sentence, without its full stop: what a list has room for.
std::string summary(const std::string& description);

/// The last word of its name.
std::string own_name(const CommandText& command);

/// The command of this own name; null if there is none.
const CommandText* find_command(const CommandText& command, const std::string& name);

/// "--mode both|vision|force", "-o, --out DIR", "TEXT".
std::string signature(const ArgumentText& argument);

/// "calligraphy write [OPTIONS] TEXT --out DIR".
std::string usage(const CommandText& command);

}  // namespace calligraphy::tools
