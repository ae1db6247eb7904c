#include <calligraphy/judge/remark_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/judge/pen_path.hpp>

#include "judge/judge_constants.hpp"
#include "judge/pens/pen_paths.hpp"
#include "judge/pens/resemblance.hpp"

namespace calligraphy {
namespace {

constexpr double clear_offset = 0.05;  // distance of an end from another stroke from which it shows a way [em]
constexpr double straight = 0.85;  // distance of the ends, over the length, below which they do not show the way [1]
// Shorter side of a box, over the longer, up to which places are not distinguished along it [1].
constexpr double flat_stroke = 0.4, flat_character = 0.15;

/// Keys of the thirds of a box, from the bottom left, row by row.
constexpr std::array<std::string_view, 9> thirds = {
    "place.bottom_left", "place.bottom",   "place.bottom_right", "place.left",     "place.middle",
    "place.right",       "place.top_left", "place.top",          "place.top_right"};
constexpr std::size_t middle_of_box = 4;

/// Index in `thirds` of the third of a box, across and up, in which a point lies.
std::size_t place_in(const Eigen::AlignedBox2d& box, double flat, const Point& point) {
  const Point sides = box.sizes(), from = point - box.min();
  std::array<std::size_t, 2> third = {1, 1};
  for (const int i : {0, 1}) {
    if (sides[i] <= flat * sides.maxCoeff()) continue;
    third[static_cast<std::size_t>(i)] = static_cast<std::size_t>(std::clamp(3.0 * from[i] / sides[i], 0.0, 2.0));
  }
  return 3 * third[1] + third[0];
}

/// "1st", "2nd", "11th" for an index from 0, from as many of the last digits as the language has a text for.
std::string ordinal(int index, const Language& language) {
  const std::string number = std::to_string(index + 1LL);
  std::string text;
  for (std::size_t first = 0; text.empty() && first < number.size(); ++first) {
    text = language.text("ordinal." + number.substr(first), {{"number", number}});
  }
  return text.empty() ? language.text("ordinal", {{"number", number}}) : text;
}

/// The name of an enumerator as a part of a key.
std::string key_of(const char* name) {
  std::string key = name;
  std::replace(key.begin(), key.end(), ' ', '_');
  return key;
}

/// The last part of the keys for a way to go: of the four, the one that is nearest.
std::string_view nearest_way(const Point& way) {
  if (std::abs(way.x()) > std::abs(way.y())) return way.x() > 0.0 ? "right" : "left";
  return way.y() > 0.0 ? "top" : "bottom";
}

/// A remark in words.
class Sentence {
 public:
  Sentence(const StrokeRemark& remark, const Character& character, const Language& language)
      : remark_(remark), code_(character.code), strokes_(strokes(character)), language_(language) {
    using Kind = StrokeRemarkKind;
    if (remark.kind < Kind::order || remark.kind > Kind::proportion) throw ValueError("remark: there is no such kind");
    const bool is_on_stroke = remark.kind < Kind::extra || remark.kind >= Kind::parts;
    require_stroke(remark.stroke, remark.stroke_count, is_on_stroke ? 0 : -1);
    require_stroke(remark.other_stroke, 1, is_on_two_strokes() ? 0 : -1);
    if (remark.end < StrokeEnd::none || remark.end > StrokeEnd::end) throw ValueError("remark: there is no such end");
    const bool is_turned = remark.orientation > WritingOrientation::upright &&
                           remark.orientation <= WritingOrientation::mirrored_right;
    if (remark.kind == Kind::orientation && !is_turned) throw ValueError("remark on the orientation: it names none");
    if (remark.kind == Kind::extra && remark.path < 0) throw ValueError("remark on an extra pen-down: it names none");
  }

  std::string text() const {
    if (is_of_form(remark_.kind)) return of_form();
    switch (remark_.kind) {
      case StrokeRemarkKind::order:
        return order();
      case StrokeRemarkKind::direction:
        return say(starts_at_a_side(remark_.stroke) ? "direction.placed" : "direction");
      case StrokeRemarkKind::shape: {
        const std::string_view key = remark_.length < detail::judge_constants.least_share ? "part" : "shape";
        const bool is_straight = remark_.stroke_count == 1 && is_nearly_straight(remark_.stroke);
        return say(std::string(key) + (is_straight ? ".straight" : ""));
      }
      case StrokeRemarkKind::broken:
        return say(remark_.path_count > 2 ? "broken.three" : "broken");
      case StrokeRemarkKind::missing:
        return say(place_in_character() == middle_of_box ? "missing.middle" : "missing");
      case StrokeRemarkKind::extra:
        return extra();
      default:
        return say(to_string(remark_.kind));
    }
  }

