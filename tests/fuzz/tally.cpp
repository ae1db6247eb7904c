#include "tally.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

namespace calligraphy_test {

void Times::add(double nanoseconds, std::uint64_t calls) {
  const double octaves = std::log2(std::max(nanoseconds / static_cast<double>(calls), 1.0));
  const auto step = static_cast<std::size_t>(octaves * steps_per_octave);
  counts_[std::min(step, counts_.size() - 1)] += calls;
}

void Times::add(const Times& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
}

double Times::median() const {
  const std::uint64_t all = std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    below += counts_[i];
    if (2 * below > all) return std::exp2((static_cast<double>(i) + 0.5) / steps_per_octave);
  }
  return 0.0;
}

void Count::add(const Count& other) {
  answers += other.answers;
  wrong_branches += other.wrong_branches;
  above_allowance += other.above_allowance;
  inconsistent += other.inconsistent;
  uncertified += other.uncertified;
  not_finite += other.not_finite;
  different += other.different;
  worst_error = std::max(worst_error, other.worst_error);
  proven_error = std::max(proven_error, other.proven_error);
  worst_share = std::max(worst_share, other.worst_share);
  times.add(other.times);
}

bool Tally::judge(std::size_t family, const Verdict& verdict, bool finite, bool certified) {
  Count& count = counts_[family];
  ++count.answers;
  if (!finite) {
    ++count.not_finite;
    return true;
  }
  if (verdict.plain) {
    count.worst_error = std::max(count.worst_error, verdict.surely);
    count.proven_error = std::max(count.proven_error, verdict.error);
  }
  count.worst_share = std::max(count.worst_share, verdict.share);
  count.uncertified += !certified;
  if (verdict.right) return !certified;
  ++(verdict.wrong_branch ? count.wrong_branches : verdict.consistent ? count.above_allowance : count.inconsistent);
  return true;
}

void Tally::add(const Tally& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i].add(other.counts_[i]);
  failures_.insert(failures_.end(), other.failures_.begin(), other.failures_.end());
}

Count Tally::total() const {
  Count sum;
  for (const Count& count : counts_) sum.add(count);
  return sum;
}

std::vector<Failure> Tally::failures() const {
  std::vector<Failure> all = failures_, first;
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return std::tie(a.block, a.index) < std::tie(b.block, b.index); });
  std::vector<int> shown(counts_.size());
  for (const Failure& failure : all) {
    if (first.size() < shown_failures && shown[failure.family]++ < shown_failures_per_family) first.push_back(failure);
  }
  return first;
}

std::string exact_text(double value) { return fmt::format("{:a}", value); }

std::string exact_text(std::span<const Point> points) {
  std::string text;
  for (const Point& point : points) {
    text += fmt::format("{}({:a},{:a})", text.empty() ? "" : " ", point.x(), point.y());
  }
  return text;
}

}  // namespace calligraphy_test
