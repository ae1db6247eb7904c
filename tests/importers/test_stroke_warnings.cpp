// stroke_warnings finds faults that validate() accepts, import_warnings what an import measured; neither warns about
// good characters.
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/stroke_warnings.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../catch.hpp"
#include "../temporary_directory.hpp"

namespace doubtful_strokes_tests {

using namespace calligraphy;

namespace {

/// "stroke kind" of each warning, in order.
std::string warnings_of(const std::vector<StrokeInput>& strokes, int degree = 3) {
  std::string text;
  for (const StrokeWarning& warning : stroke_warnings(make_character(U'永', strokes, degree))) {
    text += (text.empty() ? "" : ", ") + std::to_string(warning.stroke) + " " + to_string(warning.kind);
  }
  return text;
}

const StrokeReference place{U'永', "", 1};

/// A stroke that follows its drawing well.
StrokeMeasures good_measures() {
  StrokeMeasures measures{};
  measures.place = place;
  measures.frechet = 0.01;
  measures.length = 0.5;
  measures.source_length = 0.52;
  measures.half_width = 0.02;
  measures.outline_size = 0.55;
  return measures;
}

/// The same of what was imported.
std::string warnings_of(const ImportResult& import) {
  std::string text;
  for (const CharacterWarnings& character : import_warnings(import)) {
    for (const StrokeWarning& warning : character.warnings) {
      text += (text.empty() ? "" : ", ") + std::to_string(warning.stroke) + " " + to_string(warning.kind);
    }
  }
  return text;
}

ImportResult import_of(const std::vector<StrokeMeasures>& measures) {
  ImportResult import;
  import.list.characters.push_back(make_character(U'永', std::vector{StrokeInput{1, {{0.1, 0.5}, {0.9, 0.52}}}}));
  import.report.measures = measures;
  return import;
}

template <typename Change>
std::string warnings_after(Change change) {
  StrokeMeasures measures = good_measures();
  change(measures);
  return warnings_of(import_of({measures}));
}

/// The warnings of strokes drawn with a pen, each a label and path data.
std::string warnings_of_kanjivg(const std::vector<std::pair<std::string, std::string>>& strokes) {
  const TemporaryDirectory directory;
  std::string text = "<svg viewBox=\"0 0 109 109\"><g>";
  for (const auto& [label, data] : strokes) text += "<path kvg:type=\"" + label + "\" d=\"" + data + "\"/>";
  directory.write("06c38.svg", text + "</g></svg>");
  ImportOptions options;
  options.report = true;
  return warnings_of(import_characters(directory.path(), options));
}

const StrokeInput heng{1, {{0.1, 0.5}, {0.9, 0.52}}};
const StrokeInput shu{2, {{0.5, 0.9}, {0.5, 0.1}}};

}  // namespace

TEST_CASE("strokes as taught in schools cause no warning, with cubics or quartics", "[model]") {
  CHECK(warnings_of({heng, shu}).empty());
  for (const Character& character : built_in_characters().characters) {
    INFO(encode_utf8(character.code));
    CHECK(stroke_warnings(character).empty());
    CHECK(stroke_warnings(with_quartic_curves(character)).empty());
  }
}

TEST_CASE("a stroke with the shape of another is found", "[model]") {
  CHECK(warnings_of({{2, {{0.1, 0.5}, {0.4, 0.1}}}, heng}) == "1 type");         // a pie recorded as shu
  CHECK(warnings_of({heng, {10, {{0.5, 0.9}, {0.8, 0.1}}}}) == "2 direction");   // a dian recorded as ti
  CHECK(warnings_of({{12, {{0.5, 0.9}, {0.5, 0.1}, {0.5, 0.09}}}}) == "1 type");       // without its hook
  CHECK(warnings_of({{3, {{0.1, 0.7}, {0.5, 0.75}, {0.8, 0.8}, {0.7, 0.5}}}}) == "1 type");  // a heng zhe as shu pie
  CHECK(warnings_of({{16, {{0.5, 0.9}, {0.5, 0.1}, {0.4, 0.2}}}}) == "1 direction");  // a shu gou recorded as heng zhe
}

TEST_CASE("a shape within the variation of its type causes no warning of the type", "[model]") {
  CHECK(warnings_of({{1, {{0.1, 0.4}, {0.8, 0.7}}}}).empty());    // rises like a ti
  CHECK(warnings_of({{8, {{0.6, 0.8}, {0.5, 0.6}}}}).empty());    // falls like a short pie
  CHECK(warnings_of({{2, {{0.5, 0.6}, {0.56, 0.5}}}}).empty());   // as short as a dian
  CHECK(warnings_of({{32, {{0.3, 0.8}, {0.22, 0.4}, {0.8, 0.42}}}}).empty());  // leans like a pie zhe
}

TEST_CASE("a stroke written from its end is found, with one warning", "[model]") {
  CHECK(warnings_of({{1, {{0.9, 0.52}, {0.1, 0.5}}}, shu}) == "1 direction");
  CHECK(warnings_of({heng, {2, {{0.5, 0.1}, {0.5, 0.9}}}}) == "2 direction");
  CHECK(warnings_of({{4, {{0.2, 0.12}, {0.46, 0.31}, {0.62, 0.58}, {0.68, 0.88}}}}) == "1 direction");
}

TEST_CASE("a stroke that overlaps another is found, one that only touches or crosses is not", "[model]") {
  CHECK(warnings_of({heng, heng}) == "2 overlap");
  CHECK(warnings_of({heng, shu, {1, {{0.3, 0.503}, {0.7, 0.508}}}}) == "3 overlap");
  CHECK(warnings_of({{1, {{0.3, 0.503}, {0.7, 0.508}}}, shu, heng}) == "3 overlap");
  CHECK(warnings_of({heng, {1, {{0.1, 0.53}, {0.9, 0.55}}}}).empty());
}

TEST_CASE("a stroke outside the em square is found by its curve, not by its handles", "[model]") {
  CHECK(warnings_of({{1, {{0.1, 0.5}, {1.02, 0.52}}}}) == "1 outside");
  CHECK(warnings_of({{1, {{-0.005, 0.5}, {0.9, 0.52}}}}).empty());
  CHECK(warnings_of({{4, {{0.68, 0.95}, {0.66, 1.5}, {0.46, 0.31}, {0.2, 0.12}}}}).find("outside") !=
        std::string::npos);
  CHECK(warnings_of({{4, {{0.68, 0.9}, {0.67, 1.02}, {0.46, 0.31}, {0.2, 0.12}}}}).find("outside") ==
        std::string::npos);
}

TEST_CASE("a dot that is a point causes no warning", "[model]") {
  CHECK(warnings_of({{8, {{0.5, 0.5}, {0.5, 0.5}}}, heng}).find("direction") == std::string::npos);
}

TEST_CASE("what an import measures beyond its limits is reported, and nothing below them", "[model]") {
  CHECK(warnings_after([](StrokeMeasures&) {}).empty());
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.backward = 0.051; }) == "1 fold");
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.backward = 0.049; }).empty());
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.reversal = 140.0; }) == "1 fold");
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.reversal = 130.0; }).empty());
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.length = 0.38; }) == "1 length");  // 0.8 of 0.48
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.length = 0.39; }).empty());
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.length = 0.58; }) == "1 length");
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.outline_size = 1.6; }) == "1 length");  // a fragment
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.outline_size = 1.5; }).empty());
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.false_distance = 0.031; }) == "1 corner");
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.false_distance = 0.029; }).empty());
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.lost_inside = 0.11; }) == "1 corner");
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.lost_inside = 0.09; }).empty());  // an entry of the brush
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.frechet = 0.041; }) == "1 distance");
  CHECK(warnings_after([](StrokeMeasures& stroke) { stroke.frechet = 0.039; }).empty());
}

