// The text format: writing and reading round-trips, and errors are reported with file, line and value.
#include "../catch.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../hard_cases.hpp"
#include "../sanitized.hpp"
#include "character_lists.hpp"

using namespace calligraphy;

namespace {

const std::string head = "calligraphy characters 2\n";

CharacterList read(const std::string& text) {
  std::istringstream in(text);
  return read_characters(in, "test.txt");
}

std::string write(const CharacterList& set) {
  std::ostringstream out;
  write_characters(out, set);
  return out.str();
}

/// The message of the FormatError, or "" if the text is accepted.
std::string complaint(const std::string& text) {
  try {
    read(text);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "";
}

bool same(const CharacterList& a, const CharacterList& b) {
  if (a.provenance != b.provenance) return false;
  if (a.characters.size() != b.characters.size()) return false;
  for (std::size_t i = 0; i < a.characters.size(); ++i) {
    const Character &x = a.characters[i], &y = b.characters[i];
    if (x.code != y.code || x.order != y.order || x.curve_degree != y.curve_degree ||
        x.sequence.stroke_ids != y.sequence.stroke_ids || x.sequence.elements != y.sequence.elements ||
        x.sequence.feature_points != y.sequence.feature_points ||
        x.structure.control_points != y.structure.control_points ||
        x.physics.attraction_factors != y.physics.attraction_factors || x.physics.ink != y.physics.ink) {
      return false;
    }
  }
  return true;
}

struct CommaNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\1"; }
};

}  // namespace

TEST_CASE("a character that a list does not have is an error that names it", "[model]") {
  CHECK(built_in_characters().at(U'永').code == U'永');
  CHECK_THROWS_WITH(read(head).at(U'八'), "character 八 is not in the list of 0 characters");
  CHECK_THROWS_WITH(built_in_characters().at(U'永', "x"),
                    "character 永 order x is not in the list of 65 characters");
}

TEST_CASE("a written list reads back identically, including quartics and attraction factors", "[model]") {
  CharacterList set = built_in_characters();
  set.characters.push_back(with_quartic_curves(*set.find(U'永')));
  set.characters.back().code = U'\U00020000';
  calligraphy_test::Sequence random(3);
  for (Character& character : set.characters) {
    for (double& factor : character.physics.attraction_factors) factor = random.between(0.0, 3.0);
    for (Point& point : character.structure.control_points) point += 1e-3 * random.point(-1.0, 1.0);  // all 17 digits
  }
  CHECK(same(read(write(set)), set));
  CHECK(write(read(write(set))) == write(set));
  CHECK(same(read(write(built_in_characters())), built_in_characters()));
  CHECK(read(write({})).characters.empty());
}

TEST_CASE("ink reads back identically, and the format is that of older programs if there is none", "[model]") {
  const auto begins_with = [](const std::string& text, int format) {
    return text.starts_with("calligraphy characters " + std::to_string(format) + "\n");
  };
  CharacterList set = built_in_characters();
  CHECK(begins_with(write(set), 2));
  calligraphy_test::Sequence random(4);
  for (std::size_t i = 0; i < set.characters.size(); i += 2) {
    calligraphy_test::add_ink(set.characters[i], max_ink_length, random);
    if (i % 4 == 0) set.characters[i].physics.ink[0].offsets.fill(0.0);
  }
  CHECK(begins_with(write(set), 4));
  CHECK(same(read(write(set)), set));
  CHECK(write(read(write(set))) == write(set));
}

