#include "drawing_source.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "anim_cjk.hpp"
#include "base/charconv.hpp"
#include "base/enum_name.hpp"
#include "file_name.hpp"
#include "hanzi_writer.hpp"
#include "model/code_point_name.hpp"
#include "source_files.hpp"

namespace calligraphy {
namespace {

constexpr std::string_view licence_file = "ARPHICPL.TXT";
constexpr std::string_view package_file = "package.json";

bool is_ideograph(char32_t code) {
  return (code >= 0x3400 && code <= 0x4DBF) || (code >= 0x4E00 && code <= 0x9FFF) ||
         (code >= 0xF900 && code <= 0xFAFF) || (code >= 0x20000 && code <= 0x3FFFF);
}

/// True for a file of the package itself, not of a nested one.
bool is_package_file(std::string_view path, std::string_view name) {
  return path == name || path == "package/" + std::string(name);
}

/// 0 if it is not one character.
char32_t only_code(const std::string& text) {
  const std::u32string codes = decode_utf8(text);
  return codes.size() == 1 ? codes[0] : 0;
}

/// True if more than one line begins a JSON object, but not of an array.
bool has_character_a_line(std::string_view text) {
  if (text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size())).starts_with('[')) return false;
  std::size_t objects = text.starts_with('{') ? 1 : 0;
  for (std::size_t end = text.find('\n'); end < text.size() && objects < 2; end = text.find('\n', end + 1)) {
    if (text.substr(end + 1).starts_with('{')) ++objects;
  }
  return objects > 1;
}

/// The code in the first id of an SVG, as in kvg:StrokePaths_04e00, kvg:04e00 or z19968; 0 if there is none.
char32_t code_in_svg(std::string_view svg, DrawingForm form) {
  const bool is_decimal = form == DrawingForm::anim_cjk;
  const std::string_view first = is_decimal ? "id=\"z" : "\"kvg:StrokePaths_";
  for (const std::string_view before : {first, std::string_view(is_decimal ? "id='z" : "\"kvg:")}) {
    const std::size_t at = svg.find(before);
    if (at == svg.npos) continue;
    unsigned code = 0;
    const char* const begin = svg.data() + at + before.size();
    constexpr std::ptrdiff_t most = 7;
    const char* const end = begin + std::min(most, svg.data() + svg.size() - begin);
    from_chars(begin, end, code, is_decimal ? 10 : 16);
    if (code > 0 && code <= 0x10FFFF) return code;
  }
  return 0;
}

/// One that draws a character for the eye, as in svgs and svgs-still of Make Me a Hanzi.
bool is_picture(std::string_view svg) { return svg.find("\"scale(1, -1) translate(0, -900)\"") != svg.npos; }

/// KanjiVG as one file, kanjivg.xml, has this as its root.
bool has_kanji_elements(std::string_view xml) {
  constexpr std::size_t head = 10000;  // [byte]; of a notice
  return xml.substr(0, head).find("<kanjivg") != xml.npos;
}

/// Whether the name is of a zip that says it in another encoding. Two bytes of GBK or Shift JIS may look like a letter
/// of UTF-8 before those of Chinese and Japanese.
bool is_foreign_name(std::string_view path) {
  constexpr char32_t radicals = 0x2E80;
  try {
    const std::u32string codes = decode_utf8(path.substr(path.rfind('/') + 1));
    const std::size_t letters = codes.find(U'.');
    return letters == 1 && codes[0] > 0x7F && codes[0] < radicals;
  } catch (const FormatError&) {
    return true;
  }
}

/// The licence of the package itself, or where Make Me a Hanzi, animCJK and packages made of it have it.
bool is_licence_file(std::string_view path) {
  for (const std::string_view folder : {"licenses/", "APL/english/"}) {
    const std::string end = std::string(folder) + std::string(licence_file);
    if (path == end || path.ends_with("/" + end)) return true;
  }
  return is_package_file(path, licence_file);
}

/// For messages: the path is not repeated if the file is the source.
std::string place_in(const std::string& source, const std::string& path) {
  const std::string only = std::filesystem::path(source).filename().string();
  if (!only.empty() && path.starts_with(only) && (path.size() == only.size() || path[only.size()] == ':')) {
    return source + path.substr(only.size());
  }
  return source + ": " + path;
}

/// Why the JSON text is no drawing; empty if it is one.
std::string problem_of(std::string_view json) {
  try {
    parse_hanzi_writer(json, {});
    return {};
  } catch (const FormatError& error) {
    return std::string(error.what()).substr(2);  // after ": "
  }
}