TEST_CASE("a lost crossing names both strokes", "[model]") {
  ImportResult import = import_of({good_measures()});
  import.report.lost_crossings.push_back({{U'永', "", 3}, 2});
  const std::vector<CharacterWarnings> warnings = import_warnings(import);
  REQUIRE(warnings.size() == 1);
  REQUIRE(warnings[0].warnings.size() == 1);
  CHECK(warnings[0].warnings[0].stroke == 3);
  CHECK(warnings[0].warnings[0].what == "crosses stroke 2 in the drawing, but not as imported");
}

TEST_CASE("a label is reported if the drawing is clearly another kind, or if it is unknown", "[model]") {
  const std::string level = "M10,50c30,0,60,-1,90,-2";
  const std::string rising = "M20,70c20,-8,40,-16,60,-24";
  const std::string down = "M50,10c0,30,0,60,0,85";
  const std::string hooked = down + "c-4,-3,-8,-6,-12,-9";
  CHECK(warnings_of_kanjivg({{"㇐", level}, {"㇑", down}, {"㇀", rising}}).empty());
  CHECK(warnings_of_kanjivg({{"㇚", hooked}}).empty());
  CHECK(warnings_of_kanjivg({{"㇐", level}, {"㇑", hooked}}) == "2 label");
  CHECK(warnings_of_kanjivg({{"㇐", level}, {"㇚", down}}) == "2 label");
  CHECK(warnings_of_kanjivg({{"㇐", level}, {"㇐", down}}) == "2 label");
  CHECK(warnings_of_kanjivg({{"６", level}}) == "1 label");
  // Ends straight down.
  CHECK(warnings_of_kanjivg({{"㇆", "M20,20c20,-1,40,-2,50,-3c-1,30,-1,40,-2,60"}}) == "1 label");
  CHECK(warnings_of_kanjivg({{"㇀", "M20,60c20,-4,40,-8,60,-10"}}).empty());           // as level as a heng
  CHECK(warnings_of_kanjivg({{"㇔", "M50,20c-3,6,-7,12,-12,17"}}).empty());            // falls like a short pie
}

TEST_CASE("a label that the drawing contradicts makes a warning of the type superfluous", "[model]") {
  ImportResult import = import_of({good_measures()});
  const StrokeInput without_hook{12, {{0.5, 0.9}, {0.5, 0.1}, {0.5, 0.09}}};
  import.list.characters[0] = make_character(U'永', std::vector{without_hook});
  CHECK(warnings_of(import) == "1 type");
  import.report.label_conflicts.push_back({place, "㇚", LabelResolution::accepted, 2, 12, true});
  CHECK(warnings_of(import) == "1 label");
  import.report.label_conflicts.back().certain = false;
  CHECK(warnings_of(import) == "1 type");
}

}  // namespace doubtful_strokes_tests
