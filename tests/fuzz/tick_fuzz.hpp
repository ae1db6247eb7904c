// Pens that follow strokes from tick to tick: every result must be the nearest point of the whole stroke.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/model/character.hpp>

#include "tally.hpp"

namespace calligraphy_test {

/// Blocks of warm ticks; each is determined by the seed and its number alone.
class TickFuzz {
 public:
  static constexpr std::uint64_t block_size = 20000;

  TickFuzz();

  /// The kinds of path.
  const std::vector<std::string>& families() const { return families_; }
  /// Runs the first `limit` ticks of a block. Thread-safe.
  void run(std::uint64_t seed, std::uint64_t block, std::uint64_t limit, Tally& tally) const;

 private:
  std::vector<std::string> families_;
};

}  // namespace calligraphy_test
