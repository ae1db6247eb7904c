#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <utility>

#include <calligraphy/collision/stroke_tracker.hpp>
#include <calligraphy/error.hpp>
#include <calligraphy/practice/nearest_point_workload.hpp>
#include <calligraphy/practice/stroke_queries.hpp>
#include <calligraphy/practice/trade.hpp>
#include <calligraphy/render/force_terms.hpp>

namespace calligraphy {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double wrong_branch = 1e-3;  ///< an error of the distance above this is no rounding [sizes of the curve]
constexpr NearestPointOptions reference = {.method = NearestPointMethod::exact, .tolerance = 1e-12};
constexpr double em = 0.04;  ///< edge of a character's square [m]

/// 90 % of the values are at most this for a share of 0.9. Reorders them; 0 of none.
double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

bool is_real(const std::string& workload) { return workload.starts_with("real strokes"); }

/// A curve and what is asked of it, with the right answers.
struct Task {
  StrokeElement element;
  std::vector<Point> queries;
  std::vector<double> distances;  ///< exact
  double size;                    ///< of the curve; of a point, 1
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

/// Asks one query after the other, each from the last answer; `use` gets each answer and its place in the task.
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

/// Seconds that `work` takes. What it returns is kept, or nothing would have to be computed.
template <typename Work>
double seconds_of(const Work& work) {
  const auto start = Clock::now();
  volatile double kept = work();
  const auto end = Clock::now();
  static_cast<void>(kept);
  return std::chrono::duration<double>(end - start).count();
}

/// For all queries of a workload.
double time_of(const Workload& workload, const NearestPointOptions& options) {
  return seconds_of([&] {
    double sum = 0.0;
    for (const Task& task : workload.tasks) {
      ask(task, options, [&sum](std::size_t, const NearestPoint& found) { sum += found.parameter; });
    }
    return sum;
  });
}

/// The same, all queries to a curve at once.
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

/// Seconds of each round.
struct Rounds {
  std::vector<double> one_by_one, batch;
};

double per_query(std::vector<double> seconds, double share, std::size_t count) {
  return 1e9 * percentile(seconds, share) / static_cast<double>(count);
}

NearestPointCost cost(std::string queries, std::vector<double> errors, const Rounds& rounds) {
  const auto is_wrong = [](double error) { return !(error <= wrong_branch); };
  const std::size_t count = errors.size();
  NearestPointCost result;
  result.queries = std::move(queries);
  result.ns = per_query(rounds.one_by_one, 0.5, count);
  result.ns_p90 = per_query(rounds.one_by_one, 0.9, count);
  result.batch_ns = per_query(rounds.batch, 0.5, count);
  result.wrong =
      static_cast<double>(std::count_if(errors.begin(), errors.end(), is_wrong)) / static_cast<double>(count);
  result.error = percentile(errors, 0.5);
  result.error_p99 = percentile(errors, 0.99);
  result.error_worst = *std::max_element(errors.begin(), errors.end());
  return result;
}

/// Several workloads as one.
struct Pool {
  std::vector<double> errors;
  Rounds rounds;