 private:
  /// Whether it relates one stroke, or part, to another.
  bool is_on_two_strokes() const {
    using Kind = StrokeRemarkKind;
    constexpr std::array kinds = {Kind::parts, Kind::crossing, Kind::no_crossing, Kind::gap, Kind::side,
                                  Kind::proportion};
    if (remark_.kind == Kind::overlap) return remark_.stroke_count < 2;
    return std::find(kinds.begin(), kinds.end(), remark_.kind) != kinds.end();
  }

  /// @throws ValueError unless the character has these strokes, the first of which is at least `least`
  void require_stroke(int first, int count, int least) const {
    const auto strokes = static_cast<int>(strokes_.size());
    if (first >= least && (first < 0 || (first < strokes && count <= strokes - first))) return;
    throw ValueError("remark on " + std::to_string(count) + " strokes from index " + std::to_string(first) +
                     ": the character has " + std::to_string(strokes));
  }

  std::string order() const {
    if (remark_.other_stroke < 0) return say("order.reversed");
    if (remark_.other_path >= 0) return say("order.exchanged");
    if (remark_.stroke > remark_.other_stroke) return say("order.early");
    return say(remark_.stroke == 0 ? "order.first" : "order.late");
  }

  std::string extra() const {
    if (remark_.other_stroke < 0) return say("extra");
    if (remark_.direction == WritingDirection::backwards) {
      return say(starts_at_a_side(remark_.other_stroke) ? "extra.backwards.placed" : "extra.backwards");
    }
    return say(remark_.other_path < 0 ? "extra.unlike" : "extra.twice");
  }

  std::string of_form() const {
    using Kind = StrokeRemarkKind;
    const std::string key = key_of(to_string(remark_.kind));
    const bool becomes_another = remark_.other_character != 0;
    const std::string at_end = remark_.end == StrokeEnd::none ? "" : std::string(".") + to_string(remark_.end);
    switch (remark_.kind) {
      case Kind::orientation:
        return say(key + "." + key_of(to_string(remark_.orientation)));
      case Kind::parts:
        return say(place_in_character() == middle_of_box ? "parts.middle" : key);
      case Kind::crossing:
      case Kind::no_crossing:
        if (becomes_another) return say(at_end.empty() ? key + ".becomes" : "becomes" + at_end);
        return say(key + at_end);
      case Kind::gap:
        return say(key + at_end);
      case Kind::overlap:
      case Kind::straight:
      case Kind::wavy:
        return say(remark_.stroke_count > 1 ? key + ".all" : key);
      case Kind::length:
        return say(remark_.length < 1.0 ? "length.short" : "length.long");
      case Kind::proportion:
        return say(becomes_another ? key + ".becomes" : key);
      default:
        return say(key);
    }
  }

  /// The text of a key, with everything that a remark may name filled in.
  std::string say(std::string_view key) const {
    const bool is_exchange = remark_.kind == StrokeRemarkKind::order && remark_.other_path >= 0;
    const auto [first, other] = is_exchange ? std::minmax({remark_.stroke, remark_.other_stroke})
                                            : std::pair(remark_.stroke, remark_.other_stroke);
    const auto [line, other_line] = key == "extra.twice" ? std::minmax({remark_.path, remark_.other_path})
                                                         : std::pair(remark_.path, remark_.other_path);
    const Ends ends = ends_of(remark_.kind == StrokeRemarkKind::extra ? remark_.other_stroke : remark_.stroke);
    const bool is_placed = remark_.kind == StrokeRemarkKind::missing || remark_.kind == StrokeRemarkKind::parts;
    const std::size_t start = is_placed ? place_in_character() : ends.start;
    const std::string way(nearest_way(way_off()));
    return language_.text_for(remark_.stroke_count, key,
                              {{"strokes", all_strokes()},
                               {"first", stroke(first)},
                               {"first_number", std::to_string(first + 1)},
                               {"last_number", std::to_string(last() + 1)},
                               {"before_number", std::to_string(remark_.stroke)},
                               {"other", stroke(other)},
                               {"line", ordinal(line, language_)},
                               {"other_line", ordinal(other_line, language_)},
                               {"start", language_.text(thirds[start])},
                               {"end", language_.text(thirds[ends.end])},
                               {"off", language_.text("off." + way)},
                               {"way", language_.text("way." + way)},
                               {"written", encode_utf8(remark_.other_character)},
                               {"asked", encode_utf8(code_)}});
  }

