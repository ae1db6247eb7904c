// Recognising which character of a set a pen wrote: for looking one up by drawing it, or noticing a wrong one.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <calligraphy/judge/pen_path.hpp>
#include <calligraphy/model/character_set.hpp>

namespace calligraphy {

class CharacterFeatures;

/// A character that somebody may have written.
struct RecognisedCharacter {
  char32_t code = 0;  ///< its Unicode code point
  /// How far it is from the writing: RMS distance between points at equal shares of their strokes, once both fill the
  /// same square [em].
  double distance = 0.0;
};

/// The characters of a set in all their forms (CharacterSet::forms()), prepared for comparison with a pen: 64 bytes per
/// stroke. Cheap to copy; any number of threads may use it.
class CharacterIndex {
 public:
  /// An index of every character of the set. @throws FormatError naming the file and the character if one is damaged
  explicit CharacterIndex(const CharacterSet& set);

  /// Number of characters.
  std::size_t size() const noexcept;

  /// At most `most` characters that the writing resembles, each once, the nearest first. They have as many strokes as
  /// there are pen-downs and are compared in the order of writing, stroke by stroke: joined or missing strokes, and
  /// another order or direction, are not recognised. Size, place and proportion do not matter. O(characters with as
  /// many strokes).
  /// @throws ValueError as match_strokes() for the paths
  std::vector<RecognisedCharacter> recognise(std::span<const PenPath> paths, std::size_t most = 10) const;

  /// What match_strokes() compares the writing with.
  const CharacterFeatures& features() const noexcept { return *features_; }

 private:
  std::shared_ptr<const CharacterFeatures> features_;
};

}  // namespace calligraphy
