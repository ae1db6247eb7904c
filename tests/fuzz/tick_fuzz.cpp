#include "tick_fuzz.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include <calligraphy/collision/stroke_tracker.hpp>

#include "hostile_strokes.hpp"

namespace calligraphy_test {
namespace {

using calligraphy::StrokeElement;

using calligraphy::StrokePoint;
using calligraphy::StrokeTracker;

/// The oracle for a stroke.
class StrokeOracle {
 public:
  explicit StrokeOracle(const std::vector<std::vector<Point>>& elements) {
    for (const auto& element : elements) {
      oracles_.emplace_back(element);
      size_ = std::max(size_, oracles_.back().size());
    }
  }

  Verdict judge(const StrokePoint& answer, const Point& query) const {
    const auto which = static_cast<std::size_t>(answer.element);
    const NearestPointOracle& its = oracles_[which];
    oracle::Bounds bounds = its.nearest(query, answer.closest.parameter);
    for (std::size_t i = 0; i < oracles_.size(); ++i) {
      if (i == which || oracles_[i].box_distance(query) >= answer.closest.distance) continue;
      const oracle::Bounds others = oracles_[i].nearest_within(query, bounds.least);
      bounds.least = std::min(bounds.least, others.least);
      bounds.found = std::min(bounds.found, others.found);
    }
    return its.judge(answer.closest, query, bounds, {}, size_);
  }

  int count() const { return static_cast<int>(oracles_.size()); }

 private:
  std::vector<NearestPointOracle> oracles_;
  double size_ = 0.0;
};

bool is_usable(const NearestPoint& answer) {
  return std::isfinite(answer.parameter) && answer.point.allFinite() && answer.tangent.allFinite();
}

bool is_lost(const Point& query) { return !query.allFinite() || query.cwiseAbs().maxCoeff() > 1e150; }

class PathRun {
 public:
  PathRun(std::size_t family, const PenPath& path, Tally& tally)
      : family_(family), path_(path), tally_(tally), oracle_(path.elements) {
    for (const auto& element : path.elements) elements_.push_back(calligraphy::prepare_element(element));
  }

  void run() {
    std::vector<StrokePoint> answers;
    answers.reserve(path_.ticks.size());
    StrokeTracker tracker(elements_);
    const auto start = std::chrono::steady_clock::now();
    for (const Point& tick : path_.ticks) answers.push_back(tracker.update(tick));
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    tally_[family_].times.add(taken.count(), answers.size());
    for (std::size_t i = 0; i < answers.size(); ++i) judge(answers[i], i);
  }

 private:
  void judge(const StrokePoint& answer, std::size_t tick) {
    const Point& query = path_.ticks[tick];
    if (answer.element < 0 || answer.element >= oracle_.count() || !is_usable(answer.closest)) {
      ++tally_[family_].answers;
      ++tally_[family_].not_finite;
      return report(answer, tick, "not finite, or no element");
    }
    if (is_lost(query)) {
      ++tally_[family_].answers;
      if (std::isinf(answer.closest.distance) && !answer.closest.certified()) return;
      if (elements_[static_cast<std::size_t>(answer.element)].length() == 0.0) return;
      ++tally_[family_].inconsistent;
      return report(answer, tick, "a query that is not finite must be rejected");
    }
    const Verdict verdict = oracle_.judge(answer, query);
    if (!tally_.judge(family_, verdict, std::isfinite(answer.closest.distance), answer.closest.certified())) return;
    report(answer, tick, fmt::format("error {:.3g} of the size", verdict.error));
  }

  void report(const StrokePoint& answer, std::size_t tick, const std::string& what) {
    tally_.fail(family_, [&] {
      std::string text = "tracker:";
      for (const auto& element : path_.elements) text += fmt::format(" element {}", exact_text(element));
      const std::size_t first = tick < 2 ? 0 : tick - 2;
      text += fmt::format(" tick {}, last queries {}", tick,
                          exact_text(std::span(path_.ticks).subspan(first, tick + 1 - first)));
      return text + fmt::format(" -> element {} t {} distance {:.17g}{}; {}", answer.element,
                                exact_text(answer.closest.parameter), answer.closest.distance,
                                answer.closest.certified() ? ", certified" : "", what);
    });
  }

  const std::size_t family_;
  const PenPath& path_;
  Tally& tally_;
  const StrokeOracle oracle_;
  std::vector<StrokeElement> elements_;
};

}  // namespace

TickFuzz::TickFuzz() {
  for (const PathFamily& family : path_families()) families_.emplace_back(family.name);
}

void TickFuzz::run(std::uint64_t seed, std::uint64_t block, std::uint64_t limit, Tally& tally) const {
  tally.begin_block(block);
  RandomPoints random(RandomPoints(seed ^ 0x7469636B73u).bits() ^ RandomPoints(~block).bits());
  std::uint64_t asked = 0;
  for (std::uint64_t i = 0; asked < limit; ++i) {
    const std::size_t family = i % path_families().size();
    PenPath path = path_families()[family].draw(random);
    path.ticks.resize(std::min<std::size_t>(path.ticks.size(), limit - asked));
    PathRun(family, path, tally).run();
    asked += path.ticks.size();
  }
}

}  // namespace calligraphy_test
