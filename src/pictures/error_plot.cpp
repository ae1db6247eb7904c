#include <calligraphy/pictures/error_plot.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "base/require.hpp"
#include "gnuplot.hpp"
#include "svg.hpp"

namespace calligraphy {
namespace {

using Value = MeanInterval PairedErrors::*;

// [px]
constexpr double figure_width = 900.0, row_height = 26.0, rows_top = 92.0, axis_height = 76.0;
constexpr double errors_left = 88.0, errors_right = 520.0, reduction_left = 560.0, reduction_right = 832.0;
constexpr double count_middle = 868.0;
constexpr double all_gap = 0.4;        ///< between the characters and all of them [rows]
constexpr double error_offset = 0.17;  ///< of the values with and without force from the middle of their row [rows]
constexpr double millimetres = 1e3;
constexpr const char *without_colour = "#555555", *with_colour = "#0072b2", *text_colour = "#222222",
                     *note_colour = "#666666";

struct Row {
  const PairedErrors* errors;
  double place;  ///< of its middle, from the first one's [rows]
};

std::vector<Row> rows_of(const ErrorsByCharacter& errors) {
  std::vector<Row> rows;
  for (const PairedErrors& each : errors.characters) rows.push_back({&each, static_cast<double>(rows.size())});
  if (rows.size() == 1) return rows;  // all of one are it
  rows.push_back({&errors.all, static_cast<double>(rows.size()) + (rows.empty() ? 0.0 : all_gap)});
  return rows;
}

bool has_interval(const MeanInterval& value) { return std::isfinite(value.half_width); }

/// The points of a value, or its intervals: mean, row and half width, a line each.
std::string data_lines(const std::vector<Row>& rows, Value which, double offset, bool intervals) {
  std::string lines;
  for (const Row& row : rows) {
    const MeanInterval& value = row.errors->*which;
    if (!std::isfinite(value.mean) || (intervals && !has_interval(value))) continue;
    lines += number_text(value.mean * millimetres) + " " + number_text(row.place + offset) + " " +
             number_text(intervals ? value.half_width * millimetres : 0.0) + "\n";
  }
  return lines;
}

/// The plots of a value, with its data blocks before them in `blocks`.
std::string plots_of(const std::vector<Row>& rows, Value which, const std::string& name, double offset,
                     const char* colour, bool filled, std::string& blocks) {
  const std::string ink = std::string(" linecolor rgb '") + colour + "'", marker = " pointsize 0.9";
  blocks += "$" + name + " << END\n" + data_lines(rows, which, offset, false) + "END\n";
  std::string plots;
  if (const std::string lines = data_lines(rows, which, offset, true); !lines.empty()) {
    blocks += "$" + name + "_interval << END\n" + lines + "END\n";
    plots += "$" + name + "_interval using 1:2:3 with xerrorbars pointtype 0 linewidth 1.6" + ink + ", ";
  }
  // An open circle is white inside, or its interval would be seen through it.
  plots += "$" + name + " using 1:2 with points pointtype 7" + marker + (filled ? ink : " linecolor rgb 'white'");
  if (!filled) plots += ", $" + name + " using 1:2 with points pointtype 6 linewidth 1.6" + marker + ink;
  return plots;
}

/// The range of the values with their intervals, and zero.
std::string x_range(const std::vector<Row>& rows, std::initializer_list<Value> values) {
  double low = 0.0, high = 0.0;
  for (const Row& row : rows) {
    for (const Value which : values) {
      const MeanInterval& value = row.errors->*which;
      if (!std::isfinite(value.mean)) continue;
      const double half = has_interval(value) ? value.half_width : 0.0;
      low = std::min(low, (value.mean - half) * millimetres);
      high = std::max(high, (value.mean + half) * millimetres);
    }
  }
  if (low == high) high = 1.0;
  const double margin = 0.06 * (high - low);
  return "set xrange [" + number_text(low < 0.0 ? low - margin : 0.0) + ":" +
         number_text(high > 0.0 ? high + margin : 0.0) + "]\n";
}

std::string margins(double left, double right) {
  return "set lmargin at screen " + number_text(left / figure_width) + "\nset rmargin at screen " +
         number_text(right / figure_width) + "\n";
}

std::string figure_script(const std::vector<Row>& rows, double span, double height, const Language& language) {
  const auto label = [&](const char* key) { return "set xlabel " + gnuplot::quoted(language.text(key)) + "\n"; };
  std::string ticks;
  for (const Row& row : rows) ticks += (ticks.empty() ? "" : ", ") + ("'' " + number_text(row.place));
  std::string blocks;
  const std::string errors =
      plots_of(rows, &PairedErrors::vision, "without", -error_offset, without_colour, false, blocks) + ", " +
      plots_of(rows, &PairedErrors::force, "with", error_offset, with_colour, true, blocks);
  const std::string reduction =
      plots_of(rows, &PairedErrors::reduction, "reduction", 0.0, text_colour, true, blocks);
  return gnuplot::svg_terminal(static_cast<int>(figure_width), static_cast<int>(height)) + blocks +
         "set tmargin at screen " + number_text(1.0 - rows_top / height) + "\nset bmargin at screen " +
         number_text(axis_height / height) + "\nset yrange [" + number_text(span - 0.5) + ":-0.5]\nset ytics (" +
         ticks + ") scale 0\nset grid back linetype 1 linecolor rgb '#dcdcdc' linewidth 0.5\n"
         "set border 1 linecolor rgb '#666666'\nset xtics nomirror out\nunset key\nset multiplot\n" +
         margins(errors_left, errors_right) + x_range(rows, {&PairedErrors::vision, &PairedErrors::force}) +
         label("plot.error") + "plot " + errors + "\n" + margins(reduction_left, reduction_right) +
         x_range(rows, {&PairedErrors::reduction}) + label("plot.error.reduction") +
         "set arrow from 0, graph 0 to 0, graph 1 nohead linecolor rgb '#666666'\nplot " + reduction +
         "\nunset multiplot\n";
}

void add_marker_key(pugi::xml_node root, double x, double y, bool filled, const std::string& text) {
  svg::add_circle(root, "key", {x, y - 4.0}, "4.5",
                  {{"fill", filled ? with_colour : "#ffffff"},
                   {"stroke", filled ? with_colour : without_colour},
                   {"stroke-width", "1.6"}});
  svg::add_text(root, x + 11.0, y, 12.0, text, {{"font-family", "sans-serif"}, {"fill", text_colour}});
}

/// Names of the rows and their numbers of pairs, heading and legend: no character reaches gnuplot.
void add_words(pugi::xml_node root, const std::vector<Row>& rows, const ErrorsByCharacter& errors,
               const std::string& heading, const Language& language) {
  const auto words = [root](double x, double y, double size, const std::string& text, const char* anchor,
                            const char* colour, const char* weight = "normal") {
    svg::add_text(root, x, y, size, text,
                  {{"font-family", "sans-serif"}, {"text-anchor", anchor}, {"fill", colour}, {"font-weight", weight}});
  };
  const double size = std::min(17.0, 0.9 * figure_width / svg::text_width(heading + ".", 1.0));
  words(errors_left, 26.0, size, heading, "start", text_colour);
  words(errors_left, 46.0, 12.0,
        language.text("plot.error.measured", {{"pairs", std::to_string(errors.all.reduction.draws)}}), "start",
        note_colour);
  add_marker_key(root, errors_left + 5.0, 74.0, false, language.text("mode.vision_only"));
  add_marker_key(root, errors_left + 150.0, 74.0, true, language.text("mode.vision_and_force"));
  words(count_middle, 74.0, 12.0, "n", "middle", note_colour);
  for (const Row& row : rows) {
    const double middle = rows_top + (row.place + 0.5) * row_height;
    const bool is_all = row.errors->character == 0;
    words(errors_left - 14.0, middle + (is_all ? 4.5 : 6.0), is_all ? 13.0 : 17.0,
          is_all ? language.text("plot.error.all") : svg::clean(encode_utf8(row.errors->character)), "end", text_colour,
          is_all ? "bold" : "normal");
    words(count_middle, middle + 4.5, 12.0, std::to_string(row.errors->reduction.draws), "middle", note_colour);
  }
}

}  // namespace

std::string error_plot(const ErrorsByCharacter& errors, const std::string& title, const Language& language) {
  const std::string heading = svg::clean(title);
  if (errors.all.reduction.values == 0) throw ValueError("error plot: there is no pair without and with force");
  const std::vector<Row> rows = rows_of(errors);
  const double span = rows.back().place + 1.0;
  pugi::xml_document document;
  gnuplot::draw(figure_script(rows, span, rows_top + span * row_height + axis_height, language), document);
  pugi::xml_node root = document.child("svg");
  root.child("title").text() = heading.c_str();
  add_words(root, rows, errors, heading, language);
  return svg::to_string(document);
}

}  // namespace calligraphy
