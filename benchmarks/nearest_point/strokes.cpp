// Whole strokes at 1 kHz: the nearest point over all elements at each tick.
#include <algorithm>
#include <cmath>
#include <iterator>

#include <calligraphy/base/random.hpp>
#include <calligraphy/model/bezier.hpp>
#include <calligraphy/model/character_list.hpp>

#include "experiments/stroke_queries.hpp"
#include "runs.hpp"

namespace nearest_point_benchmark {
namespace {

using calligraphy::StrokeQueries;

struct StrokeSet {
  std::string name;
  std::vector<StrokeQueries> strokes;
};

ControlPoints as_cubic(const ControlPoints& points) {
  if (points.size() == 4) return points;
  const auto cubic = calligraphy::Bezier<1>{{points[0], points[1]}}.elevated().elevated();
  return {cubic.control_points.begin(), cubic.control_points.end()};
}

/// As a real encoder gives it: with noise [m], in steps [m].
std::vector<StrokeQueries> sampled(std::vector<StrokeQueries> strokes, double noise, double step) {
  calligraphy::Random random(1);
  for (StrokeQueries& stroke : strokes) {
    for (Point& tip : stroke.path) {
      for (double& x : tip) {
        x += noise * random.normal();
        if (step > 0.0) x = step * std::round(x / step);
      }
    }
  }
  return strokes;
}

/// Most elements of Chinese characters are lines, which are cheap with any method. Therefore also only the strokes with
/// a curve, and every line written as a cubic, as drawing programs do: all strokes, and the compound ones.
std::vector<StrokeSet> stroke_sets(int characters) {
  std::span<const calligraphy::Character> written = calligraphy::built_in_characters().characters;
  if (characters > 0) written = written.first(std::min(written.size(), static_cast<std::size_t>(characters)));
  std::vector<StrokeSet> sets = {{"strokes", calligraphy::stroke_queries(written)}, {"strokes with a curve", {}}};
  std::copy_if(sets[0].strokes.begin(), sets[0].strokes.end(), std::back_inserter(sets[1].strokes),
               [](const StrokeQueries& stroke) {
                 return std::any_of(stroke.elements.begin(), stroke.elements.end(),
                                    [](const ControlPoints& points) { return points.size() == 4; });
               });
  sets.push_back({"strokes of cubics", sets[0].strokes});
  for (StrokeQueries& stroke : sets[2].strokes) {
    for (ControlPoints& points : stroke.elements) points = as_cubic(points);
  }
  sets.push_back({"compound strokes of cubics", {}});
  std::copy_if(sets[2].strokes.begin(), sets[2].strokes.end(), std::back_inserter(sets[3].strokes),
               [](const StrokeQueries& stroke) { return stroke.elements.size() > 1; });
  sets.push_back({"compound strokes of cubics with noise of 10 um", sampled(sets[3].strokes, 10e-6, 0.0)});
  sets.push_back({"compound strokes of cubics in steps of 55 um", sampled(sets[3].strokes, 0.0, 55e-6)});
  return sets;
}

void follow_all(Method& method, const StrokeSet& set, std::span<Answer> answers) {
  std::size_t element = 0, tick = 0;
  for (const StrokeQueries& stroke : set.strokes) {
    const std::size_t last = element + stroke.elements.size();
    method.follow(element, last, stroke.path, answers.subspan(tick, stroke.path.size()));
    element = last;
    tick += stroke.path.size();
  }
}

void run_strokes(benchmark::State& state, const StrokeSet& set, const RunOptions& options,
                 std::vector<Measurement>& results) {
  std::vector<ControlPoints> elements;
  Reference reference;
  std::size_t ticks = 0;
  for (const StrokeQueries& stroke : set.strokes) {
    elements.insert(elements.end(), stroke.elements.begin(), stroke.elements.end());
    reference.add(stroke.elements, stroke.path, options.tick_stride);
    ticks += stroke.path.size();
  }
  const auto methods = stroke_methods();
  std::vector<Answer> answers(ticks);
  std::vector<Errors> errors;
  for (const auto& method : methods) {
    method->prepare(elements);
    follow_all(*method, set, answers);
    errors.push_back(reference.errors(answers, 1e-9));
  }
  const RoundRobin times = time_in_turn(state, methods.size(), ticks, [&](std::size_t m) {
    follow_all(*methods[m], set, answers);
    benchmark::DoNotOptimize(answers.data());
  });
  state.counters["ticks"] = static_cast<double>(ticks);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    results.push_back({set.name, methods[m]->name(), spread(times.of(m)), errors[m]});
    state.counters[methods[m]->name()] = results.back().nanoseconds.p50;
  }
}

}  // namespace

void register_strokes(const RunOptions& options, std::vector<Measurement>& results) {
  static std::vector<StrokeSet> sets;
  sets = stroke_sets(options.characters);
  for (const StrokeSet& set : sets) {
    benchmark::RegisterBenchmark(("whole strokes/" + set.name).c_str(),
                                 [&](benchmark::State& state) { run_strokes(state, set, options, results); })
        ->Iterations(options.rounds)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace nearest_point_benchmark
