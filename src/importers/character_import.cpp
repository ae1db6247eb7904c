#include <calligraphy/importers/character_import.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <fstream>
#include <numbers>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/importers/stroke_fit.hpp>
#include <calligraphy/importers/stroke_warnings.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/character_text.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "base/archive_format.hpp"
#include "base/parallel.hpp"
#include "base/require.hpp"
#include "importers/check/import_measures.hpp"
#include "importers/check/imported_character.hpp"
#include "importers/fit/brush_stroke_fit.hpp"
#include "importers/fit/crossings.hpp"
#include "importers/fit/frechet.hpp"
#include "importers/fit/ink_fit.hpp"
#include "importers/fit/outline.hpp"
#include "importers/read/drawing_source.hpp"
#include "importers/read/file_name.hpp"
#include "importers/read/stroke_letters.hpp"

namespace calligraphy {
namespace {

constexpr int max_imported_strokes = 1'000'000;  // of an import; the largest source known has 148 thousand

/// True if the stroke runs across or against the typical one: then the label belongs to another stroke.
bool is_misdirected(const StrokeInput& stroke) {
  constexpr double most = 80.0 * std::numbers::pi / 180.0;
  const std::string_view elements = stroke.composition().elements();
  return start_direction_error({&typical_stroke(stroke.id), elements, 3, stroke.control_points, {}}) > most;
}

/// Fits a stroke. Its label decides unless the recognised kind follows the drawing much more closely or, if the label
/// is doubtful because it may belong to another stroke, just as closely.
StrokeInput fitted_stroke(const SourceStroke& drawn, const recognition::Outline& outline, bool doubtful,
                          ImportedStroke& result) {
  constexpr double of_pen = 0.018;     // [em]; a label is not questioned within this distance of the drawing
  constexpr double much_closer = 0.7;  // [1]
  FittedStroke fitted = recognition::fit_brush_stroke(drawn.path, outline, drawn.label_ids);
  result.recognised = fitted.recognised;
  result.label = drawn.label;
  result.label_known = !drawn.label_ids.empty();
  result.label_agrees = drawn.allows(result.recognised);
  if (result.label_known && !result.label_agrees) {
    doubtful = doubtful || is_misdirected(fitted.stroke);
    if (doubtful || fitted.unbent_error > (outline.empty() ? of_pen : recognition::reach_of_brush)) {
      FittedStroke shape = recognition::fit_brush_stroke(drawn.path, outline, {&result.recognised, 1});
      const double limit = doubtful ? std::max(of_pen, fitted.unbent_error) : much_closer * fitted.unbent_error;
      if (shape.unbent_error < limit) fitted = std::move(shape);
    }
  }
  result.error = fitted.error;
  result.half_width = fitted.half_width;
  return std::move(fitted.stroke);
}

/// The fitted strokes, and what the report says about them.
struct LabelledFit {
  std::vector<StrokeInput> inputs;
  std::vector<ImportedStroke> strokes;
};

/// @throws FormatError naming the place and the stroke that cannot be fitted
LabelledFit fit_labelled(const std::vector<SourceStroke>& drawn, const std::vector<recognition::Outline>& outlines,
                         const DrawingFile& file) {
  LabelledFit result{std::vector<StrokeInput>(drawn.size()), std::vector<ImportedStroke>(drawn.size())};
  const auto fit_one = [&](std::size_t i, bool doubtful) {
    try {
      result.inputs[i] = fitted_stroke(drawn[i], outlines[i], doubtful, result.strokes[i]);
    } catch (const ValueError& error) {
      throw FormatError(file.place + ": stroke " + std::to_string(i + 1) + ": " + error.what());
    }
  };
  for (std::size_t i = 0; i < drawn.size(); ++i) fit_one(i, false);

  // Letters are those of another stroke order if geometry alone recognises something else for many of them: then these
  // are doubtful.
  constexpr std::ptrdiff_t many = 5;  // in the right order there are up to four
  const auto is_contradicted = [](const ImportedStroke& stroke) { return stroke.label_known && !stroke.label_agrees; };
  const bool has_letters = file.form != DrawingForm::kanjivg;
  if (!has_letters || std::count_if(result.strokes.begin(), result.strokes.end(), is_contradicted) < many) {
    return result;
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (is_contradicted(result.strokes[i])) fit_one(i, true);
  }
  return result;
}

/// Makes strokes cross that cross in the drawing. Returns the crossings of the drawing.
std::vector<recognition::CrossingStrokes> keep_crossings(const std::vector<SourceStroke>& drawn, LabelledFit& fit) {
  std::vector<recognition::Path> sources;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    sources.push_back(recognition::without_ends(drawn[i].path, fit.strokes[i].half_width));
  }
  std::vector<recognition::CrossingStrokes> crossings = recognition::crossing_strokes(sources);
  for (const std::size_t i : recognition::keep_crossings(crossings, sources, fit.inputs)) {
    fit.strokes[i].error = recognition::fit_error(fit.inputs[i], drawn[i].path, fit.strokes[i].half_width);
  }
  return crossings;
}

/// Adds ink, provided that every stroke has an outline.
void add_ink(const std::vector<SourceStroke>& drawn, const std::vector<recognition::Outline>& outlines,
             InkDetail detail, std::vector<StrokeInput>& strokes) {
  const auto is_missing = [](const recognition::Outline& outline) { return outline.empty(); };
  if (detail == InkDetail::none || std::any_of(outlines.begin(), outlines.end(), is_missing)) return;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    strokes[i].ink = recognition::fit_ink(recognition::view_of(strokes[i]), drawn[i].path, outlines[i], detail);
  }
}

