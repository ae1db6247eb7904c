#include "mistyped.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>

#include <fmt/format.h>

namespace calligraphy::tools {
namespace {

/// Characters inserted, left out, replaced, or exchanged with their neighbour (optimal string alignment).
std::size_t slips(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> distance(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        distance[i][j] = i + j;
        continue;
      }
      const std::size_t replaced = distance[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      distance[i][j] = std::min({distance[i - 1][j] + 1, distance[i][j - 1] + 1, replaced});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) distance[i][j] = std::min(distance[i][j], distance[i - 2][j - 2] + 1);
    }
  }
  return distance.back().back();
}

[[noreturn]] void refuse(const CommandText& command, const char* what, const std::string& word,
                         const std::vector<std::string>& candidates) {
  const std::string near = nearest_name(word, candidates);
  const std::string advice =
      near.empty() ? fmt::format("{} --help lists them", command.name) : fmt::format("did you mean {}?", near);
  throw UsageError(fmt::format("unknown {} {}; {}", what, word, advice));
}

std::vector<std::string> option_names(const CommandText& command) {
  std::vector<std::string> names;
  for (const ArgumentText& option : command.options) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

const ArgumentText* find_option(const CommandText& command, const std::string& name) {
  for (const ArgumentText& option : command.options) {
    if (std::find(option.names.begin(), option.names.end(), name) != option.names.end()) return &option;
  }
  return nullptr;
}

bool takes_many(const CommandText& command) {
  return !command.positional.empty() && command.positional.back().repeatable;
}

/// As opposed to "-", "-1" and "TEXT".
bool looks_like_option(std::string_view word) {
  return word.size() > 1 && word[0] == '-' && std::isdigit(static_cast<unsigned char>(word[1])) == 0;
}

/// The option at the beginning of `word`: all of it, "--NAME=VALUE", or "-NVALUE", which a long name with one dash is
/// not. @throws UsageError
const ArgumentText& option_of(const CommandText& command, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  const ArgumentText* option = find_option(command, name);
  const bool is_short = name[1] != '-' && find_option(command, "-" + name) == nullptr;
  if (option == nullptr && is_short) option = find_option(command, name.substr(0, 2));
  if (option == nullptr) refuse(command, "option", name, option_names(command));
  return *option;
}

}  // namespace

std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates) {
  constexpr std::size_t letters_per_slip = 3, most = 2;
  const std::size_t tolerated = std::min(most, word.size() / letters_per_slip);
  const auto far = [&word](const std::string& candidate) { return slips(word, candidate); };
  const auto nearest = std::min_element(candidates.begin(), candidates.end(),
                                        [&](const auto& a, const auto& b) { return far(a) < far(b); });
  if (nearest != candidates.end() && tolerated > 0 && far(*nearest) <= tolerated) return *nearest;
  const auto begins = [&word](const std::string& candidate) { return candidate.starts_with(word); };
  if (std::count_if(candidates.begin(), candidates.end(), begins) != 1) return "";
  return *std::find_if(candidates.begin(), candidates.end(), begins);
}

const CommandText& chosen_command(const CommandText& command, const std::string& name) {
  if (const CommandText* const found = find_command(command, name)) return *found;
  if (command.commands.empty()) {
    throw UsageError(fmt::format("unexpected argument {}: {} has no commands", name, command.name));
  }
  std::vector<std::string> names;
  for (const CommandText& each : command.commands) names.push_back(own_name(each));
  refuse(command, "command", name, names);
}

UsageError unexpected(const std::string& argument) {
  return UsageError(fmt::format("unexpected argument {}; quote words that belong together", argument));
}

void check_words(const CommandText& program, std::span<const char* const> words) {
  const CommandText* command = &program;
  std::set<const ArgumentText*> given;
  std::size_t plain_words = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string word = words[i];
    if (word == "--") {
      if (command->commands.empty()) return;
      throw UsageError(fmt::format("--: a command must come first; {} --help lists them", command->name));
    }
    if (!looks_like_option(word)) {
      if (!command->commands.empty()) {
        command = &chosen_command(*command, word);
      } else if (++plain_words > command->positional.size() && !takes_many(*command)) {
        throw unexpected(word);
      }
      continue;
    }
    const ArgumentText& option = option_of(*command, word);
    const bool has_its_own_word = std::find(option.names.begin(), option.names.end(), word) != option.names.end();
    if (option.value.empty()) {
      if (!has_its_own_word) throw UsageError(fmt::format("{}: it takes no value", word));
      if (option.names.back() == "--help" || option.names.back() == "--version") return;
      continue;
    }
    if (!given.insert(&option).second && !option.repeatable) throw UsageError(fmt::format("{}: given twice", word));
    if (!has_its_own_word) continue;
    if (i + 1 == words.size() || find_option(*command, words[i + 1]) != nullptr) {
      throw UsageError(fmt::format("{}: its value is missing: {}", word, signature(option)));
    }
    ++i;
  }
}

}  // namespace calligraphy::tools
