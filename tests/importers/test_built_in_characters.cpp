// The built-in characters, stroke by stroke, against hanzi-writer-data with cnchar-order and against KanjiVG.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <map>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../catch.hpp"
#include "../package_data.hpp"
#include "importers/fit/polyline.hpp"
#include "importers/read/kanjivg.hpp"
#include "importers/read/stroke_labels.hpp"
#include "importers/read/stroke_letters.hpp"

namespace built_in_tests {

using namespace calligraphy;
using recognition::Path;

namespace {

/// Every difference that is not a mistake, as in the table of docs/strokes.md, which has the reasons: the source, what
/// it has where the built-in character has something else, and the characters, with the number of the built-in stroke.
const char* const deliberate_differences = R"(
| KanjiVG | 2 (㇑) for 8 | 航 6 |
| KanjiVG | 2 (㇑a) for 8 | 京 1, 航 7, 空 1, 文 1, 字 1, 家 1, 之 1 |
| KanjiVG | 20 (㇈) for 22 | 乙 1 |
| KanjiVG | 30 (㇟a/㇏) for 8 | 空 5 |
| KanjiVG | 5 strokes | 以 |
| KanjiVG | 6 (㇏) for 7 | 之 3 |
| KanjiVG | 8 (㇔) for 9 | 空 2, 学 4, 字 2, 必 1, 家 2, 写 1 |
| KanjiVG | none | 书, 计, 飞, 朵, 队, 专, 马, 〇 |
| KanjiVG | order 1 2 3 4 6 5 7 8 9 10 | 航 |
| KanjiVG | order 1 2 3 5 4 6 7 8 | 国 |
| KanjiVG | order 1 2 3 5 4 6 7 8 9 | 美 |
| KanjiVG | order 1 2 4 3 5 | 田 |
| KanjiVG | order 1 3 2 4 | 王 |
| KanjiVG | order 2 1 | 乃 |
| KanjiVG | order 2 1 3 4 5 | 北 |
| KanjiVG | order 3 4 2 1 5 | 必 |
| KanjiVG | other strokes | 凹, 凸 |
| hanzi-writer-data | 12 (g) for 13 | 学 7, 字 5, 子 2 |
| hanzi-writer-data | none | 〇 |
)";

// Strokes are compared as shares of the box of their character.
constexpr int points_per_stroke = 24;
constexpr double flattest = 0.2;  // a box has at least this ratio of sides, because that of 一 has no height
constexpr double unlike = 0.25;   // mean distance from another stroke altogether

/// The strokes of a character, each as points equally far apart, with the character's box as the unit square.
std::vector<Path> paths_of(const Character& character) {
  std::vector<Path> paths;
  Point low = Point::Constant(std::numeric_limits<double>::infinity());
  Point high = -low;
  for (const Stroke& stroke : strokes(character)) {
    const Path path = recognition::flattened(input_of(stroke));
    paths.push_back(recognition::resampled(path, points_per_stroke, 0.0, recognition::path_length(path)));
    for (const Point& point : paths.back()) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  const Point centre = 0.5 * (low + high);
  const Point size = (high - low).cwiseMax(flattest * (high - low).maxCoeff());
  for (Path& path : paths) {
    for (Point& point : path) point = (point - centre).cwiseQuotient(size);
  }
  return paths;
}

Path reversed(const Path& path) { return {path.rbegin(), path.rend()}; }

Path centred(Path path) {
  Point sum = Point::Zero();
  for (const Point& point : path) sum += point;
  for (Point& point : path) point -= sum / static_cast<double>(path.size());
  return path;
}

double mean_distance(const Path& one, const Path& other) {
  double sum = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) sum += (one[i] - other[i]).norm();
  return sum / static_cast<double>(one.size());
}

double distance_either_way(const Path& one, const Path& other) {
  return std::min(mean_distance(one, other), mean_distance(reversed(one), other));
}

/// Wherever the strokes are: a dot is shorter than its place may differ.
bool runs_backwards(const Path& path, const Path& source) {
  const Path here = centred(path);
  const Path there = centred(source);
  return mean_distance(reversed(here), there) < mean_distance(here, there);
}

/// For each stroke that of the source, at the least sum of distances. For every set of the source's strokes, as bits,
/// it finds the best way to give them to the first strokes of ours.
std::vector<std::size_t> counterparts(const std::vector<Path>& ours, const std::vector<Path>& source) {
  struct Way {
    double distance = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> strokes = {};
  };
  std::vector<Way> ways(std::size_t{1} << source.size());
  ways[0].distance = 0.0;
  for (std::size_t set = 0; set + 1 < ways.size(); ++set) {
    const Path& next = ours[ways[set].strokes.size()];
    for (std::size_t stroke = 0; stroke < source.size(); ++stroke) {
      const std::size_t larger = set | std::size_t{1} << stroke;
      if (larger == set) continue;
      const double distance = ways[set].distance + distance_either_way(next, source[stroke]);
      if (distance >= ways[larger].distance) continue;
      ways[larger] = {distance, ways[set].strokes};
      ways[larger].strokes.push_back(stroke);
    }
  }
  return ways.back().strokes;
}

/// The order in which the source writes our strokes, from 1; empty if it is ours.
std::string order_of(const std::vector<std::size_t>& counterparts) {
  if (std::is_sorted(counterparts.begin(), counterparts.end())) return {};
  std::vector<std::size_t> order(counterparts.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[counterparts[i]] = i + 1;
  std::string text = "order";
  for (const std::size_t stroke : order) text += ' ' + std::to_string(stroke);
  return text;
}

/// A stroke's label in the source, and the ids that it allows.
struct Label {
  std::string text;
  std::span<const int> ids;
};

/// One source: its name, the built-in characters as imported from it, and their labels, which may be missing.
struct Source {
  std::string name;
  CharacterList imported;
  std::map<char32_t, std::vector<Label>> labels;
};

/// What the source has, and where: "京 7", or "北" for a whole character.
using Differences = std::vector<std::pair<std::string, std::string>>;

Differences differences(const Character& ours, const Source& source) {
  const std::string name = encode_utf8(ours.code);
  const Character* const theirs = source.imported.find(ours.code);
  if (theirs == nullptr) return {{"none", name}};
  if (theirs->stroke_count() != ours.stroke_count()) {
    return {{std::to_string(theirs->stroke_count()) + " strokes", name}};
  }
  const std::vector<Path> here = paths_of(ours);
  const std::vector<Path> there = paths_of(*theirs);
  const std::vector<std::size_t> counterpart = counterparts(here, there);
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (distance_either_way(here[i], there[counterpart[i]]) > unlike) return {{"other strokes", name}};
  }
  Differences found;
  if (const std::string order = order_of(counterpart); !order.empty()) found.emplace_back(order, name);
  const auto labels = source.labels.find(ours.code);
  for (std::size_t i = 0; i < here.size(); ++i) {
    const std::size_t j = counterpart[i];
    const std::string place = name + ' ' + std::to_string(i + 1);
    if (runs_backwards(here[i], there[j])) found.emplace_back("backwards", place);
    const int id = ours.sequence.stroke_ids[i];
    const int their_id = theirs->sequence.stroke_ids[j];
    const Label label = labels == source.labels.end() ? Label{"no label", {}} : labels->second.at(j);
    if (id == their_id || std::find(label.ids.begin(), label.ids.end(), id) != label.ids.end()) continue;
    found.emplace_back(std::to_string(their_id) + " (" + label.text + ") for " + std::to_string(id), place);
  }
  return found;
}

/// Rows of a Markdown table without its last column, sorted: source, what it has, and all places.
std::vector<std::string> rows_of(const std::vector<Source>& sources) {
  std::map<std::string, std::string> places;
  for (const Source& source : sources) {
    for (const Character& character : built_in_characters().characters) {
      for (const auto& [what, place] : differences(character, source)) {
        std::string& list = places["| " + source.name + " | " + what + " | "];
        list += (list.empty() ? "" : ", ") + place;
      }
    }
  }
  std::vector<std::string> rows;
  for (const auto& [row, list] : places) rows.push_back(row + list + " |");
  return rows;
}

/// The lines that begin as a row of one of the sources, without what follows their third column, sorted.
std::vector<std::string> rows_in(const std::string& text) {
  std::vector<std::string> rows;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("| hanzi-writer-data | ", 0) != 0 && line.rfind("| KanjiVG | ", 0) != 0) continue;
    std::size_t end = 0;
    for (int column = 0; column < 3; ++column) end = line.find('|', end + 1);
    rows.push_back(line.substr(0, end + 1));
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// The rows of one list that the other does not have, one a line.
std::string rows_missing(const std::vector<std::string>& from, const std::vector<std::string>& of) {
  std::string text;
  for (const std::string& row : of) {
    if (!std::binary_search(from.begin(), from.end(), row)) text += row + '\n';
  }
  return text;
}

CharacterList import_built_in(const std::filesystem::path& package, const std::filesystem::path& letters) {
  ImportOptions options;
  options.letters = letters;
  for (const Character& character : built_in_characters().characters) options.only += character.code;
  return import_characters(package, options).list;
}

Source hanzi_writer(const std::filesystem::path& package, const std::filesystem::path& letters) {
  Source source{"hanzi-writer-data", import_built_in(package, letters), {}};
  const StrokeLetters all = read_stroke_letters(letters);
  for (const Character& character : source.imported.characters) {
    const auto found = all.find(character.code);
    if (found == all.end()) continue;
    for (const char letter : found->second) {
      source.labels[character.code].push_back({std::string(1, letter), ids_of_stroke_letter(letter)});
    }
  }
  return source;
}

Source kanjivg(const std::filesystem::path& package) {
  Source source{"KanjiVG", import_built_in(package, {}), {}};
  for (const Character& character : source.imported.characters) {
    std::ostringstream name;
    name << std::hex << std::setw(5) << std::setfill('0') << static_cast<unsigned>(character.code) << ".svg";
    const std::string svg = read_file(package / "kanji" / name.str(), 1 << 20);
    for (const SourceStroke& stroke : parse_kanjivg(svg, name.str()).strokes) {
      source.labels[character.code].push_back({stroke.label, ids_of_kanjivg_label(stroke.label)});
    }
  }
  return source;
}

}  // namespace

