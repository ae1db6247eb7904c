#include "form_faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <calligraphy/base/error.hpp>

#include "judge/pens/resemblance.hpp"
#include "model/random_points.hpp"
#include "model/stroke_ends.hpp"
#include "polyline.hpp"
#include "row_named.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

using Kind = StrokeRemarkKind;

constexpr int line_points = 64;
constexpr double meeting = 0.04, corner = 0.03;        // of an end from a stroke; of a crossing that is none [em]
constexpr double crossing_tail = 0.08, lifted = 0.005;  // [em]
constexpr double least_rest = 0.1;                      // of a stroke that is cut [em]
constexpr double least_gap = 0.06, most_gap = 0.3;      // of strokes side by side [em]
constexpr double straight_bow = 0.05, long_stroke = 0.4, least_waver = 0.25, least_hook = 0.05;  // [em]
constexpr double same_image = 0.08;                     // mean distance [em]

/// A stroke as it was drawn, or as it should be.
struct Line {
  PenPath path;
  double length = 0.0, hook = 0.0;  // of the final hook; 0: none

  explicit Line(const PenPath& drawn) : path(evenly(drawn, line_points)), length(path_length(path)) {
    if (const auto start = length > 0.15 ? hook_start(path) : std::nullopt) hook = length - *start;
  }
  PenPath body() const { return hook > 0.0 ? part_of(path, 0.0, length - hook) : path; }
  bool is_straight() const { return length >= long_stroke && hook == 0.0 && bow(path) < straight_bow; }
};

std::vector<Line> lines_of(const std::vector<PenPath>& paths) {
  std::vector<Line> lines;
  for (const PenPath& path : paths) lines.emplace_back(path);
  return lines;
}

/// From the one to the other, if the one lies beside it, on one side; the mean over the points that do.
std::optional<Point> gap_between(const Line& one, const Line& other) {
  if (std::min(one.length, other.length) < least_rest || !crossings(one.path, other.path).empty()) return std::nullopt;
  Point sum = Point::Zero();
  double sides = 0.0, distances = 0.0, accord = 0.0;
  int count = 0;
  for (std::size_t i = 0; i + 1 < one.path.size(); ++i) {
    const Nearest near = nearest(one.path[i], other.path);
    if (near.along < 0.02 * other.length || near.along > 0.98 * other.length) continue;
    const auto k = std::min(static_cast<std::size_t>(near.along / other.length * (line_points - 1)),
                            other.path.size() - 2);
    const Point step = one.path[i + 1] - one.path[i], other_step = other.path[k + 1] - other.path[k];
    sum += near.point - one.path[i];
    sides += near.side * near.distance;
    distances += near.distance;
    accord += std::abs(step.normalized().dot(other_step.normalized()));
    ++count;
  }
  if (count < 0.35 * line_points || accord < 0.85 * count || std::abs(sides) < 0.95 * distances) return std::nullopt;
  if (distances < least_gap * count || distances > most_gap * count) return std::nullopt;
  return Point(sum / count);
}

/// A lower bound of the mean distance of the writing from the strokes in any order and direction.
double distance_in_any_order(const std::vector<Line>& drawn, const std::vector<Line>& own) {
  double sum = 0.0;
  for (const Line& one : drawn) {
    double least = std::numeric_limits<double>::infinity();
    for (const Line& other : own) {
      double along = 0.0, against = 0.0;
      for (std::size_t k = 0; k < one.path.size(); ++k) {
        along += (one.path[k] - other.path[k]).norm();
        against += (one.path[k] - other.path[other.path.size() - 1 - k]).norm();
      }
      least = std::min({least, along / line_points, against / line_points});
    }
    sum += least;
  }
  return sum / static_cast<double>(drawn.size());
}

void move(PenPath& path, const Point& by) {
  for (Point& point : path) point += by;
}

/// Puts one fault of form into a pen.
class Malformer {
 public:
  Malformer(const RightPen& pen, RandomPoints& random)
      : types_(strokes(pen.character)),
        paths_(in_size_of(pen.character, pen.paths)),
        drawn_(lines_of(paths_)),
        own_(lines_of(middle_lines(pen.character))),
        random_(random) {}