TEST_CASE("ink is a line of numbers after each stroke of a character, with offsets or without, and shifts of corners", "[model]") {
  const CharacterList set = read("calligraphy characters 4\ncharacter \xE4\xB8\x80\nstroke 1 0,0 1,1 | 1 2\n\n"
                                 "ink 0.01 0.02 1e-1 0 1 .4 .5 .6 .7 .8 # thick\n"
                                 "stroke 1 0,1 1,0\n  ink 0 0 0 0 0 0 0 0 0 0 -1 .2 .3 .4 .5 .6 .7 1\n"
                                 "character \xE4\xBA\x8C\nstroke 1 0,0 1,1\n"
                                 "character \xE4\xB8\xA8\nstroke 12 0.5,1 0.5,0 0.3,0.2\n"
                                 "ink 0 0 .1 .2 .3 .4 .5 .6 .7 .8 .9 .8"
                                 " -.1 -.2 -.3 -.4 -.5 -.6 -.7 -.8 -.9 -1 .25\n");
  REQUIRE(set.characters[0].physics.ink.size() == 2);
  CHECK(set.characters[0].physics.ink[0] == StrokeInk{0.01, 0.02, {}, {0.1, 0.0, 1.0, 0.4, 0.5, 0.6, 0.7, 0.8}, {}});
  CHECK(set.characters[0].physics.ink[1] == StrokeInk{0.0, 0.0, {}, {}, {-1.0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 1.0}});
  CHECK(set.characters[1].physics.ink.empty());
  CHECK(set.characters[2].physics.ink.at(0) == StrokeInk{0.0, 0.0, {0.25},
                                                         {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.8},
                                                         {-0.1, -0.2, -0.3, -0.4, -0.5, -0.6, -0.7, -0.8, -0.9, -1.0}});
  CHECK(write(set).find("\nink 0.01 0.02 0.1 0 1 0.4 0.5 0.6 0.7 0.8\n") != std::string::npos);
}

TEST_CASE("each kind of malformed ink is reported with file, line and value", "[model]") {
  const std::string plain = "\ncharacter \xE5\x8C\x97\nstroke 1 0,0 1,1\n";
  const std::string north = "calligraphy characters 4" + plain;
  const std::string ink = "ink 0 0 .1 .1 .1 .1 .1 .1 .1 .1";
  const std::string version = "'calligraphy characters 4' as the first statement";
  const struct {
    std::string text, line, value;
  } cases[] = {
      {"calligraphy characters 2" + plain + ink, "test.txt:4: ", version + ", not 2"},
      {"calligraphy characters 3" + plain + ink, "test.txt:4: ", version + ", not 3"},
      {"calligraphy characters 1" + plain + ink, "test.txt:4: ", version + ", not 1"},
      {"calligraphy characters 4\n" + ink, "test.txt:2: ", "before any stroke"},
      {north + ink + "\ncharacter \xE4\xB8\x80\n" + ink, "test.txt:6: ", "before any stroke"},
      {north + ink + "\n" + ink, "test.txt:5: ", "second line of ink"},
      {north + "ink", "test.txt:4: ", "10 or 18 numbers, not 0"},
      {north + "ink 0 0 .1 .1 .1 .1 .1 .1 .1", "test.txt:4: ", "not 9"},
      {north + ink + " 0", "test.txt:4: ", "not 11"},
      {north + ink + " 0 0 0 0 0 0 0 0 0", "test.txt:4: ", "not 19"},
      {north + ink + " 0 0 0 0 wide", "test.txt:4: ", "'wide'"},
      {north + ink + " 0 0 0 0 0 0 0 -1.5", "test.txt:4: ", "offset of ink -1.5 em"},
      {north + "ink -.25 0 .1 .1 .1 .1 .1 .1 .1 .1", "test.txt:4: ", "start of ink -0.25 em"},
      {north + "ink 0 1.5 .1 .1 .1 .1 .1 .1 .1 .1", "test.txt:4: ", "end of ink 1.5 em"},
      {north + "ink 0 0 .1 .1 .1 .1 .1 .1 .1 nan", "test.txt:4: ", "half-width of ink nan"},
      {north + "stroke 1 0,1 1,0\n" + ink, "test.txt:5: ", "stroke 2 has ink, unlike stroke 1"},
      {north + ink + "\nstroke 1 0,1 1,0\n\n", "test.txt:5: ", "stroke 2 has no ink, unlike stroke 1"},
      {north + ink + "\nstroke 1 0,1 1,0\n\nstroke 1 0,0 1,1\n", "test.txt:5: ", "stroke 2 has no ink"},
      {north + ink + "\nstroke 1 0,1 1,0\n\ncharacter \xE4\xB8\x80\n", "test.txt:5: ", "stroke 2 has no ink"},
  };
  for (const auto& [text, line, value] : cases) {
    const std::string found = complaint(text);
    INFO(text << " gives " << found);
    CHECK(found.starts_with(line));
    CHECK(found.find(value) != std::string::npos);
  }
}

