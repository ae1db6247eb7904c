// The tradeoff of speed against accuracy, drawn by gnuplot.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>

#include <calligraphy/base/error.hpp>
#include <calligraphy/experiments/tradeoff.hpp>

#include "base/require.hpp"
#include "pictures/gnuplot.hpp"
#include "pictures/svg.hpp"

namespace calligraphy {
namespace {

constexpr double to_millimetres = 1e3;
constexpr double percent = 100.0;
constexpr double min_error = 1e-17;  ///< drawn for no error at all

constexpr const char* style =
    "set grid back linetype 1 linecolor rgb '#dcdcdc' linewidth 0.5\n"
    "set border 3 linecolor rgb '#666666'\nset tics nomirror out\n";

struct MethodStyle {
  NearestPointMethod method;
  const char* colour;
  int marker;
  const char* label;  ///< where the setting stands beside its point
  double across, up;  ///< size of a label along the axes [decades]
};
constexpr std::array methods = {
    MethodStyle{NearestPointMethod::exact, "#0072b2", 7, "right offset -0.8,-0.1", 0.3, 0.6},
    MethodStyle{NearestPointMethod::tracked, "#009e73", 13, "left offset 0.8,-0.7", 0.3, 0.6},
    MethodStyle{NearestPointMethod::sampled, "#b0578d", 5, "left rotate by 60 offset 0,0.6", 0.06, 2.0},
    MethodStyle{NearestPointMethod::wang2006, "#d55e00", 9, "left rotate by 60 offset 0,0.6", 0.06, 2.0},
};

std::string finish(const std::string& script, const char* title) {
  pugi::xml_document document;
  gnuplot::draw(script, document);
  document.child("svg").child("title").text() = title;
  return svg::to_string(document);
}

std::string block(const std::string& name, const std::string& lines) {
  return "$" + name + " << END\n" + lines + "END\n";
}

std::string point_label(const NearestPointSetting& setting) { return setting.name.substr(setting.name.find(' ') + 1); }

using Cost = NearestPointCost NearestPointTradeoff::*;

/// Where a setting is drawn.
struct Mark {
  double ns, largest, p99;
  std::vector<std::string> names;  ///< also of later settings that overlap it; empty if it overlaps an earlier one
};

bool overlap(const Mark& a, const Mark& b, const MethodStyle& method) {
  return std::abs(std::log10(a.ns / b.ns)) < method.across && std::abs(std::log10(a.largest / b.largest)) < method.up;
}

std::string label_of(const Mark& mark) {
  if (mark.names.empty()) return "";
  if (mark.names.size() == 1) return mark.names.front();
  return mark.names.front() + (mark.names.size() == 2 ? ", " : " to ") + mark.names.back();
}

/// One line per setting of the method: cost, largest error, 99 % error, label.
std::string points_of(std::span<const NearestPointTradeoff> tradeoff, const MethodStyle& method, Cost cost) {
  std::vector<Mark> marks;
  for (const NearestPointTradeoff& entry : tradeoff) {
    if (entry.setting.options.method != method.method) continue;
    const NearestPointCost& own = entry.*cost;
    const auto shown = [](double error) { return std::isfinite(error) ? std::clamp(error, min_error, 1e3) : 1e3; };
    Mark mark{own.ns, shown(own.error_worst), shown(own.error_p99), {}};
    const auto hidden_by = std::find_if(marks.begin(), marks.end(), [&](const Mark& earlier) {
      return !earlier.names.empty() && overlap(earlier, mark, method);
    });
    (hidden_by == marks.end() ? mark : *hidden_by).names.push_back(point_label(entry.setting));
    marks.push_back(std::move(mark));
  }
  std::string lines;
  for (const Mark& mark : marks) {
    lines += number_text(mark.ns) + " " + number_text(mark.largest) + " " + number_text(mark.p99) + " \"" +
             label_of(mark) + "\"\n";
  }
  return lines;
}

template <typename Entry>
std::string series(std::span<const Entry> tradeoff,
                   std::initializer_list<std::function<double(const Entry&)>> columns) {
  std::string lines;
  for (const Entry& entry : tradeoff) {
    for (const auto& column : columns) lines += number_text(column(entry)) + " ";
    lines += "\n";
  }
  return lines;
}

void require_some(std::size_t count) {
  if (count == 0) throw ValueError("tradeoff plot: there are no entries");
}

}  // namespace

std::string nearest_point_tradeoff_plot(std::span<const NearestPointTradeoff> tradeoff) {
  require_some(tradeoff.size());
  std::string text = gnuplot::svg_terminal(1180, 540) + style;
  double cheapest = tradeoff[0].real.ns, dearest = cheapest;
  for (const NearestPointTradeoff& entry : tradeoff) {
    for (const double ns : {entry.real.ns, entry.hard.ns, entry.ticks.ns}) {
      cheapest = std::min(cheapest, ns);
      dearest = std::max(dearest, ns);
    }
  }
  text +=
      "set multiplot\nset logscale xy\nset xrange [" + number_text(0.3 * cheapest) + ":" + number_text(2.0 * dearest) +
      "]\nset yrange [1e-19:1e4]\nset format y '%.0e'\nset xlabel 'median cost [ns]'\n"
      "set ytics 1e-17,1000,10\nset mytics 1\nset mxtics 1\nset xtics (10,20,50,100,200,500,1000,2000,5000,10000)\n"
      "set tmargin at screen 0.84\nset bmargin at screen 0.13\n"
      "set label 1 'above: wrong branch' at graph 0.01, first 2.5e-3 left textcolor rgb '#888888' "
      "font ',10'\nset label 2 '1e-17: no difference from the reference, exact 1e-12' at graph 0.99, first 3e-19 right "
      "textcolor rgb '#888888' font ',10'\n"
      "set arrow from graph 0, first 1e-3 to graph 1, first 1e-3 nohead linecolor rgb '#888888' dashtype 2\n";
  const auto panel = [&](const char* heading, double left, double right, Cost cost, bool key) {
    std::string plots;
    for (const MethodStyle& method : methods) {
      const std::string points = points_of(tradeoff, method, cost);
      if (points.empty()) continue;
      const std::string colour = std::string(" linecolor rgb '") + method.colour + "' ";
      const std::string name = to_string(method.method);
      text += block(name, points);
      plots += std::string(plots.empty() ? "" : ", ") + "$" + name +
               " using 1:2:3:2 with yerrorbars pointtype 0 linewidth 1" + colour + "notitle, $" + name +
               " using 1:2 with points pointtype " + std::to_string(method.marker) + " pointsize 1" + colour +
               "title '" + name + "', $" + name + " using 1:2:4 with labels " + method.label +
               " font ',10' textcolor rgb '" + method.colour + "' notitle";
    }
    text += "set lmargin at screen " + number_text(left) + "\nset rmargin at screen " + number_text(right) +
            "\nset title '" + heading + "'\n" +
            (key ? "set key horizontal at screen 0.98, 0.995 right top samplen 1\n" : "unset key\n") + "plot " + plots +
            "\n";
  };
  text += "set ylabel 'distance error [curve sizes]: maximum, bar down to p99'\n";
  panel("queries around real strokes", 0.075, 0.36, &NearestPointTradeoff::real, true);
  text += "unset ylabel\nset format y ''\n";
  panel("hard workloads", 0.385, 0.67, &NearestPointTradeoff::hard, false);
  panel("a pen along whole strokes, per tick", 0.695, 0.98, &NearestPointTradeoff::ticks, false);
  return finish(text + "unset multiplot\n", "Nearest point: cost against error");
}

std::string servo_rate_tradeoff_plot(std::span<const ServoRateTradeoff> tradeoff) {
  require_some(tradeoff.size());
  using Entry = ServoRateTradeoff;
  const std::string rows = series<Entry>(
      tradeoff, {[](const Entry& e) { return e.rate; }, [](const Entry& e) { return e.penetration * to_millimetres; },
                 [](const Entry& e) { return e.hard_penetration * to_millimetres; },
                 [](const Entry& e) { return e.path_error * to_millimetres; },
                 [](const Entry& e) { return e.force_step; }, [](const Entry& e) { return e.hard_force_step; },
                 [](const Entry& e) { return e.loop_stiffness; }, [](const Entry& e) { return e.unlimited_stiffness; },
                 [](const Entry& e) { return e.held_stiffness; }, [](const Entry& e) { return e.free_stiffness; }});
  std::string text = gnuplot::svg_terminal(1000, 620) + style + block("rates", rows) +
                     "set multiplot layout 2,2 margins 0.07,0.98,0.11,0.93 spacing 0.09,0.18\n"
                     "set logscale x\nset xrange [200:25000]\nset mxtics 1\nset mytics 1\nset key samplen 2\n"
                     "set xtics (250, 500, '1k' 1000, '2k' 2000, '4k' 4000, '10k' 10000, '20k' 20000)\n"
                     "set style data linespoints\nset xlabel 'servo rate [Hz]'\n";
  const auto line = [](int column, const char* colour, const char* title) {
    return "$rates using 1:" + std::to_string(column) + " linewidth 1.6 pointtype 7 pointsize 0.6 linecolor rgb '" +
           colour + "' title '" + title + "'";
  };
  constexpr const char *blue = "#0072b2", *orange = "#d55e00", *green = "#009e73", *grey = "#888888";
  text +=
      "set title 'maximum penetration [mm]'\nset yrange [0:*]\nset key default samplen 2 at graph 0.98, 0.75 "
      "right\nplot " +
      line(2, blue, "default paper") + ", " + line(3, orange, "hardest paper") +
      "\nset title 'path error [mm RMS]'\nset key default samplen 2 bottom right\nplot " +
      line(4, blue, "default paper") +
      "\nset logscale y\nset yrange [*:*]\n"
      "set title 'maximum force step [N per tick]'\nset yrange [0.01:10]\nset key default samplen 2 top right\nplot " +
      line(5, blue, "default paper") + ", " + line(6, orange, "hardest paper") +
      "\nset title 'maximum stable stiffness [N/m]'\nset yrange [10:1e10]\nset format y '%.0e'\nset key default "
      "samplen "
      "2 top left Left reverse\nplot " +
      line(8, orange, "no limit on the rate of the normal force") + ", " + line(9, green, "theory: linear, held") +
      ", " + line(7, blue, "default paper") + ", " + line(10, grey, "theory: linear, free") + "\n";
  return finish(text + "unset multiplot\n", "Servo rate");
}

std::string coordinate_width_tradeoff_plot(std::span<const CoordinateWidthTradeoff> tradeoff) {
  require_some(tradeoff.size());
  using Entry = CoordinateWidthTradeoff;
  const std::string rows = series<Entry>(
      tradeoff,
      {[](const Entry& e) { return static_cast<double>(e.bits); }, [](const Entry& e) { return e.max_error * percent; },
       [](const Entry& e) { return e.rms_error * percent; }, [](const Entry& e) { return e.bytes; }});
  std::string text = gnuplot::svg_terminal(720, 420) + style + block("widths", rows) +
                     "set border 11\nset logscale y\nset xlabel 'bits per coordinate'\nset xtics 2\n"
                     "set ylabel 'shape error [% of the em]'\nset y2label 'bytes per character'\nset y2tics\n"
                     "set y2range [0:*]\nset style data linespoints\nset key top center samplen 2\n"
                     "plot $widths using 1:2 linewidth 1.6 pointtype 7 linecolor rgb '#d55e00' title 'maximum', "
                     "$widths using 1:3 linewidth 1.6 pointtype 7 linecolor rgb '#0072b2' title 'RMS', "
                     "$widths using 1:4 axes x1y2 linewidth 1.6 pointtype 5 linecolor rgb '#888888' title 'bytes'\n";
  return finish(text, "Width of stored coordinates");
}

}  // namespace calligraphy
