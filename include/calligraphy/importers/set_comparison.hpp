// What two collections of characters write differently.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_set.hpp>

namespace calligraphy {

/// What differs about a character.
enum class SetDifferenceKind {
  character,  ///< it has the strokes of another character of the other collection
  count,      ///< its number of strokes
  order,      ///< the order of its strokes
  direction   ///< the direction of a stroke
};

/// "character", "count", "order", "direction".
const char* to_string(SetDifferenceKind kind) noexcept;

/// A character that another collection writes differently.
struct SetDifference {
  char32_t code;           ///< Unicode code point
  std::string order;       ///< name of the stroke order; empty for the standard one
  SetDifferenceKind kind;  ///< what differs
  std::string what;        ///< a description, in which strokes have the numbers that they have here, from 1
};

/// Result of compare_sets().
struct SetComparison {
  int compared = 0;                        ///< characters, in each of their orders, that both have
  std::vector<SetDifference> differences;  ///< in the order of the list
};

/// Compares how the characters of a list and those of another collection are written: stroke by stroke, as if somebody had
/// written the one where the other is asked for. Of the forms and orders of the other collection, the nearest counts.
/// Position, size and the shapes of strokes may differ. From `threads` threads (0: one per core); `progress` is called
/// with the fraction done, in the calling thread.
/// @throws FormatError naming the file and the damage if the other collection is damaged
SetComparison compare_sets(const CharacterList& list, const CharacterSet& other, int threads = 0,
                           const std::function<void(double)>& progress = {});

}  // namespace calligraphy
