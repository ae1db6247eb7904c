// Pens that follow strokes from tick to tick: every answer must be the nearest point of the whole stroke.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/model/character.hpp>

#include "tally.hpp"

namespace calligraphy_test {

/// Block after block of warm ticks; each follows from the seed and its number alone.
class TickFuzz {
 public:
  static constexpr std::uint64_t block_size = 20000;

  TickFuzz();

  /// The kinds of path.
  const std::vector<std::string>& families() const { return families_; }
  /// Asks the first `limit` ticks of a block. Safe in several threads.
  void run(std::uint64_t seed, std::uint64_t block, std::uint64_t limit, Tally& tally) const;

 private:
  std::vector<std::string> families_;
};

}  // namespace calligraphy_test
