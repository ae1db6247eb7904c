#include <calligraphy/importers/character_warnings.hpp>

#include "base/parallel.hpp"

namespace calligraphy {

std::vector<CharacterWarnings> character_warnings(std::span<const Character> characters, int threads,
                                                  const std::function<void(double)>& progress) {
  std::vector<std::vector<StrokeWarning>> warnings(characters.size());
  parallel_for(characters.size(), threads, progress,
               [&](std::size_t i) { warnings[i] = stroke_warnings(characters[i]); });
  std::vector<CharacterWarnings> found;
  for (std::size_t i = 0; i < characters.size(); ++i) {
    if (!warnings[i].empty()) found.push_back({characters[i].code, characters[i].order, std::move(warnings[i])});
  }
  return found;
}

}  // namespace calligraphy
