// Character sets: lookup in single and layered sets, in every stroke order and from every thread.
#include "../catch.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/set_encoding.hpp>
#include <calligraphy/model/typical_ink.hpp>

#include "../allocation_counter.hpp"
#include "character_lists.hpp"

using namespace calligraphy;
using calligraphy_test::one_stroke;
using calligraphy_test::rich_list;
using calligraphy_test::same;

namespace {

bool same_stroke(const Stroke& a, const Stroke& b) {
  return a.type == b.type && a.curve_degree == b.curve_degree &&
         std::equal(a.control_points.begin(), a.control_points.end(), b.control_points.begin(),
                    b.control_points.end()) &&
         std::equal(a.attraction_factors.begin(), a.attraction_factors.end(), b.attraction_factors.begin(),
                    b.attraction_factors.end());
}

std::vector<char32_t> codes_of(const CharacterSet& set) {
  std::vector<char32_t> codes;
  for (const StoredCharacter& character : set) codes.push_back(character.code());
  return codes;
}

CharacterSet set_of(const std::vector<Character>& characters, const std::string& source = "") {
  return CharacterSet(CharacterList{{source, "", "", ""}, characters});
}

Character named(Character character, const std::string& order) {
  character.order = order;
  return character;
}

}  // namespace

TEST_CASE("characters in memory are restored exactly, including rare cases", "[model]") {
  const CharacterList list = rich_list();
  const CharacterSet set(list);
  for (const Character& character : list.characters) {
    const auto found = set.find(character.code, character.order);
    REQUIRE(found);
    CHECK(found->code() == character.code);
    CHECK(found->order() == character.order);
    CHECK(found->stroke_count() == character.stroke_count());
    CHECK(same(found->character(), character));
    CHECK(found->provenance() == list.provenance);
  }
  CHECK(set.coordinate_error() == 0.0);
  CHECK(set.provenances() == std::vector{list.provenance});
  CHECK_NOTHROW(set.check());
}

TEST_CASE("characters that are not in the set are not found", "[model]") {
  const CharacterList list = rich_list();
  const CharacterSet set(list);
  std::size_t found = 0;
  for (char32_t code = 0; code <= 0x110040; ++code) {
    const bool is_there = set.find(code).has_value();
    found += is_there ? 1 : 0;
    if (is_there && list.find(code) == nullptr) FAIL("found " << static_cast<unsigned>(code));
  }
  CHECK(found == set.size());
  CHECK_FALSE(set.find(0xFFFFFFFF));
  CHECK_FALSE(set.find(U'北', "table 3"));
  CHECK_FALSE(set.find(U'永', "Table 3"));
  CHECK_FALSE(CharacterSet().find(U'北'));
  CHECK_FALSE(CharacterSet(CharacterList()).find(U'北'));
  CHECK(CharacterSet(CharacterList()).size() == 0);
  CHECK(codes_of(CharacterSet(CharacterList())).empty());
  CHECK(codes_of(CharacterSet()).empty());
}

TEST_CASE("a stroke decoded on its own equals that of the whole character", "[model]") {
  const CharacterList list = rich_list();
  for (const CoordinatePrecision precision : {CoordinatePrecision::coarse, CoordinatePrecision::exact}) {
    const CharacterSet set = CharacterSet::from_bytes(encode_character_set(list, precision), "test");
    for (const StoredCharacter& stored : set) {
      const Character character = stored.character();
      int index = 0;
      for (const Stroke& stroke : strokes(character)) {
        CHECK(stored.stroke_id(index) == stroke.type->id);
        const auto decoded = stored.stroke(index++);
        REQUIRE(decoded);
        CHECK(same_stroke(decoded->stroke(), stroke));
        CHECK(decoded->stroke().ink == nullptr);
        const auto ink = stored.ink(index - 1);
        CHECK(ink.has_value() == (stroke.ink != nullptr));
        if (ink && stroke.ink != nullptr) CHECK(*ink == *stroke.ink);
      }
      CHECK(stored.has_ink() == !character.physics.ink.empty());
      for (const int outside : {-1, index, index + 1, 1'000'000}) {
        CHECK_FALSE(stored.stroke(outside));
        CHECK_FALSE(stored.ink(outside));
        CHECK(stored.stroke_id(outside) == 0);
      }
    }
  }
}

