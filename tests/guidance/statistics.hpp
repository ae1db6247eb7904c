// What the judges print of many figures.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace calligraphy_test {

/// A count out of a count.
struct Share {
  int count = 0, of = 0;

  void add(bool counted) {
    ++of;
    count += counted;
  }
  void add(const Share& other) {
    count += other.count;
    of += other.of;
  }
  double percent() const { return of > 0 ? 100.0 * count / of : 0.0; }
};

/// The value below which `share` of the values lie; 0 if there is none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto i = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + i, values.end());
  return values[static_cast<std::size_t>(i)];
}

/// A mean of values of which those of one cluster are not independent.
class ClusteredMean {
 public:
  void add(std::uint64_t cluster, double value) {
    Cluster& of = clusters_[cluster];
    of.sum += value;
    ++of.count;
    sum_ += value;
    ++count_;
  }
  double mean() const { return count_ > 0 ? sum_ / count_ : 0.0; }
  /// Half width of the 95 % interval, by the spread between clusters; the normal quantile, so for twenty or more.
  double half_width() const {
    const double clusters = static_cast<double>(clusters_.size());
    if (clusters < 2.0) return std::nan("");
    double square = 0.0;
    for (const auto& [key, of] : clusters_) square += std::pow(of.sum - of.count * mean(), 2);
    return 1.96 * std::sqrt(square * clusters / (clusters - 1.0)) / count_;
  }

 private:
  struct Cluster {
    double sum = 0.0;
    int count = 0;
  };
  std::map<std::uint64_t, Cluster> clusters_;
  double sum_ = 0.0;
  int count_ = 0;
};

}  // namespace calligraphy_test
