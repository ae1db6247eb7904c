// Cost of a servo tick: percentiles over a whole written page, and the cost of each stage.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include <calligraphy/c/calligraphy.h>
#include <calligraphy/calligraphy.hpp>
#include <calligraphy/devices/detail/flush_denormals.hpp>

#include "render/energy_budget.hpp"
#include "render/force_limiter.hpp"
#include "render/thermal_budget.hpp"
#include "timing.hpp"

namespace {

using namespace calligraphy;
using namespace timing;

/// Four characters as a guided novice wrote them on a Desktop, sampled by a clock that jitters by 20 us.
struct WrittenPage {
  PracticePage page;
  MotionMapping mapping;
  Capabilities capabilities;
  std::vector<DeviceState> states;

  WrittenPage() {
    std::vector<Character> text;
    for (const char32_t code : {U'北', U'京', U'航', U'空'}) text.push_back(*built_in_characters().find(code));
    page = lay_out(text).at(0);
    mapping = upright_page(page.width, page.height);
    SessionOptions session;
    session.device = device_profile("desktop");
    session.renderer = RendererOptions::for_device(session.device);
    session.skill = WriterSkill::novice();
    capabilities = session.device;
    states = device_states(write_page(page, session), mapping);
    Random random(1);
    for (DeviceState& state : states) state.time += random.between(-20e-6, 20e-6);
  }
};

const WrittenPage& written_page() {
  static const WrittenPage page;
  return page;
}

/// The first curve of 北 on a page, and pen tips within 12 mm of it.
struct CurveQueries {
  StrokeElement element;
  std::vector<Point> tips;

