#include "import_report.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>

#include "counted.hpp"
#include "importers/check/import_report_figures.hpp"
#include "importers/check/import_report_json.hpp"
#include "options.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr double percent = 100.0;
constexpr std::size_t max_examples = 10;  // in a table; the JSON has all
constexpr std::size_t max_listed = 20;    // of the strokes that a row counts

std::string typical_name(int id) { return fmt::format("{} {}", id, typical_stroke(id).name); }

std::string stroke_reference_text(const StrokeReference& place) {
  return fmt::format("{} stroke {}", character_label(place.code, place.order), place.stroke);
}

std::string fit_table(const ImportReport& report) {
  std::string limits = "\nFréchet distance from the drawing <= ";
  std::string strokes = "strokes                             ";
  std::string characters = "characters with every stroke        ";
  for (const FitCount& count : report.within) {
    limits += fmt::format("{:>8.0f} %", percent * count.error);
    strokes += fmt::format("{:>8.2f} %", percent * share_of(count.strokes, report.strokes));
    characters += fmt::format("{:>8.2f} %", percent * share_of(count.characters, report.characters));
  }
  std::string text = limits + " of the em\n" + strokes + "\n" + characters + "\n";
  text += "\nlargest errors [% of the em]\n";
  for (const StrokeError& worst : report.worst) {
    text += fmt::format("{:>8.2f}  {}, {}\n", percent * worst.error, stroke_reference_text(worst.place),
                        typical_name(worst.id));
  }
  return text;
}

std::string row(const char* what, const std::string& value) { return fmt::format("  {:<43}{:>10}\n", what, value); }

std::string share_row(const char* what, int part, int whole) {
  return row(what, fmt::format("{:.2f} %", percent * share_of(part, whole)));
}

/// A row, and the strokes that it counts if they are few.
std::string counted_row(const char* what, const ImportReport& report, bool (*condition)(const StrokeMeasures&)) {
  const int count = count_of(report, condition);
  std::string text = row(what, std::to_string(count));
  if (count == 0 || static_cast<std::size_t>(count) > max_listed) return text;
  for (const StrokeMeasures& stroke : report.measures) {
    if (condition(stroke)) text += "    " + stroke_reference_text(stroke.place) + "\n";
  }
  return text;
}

/// Shares of all strokes, and the strokes that run back.
std::string measures_table(const ImportReport& report, std::size_t bytes) {
  const auto all = static_cast<int>(report.measures.size());
  std::string text = fmt::format("\nof {}, each against the whole of its source\n", counted(all, "stroke"));
  text += counted_row("strokes that run back by more than 5 %", report, runs_back);
  text += share_row("length from 0.9 (L - 2 h) to 1.1 L", count_of(report, keeps_length), all);
  text += counted_row("strokes with a corner that the source lacks", report, has_false_corner);
  text += counted_row("strokes that lack a corner of the source", report, has_lost_corner);
  text += counted_row("  more than 10 % of the em from its ends", report, has_lost_inner_corner);
  text += share_row("crossings of strokes kept", report.crossings.kept, report.crossings.source);
  if (report.labelled > 0) text += share_row("strokes of a kind their label allows", report.allowed, report.labelled);
  text += row("bytes a character", fmt::format("{:.1f}", bytes_per_character(report, bytes)));
  return text;
}

std::string id_table(const ImportReport& report) {
  std::string text = "\ntypical strokes used\n";
  for (int id = 1; id <= typical_stroke_count; ++id) {
    const int count = report.ids_used[static_cast<std::size_t>(id)];
    if (count == 0) continue;
    text += fmt::format("{:>8}  {:>6.2f} %  {} {}\n", count, percent * share_of(count, report.strokes),
                        typical_name(id), typical_stroke(id).pinyin);
  }
  return text;
}

std::string label_table(const ImportReport& report) {
  if (report.labelled == 0 && report.label_conflicts.empty()) return {};
  std::string text = fmt::format("\nlabels: of {}, geometry alone recognises {} as labelled ({:.2f} %)\n",
                                 counted(report.labelled, "stroke"), report.agreed,
                                 percent * share_of(report.agreed, report.labelled));
  text +=
      fmt::format("  labels of the others: {} accepted, {} overridden by the shape, {} unknown\n",
                  count_of(report, LabelResolution::accepted), count_of(report, LabelResolution::overridden),
                  count_of(report, LabelResolution::unknown));
  for (std::size_t i = 0; i < std::min(report.confusions.size(), max_examples); ++i) {
    const LabelConfusion& confusion = report.confusions[i];
    text += fmt::format("{:>8}  {} looks like {}, as in {}\n", confusion.count, printable(confusion.label),
                        typical_name(confusion.recognised), stroke_reference_text(confusion.example));
  }
  if (!report.letters_unused.empty()) {
    text += fmt::format("  letters of {} ignored: they do not match the stroke count\n",
                        counted(report.letters_unused.size(), "character"));
  }
  return text;
}

std::string corrected_table(const ImportReport& report) {
  std::string text;
  for (const OrderCorrected& each : report.corrected) {
    if (text.empty()) text = "\nstroke orders corrected\n";
    text += fmt::format("  {}: {}\n", character_label(each.code), each.reason);
  }
  return text;
}