  int last() const { return remark_.stroke < 0 ? -1 : remark_.stroke + std::max(remark_.stroke_count, 1) - 1; }

  /// "2 (héng)"; empty for no stroke.
  std::string stroke(int index) const {
    if (index < 0) return {};
    const TypicalStroke& type = *strokes_[static_cast<std::size_t>(index)].type;
    return language_.text("stroke",
                          {{"number", std::to_string(index + 1)}, {"pinyin", type.pinyin}, {"name", type.name}});
  }

  /// "2 (héng) to 4 (nà)"
  std::string all_strokes() const {
    const std::string first = stroke(remark_.stroke);
    if (remark_.kind == StrokeRemarkKind::joined && remark_.other_stroke >= 0) {
      return language_.text("strokes.two", {{"first", first}, {"last", stroke(remark_.other_stroke)}});
    }
    if (remark_.stroke_count < 2) return first;
    return language_.text(remark_.stroke_count == 2 ? "strokes.two" : "strokes.more",
                          {{"first", first}, {"last", stroke(last())}});
  }

  std::vector<Point> line_of(int index) const { return middle_line(strokes_[static_cast<std::size_t>(index)]); }

  /// Where a stroke starts and ends, as thirds of its box.
  struct Ends {
    std::size_t start = middle_of_box, end = middle_of_box;
  };

  Ends ends_of(int index) const {
    if (index < 0) return {};
    const std::vector<Point> line = line_of(index);
    const Eigen::AlignedBox2d box = box_of_all({&line, 1});
    return {place_in(box, flat_stroke, line.front()), place_in(box, flat_stroke, line.back())};
  }

  /// Whether it helps to say where a stroke starts.
  bool starts_at_a_side(int index) const {
    const Ends ends = ends_of(index);
    return ends.start != ends.end && ends.start != middle_of_box;
  }

  /// Whether a stroke is so straight that its ends show how it runs.
  bool is_nearly_straight(int index) const {
    const std::vector<Point> line = line_of(index);
    return (line.front() - line.back()).norm() >= straight * path_length(line);
  }

  /// The third of the character in which the middle of the remark's stroke lies, or that of its part.
  std::size_t place_in_character() const {
    std::vector<PenPath> lines;
    for (const Stroke& stroke : strokes_) lines.push_back(middle_line(stroke));
    const auto first = static_cast<std::size_t>(remark_.stroke), count = static_cast<std::size_t>(last()) - first + 1;
    const bool is_part = remark_.kind == StrokeRemarkKind::parts;
    const Point middle =
        is_part ? box_of_all(std::span(lines).subspan(first, count)).center() : halfway(lines[first]);
    return place_in(box_of_all(lines), flat_character, middle);
  }

  /// The way in which a stroke, or its end, is out of place.
  Point way_off() const {
    if (remark_.kind == StrokeRemarkKind::place || remark_.offset.norm() > clear_offset) return remark_.offset;
    if (remark_.kind == StrokeRemarkKind::crossing) return way_of_end();
    if (remark_.kind == StrokeRemarkKind::no_crossing) return -way_of_end();
    return remark_.offset;
  }

  /// From the inside of a stroke to the remark's end. A third of the stroke is more than a hook.
  Point way_of_end() const {
    const std::vector<Point> line = line_of(remark_.stroke);
    const std::vector<Point> inside = points_along(line, path_length(line), 4);
    return remark_.end == StrokeEnd::end ? Point(line.back() - inside[2]) : Point(line.front() - inside[1]);
  }

  const StrokeRemark& remark_;
  const char32_t code_;
  const std::vector<Stroke> strokes_;
  const Language& language_;
};

}  // namespace

std::string remark_text(const StrokeRemark& remark, const Character& character, const Language& language) {
  return Sentence(remark, character, language).text();
}

}  // namespace calligraphy