TEST_CASE("iteration is by ascending code point, whatever the order of insertion", "[model]") {
  const std::vector<char32_t> codes{0, 1, 63, 64, 127, 128, 0xD7FF, 0xE000, 0xFFFF, 0x10000, 0x10FFBF, 0x10FFFF};
  std::vector<Character> characters;
  for (const char32_t code : codes) characters.insert(characters.begin(), one_stroke(code));
  const CharacterSet set = set_of(characters);
  CHECK(codes_of(set) == codes);
  CHECK(set.size() == codes.size());
  CHECK(set.next(0) == char32_t{0});
  CHECK(set.next(2) == char32_t{63});
  CHECK(set.next(0x10FFFF) == char32_t{0x10FFFF});
  CHECK_FALSE(set.next(0x110000));
}

TEST_CASE("a character may have several orders, the standard one first", "[model]") {
  const Character north = *built_in_characters().find(U'北');
  const CharacterSet set = set_of({named(paper_example(), "Table 3"), named(one_stroke(U'一'), "b"), north});
  CHECK(set.orders(U'北') == std::vector<std::string>{"", "Table 3"});
  CHECK(set.orders(U'一') == std::vector<std::string>{"b"});
  CHECK(set.orders(U'二').empty());
  CHECK(same(set.find(U'北')->character(), north));
  CHECK(set.find(U'北', "Table 3")->character().sequence.stroke_ids == std::vector{2, 1, 10, 31, 4});
  CHECK(set.find(U'一')->order() == "b");
  CHECK(set.size() == 2);
}

TEST_CASE("in layered sets the first set that has a character wins", "[model]") {
  const CharacterSet mine = set_of({one_stroke(U'b', 0.1), named(one_stroke(U'd', 0.1), "own")}, "mine");
  const CharacterSet standard =
      set_of({one_stroke(U'a', 0.9), one_stroke(U'b', 0.9), named(one_stroke(U'b', 0.8), "old"), one_stroke(U'd', 0.9)},
             "standard");
  const CharacterSet both = CharacterSet::layered(std::vector{mine, CharacterSet(), standard});
  CHECK(codes_of(both) == std::vector<char32_t>{U'a', U'b', U'd'});
  CHECK(both.size() == 3);
  CHECK(both.bytes() == mine.bytes() + standard.bytes());
  CHECK(both.find(U'a')->provenance().source == "standard");
  CHECK(both.find(U'b')->provenance().source == "mine");
  CHECK(both.find(U'b')->stroke(0)->points[0].y() == 0.1);
  CHECK(both.find(U'b', "old")->stroke(0)->points[0].y() == 0.8);  // only the order of the same name is hidden
  CHECK(both.find(U'd')->provenance().source == "standard");       // the standard order, if there is one
  CHECK(both.orders(U'b') == std::vector<std::string>{"", "old"});
  CHECK(both.orders(U'd') == std::vector<std::string>{"own", ""});
  CHECK(both.provenances().size() == 2);
  const CharacterSet turned = CharacterSet::layered(std::vector{standard, mine});
  CHECK(turned.find(U'b')->provenance().source == "standard");
  CHECK(CharacterSet::layered(std::vector{both, turned}).size() == 3);
}