TEST_CASE("source, licence and attribution are free text, including '#'", "[model]") {
  CharacterList set;
  set.provenance.source = "https://example.org/set#2 # second edition";
  set.provenance.licence = "stroke 1 is not a stroke here";
  set.provenance.attribution = "王 | Zhang, \"Yao\"";
  CHECK(same(read(write(set)), set));
  set.provenance.licence = "one\nstroke 1 0,0 1,1";
  CHECK_THROWS_AS(write(set), ValueError);
}

TEST_CASE("a licence text of many lines is kept, including trailing white space", "[model]") {
  CharacterList set = built_in_characters();
  for (const std::string& text :
       {std::string("one"), std::string("one\n"), std::string("\n"), std::string("\n\n one # 1 \t\n"),
        std::string("stroke 1 0,0 1,1\ncharacter \xE4\xB8\x80\n\n\nend")}) {
    set.provenance.licence_text = text;
    CHECK(same(read(write(set)), set));
  }
  CHECK(read(head + "licence-text one\r\nlicence-text\r\nlicence-text  two").provenance.licence_text == "one\n\n two");
  set.provenance.licence_text = "one\r\ntwo";
  CHECK_THROWS_AS(write(set), ValueError);
}

TEST_CASE("a file may contain a character once in each stroke order", "[model]") {
  CharacterList set;
  for (const char* const order : {"", "Table 3", "degree 4", "\xE5\x8C\x97 | 2"}) {
    set.characters.push_back(std::string_view(order) == "degree 4" ? with_quartic_curves(paper_example())
                                                                   : paper_example());
    set.characters.back().order = order;
  }
  CHECK(same(read(write(set)), set));
  CHECK(read(write(set)).find(U'\u5317', "Table 3") != nullptr);
  CHECK(read(write(set)).find(U'\u5317', "Table 4") == nullptr);
  CHECK(with_quartic_curves(set.characters[1]).order == "Table 3");
  for (const char* const bad : {" a", "a#b", "a\nstroke 1 0,0 1,1"}) {
    set.characters.back().order = bad;
    CHECK_THROWS_AS(write(set), ValueError);
  }
}

TEST_CASE("comments, blank lines, tabs, CRLF and a byte order mark are accepted", "[model]") {
  const CharacterList plain = read(head + "character \xE4\xB8\x80\nstroke 1 0.1,0.5 0.9,0.5 | 1 2\n");
  CHECK(same(read("\xEF\xBB\xBF" + head + "character \xE4\xB8\x80\nstroke 1 0.1,0.5 0.9,0.5 | 1 2"), plain));
  CHECK(same(read("calligraphy characters 1\r\n\r\ncharacter \xE4\xB8\x80\r\nstroke 1 0.1,0.5 0.9,0.5 | 1 2\r\n"),
             plain));
  CHECK(same(read("\n# first\n" + head + "\n  character\t\xE4\xB8\x80  # one\n\tstroke 1  0.1,0.5\t1e-1,5e-1 # no\n"),
             plain) == false);
  CHECK(same(read(head + "  character\t\xE4\xB8\x80  # one\n\n \t\n\tstroke 1  0.1,0.5\t9e-1,5e-1 | 1.0 2.0 # ok\n"),
             plain));
}

