#include <calligraphy/importers/character_import.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/stroke_fit.hpp>
#include <calligraphy/importers/stroke_warnings.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/set_encoding.hpp>
#include <calligraphy/model/stroke_polyline.hpp>
#include <calligraphy/model/typical_ink.hpp>

#include "base/archive_format.hpp"
#include "base/charconv.hpp"
#include "base/parallel.hpp"
#include "base/require.hpp"
#include "crossings.hpp"
#include "frechet.hpp"
#include "hanzi_writer.hpp"
#include "imported_character.hpp"
#include "ink_fit.hpp"
#include "ink_measures.hpp"
#include "kanjivg.hpp"
#include "outline.hpp"
#include "shape_contradiction.hpp"
#include "source_files.hpp"
#include "stroke_labels.hpp"
#include "stroke_letters.hpp"
#include "stroke_measures.hpp"
#include "stroke_polyline.hpp"

namespace calligraphy {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view licence_file = "ARPHICPL.TXT";
constexpr std::string_view package_file = "package.json";
constexpr int max_imported_strokes = 1'000'000;  // of an import; the largest source known has 148 thousand
constexpr std::size_t max_order = 64;            // [byte]

/// The character in a file of a source, according to the file name.
struct FileName {
  SourceKind kind;
  char32_t code;
  std::string order;
};

bool is_ideograph(char32_t code) {
  return (code >= 0x3400 && code <= 0x4DBF) || (code >= 0x4E00 && code <= 0x9FFF) ||
         (code >= 0xF900 && code <= 0xFAFF) || (code >= 0x20000 && code <= 0x3FFFF);
}

bool is_word(std::string_view text) {
  return !text.empty() && text.size() <= max_order && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
  });
}

/// 04e86.svg or 04e86-Kaisho.svg.
std::optional<FileName> kanjivg_name(std::string_view stem) {
  constexpr std::size_t digits = 5;
  unsigned code = 0;
  if (stem.size() < digits) return std::nullopt;
  const char* const end = stem.data() + digits;
  const auto [rest, error] = from_chars(stem.data(), end, code, 16);
  if (error != std::errc() || rest != end || code == 0) return std::nullopt;
  if (stem.size() == digits) return FileName{SourceKind::kanjivg, code, {}};
  if (stem[digits] != '-' || !is_word(stem.substr(digits + 1))) return std::nullopt;
  return FileName{SourceKind::kanjivg, code, std::string(stem.substr(digits + 1))};
}

/// 永.json.
std::optional<FileName> hanzi_writer_name(std::string_view stem) {
  try {
    const std::u32string codes = decode_utf8(stem);
    if (codes.size() == 1 && codes[0] > 0x7F) return FileName{SourceKind::hanzi_writer_data, codes[0], {}};
  } catch (const FormatError&) {  // the name is in another encoding
  }
  return std::nullopt;
}

std::optional<FileName> parse_name(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  if (name.substr(dot) == ".svg") return kanjivg_name(name.substr(0, dot));
  if (name.substr(dot) == ".json") return hanzi_writer_name(name.substr(0, dot));
  return std::nullopt;
}

/// True for a file of the package itself, not of a nested one.
bool is_package_file(std::string_view path, std::string_view name) {
  return path == name || path == "package/" + std::string(name);
}

/// A text as it is redistributed: UTF-8 with '\n' line ends. @throws FormatError naming the place
std::string with_plain_line_ends(std::string_view text, const std::string& place) {
  try {
    decode_utf8(text);
  } catch (const FormatError& error) {
    throw FormatError(place + ": " + error.what());
  }
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
    plain += text[i] == '\r' ? '\n' : text[i];
  }
  return plain;
}

/// @throws ValueError naming an option that has no effect on a source of this kind
void check_applies(const ImportOptions& options, SourceKind kind) {
  const auto refuse = [kind](bool given, const std::string& option, std::initializer_list<SourceKind> kinds) {
    if (!given || std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) return;
    std::string names;
    for (const SourceKind each : kinds) names += (names.empty() ? "" : " and ") + std::string(to_string(each));
    throw ValueError(option + ": applies only to " + names + ", not to " +
                     (kind == SourceKind::calligraphy ? "a set file or the text format" : to_string(kind)));
  };
  refuse(!options.letters.empty(), "letters", {SourceKind::hanzi_writer_data});
  refuse(options.ink == InkDetail::half_widths, "ink half-widths", {SourceKind::hanzi_writer_data});
  refuse(options.alternates, "alternates", {SourceKind::kanjivg});
  refuse(!options.ideographs_only, "ideographs_only", {SourceKind::kanjivg});
  refuse(options.report, "report", {SourceKind::hanzi_writer_data, SourceKind::kanjivg});
  refuse(!options.date.empty(), "date", {SourceKind::hanzi_writer_data, SourceKind::kanjivg});
}

