// The doubtful strokes of many characters.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/importers/doubtful_strokes.hpp>

namespace calligraphy {

struct DoubtfulCharacter {
  char32_t code;
  std::string order;  ///< empty for the standard one
  std::vector<Doubt> doubts;
};

/// The characters with doubtful strokes, in the order given, from `threads` threads (0: one per core). `progress` hears
/// the share that is done, in the calling thread.
std::vector<DoubtfulCharacter> doubtful_characters(std::span<const Character> characters, int threads = 0,
                                                   const std::function<void(double)>& progress = {});

}  // namespace calligraphy
