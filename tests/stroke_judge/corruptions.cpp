#include "corruptions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include <calligraphy/base/error.hpp>

#include "judge/pens/resemblance.hpp"
#include "model/random_points.hpp"
#include "polyline.hpp"
#include "row_named.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

constexpr double splittable = 0.2, turnable = 0.2, shortest_turned = 0.1;  // lengths of the shortest strokes [em]
constexpr double splittable_in_three = 0.3;  // the same [em]
constexpr double joinable = 0.1;            // distance of the ends of strokes that are joined out of turn [em]
constexpr double again = 0.03;              // displacement of a stroke that is written again [em]
constexpr double parallel_distance = 0.25;  // between centres [em]
constexpr std::size_t longest_block = 3;

constexpr std::array class_names = {"any", "dots", "hooks", "parallel"};

bool is_beside(const Box& one, const Box& other) {
  return one.min().x() < other.max().x() && other.min().x() < one.max().x() &&
         (one.center() - other.center()).norm() < parallel_distance;
}

std::vector<bool> parallel_members(const std::vector<Stroke>& all) {
  std::vector<Box> boxes;
  for (const Stroke& stroke : all) boxes.push_back(box_of(middle_line(stroke, {Point::Zero(), 1.0})));
  const auto is_heng = [&](std::size_t i) { return std::string_view(all[i].type->pinyin) == "héng"; };
  std::vector<bool> found(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (i != j && is_heng(i) && is_heng(j) && is_beside(boxes[i], boxes[j])) found[i] = true;
    }
  }
  return found;
}

bool is_member(const Stroke& stroke, StrokeClass stroke_class) {
  const std::string_view name = stroke.type->pinyin;
  if (stroke_class == StrokeClass::dots) return name == "diǎn" || name == "zuǒdiǎn";
  if (stroke_class == StrokeClass::hooks) return name.ends_with("gōu");
  return true;
}

template <typename Values>
void erase_at(Values& values, std::size_t i) {
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(i));
}

template <typename Values, typename Value>
void insert_at(Values& values, std::size_t i, Value value) {
  values.insert(values.begin() + static_cast<std::ptrdiff_t>(i), std::move(value));
}

/// Puts one fault into a pen.
class Corrupter {
 public:
  Corrupter(const RightPen& pen, StrokeClass stroke_class, RandomPoints& random)
      : paths_(pen.paths),
        member_(members(pen.character, stroke_class)),
        random_(random),
        any_(stroke_class == StrokeClass::any) {
    for (std::size_t i = 0; i < paths_.size(); ++i) truth_.written.push_back({static_cast<int>(i), 1});
  }

  std::optional<Corrupted> run(Fault fault) {
    if (fault == Fault::twice) return written_twice();
    if (!put(fault)) return std::nullopt;
    return Corrupted{paths_, {truth_}};
  }

 private:
  bool put(Fault fault) {
    switch (fault) {
      case Fault::swap:
        return swap();
      case Fault::adjacent:
        return swap_adjacent();
      case Fault::reverse:
        return reverse();
      case Fault::drop:
        return drop();
      case Fault::split:
        return split();
      case Fault::join:
        return join();
      case Fault::extra:
        return extra();
      case Fault::turned:
        return turn(turnable, std::numeric_limits<double>::infinity());
      case Fault::turned_short:
        return turn(shortest_turned, turnable);
      case Fault::block:
        return move_block();
      case Fault::join_apart:
        return join_apart();
      case Fault::split_three:
        return split_three();
      default:
        return true;
    }
  }