TEST_CASE("a stored control point is within the bound of its precision, and so is every point of a curve", "[model]") {
  calligraphy_test::Sequence random(7);
  CharacterList list = rich_list();
  for (const double scale : {1.0, 0.3, 0.05}) {
    for (Character& character : calligraphy_test::typical_strokes_as_characters(scale, random).characters) {
      character.order = "scale " + std::to_string(scale);
      list.characters.push_back(character);
    }
  }
  for (const auto& [precision, most] :
       {std::pair{CoordinatePrecision::coarse, 0.004}, std::pair{CoordinatePrecision::standard, 0.001},
        std::pair{CoordinatePrecision::fine, 0.0001}, std::pair{CoordinatePrecision::exact, 0.0}}) {
    const double bound = coordinate_error_bound(precision);
    CHECK(bound <= most);
    const CharacterSet set = CharacterSet::from_bytes(encode_character_set(list, precision), "test");
    double largest = 0.0;
    for (const Character& character : list.characters) {
      const Character stored = set.find(character.code, character.order)->character();  // throws unless it is valid
      const auto &drawn = character.structure.control_points, &kept = stored.structure.control_points;
      REQUIRE(drawn.size() == kept.size());
      for (std::size_t i = 0; i < drawn.size(); ++i) largest = std::max(largest, (drawn[i] - kept[i]).norm());
      CHECK(stored.physics.attraction_factors == character.physics.attraction_factors);
    }
    CHECK(largest <= bound);
    CHECK(largest == Approx(set.coordinate_error()).margin(1e-14));
    if (precision != CoordinatePrecision::exact) CHECK(largest > 0.5 * bound);
  }
}

TEST_CASE("stored ink is within half a step of the original, whatever its width", "[model]") {
  const CharacterList list = rich_list();
  const struct {
    CoordinatePrecision precision;
    double most;  ///< error [em]
  } marks[] = {{CoordinatePrecision::coarse, 1.0 / 800.0},
               {CoordinatePrecision::standard, 1.0 / 1600.0},
               {CoordinatePrecision::fine, 1.0 / 25600.0},
               {CoordinatePrecision::exact, 0.0}};
  for (const auto& [precision, most] : marks) {
    CHECK(ink_error_bound(precision) == Approx(most).margin(1e-14));
    const CharacterSet set = CharacterSet::from_bytes(encode_character_set(list, precision), "test");
    double largest = 0.0;
    for (const Character& character : list.characters) {
      const std::vector<StrokeInk>& drawn = character.physics.ink;
      const std::vector<StrokeInk> kept = set.find(character.code, character.order)->character().physics.ink;
      REQUIRE(kept.size() == drawn.size());
      const auto compare = [&](double a, double b) { largest = std::max(largest, std::abs(a - b)); };
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        compare(drawn[i].start, kept[i].start);
        compare(drawn[i].end, kept[i].end);
        for (std::size_t k = 0; k < max_ink_knots; ++k) {
          compare(drawn[i].half_widths[k], kept[i].half_widths[k]);
          compare(drawn[i].offsets[k], kept[i].offsets[k]);
        }
        for (std::size_t k = 0; k < max_ink_corners; ++k) compare(drawn[i].shifts[k], kept[i].shifts[k]);
      }
    }
    CHECK(largest <= ink_error_bound(precision));
    CHECK(largest >= 0.9 * most);
  }
}

TEST_CASE("ink takes little more than half a byte a value where strokes of a kind are alike, and nothing where there is none",
          "[model]") {
  CharacterList list = built_in_characters();
  const std::size_t without = encode_character_set(list).size();
  calligraphy_test::Sequence random(13);
  std::size_t strokes = 0, values = 0;
  for (Character& character : list.characters) {
    strokes += character.sequence.stroke_ids.size();
    character = with_typical_ink(character);
    for (std::size_t i = 0; i < character.physics.ink.size(); ++i) {
      StrokeInk& ink = character.physics.ink[i];
      for (double& half_width : ink.half_widths) half_width *= random.between(0.9, 1.1);
      const std::size_t knots = ink_size(typical_stroke(character.sequence.stroke_ids[i]),
                                         character.sequence.elements[i].elements()).knots;
      for (std::size_t k = 0; k < knots; ++k) ink.offsets[k] += random.between(-2.0, 2.0) / 800.0;
      values += 2 + 2 * knots;
    }
  }
  const std::size_t with_offsets = encode_character_set(list).size() - without;
  CHECK(20 * with_offsets < 11 * values);
  for (Character& character : list.characters) {
    for (StrokeInk& ink : character.physics.ink) {
      std::fill_n(ink.offsets.begin(), 8, 0.4 / 800.0);  // zero once rounded
      std::fill(ink.offsets.begin() + 8, ink.offsets.end(), 0.0);
      ink.shifts = {};
    }
  }
  const auto straight = encode_character_set(list);
  CHECK(straight.size() - without < with_offsets - strokes);
  CHECK(CharacterSet::from_bytes(straight, "test").find(U'永')->ink(0)->offsets == decltype(StrokeInk::offsets){});
  for (Character& character : list.characters) character.physics.ink.clear();
  CHECK(encode_character_set(list).size() == without);
}

