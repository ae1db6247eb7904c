// The tradeoff of speed against accuracy, drawn by gnuplot.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/experiments/tradeoff.hpp>

#include "base/require.hpp"
#include "pictures/gnuplot.hpp"
#include "pictures/label_place.hpp"
#include "pictures/svg.hpp"

namespace calligraphy {
namespace {

constexpr double to_millimetres = 1e3;
constexpr double percent = 100.0;
constexpr double min_error = 1e-17;  ///< drawn for no error at all
constexpr double max_error = 1e3;    ///< drawn for more, too

constexpr const char* style =
    "set grid back linetype 1 linecolor rgb '#dcdcdc' linewidth 0.5\n"
    "set border 3 linecolor rgb '#666666'\nset tics nomirror out\n";

struct MethodStyle {
  NearestPointMethod method;
  const char* colour;
  int marker;
};
constexpr std::array methods = {
    MethodStyle{NearestPointMethod::exact, "#0072b2", 7},
    MethodStyle{NearestPointMethod::tracked, "#009e73", 13},
    MethodStyle{NearestPointMethod::sampled, "#b0578d", 5},
    MethodStyle{NearestPointMethod::wang2006, "#d55e00", 9},
};

pugi::xml_document drawn(const std::string& script, const char* title) {
  pugi::xml_document document;
  gnuplot::draw(script, document);
  document.child("svg").child("title").text() = title;
  return document;
}

std::string block(const std::string& name, const std::string& lines) {
  return "$" + name + " << END\n" + lines + "END\n";
}

std::string point_label(const NearestPointSetting& setting) { return setting.name.substr(setting.name.find(' ') + 1); }

using Cost = NearestPointCost NearestPointTradeoff::*;

/// An error within the picture.
double shown(double error) { return std::isfinite(error) ? std::clamp(error, min_error, max_error) : max_error; }

/// Where a setting is drawn.
struct Mark {
  double ns, largest, p99;
  std::string name;
};

std::vector<Mark> marks_of(std::span<const NearestPointTradeoff> tradeoff, NearestPointMethod method, Cost cost) {
  std::vector<Mark> marks;
  for (const NearestPointTradeoff& entry : tradeoff) {
    if (entry.setting.options.method != method) continue;
    const NearestPointCost& own = entry.*cost;
    marks.push_back({own.ns, shown(own.error_worst), shown(own.error_p99), point_label(entry.setting)});
  }
  return marks;
}

/// One line per mark: cost, largest error, 99 % error.
std::string lines_of(const std::vector<Mark>& marks) {
  std::string lines;
  for (const Mark& mark : marks) {
    lines += number_text(mark.ns) + " " + number_text(mark.largest) + " " + number_text(mark.p99) + "\n";
  }
  return lines;
}

/// A panel of the picture with its logarithmic axes.
struct Panel {
  svg::Box box;           ///< [px]
  Point least, greatest;  ///< cost [ns] and error at its edges

