// The stroke letters of cnchar-order, which are contained in a JavaScript program.
#include <set>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "../catch.hpp"
#include "../package_data.hpp"
#include "../temporary_directory.hpp"
#include "importers/read/stroke_labels.hpp"
#include "importers/read/stroke_letters.hpp"

namespace stroke_letters_tests {

using namespace calligraphy;

namespace {

std::string complaint(const std::string& javascript) {
  try {
    parse_stroke_letters(javascript, "x.js");
  } catch (const FormatError& error) {
    return error.what();
  }
  return {};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("the table of letters is found among other literals", "[practice]") {
  const StrokeLetters letters = parse_stroke_letters(
      R"js(!function(){a=JSON.parse('{"j":{"name":"\'x\'"}}');b=JSON.parse('{"一":"j","十":"jf"}')}();)js", "x.js");
  CHECK(letters == StrokeLetters{{U'一', "j"}, {U'十', "jf"}});
}

TEST_CASE("JavaScript without a table of letters is rejected with the byte", "[practice]") {
  CHECK(has(complaint(""), "x.js: no table of stroke letters"));
  CHECK(has(complaint("JSON.parse('{\"一\":\"j\"}"), "byte 12: unterminated string"));
  CHECK(has(complaint("JSON.parse('{\"一\":')"), "byte 12: not JSON"));
  CHECK(has(complaint("JSON.parse('\\x41')"), "byte 13: an escape"));
  CHECK(has(complaint("JSON.parse('\\"), "byte 13: an escape"));
  for (const char* const other :
       {"[]", "{}", "7", "{\"一二\":\"j\"}", "{\"一\":\"J\"}", "{\"一\":\"\"}", "{\"一\":7}"}) {
    INFO(other);
    CHECK(has(complaint("JSON.parse('" + std::string(other) + "')"), "no table of stroke letters"));
  }
  CHECK(has(complaint("JSON.parse('" + std::string(200000, '[') + "')"), "not JSON"));
}

TEST_CASE("every typical stroke but the circle has a letter, and every letter stands for typical strokes",
          "[practice]") {
  std::set<int> ids;
  for (char letter = 'a'; letter <= 'z'; ++letter) {
    INFO(letter);
    CHECK(!ids_of_stroke_letter(letter).empty());
    for (const int id : ids_of_stroke_letter(letter)) ids.insert(typical_stroke(id).id);
  }
  CHECK(ids.size() == typical_stroke_count - 1);
  CHECK(ids.count(39) == 0);
  CHECK(ids_of_stroke_letter('A').empty());
  CHECK(ids_of_stroke_letter('\xFF').empty());
}

TEST_CASE("labels of KanjiVG stand for typical strokes, combined labels for those of all parts", "[practice]") {
  const auto ids = [](std::string_view label) {
    const auto span = ids_of_kanjivg_label(label);
    return std::vector<int>(span.begin(), span.end());
  };
  CHECK(ids("㇐") == std::vector<int>{1});
  CHECK(ids("㇒") == std::vector<int>{4, 5, 3});
  CHECK(ids("㇔/㇀") == std::vector<int>{8, 38, 10});
  CHECK(ids("㇑/㇐") == std::vector<int>{2, 1});  // the last row of the table
  CHECK(ids("６").empty());
  CHECK(ids("label").empty());
  CHECK(ids("").empty());
}

TEST_CASE("letters are read from the directory or the file of the package", "[practice]") {
  const std::filesystem::path package = package_data("CALLIGRAPHY_CNCHAR_ORDER");
  if (package.empty()) return;
  const StrokeLetters letters = read_stroke_letters(package);
  CHECK(letters.size() == 6939);
  CHECK(letters.at(U'永') == "kresl");
  CHECK(read_stroke_letters(package / "cnchar.order.min.js") == letters);
}

TEST_CASE("a source without letters is named", "[practice]") {
  const TemporaryDirectory directory;
  CHECK_THROWS_AS(read_stroke_letters(directory.path()), FileError);
  CHECK_THROWS_AS(read_stroke_letters(directory.path() / "none.js"), FileError);
  directory.write("big.js", std::string(5 << 20, ' '));
  CHECK_THROWS_AS(read_stroke_letters(directory.path() / "big.js"), FormatError);
}

}  // namespace stroke_letters_tests
