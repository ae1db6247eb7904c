// What is known of the form of a character before anybody writes it: how its strokes meet, cross and lie beside each
// other.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <calligraphy/judge/stroke_remark.hpp>
#include <calligraphy/model/character.hpp>

#include "form_line.hpp"

namespace calligraphy {

/// A crossing of two lines by its tails, the parts of the two lines before and after it. The depth is the length of the
/// shortest tail: a line that sticks out beyond another by x crosses it with the depth x, a corner with almost none.
struct DeepCrossing {
  double depth;                   ///< [em]
  double share_one, share_other;  ///< places on the two lines, as shares of their lengths [1]
  bool is_of_one;                 ///< whether the shortest tail is one of the first line
  StrokeEnd end;                  ///< the end of that tail
};

/// All crossings of two lines.
std::vector<DeepCrossing> deep_crossings(const FormLine& one, const FormLine& other);

/// How one line lies beside another, over those of its points that have a foot within the other.
struct Beside {
  std::vector<bool> points;  ///< the points that count
  std::size_t count = 0;     ///< their number
  double signed_gap = 0.0;   ///< mean distance, positive to the left of the other [em]
  double gap = 9.0;          ///< mean of its absolute value [em]
  double parallel = 0.0;     ///< mean of the absolute cosine of the angle between the two [1]
};

/// `among`: the points of the line that may count; empty: all.
Beside beside(const FormLine& line, const FormLine& other, const std::vector<bool>& among = {});

/// An end of a stroke that lies on another stroke.
struct Meeting {
  std::size_t stroke;
  StrokeEnd end;
  std::size_t other;
  double distance;       ///< of the end from the other stroke [em]
  double before, after;  ///< lengths of the other stroke up to there and from there on [em]
};

/// Two strokes side by side, all of one beside the other.
struct Neighbours {
  std::size_t stroke, other;
  Beside beside;
};

/// Two straight strokes side by side, of different lengths, in the order of writing.
struct Parallels {
  std::size_t stroke, other;
  double longer_by;  ///< by how much the first is longer [em]
};

/// The form of a character.
struct CharacterForm {
  explicit CharacterForm(const Character& character);

  std::size_t count() const { return strokes.size(); }
  const std::vector<DeepCrossing>& crossings_of(std::size_t one, std::size_t other) const {
    return crossings[one * strokes.size() + other];
  }

  std::vector<FormLine> strokes;
  std::vector<FormLine> bodies;                      ///< without their hooks
  std::vector<std::optional<std::size_t>> hooks;     ///< index of the point where the hook of each stroke begins
  std::vector<std::vector<DeepCrossing>> crossings;  ///< of pairs, the first before the second in the order of writing
  std::vector<Meeting> meetings;
  std::vector<Neighbours> neighbours;
  std::vector<Parallels> parallels;
};

/// The end of a line.
const Point& end_of(const FormLine& line, StrokeEnd end);

}  // namespace calligraphy