/// Decides which files of a source are read: each character once.
class Selection {
 public:
  explicit Selection(const ImportOptions& options) : options_(options) {}

  std::string skip_reason(std::string_view path) {
    if (is_package_file(path, licence_file) || is_package_file(path, package_file)) return {};
    const std::optional<FileName> name = parse_name(path);
    if (!name) return "not a character file";
    const bool mixed = name->kind == SourceKind::kanjivg;  // hanzi-writer-data has radicals beside ideographs
    if (mixed && options_.ideographs_only && !is_ideograph(name->code)) return "not an ideograph";
    if (!name->order.empty() && !options_.alternates) return "an alternate order";
    if (!options_.only.empty() && options_.only.find(name->code) == std::u32string::npos) return "not requested";
    if (!seen_.emplace(name->kind, name->code, name->order).second) return "a duplicate of an earlier file";
    return {};
  }

 private:
  const ImportOptions& options_;
  std::set<std::tuple<SourceKind, char32_t, std::string>> seen_;
};

struct Drawing {
  FileName name;
  std::string place;  ///< for messages: source and path
  std::string text;
};

/// The drawn path of a stroke, and its label in the source.
struct StrokeOfDrawing {
  std::vector<Point> path;
  std::vector<Point> outline;  ///< of a brush stroke
  std::string label;
  std::span<const int> label_ids;

  bool allows(int id) const { return std::find(label_ids.begin(), label_ids.end(), id) != label_ids.end(); }
};

/// True if the stroke runs across or against the typical one: then the label is that of another stroke.
bool is_misdirected(const StrokeInput& stroke) {
  constexpr double most = 80.0 * std::numbers::pi / 180.0;
  const std::string_view elements = stroke.composition().elements();
  return start_direction_error({&typical_stroke(stroke.id), elements, 3, stroke.control_points, {}}) > most;
}

/// Fits a stroke. Its label decides unless the shape follows the drawing much more closely or, if the label is doubtful
/// since it may be another stroke's, as closely.
StrokeInput fit(const StrokeOfDrawing& drawn, bool doubtful, ImportedStroke& result) {
  constexpr double of_pen = 0.018;     // [em]; a label is not questioned within this distance of the drawing
  constexpr double much_closer = 0.7;  // [1]
  FittedStroke fitted = fit_stroke(drawn.path, {drawn.outline, drawn.label_ids});
  result.recognised = fitted.recognised;
  result.label = drawn.label;
  result.label_known = !drawn.label_ids.empty();
  result.label_agrees = drawn.allows(result.recognised);
  if (result.label_known && !result.label_agrees) {
    doubtful = doubtful || is_misdirected(fitted.stroke);
    if (doubtful || fitted.unbent_error > (drawn.outline.empty() ? of_pen : recognition::reach_of_brush)) {
      FittedStroke shape = fit_stroke(drawn.path, {drawn.outline, {&result.recognised, 1}});
      const double limit = doubtful ? std::max(of_pen, fitted.unbent_error) : much_closer * fitted.unbent_error;
      if (shape.unbent_error < limit) fitted = std::move(shape);
    }
  }
  result.error = fitted.error;
  result.half_width = fitted.half_width;
  return std::move(fitted.stroke);
}

/// True if the drawing clearly contradicts the label. One that overrides the label does, unless the label is a dot,
/// which may fall in any direction.
bool contradicts_label(const StrokeOfDrawing& drawn, const ImportedStroke& stroke, int id) {
  if (stroke.label_agrees || drawn.label_ids.empty()) return false;
  if (id == stroke.recognised && !drawn.allows(8)) return true;
  return recognition::contradicts(drawn.path, !drawn.outline.empty(), drawn.label_ids, stroke.recognised);
}

class Importer {
 public:
  Importer(const fs::path& source, const ImportOptions& options) : source_(source), options_(options) {
    if (!options.letters.empty()) letters_ = read_stroke_letters(options.letters);
  }