/// The character made from one drawing.
ImportedCharacter imported(const DrawingFile& file, Drawing drawing, const ImportOptions& options) {
  std::vector<recognition::Outline> outlines;
  for (const SourceStroke& stroke : drawing.strokes) outlines.emplace_back(std::span(stroke.outline));
  LabelledFit fit = fit_labelled(drawing.strokes, outlines, file);
  const std::vector<recognition::CrossingStrokes> crossings = keep_crossings(drawing.strokes, fit);
  add_ink(drawing.strokes, outlines, options.ink, fit.inputs);
  ImportedCharacter result;
  try {
    result.character = make_character(file.character.code, fit.inputs);
  } catch (const ValueError& error) {
    throw FormatError(file.place + ": " + error.what());
  }
  result.character.order = file.character.order;
  result.strokes = std::move(fit.strokes);
  result.letters_unused = drawing.letters_unused;
  result.correction = std::move(drawing.correction);
  result.notice = std::move(drawing.notice);
  if (options.report) measure_import(drawing.strokes, outlines, fit.inputs, crossings, result);
  return result;
}

/// What was made of one file.
struct FileResult {
  ImportedCharacter character;
  std::string problem;  ///< message of the error if it is unusable
};

/// Moves the usable characters; the others become skipped files.
/// @throws FormatError for the first file if none is usable
std::vector<ImportedCharacter> usable_of(std::vector<FileResult>& results, DrawingSource& source) {
  std::vector<ImportedCharacter> characters;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const std::string& problem = results[i].problem;
    if (problem.empty()) {
      characters.push_back(std::move(results[i].character));
      continue;
    }
    const std::string place = source.files[i].place + ": ";
    source.skipped.push_back(
        {source.files[i].path, problem.starts_with(place) ? problem.substr(place.size()) : problem, true});
  }
  if (characters.empty()) throw FormatError(results.front().problem);
  std::stable_sort(source.skipped.begin(), source.skipped.end(),
                   [](const SkippedFile& a, const SkippedFile& b) { return a.path < b.path; });
  return characters;
}

ImportResult import_drawings(const std::filesystem::path& path, const ImportOptions& options) {
  const StrokeLetters letters = options.letters.empty() ? StrokeLetters() : read_stroke_letters(options.letters);
  DrawingSource source = read_drawings(path, options);
  std::vector<FileResult> results(source.files.size());
  std::atomic<int> strokes = 0;
  parallel_for(source.files.size(), options.threads, options.progress, [&](std::size_t i) {
    try {
      Drawing drawing = parse_drawing(source.files[i], letters, options.corrections);
      strokes += static_cast<int>(drawing.strokes.size());
      if (strokes <= max_imported_strokes) {
        results[i].character = imported(source.files[i], std::move(drawing), options);
      }
    } catch (const FormatError& error) {
      if (options.strict) throw;
      results[i].problem = error.what();
    }
    if (strokes > max_imported_strokes) {
      throw FormatError(path.string() + ": more than " + std::to_string(max_imported_strokes) + " strokes");
    }
  });
  std::vector<ImportedCharacter> characters = usable_of(results, source);
  ImportResult result{{}, report_of(source.kind, characters)};
  result.list.provenance = provenance(source, options, characters.front().notice, result.report.notes);
  if (!result.report.corrected.empty()) result.list.provenance.attribution += "; some stroke orders corrected";
  result.report.skipped = std::move(source.skipped);
  for (ImportedCharacter& character : characters) result.list.characters.push_back(std::move(character.character));
  return result;
}

ImportResult import_own_format(const std::filesystem::path& source, const ImportOptions& options) {
  check_applies(options, SourceKind::calligraphy);
  CharacterList list = CharacterSet::open(source.string()).list();
  if (!options.only.empty()) {
    std::erase_if(list.characters, [&](const Character& c) { return options.only.find(c.code) == options.only.npos; });
  }
  if (options.ink == InkDetail::none) {
    for (Character& character : list.characters) character.physics.ink.clear();
  }
  if (list.characters.empty())
    throw FormatError(source.string() + ": contains no character" +
                      (options.only.empty() ? "" : " that was requested"));
  std::stable_sort(list.characters.begin(), list.characters.end(),
                   [](const Character& a, const Character& b) { return a.code < b.code; });
  ImportReport report = report_of(list);
  return {std::move(list), std::move(report)};
}

void check(const ImportOptions& options) {
  constexpr int max_threads = 256;
  require_within("threads", options.threads, "", 0, max_threads);
  if (options.date.size() > 40 || options.date.find_first_of("\r\n") != std::string::npos) {
    throw ValueError("date '" + options.date.substr(0, 40) + "': expected one line of at most 40 bytes");
  }
}

}  // namespace

bool is_own_format(const std::filesystem::path& source) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(source, failure)) return false;
  if (parse_file_name(source.filename().string()).form != FileForm::none) return false;
  std::ifstream in(source, std::ios::binary);
  std::string start(archive_start, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  if (!archive_format(start).empty()) return false;
  const std::size_t first = start.find_first_not_of(" \t\r\n", start.starts_with("\xEF\xBB\xBF") ? 3 : 0);
  return first == start.npos || (start[first] != '{' && start[first] != '[' && start[first] != '<');
}

ImportResult import_characters(const std::filesystem::path& source, const ImportOptions& options) {
  check(options);
  ImportOptions asked = options;
  for (const char32_t code : options.only) {
    if (unified(code) != code) asked.only += unified(code);
  }
  return is_own_format(source) ? import_own_format(source, asked) : import_drawings(source, asked);
}

}  // namespace calligraphy
