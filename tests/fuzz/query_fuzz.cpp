#include "query_fuzz.hpp"
#include "experiments/nearest_point_workload.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include <calligraphy/collision/nearest_point.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../last_interval.hpp"
#include "hostile_curves.hpp"
#include "hostile_queries.hpp"
#include "hostile_strokes.hpp"

namespace calligraphy_test {
namespace {

using calligraphy::nearest_point;
using calligraphy::NearestPointMethod;
using calligraphy::NearestPointStatus;
using calligraphy::StrokeElement;

constexpr int queries_per_curve = 8;
constexpr int workload_queries = 512;

bool is_finite(const NearestPoint& answer) {
  return std::isfinite(answer.parameter) && answer.point.allFinite() && std::isfinite(answer.distance) &&
         answer.tangent.allFinite();
}

bool same_bits(const NearestPoint& a, const NearestPoint& b) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  return bits(a.parameter) == bits(b.parameter) && bits(a.point.x()) == bits(b.point.x()) &&
         bits(a.point.y()) == bits(b.point.y()) && bits(a.distance) == bits(b.distance) &&
         bits(a.tangent.x()) == bits(b.tangent.x()) && bits(a.tangent.y()) == bits(b.tangent.y()) &&
         a.status == b.status;
}

/// Mostly the whole curve; otherwise a part of it, which may be tiny or a point.
ParameterRange draw_range(RandomPoints& random) {
  if (!one_in(random, 4)) return {};
  double begin = random.next(), end = random.next();
  switch (random.index(6)) {
    case 0:
      begin = 0.0;
      break;
    case 1:
      end = 1.0;
      break;
    case 2:
      end = begin;
      break;
    case 3:
      end = std::min(1.0, begin + magnitude(random, -16.0, -1.0));
      break;
    case 4:
      begin = std::round(8.0 * begin) / 8.0, end = std::round(8.0 * end) / 8.0;
      break;
    default:
      break;
  }
  return {std::min(begin, end), std::max(begin, end)};
}

/// One curve and the queries to it.
struct Case {
  std::size_t family;
  std::vector<Point> control_points;
  std::vector<Point> queries;
  ParameterRange range;
};

class CaseRun {
 public:
  CaseRun(const Case& asked, RandomPoints& random, std::size_t first_method_family, Tally& tally)
      : case_(asked),
        random_(random),
        other_methods_(first_method_family),
        tally_(tally),
        element_(calligraphy::prepare_element(asked.control_points)),
        oracle_(asked.control_points) {}

  void run() {
    ask_exact();
    for (std::size_t i = 0; i < case_.queries.size(); ++i) {
      const Point& query = case_.queries[i];
      if (!query.allFinite() || query.cwiseAbs().maxCoeff() > 1e150) {
        judge_lost(answers_[i], query);
        continue;
      }
      const auto bounds = oracle_.nearest(query, answers_[i].parameter, case_.range);
      judge(case_.family, "exact", answers_[i], query, bounds, answers_[i].certified());
      ask_warm(query, answers_[i].parameter, bounds);
      if (i == 0) {
        ask_sampled(query, bounds);
        ask_printed(query);
      }
    }
    compare_again();
  }

 private:
  void ask_exact() {
    answers_.reserve(case_.queries.size());
    const auto start = std::chrono::steady_clock::now();
    for (const Point& query : case_.queries) answers_.push_back(nearest_point(element_, query, {}, case_.range));
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    tally_[case_.family].times.add(taken.count(), case_.queries.size());
  }

  void judge(std::size_t family, const char* method, const NearestPoint& answer, const Point& query,
             const oracle::Bounds& bounds, bool has_certificate, double start = 0.0) {
    const Verdict verdict = oracle_.judge(answer, query, bounds, case_.range);
    if (tally_.judge(family, verdict, is_finite(answer), has_certificate)) {
      report(
          family, method, answer, query, start,
          fmt::format("error {:.3g} of the size, nearest {:.17g}", verdict.error, static_cast<double>(bounds.found)));
    }
  }

  void judge_lost(const NearestPoint& answer, const Point& query) {
    Count& count = tally_[case_.family];
    ++count.answers;
    const bool usable = std::isfinite(answer.parameter) && answer.point.allFinite() && answer.tangent.allFinite();
    const bool told = answer.parameter == case_.range.begin && std::isinf(answer.distance) && !answer.certified();
    if (usable && (told || element_size() == 0.0)) return;
    ++(usable ? count.inconsistent : count.not_finite);
    report(case_.family, "exact", answer, query, 0.0, "a query that is not finite must be rejected");
  }

  double element_size() const { return oracle_.size(); }

  void ask_warm(const Point& query, double truth, const oracle::Bounds& bounds) {
    const double starts[] = {random_.next(), truth, 0.0, 1.0, last_start_};
    const double start = starts[random_.index(std::size(starts))];
    last_start_ = truth;
    const NearestPoint answer = nearest_point(element_, query, {NearestPointMethod::tracked}, case_.range, start);
    judge(other_methods_, "tracked", answer, query, bounds, answer.certified(), start);
  }

  void ask_sampled(const Point& query, const oracle::Bounds& bounds) {
    const NearestPoint sampled = nearest_point(element_, query, {NearestPointMethod::sampled}, case_.range);
    const Verdict verdict = oracle_.judge(sampled, query, bounds, case_.range);
    Count& count = tally_[other_methods_ + 2];
    ++count.answers;
    const bool honest = sampled.certified() == !element_.curve();
    if (is_finite(sampled) && verdict.consistent && honest) return;
    ++(is_finite(sampled) ? count.inconsistent : count.not_finite);
    report(other_methods_ + 2, "sampled", sampled, query, 0.0, "not consistent");
  }

