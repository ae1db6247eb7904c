#include "drawing_source.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <initializer_list>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "base/charconv.hpp"
#include "base/enum_name.hpp"
#include "source_files.hpp"

namespace calligraphy {
namespace {

constexpr std::string_view licence_file = "ARPHICPL.TXT";
constexpr std::string_view package_file = "package.json";

constexpr std::size_t max_order = 64;  // [byte]

bool is_word(std::string_view text) {
  return !text.empty() && text.size() <= max_order && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
  });
}

/// 04e86.svg or 04e86-Kaisho.svg.
std::optional<CharacterFile> kanjivg_name(std::string_view stem) {
  constexpr std::size_t digits = 5;
  unsigned code = 0;
  if (stem.size() < digits) return std::nullopt;
  const char* const end = stem.data() + digits;
  const auto [rest, error] = from_chars(stem.data(), end, code, 16);
  if (error != std::errc() || rest != end || code == 0) return std::nullopt;
  if (stem.size() == digits) return CharacterFile{SourceKind::kanjivg, code, {}};
  if (stem[digits] != '-' || !is_word(stem.substr(digits + 1))) return std::nullopt;
  return CharacterFile{SourceKind::kanjivg, code, std::string(stem.substr(digits + 1))};
}

/// 永.json.
std::optional<CharacterFile> hanzi_writer_name(std::string_view stem) {
  try {
    const std::u32string codes = decode_utf8(stem);
    if (codes.size() == 1 && codes[0] > 0x7F) return CharacterFile{SourceKind::hanzi_writer_data, codes[0], {}};
  } catch (const FormatError&) {  // the name is in another encoding
  }
  return std::nullopt;
}

/// From the path of a file within the source; empty if it names no character.
std::optional<CharacterFile> character_file(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  if (name.substr(dot) == ".svg") return kanjivg_name(name.substr(0, dot));
  if (name.substr(dot) == ".json") return hanzi_writer_name(name.substr(0, dot));
  return std::nullopt;
}

bool is_ideograph(char32_t code) {
  return (code >= 0x3400 && code <= 0x4DBF) || (code >= 0x4E00 && code <= 0x9FFF) ||
         (code >= 0xF900 && code <= 0xFAFF) || (code >= 0x20000 && code <= 0x3FFFF);
}

/// True for a file of the package itself, not of a nested one.
bool is_package_file(std::string_view path, std::string_view name) {
  return path == name || path == "package/" + std::string(name);
}

/// Decides which files of a source are read: each character once.
class Selection {
 public:
  explicit Selection(const ImportOptions& options) : options_(options) {}

  std::string skip_reason(std::string_view path) {
    if (is_package_file(path, licence_file) || is_package_file(path, package_file)) return {};
    const std::optional<CharacterFile> name = character_file(path);
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

/// @throws FormatError if there are no files, or files of both kinds
SourceKind kind_of(const std::vector<DrawingFile>& files, const std::string& source, const ImportOptions& options) {
  if (files.empty()) {
    const char32_t wanted = options.only.empty() ? U'永' : options.only.front();
    char number[16];
    std::snprintf(number, sizeof number, "%05x", static_cast<unsigned>(wanted));
    throw FormatError(source + ": contains no character file" + (options.only.empty() ? "" : " that was requested") +
                      ": neither " + encode_utf8(wanted) + ".json as in hanzi-writer-data nor " + number +
                      ".svg as in KanjiVG");
  }
  const SourceKind kind = files.front().character.kind;
  for (const DrawingFile& file : files) {
    if (file.character.kind == kind) continue;
    throw FormatError(source + ": contains both hanzi-writer-data and KanjiVG: " + files.front().place + " and " +
                      file.place);
  }
  return kind;
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
  static constexpr const char* names[] = {"hanzi-writer-data", "KanjiVG", "calligraphy"};
  return name_of<SourceKind::calligraphy>(kind, names, "calligraphy");
}

DrawingSource read_drawings(const std::filesystem::path& path, const ImportOptions& options) {
  Selection selection(options);
  const auto skip_reason = [&](std::string_view file) {
    if (options.progress) options.progress(0.0);  // reading alone may take seconds
    return selection.skip_reason(file);
  };
  SourceFiles found = read_source(path, skip_reason, options.limits);
  DrawingSource source;
  source.skipped = std::move(found.skipped);
  for (SourceFile& file : found.files) {
    std::string place = path.string() + ": " + file.path;
    if (is_package_file(file.path, licence_file)) {
      source.licence = with_plain_line_ends(file.text, place);
    } else if (is_package_file(file.path, package_file)) {
      source.package = std::move(file.text);
    } else {
      source.files.push_back({*character_file(file.path), std::move(place), std::move(file.text)});
    }
  }
  source.kind = kind_of(source.files, path.string(), options);
  check_applies(options, source.kind);
  std::sort(source.files.begin(), source.files.end(), [](const DrawingFile& a, const DrawingFile& b) {
    return std::tie(a.character.code, a.character.order) < std::tie(b.character.code, b.character.order);
  });
  return source;
}

Provenance provenance(const DrawingSource& source, const ImportOptions& options, const std::string& notice,
                      std::vector<std::string>& notes) {
  const std::string change = "; changed by calligraphy: fitted to typical strokes" +
                             (options.date.empty() ? std::string() : " on " + options.date);
  if (source.kind == SourceKind::kanjivg) {
    if (notice.empty()) notes.push_back("the source has no copyright notice to include");
    return {"KanjiVG" + package_words(source.package), "Creative Commons Attribution-Share Alike 3.0",
            "Ulrich Apel, KanjiVG, http://kanjivg.tagaini.net" + change, notice};
  }
  if (source.licence.empty()) {
    notes.push_back("the source has no " + std::string(licence_file) +
                    ": add the Arphic Public License when redistributing the characters");
  }
  const std::string letters = options.letters.empty() ? "" : "; stroke letters: theajack, cnchar-order (MIT)";
  return {"Make Me a Hanzi" + package_words(source.package), "Arphic Public License",
          "Arphic Technology, Make Me a Hanzi, Hanzi Writer" + letters + change, source.licence};
}

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

}  // namespace calligraphy
