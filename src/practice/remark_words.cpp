#include "remark_words.hpp"

#include <cstddef>

namespace calligraphy {
namespace {

std::string pen_down(int path) { return "pen-down " + std::to_string(path + 1); }

class Words {
 public:
  explicit Words(std::span<const Stroke> strokes) : strokes_(strokes) {}

  std::string stroke(int index) const {
    const std::string_view pinyin = strokes_[static_cast<std::size_t>(index)].type->pinyin;
    return "stroke " + std::to_string(index + 1) + " (" + std::string(pinyin) + ")";
  }

  std::string strokes(const StrokeRemark& remark) const {
    if (remark.stroke_count == 1) return stroke(remark.stroke);
    return stroke(remark.stroke) + " to " + stroke(remark.stroke + remark.stroke_count - 1);
  }

  std::string order(const StrokeRemark& remark) const {
    const std::string other = stroke(remark.other_stroke);
    if (remark.other_path >= 0) return strokes(remark) + " and " + other + " changed places";
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
  std::span<const Stroke> strokes_;
};

}  // namespace

std::string sentence(const StrokeRemark& remark, std::span<const DrawnStroke> drawn, std::span<const Stroke> strokes) {
  const Words words(strokes);
  switch (remark.kind) {
    case StrokeRemarkKind::order:
      return words.order(remark);
    case StrokeRemarkKind::direction:
      return words.strokes(remark) + (remark.stroke_count > 1 ? " were" : " was") + " written backwards";
    case StrokeRemarkKind::shape:
      return pen_down(remark.path) + " runs neither along " + words.stroke(remark.stroke) +
             " nor against it: it was drawn as another shape";
    case StrokeRemarkKind::joined:
      return words.strokes(remark) + " were written as one: connected writing, no mistake of order";
    case StrokeRemarkKind::broken:
      return words.stroke(remark.stroke) + " was written in two pen-downs, " + std::to_string(remark.path + 1) +
             " and " + std::to_string(remark.path + 2);
    case StrokeRemarkKind::missing:
      return words.stroke(remark.stroke) + " was not written";
    case StrokeRemarkKind::extra:
      break;
  }
  return words.extra(remark, drawn[static_cast<std::size_t>(remark.path)].direction);
}

}  // namespace calligraphy
