#include <calligraphy/judge/character_index.hpp>

#include <algorithm>

#include "character_features.hpp"
#include "judge/pens/pen_paths.hpp"

namespace calligraphy {

CharacterIndex::CharacterIndex(const CharacterSet& set) : features_(std::make_shared<const CharacterFeatures>(set)) {}

std::size_t CharacterIndex::size() const noexcept { return features_->size(); }

std::vector<RecognisedCharacter> CharacterIndex::recognise(std::span<const PenPath> paths, std::size_t most) const {
  require_paths(paths);
  std::vector<Outline> outlines;
  for (const PenPath& path : paths) outlines.push_back(outline(path));
  std::vector<CharacterFeatures::Neighbour> found = features_->neighbours(character_feature(outlines));
  std::sort(found.begin(), found.end(),
            [](const auto& one, const auto& other) { return one.distance < other.distance; });
  std::vector<RecognisedCharacter> recognised;
  for (const CharacterFeatures::Neighbour& each : found) {
    if (recognised.size() == most) break;
    const auto is_same = [&each](const RecognisedCharacter& other) { return other.code == each.code; };
    if (std::any_of(recognised.begin(), recognised.end(), is_same)) continue;  // another form of it
    recognised.push_back({each.code, each.distance});
  }
  return recognised;
}

}  // namespace calligraphy
