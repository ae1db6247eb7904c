#include "stroke_reading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "assignment.hpp"
#include "judge/judge_constants.hpp"
#include "stroke_direction.hpp"
#include "writing_order.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

constexpr std::ptrdiff_t max_apart_tried = 3;  // pairs of strokes joined out of turn that are tried, for speed

using Costs = std::shared_ptr<const StrokeCosts>;

/// The parts of a path before and after a share of its length.
std::pair<PenPath, PenPath> cut(const PenPath& path, double share) {
  const double at = share * path_length(path);
  PenPath begun = {path.front()}, rest;
  double reached = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step = (path[i] - path[i - 1]).norm();
    if (rest.empty() && reached + step >= at && step > 0.0) {
      begun.push_back(path[i - 1] + std::clamp((at - reached) / step, 0.0, 1.0) * (path[i] - path[i - 1]));
      rest.push_back(begun.back());
    }
    (rest.empty() ? begun : rest).push_back(path[i]);
    reached += step;
  }
  if (rest.empty()) rest.push_back(path.back());
  return {begun, rest};
}

/// The least saving for which another order is believed of a hand with this mean cost [em].
double least_saving(double mean_cost) {
  return std::max(judge_constants.min_saving, judge_constants.saving_factor * mean_cost);
}

/// The cheapest reading of the pen-downs, taken in this order, as the strokes in theirs: like the edits that turn one
/// word into another (Needleman and Wunsch 1970), with joined and broken strokes as additional edits.
StrokeReading read_in_this_order(Costs costs, std::span<const std::size_t> order) {
  struct Best {
    double cost = std::numeric_limits<double>::infinity();
    ReadingStep step;
  };
  const std::size_t paths = order.size(), strokes = costs->strokes();
  const double unlikely = judge_constants.unlikely_count_cost;
  const double join_price = judge_constants.join_cost + (paths >= strokes ? unlikely : 0.0);
  const double break_price = judge_constants.break_cost + (paths <= strokes ? unlikely : 0.0);
  std::vector<std::vector<Best>> best(paths + 1, std::vector<Best>(strokes + 1));
  best[0][0].cost = 0.0;
  for (std::size_t i = 0; i <= paths; ++i) {
    const std::size_t path = i < paths ? order[i] : paths;
    for (std::size_t stroke = 0; stroke <= strokes; ++stroke) {
      const double before = best[i][stroke].cost;
      const auto reach = [&](std::size_t more_paths, std::size_t more_strokes, double cost) {
        Best& then = best[i + more_paths][stroke + more_strokes];
        if (before + cost < then.cost) then = {before + cost, {path, more_paths, stroke, more_strokes, cost}};
      };
      if (stroke < strokes) reach(0, 1, judge_constants.left_over_cost);
      if (i == paths) continue;
      reach(1, 0, costs->is_tap(path) ? 0.0 : judge_constants.left_over_cost);
      if (stroke == strokes) continue;
      reach(1, 1, costs->single(path, stroke).cost);
      for (std::size_t more = 2; more <= std::min(max_joined, strokes - stroke); ++more) {
        reach(1, more, costs->joined(path, stroke, more).cost + join_price * static_cast<double>(more - 1));
      }
      for (std::size_t more = 2; more <= std::min(max_broken, paths - i); ++more) {
        if (order[i + more - 1] != path + more - 1) break;
        reach(more, 1, costs->broken(path, more, stroke).cost + break_price * static_cast<double>(more - 1));
      }
    }
  }
  StrokeReading reading{{}, best[paths][strokes].cost, std::move(costs)};
  for (std::size_t i = paths, stroke = strokes; i > 0 || stroke > 0;) {
    const ReadingStep& step = best[i][stroke].step;
    reading.steps.push_back(step);
    i -= step.paths;
    stroke -= step.strokes;
  }
  std::reverse(reading.steps.begin(), reading.steps.end());
  return reading;
}