  std::optional<Malformed> run(const FormRow& row) {
    if (!put(row)) return std::nullopt;
    return Malformed{paths_, faulty_};
  }

 private:
  bool put(const FormRow& row) {
    switch (row.fault) {
      case FormFault::protrude:
        return protrude(row.size);
      case FormFault::uncross:
        return uncross();
      case FormFault::fall_short:
        return fall_short(row.size);
      case FormFault::collapse:
        return collapse(row.size);
      case FormFault::collapse_all:
        return collapse_all();
      case FormFault::chords:
        return straighten_all();
      case FormFault::chord:
        return straighten();
      case FormFault::arch:
        return arch(row.size);
      case FormFault::zigzag:
        return zigzag(row.size);
      case FormFault::waver:
        return waver(row.size);
      case FormFault::waver_all:
        return waver_all(row.size);
      case FormFault::displace:
        return displace(row.size);
      case FormFault::shrink_half:
        return shrink_half(row.size);
      case FormFault::drop_hook:
        return drop_hook();
      case FormFault::swap_parts:
        return swap_parts();
      case FormFault::turn:
        paths_ = lying(paths_, row.orientation);
        return is_new_image();
      case FormFault::write_twice:
        return write_twice();
      case FormFault::scribble:
        return scribble();
    }
    return false;
  }