TEST_CASE("each kind of malformed line is reported with file, line and value", "[model]") {
  const std::string north = head + "character \xE5\x8C\x97\n";
  const struct {
    std::string text, line, value;
  } cases[] = {
      {"", "test.txt: ", "empty"},
      {"\n\n# nothing\n", "test.txt: ", "empty"},
      {"characters\n", "test.txt:1: ", "'characters'"},
      {"\n\ncalligraphy characters 5\n", "test.txt:3: ", "'calligraphy characters 5'"},
      {head + "strokes 1 0,0 1,1\n", "test.txt:2: ", "'strokes'"},
      {head + "stroke 1 0,0 1,1\n", "test.txt:2: ", "before any character"},
      {head + "character \xE5\x8C\n", "test.txt:2: ", "byte 0"},
      {head + "source \xFF\xFE\n", "test.txt:2: ", "byte 0"},
      {head + "character\n", "test.txt:2: ", "found 0"},
      {head + "character \xE5\x8C\x97\xE5\x8C\x97\n", "test.txt:2: ", "found 2"},
      {head + "character \xE5\x8C\x97 grade 4\n", "test.txt:2: ", "'grade'"},
      {head + "character \xE5\x8C\x97 degree\n", "test.txt:2: ", "the end of the line"},
      {head + "character \xE5\x8C\x97 degree four\n", "test.txt:2: ", "'four'"},
      {head + "character \xE5\x8C\x97 degree 4 5\n", "test.txt:2: ", "'5'"},
      {head + "character \xE5\x8C\x97 order\n", "test.txt:2: ", "''"},
      {head + "character \xE5\x8C\x97 order # none\n", "test.txt:2: ", "''"},
      {head + "character \xE5\x8C\x97 order a\x01\n", "test.txt:2: ", "order"},
      {head + "licence-text \xFF\n", "test.txt:2: ", "byte 0"},
      {north + "stroke 1 0,0 1,1\ncharacter \xE5\x8C\x97 order a\nstroke 1 0,0 1,1\ncharacter \xE5\x8C\x97 order a\n",
       "test.txt:6: ", "\xE5\x8C\x97 order a"},
      {head + "character \xE5\x8C\x97 degree 7\nstroke 1 0,0 1,1\n", "test.txt:3: ", "7"},
      {north + "stroke 1 0,0 1,1\n" + "character \xE5\x8C\x97\nstroke 1 0,0 1,1\n", "test.txt:4: ", "\xE5\x8C\x97"},
      {north, "test.txt:2: ", "\xE5\x8C\x97"},
      {north + "character \xE4\xB8\x80\nstroke 1 0,0 1,1\n", "test.txt:2: ", "no stroke"},
      {north + "stroke\n", "test.txt:3: ", "the end of the line"},
      {north + "stroke one 0,0 1,1\n", "test.txt:3: ", "'one'"},
      {north + "stroke 1.5 0,0 1,1\n", "test.txt:3: ", "'1.5'"},
      {north + "stroke 99999999999 0,0 1,1\n", "test.txt:3: ", "'99999999999'"},
      {north + "stroke 0 0,0 1,1\n", "test.txt:3: ", "id 0"},
      {north + "stroke 40 0,0 1,1\n", "test.txt:3: ", "id 40"},
      {north + "stroke -1 0,0 1,1\n", "test.txt:3: ", "id -1"},
      {north + "stroke 16 L 0,0 1,1\n", "test.txt:3: ", "not 'L'"},
      {north + "stroke 16 cl 0,0 1,1 2,1\n", "test.txt:3: ", "elements 'cl': expected"},
      {north + "stroke 16 CL 0,0 1,1 2,1\n", "test.txt:3: ", "typical stroke 16 (CL) takes 5 control points"},
      {north + "stroke 1 0,0\n", "test.txt:3: ", "2 control points, not 1"},
      {north + "stroke 1 0,0 1,1 1,2\n", "test.txt:3: ", "not 3"},
      {north + "stroke 1 0,0 1\n", "test.txt:3: ", "'1'"},
      {north + "stroke 1 0,0 1;1\n", "test.txt:3: ", "'1;1'"},
      {north + "stroke 1 0,0 1,1,1\n", "test.txt:3: ", "'1,1'"},
      {north + "stroke 1 0,0 1,\n", "test.txt:3: ", "the end of the line"},
      {north + "stroke 1 0,0 1,one\n", "test.txt:3: ", "'one'"},
      {north + "stroke 1 0,0 1,1e999\n", "test.txt:3: ", "'1e999'"},
      {north + "stroke 1 0,0 nan,1\n", "test.txt:3: ", "nan"},
      {north + "stroke 1 0,0 1,-inf\n", "test.txt:3: ", "-inf"},
      {north + "stroke 1 0,0 1,99\n", "test.txt:3: ", "99"},
      {north + "stroke 1 0,0 1,1 |\n", "test.txt:3: ", "'|'"},
      {north + "stroke 1 0,0 1,1 | 1\n", "test.txt:3: ", "not 1"},
      {north + "stroke 1 0,0 1,1 | 1 two\n", "test.txt:3: ", "'two'"},
      {north + "stroke 1 0,0 1,1 | 1 -2\n", "test.txt:3: ", "-2"},
      {north + "stroke 16 0,0 1,1 1,1\n", "test.txt:3: ", "element 2 has zero length"},
  };
  for (const auto& [text, line, value] : cases) {
    const std::string found = complaint(text);
    INFO(text << "gives " << found);
    CHECK(found.starts_with(line));
    CHECK(found.find(value) != std::string::npos);
  }
}

