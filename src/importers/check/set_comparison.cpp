#include <calligraphy/importers/set_comparison.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>

#include <calligraphy/base/text.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/model/stroke_polyline.hpp>

#include "base/enum_name.hpp"
#include "base/parallel.hpp"
#include "model/code_point_name.hpp"

namespace calligraphy {
namespace {

constexpr double same_drawing = 0.07;  // [em]; seven in ten characters of hanzi-writer-data and KanjiVG differ by less

std::string strokes_word(std::size_t count) { return std::to_string(count) + (count == 1 ? " stroke" : " strokes"); }

/// The writing of one character compared with what another collection has for it.
class CharacterComparison {
 public:
  CharacterComparison(const Character& character, const CharacterSet& other, const CharacterIndex& index)
      : character_(character), index_(index) {
    for (const StoredCharacter& form : other.forms(character.code)) forms_.push_back(form.character());
    if (forms_.empty()) return;
    for (const Stroke& stroke : strokes(character)) paths_.push_back(stroke_polyline(stroke, 1e-3));
    compare();
  }

  bool is_there() const { return !forms_.empty(); }
  std::vector<SetDifference>& differences() { return differences_; }

 private:
  void add(SetDifferenceKind kind, std::string what) {
    differences_.push_back({character_.code, character_.order, kind, std::move(what)});
  }

  void compare() {
    std::vector<Character> as_long;
    for (const Character& form : forms_) {
      if (form.sequence.stroke_ids.size() == paths_.size()) as_long.push_back(form);
    }
    if (as_long.empty()) {
      add_count();
      return;
    }
    const MatchResult match = match_strokes(as_long, paths_, {.form = false});
    if (const std::optional<char32_t> drawn = drawn_as(0.5 * mean_distance(match))) {
      add(SetDifferenceKind::character, "its drawing is nearest to " + code_point_name(*drawn) + " there");
    } else {
      add_order(match);
      add_directions(match);
    }
  }

  static double mean_distance(const MatchResult& match) {
    double sum = 0.0;
    for (const DrawnStroke& drawn : match.drawn) sum += drawn.stroke < 0 ? 1.0 : drawn.distance;
    return sum / static_cast<double>(match.drawn.size());
  }

  /// Another character of about the same drawing, if there is one within `distance` [em].
  std::optional<char32_t> drawn_as(double distance) const {
    const std::vector<RecognisedCharacter> nearest = index_.recognise(paths_, 1);
    if (nearest.empty() || nearest[0].code == character_.code) return std::nullopt;
    if (nearest[0].distance > std::min(distance, same_drawing)) return std::nullopt;
    return nearest[0].code;
  }

  void add_count() {
    const std::string counts = "has " + strokes_word(paths_.size()) + ", there " +
                               std::to_string(forms_.front().sequence.stroke_ids.size());
    const std::optional<char32_t> drawn = drawn_as(same_drawing);
    add(drawn ? SetDifferenceKind::character : SetDifferenceKind::count,
        counts + (drawn ? "; its drawing is nearest to " + code_point_name(*drawn) : ""));
  }

  void add_order(const MatchResult& match) {
    std::vector<std::size_t> numbers(match.drawn.size());  // of the strokes here, in the order there
    for (std::size_t i = 0; i < match.drawn.size(); ++i) {
      const DrawnStroke& drawn = match.drawn[i];
      const bool is_one = drawn.stroke >= 0 && drawn.stroke_count == 1 && drawn.also < 0 && !drawn.continues;
      if (!is_one) return;  // too unlike to tell
      numbers[static_cast<std::size_t>(drawn.stroke)] = i + 1;
    }
    if (match.count(StrokeRemarkKind::order) == 0 || std::is_sorted(numbers.begin(), numbers.end())) return;
    std::string order;
    for (const std::size_t number : numbers) order += (order.empty() ? "" : " ") + std::to_string(number);
    add(SetDifferenceKind::order, "is written in the order " + order + " there");
  }

  void add_directions(const MatchResult& match) {
    for (const StrokeRemark& remark : match.remarks) {
      if (remark.kind != StrokeRemarkKind::direction) continue;
      add(SetDifferenceKind::direction, "stroke " + std::to_string(remark.path + 1) + " runs the other way there");
    }
  }

  const Character& character_;
  const CharacterIndex& index_;
  std::vector<Character> forms_;
  std::vector<PenPath> paths_;
  std::vector<SetDifference> differences_;
};

}  // namespace

const char* to_string(SetDifferenceKind kind) noexcept {
  static constexpr const char* names[] = {"character", "count", "order", "direction"};
  return name_of<SetDifferenceKind::direction>(kind, names, "direction");
}

SetComparison compare_sets(const CharacterList& list, const CharacterSet& other, int threads,
                           const std::function<void(double)>& progress) {
  const CharacterIndex index(other);
  std::vector<std::vector<SetDifference>> differences(list.characters.size());
  std::vector<char> is_there(list.characters.size());
  parallel_for(list.characters.size(), threads, progress, [&](std::size_t i) {
    CharacterComparison comparison(list.characters[i], other, index);
    is_there[i] = comparison.is_there() ? 1 : 0;
    differences[i] = std::move(comparison.differences());
  });
  SetComparison result;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    result.compared += is_there[i];
    result.differences.insert(result.differences.end(), differences[i].begin(), differences[i].end());
  }
  return result;
}

}  // namespace calligraphy
