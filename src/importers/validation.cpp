#include <calligraphy/importers/validation.hpp>

#include "base/parallel.hpp"

namespace calligraphy {

std::vector<DoubtfulCharacter> doubtful_characters(std::span<const Character> characters, int threads,
                                                   const std::function<void(double)>& progress) {
  std::vector<std::vector<Doubt>> doubts(characters.size());
  parallel_for(characters.size(), threads, progress,
               [&](std::size_t i) { doubts[i] = doubtful_strokes(characters[i]); });
  std::vector<DoubtfulCharacter> found;
  for (std::size_t i = 0; i < characters.size(); ++i) {
    if (!doubts[i].empty()) found.push_back({characters[i].code, characters[i].order, std::move(doubts[i])});
  }
  return found;
}

}  // namespace calligraphy