std::string skipped_table(const ImportReport& report) {
  std::string text;
  const auto add_rows = [&](bool unusable, const char* head) {
    std::size_t rows = 0;
    for (const auto& [reason, files] : skipped_by_reason(report, unusable)) {
      if (rows == 0) text += head;
      if (++rows > max_listed) continue;
      text += fmt::format("{:>8}  {}: {}{}\n", files.size(), reason, printable(files.front()),
                          files.size() > 1 ? ", ..." : "");
    }
    if (rows > max_listed) text += fmt::format("{:>8}  more, as --json lists them\n", rows - max_listed);
  };
  add_rows(false, "\nskipped\n");
  add_rows(true, "\nunusable, and skipped\n");
  for (const std::string& note : report.notes) text += "\nnote: " + note + "\n";
  return text;
}

}  // namespace

Contents contents_of(const CharacterList& list) {
  Contents contents;
  for (std::size_t i = 0; i < list.characters.size(); ++i) {
    const Character& character = list.characters[i];
    if (i > 0 && list.characters[i - 1].code == character.code) {
      ++contents.alternate_orders;
    } else {
      ++contents.characters;
      contents.strokes += character.stroke_count();
    }
  }
  return contents;
}

std::string to_string(const Contents& contents) {
  const std::string text = counted(contents.characters, "character") + ", " + counted(contents.strokes, "stroke");
  if (contents.alternate_orders == 0) return text;
  return text + ", " + counted(contents.alternate_orders, "alternate stroke order");
}

std::string character_label(char32_t code, const std::string& order) {
  return order.empty() ? character_label(code) : character_label(code) + " order " + order;
}

std::string ink_table(const ImportResult& import) {
  const std::vector<InkFigures> rows = ink_figures(import);
  if (rows.empty()) return {};
  constexpr const char* head = "{:<32}{:>10}{:>8}{:>8}{:>8}{:>8}{:>6}{:>11}{:>8}\n";
  std::string text =
      "\nink against the outlines (docs/strokes.md#ink): intersection over union of the areas of strokes, mean and 5th\n"
      "percentile, and of whole characters; contacts of strokes, kept and new; strokes with more than 0.02 em of outline\n"
      "uncovered, and of ink beyond the outline\n";
  text += fmt::format(fmt::runtime(head), "", "bytes a", "", "", "whole", "kept", "new", "uncovered", "beyond");
  text += fmt::format(fmt::runtime(head), "", "character", "mean", "p5", "char.", "[%]", "[%]", "[%]", "[%]");
  for (const InkFigures& ink : rows) {
    const InkMeasures& measures = *ink.measures;
    text += fmt::format("{:<32}{:>10.1f}{:>8.4f}{:>8.4f}{:>8.4f}{:>8.2f}{:>6.2f}{:>11.2f}{:>8.2f}\n", ink.name,
                        ink.bytes_per_character, ink.mean, ink.low, ink.character_mean,
                        percent * share_of(measures.contacts_kept, measures.contacts),
                        percent * share_of(measures.new_contacts, std::max(1, measures.apart)),
                        percent * ink.uncovered, percent * ink.beyond);
  }
  const std::vector<NotchFigures> hooks = notch_figures(import.report);
  if (!hooks.empty()) {
    text += fmt::format("\nnotches of more than {:.0f} degrees within 0.1 em of the tip of a hook\n{:>8}  {:>8}{:>12}\n",
                        notch_angle, "strokes", "ink [%]", "source [%]");
  }
  for (const NotchFigures& hook : hooks) {
    text += fmt::format("{:>8}  {:>8.1f}{:>12.1f}  {} {}\n", hook.strokes, percent * hook.ink, percent * hook.source,
                        typical_name(hook.id), typical_stroke(hook.id).pinyin);
  }
  return text;
}

std::string tables(const ImportResult& import, const ImportOutput& output) {
  const ImportReport& report = import.report;
  const Provenance& provenance = import.list.provenance;
  const bool fitted = report.kind != SourceKind::calligraphy;
  return fmt::format("{} ({}, {} bytes): {} from {}\n", output.file, output.format, output.bytes,
                     to_string(contents_of(import.list)), calligraphy::to_string(report.kind)) +
         fmt::format("source: {}\nlicence: {}\nattribution: {}\n", provenance.source,
                     provenance.licence.empty() ? "not stated" : provenance.licence,
                     provenance.attribution) +
         (fitted ? fit_table(report) : "") + (report.measures.empty() ? "" : measures_table(report, output.bytes)) +
         ink_table(import) + id_table(report) + label_table(report) + corrected_table(report) +
         skipped_table(report);
}

std::string json(const ImportResult& import, const ImportOutput& output) {
  const Provenance& provenance = import.list.provenance;
  const Contents contents = contents_of(import.list);
  Json all = {{"file", output.file},
              {"format", output.format},
              {"bytes", output.bytes},
              {"kind", calligraphy::to_string(import.report.kind)},
              {"source", provenance.source},
              {"licence", provenance.licence},
              {"attribution", provenance.attribution},
              {"characters", contents.characters},
              {"strokes", contents.strokes},
              {"alternate_orders", contents.alternate_orders}};
  all.update(report_json(import, output.bytes));
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // file names may be in any encoding
}

}  // namespace calligraphy::tools
