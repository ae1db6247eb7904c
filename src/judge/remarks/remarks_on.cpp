#include "remarks_on.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <Eigen/LU>

#include "judge/judge_constants.hpp"
#include "judge/pens/pen_paths.hpp"
#include "judge/pens/resemblance.hpp"
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
    if (other) remark_on_other_character(*other);
    if (other && !other->is_lookalike) return std::move(remarks_);
    for (int path = 0; path < static_cast<int>(drawn_.size()); ++path) remark_on(path);
    std::vector<bool> is_written(strokes_.size(), false);
    for (const int path : written_) {
      std::fill_n(is_written.begin() + at(path).stroke, at(path).stroke_count, true);
      if (at(path).also >= 0) is_written[static_cast<std::size_t>(at(path).also)] = true;
    }
    for (int stroke = 0; stroke < static_cast<int>(strokes_.size()); ++stroke) {
      if (is_written[static_cast<std::size_t>(stroke)]) continue;
      add({.kind = StrokeRemarkKind::missing,
           .stroke = stroke,
           .stroke_count = 1,
           .place = place_of_stroke(stroke),
           .evidence = path_length(line_of(stroke)) / tap_length});
    }
    return std::move(remarks_);
  }

 private:
  const DrawnStroke& at(int path) const { return drawn_[static_cast<std::size_t>(path)]; }

  void add(const StrokeRemark& remark) {
    if (remark.evidence >= evidence_.least) remarks_.push_back(remark);
  }

  void remark_on_other_character(const OtherCharacter& other) {
    add({.kind = other.is_lookalike ? StrokeRemarkKind::lookalike : StrokeRemarkKind::character,
         .path = 0,
         .path_count = static_cast<int>(paths_.size()),
         .other_character = other.code,
         .place = box_of_all(paths_).center()});
  }

  void remark_on(int path) {
    const DrawnStroke& drawn = at(path);
    if (drawn.stroke < 0) {
      if (!drawn.tap) remark_on_extra(path);  // a tap is a pen that bounced
      return;
    }
    if (drawn.continues) return;
    for (const Exchange& exchange : order_.exchanges) {
      if (exchange.path == path) remark_on_exchange(exchange);
    }
    for (const MovedStrokes& moved : order_.moved) {
      if (moved.path == path) remark_on_moved(moved);
    }
    int parts = 1;
    while (path + parts < static_cast<int>(drawn_.size()) && at(path + parts).continues) ++parts;
    const auto remark_on_stroke = [&](StrokeRemarkKind kind, double evidence) {
      add({.kind = kind,
           .path = path,
           .path_count = parts,
           .stroke = drawn.stroke,
           .stroke_count = drawn.stroke_count,
           .other_stroke = kind == StrokeRemarkKind::joined ? drawn.also : -1,
           .place = place_of_path(path),
           .evidence = evidence,
           .length = drawn.length,
           .direction = drawn.direction});
    };
    if (parts > 1) {
      remark_on_stroke(StrokeRemarkKind::broken,
                       std::max(1.0, share_beside_longest(path, parts) / judge_constants.sure_part));
    }
    const int joined = drawn.stroke_count + (drawn.also >= 0 ? 1 : 0);
    if (joined > 1) remark_on_stroke(StrokeRemarkKind::joined, judge_constants.joined_evidence * joined);
    if (drawn.direction == WritingDirection::backwards) {
      remark_on_stroke(StrokeRemarkKind::direction, drawn.evidence);
    } else if (drawn.direction != WritingDirection::unknown) {
      remark_on_stroke(StrokeRemarkKind::shape, drawn.evidence);
    }
  }

  void remark_on_extra(int path) {
    StrokeRemark remark{.kind = StrokeRemarkKind::extra,
                        .path = path,
                        .path_count = 1,
                        .other_stroke = at(path).attempt,
                        .place = place_of_path(path),
                        .evidence = path_length(aligned(path)) / tap_length,
                        .direction = at(path).direction};
    for (const int other : written_) {
      const int beyond = remark.other_stroke - at(other).stroke;
      const bool is_also = remark.other_stroke >= 0 && remark.other_stroke == at(other).also;
      if (is_also || (0 <= beyond && beyond < at(other).stroke_count)) remark.other_path = other;
    }
    add(remark);
  }

  void remark_on_exchange(const Exchange& exchange) {
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

  void remark_on_moved(const MovedStrokes& moved) {
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

  /// The first stroke that was still to be written when a pen-down began, of those written at all; strokes that changed
  /// places have remarks of their own.
  int due_at(int path) const {
    int due = static_cast<int>(strokes_.size());
    for (const int other : written_) {
      if (other >= path && !order_.has_changed_places(other)) due = std::min(due, at(other).stroke);
    }
    return due;
  }

  /// The last of the strokes written before a pen-down.
  int last_before(int path) const {
    int last = 0;
    for (const int other : written_) {
      if (other >= path || order_.has_changed_places(other)) continue;
      last = std::max(last, at(other).stroke + at(other).stroke_count - 1);
    }
    return last;
  }

  Point place_of_path(int path) const { return halfway(paths_[static_cast<std::size_t>(path)]); }

  /// A pen-down, aligned with the character.
  PenPath aligned(int path) const {
    PenPath result = paths_[static_cast<std::size_t>(path)];
    for (Point& point : result) point = fit_(point);
    return result;
  }

  /// Share of all parts but the longest, of a stroke that so many pen-downs wrote.
  double share_beside_longest(int path, int parts) const {
    double longest = 0.0, all = 0.0;
    for (int part = path; part < path + parts; ++part) {
      const double length = path_length(paths_[static_cast<std::size_t>(part)]);
      longest = std::max(longest, length);
      all += length;
    }
    return (all - longest) / std::max(all, 1e-300);
  }

  std::vector<Point> line_of(int stroke) const { return middle_line(strokes_[static_cast<std::size_t>(stroke)]); }

  Point place_of_stroke(int stroke) const {
    return fit_.linear.inverse() * (halfway(line_of(stroke)) - fit_.offset);
  }

  const std::vector<Stroke> strokes_;
  const std::span<const PenPath> paths_;
  const std::span<const DrawnStroke> drawn_;
  const AffineMap& fit_;
  const RemarkEvidence evidence_;
  const WritingOrder order_;
  std::vector<int> written_;  ///< pen-downs that wrote strokes, without second parts of broken ones
  std::vector<StrokeRemark> remarks_;
};

}  // namespace

std::vector<StrokeRemark> remarks_on(const Character& character, std::span<const PenPath> paths,
                                     std::span<const DrawnStroke> drawn, const AffineMap& fit,
                                     const RemarkEvidence& evidence, const std::optional<OtherCharacter>& other) {
  return Remarks(character, paths, drawn, fit, evidence).run(other);
}

}  // namespace calligraphy