/// Decides which files of a source are read, and what character each draws.
class Selection {
 public:
  Selection(std::string source, const ImportOptions& options) : name_(std::move(source)), options_(options) {}

  /// From its path alone.
  FilePlan plan(std::string_view path) {
    if (is_licence_file(path) || is_package_file(path, package_file)) return {};
    const FileName name = parse_file_name(path);
    if (name.form == FileForm::none) return {"not a character file"};
    if (name.form == FileForm::list) return {{}, true};
    if (!name.has_meaning()) return {{}, false, true};
    if (!name.order.empty() && !options_.alternates) return {"an alternate order"};
    const char32_t codes[] = {name.code, name.hex, name.decimal};
    if (std::none_of(std::begin(codes), std::end(codes), [this](char32_t code) { return is_asked_for(code); })) {
      return {"not requested"};
    }
    const std::string_view last = path.substr(path.rfind('/') + 1);
    if (!names_.emplace(last).second) return {"a duplicate of an earlier file"};
    return {};
  }

  /// Adds the drawings in a file, or why there are none. `is_only`: it is the source.
  void take(SourceFile file, bool is_only) {
    FileName name = parse_file_name(file.path);
    if (is_utf16(file.text)) {
      const bool is_meant = is_only || name.form == FileForm::list || name.has_meaning();
      return skip(file.path, is_meant ? "is UTF-16, not UTF-8: save it as UTF-8" : "not a character file", is_meant);
    }
    const std::size_t mark = file.text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    if (name.form == FileForm::none) {  // the only one: its content tells
      const std::size_t first = file.text.find_first_not_of(" \t\r\n", mark);
      name.form = first != file.text.npos && file.text[first] == '<' ? FileForm::svg : FileForm::json;
    }
    if (name.form == FileForm::svg) return take_svg(std::move(file), name, is_only);
    if (mark > 0) file.text.erase(0, mark);
    if (name.form == FileForm::list || has_character_a_line(file.text)) return take_lines(file);
    take_json(std::move(file), name, is_only);
  }

  DrawingSource finish(std::vector<SkippedFile> skipped) {
    source_.skipped.insert(source_.skipped.begin(), std::make_move_iterator(skipped.begin()),
                           std::make_move_iterator(skipped.end()));
    std::stable_sort(source_.skipped.begin(), source_.skipped.end(),
                     [](const SkippedFile& a, const SkippedFile& b) { return a.path < b.path; });
    std::sort(source_.files.begin(), source_.files.end(), [](const DrawingFile& a, const DrawingFile& b) {
      return std::tie(a.character.code, a.character.order) < std::tie(b.character.code, b.character.order);
    });
    return std::move(source_);
  }

 private:
  bool is_asked_for(char32_t code) const {
    return code != 0 && (options_.only.empty() || options_.only.find(code) != std::u32string::npos);
  }

  void skip(const std::string& path, std::string reason, bool unusable = false) {
    if (unusable && options_.strict) throw FormatError(place_in(name_, path) + ": " + reason);
    source_.skipped.push_back({path, std::move(reason), unusable});
  }

  void add(CharacterFile character, DrawingForm form, const std::string& path, std::string text) {
    const bool is_mixed = form == DrawingForm::kanjivg;  // the others have radicals beside ideographs
    if (is_mixed && options_.ideographs_only && !is_ideograph(character.code)) return skip(path, "not an ideograph");
    if (!is_asked_for(character.code)) return skip(path, "not requested");
    if (!seen_.emplace(character.kind, character.code, character.order).second) {
      return skip(path, "a duplicate of an earlier file");
    }
    source_.files.push_back({std::move(character), form, path, place_in(name_, path), std::move(text)});
  }

  /// What a name without meaning and content without a character lead to.
  void skip_nameless(const std::string& path, bool is_only, const char* where) {
    if (is_foreign_name(path)) return skip(path, "its name is not in UTF-8: pack the files with names in UTF-8", true);
    if (!is_only) return skip(path, "not a character file");
    skip(path, std::string("neither its name nor ") + where + " says which character it has", true);
  }