TEST_CASE("small strokes with smooth joints stay smooth at every precision", "[model]") {
  calligraphy_test::Sequence random(11);
  for (int repetition = 0; repetition < 20; ++repetition) {
    for (const double scale : {0.5, 0.1, 0.02}) {
      const CharacterList list = calligraphy_test::typical_strokes_as_characters(scale, random);
      for (const CoordinatePrecision precision :
           {CoordinatePrecision::coarse, CoordinatePrecision::standard, CoordinatePrecision::fine}) {
        CHECK_NOTHROW(CharacterSet::from_bytes(encode_character_set(list, precision), "test").check());
      }
    }
  }
}

TEST_CASE("decoding and encoding a set again gives the same bytes", "[model]") {
  const CharacterList list = rich_list();
  for (const CoordinatePrecision precision :
       {CoordinatePrecision::coarse, CoordinatePrecision::standard, CoordinatePrecision::fine}) {
    const CharacterSet set = CharacterSet::from_bytes(encode_character_set(list, precision), "test");
    CharacterList decoded{set.provenances()[0], {}};
    for (const StoredCharacter& character : set) {
      for (const std::string& order : set.orders(character.code())) {
        decoded.characters.push_back(set.find(character.code(), order)->character());
      }
    }
    CHECK(decoded.characters.size() == list.characters.size());
    const auto again = CharacterSet::from_bytes(encode_character_set(decoded, precision), "test");
    CHECK(again.bytes() == set.bytes());
    for (const StoredCharacter& character : set) {
      CHECK(same(again.find(character.code())->character(), character.character()));
    }
  }
}

