#include <calligraphy/pictures/plot.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/point.hpp>

#include "base/require.hpp"
#include "gnuplot.hpp"
#include "process.hpp"
#include "svg.hpp"
#include "thinned.hpp"

namespace calligraphy {
namespace {

constexpr int plot_width = 900, plot_height = 620;         // [px]
constexpr double panel_left = 0.095, panel_right = 0.975;  // of the panels, share of the width
constexpr std::size_t buckets = 2000;                      // two points each, at most
constexpr double panel_height = 0.35;                      // share of the height
constexpr double finest_line = 0.25;                       // how far a curve may be drawn beside its values [px]

/// A time during which a stroke was being written [s].
struct Band {
  double begin;
  double end;
  int stroke;
  bool abandoned;
};

struct Signal {
  const char* name;
  std::vector<double> values;
};

struct Signals {
  std::vector<double> time;
  std::vector<Signal> curves;
  std::vector<Band> bands;
};

Signals signals_of(const Recording& recording, int character) {
  Signals signals{{}, {{"fx", {}}, {"fy", {}}, {"size", {}}, {"normal", {}}}, {}};
  bool writing = false;
  double end = 0.0;
  const double first = recording.samples.empty() ? 0.0 : recording.samples.front().time;
  for (const RecordedSample& sample : recording.samples) {
    const double time = sample.time - first;
    // The tick that finishes the last stroke may already belong to the next character.
    const bool here = sample.character == character;
    if (writing && !(here && sample.state == InteractionState::writing)) {
      signals.bands.back().end = time;
      writing = false;
    }
    // Perhaps in the air, or together with the start of the next attempt.
    const bool is_abandoned = here && has_event(sample.events, TickEvent::stroke_abandoned);
    if (is_abandoned && !signals.bands.empty()) signals.bands.back().abandoned = true;
    if (!here || !std::isfinite(time)) continue;
    if (!writing && sample.state == InteractionState::writing) {
      signals.bands.push_back({time, time, sample.stroke, false});
      writing = true;
    }
    end = time;
    const double values[] = {sample.force.x(), sample.force.y(), sample.force.head<2>().norm(), sample.force.z()};
    signals.time.push_back(time);
    for (std::size_t i = 0; i < signals.curves.size(); ++i) signals.curves[i].values.push_back(values[i]);
  }
  if (writing) signals.bands.back().end = end;
  return signals;
}

/// A range of values with a margin, which contains zero.
struct Range {
  double low, high;
};

Range range_of(std::span<const Signal> curves) {
  double low = 0.0, high = 0.0;
  for (const Signal& curve : curves) {
    for (const double value : curve.values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low == high) high = 1.0;
  const double margin = 0.06 * (high - low);
  return {low < 0.0 ? low - margin : 0.0, high > 0.0 ? high + margin : 0.0};
}

/// To a microsecond or a micronewton.
double rounded(double value) { return std::round(value * 1e6) / 1e6; }

/// The curve as a data block: the smallest and the largest sample of every bucket, so that no peak is lost, without
/// points that cannot be told from the line between their neighbours.
std::string data_block(const std::vector<double>& time, const Signal& signal, const Range& range) {
  const double width = plot_width * (panel_right - panel_left), height = plot_height * panel_height;
  const Point pixels(width / std::max(time.back() - time.front(), 1e-3), height / (range.high - range.low));
  const std::size_t bucket = std::max<std::size_t>(1, (time.size() + buckets - 1) / buckets);
  const auto& values = signal.values;
  std::vector<Point> line;
  const auto add = [&](std::size_t i) {
    if (std::isfinite(values[i])) line.push_back(pixels.cwiseProduct(Point(time[i], values[i])));
  };
  for (std::size_t begin = 0; begin < time.size(); begin += bucket) {
    std::size_t low = begin, high = begin;
    for (std::size_t i = begin; i < std::min(begin + bucket, time.size()); ++i) {
      if (!(values[i] >= values[low])) low = i;
      if (!(values[i] <= values[high])) high = i;
    }
    add(std::min(low, high));
    if (low != high) add(std::max(low, high));
  }
  std::string text = "$" + std::string(signal.name) + " << END\n";
  if (!line.empty()) line = thinned(line, finest_line);
  for (const Point& point : line) {
    const Point value = point.cwiseQuotient(pixels);
    text += number_text(rounded(value.x())) + " " + number_text(rounded(value.y())) + "\n";
  }
  return text + "END\n";
}

std::string band_objects(const std::vector<Band>& bands) {
  std::string text;
  for (const Band& band : bands) {
    text += "set object rectangle from first " + number_text(band.begin) + ", graph 0 to first " +
            number_text(band.end) + ", graph 1 behind fillstyle solid noborder fillcolor rgb '" +
            (band.abandoned ? "#e4e4e4" : "#e3ecfb") + "'\n";
  }
  return text;
}

/// Stroke numbers above the bands, without overlap.
std::string band_labels(const std::vector<Band>& bands, double begin, double end) {
  const double needed = 20.0 / (plot_width * (panel_right - panel_left)) * (end - begin);
  double last = -std::numeric_limits<double>::infinity();
  std::string text;
  for (const Band& band : bands) {
    const double middle = 0.5 * (band.begin + band.end);
    if (middle - last < needed) continue;
    last = middle;
    text += "set label '" + std::to_string(band.stroke + 1) + "' at first " + number_text(middle) +
            ", graph 1 offset 0, 0.7 center textcolor rgb '" + (band.abandoned ? "#888888" : "#2f5fb3") + "'\n";
  }
  return text;
}

std::string y_range(const Range& range) {
  return "set yrange [" + number_text(range.low) + ":" + number_text(range.high) + "]\n";
}

/// Only numbers and the words of the language vary: no text from the caller reaches gnuplot.
std::string script(const Signals& signals, const Language& language) {
  const double begin = signals.time.front();
  const double end = std::max(signals.time.back(), begin + 1e-3);
  std::string text = gnuplot::svg_terminal(plot_width, plot_height);
  const std::span<const Signal> curves(signals.curves);
  const Range in_plane = range_of(curves.first(3)), normal = range_of(curves.last(1));
  for (const Signal& signal : curves.first(3)) text += data_block(signals.time, signal, in_plane);
  text += data_block(signals.time, curves.back(), normal);
  text += "set lmargin at screen " + number_text(panel_left) + "\nset rmargin at screen " + number_text(panel_right) +
          "\n" + "set xrange [" + number_text(begin) + ":" + number_text(end) + "]\n" + band_objects(signals.bands) +
          "set grid back linetype 1 linecolor rgb '#dcdcdc' linewidth 0.5\n"
          "set border 3 linecolor rgb '#666666'\nset tics nomirror out\n"
          "set xzeroaxis linetype 1 linecolor rgb '#999999'\n";
  text +=
      "set multiplot\n"
      "set tmargin at screen 0.865\nset bmargin at screen 0.515\n"
      "set format x ''\nset label " +
      gnuplot::quoted(language.text("plot.in_plane_force")) +
      " at screen 0.022, graph 0.5 center rotate\n"
      "set key horizontal at screen 0.975, 0.942 right top samplen 2\n" +
      band_labels(signals.bands, begin, end) + y_range(in_plane) +
      "plot $size with lines linewidth 3.5 linecolor rgb '#b0b0b0' title '|F|', "
      "$fx with lines linewidth 1.3 linecolor rgb '#0072b2' title 'Fx', "
      "$fy with lines linewidth 1.3 linecolor rgb '#d55e00' title 'Fy'\n"
      "unset label\nset tmargin at screen 0.47\nset bmargin at screen 0.12\n"
      "set format x '%g'\nset xlabel " +
      gnuplot::quoted(language.text("plot.time")) + "\nunset key\nset label " +
      gnuplot::quoted(language.text("plot.normal_force")) +
      " at screen 0.022, graph 0.5 center rotate\n" + y_range(normal) +
      "plot $normal with lines linewidth 1.3 linecolor rgb '#222222' notitle\n"
      "unset multiplot\n";
  return text;
}

std::string band_caption(const std::vector<Band>& bands, const Language& language) {
  if (bands.empty()) return "";
  const bool any = std::any_of(bands.begin(), bands.end(), [](const Band& band) { return band.abandoned; });
  return language.text(any ? "plot.shaded.abandoned" : "plot.shaded");
}

}  // namespace

bool gnuplot_available() {
  try {
    return run_process({"gnuplot", "--version"}, "").exit_code == 0;
  } catch (const Error&) {
    return false;
  }
}

std::string force_plot(const Recording& recording, int character, const std::string& title, const Language& language) {
  const std::string heading = svg::clean(title);
  const Signals signals = signals_of(recording, character);
  if (signals.time.empty()) {
    throw ValueError("character " + std::to_string(character) + " is not active in any sample of the recording");
  }
  pugi::xml_document document;
  gnuplot::draw(script(signals, language), document);
  pugi::xml_node root = document.child("svg");
  root.child("title").text() = heading.c_str();
  const double size = std::min(17.0, 0.9 * plot_width / svg::text_width(heading + ".", 1.0));
  svg::add_text(root, panel_left * plot_width, 26.0, size, heading,
                {{"font-family", "sans-serif"}, {"fill", "#222222"}});
  svg::add_text(root, panel_left * plot_width, 46.0, 12.0, band_caption(signals.bands, language),
                {{"font-family", "sans-serif"}, {"fill", "#666666"}});
  return svg::to_string(document);
}

}  // namespace calligraphy
