// Queries to single curves, cold and warm, individually and in batches, with every result verified by proof.
#pragma once

#include <string>
#include <vector>

#include "tally.hpp"

namespace calligraphy_test {

/// Blocks of queries; each is determined by the seed and its number alone.
class QueryFuzz {
 public:
  static constexpr std::uint64_t block_size = 20000;

  QueryFuzz();

  /// The 19 workloads, then the families of curves of every degree, then the methods that are not exact.
  const std::vector<std::string>& families() const { return families_; }
  /// Runs the first `limit` queries of a block. Thread-safe.
  void run(std::uint64_t seed, std::uint64_t block, std::uint64_t limit, Tally& tally) const;

 private:
  std::vector<std::vector<Point>> real_curves_;
  std::vector<std::string> families_;
};

}  // namespace calligraphy_test