  Point operator()(double ns, double error) const {
    const Point share((std::log(ns / least.x())) / std::log(greatest.x() / least.x()),
                      (std::log(greatest.y() / error)) / std::log(greatest.y() / least.y()));
    return box.low + share.cwiseProduct(box.high - box.low);
  }
};

/// Writes the settings beside their marks: those of marks that lie on one another together, from the first to the last.
void label_marks(pugi::xml_node root, const std::array<std::vector<Mark>, methods.size()>& marks, const Panel& panel) {
  constexpr double font = 11.0;
  std::vector<svg::Box> taken;
  const Point marker(5.0, 5.0), bar(2.0, 2.0);
  for (const std::vector<Mark>& of_method : marks) {
    for (const Mark& mark : of_method) {
      const Point top = panel(mark.ns, mark.largest), bottom = panel(mark.ns, mark.p99);
      taken.push_back({top - marker, top + marker});
      taken.push_back({top - bar, bottom + bar});
    }
  }
  for (std::size_t i = 0; i < marks.size(); ++i) {
    for (std::size_t first = 0, end = 0; first < marks[i].size(); first = end) {
      const Point place = panel(marks[i][first].ns, marks[i][first].largest);
      const auto hides = [&](const Mark& mark) {
        return (panel(mark.ns, mark.largest) - place).cwiseAbs().maxCoeff() < 9.0;
      };
      end = first + 1;
      while (end < marks[i].size() && hides(marks[i][end])) ++end;
      const std::string& last = marks[i][end - 1].name;
      const std::string text =
          end - first == 1 ? last : marks[i][first].name + (end - first == 2 ? ", " : " to ") + last;
      const Point size(svg::text_width(text, font), font);
      const svg::Box box = svg::place_label(place, size, panel.box, taken);
      svg::add_text(root, 0.5 * (box.low.x() + box.high.x()), box.high.y() - 1.5, font, text,
                    {{"font-family", "sans-serif"}, {"text-anchor", "middle"}, {"fill", methods[i].colour}});
      taken.push_back(box);
      const Point nearest = place.cwiseMax(box.low).cwiseMin(box.high);
      if ((nearest - place).norm() < 14.0) continue;
      svg::Path leader;
      leader.move_to(place);
      leader.line_to(nearest);
      svg::add(root, "path", {{"d", leader.data()}, {"stroke", methods[i].colour}, {"stroke-width", "0.6"}});
    }
  }
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

void add_note(pugi::xml_node root, double x, double y, const std::string& note) {
  svg::add_text(root, x, y, 12.0, note, {{"font-family", "sans-serif"}, {"fill", "#666666"}});
}

/// What the picture shows, and how to read it, above the panels.
void add_heading(pugi::xml_node root, double x, const std::string& heading, const std::string& reading) {
  svg::add_text(root, x, 26.0, 17.0, heading, {{"font-family", "sans-serif"}, {"fill", "#222222"}});
  add_note(root, x, 46.0, reading);
}

void require_some(std::size_t count) {
  if (count == 0) throw ValueError("tradeoff plot: there are no entries");
}

}  // namespace

std::string nearest_point_tradeoff_plot(std::span<const NearestPointTradeoff> tradeoff) {
  require_some(tradeoff.size());
  constexpr int width = 1180, height = 640;
  constexpr double top = 124.0, bottom = height - 76.0, least_error = 1e-18;
  double cheapest = tradeoff[0].real.ns, dearest = cheapest, greatest_error = 1.0;
  for (const NearestPointTradeoff& entry : tradeoff) {
    for (const NearestPointCost& cost : {entry.real, entry.hard, entry.ticks}) {
      cheapest = std::min(cheapest, cost.ns);
      dearest = std::max(dearest, cost.ns);
      greatest_error = std::max(greatest_error, shown(cost.error_worst));
    }
  }
  const Point least(0.5 * cheapest, least_error), greatest(2.0 * dearest, 30.0 * greatest_error);
  std::string text = gnuplot::svg_terminal(width, height) + style +
                     "set multiplot\nset logscale xy\nset xrange [" + number_text(least.x()) + ":" +
                     number_text(greatest.x()) + "]\nset yrange [" + number_text(least.y()) + ":" +
                     number_text(greatest.y()) +
                     "]\nset format y '%.0e'\nset xlabel 'median cost [ns]'\nset ytics 1e-17,1000,10\nset mytics 1\n"
                     "set mxtics 1\nset xtics (10,20,50,100,200,500,1000,2000,5000,10000)\nset tmargin at screen " +
                     number_text(1.0 - top / height) + "\nset bmargin at screen " + number_text(1.0 - bottom / height) +
                     "\nset arrow from graph 0, first 1e-3 to graph 1, first 1e-3 nohead linecolor rgb '#888888' "
                     "dashtype 2\nset ylabel 'distance error [curve sizes]'\n";
  struct Queries {
    const char* heading;
    double left, right;  ///< shares of the width
    Cost cost;
  };
  constexpr std::array all = {Queries{"queries around real strokes", 0.085, 0.37, &NearestPointTradeoff::real},
                              Queries{"hard workloads", 0.39, 0.675, &NearestPointTradeoff::hard},
                              Queries{"a pen along whole strokes, per tick", 0.695, 0.98,
                                      &NearestPointTradeoff::ticks}};
  std::array<std::array<std::vector<Mark>, methods.size()>, all.size()> marks;
  for (std::size_t panel = 0; panel < all.size(); ++panel) {
    std::string plots;
    for (std::size_t i = 0; i < methods.size(); ++i) {
      marks[panel][i] = marks_of(tradeoff, methods[i].method, all[panel].cost);
      if (marks[panel][i].empty()) continue;
      const std::string colour = std::string(" linecolor rgb '") + methods[i].colour + "' ";
      const std::string name = to_string(methods[i].method);
      text += block(name, lines_of(marks[panel][i]));
      plots += std::string(plots.empty() ? "" : ", ") + "$" + name +
               " using 1:2:3:2 with yerrorbars pointtype 0 linewidth 1" + colour + "notitle, $" + name +
               " using 1:2 with points pointtype " + std::to_string(methods[i].marker) + " pointsize 1" + colour +
               "title '" + name + "'";
    }
    text += "set lmargin at screen " + number_text(all[panel].left) + "\nset rmargin at screen " +
            number_text(all[panel].right) + "\nset title '" + all[panel].heading + "'\n" +
            (panel == 0 ? "set key horizontal maxrows 1 at screen 0.98, 0.985 right top samplen 1\n"
                        : "unset key\nunset ylabel\nset format y ''\n") +
            "plot " + plots + "\n";
  }
  pugi::xml_document document = drawn(text + "unset multiplot\n", "Nearest point: cost against error");
  pugi::xml_node root = document.child("svg");
  add_heading(root, all[0].left * width, "Nearest point: cost against error",
              "marker: maximum error, with the tolerance, or samples x refinements; line: down to the error that 99 % "
              "of the answers stay below");
  add_note(root, all[0].left * width, 63.0,
           "above the dashed line: on a wrong branch; 1e-17: no difference from exact 1e-12");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Panel panel{{Point(all[i].left * width, top), Point(all[i].right * width, bottom)}, least, greatest};
    label_marks(root, marks[i], panel);
  }
  return svg::to_string(document);
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
  std::string text = gnuplot::svg_terminal(1000, 700) + style + block("rates", rows) +
                     "set multiplot layout 2,2 margins 0.07,0.98,0.11,0.85 spacing 0.09,0.18\n"
                     "set logscale x\nset xrange [200:25000]\nset mxtics 1\nset mytics 1\n"
                     "set xtics (250, 500, '1k' 1000, '2k' 2000, '4k' 4000, '10k' 10000, '20k' 20000)\n"
                     "set style data linespoints\nset xlabel 'servo rate [Hz]'\n";
  const auto line = [](int column, const char* look, const char* title) {
    return "$rates using 1:" + std::to_string(column) + " " + look + " title '" + title + "'";
  };
  // Lines on one another: the lower one is wide.
  constexpr const char* paper = "linewidth 1.6 pointtype 7 pointsize 0.6 linecolor rgb '#0072b2'";
  constexpr const char* hardest = "linewidth 1.6 pointtype 5 pointsize 0.7 linecolor rgb '#d55e00'";
  constexpr const char* no_limit = "linewidth 6 pointtype 0 linecolor rgb '#f3c48f'";
  constexpr const char* held = "linewidth 1.6 dashtype 2 pointtype 9 pointsize 0.8 linecolor rgb '#009e73'";
  constexpr const char* free = "linewidth 1.6 dashtype 3 pointtype 13 pointsize 0.8 linecolor rgb '#666666'";
  text +=
      "set title 'maximum penetration [mm]'\nset offsets graph 0, graph 0, graph 0.1, graph 0\nset yrange [0:*]\n"
      "set key default samplen 3 at graph 0.98, 0.75 right\nplot " +
      line(2, paper, "default paper") + ", " + line(3, hardest, "hardest paper") +
      "\nset title 'path error [mm RMS]'\nset key default samplen 3 bottom right\nplot " +
      line(4, paper, "default paper") +
      "\nset logscale y\nset offsets 0,0,0,0\nset title 'maximum force step [N per tick]'\nset yrange [0.01:10]\n"
      "set key default samplen 3 bottom left Left reverse\nplot " +
      line(5, paper, "default paper") + ", " + line(6, hardest, "hardest paper") +
      "\nset title 'maximum stable stiffness [N/m]'\nset yrange [10:1e10]\nset ytics 100\nset format y '%.0e'\n"
      "set key default samplen 3 top left Left reverse\nplot " +
      line(8, no_limit, "no limit on the rate of the normal force") + ", " + line(7, paper, "default paper") + ", " +
      line(9, held, "theory: linear, held") + ", " + line(10, free, "theory: linear, free") + "\n";
  pugi::xml_document document = drawn(text + "unset multiplot\n", "Servo rate");
  add_heading(document.child("svg"), 70.0, "Servo rate", "a simulated novice who writes on a simulated Desktop");
  return svg::to_string(document);
}

std::string coordinate_width_tradeoff_plot(std::span<const CoordinateWidthTradeoff> tradeoff) {
  require_some(tradeoff.size());
  using Entry = CoordinateWidthTradeoff;
  const std::string rows = series<Entry>(
      tradeoff,
      {[](const Entry& e) { return static_cast<double>(e.bits); }, [](const Entry& e) { return e.max_error * percent; },
       [](const Entry& e) { return e.rms_error * percent; }, [](const Entry& e) { return e.bytes; }});
  const std::string text =
      gnuplot::svg_terminal(720, 470) + style + block("widths", rows) +
      "set border 11\nset logscale y\nset xlabel 'bits per coordinate'\nset xtics 2\nset xrange [3.5:16.5]\n"
      "set tmargin at screen 0.85\nset ylabel 'shape error [% of the em]'\n"
      "set y2label 'bytes per character'\nset y2tics\nset y2range [0:*]\nset style data linespoints\n"
      "set key top center samplen 3\n"
      "plot $widths using 1:2 linewidth 1.6 pointtype 7 linecolor rgb '#d55e00' title 'maximum error', "
      "$widths using 1:3 linewidth 1.6 pointtype 9 linecolor rgb '#0072b2' title 'RMS error', "
      "$widths using 1:4 axes x1y2 linewidth 1.6 dashtype 2 pointtype 5 linecolor rgb '#666666' "
      "title 'bytes (right)'\n";
  pugi::xml_document document = drawn(text, "Width of stored coordinates");
  add_heading(document.child("svg"), 90.0, "Width of stored coordinates",
              "distance between the original and the stored strokes, and what they take");
  return svg::to_string(document);
}

}  // namespace calligraphy