TEST_CASE("seventy thousand characters across all of Unicode are found", "[model]") {
  std::vector<Character> characters;
  for (char32_t code = 0; code <= 0x10FFFF; code += 15) {
    if (code < 0xD800 || code > 0xDFFF) characters.push_back(one_stroke(code, 1e-6 * code / 2.0));
  }
  REQUIRE(characters.size() > 70'000);
  const CharacterSet set = set_of(characters);
  CHECK(set.size() == characters.size());
  std::size_t wrong = 0;
  for (const Character& character : characters) {
    const auto found = set.find(character.code);
    wrong +=
        !found || found->stroke(0)->points[0] != character.structure.control_points[0] || set.find(character.code + 1);
  }
  CHECK(wrong == 0);
  CHECK(codes_of(set).size() == characters.size());
}

TEST_CASE("characters with very many strokes, and groups larger than 16-bit offsets, are stored", "[model]") {
  calligraphy_test::Sequence random(5);
  std::vector<Character> characters;
  for (const int count : {127, 128, 256, 4096}) {
    std::vector<StrokeInput> strokes;
    for (int i = 0; i < count; ++i) {
      strokes.push_back({i % 2 == 0 ? 1 : 2, {random.point(0.0, 1.0), random.point(0.0, 1.0)}, {}});
    }
    characters.push_back(make_character(static_cast<char32_t>(0x4E00 + characters.size()), strokes));
  }
  const CharacterSet set = set_of(characters);
  for (const Character& character : characters) {
    const auto found = set.find(character.code);
    REQUIRE(found);
    CHECK(same(found->character(), character));
    const int last = character.stroke_count() - 1;
    CHECK(found->stroke(last)->points[1] == character.structure.control_points.back());
  }
}

TEST_CASE("finding a character and decoding its strokes does not allocate", "[model]") {
  const CharacterSet one = CharacterSet::from_bytes(encode_character_set(rich_list()), "test");
  const CharacterSet set = CharacterSet::layered(std::vector{set_of({one_stroke(U'一')}), one});
  double sum = 0.0, inked = 0.0;
  const std::size_t before = calligraphy_test::allocations();
  for (char32_t code = 0x4E00; code < 0x9FFF; ++code) {
    const auto found = set.find(code);
    for (int i = 0; found && i < found->stroke_count(); ++i) {
      const auto stroke = found->stroke(i);
      sum += stroke->stroke().control_points.back().x() + found->stroke_id(i);
      if (const auto ink = found->ink(i)) inked += ink->half_widths[0];
    }
  }
  CHECK(calligraphy_test::allocations() == before);
  CHECK(sum > 0.0);
  CHECK(inked > 0.0);
}

TEST_CASE("a character outlives its set, and a copied set outlives the original", "[model]") {
  std::optional<StoredCharacter> kept;
  CharacterSet copy;
  {
    const CharacterSet set(built_in_characters());
    kept = set.find(U'北');
    copy = set;
  }
  CHECK(same(kept->character(), *built_in_characters().find(U'北')));
  CHECK(kept->provenance() == built_in_characters().provenance);
  CHECK(copy.size() == built_in_characters().characters.size());
}

TEST_CASE("a default-constructed character has no strokes", "[model]") {
  const StoredCharacter none;
  CHECK(none.stroke_count() == 0);
  CHECK(none.stroke_id(0) == 0);
  CHECK_FALSE(none.stroke(0));
  CHECK_FALSE(none.ink(0));
  CHECK_FALSE(none.has_ink());
  CHECK(none.provenance() == Provenance());
  CHECK_THROWS_AS(none.character(), FormatError);
}

TEST_CASE("several threads find and decode in a set that none has used before", "[model]") {
  const CharacterList list = rich_list();
  for (int repetition = 0; repetition < 20; ++repetition) {
    const CharacterSet set(list);
    std::vector<std::size_t> right(4);
    std::vector<std::thread> threads;
    for (std::size_t& count : right) {
      threads.emplace_back([&] {
        for (const Character& character : list.characters) {
          const auto found = set.find(character.code, character.order);
          const auto stroke = found ? found->stroke(0) : std::nullopt;
          if (stroke && stroke->points[0] == character.structure.control_points[0]) ++count;
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(right == std::vector<std::size_t>(4, list.characters.size()));
  }
}

TEST_CASE("a character that cannot be encoded is named", "[model]") {
  const auto complaint = [](const std::vector<Character>& characters) -> std::string {
    try {
      encode_character_set({{}, characters});
    } catch (const ValueError& error) {
      return error.what();
    }
    return "";
  };
  const Character one = one_stroke(U'一');
  CHECK(complaint({one, one}).find("一 (U+4E00): occurs twice") != std::string::npos);
  CHECK(complaint({named(one, "a"), one, named(one, "a")}).find("一 (U+4E00) order a: occurs twice") !=
        std::string::npos);
  CHECK(complaint({named(one, "a"), one, named(one, "b")}).empty());
  CHECK(complaint({one_stroke(0xD800)}).find("U+D800") != std::string::npos);
  CHECK(complaint({one_stroke(0x110000)}).find("U+110000") != std::string::npos);
  for (const std::string& order : {std::string(" a"), std::string("a "), std::string("a\nb"), std::string("a#b"),
                                   std::string("\xFF"), std::string(256, 'a'), std::string(1, '\0')}) {
    CHECK(complaint({named(one, order)}).find("is not a valid name of a stroke order") != std::string::npos);
  }
  CHECK(complaint({named(one, std::string(255, 'a'))}).empty());
  Character broken = one;
  broken.structure.control_points[1].x() = std::nan("");
  CHECK(complaint({broken}).find("一 (U+4E00): stroke 1: control point") != std::string::npos);
  CHECK(complaint({Character{}}).find("there is no stroke") != std::string::npos);
}
