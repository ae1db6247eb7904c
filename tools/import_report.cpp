#include "import_report.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>

#include "counted.hpp"
#include "import_measures.hpp"
#include "options.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_examples = 10;  // in a table; the JSON has all

/// Skipped files by reason.
std::map<std::string, std::vector<std::string>> by_reason(const std::vector<SkippedFile>& skipped) {
  std::map<std::string, std::vector<std::string>> reasons;
  for (const SkippedFile& file : skipped) reasons[file.reason].push_back(file.path);
  return reasons;
}

std::string typical_name(int id) { return fmt::format("{} {}", id, typical_stroke(id).name); }

int count_of(const ImportReport& report, LabelResolution resolution) {
  return static_cast<int>(
      std::count_if(report.label_conflicts.begin(), report.label_conflicts.end(),
                    [resolution](const LabelConflict& conflict) { return conflict.resolution == resolution; }));
}

std::string fit_table(const ImportReport& report) {
  std::string limits = "\nFréchet distance from the drawing <= ";
  std::string strokes = "strokes                             ";
  std::string characters = "characters with every stroke        ";
  for (const FitCount& count : report.within) {
    limits += fmt::format("{:>8.0f} %", percent * count.error);
    strokes += fmt::format("{:>8.2f} %", percent * share(count.strokes, report.strokes));
    characters += fmt::format("{:>8.2f} %", percent * share(count.characters, report.characters));
  }
  std::string text = limits + " of the em\n" + strokes + "\n" + characters + "\n";
  text += "\nlargest errors [% of the em]\n";
  for (const StrokeError& worst : report.worst) {
    text += fmt::format("{:>8.2f}  {}, {}\n", percent * worst.error, stroke_reference_text(worst.place),
                        typical_name(worst.id));
  }
  return text;
}

std::string id_table(const ImportReport& report) {
  std::string text = "\ntypical strokes used\n";
  for (int id = 1; id <= typical_stroke_count; ++id) {
    const int count = report.ids_used[static_cast<std::size_t>(id)];
    if (count == 0) continue;
    text += fmt::format("{:>8}  {:>6.2f} %  {} {}\n", count, percent * share(count, report.strokes), typical_name(id),
                        typical_stroke(id).pinyin);
  }
  return text;
}

std::string label_table(const ImportReport& report) {
  if (report.labelled == 0 && report.label_conflicts.empty()) return {};
  std::string text =
      fmt::format("\nlabels: of {}, geometry alone recognises {} as labelled ({:.2f} %)\n",
                  counted(report.labelled, "stroke"), report.agreed, percent * share(report.agreed, report.labelled));
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

std::string skipped_table(const ImportReport& report) {
  std::string text;
  for (const auto& [reason, files] : by_reason(report.skipped)) {
    if (text.empty()) text = "\nskipped\n";
    text += fmt::format("{:>8}  {}: {}{}\n", files.size(), reason, printable(files.front()),
                        files.size() > 1 ? ", ..." : "");
  }
  for (const std::string& note : report.notes) text += "\nnote: " + note + "\n";
  return text;
}

Json fit_json(const ImportReport& report) {
  Json rows = Json::array();
  for (const FitCount& count : report.within) {
    rows.push_back({{"error_em", count.error},
                    {"strokes", count.strokes},
                    {"strokes_share", share(count.strokes, report.strokes)},
                    {"characters", count.characters},
                    {"characters_share", share(count.characters, report.characters)}});
  }
  return rows;
}

Json worst_json(const ImportReport& report) {
  Json rows = Json::array();
  for (const StrokeError& worst : report.worst) {
    Json row = place_json(worst.place);
    row["id"] = worst.id;
    row["error_em"] = worst.error;
    rows.push_back(row);
  }
  return rows;
}

Json label_json(const ImportReport& report) {
  Json confusions = Json::array();
  for (const LabelConfusion& confusion : report.confusions) {
    confusions.push_back({{"label", confusion.label},
                          {"recognised_id", confusion.recognised},
                          {"strokes", confusion.count},
                          {"example", place_json(confusion.example)}});
  }
  Json conflicts = Json::array();
  for (const LabelConflict& conflict : report.label_conflicts) {
    Json row = place_json(conflict.place);
    row["label"] = conflict.label;
    row["resolution"] = to_string(conflict.resolution);
    row["recognised_id"] = conflict.recognised;
    row["id"] = conflict.id;
    conflicts.push_back(row);
  }
  Json unused = Json::array();
  for (const char32_t code : report.letters_unused) unused.push_back(encode_utf8(code));
  return {
      {"strokes", report.labelled}, {"agreed", report.agreed}, {"agreed_share", share(report.agreed, report.labelled)},
      {"confusions", confusions},   {"conflicts", conflicts},  {"letters_unused", unused}};
}

Json ids_json(const ImportReport& report) {
  Json ids = Json::object();
  for (int id = 1; id <= typical_stroke_count; ++id) {
    const int count = report.ids_used[static_cast<std::size_t>(id)];
    if (count > 0) ids[std::to_string(id)] = count;
  }
  return ids;
}

Json skipped_json(const ImportReport& report) {
  Json rows = Json::array();
  for (const auto& [reason, files] : by_reason(report.skipped)) {
    rows.push_back({{"reason", reason}, {"count", files.size()}, {"files", files}});
  }
  return rows;
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

std::string tables(const ImportResult& import, const ImportOutput& output) {
  const ImportReport& report = import.report;
  const Provenance& provenance = import.list.provenance;
  const bool fitted = report.kind != SourceKind::calligraphy;
  return fmt::format("{} ({}, {} bytes): {} from {}\n", output.file, output.format, output.bytes,
                     to_string(contents_of(import.list)), calligraphy::to_string(report.kind)) +
         fmt::format("source: {}\nlicence: {}\nattribution: {}\n", provenance.source, provenance.licence,
                     provenance.attribution) +
         (fitted ? fit_table(report) : "") + (report.measures.empty() ? "" : measures_table(report, output.bytes)) +
         ink_table(import) + id_table(report) + label_table(report) + skipped_table(report);
}

std::string json(const ImportResult& import, const ImportOutput& output) {
  const ImportReport& report = import.report;
  const Provenance& provenance = import.list.provenance;
  const Contents contents = contents_of(import.list);
  Json all = {{"file", output.file},
              {"format", output.format},
              {"bytes", output.bytes},
              {"kind", calligraphy::to_string(report.kind)},
              {"source", provenance.source},
              {"licence", provenance.licence},
              {"attribution", provenance.attribution},
              {"characters", contents.characters},
              {"strokes", contents.strokes},
              {"alternate_orders", contents.alternate_orders}};
  if (report.kind != SourceKind::calligraphy) {
    all["within"] = fit_json(report);
    all["worst"] = worst_json(report);
    all["labels"] = label_json(report);
    if (!report.measures.empty()) all["measures"] = measures_json(report, output.bytes);
    if (!report.ink.strokes.empty()) all["ink"] = ink_json(import);
  }
  all["ids_used"] = ids_json(report);
  all["skipped"] = skipped_json(report);
  all["notes"] = report.notes;
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // file names may be in any encoding
}

}  // namespace calligraphy::tools