TEST_CASE("the built-in characters have the strokes of both sources, in their order, kind and direction, except where "
          "docs/strokes.md says why not",
          "[practice]") {
  const auto hanzi = package_data("CALLIGRAPHY_HANZI_WRITER_DATA");
  const auto letters = package_data("CALLIGRAPHY_CNCHAR_ORDER");
  const auto kanji = package_data("CALLIGRAPHY_KANJIVG");
  if (hanzi.empty() || letters.empty() || kanji.empty()) return;
  const std::vector<std::string> found = rows_of({hanzi_writer(hanzi, letters), kanjivg(kanji)});
  const std::vector<std::string> listed = rows_in(deliberate_differences);
  CHECK(rows_missing(listed, found) == "");  // differences that are not listed
  CHECK(rows_missing(found, listed) == "");  // listed differences that do not exist
}

TEST_CASE("docs/strokes.md has the deliberate differences of the built-in characters", "[practice]") {
  const std::filesystem::path page = std::filesystem::path(CALLIGRAPHY_SOURCE_DIR) / "docs" / "strokes.md";
  const std::vector<std::string> listed = rows_in(deliberate_differences);
  const std::vector<std::string> documented = rows_in(read_file(page, 1 << 20));
  CHECK(rows_missing(documented, listed) == "");
  CHECK(rows_missing(listed, documented) == "");
}

}  // namespace built_in_tests
