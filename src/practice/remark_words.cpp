#include "remark_words.hpp"

#include <cstddef>
#include <string_view>

#include <calligraphy/base/text.hpp>

#include "stroke_direction.hpp"

namespace calligraphy {
namespace {

std::string pen_down(int path) { return "pen-down " + std::to_string(path + 1); }

class Words {
 public:
  explicit Words(std::span<const Stroke> strokes) : strokes_(strokes) {}

  std::string stroke(int index) const { return "stroke " + numbered(index); }

  std::string strokes(const StrokeRemark& remark) const {
    if (remark.stroke_count == 1) return stroke(remark.stroke);
    const std::string between = remark.stroke_count == 2 ? " and " : " to ";
    return "strokes " + numbered(remark.stroke) + between + numbered(remark.stroke + remark.stroke_count - 1);
  }

  std::string order(const StrokeRemark& remark) const {
    if (remark.other_stroke < 0) return strokes(remark) + " were written from the last to the first";
    const std::string other = stroke(remark.other_stroke);
    if (remark.other_path >= 0) {
      return "strokes " + numbered(remark.stroke) + " and " + numbered(remark.other_stroke) + " changed places";
    }
    const std::string were = remark.stroke_count > 1 ? " were written " : " was written ";
    if (remark.stroke > remark.other_stroke) return strokes(remark) + were + "where " + other + " was due";
    return strokes(remark) + were + "only after " + other;
  }

  std::string extra(const StrokeRemark& remark, WritingDirection direction) const {
    if (remark.other_stroke < 0) return pen_down(remark.path) + " resembles none of the strokes";
    std::string text = pen_down(remark.path) + " is another attempt at " + stroke(remark.other_stroke);
    if (direction == WritingDirection::backwards) text += ", backwards";
    if (remark.other_path >= 0) text += ", which " + pen_down(remark.other_path) + " wrote";
    return text;
  }

 private:
  std::string numbered(int index) const {
    const std::string_view pinyin = strokes_[static_cast<std::size_t>(index)].type->pinyin;
    return std::to_string(index + 1) + " (" + std::string(pinyin) + ")";
  }

  std::span<const Stroke> strokes_;
};

}  // namespace

std::string sentence(const StrokeRemark& remark, std::span<const DrawnStroke> drawn, char32_t character,
                     std::span<const Stroke> strokes) {
  const Words words(strokes);
  switch (remark.kind) {
    case StrokeRemarkKind::order:
      return words.order(remark);
    case StrokeRemarkKind::direction:
      return words.strokes(remark) + (remark.stroke_count > 1 ? " were" : " was") + " written backwards";
    case StrokeRemarkKind::shape:
      if (drawn[static_cast<std::size_t>(remark.path)].length < least_share) {
        return "only a part of " + words.stroke(remark.stroke) + " was written";
      }
      return pen_down(remark.path) + " runs neither along " + words.stroke(remark.stroke) +
             " nor against it: it was drawn as another shape";
    case StrokeRemarkKind::joined:
      return words.strokes(remark) + " were written as one: connected writing, no mistake of order";
    case StrokeRemarkKind::broken:
      return words.stroke(remark.stroke) + " was written in two pen-downs, " + std::to_string(remark.path + 1) +
             " and " + std::to_string(remark.path + 2);
    case StrokeRemarkKind::missing:
      return words.stroke(remark.stroke) + " was not written";
    case StrokeRemarkKind::character:
      return "this is " + encode_utf8(remark.other_character) + ", not " + encode_utf8(character);
    case StrokeRemarkKind::lookalike:
      return "this is nearer to " + encode_utf8(remark.other_character) + " than to " + encode_utf8(character);
    case StrokeRemarkKind::extra:
      break;
  }
  return words.extra(remark, drawn[static_cast<std::size_t>(remark.path)].direction);
}

}  // namespace calligraphy