  /// It may be wrong, but must report where its last interval contains a nearer point.
  void ask_printed(const Point& query) {
    constexpr double tolerances[] = {1e-3, 1e-6, 1e-9};
    const double tolerance = tolerances[random_.index(std::size(tolerances))];
    const NearestPoint printed = nearest_point(element_, query, {NearestPointMethod::wang2006, tolerance});
    Count& count = tally_[other_methods_ + 1];
    ++count.answers;
    if (!is_finite(printed)) {
      ++count.not_finite;
      return report(other_methods_ + 1, "wang2006", printed, query, 0.0, "not finite");
    }
    if (!element_.curve() || printed.status == NearestPointStatus::unsafe_stop) return;
    const ParameterRange last = last_interval(printed.parameter);
    const auto bounds = oracle_.nearest(query, printed.parameter, last);
    const double rounding = 1e-15 * printed.distance;
    const double epsilon = wang2006_epsilon(element_, query, tolerance) + rounding;
    if (printed.status == NearestPointStatus::approximate && bounds.found >= printed.distance - epsilon) return;
    ++count.inconsistent;
    report(other_methods_ + 1, "wang2006", printed, query, tolerance,
           fmt::format("unsafe stop not reported, nearest of the last interval {:.17g}",
                       static_cast<double>(bounds.found)));
  }

  /// The same bits in a batch, and when queried individually again.
  void compare_again() {
    std::vector<NearestPoint> again(case_.queries.size());
    const bool whole = case_.range.begin == 0.0 && case_.range.end == 1.0;
    if (whole) calligraphy::nearest_points(element_, case_.queries, again);
    if (!whole) {
      const StrokeElement other = calligraphy::prepare_element(case_.control_points);
      for (std::size_t i = 0; i < again.size(); ++i) again[i] = nearest_point(other, case_.queries[i], {}, case_.range);
    }
    for (std::size_t i = 0; i < again.size(); ++i) {
      if (same_bits(again[i], answers_[i])) continue;
      ++tally_[case_.family].different;
      report(case_.family, whole ? "batch" : "again", again[i], case_.queries[i], 0.0,
             fmt::format("alone t {}", exact_text(answers_[i].parameter)));
    }
  }

  void report(std::size_t family, const char* method, const NearestPoint& answer, const Point& query, double start,
              const std::string& what) {
    tally_.fail(family, [&] {
      return fmt::format("{}: points {} query {} range {} {} start {} -> t {} distance {:.17g}{}; {}", method,
                         exact_text(case_.control_points), exact_text({&query, 1}), exact_text(case_.range.begin),
                         exact_text(case_.range.end), exact_text(start), exact_text(answer.parameter), answer.distance,
                         answer.certified() ? ", certified" : "", what);
    });
  }

  const Case& case_;
  RandomPoints& random_;
  const std::size_t other_methods_;
  Tally& tally_;
  const StrokeElement element_;
  const NearestPointOracle oracle_;
  std::vector<NearestPoint> answers_;
  double last_start_ = 0.5;
};

Case draw_case(RandomPoints& random, std::size_t family, std::size_t first_family) {
  constexpr int degrees[] = {2, 3, 3, 4};
  const int degree = degrees[random.index(std::size(degrees))];
  std::vector<Point> shape = curve_families()[family - first_family].draw(random, degree);
  Case drawn{family, {}, {}, draw_range(random)};
  const Place place(random);
  for (const Point& point : shape) drawn.control_points.push_back(place(point));
  for (int i = 0; i < queries_per_curve; ++i) {
    const Point query = one_in(random, 64) ? draw_tie(random, shape) : draw_query(random, shape);
    drawn.queries.push_back(place(query));
    if (one_in(random, 1000)) drawn.queries.back() = draw_lost_query(random);
  }
  return drawn;
}

}  // namespace

QueryFuzz::QueryFuzz()
    : real_curves_(calligraphy::curve_control_points(calligraphy::built_in_characters().characters)) {
  for (const auto& workload : calligraphy::nearest_point_workloads(real_curves_, 1)) families_.push_back(workload.name);
  for (const CurveFamily& family : curve_families()) families_.push_back(fmt::format("any degree, {}", family.name));
  for (const char* method : {"tracked", "wang2006", "sampled"}) families_.emplace_back(method);
}

void QueryFuzz::run(std::uint64_t seed, std::uint64_t block, std::uint64_t limit, Tally& tally) const {
  tally.begin_block(block);
  RandomPoints random(RandomPoints(seed).bits() ^ RandomPoints(~block).bits());
  const std::size_t methods = families_.size() - 3;
  std::uint64_t asked = 0;
  const auto ask = [&](Case next) {
    next.queries.resize(std::min<std::size_t>(next.queries.size(), limit - asked));
    CaseRun(next, random, methods, tally).run();
    asked += next.queries.size();
  };
  std::size_t family = 0;
  for (const auto& workload : calligraphy::nearest_point_workloads(real_curves_, workload_queries, random.bits())) {
    for (const auto& curve : workload.curves) {
      if (asked < limit) ask({family, curve.control_points, curve.queries, {}});
    }
    ++family;
  }
  const std::size_t first = family;
  while (asked < limit) {
    ask(draw_case(random, family, first));
    family = first + (family + 1 - first) % curve_families().size();
  }
}

}  // namespace calligraphy_test
