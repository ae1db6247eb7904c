// Characters of other collections, recognised and fitted as typical strokes.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <calligraphy/importers/source_files.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy {

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
const char* name_of(SourceKind kind) noexcept;

/// A stroke of the characters imported.
struct StrokePlace {
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
  StrokePlace place;
  int id;
  double error;  ///< largest distance between stroke and drawing, both ways [em]
};

/// What became of a label or letter that does not say what the shape says.
enum class LabelFate {
  unknown,   ///< nobody knows it: the shape decided
  obeyed,    ///< a stroke of the label's kind follows the drawing well enough: the label decided
  overruled  ///< no stroke of the label's kind does: the shape decided
};

struct LabelDoubt {
  StrokePlace place;
  std::string label;
  LabelFate fate;
  int recognised;  ///< id by geometry alone
  int id;          ///< as imported
};

/// How often a label goes with an id recognised by geometry alone that is none of the label's.
struct Confusion {
  std::string label;
  int recognised;
  int count;
  StrokePlace example;
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

  int labelled = 0;                      ///< strokes with a label or letter that is known
  int agreed = 0;                        ///< of these, recognised by geometry alone as what the label says
  std::vector<Confusion> confusions;     ///< the commonest first
  std::vector<LabelDoubt> label_doubts;  ///< by character and stroke
  std::vector<char32_t> letters_unused;  ///< characters with more or fewer letters than strokes

  std::vector<SkippedFile> skipped;
  std::vector<std::string> notes;  ///< what else whoever passes the characters on should know
};

struct Import {
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
Import import_characters(const std::filesystem::path& source, const ImportOptions& options = {});

}  // namespace calligraphy
