// Stroke warnings for many characters.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/importers/stroke_warnings.hpp>

namespace calligraphy {

struct CharacterWarnings {
  char32_t code;
  std::string order;  ///< empty for the standard one
  std::vector<StrokeWarning> warnings;
};

/// The characters that have stroke warnings, in the given order, computed by `threads` threads (0: one per core).
/// `progress` receives the fraction done, in the calling thread.
std::vector<CharacterWarnings> character_warnings(std::span<const Character> characters, int threads = 0,
                                                  const std::function<void(double)>& progress = {});

}  // namespace calligraphy