/// The affine map from the pen-downs to the strokes they are read as, by least squares. It is pulled towards the start,
/// because a few strokes reveal little about slant and size. None if nothing was written, or if the map slants or
/// scales the writing so much more than the start does that handwriting cannot explain it.
std::optional<AffineMap> fit_writing(const StrokeReading& reading, const StrokeOutlines& strokes,
                                     std::span<const DrawnLine> drawn, const AffineMap& start) {
  std::vector<std::pair<Outline, Outline>> pairs;
  Point from = Point::Zero(), to = Point::Zero();
  for (const ReadingStep& step : reading.steps) {
    if (step.paths != 1 || step.strokes == 0 || reading.costs->is_tap(step.path)) continue;
    if (step.cost > judge_constants.max_fitted_cost) continue;
    Outline wanted = strokes.run(step.stroke, step.strokes).line;
    if (reading.pair(step).backwards) wanted = reversed(wanted);
    pairs.emplace_back(drawn[step.path].line, wanted);
    from += pairs.back().first.colwise().mean().transpose();
    to += wanted.colwise().mean().transpose();
  }
  if (pairs.empty()) return std::nullopt;
  const auto count = static_cast<double>(pairs.size());
  from /= count;
  to /= count;
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero(), product = Eigen::Matrix2d::Zero();
  for (const auto& [line, wanted] : pairs) {
    const Outline p = line.rowwise() - from.transpose(), q = wanted.rowwise() - to.transpose();
    square += p.transpose() * p;
    product += q.transpose() * p;
  }
  const double points = count * static_cast<double>(Outline::RowsAtCompileTime);
  const double spread = points * judge_constants.fit_pull / std::abs(start.linear.determinant());
  const Eigen::Matrix2d linear =
      (product + spread * start.linear) * (square + spread * Eigen::Matrix2d::Identity()).inverse();
  const Eigen::Matrix2d change = linear * start.linear.inverse();
  const double size = change.determinant();
  const double max_size = judge_constants.max_fit_scale * judge_constants.max_fit_scale;
  if (!(size > 1.0 / max_size && size < max_size)) return std::nullopt;
  const Eigen::Matrix2d slant = change / std::sqrt(size) - Eigen::Matrix2d::Identity();
  if (slant.jacobiSvd().singularValues()[0] > judge_constants.max_fit_slant) return std::nullopt;
  return AffineMap{linear, to - linear * from};
}

class Reader {
 public:
  Reader(const Character& character, const StrokeOutlines& strokes, std::span<const PenPath> paths)
      : character_(character), strokes_(strokes), paths_(paths), drawn_(drawn_lines(paths)) {}

  /// Starts from the box of the pen-downs, or from where they are if that fits clearly better at once. If there is then
  /// something to remark or the fit is poor, the hand may be slanted: starts from the box turned both ways as well.
  /// With a single line, nobody can tell a slanted hand from a slanted stroke.
  StrokeReading read() {
    const Start boxed = begin(box_of_turned(0.0)), here = begin(AffineMap());
    Pair best = refine(here.cost() < boxed.cost() - judge_constants.min_saving ? here : boxed);
    StrokeReading chosen = choose(best);
    if (paths_.size() > 1 && (!is_unremarkable(chosen) || chosen.mean_cost() >= judge_constants.doubtful_mean_cost)) {
      for (const double degrees : {-judge_constants.start_turn, judge_constants.start_turn}) {
        const Pair pair = refine(begin(box_of_turned(degrees)));
        if (pair.in_order.cost < best.in_order.cost) best.in_order = pair.in_order;
        if (pair.free.cost < best.free.cost) best.free = pair.free;
      }
      chosen = choose(best);
    }
    join_apart(chosen);
    pair_leftovers(chosen);
    unpair_attempts(chosen);
    chosen.comparisons = comparisons_;
    return chosen;
  }

 private:
  using Rule = StrokeReading (Reader::*)(const Costs&) const;

  struct Pair {
    StrokeReading in_order, free;
  };
  struct Start : Pair {
    AffineMap fit;
    double cost() const { return std::min(in_order.cost, free.cost); }
  };

  AffineMap box_of_turned(double degrees) const {
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(degrees * std::numbers::pi / 180.0).toRotationMatrix();
    std::vector<PenPath> turned(paths_.begin(), paths_.end());
    for (PenPath& path : turned) {
      for (Point& point : path) point = turn * point;
    }
    const BoxMap box = fit_box(turned, character_);
    return {box.scale.asDiagonal() * turn, box.offset};
  }