  std::size_t count() const { return paths_.size(); }
  void replace(std::size_t stroke, PenPath path) {
    paths_[stroke] = std::move(path);
    faulty_.push_back(static_cast<int>(stroke));
  }
  template <typename Suitable>
  std::optional<std::size_t> choose(const Suitable& suitable) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < count(); ++i) {
      if (suitable(i)) found.push_back(i);
    }
    if (found.empty()) return std::nullopt;
    return found[random_.index(found.size())];
  }
  /// Pairs (i, j) of different strokes in random order.
  std::vector<std::pair<std::size_t, std::size_t>> pairs() {
    std::vector<std::pair<std::size_t, std::size_t>> all;
    for (std::size_t i = 0; i < count(); ++i) {
      for (std::size_t j = 0; j < count(); ++j) {
        if (i != j) all.emplace_back(i, j);
      }
    }
    shuffle(all, random_);
    return all;
  }

  bool has_hook(std::size_t i) const { return drawn_[i].hook > 0.0 || own_[i].hook > 0.0; }

  /// Of a pen-down that ends where the stroke begins or ends.
  PenPath from_other_end(std::size_t i, bool at_end) const {
    PenPath path = drawn_[i].path;
    if (!at_end) std::reverse(path.begin(), path.end());
    return path;
  }
  static PenPath back_again(PenPath path, bool at_end) {
    if (!at_end) std::reverse(path.begin(), path.end());
    return path;
  }

  static bool meets(const Line& one, bool at_end, const Line& other) {
    const Point& end = at_end ? one.path.back() : one.path.front();
    return nearest(end, other.path).distance <= meeting && depth(one.path, other.path) <= corner;
  }

  struct Meeting {
    std::size_t stroke;
    bool at_end;
    std::size_t other;
  };
  std::vector<Meeting> meetings() {
    std::vector<Meeting> found;
    for (const auto& [i, j] : pairs()) {
      if (std::min(drawn_[i].length, drawn_[j].length) < least_rest) continue;
      for (const bool at_end : {false, true}) {
        if (at_end && has_hook(i)) continue;
        if (meets(drawn_[i], at_end, drawn_[j]) && meets(own_[i], at_end, own_[j])) found.push_back({i, at_end, j});
      }
    }
    shuffle(found, random_);
    return found;
  }

  /// By how much the end must be prolonged to go so far beyond the other stroke.
  static std::optional<double> missing_length(const PenPath& path, const Point& direction, const PenPath& other,
                                              double beyond) {
    const double length = path_length(path);
    for (const Crossing& each : crossings(path, other)) {
      if (length - each.one <= meeting) return beyond - (length - each.one);
    }
    const PenPath ray = {path.back(), path.back() + 2.0 * meeting * direction};
    const std::vector<Crossing> ahead = crossings(ray, other);
    if (ahead.empty()) return std::nullopt;
    return beyond + ahead.front().one;
  }

  bool protrude(double beyond) {
    for (const Meeting& each : meetings()) {
      PenPath path = from_other_end(each.stroke, each.at_end);
      const double length = drawn_[each.stroke].length, last = std::min(0.06, length / 2.0);
      const Point end = path.back(), direction = (end - point_at(path, 1.0 - last / length)).normalized();
      const PenPath& other = drawn_[each.other].path;
      const auto missing = missing_length(path, direction, other, beyond);
      if (!missing) continue;
      const PenPath beyond_end = straight_line(end, end + *missing * direction);
      path.insert(path.end(), beyond_end.begin() + 1, beyond_end.end());
      if (depth(path, other) < 0.9 * beyond) continue;
      replace(each.stroke, back_again(std::move(path), each.at_end));
      return true;
    }
    return false;
  }

  bool fall_short(double by) {
    for (const Meeting& each : meetings()) {
      const double length = drawn_[each.stroke].length;
      if (length < by + least_rest) continue;
      const PenPath path = part_of(from_other_end(each.stroke, each.at_end), 0.0, length - by);
      if (nearest(path.back(), drawn_[each.other].path).distance < 0.85 * by) continue;
      replace(each.stroke, back_again(path, each.at_end));
      return true;
    }
    return false;
  }

  bool uncross() {
    for (const auto& [i, j] : pairs()) {
      const Line &one = drawn_[i], &other = drawn_[j];
      const std::vector<Crossing> found = crossings(one.path, other.path);
      if (found.size() != 1 || crossings(own_[i].path, own_[j].path).size() != 1) continue;
      if (std::min(depth(one.path, other.path), depth(own_[i].path, own_[j].path)) < crossing_tail) continue;
      const double before = found[0].one, after = one.length - before;
      const double shortest = std::min({before, after, found[0].other, other.length - found[0].other});
      const bool at_end = after < before;
      if (std::min(before, after) > shortest || (at_end && has_hook(i))) continue;  // then it is j that is cut
      replace(i, at_end ? part_of(one.path, 0.0, before - lifted) : part_of(one.path, before + lifted, one.length));
      return true;
    }
    return false;
  }

  std::optional<Point> gap(std::size_t i, std::size_t j) const {
    return gap_between(own_[i], own_[j]) ? gap_between(drawn_[i], drawn_[j]) : std::nullopt;
  }

  bool collapse(double share) {
    for (const auto& [i, j] : pairs()) {
      const auto across = gap(i, j);
      if (!across) continue;
      move(paths_[i], (1.0 - share) * *across);
      faulty_ = {static_cast<int>(i)};
      return true;
    }
    return false;
  }

  bool collapse_all() {
    for (std::size_t j = 0; j < count(); ++j) {
      std::vector<std::pair<std::size_t, Point>> beside;
      for (std::size_t i = 0; i < count(); ++i) {
        const auto across = i == j ? std::nullopt : gap(i, j);
        if (across) beside.emplace_back(i, *across);
      }
      if (beside.size() < 2) continue;
      faulty_ = {static_cast<int>(j)};
      for (const auto& [i, across] : beside) {
        move(paths_[i], across);
        faulty_.push_back(static_cast<int>(i));
      }
      return true;
    }
    return false;
  }

  double common_bow(std::size_t i) const { return std::min(bow(drawn_[i].body()), bow(own_[i].body())); }
  void make_chord(std::size_t i) { paths_[i] = straight_line(paths_[i].front(), paths_[i].back()); }

  bool straighten_all() {
    double most = 0.0;
    for (std::size_t i = 0; i < count(); ++i) {
      most = std::max(most, common_bow(i));
      make_chord(i);
    }
    return most >= 0.13;
  }
  bool straighten() {
    const auto stroke = choose([&](std::size_t i) {
      const double drawn = bow(drawn_[i].body());
      return drawn >= 0.2 && drawn <= 0.3 && common_bow(i) >= 0.15;
    });
    if (!stroke) return false;
    replace(*stroke, straight_line(paths_[*stroke].front(), paths_[*stroke].back()));
    return true;
  }

  std::optional<std::size_t> choose_straight() {
    return choose([&](std::size_t i) { return drawn_[i].is_straight() && own_[i].is_straight(); });
  }
  /// Square to the stroke, to either side.
  Point across(const PenPath& path) {
    const Point along = (path.back() - path.front()).normalized();
    return (random_.index(2) == 0 ? 1.0 : -1.0) * Point(-along.y(), along.x());
  }
  bool arch(double height) {
    const auto stroke = choose_straight();
    if (!stroke) return false;
    const PenPath& path = drawn_[*stroke].path;
    const Point up = across(path);
    PenPath arc;
    for (int k = 0; k < line_points; ++k) {
      const double share = static_cast<double>(k) / (line_points - 1);
      arc.push_back(path.front() + share * (path.back() - path.front()) + 4.0 * share * (1.0 - share) * height * up);
    }
    replace(*stroke, std::move(arc));
    return true;
  }
  bool zigzag(double amplitude) {
    constexpr int waves = 4;  // halves
    const auto stroke = choose_straight();
    if (!stroke) return false;
    const PenPath& path = drawn_[*stroke].path;
    const Point up = amplitude * across(path), piece = (path.back() - path.front()) / waves;
    PenPath corners = {path.front()};
    for (int k = 0; k < waves; ++k) {
      const Point offset = k % 2 == 0 ? up : Point(-up);
      corners.push_back(path.front() + k * piece + offset);
      corners.push_back(path.front() + (k + 1) * piece + offset);
    }
    corners.push_back(path.back());
    replace(*stroke, evenly(corners, 3 * line_points));
    return true;
  }

  PenPath wavering(const PenPath& path, double amplitude) {
    constexpr double step = 0.005;  // [em]
    const double length = path_length(path), period = random_.between(0.08, 0.2);
    const PenPath course = evenly(path, 3 + static_cast<int>(length / step));
    double phase = random_.between(0.0, 1.0);
    PenPath wave;
    for (std::size_t k = 0; k < course.size(); ++k) {
      const Point along = course[std::min(k + 4, course.size() - 1)] - course[k - std::min(k, std::size_t{4})];
      const double share = phase - std::floor(phase), height = amplitude * (4.0 * std::abs(share - 0.5) - 1.0);
      wave.push_back(course[k] + height / std::max(along.norm(), 1e-9) * Point(-along.y(), along.x()));
      phase += length / static_cast<double>(course.size() - 1) / period;
    }
    return wave;
  }
  bool can_waver(std::size_t i) const { return std::min(drawn_[i].length, own_[i].length) >= least_waver; }
  bool waver(double amplitude) {
    const auto stroke = choose([&](std::size_t i) { return can_waver(i); });
    if (!stroke) return false;
    replace(*stroke, wavering(paths_[*stroke], amplitude));
    return true;
  }
  bool waver_all(double amplitude) {
    if (!choose([&](std::size_t i) { return can_waver(i); })) return false;
    for (PenPath& path : paths_) path = wavering(path, amplitude);
    return true;
  }

  bool displace(double by) {
    if (count() < 2) return false;
    const auto stroke = static_cast<std::size_t>(random_.index(count()));
    move(paths_[stroke], by * random_.direction());
    faulty_ = {static_cast<int>(stroke)};
    return true;
  }

  bool shrink_half(double size) {
    if (count() < 4) return false;
    std::vector<std::size_t> all(count());
    std::iota(all.begin(), all.end(), 0);
    shuffle(all, random_);
    all.resize(count() / 2);
    Box box;
    for (const std::size_t i : all) box.extend(box_of(paths_[i]));
    for (const std::size_t i : all) {
      for (Point& point : paths_[i]) point = box.center() + size * (point - box.center());
      faulty_.push_back(static_cast<int>(i));
    }
    return true;
  }

  bool drop_hook() {
    const auto stroke = choose([&](std::size_t i) {
      return ends_in_hook(*types_[i].type) && std::min(drawn_[i].hook, own_[i].hook) >= least_hook;
    });
    if (!stroke) return false;
    replace(*stroke, drawn_[*stroke].body());
    return true;
  }

  bool swap_parts() {
    constexpr double apart = 0.2, most_overlap = -0.05;
    std::vector<std::size_t> cuts;
    const auto centre = [&](std::size_t from, std::size_t to) {
      return Point(box_of(std::span(paths_).subspan(from, to - from)).center());
    };
    for (std::size_t k = 2; k + 2 <= count(); ++k) {
      const Box first = box_of(std::span(paths_).first(k)), second = box_of(std::span(paths_).subspan(k));
      const double between = std::max((second.min() - first.max()).maxCoeff(), (first.min() - second.max()).maxCoeff());
      if ((centre(0, k) - centre(k, count())).norm() >= apart && between >= most_overlap) cuts.push_back(k);
    }
    if (cuts.empty()) return false;
    const std::size_t first = cuts[random_.index(cuts.size())];
    const Point between = centre(first, count()) - centre(0, first);
    for (std::size_t i = 0; i < count(); ++i) move(paths_[i], i < first ? between : Point(-between));
    return is_new_image();
  }

  bool is_new_image() const { return distance_in_any_order(lines_of(paths_), own_) >= same_image; }

  bool write_twice() {
    const Box box = box_of(paths_);
    const double size = random_.between(0.6, 1.0);
    const Point corner_beside(box.max().x() + 0.15, box.min().y());
    const std::size_t once = count();
    for (std::size_t i = 0; i < once; ++i) {
      PenPath path = paths_[i];
      for (Point& point : path) point = corner_beside + size * (point - box.min());
      paths_.push_back(std::move(path));
    }
    return once > 1;  // 二 for 一 is something else
  }

  bool scribble() {
    if (count() < 3) return false;
    const Box box = box_of(paths_);
    const auto point = [&] { return Point(box.min() + random_.point(0.0, 1.0).cwiseProduct(box.sizes())); };
    for (PenPath& path : paths_) {
      const Point a = point(), b = point(), c = point(), d = point();
      path.clear();
      for (int k = 0; k < line_points; ++k) {
        const double t = static_cast<double>(k) / (line_points - 1), s = 1.0 - t;
        path.push_back(s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d);
      }
    }
    return true;
  }

  std::vector<Stroke> types_;
  std::vector<PenPath> paths_;
  std::vector<Line> drawn_, own_;
  std::vector<int> faulty_;
  RandomPoints& random_;
};

}  // namespace

