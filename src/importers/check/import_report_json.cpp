#include "import_report_json.hpp"

#include <string>

#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>

#include "import_report_figures.hpp"

namespace calligraphy {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson place_json(const StrokeReference& place) {
  return {{"character", encode_utf8(place.code)}, {"order", place.order}, {"stroke", place.stroke}};
}

OrderedJson stroke_json(const StrokeMeasures& stroke) {
  OrderedJson row = place_json(stroke.place);
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

OrderedJson measures_json(const ImportReport& report, std::size_t bytes) {
  const int length = count_of(report, keeps_length);
  OrderedJson strokes = OrderedJson::array();
  for (const StrokeMeasures& stroke : report.measures) strokes.push_back(stroke_json(stroke));
  return {{"running_back", count_of(report, runs_back)},
          {"length_kept", length},
          {"length_kept_share", share_of(length, static_cast<int>(report.measures.size()))},
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

OrderedJson fit_json(const ImportReport& report) {
  OrderedJson rows = OrderedJson::array();
  for (const FitCount& count : report.within) {
    rows.push_back({{"error_em", count.error},
                    {"strokes", count.strokes},
                    {"strokes_share", share_of(count.strokes, report.strokes)},
                    {"characters", count.characters},
                    {"characters_share", share_of(count.characters, report.characters)}});
  }
  return rows;
}

OrderedJson worst_json(const ImportReport& report) {
  OrderedJson rows = OrderedJson::array();
  for (const StrokeError& worst : report.worst) {
    OrderedJson row = place_json(worst.place);
    row["id"] = worst.id;
    row["error_em"] = worst.error;
    rows.push_back(row);
  }
  return rows;
}

OrderedJson label_json(const ImportReport& report) {
  OrderedJson confusions = OrderedJson::array();
  for (const LabelConfusion& confusion : report.confusions) {
    confusions.push_back({{"label", confusion.label},
                          {"recognised_id", confusion.recognised},
                          {"strokes", confusion.count},
                          {"example", place_json(confusion.example)}});
  }
  OrderedJson conflicts = OrderedJson::array();
  for (const LabelConflict& conflict : report.label_conflicts) {
    OrderedJson row = place_json(conflict.place);
    row["label"] = conflict.label;
    row["resolution"] = to_string(conflict.resolution);
    row["recognised_id"] = conflict.recognised;
    row["id"] = conflict.id;
    conflicts.push_back(row);
  }
  OrderedJson unused = OrderedJson::array();
  for (const char32_t code : report.letters_unused) unused.push_back(encode_utf8(code));
  return {{"strokes", report.labelled},
          {"agreed", report.agreed},
          {"agreed_share", share_of(report.agreed, report.labelled)},
          {"confusions", confusions},
          {"conflicts", conflicts},
          {"letters_unused", unused}};
}

OrderedJson ids_json(const ImportReport& report) {
  OrderedJson ids = OrderedJson::object();
  for (int id = 1; id <= typical_stroke_count; ++id) {
    const int count = report.ids_used[static_cast<std::size_t>(id)];
    if (count > 0) ids[std::to_string(id)] = count;
  }
  return ids;
}

OrderedJson corrected_json(const ImportReport& report) {
  OrderedJson rows = OrderedJson::array();
  for (const OrderCorrected& each : report.corrected) {
    rows.push_back({{"character", encode_utf8(each.code)}, {"reason", each.reason}});
  }
  return rows;
}

OrderedJson skipped_json(const ImportReport& report) {
  OrderedJson rows = OrderedJson::array();
  for (const bool unusable : {false, true}) {
    for (const auto& [reason, files] : skipped_by_reason(report, unusable)) {
      rows.push_back({{"reason", reason}, {"unusable", unusable}, {"count", files.size()}, {"files", files}});
    }
  }
  return rows;
}

OrderedJson hooks_json(const ImportReport& report) {
  OrderedJson rows = OrderedJson::array();
  for (const NotchFigures& hook : notch_figures(report)) {
    rows.push_back(
        {{"id", hook.id}, {"strokes", hook.strokes}, {"notches", hook.ink}, {"source_notches", hook.source}});
  }
  return rows;
}

}  // namespace

OrderedJson ink_json(const ImportResult& import) {
  OrderedJson result = OrderedJson::object();
  for (const InkFigures& ink : ink_figures(import)) {
    result[ink.key] = {{"bytes_per_character", ink.bytes_per_character},
                       {"iou_mean", ink.mean},
                       {"iou_p5", ink.low},
                       {"iou_characters_mean", ink.character_mean},
                       {"contacts", ink.measures->contacts},
                       {"contacts_kept", ink.measures->contacts_kept},
                       {"apart", ink.measures->apart},
                       {"new_contacts", ink.measures->new_contacts},
                       {"uncovered_share", ink.uncovered},
                       {"beyond_share", ink.beyond},
                       {"iou", ink.measures->strokes},
                       {"uncovered", ink.measures->uncovered},
                       {"beyond", ink.measures->beyond},
                       {"notches", ink.measures->notches},
                       {"source_notches", ink.measures->source_notches}};
  }
  return result;
}

OrderedJson report_json(const ImportResult& import, std::size_t bytes) {
  const ImportReport& report = import.report;
  OrderedJson all = OrderedJson::object();
  if (report.kind != SourceKind::calligraphy) {
    all["within"] = fit_json(report);
    all["worst"] = worst_json(report);
    all["labels"] = label_json(report);
    if (!report.measures.empty()) all["measures"] = measures_json(report, bytes);
    if (!report.ink.strokes.empty()) all["ink"] = ink_json(import);
    if (!report.ink.strokes.empty()) all["hooks"] = hooks_json(report);
  }
  all["ids_used"] = ids_json(report);
  const bool is_brush = report.kind != SourceKind::kanjivg && report.kind != SourceKind::calligraphy;
  if (is_brush) all["corrected"] = corrected_json(report);
  all["skipped"] = skipped_json(report);
  all["notes"] = report.notes;
  return all;
}

OrderedJson warnings_json(const std::vector<CharacterWarnings>& characters) {
  OrderedJson rows = OrderedJson::array();
  for (const CharacterWarnings& character : characters) {
    for (const StrokeWarning& warning : character.warnings) {
      OrderedJson row = place_json({character.code, character.order, warning.stroke});
      row["kind"] = to_string(warning.kind);
      row["what"] = warning.what;
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace calligraphy
