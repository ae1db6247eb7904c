#include "remark_words.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <calligraphy/base/text.hpp>
#include <calligraphy/judge/pen_path.hpp>

#include "judge/pens/resemblance.hpp"
#include "judge/reading/stroke_direction.hpp"

namespace calligraphy {
namespace {

constexpr double straight = 0.85;  // ends nearer to each other, of its length: they do not tell the way [1]
// A side of a box that is shorter, of the longer: nothing is said along it. Of strokes, and of characters [1].
constexpr double flat_stroke = 0.4, flat_character = 0.15;

struct Place {
  std::string_view english;
  std::string_view chinese;
};

/// Of a box, from the bottom left, row by row.
constexpr std::array<Place, 9> thirds = {{{"bottom left", "左下方"},
                                          {"bottom", "下边"},
                                          {"bottom right", "右下方"},
                                          {"left", "左边"},
                                          {"middle", "中间"},
                                          {"right", "右边"},
                                          {"top left", "左上方"},
                                          {"top", "上边"},
                                          {"top right", "右上方"}}};
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

/// "1st", "2nd", "3rd", "4th", "11th", "21st" of an index from 0
std::string ordinal(int index) {
  const int number = index + 1;
  const int last = number % 10;
  const bool is_regular = number / 10 % 10 == 1 || last < 1 || last > 3;
  constexpr std::array<const char*, 3> endings = {"st", "nd", "rd"};
  return std::to_string(number) + (is_regular ? "th" : endings[static_cast<std::size_t>(last - 1)]);
}

class Words {
 public:
  Words(const StrokeRemark& remark, std::span<const Stroke> strokes) : remark_(remark), strokes_(strokes) {}

  RemarkWords order() const {
    const int other = remark_.other_stroke;
    if (other < 0) {
      const int last = remark_.stroke + remark_.stroke_count;
      return {"Strokes " + english_number(remark_.stroke) + " to " + std::to_string(last) +
                  " were written from the last to the first: begin with stroke " + english(remark_.stroke) + ".",
              chinese_number(remark_.stroke) + "到第" + std::to_string(last) + "笔的笔顺全反了，要从" +
                  chinese(remark_.stroke) + "写起。"};
    }
    if (remark_.other_path >= 0) {
      const auto [first, second] = std::minmax(remark_.stroke, other);
      return {"Strokes " + english(first) + " and " + english(second) + " changed places: write stroke " +
                  english_number(first) + " first.",
              chinese(first) + "和" + chinese(second) + "先后颠倒了，先写" + chinese_number(first) + "。"};
    }
    if (remark_.stroke > other) {
      return {english_strokes() + " came too early: write stroke " + english(other) + " first.",
              chinese_strokes() + "写早了，先写" + chinese(other) + "。"};
    }
    const bool is_first = remark_.stroke == 0;
    const std::string pronoun = is_several() ? "them" : "it";
    return {english_strokes() + " came too late: write " + pronoun +
                (is_first ? " first." : " straight after stroke " + english_number(remark_.stroke - 1) + "."),
            chinese_strokes() + "写晚了，" +
                (is_first ? std::string("要最先写。") : "要紧接着" + chinese_number(remark_.stroke - 1) + "写。")};
  }

  RemarkWords direction() const {
    if (is_several()) {
      const Ends ends = ends_of(remark_.stroke);
      return {english_strokes() + " were written backwards: begin with stroke " + english_number(remark_.stroke) +
                  (ends.is_told ? ", at the " + std::string(ends.start.english) + "." : "."),
              chinese_strokes() + "的方向反了，先写" + chinese_number(remark_.stroke) +
                  (ends.is_told ? "，从" + std::string(ends.start.chinese) + "起笔。" : "。")};
    }
    const RemarkWords start = start_of(remark_.stroke);
    return {english_strokes() + " was written backwards: " + start.english + ".",
            chinese_strokes() + "的方向反了，" + start.chinese + "。"};
  }

  RemarkWords shape() const {
    const RemarkWords way = way_of_all();
    return {english_strokes() + (is_several() ? " do" : " does") +
                " not look right: " + (way.english.empty() ? "follow the model." : "draw it " + way.english + "."),
            chinese_strokes() + "的形状不太对，" + (way.chinese.empty() ? "请照着范字写。" : way.chinese + "。")};
  }

  RemarkWords part() const {
    const RemarkWords way = way_of_all();
    std::string strokes = english_strokes();
    strokes.front() = 's';
    return {"Only a part of " + strokes + " is there: draw all of " + (is_several() ? "them" : "it") +
                (way.english.empty() ? "." : ", " + way.english + "."),
            chinese_strokes() + "只写了一部分，要写完整" + (way.chinese.empty() ? "。" : "，" + way.chinese + "。")};
  }

  RemarkWords joined() const {
    return {english_strokes() + " are joined, as in quick writing: lift the pen between them.",
            chinese_strokes() + "连写了，笔画之间要提笔。"};
  }

  RemarkWords broken() const {
    return {english_strokes() + (is_several() ? " are" : " is") + " in two pieces: draw " +
                (is_several() ? "them" : "it") + " in one go.",
            chinese_strokes() + "断成了两段，要一笔写完。"};
  }

  RemarkWords missing() const {
    const std::size_t place = place_in_character(remark_.stroke);
    return {english_strokes() + " is missing: it belongs " + (place == middle_of_box ? "in" : "at") + " the " +
                std::string(thirds[place].english) + ".",
            "缺少" + chinese_strokes() + "，它应该在" + std::string(thirds[place].chinese) + "。"};
  }