const std::vector<FormRow>& form_rows() {
  using Way = WritingOrientation;
  const std::vector<Kind> misplaced = {Kind::place, Kind::crossing, Kind::no_crossing, Kind::gap, Kind::overlap,
                                       Kind::side};
  const std::vector<Kind> ill_sized = {Kind::length, Kind::proportion, Kind::place, Kind::crossing, Kind::no_crossing,
                                       Kind::gap, Kind::overlap, Kind::side};
  static const std::vector<FormRow> all = {
      {"protrude-10", FormFault::protrude, 0.10, {Kind::crossing}},
      {"protrude-15", FormFault::protrude, 0.15, {Kind::crossing}},
      {"protrude-20", FormFault::protrude, 0.20, {Kind::crossing}},
      {"protrude-25", FormFault::protrude, 0.25, {Kind::crossing}},
      {"uncross", FormFault::uncross, 0.0, {Kind::no_crossing}},
      {"short-20", FormFault::fall_short, 0.20, {Kind::gap, Kind::length, Kind::place, Kind::shape, Kind::no_crossing}},
      {"short-30", FormFault::fall_short, 0.30, {Kind::gap, Kind::length, Kind::place, Kind::shape, Kind::no_crossing}},
      {"collapse-0", FormFault::collapse, 0.0, {Kind::overlap}},
      {"collapse-25", FormFault::collapse, 0.25, {Kind::overlap}},
      {"all-collapse", FormFault::collapse_all, 0.0, {Kind::overlap}},
      {"chords", FormFault::chords, 0.0, {Kind::straight}},
      {"chord-20-30", FormFault::chord, 0.0, {Kind::straight}},
      {"arch-25", FormFault::arch, 0.25, {Kind::bent}},
      {"zigzag-16", FormFault::zigzag, 0.16, {Kind::wavy, Kind::bent}},
      {"displaced-20", FormFault::displace, 0.20, misplaced},
      {"displaced-30", FormFault::displace, 0.30, misplaced},
      {"half-small", FormFault::shrink_half, 0.6, ill_sized},
      {"hook-left-out", FormFault::drop_hook, 0.0, {Kind::hook}},
      {"parts", FormFault::swap_parts, 0.0, {Kind::parts}},
      {"mirrored", FormFault::turn, 0.0, {Kind::orientation}, Way::mirrored},
      {"upside-down", FormFault::turn, 0.0, {Kind::orientation}, Way::upside_down},
      {"turned-left", FormFault::turn, 0.0, {Kind::orientation}, Way::turned_left},
      {"turned-right", FormFault::turn, 0.0, {Kind::orientation}, Way::turned_right},
      {"turned-half", FormFault::turn, 0.0, {Kind::orientation}, Way::half_turned},
      {"twice", FormFault::write_twice, 0.0, {Kind::several}},
      {"scribble", FormFault::scribble, 0.0, {Kind::unreadable}},
      {"waver-5", FormFault::waver, 0.05, {Kind::wavy}},
      {"all-waver-5", FormFault::waver_all, 0.05, {Kind::wavy}},
  };
  return all;
}

