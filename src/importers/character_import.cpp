#include <calligraphy/importers/character_import.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/character_set.hpp>

#include "base/archive_format.hpp"
#include "base/parallel.hpp"
#include "base/require.hpp"
#include "importers/check/import_measures.hpp"
#include "importers/check/imported_character.hpp"
#include "importers/fit/crossings.hpp"
#include "importers/fit/frechet.hpp"
#include "importers/fit/ink_fit.hpp"
#include "importers/read/drawing_source.hpp"
#include "importers/read/stroke_letters.hpp"
#include "labelled_fit.hpp"

namespace calligraphy {
namespace {

constexpr int max_imported_strokes = 1'000'000;  // of an import; the largest source known has 148 thousand

/// Makes strokes cross that cross in the drawing. Returns the crossings of the drawing.
std::vector<recognition::CrossingStrokes> keep_crossings(const std::vector<DrawnStroke>& drawn, LabelledFit& fit) {
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
void add_ink(const std::vector<DrawnStroke>& drawn, InkDetail detail, std::vector<StrokeInput>& strokes) {
  const auto has_outline = [](const DrawnStroke& stroke) { return stroke.outline.size() >= 3; };
  if (detail == InkDetail::none || !std::all_of(drawn.begin(), drawn.end(), has_outline)) return;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    strokes[i].ink = recognition::fit_ink(recognition::flattened(strokes[i]), drawn[i].path, drawn[i].outline, detail);
  }
}

/// The character made from one drawing.
ImportedCharacter imported(const DrawingFile& file, Drawing drawing, const ImportOptions& options) {
  LabelledFit fit = fit_labelled(drawing.strokes, file);
  const std::vector<recognition::CrossingStrokes> crossings = keep_crossings(drawing.strokes, fit);
  add_ink(drawing.strokes, options.ink, fit.inputs);
  ImportedCharacter result;
  try {
    result.character = make_character(file.character.code, fit.inputs);
  } catch (const ValueError& error) {
    throw FormatError(file.place + ": " + error.what());
  }
  result.character.order = file.character.order;
  result.strokes = std::move(fit.strokes);
  result.letters_unused = drawing.letters_unused;
  result.notice = std::move(drawing.notice);
  if (options.report) measure_import(drawing.strokes, fit.inputs, crossings, result);
  return result;
}

ImportResult import_drawings(const std::filesystem::path& path, const ImportOptions& options) {
  const StrokeLetters letters = options.letters.empty() ? StrokeLetters() : read_stroke_letters(options.letters);
  DrawingSource source = read_drawings(path, options);
  std::vector<ImportedCharacter> characters(source.files.size());
  std::atomic<int> strokes = 0;
  parallel_for(source.files.size(), options.threads, options.progress, [&](std::size_t i) {
    Drawing drawing = parse_drawing(source.files[i], letters);
    if ((strokes += static_cast<int>(drawing.strokes.size())) > max_imported_strokes) {
      throw FormatError(path.string() + ": more than " + std::to_string(max_imported_strokes) + " strokes");
    }
    characters[i] = imported(source.files[i], std::move(drawing), options);
  });
  ImportResult result{{}, report_of(source.kind, characters)};
  result.list.provenance = provenance(source, options, characters.front().notice, result.report.notes);
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
  std::ifstream in(source, std::ios::binary);
  std::string start(archive_start, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  const std::string_view archive = archive_format(start);
  return archive != "gzip" && archive != "tar";
}

ImportResult import_characters(const std::filesystem::path& source, const ImportOptions& options) {
  check(options);
  return is_own_format(source) ? import_own_format(source, options) : import_drawings(source, options);
}

}  // namespace calligraphy
