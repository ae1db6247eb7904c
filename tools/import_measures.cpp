#include "import_measures.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>
#include <calligraphy/model/set_encoding.hpp>

#include "counted.hpp"
#include "import_report.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_listed = 20;

template <typename Condition>
int count_of(const ImportReport& report, Condition condition) {
  return static_cast<int>(std::count_if(report.measures.begin(), report.measures.end(), condition));
}

bool runs_back(const StrokeMeasures& stroke) { return stroke.backward > most_backward; }
bool has_its_length(const StrokeMeasures& stroke) {
  return stroke.length >= 0.9 * (stroke.source_length - 2.0 * stroke.half_width) &&
         stroke.length <= 1.1 * stroke.source_length;
}
bool has_false_corner(const StrokeMeasures& stroke) { return stroke.false_corners > 0; }
bool has_lost_corner(const StrokeMeasures& stroke) { return stroke.lost_corners > 0; }
bool has_lost_inner_corner(const StrokeMeasures& stroke) { return stroke.lost_inside > brush_end; }

double bytes_per_character(const ImportReport& report, std::size_t bytes) {
  return report.characters == 0 ? 0.0 : static_cast<double>(bytes) / report.characters;
}

std::string row(const char* what, const std::string& value) { return fmt::format("  {:<43}{:>10}\n", what, value); }

std::string share_row(const char* what, int part, int whole) {
  return row(what, fmt::format("{:.2f} %", percent * share(part, whole)));
}

/// A row, and the strokes that it counts if they are few.
template <typename Condition>
std::string counted_row(const char* what, const ImportReport& report, Condition condition) {
  const int count = count_of(report, condition);
  std::string text = row(what, std::to_string(count));
  if (count == 0 || static_cast<std::size_t>(count) > max_listed) return text;
  for (const StrokeMeasures& stroke : report.measures) {
    if (condition(stroke)) text += "    " + stroke_reference_text(stroke.place) + "\n";
  }
  return text;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// What a share of the values falls short of.
double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

constexpr double low = 0.05;

Json stroke_json(const StrokeMeasures& stroke) {
  Json row = place_json(stroke.place);
  row["id"] = stroke.id;
  row["frechet_em"] = stroke.frechet;
  row["backward"] = stroke.backward;
  row["length_em"] = stroke.length;
  row["source_length_em"] = stroke.source_length;
  row["half_width_em"] = stroke.half_width;
  row["false_corners"] = stroke.false_corners;
  row["lost_corners"] = stroke.lost_corners;
  row["lost_inside_em"] = stroke.lost_inside;
  return row;
}

/// Ink as stored: what it costs, and what it covers.
struct InkRow {
  const char* name;
  const char* key;
  const InkMeasures* measures;
  double bytes;  ///< a character
};

std::vector<InkRow> ink_rows(const ImportResult& import) {
  if (import.report.ink.strokes.empty()) return {};
  const auto size = [](const CharacterList& list) { return static_cast<double>(encode_character_set(list).size()); };
  CharacterList list = import.list;
  const double full = size(list);
  for (Character& character : list.characters) {
    for (StrokeInk& ink : character.physics.ink) ink.offsets.fill(0.0);
  }
  const double plain = size(list);
  for (Character& character : list.characters) character.physics.ink.clear();
  const double none = size(list);
  const auto count = static_cast<double>(list.characters.size());
  std::vector<InkRow> rows{{"typical of the kind, scaled", "typical", &import.report.typical_ink, 0.0},
                           {"8 half-widths", "half_widths", &import.report.plain_ink, (plain - none) / count}};
  if (full != plain) {
    rows.push_back({"8 half-widths, 8 offsets", "full", &import.report.ink, (full - none) / count});
  }
  return rows;
}

}  // namespace

