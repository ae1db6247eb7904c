#include "stroke_remarks.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <Eigen/LU>

#include "judge/judge_constants.hpp"
#include "judge/pens/resemblance.hpp"
#include "judge/pens/writing_box.hpp"
#include "judge/reading/writing_order.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

class Remarks {
 public:
  Remarks(const Character& character, std::span<const PenPath> paths, std::span<const DrawnStroke> drawn,
          const AffineMap& fit, const RemarkEvidence& evidence)
      : strokes_(strokes(character)),
        paths_(paths),
        drawn_(drawn),
        fit_(fit),
        evidence_(evidence),
        order_(find_order(drawn)) {
    for (int path = 0; path < static_cast<int>(drawn.size()); ++path) {
      if (at(path).stroke >= 0 && !at(path).continues) written_.push_back(path);
    }
  }

  std::vector<StrokeRemark> run(const std::optional<OtherCharacter>& other) {
    if (other) tell_other(*other);
    if (other && !other->is_lookalike) return std::move(remarks_);
    for (int path = 0; path < static_cast<int>(drawn_.size()); ++path) tell(path);
    std::vector<bool> is_written(strokes_.size(), false);
    for (const int path : written_) {
      std::fill_n(is_written.begin() + at(path).stroke, at(path).stroke_count, true);
    }
    for (int stroke = 0; stroke < static_cast<int>(strokes_.size()); ++stroke) {
      if (is_written[static_cast<std::size_t>(stroke)]) continue;
      add({.kind = StrokeRemarkKind::missing,
           .stroke = stroke,
           .stroke_count = 1,
           .place = place_of_stroke(stroke),
           .evidence = length_of_stroke(stroke) / tap_length});
    }
    return std::move(remarks_);
  }

 private:
  const DrawnStroke& at(int path) const { return drawn_[static_cast<std::size_t>(path)]; }

  void add(const StrokeRemark& remark) {
    if (remark.evidence >= evidence_.least) remarks_.push_back(remark);
  }

  void tell_other(const OtherCharacter& other) {
    add({.kind = other.is_lookalike ? StrokeRemarkKind::lookalike : StrokeRemarkKind::character,
         .path = 0,
         .path_count = static_cast<int>(paths_.size()),
         .other_character = other.code,
         .place = box_of_all(paths_).center()});
  }

  void tell(int path) {
    const DrawnStroke& drawn = at(path);
    if (drawn.stroke < 0) {
      if (!drawn.tap) tell_extra(path);  // a tap is a pen that bounced
      return;
    }
    if (drawn.continues) return;
    for (const Exchange& exchange : order_.exchanges) {
      if (exchange.path == path) tell_exchange(exchange);
    }
    for (const MovedStrokes& moved : order_.moved) {
      if (moved.path == path) tell_moved(moved);
    }
    const bool goes_on = path + 1 < static_cast<int>(drawn_.size()) && at(path + 1).continues;
    const auto tell_of_stroke = [&](StrokeRemarkKind kind, double evidence) {
      add({.kind = kind,
           .path = path,
           .path_count = goes_on ? 2 : 1,
           .stroke = drawn.stroke,
           .stroke_count = drawn.stroke_count,
           .place = place_of_path(path),
           .evidence = evidence,
           .length = drawn.length,
           .direction = drawn.direction});
    };
    if (goes_on) {
      tell_of_stroke(StrokeRemarkKind::broken, std::max(1.0, shorter_share(path) / judge_constants.sure_part));
    }
    if (drawn.stroke_count > 1) tell_of_stroke(StrokeRemarkKind::joined, 0.5 * drawn.stroke_count);
    if (drawn.direction == WritingDirection::backwards) {
      tell_of_stroke(StrokeRemarkKind::direction, drawn.evidence);
    } else if (drawn.direction != WritingDirection::unknown) {
      tell_of_stroke(StrokeRemarkKind::shape, drawn.evidence);
    }
  }