  /// A random index below `count` of those that are suitable; std::nullopt if none is.
  template <typename Suitable>
  std::optional<std::size_t> choose(std::size_t count, const Suitable& suitable) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < count; ++i) {
      if (suitable(i)) found.push_back(i);
    }
    if (found.empty()) return std::nullopt;
    return found[random_.index(found.size())];
  }
  std::optional<std::size_t> choose_stroke(double least = 0.0, double below = std::numeric_limits<double>::infinity()) {
    return choose(paths_.size(), [&](std::size_t i) {
      const double length = path_length(paths_[i]);
      return member_[i] && least <= length && length < below;
    });
  }
  /// The first of two neighbours of which one is of the class.
  std::optional<std::size_t> choose_neighbours() {
    return choose(paths_.size() - 1, [&](std::size_t i) { return member_[i] || member_[i + 1]; });
  }

  bool swap() {
    if (!any_) return swap_adjacent();
    if (paths_.size() < 2) return false;
    const auto one = static_cast<std::size_t>(random_.index(paths_.size()));
    const auto other = (one + 1 + static_cast<std::size_t>(random_.index(paths_.size() - 1))) % paths_.size();
    swap(std::min(one, other), std::max(one, other));
    return true;
  }
  bool swap_adjacent() {
    const auto first = choose_neighbours();
    if (first) swap(*first, *first + 1);
    return first.has_value();
  }
  void swap(std::size_t first, std::size_t last) {
    std::swap(paths_[first], paths_[last]);
    std::swap(truth_.written[first], truth_.written[last]);
    set_moved(first, last);
  }
  void set_moved(std::size_t first, std::size_t last) {
    truth_.first_moved = static_cast<int>(first);
    truth_.last_moved = static_cast<int>(last);
  }

  bool reverse() {
    const auto stroke = choose(paths_.size(), [&](std::size_t i) {
      const double length = path_length(paths_[i]);
      return member_[i] && length >= tap_length && chord(paths_[i]) >= 0.5 * length;
    });
    if (!stroke) return false;
    std::reverse(paths_[*stroke].begin(), paths_[*stroke].end());
    truth_.written[*stroke].backwards = true;
    return true;
  }

  bool drop() {
    const auto stroke = paths_.size() > 1 ? choose_stroke() : std::nullopt;  // a pen that wrote nothing is none
    if (!stroke) return false;
    erase_at(paths_, *stroke);
    erase_at(truth_.written, *stroke);
    truth_.missing.push_back(static_cast<int>(*stroke));
    return true;
  }

  bool split() {
    const auto stroke = choose_stroke(splittable);
    if (!stroke) return false;
    const auto [first, second] = cut(paths_[*stroke], random_.between(0.35, 0.65));
    paths_[*stroke] = first;
    insert_at(paths_, *stroke + 1, second);
    insert_at(truth_.written, *stroke + 1, Written{static_cast<int>(*stroke), 1, true});
    return true;
  }

  bool split_three() {
    const auto stroke = choose_stroke(splittable_in_three);
    if (!stroke) return false;
    const double second = random_.between(0.62, 0.72);
    const auto [begun, last] = cut(paths_[*stroke], second);
    const auto [first, middle] = cut(begun, random_.between(0.28, 0.38) / second);
    paths_[*stroke] = first;
    for (const PenPath& part : {last, middle}) {
      insert_at(paths_, *stroke + 1, part);
      insert_at(truth_.written, *stroke + 1, Written{static_cast<int>(*stroke), 1, true});
    }
    return true;
  }

  bool join() {
    const auto first = choose_neighbours();
    if (!first) return false;
    join(*first, *first + 1);
    truth_.written[*first].stroke_count = 2;
    return true;
  }
  void join(std::size_t one, std::size_t other) {
    PenPath& joined = paths_[one];
    const PenPath& next = paths_[other];
    const PenPath between = straight_line(joined.back(), next.front());
    joined.insert(joined.end(), between.begin() + 1, between.end());
    joined.insert(joined.end(), next.begin() + 1, next.end());
    erase_at(paths_, other);
    erase_at(truth_.written, other);
  }

  bool join_apart() {
    const std::size_t count = paths_.size();
    const auto pair = choose(count * count, [&](std::size_t i) {
      const std::size_t one = i / count, other = i % count;
      return other != one && other != one + 1 && (paths_[other].front() - paths_[one].back()).norm() <= joinable;
    });
    if (!pair) return false;
    truth_.written[*pair / count].also = static_cast<int>(*pair % count);
    join(*pair / count, *pair % count);
    return true;
  }

  bool extra() {
    const auto place = static_cast<std::size_t>(random_.index(paths_.size() + 1));
    const double length = random_.between(0.2, 0.5);
    const Box square(Point(0.0, 0.0), Point(1.0, 1.0));
    Point from, to;
    do {
      from = random_.point(0.0, 1.0);
      to = from + length * random_.direction();
    } while (!square.contains(to));
    insert_at(paths_, place, straight_line(from, to));
    insert_at(truth_.written, place, Written{});
    return true;
  }

  std::optional<Corrupted> written_twice() {
    const auto stroke = choose_stroke();
    if (!stroke) return std::nullopt;
    const Point shift = again * random_.direction();
    PenPath second = paths_[*stroke];
    for (Point& point : second) point += shift;
    insert_at(paths_, *stroke + 1, std::move(second));
    Truth first_is_extra = truth_;
    insert_at(first_is_extra.written, *stroke, Written{});
    insert_at(truth_.written, *stroke + 1, Written{});
    return Corrupted{paths_, {truth_, first_is_extra}};
  }

  bool turn(double least, double below) {
    const auto stroke = choose_stroke(least, below);
    if (!stroke) return false;
    const double sign = random_.index(2) == 0 ? 1.0 : -1.0;
    const Point centre = box_of(paths_[*stroke]).center();
    for (Point& point : paths_[*stroke]) {
      const Point from = point - centre;
      point = centre + sign * Point(-from.y(), from.x());
    }
    truth_.written[*stroke].turned = true;
    return true;
  }

  /// Two rows of strokes change places, one of which is the block.
  bool move_block() {
    if (paths_.size() < 3) return false;
    const std::size_t longest = std::min(longest_block, paths_.size() - 1);
    const std::size_t size = 2 + static_cast<std::size_t>(random_.index(longest - 1));
    const std::size_t places = paths_.size() - size + 1;
    const auto from = static_cast<std::size_t>(random_.index(places));
    const auto to = (from + 1 + static_cast<std::size_t>(random_.index(places - 1))) % places;
    const std::size_t first = std::min(from, to), end = std::max(from, to) + size;
    const std::size_t middle = from < to ? from + size : from;
    const auto rotate = [&](auto& values) {
      const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
      std::rotate(at(first), at(middle), at(end));
    };
    rotate(paths_);
    rotate(truth_.written);
    set_moved(first, end - 1);
    return true;
  }

  std::vector<PenPath> paths_;
  Truth truth_;
  std::vector<bool> member_;
  RandomPoints& random_;
  bool any_;
};