  void add(const std::vector<double>& own_errors, const Rounds& own) {
    errors.insert(errors.end(), own_errors.begin(), own_errors.end());
    add(rounds.one_by_one, own.one_by_one);
    add(rounds.batch, own.batch);
  }
  static void add(std::vector<double>& sums, const std::vector<double>& seconds) {
    sums.resize(seconds.size());
    for (std::size_t i = 0; i < seconds.size(); ++i) sums[i] += seconds[i];
  }
};

// ---- a pen drawn along whole strokes

struct DrawnStroke {
  std::vector<StrokeElement> elements;
  std::vector<Point> path;
  std::vector<double> distances;  ///< to the nearest element, exact
  double size = 0.0;              ///< of the largest element
};

/// Nearest point over all elements.
NearestPoint over_all(const std::vector<StrokeElement>& elements, const Point& query,
                      const NearestPointOptions& options) {
  NearestPoint nearest = nearest_point(elements.front(), query, options);
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const NearestPoint found = nearest_point(elements[i], query, options);
    if (found.distance < nearest.distance) nearest = found;
  }
  return nearest;
}

std::vector<DrawnStroke> drawn_strokes(const std::vector<StrokeQueries>& queries) {
  std::vector<DrawnStroke> strokes;
  for (const StrokeQueries& each : queries) {
    DrawnStroke stroke;
    for (const auto& element : each.elements) {
      stroke.elements.push_back(prepare_element(element));
      stroke.size = std::max(stroke.size, stroke.elements.back().size());
    }
    stroke.path = each.path;
    for (const Point& tip : stroke.path) {
      stroke.distances.push_back(over_all(stroke.elements, tip, reference).distance);
    }
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

/// Follows the pen along each stroke; `use` gets the stroke, the tick and the foot.
template <typename Use>
void follow(const std::vector<DrawnStroke>& strokes, const NearestPointOptions& options, const Use& use) {
  for (const DrawnStroke& stroke : strokes) {
    if (options.method == NearestPointMethod::tracked) {
      StrokeTracker tracker(stroke.elements, options.tolerance);
      for (std::size_t i = 0; i < stroke.path.size(); ++i) use(stroke, i, tracker.update(stroke.path[i]).foot);
    } else {
      for (std::size_t i = 0; i < stroke.path.size(); ++i) {
        use(stroke, i, over_all(stroke.elements, stroke.path[i], options));
      }
    }
  }
}

std::vector<double> tick_errors(const std::vector<DrawnStroke>& strokes, const NearestPointOptions& options) {
  std::vector<double> errors;
  follow(strokes, options, [&errors](const DrawnStroke& stroke, std::size_t i, const NearestPoint& foot) {
    errors.push_back(std::abs(foot.distance - stroke.distances[i]) / stroke.size);
  });
  return errors;
}

double tick_time(const std::vector<DrawnStroke>& strokes, const NearestPointOptions& options) {
  return seconds_of([&] {
    double sum = 0.0;
    follow(strokes, options,
           [&sum](const DrawnStroke&, std::size_t, const NearestPoint& foot) { sum += foot.parameter; });
    return sum;
  });
}

// ---- what the hand feels

/// A pen drawn along one curve: the guidance of the active element alone.
struct DrawnCurve {
  StrokeElement element;
  std::vector<Point> path;
};

/// The part of each pen path that belongs to a curve.
std::vector<DrawnCurve> drawn_curves(const std::vector<DrawnStroke>& strokes, double step) {
  std::vector<DrawnCurve> curves;
  for (const DrawnStroke& stroke : strokes) {
    double end = 0.0;
    std::size_t tick = 0;
    for (const StrokeElement& element : stroke.elements) {
      end += element.length();
      DrawnCurve curve{element, {}};
      for (; tick < stroke.path.size() && static_cast<double>(tick) * step <= end; ++tick) {
        curve.path.push_back(stroke.path[tick]);
      }
      if (element.curve() != nullptr) curves.push_back(std::move(curve));
    }
  }
  return curves;
}

/// A pen beside an arc of 90 degrees round the origin, outside it by `offset`, at constant speed.
DrawnCurve arc(double radius, double offset, double step) {
  constexpr double angle = 0.5 * std::numbers::pi;
  const double handle = 4.0 / 3.0 * std::tan(angle / 4.0) * radius;
  const std::vector<Point> points = {{radius, 0.0}, {radius, handle}, {handle, radius}, {0.0, radius}};
  DrawnCurve curve{prepare_element(points), {}};
  const double pen_radius = radius + offset;
  for (double turned = 0.0; turned <= angle; turned += step / pen_radius) {
    curve.path.push_back(pen_radius * Point(std::cos(turned), std::sin(turned)));
  }
  return curve;
}

std::vector<DrawnCurve> gentle_arcs(double step) {
  std::vector<DrawnCurve> arcs;
  for (const double radius : {0.015, 0.025, 0.040}) {
    for (const double offset : {-0.004, -0.002, -0.001, 0.001, 0.002, 0.004}) arcs.push_back(arc(radius, offset, step));
  }
  return arcs;
}

PenFeel feel(const std::vector<DrawnCurve>& curves, const NearestPointOptions& options, double stiffness) {
  PenFeel result;
  std::size_t ticks = 0, wrong = 0;
  for (const DrawnCurve& curve : curves) {
    Point last = Point::Zero();
    double parameter = 0.5;
    for (std::size_t i = 0; i < curve.path.size(); ++i) {
      const Point& tip = curve.path[i];
      const NearestPoint foot = nearest_point(curve.element, tip, options, {}, parameter);
      parameter = foot.parameter;
      const double exact = nearest_point(curve.element, tip, reference).distance;
      const Point force = attraction_force(stiffness, tip, foot.point);
      if (i > 0) result.largest_step = std::max(result.largest_step, (force - last).norm());
      last = force;
      ++ticks;
      if (!(std::abs(foot.distance - exact) <= wrong_branch * curve.element.size())) ++wrong;
    }
  }
  result.wrong = ticks > 0 ? static_cast<double>(wrong) / static_cast<double>(ticks) : 0.0;
  return result;
}

std::string setting_name(const NearestPointOptions& options) {
  char setting[32];
  if (options.method == NearestPointMethod::sampled) {
    std::snprintf(setting, sizeof setting, " %d x %d", options.samples, options.refinements);
  } else {
    std::snprintf(setting, sizeof setting, " %.0e", options.tolerance);
  }
  return method_name(options.method) + std::string(setting);
}

void require(bool holds, const char* what) {
  if (!holds) throw ValueError(std::string("nearest point trade: ") + what);
}

}  // namespace

const char* method_name(NearestPointMethod method) noexcept {
  switch (method) {
    case NearestPointMethod::exact:
      return "exact";
    case NearestPointMethod::tracked:
      return "tracked";
    case NearestPointMethod::sampled:
      return "sampled";
    case NearestPointMethod::wang2006:
      return "wang2006";
  }
  return "";
}

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

std::vector<NearestPointTrade> nearest_point_trade(std::span<const Character> characters,
                                                   const NearestPointTradeOptions& options) {
  require(options.rounds > 0, "rounds are not above 0");
  require(std::isfinite(options.stiffness) && options.stiffness > 0.0, "stiffness is not a number above 0");
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
  const std::vector<DrawnStroke> drawn = drawn_strokes(stroke_queries(characters, drawing));
  const double step = options.speed / options.rate;
  const std::vector<DrawnCurve> curves = drawn_curves(drawn, step), arcs = gentle_arcs(step);

  const std::vector<NearestPointSetting> settings = nearest_point_settings();
  // Per setting and workload; the last: ticks.
  std::vector<std::vector<Rounds>> rounds(settings.size(), std::vector<Rounds>(workloads.size() + 1));
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t w = 0; w <= workloads.size(); ++w) {
      for (std::size_t i = 0; i < settings.size(); ++i) {
        // Another one begins in each round, so that none always follows the same.
        const std::size_t s = (i + static_cast<std::size_t>(round)) % settings.size();
        const NearestPointOptions& own = settings[s].options;
        Rounds& times = rounds[s][w];
        if (w == workloads.size()) {
          times.one_by_one.push_back(tick_time(drawn, own));
        } else {
          times.one_by_one.push_back(time_of(workloads[w], own));
          times.batch.push_back(batch_time_of(workloads[w], own));
        }
      }
    }
    if (options.progress) options.progress((round + 1.0) / options.rounds);
  }

  std::vector<NearestPointTrade> trade;
  for (std::size_t s = 0; s < settings.size(); ++s) {
    const NearestPointOptions& own = settings[s].options;
    NearestPointTrade entry;
    entry.setting = settings[s];
    Pool real, hard;
    for (std::size_t w = 0; w < workloads.size(); ++w) {
      const std::vector<double> errors = errors_of(workloads[w], own);
      entry.workloads.push_back(cost(workloads[w].name, errors, rounds[s][w]));
      (is_real(workloads[w].name) ? real : hard).add(errors, rounds[s][w]);
    }
    entry.real = cost("real strokes", std::move(real.errors), real.rounds);
    entry.hard = cost("hard", std::move(hard.errors), hard.rounds);
    entry.ticks = cost("ticks along strokes", tick_errors(drawn, own), rounds[s].back());
    entry.strokes = feel(curves, own, options.stiffness);
    entry.arcs = feel(arcs, own, options.stiffness);
    trade.push_back(std::move(entry));
  }
  return trade;
}

}  // namespace calligraphy