  void take_svg(SourceFile file, const FileName& name, bool is_only) {
    if (has_kanji_elements(file.text)) return take_kanji_elements(file);
    if (is_picture(file.text)) {
      return skip(file.path, "a picture of Make Me a Hanzi, which has the strokes in graphics.txt", is_only);
    }
    const DrawingForm form = is_anim_cjk(file.text) ? DrawingForm::anim_cjk : DrawingForm::kanjivg;
    const bool is_brush = form == DrawingForm::anim_cjk;
    char32_t code = name.code != 0 ? name.code : is_brush ? name.decimal : name.hex;
    const char32_t inside = code_in_svg(file.text, form);
    if (code == 0) code = inside;
    if (code == 0) return skip_nameless(file.path, is_only, "an id in it");
    if (is_brush && inside != 0 && inside != code) {
      return skip(file.path, "its name says " + code_point_name(code) + ", its id " + code_point_name(inside), true);
    }
    const SourceKind kind = is_brush ? SourceKind::anim_cjk : SourceKind::kanjivg;
    add({kind, code, is_brush ? std::string() : name.order}, form, file.path, std::move(file.text));
  }

  /// <kanji id="kvg:kanji_06c38"> has what the <svg> of the file 06c38.svg has.
  void take_kanji_elements(const SourceFile& file) {
    const std::string_view text = file.text;
    constexpr std::string_view start = "<kanji id=\"kvg:kanji_", stop = "</kanji>";
    const std::string notice(text.substr(0, text.find("<kanjivg")));
    constexpr std::size_t most_notices = 16 << 20;  // [byte]; of which the first character that is usable needs one
    std::size_t number = 0;
    for (std::size_t at = text.find(start); at != text.npos; at = text.find(start, at)) {
      if (++number > options_.limits.entries) {
        throw FormatError(place_in(name_, file.path) + ": more than " + std::to_string(options_.limits.entries) +
                          " <kanji>");
      }
      at += start.size();
      const std::size_t end = std::min(text.find(stop, at), text.size());
      const std::string_view element = text.substr(at, end - at);
      at = end;
      unsigned code = 0;
      from_chars(element.data(), element.data() + element.size(), code, 16);
      const std::size_t inside = std::min(element.find('>'), element.size() - 1) + 1;
      const std::size_t digits = std::min<std::size_t>(element.find('"'), 10);
      const std::string path = file.path + ": kanji " + printable(element.substr(0, digits));
      if (code == 0 || code > 0x10FFFF) {
        skip(path, "its id is no code point", true);
        continue;
      }
      add({SourceKind::kanjivg, code, {}}, DrawingForm::kanjivg, path,
          (number * notice.size() < most_notices ? notice : "") + "<svg viewBox='0 0 109 109'>" +
              std::string(element.substr(inside)) + "</svg>");
    }
    if (number == 0) skip(file.path, "has no <kanji id=\"kvg:kanji_...\">", true);
  }

  void take_json(SourceFile file, const FileName& name, bool is_only) {
    const std::optional<std::string> member = character_member(file.text);
    const char32_t inside = member ? only_code(*member) : 0;
    if (name.code == 0 && !member) {
      const std::string problem = is_only ? problem_of(file.text) : "";
      if (!problem.empty()) return skip(file.path, problem, true);
      return skip_nameless(file.path, is_only, "a member \"character\"");
    }
    if (member && inside == 0) {
      return skip(file.path, "character: \"" + shortened(*member) + "\": expected one character", true);
    }
    if (name.code != 0 && member && inside != name.code) {
      return skip(file.path, "character: " + code_point_name(inside) + ", but its name says " + code_point_name(name.code), true);
    }
    add({SourceKind::hanzi_writer_data, member ? inside : name.code, {}}, DrawingForm::hanzi_writer, file.path,
        std::move(file.text));
  }

  void take_lines(const SourceFile& file) {
    const SourceKind kind = is_anim_cjk_list(file.path) ? SourceKind::anim_cjk : SourceKind::make_me_a_hanzi;
    std::size_t number = 0, begin = 0;
    while (begin < file.text.size()) {
      const std::size_t end = std::min(file.text.find('\n', begin), file.text.size());
      const std::string_view line = std::string_view(file.text).substr(begin, end - begin);
      begin = end + 1;
      if (++number > options_.limits.entries) {
        throw FormatError(place_in(name_, file.path) + ": more than " + std::to_string(options_.limits.entries) +
                          " lines");
      }
      if (line.find_first_not_of(" \t\r") == line.npos) continue;
      take_line(line, kind, file.path + ": line " + std::to_string(number));
    }
  }