  /// A pen-down as two strokes of which the second does not follow the first.
  struct ApartPair {
    std::size_t path, first, other;
    double share;  ///< share of the length at which the second begins [1]
    double cost;
  };

  /// The pairs that a pen-down resembles clearly more than any of its strokes alone, the cheapest first.
  std::vector<ApartPair> apart_pairs(const StrokeCosts& costs) {
    std::vector<ApartPair> pairs;
    for (std::size_t first = 0; first < strokes_.count(); ++first) {
      for (std::size_t other = 0; other < strokes_.count(); ++other) {
        if (!strokes_.are_near(first, other)) continue;
        const StrokeRun run = strokes_.apart(first, other);
        for (std::size_t path = 0; path < paths_.size(); ++path) {
          if (costs.length(path) < judge_constants.min_joined_length * run.line_length) continue;
          const Outline &line = costs.placed(path), ways = line - run.line;
          if (std::max(ways.row(0).norm(), ways.bottomRows<1>().norm()) > judge_constants.max_apart_gap) continue;
          ++comparisons_;
          const PairCost pair = costs.of_run(path, run);
          const double alone = std::min(costs.single(path, first).cost, costs.single(path, other).cost);
          const double most =
              std::min(judge_constants.max_joined_or_broken_cost, judge_constants.max_apart_share * alone);
          if (pair.backwards || pair.cost >= most) continue;
          const double share = (strokes_.length(first) + 0.5 * (run.line_length - run.length)) / run.line_length;
          pairs.push_back({path, first, other, share, pair.cost});
        }
      }
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const ApartPair& one, const ApartPair& other) { return one.cost < other.cost; });
    return pairs;
  }

  /// Where there are too few pen-downs, one may have written two strokes that do not follow each other: reads it as two
  /// pen-downs, and believes that if it costs clearly less.
  void join_apart(StrokeReading& reading) {
    if (paths_.size() >= strokes_.count() || reading.cost < judge_constants.min_saving) return;
    const Costs as_read = reading.costs;
    if (join_apart(reading, *as_read)) return;
    join_apart(reading, *place(box_of_turned(0.0)));  // the reading may have bent the fit to the wrong stroke
  }

  bool join_apart(StrokeReading& reading, const StrokeCosts& costs) {
    const std::vector<ApartPair> pairs = apart_pairs(costs);
    return std::any_of(pairs.begin(), pairs.begin() + std::min(std::ssize(pairs), max_apart_tried),
                       [&](const ApartPair& pair) { return join_apart(reading, pair, costs.fit()); });
  }

  bool join_apart(StrokeReading& reading, const ApartPair& pair, const AffineMap& start) {
    const auto [begun, rest] = cut(paths_[pair.path], pair.share);
    std::vector<PenPath> parts(paths_.begin(), paths_.end());
    parts[pair.path] = begun;
    parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(pair.path) + 1, rest);
    Reader reader(character_, strokes_, parts);
    const StrokeReading in_two = reader.choose(reader.refine(reader.begin(start)));
    comparisons_ += reader.comparisons_;
    const double saved = reading.cost - in_two.cost - judge_constants.join_cost;
    if (saved < std::max(judge_constants.min_apart_saving, least_saving(in_two.mean_cost()))) return false;
    std::vector<ReadingStep> steps;
    for (ReadingStep step : in_two.steps) {
      const bool is_part = step.paths > 0 && step.path <= pair.path + 1 && step.path + step.paths > pair.path;
      if (is_part) {
        const std::size_t stroke = step.path == pair.path ? pair.first : pair.other;
        if (step.paths != 1 || step.strokes != 1 || step.stroke != stroke) return false;
        if (in_two.pair(step).backwards) return false;
        if (step.path > pair.path) continue;
        step.also = pair.other;
        step.cost = pair.cost;
      } else if (step.path > pair.path) {
        --step.path;
      }
      steps.push_back(step);
    }
    reading.steps = std::move(steps);
    reading.cost = in_two.cost + judge_constants.join_cost;
    reading.costs = place(in_two.costs->fit());
    reading.order_evidence = in_two.order_evidence;
    return true;
  }

  /// An extra pen-down in the place of a missing stroke is that stroke, misplaced or of another shape; so is one that
  /// resembles the stroke, wherever it comes in the order.
  static void pair_leftovers(StrokeReading& reading) {
    const StrokeCosts& costs = *reading.costs;
    for (std::size_t i = 0; i < reading.steps.size(); ++i) {
      const ReadingStep& extra = reading.steps[i];
      if (extra.paths == 0 || extra.strokes > 0 || costs.is_tap(extra.path)) continue;
      std::size_t found = i;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < reading.steps.size(); ++k) {
        const ReadingStep& missing = reading.steps[k];
        if (missing.paths > 0) continue;
        const double cost = costs.single(extra.path, missing.stroke).cost;
        const bool is_beside = k + 1 == i || k == i + 1;
        const double most = is_beside ? judge_constants.max_substitute_cost : judge_constants.left_over_cost;
        if (cost > most || cost >= least) continue;
        found = k;
        least = cost;
      }
      if (found == i) continue;
      reading.steps[found] = {extra.path, 1, reading.steps[found].stroke, 1, least};
      reading.steps.erase(reading.steps.begin() + static_cast<std::ptrdiff_t>(i));
      --i;
    }
  }

  /// A pen-down that lies on the same stroke as an attempt beside it is another attempt at it, not the missing stroke
  /// in whose place it comes.
  void unpair_attempts(StrokeReading& reading) const {
    const StrokeCosts& costs = *reading.costs;
    std::vector<ReadingStep> missing;
    for (ReadingStep& step : reading.steps) {
      if (step.paths != 1 || step.strokes != 1 || step.also || costs.is_tap(step.path)) continue;
      const std::size_t nearest = nearest_stroke(costs, step.path);
      const double cost = costs.single(step.path, nearest).cost;
      const double most = std::min(judge_constants.max_attempt_cost, judge_constants.max_attempt_share * step.cost);
      if (nearest == step.stroke || cost > most) continue;
      const bool is_repeated = std::any_of(reading.steps.begin(), reading.steps.end(), [&](const ReadingStep& other) {
        const bool is_beside = other.path + 1 == step.path || other.path == step.path + 1;
        return is_beside && other.paths == 1 && other.strokes == 0 && nearest_stroke(costs, other.path) == nearest;
      });
      if (!is_repeated) continue;
      missing.push_back({step.path, 0, step.stroke, 1, judge_constants.left_over_cost});
      step = {step.path, 1, step.stroke, 0, judge_constants.left_over_cost};
    }
    reading.steps.insert(reading.steps.end(), missing.begin(), missing.end());
  }

  Costs place(const AffineMap& fit) {
    auto costs = std::make_shared<const StrokeCosts>(strokes_, drawn_, fit);
    comparisons_ += costs->comparisons();
    return costs;
  }

  Start begin(const AffineMap& fit) {
    const Costs costs = place(fit);
    return {{read_in_order(costs), read_freely(costs)}, fit};
  }

  /// Fits the writing to the reading and reads it again, as long as the cost falls.
  StrokeReading refine(Rule rule, StrokeReading reading, const AffineMap& start) {
    for (int i = 0; i < judge_constants.max_refits; ++i) {
      const std::optional<AffineMap> fit = fit_writing(reading, strokes_, drawn_, start);
      if (!fit) break;
      StrokeReading next = (this->*rule)(place(*fit));
      if (next.cost >= reading.cost - judge_constants.min_refit_gain) break;
      reading = std::move(next);
    }
    return reading;
  }

  Pair refine(const Start& start) {
    const StrokeReading in_order = refine(&Reader::read_in_order, start.in_order, start.fit);
    StrokeReading free = start.free;
    if (is_same(start.in_order, free)) {  // another order may still show in the final fit
      free = read_freely(in_order.costs);
      if (is_same(in_order, free)) return {in_order, in_order};
    }
    return {in_order, refine(&Reader::read_freely, std::move(free), start.fit)};
  }

  static bool has(const StrokeReading& reading, const ReadingStep& wanted) {
    return std::any_of(reading.steps.begin(), reading.steps.end(),
                       [&](const ReadingStep& step) { return step.takes_the_same(wanted); });
  }

  static bool is_same(const StrokeReading& one, const StrokeReading& other) {
    return one.steps.size() == other.steps.size() &&
           std::all_of(one.steps.begin(), one.steps.end(), [&](const ReadingStep& step) { return has(other, step); });
  }

  static double cost_of_others(const StrokeReading& reading, const StrokeReading& than) {
    double sum = 0.0;
    for (const ReadingStep& step : reading.steps) sum += has(than, step) ? 0.0 : step.cost;
    return sum;
  }

  /// Another order is believed only if it fits clearly better where the two differ. A careless hand needs more
  /// evidence, unless the other order leaves no more to remark.
  StrokeReading choose(const Pair& pair) const {
    const auto& [in_order, free] = pair;
    if (free.cost >= in_order.cost) return in_order;
    const double doubt = faults(free) > faults(in_order) ? free.mean_cost() : 0.0;
    const double evidence = evidence_of(cost_of_others(in_order, free), cost_of_others(free, in_order), doubt);
    if (evidence < 1.0) return in_order;
    StrokeReading chosen = free;
    chosen.order_evidence = evidence;
    return chosen;
  }

  /// Number of pen-downs and strokes that are left over, joined, broken or out of turn.
  static std::size_t faults(const StrokeReading& reading) {
    std::size_t count = 0;
    std::vector<std::size_t> paths;  // by stroke
    for (const ReadingStep& step : reading.steps) {
      const bool is_bounce = step.strokes == 0 && reading.costs->is_tap(step.path);
      if (!is_bounce && (step.paths != 1 || step.strokes != 1)) ++count;
      if (step.is_written()) paths.push_back(step.path);
    }
    return count + paths.size() - longest_rise(paths).size();
  }

  /// Evidence for the cheaper of two orders. A careless hand needs more of it than a neat one; among small strokes, the
  /// factor between the costs decides.
  static double evidence_of(double cost, double other, double mean_cost) {
    if (cost <= other) return 0.0;
    return std::max((cost - other) / least_saving(mean_cost), cost / (judge_constants.saving_factor * other));
  }

  bool is_unremarkable(const StrokeReading& reading) const {
    std::size_t next = 0;
    for (const ReadingStep& step : reading.steps) {
      if (step.strokes == 0 && reading.costs->is_tap(step.path)) continue;
      if (step.paths != 1 || step.strokes != 1 || step.path < next) return false;
      next = step.path;
      const WritingDirection direction = direction_of(step, reading, strokes_).direction;
      if (direction == WritingDirection::backwards || direction == WritingDirection::neither) return false;
    }
    return true;
  }

  StrokeReading read_in_order(const Costs& costs) const {
    std::vector<std::size_t> order(costs->paths());
    std::iota(order.begin(), order.end(), std::size_t{0});
    return read_in_this_order(costs, order);
  }

  /// Reads the pen-downs in the order of the strokes that fit them best overall (assignment).
  StrokeReading read_freely(const Costs& costs) const {
    std::vector<std::vector<double>> pairs(costs->strokes());
    for (std::size_t stroke = 0; stroke < pairs.size(); ++stroke) {
      for (std::size_t path = 0; path < costs->paths(); ++path) {
        pairs[stroke].push_back(costs->single(path, stroke).cost);
      }
    }
    std::vector<std::optional<std::size_t>> strokes(costs->paths());
    const auto owners = assign(pairs, costs->paths(), judge_constants.left_over_cost);
    for (std::size_t stroke = 0; stroke < owners.size(); ++stroke) {
      if (owners[stroke]) strokes[*owners[stroke]] = stroke;
    }
    prefer_order(*costs, strokes);
    std::vector<std::size_t> keys;
    for (std::size_t path = 0; path < strokes.size(); ++path) {
      keys.push_back(strokes[path].value_or(nearest_stroke(*costs, path)));
    }
    std::vector<std::size_t> order(keys.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t one, std::size_t other) { return keys[one] < keys[other]; });
    return read_in_this_order(costs, order);
  }

  static std::size_t nearest_stroke(const StrokeCosts& costs, std::size_t path) {
    std::size_t nearest = 0;
    for (std::size_t stroke = 1; stroke < costs.strokes(); ++stroke) {
      if (costs.single(path, stroke).cost < costs.single(path, nearest).cost) nearest = stroke;
    }
    return nearest;
  }

  /// Prefers the right order among strokes that are much alike: pen-downs exchange their strokes if more of them are in
  /// turn afterwards and the cost does not rise clearly.
  void prefer_order(const StrokeCosts& costs, std::vector<std::optional<std::size_t>>& strokes) const {
    std::vector<std::size_t> paths;
    std::vector<std::size_t> written;
    double sum = 0.0;
    for (std::size_t path = 0; path < strokes.size(); ++path) {
      if (!strokes[path]) continue;
      paths.push_back(path);
      written.push_back(*strokes[path]);
      sum += costs.single(path, *strokes[path]).cost;
    }
    const std::size_t count = paths.size();
    if (count == 0) return;
    const double mean_cost = sum / static_cast<double>(count);
    std::size_t in_turn = longest_rise(written).size();
    const auto improve = [&](const std::vector<std::size_t>& other) {
      const std::size_t then = longest_rise(other).size();
      if (then <= in_turn) return false;
      double now_cost = 0.0, other_cost = 0.0;
      for (std::size_t i = 0; i < count; ++i) {
        if (other[i] == written[i]) continue;
        now_cost += costs.single(paths[i], written[i]).cost;
        other_cost += costs.single(paths[i], other[i]).cost;
      }
      if (evidence_of(other_cost, now_cost, mean_cost * static_cast<double>(then - in_turn)) >= 1.0) return false;
      written = other;
      in_turn = then;
      return true;
    };
    for (bool found = true; found && in_turn < count;) {
      found = false;
      for (std::size_t later = 1; later < count; ++later) {
        for (std::size_t earlier = later; earlier-- > 0;) {
          if (written[earlier] < written[later]) continue;
          std::vector<std::size_t> other = written;
          std::swap(other[earlier], other[later]);
          if (improve(other)) {
            found = true;
            continue;
          }
          other = sorted_between(written, earlier, later);
          if (improve(other)) found = true;
        }
      }
    }
    for (std::size_t i = 0; i < count; ++i) strokes[paths[i]] = written[i];
  }

  /// The strokes, sorted where they were written between two pen-downs and also lie between the strokes of these.
  static std::vector<std::size_t> sorted_between(std::vector<std::size_t> strokes, std::size_t earlier,
                                                 std::size_t later) {
    std::vector<std::size_t> places, between;
    for (std::size_t i = earlier; i <= later; ++i) {
      if (strokes[i] > strokes[earlier] || strokes[i] < strokes[later]) continue;
      places.push_back(i);
      between.push_back(strokes[i]);
    }
    std::sort(between.begin(), between.end());
    for (std::size_t i = 0; i < places.size(); ++i) strokes[places[i]] = between[i];
    return strokes;
  }

  const Character& character_;
  const StrokeOutlines& strokes_;
  const std::span<const PenPath> paths_;
  const std::vector<DrawnLine> drawn_;
  long comparisons_ = 0;
};

}  // namespace

StrokeRun run_of(const ReadingStep& step, const StrokeOutlines& strokes) {
  return step.also ? strokes.apart(step.stroke, *step.also) : strokes.run(step.stroke, step.strokes);
}

PairCost StrokeReading::pair(const ReadingStep& step) const {
  if (step.also) return costs->of_run(step.path, costs->outlines().apart(step.stroke, *step.also));
  if (step.paths > 1) return costs->broken(step.path, step.paths, step.stroke);
  if (step.strokes > 1) return costs->joined(step.path, step.stroke, step.strokes);
  return costs->single(step.path, step.stroke);
}

double StrokeReading::mean_cost() const {
  const std::size_t most = std::max(costs->paths(), costs->strokes());
  return most > 0 ? cost / static_cast<double>(most) : 0.0;
}

double StrokeReading::price(std::size_t out_of_order) const {
  return cost + static_cast<double>(out_of_order) * least_saving(mean_cost());
}

StrokeReading read_strokes(const Character& character, const StrokeOutlines& strokes, std::span<const PenPath> paths) {
  return Reader(character, strokes, paths).read();
}

}  // namespace calligraphy
