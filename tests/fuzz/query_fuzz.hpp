// Queries to single curves, cold and warm, one by one and in batches, each answer judged by proof.
#pragma once

#include <string>
#include <vector>

#include "tally.hpp"

namespace calligraphy_test {

/// Block after block of queries; each follows from the seed and its number alone.
class QueryFuzz {
 public:
  static constexpr std::uint64_t block_size = 20000;

  QueryFuzz();

  /// The 19 workloads, then the families of curves of every degree, then the methods that are not exact.
  const std::vector<std::string>& families() const { return families_; }
  /// Asks the first `limit` queries of a block. Safe in several threads.
  void run(std::uint64_t seed, std::uint64_t block, std::uint64_t limit, Tally& tally) const;

 private:
  std::vector<std::vector<Point>> real_curves_;
  std::vector<std::string> families_;
};

}  // namespace calligraphy_test