  void take_line(std::string_view line, SourceKind kind, const std::string& path) {
    const std::optional<std::string> member = character_member(line);
    const char32_t inside = member ? only_code(*member) : 0;
    if (inside != 0) return add({kind, inside, {}}, DrawingForm::hanzi_writer, path, std::string(line));
    const std::string problem =
        member ? "character: \"" + shortened(*member) + "\": expected one character" : problem_of(line);
    skip(path, problem.empty() ? "character: missing" : problem, true);
  }

  static std::string shortened(const std::string& text) { return printable(text.substr(0, 40)); }

  std::string name_;
  const ImportOptions& options_;
  DrawingSource source_;
  std::set<std::string, std::less<>> names_;
  std::set<std::tuple<SourceKind, char32_t, std::string>> seen_;
};

/// Makes files unusable that are of another kind than nearly all others.
void leave_out_strays(DrawingSource& source) {
  constexpr std::size_t one_in = 20;
  std::map<SourceKind, std::size_t> counts;
  for (const DrawingFile& file : source.files) ++counts[file.character.kind];
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == counts.end() || one_in * (source.files.size() - most->second) > source.files.size()) return;
  const SourceKind kind = most->first;
  for (const DrawingFile& file : source.files) {
    if (file.character.kind == kind) continue;
    source.skipped.push_back({file.path, std::string("is drawn as in ") + to_string(file.character.kind) +
                                             ", unlike the other files, which are " + to_string(kind) + "'s",
                              true});
  }
  std::erase_if(source.files, [kind](const DrawingFile& file) { return file.character.kind != kind; });
}

/// @throws FormatError if there are no files, or files of several kinds
SourceKind kind_of(const DrawingSource& source, const std::string& name, const ImportOptions& options) {
  const std::vector<DrawingFile>& files = source.files;
  if (files.empty()) {
    for (const SkippedFile& file : source.skipped) {
      if (file.unusable) throw FormatError(place_in(name, file.path) + ": " + file.reason);
    }
    const char32_t wanted = options.only.empty() ? U'永' : options.only.front();
    char number[16];
    std::snprintf(number, sizeof number, "%05x", static_cast<unsigned>(wanted));
    throw FormatError(name + ": contains no character file" + (options.only.empty() ? "" : " that was requested") +
                      ": neither " + encode_utf8(wanted) + ".json as in hanzi-writer-data nor " + number +
                      ".svg as in KanjiVG, nor graphics.txt");
  }
  const SourceKind kind = files.front().character.kind;
  for (const DrawingFile& file : files) {
    if (file.character.kind == kind) continue;
    const auto [first, second] = std::minmax(files.front(), file, [](const DrawingFile& a, const DrawingFile& b) {
      return a.character.kind < b.character.kind;
    });
    throw FormatError(name + ": contains both " + to_string(first.character.kind) + " and " +
                      to_string(second.character.kind) + ": " + first.place + " and " + second.place);
  }
  return kind;
}

/// Whether any drawing in lines of a pen is KanjiVG's, and not just in the same frame.
bool is_of_kanjivg(const DrawingSource& source) {
  return std::any_of(source.files.begin(), source.files.end(), [](const DrawingFile& file) {
    return file.text.find("kvg:") != std::string::npos || file.text.find("KanjiVG") != std::string::npos;
  });
}

/// ", as hanzi-writer-data 2.0.1" if the source is the complete package.
std::string package_words(const std::string& package_json) {
  const auto package = nlohmann::json::parse(package_json, nullptr, false);
  if (!package.is_object() || !package.contains("name") || !package.contains("version")) return {};
  if (!package["name"].is_string() || !package["version"].is_string()) return {};
  const std::string words = ", as " + package["name"].get<std::string>() + " " + package["version"].get<std::string>();
  constexpr std::size_t longest = 100;
  const bool printable = std::all_of(words.begin(), words.end(), [](char c) { return c >= ' ' && c <= '~'; });
  return printable && words.size() <= longest ? words : std::string();
}

}  // namespace

const char* to_string(SourceKind kind) noexcept {
  static constexpr const char* names[] = {"hanzi-writer-data", "KanjiVG", "Make Me a Hanzi", "animCJK", "calligraphy"};
  return name_of<SourceKind::calligraphy>(kind, names, "calligraphy");
}

