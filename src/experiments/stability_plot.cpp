#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/experiments/stability_map.hpp>

#include "base/require.hpp"
#include "pictures/gnuplot.hpp"
#include "pictures/svg.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t panel_columns = 3;                                       // of panels
constexpr double panels_left = 0.078, panels_right = 0.99, panel_gap = 0.025;  // of the panels, shares of the picture
constexpr double panels_top = 0.845, bottom = 0.085, between = 0.115;

/// A kind of cell in the map.
struct Kind {
  bool stable, controlled_stable;
  const char* colour;
  const char* title;
};
constexpr std::array kinds = {Kind{true, true, "#74add1", "settles with and without control"},
                              Kind{false, true, "#c2e5b6", "settles only with control"},
                              Kind{true, false, "#d9722e", "settles only without control"},
                              Kind{false, false, "#f4f4f4", "does not settle"}};

struct Bound {
  double StabilityLine::*value;
  const char* style;
  const char* title;
};
constexpr std::array bounds = {
    Bound{&StabilityLine::stable, "linewidth 2 linecolor rgb '#08306b'", "stable, exact"},
    Bound{&StabilityLine::approximate, "linewidth 1.6 linecolor rgb '#d55e00' dashtype 2", "stable, Gil et al. 2009"},
    Bound{&StabilityLine::passive, "linewidth 1.6 linecolor rgb '#222222' dashtype 3", "passive"}};

/// Adjoining cells of one kind in a column as one rectangle, a line each: centre, corners.
std::string rectangles(const StabilitySweep& sweep, const Kind& kind, const std::vector<double>& stiffnesses) {
  const double half = std::sqrt(stiffnesses[1] / stiffnesses[0]);
  std::string lines;
  for (std::size_t i = 0; i < sweep.lines.size(); ++i) {
    const StabilityLine& line = sweep.lines[i];
    const auto is_kind = [&](std::size_t k) {
      return line.stable_at[k] == kind.stable && line.controlled_stable_at[k] == kind.controlled_stable;
    };
    const double x = static_cast<double>(i);
    for (std::size_t k = 0; k < stiffnesses.size(); ++k) {
      if (!is_kind(k)) continue;
      const std::size_t first = k;
      while (k + 1 < stiffnesses.size() && is_kind(k + 1)) ++k;
      lines += number_text(x) + " " + number_text(stiffnesses[first]) + " " + number_text(x - 0.5) + " " +
               number_text(x + 0.5) + " " + number_text(stiffnesses[first] / half) + " " +
               number_text(stiffnesses[k] * half) + "\n";
    }
  }
  return lines;
}

/// A step across each column; none where the bound is zero, which a logarithmic axis cannot show.
std::string steps(const StabilitySweep& sweep, double StabilityLine::*bound) {
  std::string lines;
  for (std::size_t i = 0; i < sweep.lines.size(); ++i) {
    const double value = sweep.lines[i].*bound, x = static_cast<double>(i);
    if (value > 0.0) {
      lines += number_text(x - 0.5) + " " + number_text(value) + "\n" + number_text(x + 0.5) + " " +
               number_text(value) + "\n";
    } else {
      lines += "\n";
    }
  }
  return lines;
}

std::string ticks(const StabilitySweep& sweep) {
  std::string text;
  for (std::size_t i = 0; i < sweep.values.size(); ++i) {
    text += (i == 0 ? "" : ", ") + gnuplot::quoted(sweep.values[i]) + " " + std::to_string(i);
  }
  return "set xtics (" + text + ")\nset xrange [-0.5:" + number_text(static_cast<double>(sweep.lines.size()) - 0.5) +
         "]\n";
}

std::string place(std::size_t panel, std::size_t rows) {
  const auto column = static_cast<double>(panel % panel_columns), row = static_cast<double>(panel / panel_columns);
  const double width = (panels_right - panels_left - panel_gap * (panel_columns - 1)) / panel_columns;
  const double height = (panels_top - bottom - between * static_cast<double>(rows - 1)) / static_cast<double>(rows);
  const double begin = panels_left + column * (width + panel_gap), end = panels_top - row * (height + between);
  return "set lmargin at screen " + number_text(begin) + "\nset rmargin at screen " + number_text(begin + width) +
         "\nset tmargin at screen " + number_text(end) + "\nset bmargin at screen " + number_text(end - height) + "\n";
}

/// Data blocks and the plot of one panel. The first panel has the legend for all of them.
std::string panel(const StabilitySweep& sweep, std::size_t index, const std::vector<double>& stiffnesses) {
  std::string text, plots;
  const auto add = [&](const std::string& data, const std::string& drawn, const char* title) {
    if (data.find_first_not_of('\n') == std::string::npos && index > 0) return;
    const std::string block = "$data" + std::to_string(index) + "_" + std::to_string(plots.size());
    // gnuplot refuses a series without points: one outside the range stands for it in the legend.
    text += block + " << END\n" + (data.empty() ? "-9 1 -9 -9 1 1\n" : data) + "END\n";
    plots += (plots.empty() ? "" : ", ") + block + " " + drawn +
             (index == 0 ? " title " + gnuplot::quoted(title) : " notitle");
  };
  for (const Kind& kind : kinds) {
    add(rectangles(sweep, kind, stiffnesses),
        std::string("using 1:2:3:4:5:6 with boxxyerror fillstyle solid noborder linecolor rgb '") + kind.colour + "'",
        kind.title);
  }
  for (const Bound& bound : bounds) {
    add(steps(sweep, bound.value), std::string("using 1:2 with lines ") + bound.style, bound.title);
  }
  return text + ticks(sweep) + "set xlabel " + gnuplot::quoted(sweep.label) + "\n" +
         (index == 0 ? "set key at screen 0.53, 0.945 center top maxrows 3 samplen 2 Left reverse\n" : "unset key\n") +
         (index % panel_columns == 0 ? "set format y '%.0s%c'\nset ylabel 'stiffness K [N/m]'\n"
                                     : "set format y ''\nunset ylabel\n") +
         "plot " + plots + "\n";
}

}  // namespace

std::string stability_map_plot(const StabilityMap& map) {
  if (map.sweeps.empty() || map.stiffnesses.size() < 2) throw ValueError("stability map plot: the map has no sweep");
  const std::size_t rows = (map.sweeps.size() + panel_columns - 1) / panel_columns;
  const double half = std::sqrt(map.stiffnesses[1] / map.stiffnesses[0]);
  std::string script = gnuplot::svg_terminal(1180, 150 + 340 * static_cast<int>(rows)) +
                       "set border 3 linecolor rgb '#666666'\nset tics nomirror out\nset logscale y\nset mytics 1\n"
                       "set multiplot\nset yrange [" +
                       number_text(map.stiffnesses.front() / half) + ":" + number_text(map.stiffnesses.back() * half) +
                       "]\n";
  for (std::size_t i = 0; i < map.sweeps.size(); ++i) {
    script += place(i, rows) + panel(map.sweeps[i], i, map.stiffnesses);
  }
  pugi::xml_document document;
  gnuplot::draw(script + "unset multiplot\n", document);
  pugi::xml_node root = document.child("svg");
  root.child("title").text() = "Stability of a sampled wall";
  svg::add_text(root, panels_left * 1180.0, 28.0, 17.0, "Stability of a sampled wall",
                {{"font-family", "sans-serif"}, {"fill", "#222222"}});
  return svg::to_string(document);
}

}  // namespace calligraphy
