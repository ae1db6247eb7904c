// Characters for testing character sets.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_set.hpp>

#include "../hard_cases.hpp"

namespace calligraphy_test {

inline bool same(const calligraphy::Character& a, const calligraphy::Character& b) {
  return a.code == b.code && a.order == b.order && a.curve_degree == b.curve_degree &&
         a.sequence.stroke_ids == b.sequence.stroke_ids && a.sequence.elements == b.sequence.elements &&
         a.sequence.feature_points == b.sequence.feature_points &&
         a.structure.control_points == b.structure.control_points &&
         a.physics.attraction_factors == b.physics.attraction_factors && a.physics.ink == b.physics.ink;
}

/// Ink of a stroke of this kind: no start, end or half-width beyond one length, no offset or shift beyond another [em].
inline calligraphy::StrokeInk random_ink(const calligraphy::TypicalStroke& type, std::string_view elements,
                                         double widest, double farthest, Sequence& random) {
  const auto [knots, corners] = calligraphy::ink_size(type, elements);
  calligraphy::StrokeInk ink{random.between(0.0, widest), random.between(0.0, widest)};
  for (double& half_width : std::span(ink.half_widths).first(knots)) half_width = random.between(0.0, widest);
  for (double& offset : std::span(ink.offsets).first(knots)) offset = random.between(-farthest, farthest);
  for (double& shift : std::span(ink.shifts).first(corners)) shift = random.between(-farthest, farthest);
  return ink;
}

/// Ink for every stroke of a character, no value beyond `most` [em].
inline void add_ink(calligraphy::Character& character, double most, Sequence& random) {
  std::vector<calligraphy::StrokeInk> inks;
  for (const calligraphy::Stroke& stroke : calligraphy::strokes(character)) {
    inks.push_back(random_ink(*stroke.type, stroke.elements, most, most, random));
  }
  character.physics.ink = std::move(inks);
}

/// Every typical stroke as a separate character from U+4E00 on, each scaled about a different point.
inline calligraphy::CharacterList typical_strokes_as_characters(double scale, Sequence& random) {
  calligraphy::CharacterList list;
  for (const calligraphy::TypicalStroke& type : calligraphy::typical_strokes()) {
    calligraphy::StrokeInput stroke{type.id, {}, {}};
    const Point place = random.point(0.0, 1.0 - scale);
    for (const std::array<double, 2>& point : type.shape) {
      stroke.control_points.push_back(place + scale * Point(point[0], point[1]));
    }
    list.characters.push_back(
        calligraphy::make_character(static_cast<char32_t>(0x4E00 + type.id), std::vector{stroke}));
  }
  return list;
}

/// The built-in characters and rare cases: quartics, factors, alternate orders, points far outside, numbers with all
/// digits, four-byte code points, ink of some and very wide ink of a few.
inline calligraphy::CharacterList rich_list() {
  calligraphy::CharacterList list = calligraphy::built_in_characters();
  list.provenance.licence_text = "First line\n\n  the third\n";
  Sequence random(3);
  const calligraphy::Character first = *list.find(U'永'), second = *list.find(U'北');
  list.characters.push_back(with_quartic_curves(first));
  list.characters.back().code = U'\U00020000';
  list.characters.push_back(calligraphy::paper_example());
  list.characters.back().order = "Table 3";
  list.characters.push_back(with_quartic_curves(second));
  list.characters.back().order = "四";
  for (calligraphy::Point& point : list.characters.back().structure.control_points) point += Point(-15.0, 14.0);
  list.characters.push_back(first);
  list.characters.back().code = U'\U0010FFFF';
  list.characters.push_back(first);
  list.characters.back().code = U'\0';
  for (std::size_t i = 0; i < list.characters.size(); i += 3) {
    for (double& factor : list.characters[i].physics.attraction_factors) factor = random.between(0.0, 3.0);
    for (Point& point : list.characters[i].structure.control_points) point += 1e-3 * random.point(-1.0, 1.0);
  }
  for (std::size_t i = 0; i < list.characters.size(); i += 2) {
    add_ink(list.characters[i], i % 10 == 0 ? calligraphy::max_ink_length : 0.06, random);
  }
  return list;
}

/// One horizontal stroke.
inline calligraphy::Character one_stroke(char32_t code, double y = 0.5) {
  const std::vector<calligraphy::StrokeInput> strokes{{1, {Point(0.1, y), Point(0.9, y)}, {}}};
  return calligraphy::make_character(code, strokes);
}

}  // namespace calligraphy_test
