#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

#include <calligraphy/experiments/tradeoff.hpp>

#include "base/monotonic_clock.hpp"
#include "base/require.hpp"
#include "nearest_point_workload.hpp"
#include "tradeoff_pen.hpp"

namespace calligraphy {
namespace {

constexpr double em = 0.04;  ///< edge of a character's square [m]

/// The value that this share of the values does not exceed. Reorders them; 0 if there are none.
double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

bool is_real(const std::string& workload) { return workload.starts_with("real strokes"); }

/// A curve and its queries, with the exact answers.
struct Task {
  StrokeElement element;
  std::vector<Point> queries;
  std::vector<double> distances;  ///< exact
  double size;                    ///< of the curve; 1 for a point
};

struct Workload {
  std::string name;
  std::vector<Task> tasks;
};

Workload prepared(const NearestPointWorkload& workload) {
  Workload result{workload.name, {}};
  for (const CurveQueries& asked : workload.curves) {
    Task task{prepare_element(asked.control_points), asked.queries, {}, 1.0};
    if (task.element.size() > 0.0) task.size = task.element.size();
    for (const Point& query : task.queries) {
      task.distances.push_back(nearest_point(task.element, query, reference).distance);
    }
    result.tasks.push_back(std::move(task));
  }
  return result;
}

/// Answers one query after another, each from the last answer; `use` gets each answer and its place in the task.
template <typename Use>
void ask(const Task& task, const NearestPointOptions& options, const Use& use) {
  double last = 0.5;
  for (std::size_t i = 0; i < task.queries.size(); ++i) {
    const NearestPoint found = nearest_point(task.element, task.queries[i], options, {}, last);
    last = found.parameter;
    use(i, found);
  }
}

std::vector<double> errors_of(const Workload& workload, const NearestPointOptions& options) {
  std::vector<double> errors;
  for (const Task& task : workload.tasks) {
    ask(task, options, [&](std::size_t i, const NearestPoint& found) {
      errors.push_back(std::abs(found.distance - task.distances[i]) / task.size);
    });
  }
  return errors;
}

/// Time for all queries of a workload [s].
double time_of(const Workload& workload, const NearestPointOptions& options) {
  return seconds_of([&] {
    double sum = 0.0;
    for (const Task& task : workload.tasks) {
      ask(task, options, [&sum](std::size_t, const NearestPoint& found) { sum += found.parameter; });
    }
    return sum;
  });
}

/// The time with all queries to a curve in one call [s].
double batch_time_of(const Workload& workload, const NearestPointOptions& options) {
  std::vector<NearestPoint> results;
  for (const Task& task : workload.tasks) results.resize(std::max(results.size(), task.queries.size()));
  return seconds_of([&] {
    double sum = 0.0;
    for (const Task& task : workload.tasks) {
      nearest_points(task.element, task.queries, std::span(results).first(task.queries.size()), options);
      sum += results.front().parameter;
    }
    return sum;
  });
}

/// Time of each round [s].
struct Rounds {
  std::vector<double> one_by_one, batch;
};

double per_query(std::vector<double> seconds, double share, std::size_t count) {
  return 1e9 * percentile(seconds, share) / static_cast<double>(count);
}

void summarise(std::vector<double> errors, NearestPointCost& cost) {
  const auto is_wrong = [](double error) { return !(error <= wrong_branch); };
  cost.wrong =
      static_cast<double>(std::count_if(errors.begin(), errors.end(), is_wrong)) / static_cast<double>(errors.size());
  cost.error = percentile(errors, 0.5);
  cost.error_p99 = percentile(errors, 0.99);
  cost.error_worst = *std::max_element(errors.begin(), errors.end());
}

NearestPointCost cost_of(std::string queries, const std::vector<double>& errors, const Rounds& rounds) {
  NearestPointCost cost;
  cost.queries = std::move(queries);
  cost.ns = per_query(rounds.one_by_one, 0.5, errors.size());
  cost.ns_p90 = per_query(rounds.one_by_one, 0.9, errors.size());
  cost.batch_ns = per_query(rounds.batch, 0.5, errors.size());
  summarise(errors, cost);
  return cost;
}

/// Several workloads as one. Times are means over the workloads, so that a disturbance of one in a round does not count
/// against all.
struct Pool {
  NearestPointCost sum;
  std::vector<double> errors;