TEST_CASE("a message does not repeat a line of one megabyte", "[model]") {
  for (const std::string& start :
       {std::string(), head, head + "character ", head + "character \xE5\x8C\x97\nstroke 1 "}) {
    const std::string found = complaint(start + std::string(1'000'000, 'x'));
    CHECK_FALSE(found.empty());
    CHECK(found.size() < 300);
  }
}

TEST_CASE("a million strokes are read", "[model]") {
  constexpr int count = calligraphy_test::sanitized ? 50'000 : 1'000'000;
  std::string text = head + "character \xE5\x8C\x97\n";
  for (int i = 0; i < count; ++i) text += "stroke 1 0,0 1,1\n";
  const CharacterList set = read(text);
  CHECK(set.characters[0].stroke_count() == count);
  CHECK(set.characters[0].sequence.feature_points.back() == 2 * count - 1);
}

TEST_CASE("randomly damaged text is rejected or read, without any other effect", "[model]") {
  const std::string text = write(built_in_characters());
  calligraphy_test::Sequence random(8);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string damaged = text;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(random.next() * static_cast<double>(damaged.size()));
      if (i % 3 == 0)
        damaged.resize(at);
      else if (i % 3 == 1)
        damaged[at] = static_cast<char>(static_cast<int>(256.0 * random.next()));
      else
        damaged.erase(at, static_cast<std::size_t>(20.0 * random.next()));
      if (damaged.empty()) break;
    }
    try {
      for (const Character& character : read(damaged).characters) REQUIRE(validate(character).empty());
    } catch (const FormatError& error) {
      ++refused;
      REQUIRE(std::string(error.what()).starts_with("test.txt"));
    }
  }
  CHECK(refused > 100);
}

TEST_CASE("the locale affects neither reading nor writing", "[model]") {
  CharacterList set = built_in_characters();
  const std::string usual = write(set);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
  const std::string written = write(set);
  const bool equal = same(read(usual), set);
  std::locale::global(before);
  CHECK(written == usual);
  CHECK(equal);
}

TEST_CASE("a file is read by its path, and one that cannot be opened is named", "[model]") {
  const std::filesystem::path directory = std::filesystem::temp_directory_path();
  const std::string path = (directory / "calligraphy_test_character_format.txt").string();
  {
    std::ofstream out(path, std::ios::binary);
    write_characters(out, built_in_characters());
  }
  CHECK(same(read_characters(path), built_in_characters()));
  std::filesystem::remove(path);
  for (const std::string& missing : {path, directory.string()}) {
    std::string found;
    try {
      read_characters(missing);
    } catch (const FileError& error) {
      found = error.what();
    }
    CHECK(found.starts_with(missing));
  }
}
