#include <calligraphy/judge/pen_kinematics.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/judge/pen_path.hpp>

namespace calligraphy {
namespace {

constexpr double resampling_rate = 200.0;    // [Hz]
constexpr double min_measured = 0.05;        // half a period of the band limit [s]
constexpr std::size_t max_resampled = 4096;  // points
constexpr double band_limit = 10.0;          // of the motion of a hand [Hz]
constexpr double gaussian_reach = 4.0;       // standard deviations
constexpr double peak_prominence = 0.05;     // of the peak speed
constexpr int sparc_pad_level = 4;
constexpr double sparc_threshold = 0.05;  // of the magnitude at 0 Hz

void refuse_bad_samples(std::span<const TimedPoint> samples) {
  const auto refuse = [](std::size_t i, const char* why) {
    throw ValueError("pen_down[" + std::to_string(i) + "]" + why);
  };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!samples[i].point.allFinite() || !std::isfinite(samples[i].time)) refuse(i, " is not finite");
    if (i > 0 && samples[i].time < samples[i - 1].time) refuse(i, ": its time is before the previous one");
  }
}

/// A pen-down at even steps.
struct EvenPath {
  std::vector<Point> points;
  double step = 0.0;  // [s]
};

EvenPath resampled(std::span<const TimedPoint> samples) {
  std::vector<TimedPoint> distinct;
  for (const TimedPoint& sample : samples) {
    if (!distinct.empty() && sample.time == distinct.back().time) distinct.pop_back();
    distinct.push_back({sample.point, sample.time});
  }
  const double start = distinct.front().time, duration = distinct.back().time - start;
  const double wanted = std::clamp(std::round(resampling_rate * duration), 1.0, double{max_resampled - 1});
  const auto steps = static_cast<std::size_t>(distinct.size() > 1 ? wanted : 0.0);
  EvenPath path;
  if (steps > 0) path.step = duration / static_cast<double>(steps);
  std::size_t at = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    const double time = path.step * static_cast<double>(k);
    while (at + 2 < distinct.size() && distinct[at + 1].time - start <= time) ++at;
    const TimedPoint &from = distinct[at], &to = distinct[at + 1];
    const double share = std::min((time - (from.time - start)) / (to.time - from.time), 1.0);
    path.points.push_back(from.point + share * (to.point - from.point));
  }
  path.points.push_back(distinct.back().point);
  return path;
}

/// Point i, also beyond the ends, where the path continues by point reflection about them.
Point continued(const std::vector<Point>& points, std::ptrdiff_t i) {
  const auto last = static_cast<std::ptrdiff_t>(points.size()) - 1;
  const std::ptrdiff_t period = 2 * last;
  const std::ptrdiff_t periods = (i >= 0 ? i : i - period + 1) / period, within = i - periods * period;
  const Point shift = 2.0 * static_cast<double>(periods) * (points.back() - points.front());
  if (within <= last) return points[static_cast<std::size_t>(within)] + shift;
  return 2.0 * points.back() - points[static_cast<std::size_t>(period - within)] + shift;
}

void low_pass(EvenPath& path) {
  if (path.points.size() < 3) return;  // straight and uniform, so unchanged; the step may be as short as numbers get
  const double deviation =
      std::sqrt(std::numbers::ln2) / (2.0 * std::numbers::pi * band_limit) / path.step;  // in steps
  const auto reach = static_cast<std::ptrdiff_t>(gaussian_reach * deviation);
  std::vector<double> weights;
  double sum = 0.0;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const double deviations = static_cast<double>(k) / deviation;
    sum += weights.emplace_back(std::exp(-0.5 * deviations * deviations));
  }
  std::vector<Point> smooth;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    Point& point = smooth.emplace_back(Point::Zero());
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      point += weights[static_cast<std::size_t>(k + reach)] / sum *
               continued(path.points, static_cast<std::ptrdiff_t>(i) + k);
    }
  }
  path.points = std::move(smooth);
}