Point normal_point(RandomPoints& random) {
  const double x = random.normal();
  return {x, random.normal()};
}

void deviate(std::vector<PenPath>& paths, const Deviation& deviation, RandomPoints& random) {
  constexpr double degree = std::numbers::pi / 180.0;
  const Point centre(0.5, 0.5);
  Eigen::Matrix2d shear = Eigen::Matrix2d::Identity();
  shear(0, 1) = std::tan(degree * deviation.shear);
  const Eigen::Matrix2d map =
      deviation.scale * Eigen::Rotation2Dd(degree * deviation.rotation).toRotationMatrix() * shear;
  Point shift = Point::Zero();
  if (deviation.shift > 0.0) shift = deviation.shift * random.direction();
  for (PenPath& path : paths) {
    Point displaced = shift;
    if (deviation.displaced > 0.0) displaced += deviation.displaced * normal_point(random);
    for (Point& point : path) {
      point = centre + map * (point - centre) + displaced;
      if (deviation.jitter > 0.0) point += deviation.jitter * normal_point(random);
    }
  }
}

}  // namespace

const char* to_string(StrokeClass stroke_class) { return class_names[static_cast<std::size_t>(stroke_class)]; }

StrokeClass class_named(const std::string& name) {
  const auto found = std::find(class_names.begin(), class_names.end(), name);
  if (found == class_names.end()) throw ValueError("--class " + name + ": expected any, dots, hooks or parallel");
  return static_cast<StrokeClass>(found - class_names.begin());
}

std::vector<bool> members(const Character& character, StrokeClass stroke_class) {
  const std::vector<Stroke> all = strokes(character);
  if (stroke_class == StrokeClass::parallel) return parallel_members(all);
  std::vector<bool> found;
  for (const Stroke& stroke : all) found.push_back(is_member(stroke, stroke_class));
  return found;
}

const std::vector<Corruption>& corruptions() {
  static const std::vector<Corruption> all = {
      {"as-they-are"},
      {"shift-15", Fault::none, {.shift = 0.15}},
      {"scale-0.6", Fault::none, {.scale = 0.6}},
      {"rotation+25", Fault::none, {.rotation = 25.0}},
      {"rotation-25", Fault::none, {.rotation = -25.0}},
      {"shear+25", Fault::none, {.shear = 25.0}},
      {"shear-25", Fault::none, {.shear = -25.0}},
      {"jitter-1", Fault::none, {.jitter = 0.01}},
      {"jitter-2", Fault::none, {.jitter = 0.02}},
      {"displaced-5", Fault::none, {.displaced = 0.05}},
      {"displaced-8", Fault::none, {.displaced = 0.08}},
      {"swap", Fault::swap},
      {"adjacent", Fault::adjacent},
      {"reverse", Fault::reverse},
      {"drop", Fault::drop},
      {"split", Fault::split},
      {"join", Fault::join},
      {"extra", Fault::extra},
      {"twice", Fault::twice},
      {"turned", Fault::turned},
      {"block", Fault::block},
      {"swap,jitter-1", Fault::swap, {.jitter = 0.01}},
      {"swap,displaced-5", Fault::swap, {.displaced = 0.05}},
      {"reverse,jitter-1", Fault::reverse, {.jitter = 0.01}},
      {"reverse,displaced-5", Fault::reverse, {.displaced = 0.05}},
      {"drop,displaced-5", Fault::drop, {.displaced = 0.05}},
      {"turned-short", Fault::turned_short},
      {"join-apart", Fault::join_apart},
      {"split-3", Fault::split_three},
  };
  return all;
}

const Corruption& corruption_named(const std::string& name) { return row_named(corruptions(), name); }

std::optional<Corrupted> corrupt(const RightPen& pen, const Corruption& corruption, std::uint64_t seed,
                                 StrokeClass stroke_class) {
  RandomPoints random(seed);
  auto result = Corrupter(pen, stroke_class, random).run(corruption.fault);
  if (result && corruption.deviation != Deviation{}) deviate(result->paths, corruption.deviation, random);
  return result;
}

}  // namespace calligraphy_test