  RemarkWords extra(WritingDirection direction) const {
    const std::string english_line = "Your " + ordinal(remark_.path) + " line ";
    const std::string chinese_line = "你写的" + chinese_number(remark_.path);
    const int other = remark_.other_stroke;
    if (other < 0) {
      return {english_line + "is one too many: leave it out.", chinese_line + "是多余的，不用写。"};
    }
    if (direction == WritingDirection::backwards) {
      const RemarkWords start = start_of(other);
      return {english_line + "is stroke " + english(other) + " backwards: " + start.english + ".",
              chinese_line + "是" + chinese(other) + "，但方向反了，" + start.chinese + "。"};
    }
    if (remark_.other_path < 0) {
      return {english_line + "is not quite stroke " + english(other) + ": follow the model.",
              chinese_line + "不太像" + chinese(other) + "，请照着范字写。"};
    }
    const auto [first, second] = std::minmax(remark_.path, remark_.other_path);
    return {"Your " + ordinal(first) + " and " + ordinal(second) + " lines are both stroke " + english(other) +
                ": write it only once, in its turn.",
            "你写的" + chinese_number(first) + "和" + chinese_number(second) + "都是" + chinese(other) +
                "，按笔顺写一次就够了。"};
  }

 private:
  struct Ends {
    Place start, end;  ///< in the box of the stroke
    bool is_told;      ///< they differ, and the start is at a side
    bool is_straight;  ///< they tell how the stroke runs
  };

  bool is_several() const { return remark_.stroke_count > 1; }

  const Stroke& at(int index) const { return strokes_[static_cast<std::size_t>(index)]; }

  static std::vector<Point> middle_line_of(const Stroke& stroke) { return middle_line(stroke, {Point::Zero(), 1.0}); }

  static std::string english_number(int index) { return std::to_string(index + 1); }
  static std::string chinese_number(int index) { return "第" + std::to_string(index + 1) + "笔"; }

  /// "2 (héng)"
  std::string english(int index) const {
    return english_number(index) + " (" + std::string(at(index).type->pinyin) + ")";
  }

  /// "第2笔（横）"
  std::string chinese(int index) const {
    return chinese_number(index) + "（" + std::string(at(index).type->name) + "）";
  }

  int last() const { return remark_.stroke + remark_.stroke_count - 1; }

  std::string english_strokes() const {
    if (!is_several()) return "Stroke " + english(remark_.stroke);
    return "Strokes " + english(remark_.stroke) + (remark_.stroke_count == 2 ? " and " : " to ") + english(last());
  }

  std::string chinese_strokes() const {
    if (!is_several()) return chinese(remark_.stroke);
    return chinese(remark_.stroke) + (remark_.stroke_count == 2 ? "和" : "到") + chinese(last());
  }

  static Eigen::AlignedBox2d box_of(const std::vector<Point>& path) {
    Eigen::AlignedBox2d box;
    for (const Point& point : path) box.extend(point);
    return box;
  }

  Ends ends_of(int index) const {
    const std::vector<Point> path = middle_line_of(at(index));
    const Eigen::AlignedBox2d box = box_of(path);
    const std::size_t start = place_in(box, flat_stroke, path.front()), end = place_in(box, flat_stroke, path.back());
    return {thirds[start], thirds[end], start != end && start != middle_of_box,
            (path.front() - path.back()).norm() >= straight * path_length(path)};
  }

  /// "start at the left"
  RemarkWords start_of(int index) const {
    const Ends ends = ends_of(index);
    if (!ends.is_told) return {"start where the model starts", "请照着范字起笔"};
    return {"start at the " + std::string(ends.start.english), "从" + std::string(ends.start.chinese) + "起笔"};
  }

  /// "from the left to the right"; empty of several strokes and of one that is not straight.
  RemarkWords way_of_all() const {
    if (is_several()) return {};
    const Ends ends = ends_of(remark_.stroke);
    if (!ends.is_straight) return {};
    return {"from the " + std::string(ends.start.english) + " to the " + std::string(ends.end.english),
            "从" + std::string(ends.start.chinese) + "写到" + std::string(ends.end.chinese)};
  }

  /// Where in the character the middle of a stroke lies.
  std::size_t place_in_character(int index) const {
    Eigen::AlignedBox2d box;
    for (const Stroke& stroke : strokes_) box.extend(box_of(middle_line_of(stroke)));
    const std::vector<Point> path = middle_line_of(at(index));
    return place_in(box, flat_character, points_along(path, path_length(path), 3)[1]);
  }

  const StrokeRemark& remark_;
  const std::span<const Stroke> strokes_;
};

}  // namespace

RemarkWords words_of(const StrokeRemark& remark, std::span<const DrawnStroke> drawn, char32_t character,
                     std::span<const Stroke> strokes) {
  const Words words(remark, strokes);
  const auto path = static_cast<std::size_t>(remark.path);
  const std::string written = encode_utf8(remark.other_character), asked = encode_utf8(character);
  switch (remark.kind) {
    case StrokeRemarkKind::order:
      return words.order();
    case StrokeRemarkKind::direction:
      return words.direction();
    case StrokeRemarkKind::shape:
      return drawn[path].length < least_share ? words.part() : words.shape();
    case StrokeRemarkKind::joined:
      return words.joined();
    case StrokeRemarkKind::broken:
      return words.broken();
    case StrokeRemarkKind::missing:
      return words.missing();
    case StrokeRemarkKind::character:
      return {"This looks like " + written + ", not " + asked + ": have another look at the model.",
              "这像“" + written + "”，不像“" + asked + "”，再看看范字。"};
    case StrokeRemarkKind::lookalike:
      return {"This could be read as " + written + ": mind how " + asked + " differs.",
              "这也像“" + written + "”，注意“" + asked + "”和它的区别。"};
    case StrokeRemarkKind::extra:
      break;
  }
  return words.extra(drawn[path].direction);
}

}  // namespace calligraphy