/// At the ends, the central difference equals that to the only neighbour, because the path continues by point
/// reflection.
std::vector<double> speeds(const EvenPath& path) {
  std::vector<double> result;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, path.points.size() - 1);
    result.push_back((path.points[after] - path.points[before]).norm() /
                     (path.step * static_cast<double>(after - before)));
  }
  return result;
}

/// Counts maxima of at least this prominence: between two of them, and outside, the speed falls by that much.
int count_peaks(const std::vector<double>& speed, double prominence) {
  int peaks = 0;
  bool climbing = false;
  double extreme = 0.0;  // the highest since the climb began, or the lowest since the fall
  for (std::size_t i = 0; i <= speed.size(); ++i) {
    const double value = i < speed.size() ? speed[i] : 0.0;
    extreme = climbing ? std::max(extreme, value) : std::min(extreme, value);
    if (std::abs(value - extreme) < prominence) continue;
    if (climbing) ++peaks;
    climbing = !climbing;
    extreme = value;
  }
  return peaks;
}

/// Discrete Fourier transform in place, by the algorithm of Cooley and Tukey (1965); the size is a power of two.
void transform(std::vector<std::complex<double>>& values) {
  const std::size_t size = values.size();
  for (std::size_t i = 1, reversed = 0; i < size; ++i) {  // bit-reversed indices
    std::size_t digit = size / 2;
    for (; (reversed & digit) != 0; digit /= 2) reversed ^= digit;
    reversed ^= digit;
    if (i < reversed) std::swap(values[i], values[reversed]);
  }
  for (std::size_t half = 1; half < size; half *= 2) {
    for (std::size_t k = 0; k < half; ++k) {
      const auto turn = std::polar(1.0, -std::numbers::pi * static_cast<double>(k) / static_cast<double>(half));
      for (std::size_t i = k; i < size; i += 2 * half) {
        const std::complex<double> odd = turn * values[i + half];
        values[i + half] = values[i] - odd;
        values[i] += odd;
      }
    }
  }
}

double spectral_arc_length(const std::vector<double>& speed, double step) {
  const std::size_t padded = std::bit_ceil(speed.size()) << sparc_pad_level;
  const double frequency_step = 1.0 / (step * static_cast<double>(padded));
  std::vector<std::complex<double>> spectrum(speed.begin(), speed.end());
  spectrum.resize(padded);
  transform(spectrum);
  std::vector<double> magnitudes;
  std::size_t last = 0;
  for (std::size_t k = 0; k <= padded / 2 && static_cast<double>(k) * frequency_step <= band_limit; ++k) {
    magnitudes.push_back(std::abs(spectrum[k]) / std::abs(spectrum[0]));
    if (magnitudes.back() >= sparc_threshold) last = k;
  }
  double arc = 0.0;
  for (std::size_t k = 1; k <= last; ++k) {
    arc += std::hypot(1.0 / static_cast<double>(last), magnitudes[k] - magnitudes[k - 1]);
  }
  return -arc;
}

}  // namespace

PenKinematics pen_kinematics(std::span<const TimedPoint> pen_down) {
  refuse_bad_samples(pen_down);
  PenKinematics result;
  if (pen_down.empty()) return result;
  EvenPath path = resampled(pen_down);
  low_pass(path);
  result.begin = pen_down.front().time;
  result.duration = pen_down.back().time - pen_down.front().time;
  result.path_length = path_length(path.points);
  if (result.duration < min_measured) return result;
  const std::vector<double> speed = speeds(path);
  result.mean_speed = result.path_length / result.duration;
  result.peak_speed = *std::max_element(speed.begin(), speed.end());
  if (!(result.peak_speed > 0.0)) return result;
  result.velocity_peaks = count_peaks(speed, peak_prominence * result.peak_speed);
  result.smoothness = spectral_arc_length(speed, path.step);
  return result;
}

}  // namespace calligraphy