  ImportResult run() {
    read();
    std::vector<ImportedCharacter> characters(drawings_.size());
    parallel_for(drawings_.size(), options_.threads, options_.progress,
                 [&](std::size_t i) { characters[i] = imported(drawings_[i]); });
    ImportResult result{{provenance(characters.front().notice), {}}, report_of(kind_, characters)};
    result.report.skipped = std::move(skipped_);
    result.report.notes = std::move(notes_);
    for (ImportedCharacter& character : characters) result.list.characters.push_back(std::move(character.character));
    return result;
  }

 private:
  void read() {
    Selection selection(options_);
    SourceFiles found = read_source(
        source_,
        [&](std::string_view path) {
          if (options_.progress) options_.progress(0.0);  // reading alone may take seconds
          return selection.skip_reason(path);
        },
        options_.limits);
    skipped_ = std::move(found.skipped);
    for (SourceFile& file : found.files) {
      const std::string place = source_.string() + ": " + file.path;
      if (is_package_file(file.path, licence_file)) {
        licence_text_ = with_plain_line_ends(file.text, place);
      } else if (is_package_file(file.path, package_file)) {
        package_ = std::move(file.text);
      } else {
        drawings_.push_back({*parse_name(file.path), place, std::move(file.text)});
      }
    }
    recognise();
    std::sort(drawings_.begin(), drawings_.end(), [](const Drawing& a, const Drawing& b) {
      return std::tie(a.name.code, a.name.order) < std::tie(b.name.code, b.name.order);
    });
  }

  void recognise() {
    if (drawings_.empty()) {
      const char32_t wanted = options_.only.empty() ? U'永' : options_.only.front();
      char number[16];
      std::snprintf(number, sizeof number, "%05x", static_cast<unsigned>(wanted));
      throw FormatError(source_.string() + ": contains no character file" +
                        (options_.only.empty() ? "" : " that was requested") + ": neither " + encode_utf8(wanted) +
                        ".json as in hanzi-writer-data nor " + number + ".svg as in KanjiVG");
    }
    kind_ = drawings_.front().name.kind;
    for (const Drawing& drawing : drawings_) {
      if (drawing.name.kind == kind_) continue;
      throw FormatError(source_.string() + ": contains both hanzi-writer-data and KanjiVG: " + drawings_.front().place +
                        " and " + drawing.place);
    }
    check_applies(options_, kind_);
  }

  ImportedCharacter imported(const Drawing& drawing) {
    ImportedCharacter result;
    const std::vector<StrokeOfDrawing> drawn = drawn_strokes(drawing, result);
    if ((strokes_ += static_cast<int>(drawn.size())) > max_imported_strokes) {
      throw FormatError(source_.string() + ": more than " + std::to_string(max_imported_strokes) + " strokes");
    }
    std::vector<StrokeInput> strokes = fitted(drawn, drawing.place, result);
    const std::vector<recognition::CrossingStrokes> crossings = keep_crossings(drawn, strokes, result);
    if (options_.ink != InkDetail::none && have_outlines(drawn)) add_ink(drawn, strokes);
    try {
      result.character = make_character(drawing.name.code, strokes);
    } catch (const ValueError& error) {
      throw FormatError(drawing.place + ": " + error.what());
    }
    result.character.order = drawing.name.order;
    if (options_.report) measure(drawn, strokes, crossings, result);
    return result;
  }