  void add(const std::vector<double>& own, const NearestPointCost& cost) {
    const auto count = static_cast<double>(own.size());
    sum.ns += count * cost.ns;
    sum.ns_p90 += count * cost.ns_p90;
    sum.batch_ns += count * cost.batch_ns;
    errors.insert(errors.end(), own.begin(), own.end());
  }
  NearestPointCost cost(const char* queries) const {
    const auto count = static_cast<double>(errors.size());
    NearestPointCost mean = sum;
    mean.queries = queries;
    mean.ns /= count;
    mean.ns_p90 /= count;
    mean.batch_ns /= count;
    summarise(errors, mean);
    return mean;
  }
};

std::string setting_name(const NearestPointOptions& options) {
  char setting[32];
  if (options.method == NearestPointMethod::sampled) {
    std::snprintf(setting, sizeof setting, " %d x %d", options.samples, options.refinements);
  } else {
    std::snprintf(setting, sizeof setting, " %.0e", options.tolerance);
  }
  return to_string(options.method) + std::string(setting);
}

}  // namespace

std::vector<NearestPointSetting> nearest_point_settings() {
  using enum NearestPointMethod;
  std::vector<NearestPointSetting> settings;
  const auto add = [&settings](const NearestPointOptions& options) {
    settings.push_back({setting_name(options), options});
  };
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) add({.method = exact, .tolerance = tolerance});
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) add({.method = tracked, .tolerance = tolerance});
  for (const auto& [samples, refinements] : {std::pair(8, 1), {16, 0}, {16, 1}, {16, 2}, {32, 2}, {64, 3}}) {
    add({.method = sampled, .samples = samples, .refinements = refinements});
  }
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) add({.method = wang2006, .tolerance = tolerance});
  return settings;
}

std::vector<NearestPointTradeoff> nearest_point_tradeoff(std::span<const Character> characters,
                                                         const NearestPointTradeoffOptions& options) {
  require_above_zero("rounds", options.rounds, "");
  require_above_zero("stiffness", options.stiffness, "N/m");
  std::vector<Workload> workloads;
  for (const NearestPointWorkload& each :
       nearest_point_workloads(curve_control_points(characters, em), options.queries, options.seed)) {
    workloads.push_back(prepared(each));
  }
  StrokeQueryOptions drawing;
  drawing.em = em;
  drawing.rate = options.rate;
  drawing.speed = options.speed;
  drawing.seed = options.seed;
  const TracedStrokes drawn = drawn_strokes(stroke_queries(characters, drawing));
  const std::vector<TracedStrokes> groups = in_groups(drawn);
  const double step = options.speed / options.rate;
  const std::vector<DrawnCurve> curves = drawn_curves(drawn, step), arcs = gentle_arcs(step);

  const std::vector<NearestPointSetting> settings = nearest_point_settings();
  // By setting, then by workload followed by group of strokes.
  const std::size_t parts = workloads.size() + groups.size();
  std::vector<std::vector<Rounds>> rounds(settings.size(), std::vector<Rounds>(parts));
  const std::size_t to_measure = static_cast<std::size_t>(options.rounds) * parts * settings.size();
  std::size_t measured = 0;
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t w = 0; w < parts; ++w) {
      for (std::size_t i = 0; i < settings.size(); ++i) {
        // Each round begins with another setting, so that none always follows the same one.
        const std::size_t s = (i + static_cast<std::size_t>(round)) % settings.size();
        const NearestPointOptions& own = settings[s].options;
        Rounds& times = rounds[s][w];
        if (w >= workloads.size()) {
          times.one_by_one.push_back(tick_time(groups[w - workloads.size()], own));
        } else {
          times.one_by_one.push_back(time_of(workloads[w], own));
          times.batch.push_back(batch_time_of(workloads[w], own));
        }
        ++measured;
        if (options.progress) options.progress(static_cast<double>(measured) / static_cast<double>(to_measure));
      }
    }
  }

  std::vector<NearestPointTradeoff> tradeoff;
  for (std::size_t s = 0; s < settings.size(); ++s) {
    const NearestPointOptions& own = settings[s].options;
    NearestPointTradeoff entry;
    entry.setting = settings[s];
    Pool real, hard;
    for (std::size_t w = 0; w < workloads.size(); ++w) {
      const std::vector<double> errors = errors_of(workloads[w], own);
      entry.workloads.push_back(cost_of(workloads[w].name, errors, rounds[s][w]));
      (is_real(workloads[w].name) ? real : hard).add(errors, entry.workloads.back());
    }
    entry.real = real.cost("real strokes");
    entry.hard = hard.cost("hard");
    Pool ticks;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const std::vector<double> errors = tick_errors(groups[g], own);
      ticks.add(errors, cost_of("", errors, rounds[s][workloads.size() + g]));
    }
    entry.ticks = ticks.cost("ticks along strokes");
    entry.strokes = feel(curves, own, options.stiffness);
    entry.arcs = feel(arcs, own, options.stiffness);
    tradeoff.push_back(std::move(entry));
    if (options.progress) options.progress(1.0);
  }
  return tradeoff;
}

}  // namespace calligraphy
