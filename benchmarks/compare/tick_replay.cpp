// Replays recorded pens through HapticRenderer::update, for compare.py, which runs this program on two trees in turn.
// It is compiled on both, so it uses only what old trees have too.
//
// tick_replay record FILE [NOISE STEP]   writes the pens, with more noise and encoder steps [um]
// tick_replay count FILE OPTIONS         replays them once, for callgrind, which counts within `measured`
// tick_replay trace FILE OPTIONS TICKS   replays so many, for lackey, between `tick_begins` and `tick_ends`
// tick_replay serve FILE                 answers commands on standard input, a line each: see serve()
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <calligraphy/calligraphy.hpp>

#include "../timing.hpp"

namespace {

using namespace calligraphy;
using namespace timing;

/// Mean of the middle half: finer than the steps of a clock, and without outliers. Sorts `values`.
double middle(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const auto quarter = static_cast<std::ptrdiff_t>(values.size() / 4);
  const auto first = values.begin() + quarter, last = values.end() - quarter;
  return std::accumulate(first, last, 0.0) / static_cast<double>(last - first);
}

struct Sample {
  double time;
  Eigen::Vector3d position;  ///< device axes [m]
};
using Pen = std::vector<Sample>;

Capabilities device() { return device_profile("desktop"); }

PracticePage written_page() {
  std::vector<Character> text;
  for (const char32_t code : {U'永', U'空', U'木', U'水'}) text.push_back(*built_in_characters().find(code));
  return lay_out(text).at(0);
}

/// Guided writers at an encoder with steps of 23 um, sampled by a clock that jitters by 20 us. Noise [m] and a coarser
/// encoder [m] are added.
std::vector<Pen> record_pens(double noise, double step) {
  const PracticePage page = written_page();
  const MotionMapping mapping = upright_page(page.width, page.height);
  std::vector<Pen> pens;
  Random random(1);
  for (int seed = 1; seed <= 4; ++seed) {
    SessionOptions session;
    session.device = device();
    session.renderer = RendererOptions::for_device(session.device);
    session.skill = WriterSkill::skilled();
    session.skill.tremor = 0.0002;
    session.seed = static_cast<std::uint64_t>(seed);
    Pen pen;
    for (const DeviceState& state : device_states(write_page(page, session), mapping)) {
      Sample sample{state.time + random.between(-20e-6, 20e-6), state.position};
      for (double& x : sample.position) {
        x += noise * random.normal();
        if (step > 0.0) x = step * std::round(x / step);
      }
      pen.push_back(sample);
    }
    pens.push_back(pen);
  }
  return pens;
}

void write_pens(const std::string& file, const std::vector<Pen>& pens) {
  std::ofstream out(file, std::ios::binary);
  for (const Pen& pen : pens) {
    const std::size_t size = pen.size();
    out.write(reinterpret_cast<const char*>(&size), sizeof size);
    out.write(reinterpret_cast<const char*>(pen.data()), static_cast<std::streamsize>(size * sizeof(Sample)));
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

std::vector<Pen> read_pens(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<Pen> pens;
  std::size_t size = 0;
  while (in.read(reinterpret_cast<char*>(&size), sizeof size)) {
    pens.emplace_back(size);
    in.read(reinterpret_cast<char*>(pens.back().data()), static_cast<std::streamsize>(size * sizeof(Sample)));
  }
  if (pens.empty()) throw std::runtime_error("cannot read " + file);
  return pens;
}

/// The guidance law of everything(), for trees where it is an object and for those before.
template <class Options>
void saturate(Options& options) {
  const auto all = Options::everything(device());
  if constexpr (requires { options.guidance.force; }) {
    options.guidance.force = all.guidance.force;
  } else if constexpr (requires { options.guidance.law; }) {
    options.guidance.law = all.guidance.law;
  } else {
    options.guidance = all.guidance;
  }
}

/// One name of `options_of`, for trees whose options are in groups and for those before.
template <class Options>
bool set(Options& options, const std::string& name) {
  if constexpr (requires { options.guidance.stiffness; }) {
    if (name == "exact") options.nearest.method = NearestPointMethod::exact;
    if (name == "friction") options.paper.friction.coefficient = 0.15;
    if (name == "saturating") saturate(options);
    if (name == "guide_to_start") options.guidance.to_start = true;
    if (name == "assist") options.guidance.assist.enabled = true;
    if (name == "budget") options.energy.budget = 0.1;
    if (name == "thermal") options.limits.thermal_time_constant = 10.0;
  } else {
    if (name == "exact") options.stroke.nearest.method = NearestPointMethod::exact;
    if (name == "friction") options.friction.coefficient = 0.15;
    if (name == "saturating") saturate(options);
    if (name == "guide_to_start") options.guide_to_start = true;
    if (name == "assist") options.assist.enabled = true;
    if (name == "budget") options.energy_budget = 0.1;
    if (name == "thermal") options.thermal_time_constant = 10.0;
  }
  const auto names = {"exact", "friction", "saturating", "guide_to_start", "assist", "budget", "thermal"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Names joined by +: "everything+exact".
RendererOptions options_of(const std::string& names) {
  RendererOptions options = RendererOptions::for_device(device());
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, '+');) {
    if (name == "default") {
    } else if (name == "everything") {
      options = RendererOptions::everything(device());
    } else if (name == "wang2006") {
      options = RendererOptions::wang2006();
    } else if (!set(options, name)) {
      throw std::runtime_error("no such options: " + name);
    }
  }
  return options;
}

class Replay {
 public:
  Replay(const std::string& file, const std::string& options)
      : pens_(read_pens(file)),
        page_(written_page()),
        renderer_(page_.characters, upright_page(page_.width, page_.height), device(), options_of(options)) {
    for (const Pen& pen : pens_) ticks_ += pen.size();
  }

  std::size_t ticks() const { return ticks_; }
  double per_tick(double sum) const { return sum / static_cast<double>(ticks_); }

  /// Calls `update` with each sample, the force at work being the one sent last.
  template <typename Update>
  void run(const Update& update) {
    for (const Pen& pen : pens_) run(pen, update);
  }
  template <typename Update>
  void run(const Pen& pen, const Update& update) {
    renderer_.restart();
    DeviceState state;
    state.velocity.setZero();
    state.force.setZero();
    for (const Sample& sample : pen) {
      state.time = sample.time;
      state.position = sample.position;
      state.force = update(renderer_, state).force;
    }
  }
  const Pen& first() const { return pens_.front(); }

  int finished_strokes() {
    int finished = 0;
    run([&](HapticRenderer& renderer, const DeviceState& state) -> const HapticTick& {
      const HapticTick& tick = renderer.update(state);
      finished += has_event(tick.events, TickEvent::stroke_finished) ? 1 : 0;
      return tick;
    });
    return finished;
  }

  /// Each tick timed, the clock's own time taken off; one value per tick. Before a tick for which `pause` is true, the
  /// caches are emptied.
  template <typename Pause>
  std::vector<double> times(const Pause& pause) {
    std::vector<double> result;
    result.reserve(ticks_);
    run([&](HapticRenderer& renderer, const DeviceState& state) -> const HapticTick& {
      if (pause(result.size())) empty_caches();
      const auto start = Clock::now();
      const HapticTick& tick = renderer.update(state);
      result.push_back(nanoseconds(Clock::now() - start) - clock_);
      return tick;
    });
    return result;
  }

 private:
  void empty_caches() {
    static std::vector<std::uint64_t> memory((64 << 20) / sizeof(std::uint64_t), 1);
    for (std::size_t i = 0; i < memory.size(); i += 8) memory[i] += memory[(i + 8) % memory.size()];
  }

  static double clock_time() {
    std::vector<double> times;
    for (int i = 0; i < 10000; ++i) {
      const auto start = Clock::now();
      times.push_back(nanoseconds(Clock::now() - start));
    }
    return middle(times);
  }

  std::vector<Pen> pens_;
  PracticePage page_;
  HapticRenderer renderer_;
  std::size_t ticks_ = 0;
  double clock_ = clock_time();  ///< [ns]
};

constexpr auto update = [](HapticRenderer& renderer, const DeviceState& state) -> const HapticTick& {
  return renderer.update(state);
};

/// Every so many ticks, one is measured with cold caches.
constexpr std::size_t cold_every = 1009;

std::string three_percentiles(std::vector<double>& times) {
  std::ostringstream text;
  for (const double share : {0.5, 0.99, 0.999}) text << percentile(times, share) << ' ';
  return text.str();
}

/// Of each tick, over the rounds so far.
std::vector<double> means(const std::vector<std::vector<float>>& rounds) {
  std::vector<double> result;
  for (std::size_t tick = 0; tick < rounds.front().size(); ++tick) {
    std::vector<double> times;
    for (const std::vector<float>& round : rounds) times.push_back(round[tick]);
    result.push_back(middle(times));
  }
  return result;
}

/// COMMAND OPTIONS: `strokes` (number of strokes finished), `whole` (ns per tick, no clock inside), `ticks` (p50, p99
/// and p99.9 of this round) and `means` (of the means of each tick over the rounds), `cold` (median of the ticks with
/// cold caches, this round) and `mean_cold`, `forces` (writes the result of every tick to the file named third).
void serve(const std::string& file) {
  std::map<std::string, Replay> replays;
  std::map<std::string, std::vector<std::vector<float>>> hot, cold;
  std::string line, command, options, output;
  while (std::getline(std::cin, line)) {
    std::istringstream(line) >> command >> options >> output;
    Replay& replay = replays.try_emplace(options, file, options).first->second;
    if (command == "strokes") {
      std::cout << replay.finished_strokes() << ' ' << replay.ticks();
    } else if (command == "whole") {
      replay.run(replay.first(), update);  // warms up
      const auto start = Clock::now();
      replay.run(update);
      std::cout << replay.per_tick(nanoseconds(Clock::now() - start));
    } else if (command == "ticks") {
      std::vector<double> times = replay.times([](std::size_t) { return false; });
      hot[options].emplace_back(times.begin(), times.end());
      std::cout << three_percentiles(times);
    } else if (command == "means") {
      std::vector<double> times = means(hot.at(options));
      std::cout << three_percentiles(times);
    } else if (command == "cold") {
      const std::vector<double> all = replay.times([](std::size_t tick) { return tick % cold_every == 0; });
      std::vector<double> times;
      for (std::size_t i = 0; i < all.size(); i += cold_every) times.push_back(all[i]);
      cold[options].emplace_back(times.begin(), times.end());
      std::cout << percentile(times, 0.5);
    } else if (command == "mean_cold") {
      std::vector<double> times = means(cold.at(options));
      std::cout << percentile(times, 0.5);
    } else if (command == "forces") {
      std::ofstream out(output, std::ios::binary);
      replay.run([&](HapticRenderer& renderer, const DeviceState& state) -> const HapticTick& {
        const HapticTick& tick = renderer.update(state);
        const double values[] = {tick.force.x(),
                                 tick.force.y(),
                                 tick.force.z(),
                                 static_cast<double>(tick.state),
                                 static_cast<double>(tick.events),
                                 static_cast<double>(tick.hint),
                                 static_cast<double>(tick.stroke)};
        out.write(reinterpret_cast<const char*>(values), sizeof values);
        return tick;
      });
      if (!out.flush()) throw std::runtime_error("cannot write " + output);
    } else {
      throw std::runtime_error("no such command: " + line);
    }
    std::cout << std::endl;
  }
}

}  // namespace

/// The name at which callgrind toggles collection.
extern "C" __attribute__((noinline)) void measured(Replay& replay) { replay.run(update); }

/// Between these, lackey's addresses are those of a tick.
extern "C" __attribute__((noinline)) void tick_begins() { asm volatile(""); }
extern "C" __attribute__((noinline)) void tick_ends() { asm volatile(""); }

/// Prints a line with the state and the events after each tick, and leaves once there were so many.
[[noreturn]] void trace(Replay& replay, std::size_t ticks) {
  replay.run([&](HapticRenderer& renderer, const DeviceState& state) -> const HapticTick& {
    if (ticks-- == 0) std::exit(0);
    tick_begins();
    const HapticTick& tick = renderer.update(state);
    tick_ends();
    std::fprintf(stderr, "tick %d %d\n", static_cast<int>(tick.state), static_cast<int>(tick.events));
    return tick;
  });
  std::exit(0);
}

int main(int argc, char** argv) try {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const std::string command = arguments.empty() ? "" : arguments[0];
  if (command == "record" && (arguments.size() == 2 || arguments.size() == 4)) {
    const bool is_given = arguments.size() == 4;
    write_pens(arguments[1], record_pens(is_given ? 1e-6 * std::stod(arguments[2]) : 0.0,
                                         is_given ? 1e-6 * std::stod(arguments[3]) : 0.0));
  } else if (command == "count" && arguments.size() == 3) {
    Replay replay(arguments[1], arguments[2]);
    measured(replay);
    std::printf("%zu\n", replay.ticks());
  } else if (command == "trace" && arguments.size() == 4) {
    Replay replay(arguments[1], arguments[2]);
    trace(replay, std::stoul(arguments[3]));
  } else if (command == "serve" && arguments.size() == 2) {
    serve(arguments[1]);
  } else {
    throw std::runtime_error(
        "usage: tick_replay record FILE [NOISE STEP] | count FILE OPTIONS | trace FILE OPTIONS TICKS | serve FILE");
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "tick_replay: %s\n", error.what());
  return 1;
}