  /// The strokes of a drawing. A string of letters is that of another order if many of them are not what geometry alone
  /// recognises: then these are doubtful.
  std::vector<StrokeInput> fitted(const std::vector<StrokeOfDrawing>& drawn, const std::string& place,
                                  ImportedCharacter& result) const {
    constexpr std::ptrdiff_t many = 5;  // in the right order there are up to four
    std::vector<StrokeInput> strokes(drawn.size());
    result.strokes.resize(drawn.size());
    const auto fit_one = [&](std::size_t i, bool doubtful) {
      try {
        strokes[i] = fit(drawn[i], doubtful, result.strokes[i]);
      } catch (const ValueError& error) {
        throw FormatError(place + ": stroke " + std::to_string(i + 1) + ": " + error.what());
      }
    };
    for (std::size_t i = 0; i < drawn.size(); ++i) fit_one(i, false);
    const auto contradicted = [](const ImportedStroke& stroke) { return stroke.label_known && !stroke.label_agrees; };
    if (kind_ != SourceKind::hanzi_writer_data ||
        std::count_if(result.strokes.begin(), result.strokes.end(), contradicted) < many) {
      return strokes;
    }
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (contradicted(result.strokes[i])) fit_one(i, true);
    }
    return strokes;
  }

  static bool have_outlines(const std::vector<StrokeOfDrawing>& drawn) {
    return std::all_of(drawn.begin(), drawn.end(), [](const auto& stroke) { return stroke.outline.size() >= 3; });
  }

  void add_ink(const std::vector<StrokeOfDrawing>& drawn, std::vector<StrokeInput>& strokes) const {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      strokes[i].ink =
          recognition::fit_ink(recognition::flattened(strokes[i]), drawn[i].path, drawn[i].outline, options_.ink);
    }
  }

  /// Lets strokes cross that cross in the drawing. Returns the crossings of the drawing.
  static std::vector<recognition::CrossingStrokes> keep_crossings(const std::vector<StrokeOfDrawing>& drawn,
                                                                  std::vector<StrokeInput>& strokes,
                                                                  ImportedCharacter& result) {
    std::vector<recognition::Path> sources;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      sources.push_back(recognition::without_ends(drawn[i].path, result.strokes[i].half_width));
    }
    std::vector<recognition::CrossingStrokes> crossings = recognition::crossing_strokes(sources);
    for (const std::size_t i : recognition::keep_crossings(crossings, sources, strokes)) {
      result.strokes[i].error = recognition::fit_error(strokes[i], drawn[i].path, result.strokes[i].half_width);
    }
    return crossings;
  }

  static void measure(const std::vector<StrokeOfDrawing>& drawn, const std::vector<StrokeInput>& strokes,
                      const std::vector<recognition::CrossingStrokes>& crossings, ImportedCharacter& result) {
    std::vector<recognition::Path> paths;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      paths.push_back(recognition::flattened(strokes[i]));
      StrokeMeasures& measures = result.measures.emplace_back(
          recognition::measure_stroke(paths.back(), drawn[i].path, result.strokes[i].half_width));
      ImportedStroke& stroke = result.strokes[i];
      measures.place = {result.character.code, result.character.order, static_cast<int>(i) + 1};
      measures.id = strokes[i].id;
      measures.frechet = stroke.error;
      const std::vector<Point>& outline = drawn[i].outline;
      measures.outline_size = outline.empty() ? 0.0 : recognition::box_of(outline).diagonal().norm();
      stroke.contradicts_label = contradicts_label(drawn[i], stroke, strokes[i].id);
    }
    if (strokes.front().ink) measure_ink(drawn, paths, strokes, result);
    result.crossings.source = static_cast<int>(crossings.size());
    for (const auto& [one, other, at] : crossings) {
      if (recognition::crossing_of(paths[one], paths[other])) {
        ++result.crossings.kept;
      } else {
        result.lost_crossings.push_back({result.measures[one].place, static_cast<int>(other) + 1});
      }
    }
  }

  /// The ink of the strokes as a set file at standard precision holds it.
  static std::vector<std::vector<InkDisc>> stored_ink(char32_t code, const std::vector<StrokeInput>& strokes) {
    constexpr double spacing = 0.003;  // [em]
    const CharacterSet set =
        CharacterSet::from_bytes(encode_character_set({{}, {make_character(code, strokes)}}), "measured");
    const Character stored = set.find(code)->character();
    std::vector<std::vector<InkDisc>> inks;
    for (const Stroke& stroke : calligraphy::strokes(stored)) {
      inks.push_back(ink_discs(stroke_polyline(stroke), *stroke.ink, spacing));
    }
    return inks;
  }

  /// The ink as stored and, to compare with it, without offsets, and that of the strokes' kinds.
  static void measure_ink(const std::vector<StrokeOfDrawing>& drawn, const std::vector<recognition::Path>& paths,
                          std::vector<StrokeInput> strokes, ImportedCharacter& result) {
    const char32_t code = result.character.code;
    std::vector<std::span<const Point>> outlines;
    for (const StrokeOfDrawing& stroke : drawn) outlines.emplace_back(stroke.outline);
    result.ink = recognition::measure_ink(outlines, stored_ink(code, strokes));
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      strokes[i].ink = recognition::fit_ink(paths[i], drawn[i].path, drawn[i].outline, InkDetail::half_widths);
    }
    result.plain_ink = recognition::measure_ink(outlines, stored_ink(code, strokes));
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      strokes[i].ink = typical_ink(strokes[i].id, result.strokes[i].half_width);
    }
    result.typical_ink = recognition::measure_ink(outlines, stored_ink(code, strokes));
  }

  std::vector<StrokeOfDrawing> drawn_strokes(const Drawing& drawing, ImportedCharacter& result) const {
    std::vector<StrokeOfDrawing> drawn;
    if (kind_ == SourceKind::kanjivg) {
      KanjivgDrawing parsed = parse_kanjivg(drawing.text, drawing.place);
      result.notice = with_plain_line_ends(parsed.notice, drawing.place);
      for (KanjivgStroke& stroke : parsed.strokes) {
        const std::span<const int> ids = ids_of_kanjivg_label(stroke.label);
        drawn.push_back({std::move(stroke.path), {}, std::move(stroke.label), ids});
      }
      return drawn;
    }
    for (BrushStroke& stroke : parse_hanzi_writer(drawing.text, drawing.place)) {
      drawn.push_back({std::move(stroke.median), std::move(stroke.outline), {}, {}});
    }
    const auto found = letters_.find(drawing.name.code);
    if (found == letters_.end()) return drawn;
    result.letters_unused = found->second.size() != drawn.size();
    for (std::size_t i = 0; i < drawn.size() && !result.letters_unused; ++i) {
      drawn[i].label = found->second[i];
      drawn[i].label_ids = ids_of_stroke_letter(found->second[i]);
    }
    return drawn;
  }

  Provenance provenance(const std::string& notice) {
    const std::string change = "; changed by calligraphy: fitted to typical strokes" +
                               (options_.date.empty() ? std::string() : " on " + options_.date);
    if (kind_ == SourceKind::kanjivg) {
      if (notice.empty()) notes_.push_back("the source has no copyright notice to include");
      return {"KanjiVG" + package_words(), "Creative Commons Attribution-Share Alike 3.0",
              "Ulrich Apel, KanjiVG, http://kanjivg.tagaini.net" + change, notice};
    }
    if (licence_text_.empty()) {
      notes_.push_back("the source has no " + std::string(licence_file) +
                       ": add the Arphic Public License when redistributing the characters");
    }
    const std::string letters = options_.letters.empty() ? "" : "; stroke letters: theajack, cnchar-order (MIT)";
    return {"Make Me a Hanzi" + package_words(), "Arphic Public License",
            "Arphic Technology, Make Me a Hanzi, Hanzi Writer" + letters + change, licence_text_};
  }

  /// ", as hanzi-writer-data 2.0.1" if the source is the complete package.
  std::string package_words() const {
    const auto package = nlohmann::json::parse(package_, nullptr, false);
    if (!package.is_object() || !package.contains("name") || !package.contains("version")) return {};
    if (!package["name"].is_string() || !package["version"].is_string()) return {};
    const std::string words =
        ", as " + package["name"].get<std::string>() + " " + package["version"].get<std::string>();
    constexpr std::size_t longest = 100;
    const bool printable = std::all_of(words.begin(), words.end(), [](char c) { return c >= ' ' && c <= '~'; });
    return printable && words.size() <= longest ? words : std::string();
  }

  fs::path source_;
  const ImportOptions& options_;
  StrokeLetters letters_;
  SourceKind kind_ = SourceKind::calligraphy;
  std::vector<Drawing> drawings_;
  std::vector<SkippedFile> skipped_;
  std::vector<std::string> notes_;
  std::string licence_text_;
  std::string package_;
  std::atomic<int> strokes_ = 0;
};

ImportResult import_own_format(const fs::path& source, const ImportOptions& options) {
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

bool is_own_format(const fs::path& source) {
  std::error_code failure;
  if (!fs::is_regular_file(source, failure)) return false;
  std::ifstream in(source, std::ios::binary);
  std::string start(archive_start, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  const std::string_view archive = archive_format(start);
  return archive != "gzip" && archive != "tar";
}

ImportResult import_characters(const fs::path& source, const ImportOptions& options) {
  check(options);
  if (is_own_format(source)) return import_own_format(source, options);
  return Importer(source, options).run();
}

}  // namespace calligraphy