DrawingSource read_drawings(const std::filesystem::path& path, const ImportOptions& options) {
  Selection selection(path.string(), options);
  const auto plan = [&](std::string_view file) {
    if (options.progress) options.progress(0.0);  // reading alone may take seconds
    return selection.plan(file);
  };
  SourceFiles found = read_source(path, plan, options.limits);
  std::error_code failure;
  const bool is_only = found.files.size() == 1 && std::filesystem::is_regular_file(path, failure) &&
                       found.files[0].path == path.filename().string();
  std::string licence, package;
  for (SourceFile& file : found.files) {
    if (is_licence_file(file.path)) {
      if (!licence.empty() && !is_package_file(file.path, licence_file)) continue;
      licence = with_plain_line_ends(file.text, path.string() + ": " + file.path);
    } else if (is_package_file(file.path, package_file)) {
      package = std::move(file.text);
    } else {
      selection.take(std::move(file), is_only);
    }
  }
  DrawingSource source = selection.finish(std::move(found.skipped));
  source.licence = std::move(licence);
  source.package = std::move(package);
  if (!options.strict) leave_out_strays(source);
  source.kind = kind_of(source, path.string(), options);
  check_applies(options, source.kind);
  return source;
}

Provenance provenance(const DrawingSource& source, const ImportOptions& options, const std::string& notice,
                      std::vector<std::string>& notes) {
  const std::string change = "; changed by calligraphy: fitted to typical strokes" +
                             (options.date.empty() ? std::string() : " on " + options.date);
  if (source.kind == SourceKind::kanjivg && !is_of_kanjivg(source)) {
    notes.emplace_back("no drawing has an attribute of KanjiVG (kvg:): no licence or author is stated; state yours in "
                       "the head of the text format");
    return {"drawings in SVG", "", change.substr(2), notice};
  }
  if (source.kind == SourceKind::kanjivg) {
    if (notice.empty()) notes.push_back("the source has no copyright notice to include");
    return {"KanjiVG" + package_words(source.package), "Creative Commons Attribution-Share Alike 3.0",
            "Ulrich Apel, KanjiVG, http://kanjivg.tagaini.net" + change, notice};
  }
  if (source.licence.empty()) {
    notes.push_back("the source has no " + std::string(licence_file) +
                    ": add the Arphic Public License when redistributing the characters" +
                    (source.package.empty() && source.kind == SourceKind::hanzi_writer_data
                         ? "; drawings of your own are not under it: edit the head of the text format"
                         : ""));
  }
  const std::string letters = options.letters.empty() ? "" : "; stroke letters: theajack, cnchar-order (MIT)";
  if (source.kind == SourceKind::anim_cjk) {
    notes.push_back("animCJK has its kana and the drawings of single strokes under the GNU LGPL 3 or later");
    return {"animCJK" + package_words(source.package), "Arphic Public License",
            "Arphic Technology, Make Me a Hanzi, FM&SH, animCJK, https://github.com/parsimonhi/animCJK" + letters +
                change,
            source.licence.empty() ? notice : source.licence};
  }
  const std::string writer = source.kind == SourceKind::hanzi_writer_data ? ", Hanzi Writer" : "";
  return {"Make Me a Hanzi" + package_words(source.package), "Arphic Public License",
          "Arphic Technology, Make Me a Hanzi" + writer + letters + change, source.licence};
}

void check_applies(const ImportOptions& options, SourceKind kind) {
  const auto refuse = [kind](bool given, const std::string& option, std::initializer_list<SourceKind> kinds) {
    if (!given || std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) return;
    std::string names;
    for (const SourceKind each : kinds) names += (names.empty() ? "" : " and ") + std::string(to_string(each));
    throw ValueError(option + ": applies only to " + names + ", not to " +
                     (kind == SourceKind::calligraphy ? "a set file or the text format" : to_string(kind)));
  };
  using enum SourceKind;
  refuse(!options.letters.empty(), "letters", {hanzi_writer_data, make_me_a_hanzi, anim_cjk});
  refuse(!options.corrections, "corrections", {hanzi_writer_data, make_me_a_hanzi, anim_cjk});
  refuse(options.ink == InkDetail::half_widths, "ink half-widths", {hanzi_writer_data, make_me_a_hanzi, anim_cjk});
  refuse(options.alternates, "alternates", {kanjivg});
  refuse(!options.ideographs_only, "ideographs_only", {kanjivg});
  refuse(options.report, "report", {hanzi_writer_data, kanjivg, make_me_a_hanzi, anim_cjk});
  refuse(!options.date.empty(), "date", {hanzi_writer_data, kanjivg, make_me_a_hanzi, anim_cjk});
}

}  // namespace calligraphy