std::string ink_table(const ImportResult& import) {
  const std::vector<InkRow> rows = ink_rows(import);
  if (rows.empty()) return {};
  constexpr const char* head = "{:<28}{:>10}{:>8}{:>8}{:>8}{:>10}{:>8}\n";
  std::string text = "\nink against the outlines: intersection over union of areas; contacts of strokes\n";
  text += fmt::format(fmt::runtime(head), "", "bytes a", "", "", "whole", "kept", "new");
  text += fmt::format(fmt::runtime(head), "", "character", "mean", "p5", "char.", "[%]", "[%]");
  for (const auto& [name, key, ink, bytes] : rows) {
    text += fmt::format("{:<28}{:>10.1f}{:>8.4f}{:>8.4f}{:>8.4f}{:>10.2f}{:>8.2f}\n", name, bytes,
                        mean_of(ink->strokes), quantile(ink->strokes, low), mean_of(ink->characters),
                        percent * share(ink->contacts_kept, ink->contacts),
                        percent * share(ink->new_contacts, std::max(1, ink->apart)));
  }
  return text;
}

Json ink_json(const ImportResult& import) {
  Json result = Json::object();
  for (const auto& [name, key, ink, bytes] : ink_rows(import)) {
    result[key] = {{"bytes_per_character", bytes},
                   {"iou_mean", mean_of(ink->strokes)},
                   {"iou_p5", quantile(ink->strokes, low)},
                   {"iou_characters_mean", mean_of(ink->characters)},
                   {"contacts", ink->contacts},
                   {"contacts_kept", ink->contacts_kept},
                   {"apart", ink->apart},
                   {"new_contacts", ink->new_contacts},
                   {"iou", ink->strokes}};
  }
  return result;
}

double share(int part, int whole) { return whole == 0 ? 1.0 : static_cast<double>(part) / whole; }

std::string stroke_reference_text(const StrokeReference& place) {
  return fmt::format("{} stroke {}", character_label(place.code, place.order), place.stroke);
}

Json place_json(const StrokeReference& place) {
  return {{"character", encode_utf8(place.code)}, {"order", place.order}, {"stroke", place.stroke}};
}

std::string measures_table(const ImportReport& report, std::size_t bytes) {
  const auto all = static_cast<int>(report.measures.size());
  std::string text = fmt::format("\nof {}, each against the whole of its source\n", counted(all, "stroke"));
  text += counted_row("strokes that run back by more than 5 %", report, runs_back);
  text += share_row("length from 0.9 (L - 2 h) to 1.1 L", count_of(report, has_its_length), all);
  text += counted_row("strokes with a corner that the source lacks", report, has_false_corner);
  text += counted_row("strokes that lack a corner of the source", report, has_lost_corner);
  text += counted_row("  more than 10 % of the em from its ends", report, has_lost_inner_corner);
  text += share_row("crossings of strokes kept", report.crossings.kept, report.crossings.source);
  if (report.labelled > 0) text += share_row("strokes of a kind their label allows", report.allowed, report.labelled);
  text += row("bytes a character", fmt::format("{:.1f}", bytes_per_character(report, bytes)));
  return text;
}

Json measures_json(const ImportReport& report, std::size_t bytes) {
  const auto all = static_cast<int>(report.measures.size());
  const int length = count_of(report, has_its_length);
  Json strokes = Json::array();
  for (const StrokeMeasures& stroke : report.measures) strokes.push_back(stroke_json(stroke));
  return {{"running_back", count_of(report, runs_back)},
          {"length_kept", length},
          {"length_kept_share", share(length, all)},
          {"with_false_corners", count_of(report, has_false_corner)},
          {"with_lost_corners", count_of(report, has_lost_corner)},
          {"with_lost_inner_corners", count_of(report, has_lost_inner_corner)},
          {"crossings", report.crossings.source},
          {"crossings_kept", report.crossings.kept},
          {"labelled", report.labelled},
          {"allowed_by_label", report.allowed},
          {"bytes_per_character", bytes_per_character(report, bytes)},
          {"strokes", strokes}};
}

}  // namespace calligraphy::tools