  CurveQueries() {
    const Stroke curve = strokes(*built_in_characters().find(U'北'))[3];
    std::vector<Point> points;
    for (const Point& point : curve.control_points) points.push_back(Placement().to_page(point));
    element = prepare_element(points);
    Random random(1);
    for (int i = 0; i < 4096; ++i) {
      const double along = random.next();
      const double x = random.between(-0.012, 0.012);
      tips.push_back(element.point(along) + Point(x, random.between(-0.012, 0.012)));
    }
  }
};

const CurveQueries& curve_queries() {
  static const CurveQueries queries;
  return queries;
}

template <NearestPointMethod method, int digits>
RendererOptions with_method() {
  RendererOptions options = RendererOptions::for_device(written_page().capabilities);
  options.nearest.method = method;
  options.nearest.tolerance = std::pow(10.0, -digits);
  return options;
}

/// HapticRenderer::update over the whole page, each tick timed individually; `clock_ns` is the overhead of the timing.
void whole_tick(benchmark::State& state, RendererOptions (*options)()) {
  const WrittenPage& written = written_page();
  HapticRenderer renderer(written.page.characters, written.mapping, written.capabilities, options());
  std::vector<double> times;
  std::vector<double> clock;
  times.reserve(1 << 20);
  clock.reserve(1 << 20);
  for (auto _ : state) {
    renderer.restart();
    double sum = 0.0;
    for (const DeviceState& sample : written.states) {
      const auto start = Clock::now();
      benchmark::DoNotOptimize(renderer.update(sample).force.data());
      const auto middle = Clock::now();
      const auto end = Clock::now();
      times.push_back(nanoseconds(middle - start));
      clock.push_back(nanoseconds(end - middle));
      sum += times.back();
    }
    state.SetIterationTime(1e-9 * sum);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(times.size()));
  state.counters["p50_ns"] = percentile(times, 0.5);
  state.counters["p99_ns"] = percentile(times, 0.99);
  state.counters["p999_ns"] = percentile(times, 0.999);
  state.counters["max_ns"] = times.back();
  state.counters["clock_ns"] = percentile(clock, 0.5);
}
BENCHMARK_CAPTURE(whole_tick, default_rules, with_method<NearestPointMethod::tracked, 9>)->UseManualTime();
BENCHMARK_CAPTURE(whole_tick, nearest_exact, with_method<NearestPointMethod::exact, 9>)->UseManualTime();
BENCHMARK_CAPTURE(whole_tick, nearest_sampled, with_method<NearestPointMethod::sampled, 9>)->UseManualTime();
BENCHMARK_CAPTURE(whole_tick, nearest_wang2006_1e_3, with_method<NearestPointMethod::wang2006, 3>)->UseManualTime();
BENCHMARK_CAPTURE(whole_tick, nearest_wang2006_1e_6, with_method<NearestPointMethod::wang2006, 6>)->UseManualTime();
BENCHMARK_CAPTURE(whole_tick, nearest_wang2006_1e_9, with_method<NearestPointMethod::wang2006, 9>)->UseManualTime();
BENCHMARK_CAPTURE(whole_tick, all_rules_wang2006, RendererOptions::wang2006)->UseManualTime();

/// Cost of a stage: the whole page in one piece, without a clock inside, alternating with the default.
void tick_with(benchmark::State& state, void (*add)(RendererOptions&)) {
  const WrittenPage& written = written_page();
  RendererOptions options = RendererOptions::for_device(written.capabilities);
  add(options);
  HapticRenderer renderer(written.page.characters, written.mapping, written.capabilities, options);
  HapticRenderer plain(written.page.characters, written.mapping, written.capabilities,
                       RendererOptions::for_device(written.capabilities));
  const auto run = [&](HapticRenderer& one) {
    one.restart();
    const auto start = Clock::now();
    for (const DeviceState& sample : written.states) benchmark::DoNotOptimize(one.update(sample).force.data());
    return nanoseconds(Clock::now() - start) / static_cast<double>(written.states.size());
  };
  std::vector<double> with, added;
  for (auto _ : state) {
    with.push_back(run(renderer));
    added.push_back(with.back() - run(plain));
  }
  state.counters["ns_per_tick"] = percentile(with, 0.5);
  state.counters["added_ns"] = percentile(added, 0.5);
}
void nothing(RendererOptions&) {}
void friction(RendererOptions& options) { options.paper.friction.coefficient = 0.15; }
void saturate(RendererOptions& options) { options.guidance.force = saturating_guidance; }
/// The default law, as an author would write it.
void own_law(RendererOptions& options) {
  const auto spring = [](const GuidanceInput& in) -> Point { return in.stiffness * in.share * (in.target - in.tip); };
  options.guidance.force = {spring, {.stiffness = options.guidance.stiffness}};
}
void guidance_to_start(RendererOptions& options) { options.guidance.to_start = true; }
void assist_policy(RendererOptions& options) { options.guidance.assist.enabled = true; }
void energy_budget(RendererOptions& options) { options.energy.budget = 0.1; }
void thermal_budget(RendererOptions& options) { options.limits.thermal_time_constant = 10.0; }
void max_standstill(RendererOptions& options) { options.limits.max_standstill = 0.5; }
void everything(RendererOptions& options) { options = RendererOptions::everything(written_page().capabilities); }
BENCHMARK_CAPTURE(tick_with, nothing_added, nothing);
BENCHMARK_CAPTURE(tick_with, friction, friction);
BENCHMARK_CAPTURE(tick_with, saturating_guidance, saturate);
BENCHMARK_CAPTURE(tick_with, own_law, own_law);
BENCHMARK_CAPTURE(tick_with, guidance_to_start, guidance_to_start);
BENCHMARK_CAPTURE(tick_with, assist_policy, assist_policy);
BENCHMARK_CAPTURE(tick_with, energy_budget, energy_budget);
BENCHMARK_CAPTURE(tick_with, thermal_budget, thermal_budget);
BENCHMARK_CAPTURE(tick_with, max_standstill, max_standstill);
BENCHMARK_CAPTURE(tick_with, everything, everything);

/// Cost of the decisions of a lesson, which is looked at between pieces of 16 ticks, alternating with the renderer alone.
void tick_of_a_lesson(benchmark::State& state) {
  const WrittenPage& written = written_page();
  LessonOptions options;
  options.renderer = RendererOptions::for_device(written.capabilities);
  HapticRenderer plain(written.page.characters, written.mapping, written.capabilities, options.renderer);
  std::vector<double> with, added;
  for (auto _ : state) {
    Lesson lesson({written.page}, written.capabilities, options);
    plain.restart();
    double sum = 0.0, alone = 0.0;
    for (std::size_t begin = 0; begin + 16 <= written.states.size(); begin += 16) {
      const std::span piece(&written.states[begin], 16);
      const auto start = Clock::now();
      for (const DeviceState& sample : piece) benchmark::DoNotOptimize(lesson.update(sample).force.data());
      const auto middle = Clock::now();
      for (const DeviceState& sample : piece) benchmark::DoNotOptimize(plain.update(sample).force.data());
      sum += nanoseconds(middle - start);
      alone += nanoseconds(Clock::now() - middle);
      benchmark::DoNotOptimize(lesson.look().accepted);
    }
    const auto ticks = static_cast<double>(written.states.size());
    with.push_back(sum / ticks);
    added.push_back((sum - alone) / ticks);
  }
  state.counters["ns_per_tick"] = percentile(with, 0.5);
  state.counters["added_ns"] = percentile(added, 0.5);
}
BENCHMARK(tick_of_a_lesson);

/// Cost of a call through the C interface: the whole page in one piece, alternating with C++.
void tick_through_c(benchmark::State& state) {
  const WrittenPage& written = written_page();
  HapticRenderer plain(written.page.characters, written.mapping, written.capabilities,
                       RendererOptions::for_device(written.capabilities));
  calligraphy_set* set = nullptr;
  calligraphy_page* page = nullptr;
  calligraphy_renderer* renderer = nullptr;
  calligraphy_capabilities capabilities = {};
  capabilities.size = sizeof capabilities;
  bool ok = calligraphy_set_built_in(&set) == CALLIGRAPHY_OK;
  ok = ok && calligraphy_page_lay_out(set, "北京航空", nullptr, nullptr, &page) == CALLIGRAPHY_OK;
  ok = ok && calligraphy_device_profile("desktop", &capabilities) == CALLIGRAPHY_OK;
  ok = ok && calligraphy_renderer_create(page, nullptr, &capabilities, nullptr, &renderer) == CALLIGRAPHY_OK;
  std::vector<calligraphy_device_state> states;
  for (const DeviceState& from : written.states) {
    calligraphy_device_state& to = states.emplace_back();
    to.size = sizeof to;
    to.time = from.time;
    std::copy_n(from.position.data(), 3, to.position);
  }
  std::vector<double> in_c, added;
  calligraphy_tick tick = {};
  tick.size = sizeof tick;
  for (auto _ : state) {
    ok = ok && calligraphy_renderer_restart(renderer) == CALLIGRAPHY_OK;
    auto start = Clock::now();
    for (const calligraphy_device_state& sample : states) {
      ok &= calligraphy_renderer_update(renderer, &sample, &tick) == CALLIGRAPHY_OK;
      benchmark::DoNotOptimize(tick.force);
    }
    in_c.push_back(nanoseconds(Clock::now() - start) / static_cast<double>(states.size()));
    plain.restart();
    start = Clock::now();
    for (const DeviceState& sample : written.states) benchmark::DoNotOptimize(plain.update(sample).force.data());
    added.push_back(in_c.back() - nanoseconds(Clock::now() - start) / static_cast<double>(states.size()));
  }
  for (void* handle : {static_cast<void*>(renderer), static_cast<void*>(page), static_cast<void*>(set)}) {
    ok &= calligraphy_free(handle) == CALLIGRAPHY_OK;
  }
  const bool same = std::equal(tick.force, tick.force + 3, plain.last().force.data());
  if (!ok || !same) state.SkipWithError("the tick through C is another one");
  state.counters["ns_per_tick"] = percentile(in_c, 0.5);
  state.counters["added_ns"] = percentile(added, 0.5);
}
BENCHMARK(tick_through_c);

/// A pen whose distances are all denormal numbers, and one with the same motion in millimetres, alternating in blocks
/// of ticks; once as in any thread, once with denormals flushed.
void denormal_ticks(benchmark::State& state, bool flush) {
  RendererOptions options = RendererOptions::everything(written_page().capabilities);
  const StrokeInput heng{1, {{0.0, 0.0}, {1.0, 0.0}}, {}};
  const std::vector<PlacedCharacter> page = {{make_character(U'一', std::span(&heng, 1)), {{0.0, 0.0}, 0.04}}};
  HapticRenderer usual(page, {}, written_page().capabilities, options);
  HapticRenderer denormal(page, {}, written_page().capabilities, options);
  const auto run = [](HapticRenderer& renderer, double unit) {
    const auto start = Clock::now();
    for (int i = 0; i < 1000; ++i) {
      DeviceState sample;
      sample.time = 0.001 * i;
      sample.position = unit * Eigen::Vector3d(i % 7, i % 5 - 2, -(i % 3) - 0.5);
      benchmark::DoNotOptimize(renderer.update(sample).force.data());
    }
    return nanoseconds(Clock::now() - start);
  };
  std::optional<detail::FlushDenormals> as_a_servo_thread;
  if (flush) as_a_servo_thread.emplace();
  std::vector<double> ratios;
  for (auto _ : state) {
    const double reference = run(usual, 1e-4);
    ratios.push_back(run(denormal, 1e-311) / reference);
  }
  state.counters["ratio_p50"] = percentile(ratios, 0.5);
}
BENCHMARK_CAPTURE(denormal_ticks, as_any_thread, false);
BENCHMARK_CAPTURE(denormal_ticks, flushed, true);

void stage_motion_mapping(benchmark::State& state) {
  const WrittenPage& written = written_page();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(written.mapping.to_page(written.states[i].position));
    i = i + 1 < written.states.size() ? i + 1 : 0;
  }
}
BENCHMARK(stage_motion_mapping);