const FormRow& form_row_named(const std::string& name) { return row_named(form_rows(), name); }

std::optional<Malformed> malform(const RightPen& pen, const FormRow& row, std::uint64_t seed) {
  RandomPoints random(seed);
  return Malformer(pen, random).run(row);
}

std::vector<PenPath> in_size_of(const Character& character, const std::vector<PenPath>& paths) {
  const Box from = box_of(paths), to = box_of(middle_lines(character));
  const double scale = from.sizes().maxCoeff() > 0.0 ? to.sizes().maxCoeff() / from.sizes().maxCoeff() : 1.0;
  std::vector<PenPath> moved = paths;
  for (PenPath& path : moved) {
    for (Point& point : path) point = to.center() + scale * (point - from.center());
  }
  return moved;
}

std::vector<PenPath> lying(const std::vector<PenPath>& paths, WritingOrientation orientation) {
  Eigen::Matrix2d mirror, left;
  mirror << -1.0, 0.0, 0.0, 1.0;
  left << 0.0, -1.0, 1.0, 0.0;
  Eigen::Matrix2d map = Eigen::Matrix2d::Identity();
  switch (orientation) {
    case WritingOrientation::upright:
      break;
    case WritingOrientation::mirrored:
      map = mirror;
      break;
    case WritingOrientation::upside_down:
      map = -mirror;
      break;
    case WritingOrientation::half_turned:
      map = -map;
      break;
    case WritingOrientation::turned_left:
      map = left;
      break;
    case WritingOrientation::turned_right:
      map = -left;
      break;
    case WritingOrientation::mirrored_left:
      map = left * mirror;
      break;
    case WritingOrientation::mirrored_right:
      map = -left * mirror;
      break;
  }
  const Point centre = box_of(paths).center();
  std::vector<PenPath> moved = paths;
  for (PenPath& path : moved) {
    for (Point& point : path) point = centre + map * (point - centre);
  }
  return moved;
}

}  // namespace calligraphy_test