  void tell_extra(int path) {
    StrokeRemark remark{.kind = StrokeRemarkKind::extra,
                        .path = path,
                        .path_count = 1,
                        .other_stroke = at(path).attempt,
                        .place = place_of_path(path),
                        .evidence = path_length(fitted(path)) / tap_length,
                        .direction = at(path).direction};
    for (const int other : written_) {
      const int beyond = remark.other_stroke - at(other).stroke;
      if (0 <= beyond && beyond < at(other).stroke_count) remark.other_path = other;
    }
    add(remark);
  }

  void tell_exchange(const Exchange& exchange) {
    add({.kind = StrokeRemarkKind::order,
         .path = exchange.path,
         .path_count = 1,
         .stroke = at(exchange.path).stroke,
         .stroke_count = at(exchange.path).stroke_count,
         .other_path = exchange.other_path,
         .other_stroke = at(exchange.other_path).stroke,
         .place = place_of_path(exchange.path),
         .evidence = evidence_.order});
  }

  void tell_moved(const MovedStrokes& moved) {
    const int due = due_at(moved.path);
    add({.kind = StrokeRemarkKind::order,
         .path = moved.path,
         .path_count = (order_.is_reversed ? written_.back() : moved.last_path) - moved.path + 1,
         .stroke = moved.stroke,
         .stroke_count = moved.stroke_count,
         .other_stroke = order_.is_reversed ? -1 : (moved.stroke > due ? due : last_before(moved.path)),
         .place = place_of_path(moved.path),
         .evidence = evidence_.order});
  }

  /// The first stroke that was still to be written when a pen-down began, of those that were written at all; strokes
  /// that changed places are told by themselves.
  int due_at(int path) const {
    int due = static_cast<int>(strokes_.size());
    for (const int other : written_) {
      if (other >= path && !order_.has_changed_places(other)) due = std::min(due, at(other).stroke);
    }
    return due;
  }

  /// The last stroke of those written before a pen-down.
  int last_before(int path) const {
    int last = 0;
    for (const int other : written_) {
      if (other >= path || order_.has_changed_places(other)) continue;
      last = std::max(last, at(other).stroke + at(other).stroke_count - 1);
    }
    return last;
  }

  Point place_of_path(int path) const {
    const PenPath& drawn = paths_[static_cast<std::size_t>(path)];
    return points_along(drawn, path_length(drawn), 3)[1];
  }

  /// A pen-down, laid on the character.
  PenPath fitted(int path) const {
    PenPath laid = paths_[static_cast<std::size_t>(path)];
    for (Point& point : laid) point = fit_(point);
    return laid;
  }

  /// Of a stroke that a pen-down and the next one wrote, the share of the shorter one.
  double shorter_share(int path) const {
    const double one = path_length(paths_[static_cast<std::size_t>(path)]);
    const double other = path_length(paths_[static_cast<std::size_t>(path) + 1]);
    return std::min(one, other) / std::max(one + other, 1e-300);
  }

  double length_of_stroke(int stroke) const {
    return path_length(middle_line(strokes_[static_cast<std::size_t>(stroke)], {Point::Zero(), 1.0}));
  }

  Point place_of_stroke(int stroke) const {
    const std::vector<Point> line = middle_line(strokes_[static_cast<std::size_t>(stroke)], {Point::Zero(), 1.0});
    return fit_.linear.inverse() * (points_along(line, path_length(line), 3)[1] - fit_.offset);
  }

  const std::vector<Stroke> strokes_;
  const std::span<const PenPath> paths_;
  const std::span<const DrawnStroke> drawn_;
  const AffineMap& fit_;
  const RemarkEvidence evidence_;
  const WritingOrder order_;
  std::vector<int> written_;  ///< pen-downs that wrote something, without the second parts of broken strokes
  std::vector<StrokeRemark> remarks_;
};

}  // namespace

std::vector<StrokeRemark> remarks_on(const Character& character, std::span<const PenPath> paths,
                                     std::span<const DrawnStroke> drawn, const AffineMap& fit,
                                     const RemarkEvidence& evidence, const std::optional<OtherCharacter>& other) {
  return Remarks(character, paths, drawn, fit, evidence).run(other);
}

}  // namespace calligraphy