void stage_active_stroke_load(benchmark::State& state) {
  const Character& character = *built_in_characters().find(U'北');
  const std::vector<Stroke> all = strokes(character);
  ActiveStroke active;
  std::size_t i = 0;
  for (auto _ : state) {
    active.load(all[i], {});
    benchmark::DoNotOptimize(active);
    i = (i + 1) % all.size();
  }
}
BENCHMARK(stage_active_stroke_load);

void stage_constraint_share(benchmark::State& state, Rules rules) {
  const CurveQueries& queries = curve_queries();
  constexpr double em = 0.04;  // [m]
  std::vector<NearestPoint> closest_points;
  for (const Point& tip : queries.tips) closest_points.push_back(nearest_point(queries.element, tip));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(guidance_weight({}, em, queries.element, queries.tips[i], closest_points[i], rules));
    i = (i + 1) % closest_points.size();
  }
}
BENCHMARK_CAPTURE(stage_constraint_share, tube, Rules::revised);
BENCHMARK_CAPTURE(stage_constraint_share, wang2006, Rules::wang2006);

void stage_limiter(benchmark::State& state) {
  ForceLimiter limiter{0.1, 0.4, 7.9};
  const CurveQueries& queries = curve_queries();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  std::size_t i = 0;
  for (auto _ : state) {
    const Point target = 1e3 * queries.tips[i];
    force = limiter.next(force, {target.x(), target.y(), 0.5});
    benchmark::DoNotOptimize(force.data());
    i = (i + 1) % queries.tips.size();
  }
}
BENCHMARK(stage_limiter);

/// Not a time: object sizes, recorded with the times.
void bytes_per_object(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(sizeof(HapticTick));
  state.counters["EnergyBudget"] = sizeof(EnergyBudget);
  state.counters["ThermalBudget"] = sizeof(ThermalBudget);
  state.counters["PaperFriction"] = sizeof(PaperFriction);
  state.counters["ActiveStroke"] = sizeof(ActiveStroke);
  state.counters["LineElement"] = sizeof(detail::LineElement);
  state.counters["CurveElement"] = sizeof(detail::CurveElement);
  state.counters["HapticTick"] = sizeof(HapticTick);
  state.counters["DeviceState"] = sizeof(DeviceState);
  state.counters["RecordedSample"] = sizeof(RecordedSample);
}
BENCHMARK(bytes_per_object)->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
