#include <calligraphy/practice/stroke_matching.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <calligraphy/base/error.hpp>

#include "assignment.hpp"
#include "resemblance.hpp"
#include "stroke_name.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t max_paths = 1000;
constexpr double left_over = 0.15;       // what a stroke or a pen-down without a partner costs [em]
constexpr double backwards_cost = 0.02;  // by which a stroke must fit better backwards [em]
constexpr double turned_cost = 0.05;     // of a quarter turn; twice as much of a half turn [em]
// By which another order must fit better than the right one [em]; or by the factor StrokeTolerances::distinction, which
// tells small strokes apart.
constexpr double order_doubt = 0.05;
constexpr double impossible = 1e3;        // [em]
constexpr double max_dot = 0.3;           // a tap may be a stroke up to this length [em]
constexpr double joined_distance = 0.15;  // mean distance up to which joined or broken strokes are told [em]
constexpr double joined_length = 0.6;     // of the strokes that a pen-down joined, that it is long at least
constexpr double joined_share = 0.75;     // of the distance from one of them alone, at most
constexpr std::size_t max_joined = 5;     // strokes without lifting the pen
constexpr double broken_gap = 0.25;       // between the parts of a broken stroke, of its length
constexpr double opposite_way = 0.7;      // against the reversed stroke, from which it runs backwards: 45 degrees
constexpr int max_refits = 6;
constexpr double shape_stiffness = 0.1;  // spread of a shape [em] below which it says little of how it is stretched
constexpr double min_stretch = 0.6, max_stretch = 1.0 / min_stretch;
constexpr double better = 1e-6;  // by which a refit must be [em]

/// What one pen-down wrote: `count` strokes from `first` on.
struct Match {
  std::size_t first = 0;
  std::size_t count = 0;
  double cost = 0.0;
  bool backwards = false;
  bool continues = false;
};

/// Every pen-down's match, how they were laid on the strokes, and what it costs in all.
struct Reading {
  std::vector<Match> matches;
  BoxMap fit;
  double cost = 0.0;
};

class Judge {
 public:
  Judge(const Character& character, std::span<const PenPath> paths, const StrokeTolerances& tolerances)
      : character_(character),
        strokes_(strokes(character)),
        paths_(paths),
        same_way_(std::cos(tolerances.direction)),
        distinction_(tolerances.distinction) {
    for (const Stroke& stroke : strokes_) {
      lines_.push_back(middle_line(stroke, {Point::Zero(), 1.0}));
      lengths_.push_back(path_length(lines_.back()));
      outlines_.push_back(outline(lines_.back()));
    }
  }

  MatchResult run() {
    best_ = read(&Judge::match_in_order);
    const Reading free = read(&Judge::match_freely);
    if (is_believed(free, best_)) best_ = free;
    place(best_.fit);
    prefer_corrections();
    tell_drawn();
    tell_order();
    tell_rest();
    return std::move(result_);
  }

 private:
  using Rule = std::vector<Match> (Judge::*)() const;

  /// By a rule, from the paths as they are and from their box; in doubt the pen was where the character is.
  Reading read(Rule rule) {
    const Reading here = refine(rule, BoxMap());
    const Reading boxed = refine(rule, fit_box(paths_, character_));
    return boxed.cost < here.cost - order_doubt ? boxed : here;
  }

  /// From a first guess of how the paths lie, better and better.
  Reading refine(Rule rule, const BoxMap& guess) {
    Reading reading = match(rule, guess);
    for (int i = 0; i < max_refits; ++i) {
      const Reading next = match(rule, refit(reading, guess));
      if (next.cost >= reading.cost - better) break;
      reading = next;
    }
    return reading;
  }

  Reading match(Rule rule, const BoxMap& fit) {
    place(fit);
    Reading reading{(this->*rule)(), fit, 0.0};
    reading.cost = cost_where(reading, [](std::size_t) { return true; });
    return reading;
  }

  void place(const BoxMap& fit) {
    placed_.clear();
    placed_lengths_.clear();
    drawn_.clear();
    for (const PenPath& path : paths_) {
      PenPath& moved = placed_.emplace_back();
      for (const Point& point : path) moved.push_back(fit(point));
      placed_lengths_.push_back(path_length(moved));
      drawn_.push_back(outline(moved, placed_lengths_.back()));
    }
    singles_.assign(paths_.size(), {});
    for (std::size_t path = 0; path < paths_.size(); ++path) {
      for (std::size_t stroke = 0; stroke < strokes_.size(); ++stroke) {
        singles_[path].push_back(compare(drawn_[path], placed_lengths_[path], stroke, 1));
      }
    }
  }

  bool is_tap(std::size_t path) const { return placed_lengths_[path] < tap_length; }

  /// What the pen-downs that are chosen cost, and the strokes that none of them and no other wrote.
  template <typename Chosen>
  double cost_where(const Reading& reading, Chosen chosen) const {
    double sum = 0.0;
    for (std::size_t path = 0; path < reading.matches.size(); ++path) {
      const Match& match = reading.matches[path];
      if (!chosen(path)) continue;
      sum += match.count > 0 ? match.cost : is_tap(path) ? 0.0 : left_over;
    }
    const std::vector<bool> done = written(reading.matches);
    return sum + left_over * static_cast<double>(std::count(done.begin(), done.end(), false));
  }

  std::vector<bool> written(const std::vector<Match>& matches) const {
    std::vector<bool> result(strokes_.size(), false);
    for (const Match& match : matches) {
      std::fill_n(result.begin() + static_cast<std::ptrdiff_t>(match.first), match.count, true);
    }
    return result;
  }

  /// Whether another order than the right one fits so much better where they differ that it must be what was written.
  bool is_believed(const Reading& free, const Reading& in_order) const {
    const auto differs = [&](std::size_t path) {
      const Match &one = free.matches[path], &other = in_order.matches[path];
      return one.first != other.first || one.count != other.count || one.continues != other.continues;
    };
    return is_clearly_more(cost_where(in_order, differs), cost_where(free, differs));
  }

  bool is_clearly_more(double cost, double other) const {
    return cost >= other + order_doubt || (cost > other && cost >= distinction_ * other);
  }

  /// An outline against `count` strokes one after the other, with the ways between them.
  Match compare(const Outline& drawn, double length, std::size_t first, std::size_t count) const {
    Match match{first, count, impossible, false, false};
    if (length < tap_length && written_length(first, count) > max_dot) return match;
    const Outline wanted = wanted_outline(first, count);
    const double forwards = distance(drawn, wanted);
    const double backwards = distance(drawn, reversed(wanted)) + backwards_cost;
    match.cost = std::min(forwards, backwards);
    match.backwards = backwards < forwards;
    return match;
  }

  /// Among small strokes close to each other how a pen-down runs tells more than where it is.
  static double distance(const Outline& drawn, const Outline& wanted) {
    return mean_distance(drawn, wanted) + turned_cost * (1.0 - accord(drawn, wanted));
  }

  double written_length(std::size_t first, std::size_t count) const {
    double length = 0.0;
    for (std::size_t stroke = first; stroke < first + count; ++stroke) length += lengths_[stroke];
    return length;
  }

  Outline wanted_outline(std::size_t first, std::size_t count) const {
    if (count == 1) return outlines_[first];
    std::vector<Point> line;
    for (std::size_t stroke = first; stroke < first + count; ++stroke) {
      line.insert(line.end(), lines_[stroke].begin(), lines_[stroke].end());
    }
    return outline(line);
  }

  /// The pen-down as strokes written without lifting the pen, if it resembles all of them, and none of them by itself.
  std::optional<Match> joined(std::size_t path, std::size_t first, std::size_t count) const {
    const double length = placed_lengths_[path];
    if (length < joined_length * written_length(first, count)) return std::nullopt;
    double alone = impossible;
    for (std::size_t stroke = first; stroke < first + count; ++stroke) {
      alone = std::min(alone, singles_[path][stroke].cost);
    }
    const Match match = compare(drawn_[path], length, first, count);
    if (match.cost > std::min(joined_distance, joined_share * alone)) return std::nullopt;
    return match;
  }

  /// The pen-down and the next one as one stroke, if the second goes on where the first ended and both together
  /// resemble it more than either.
  std::optional<Match> broken(std::size_t path, std::size_t stroke) const {
    if (is_tap(path) || is_tap(path + 1)) return std::nullopt;
    const double gap = (placed_[path + 1].front() - placed_[path].back()).norm();
    if (gap > broken_gap * lengths_[stroke]) return std::nullopt;
    const PenPath both = together(path);
    const Match match = compare(outline(both), path_length(both), stroke, 1);
    const double alone = std::min(singles_[path][stroke].cost, singles_[path + 1][stroke].cost);
    if (match.cost > joined_distance || match.cost >= alone) return std::nullopt;
    return match;
  }

  PenPath together(std::size_t path) const {
    PenPath both = placed_[path];
    both.insert(both.end(), placed_[path + 1].begin(), placed_[path + 1].end());
    return both;
  }

  static void set_broken(std::vector<Match>& matches, std::size_t path, const Match& match) {
    matches[path] = matches[path + 1] = match;
    matches[path + 1].continues = true;
    matches[path + 1].cost = 0.0;
  }

  /// The cheapest reading in which strokes follow each other as they should: pen-downs and strokes side by side, as the
  /// letters of two words are compared (Needleman and Wunsch 1970).
  std::vector<Match> match_in_order() const {
    struct Step {
      double cost = std::numeric_limits<double>::infinity();
      std::size_t paths = 0, strokes = 0;  ///< taken by the step that led here
      Match match;
    };
    const std::size_t paths = paths_.size(), count = strokes_.size();
    std::vector<std::vector<Step>> best(paths + 1, std::vector<Step>(count + 1));
    best[0][0].cost = 0.0;
    for (std::size_t path = 0; path <= paths; ++path) {
      for (std::size_t stroke = 0; stroke <= count; ++stroke) {
        const double before = best[path][stroke].cost;
        const auto reach = [&](std::size_t more_paths, std::size_t more_strokes, double cost, const Match& match) {
          Step& step = best[path + more_paths][stroke + more_strokes];
          if (before + cost < step.cost) step = {before + cost, more_paths, more_strokes, match};
        };
        if (path < paths) reach(1, 0, is_tap(path) ? 0.0 : left_over, {});
        if (stroke < count) reach(0, 1, left_over, {});
        if (path == paths || stroke == count) continue;
        reach(1, 1, singles_[path][stroke].cost, singles_[path][stroke]);
        for (std::size_t more = 2; more <= std::min(max_joined, count - stroke); ++more) {
          if (const auto match = joined(path, stroke, more)) reach(1, more, match->cost, *match);
        }
        if (path + 1 == paths) continue;
        if (const auto match = broken(path, stroke)) reach(2, 1, match->cost, *match);
      }
    }
    std::vector<Match> matches(paths);
    for (std::size_t path = paths, stroke = count; path > 0 || stroke > 0;) {
      const Step& step = best[path][stroke];
      path -= step.paths;
      stroke -= step.strokes;
      if (step.paths == 1) matches[path] = step.match;
      if (step.paths == 2) set_broken(matches, path, step.match);
    }
    return matches;
  }

  /// The cheapest of all, in whatever order; strokes and pen-downs left over are then joined with their neighbours.
  std::vector<Match> match_freely() const {
    std::vector<std::vector<double>> costs(strokes_.size());
    for (std::size_t stroke = 0; stroke < strokes_.size(); ++stroke) {
      for (const auto& singles : singles_) costs[stroke].push_back(singles[stroke].cost);
    }
    const auto owners = assign(costs, paths_.size(), left_over);
    std::vector<Match> matches(paths_.size());
    for (std::size_t stroke = 0; stroke < strokes_.size(); ++stroke) {
      if (owners[stroke]) matches[*owners[stroke]] = singles_[*owners[stroke]][stroke];
    }
    prefer_order(matches);
    join(matches);
    mend(matches);
    return matches;
  }

  /// Strokes that are much alike are taken in the order in which they should come.
  void prefer_order(std::vector<Match>& matches) const {
    for (std::size_t later = 1; later < matches.size(); ++later) {
      for (std::size_t earlier = later; earlier-- > 0;) {
        Match &one = matches[earlier], &other = matches[later];
        if (one.count == 0 || other.count == 0 || one.first < other.first) continue;
        const Match swapped = singles_[earlier][other.first], back = singles_[later][one.first];
        if (is_clearly_more(swapped.cost + back.cost, one.cost + other.cost)) continue;
        one = swapped;
        other = back;
      }
    }
  }

  /// Gives strokes that are left over to the pen-down that wrote their neighbour, where it joined them.
  void join(std::vector<Match>& matches) const {
    for (bool found = true; found;) {
      found = false;
      const std::vector<bool> taken = written(matches);
      for (std::size_t path = 0; path < matches.size() && !found; ++path) {
        found = join_one_more(matches[path], path, taken);
      }
    }
  }

  /// One stroke more, before or behind; to a pen-down without one, two that follow each other.
  bool join_one_more(Match& match, std::size_t path, const std::vector<bool>& taken) const {
    const auto take = [&](std::size_t first, std::size_t count) {
      const auto longer = joined(path, first, count);
      const double before = match.count > 0 ? match.cost + left_over : 3.0 * left_over;
      if (!longer || longer->cost >= before) return false;
      match = *longer;
      return true;
    };
    if (match.count == 0) {
      for (std::size_t first = 0; first + 1 < taken.size(); ++first) {
        if (!taken[first] && !taken[first + 1] && take(first, 2)) return true;
      }
      return false;
    }
    const std::size_t end = match.first + match.count;
    if (match.count >= max_joined) return false;
    if (match.first > 0 && !taken[match.first - 1] && take(match.first - 1, match.count + 1)) return true;
    return end < taken.size() && !taken[end] && take(match.first, match.count + 1);
  }

  /// Gives a pen-down that is left over to the stroke of the one beside it, where both are parts of it.
  void mend(std::vector<Match>& matches) const {
    for (std::size_t path = 0; path + 1 < matches.size(); ++path) {
      const Match &one = matches[path], &other = matches[path + 1];
      if ((one.count == 0) == (other.count == 0) || one.continues || one.count + other.count != 1) continue;
      const auto whole = broken(path, one.count > 0 ? one.first : other.first);
      if (whole) set_broken(matches, path, *whole);
    }
  }

  /// The map of the paths as they came that lays them on what they wrote, by least squares along each axis. Shapes that
  /// hardly extend along an axis say little of its stretch.
  BoxMap refit(const Reading& reading, const BoxMap& guess) const {
    Point from_mean = Point::Zero(), to_mean = Point::Zero();
    std::vector<std::pair<Point, Point>> pairs;
    for (std::size_t path = 0; path < paths_.size(); ++path) {
      const Match& match = reading.matches[path];
      const bool part = match.continues || goes_on(reading.matches, path);
      if (match.count == 0 || part || match.cost > left_over || is_tap(path)) continue;
      const Outline drawn = outline(paths_[path]);
      const Outline wanted = wanted_outline(match.first, match.count);
      const Outline along = match.backwards ? reversed(wanted) : wanted;
      for (std::size_t k = 0; k < drawn.size(); ++k) {
        pairs.emplace_back(drawn[k], along[k]);
        from_mean += drawn[k];
        to_mean += along[k];
      }
    }
    if (pairs.empty()) return reading.fit;
    const auto count = static_cast<double>(pairs.size());
    from_mean /= count;
    to_mean /= count;
    Point square = Point::Zero(), product = Point::Zero();
    for (const auto& [from, to] : pairs) {
      square += (from - from_mean).cwiseAbs2();
      product += (from - from_mean).cwiseProduct(to - to_mean);
    }
    const double firm = count * shape_stiffness * shape_stiffness;
    BoxMap map;
    for (int axis = 0; axis < 2; ++axis) {
      const double stretch = (product[axis] + firm * guess.scale[axis]) / (square[axis] + firm);
      map.scale[axis] = std::clamp(stretch, min_stretch * guess.scale[axis], max_stretch * guess.scale[axis]);
    }
    map.offset = to_mean - map.scale.cwiseProduct(from_mean);
    return map;
  }

  /// The next pen-down goes on with the stroke that this one began.
  static bool goes_on(const std::vector<Match>& matches, std::size_t path) {
    return path + 1 < matches.size() && matches[path + 1].continues;
  }

  /// A stroke written backwards and at once again forwards, or the other way round, was written forwards; the attempt
  /// backwards is extra.
  void prefer_corrections() {
    std::vector<Match>& matches = best_.matches;
    for (std::size_t path = 0; path < matches.size(); ++path) {
      const Match& wrong = matches[path];
      if (wrong.count != 1 || !wrong.backwards || wrong.continues || goes_on(matches, path)) continue;
      const auto is_correction = [&](std::size_t other) {
        const Match& match = singles_[other][wrong.first];
        return !is_tap(other) && !match.backwards && match.cost < left_over;
      };
      const auto correction = attempt_beside(path, is_correction);
      if (!correction) continue;
      matches[*correction] = singles_[*correction][wrong.first];
      matches[path] = {};
    }
  }

  /// Of the pen-downs that wrote nothing and follow each other up to this one, or from it on, one that is wanted.
  template <typename Wanted>
  std::optional<std::size_t> attempt_beside(std::size_t path, Wanted wanted) const {
    const std::vector<Match>& matches = best_.matches;
    for (std::size_t next = path + 1; next < matches.size() && matches[next].count == 0; ++next) {
      if (wanted(next)) return next;
    }
    for (std::size_t before = path; before-- > 0 && matches[before].count == 0;) {
      if (wanted(before)) return before;
    }
    return std::nullopt;
  }

  std::string stroke_label(std::size_t stroke) const { return stroke_name(stroke, *strokes_[stroke].type); }

  void add(StrokeRemarkKind kind, std::size_t path, std::size_t stroke, std::string reason) {
    result_.remarks.push_back({kind, static_cast<int>(path), static_cast<int>(stroke), std::move(reason)});
  }

  void tell_drawn() {
    result_.fit = best_.fit;
    for (std::size_t path = 0; path < paths_.size(); ++path) {
      const Match& match = best_.matches[path];
      DrawnStroke& drawn = result_.drawn.emplace_back();
      drawn.tap = is_tap(path);
      if (match.count == 0) continue;
      drawn.stroke = static_cast<int>(match.first);
      drawn.stroke_count = static_cast<int>(match.count);
      drawn.continues = match.continues;
      drawn.direction = direction_of_path(path, match);
      const Outline wanted = wanted_outline(match.first, match.count);
      drawn.distance = mean_distance(whole_outline(path), match.backwards ? reversed(wanted) : wanted);
    }
  }

  /// Of both parts where the stroke was broken.
  Outline whole_outline(std::size_t path) const {
    if (best_.matches[path].continues) return outline(together(path - 1));
    return goes_on(best_.matches, path) ? outline(together(path)) : drawn_[path];
  }

  WritingDirection direction_of_path(std::size_t path, const Match& match) const {
    if (is_tap(path)) return WritingDirection::unknown;
    const Outline wanted = wanted_outline(match.first, match.count);
    const Outline drawn = whole_outline(path);
    const double with = accord(drawn, wanted), against = accord(drawn, reversed(wanted));
    if (with >= against) return with >= same_way_ ? WritingDirection::forwards : WritingDirection::neither;
    return against >= opposite_way ? WritingDirection::backwards : WritingDirection::neither;
  }

  /// In turn is the longest series of pen-downs whose strokes rise; of several as long, the one drawn last.
  void tell_order() {
    std::vector<std::size_t> paths;
    for (std::size_t path = 0; path < best_.matches.size(); ++path) {
      if (best_.matches[path].count > 0 && !best_.matches[path].continues) paths.push_back(path);
    }
    std::vector<std::size_t> series(paths.size(), 1);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (best_.matches[paths[j]].first < best_.matches[paths[i]].first)
          series[i] = std::max(series[i], series[j] + 1);
      }
    }
    std::size_t wanted = paths.empty() ? 0 : *std::max_element(series.begin(), series.end());
    std::size_t above = strokes_.size();
    for (std::size_t i = paths.size(); i-- > 0;) {
      const std::size_t stroke = best_.matches[paths[i]].first;
      const bool chosen = wanted > 0 && series[i] == wanted && stroke < above;
      result_.drawn[paths[i]].in_turn = chosen;
      if (!chosen) continue;
      --wanted;
      above = stroke;
    }
  }

  /// The first stroke that was still to be written when a pen-down began, of those that were written at all.
  std::size_t due_at(std::size_t path) const {
    std::vector<bool> open(strokes_.size(), false);
    for (std::size_t i = path; i < best_.matches.size(); ++i) {
      const Match& match = best_.matches[i];
      for (std::size_t stroke = match.first; stroke < match.first + match.count; ++stroke) open[stroke] = true;
    }
    return static_cast<std::size_t>(std::find(open.begin(), open.end(), true) - open.begin());
  }

  std::string order_reason(std::size_t path) const {
    const std::size_t stroke = best_.matches[path].first, due = due_at(path);
    if (stroke > due) return stroke_label(stroke) + " was written where " + stroke_label(due) + " was due";
    std::size_t last = 0;  // of the strokes written before
    for (std::size_t i = 0; i < path; ++i) {
      if (best_.matches[i].count > 0) last = std::max(last, best_.matches[i].first + best_.matches[i].count - 1);
    }
    return stroke_label(stroke) + " was written only after " + stroke_label(last);
  }

  /// Another attempt at a stroke, or nothing that is known.
  std::string extra_reason(std::size_t path) const {
    const std::vector<Match>& of_path = singles_[path];
    const auto nearest = std::min_element(of_path.begin(), of_path.end(),
                                          [](const Match& one, const Match& other) { return one.cost < other.cost; });
    if (nearest == of_path.end() || nearest->cost > left_over) return " resembles none of the strokes";
    std::string text = " is another attempt at " + stroke_label(nearest->first);
    if (nearest->backwards) text += ", backwards";
    for (std::size_t other = 0; other < best_.matches.size(); ++other) {
      const Match& match = best_.matches[other];
      const bool wrote = match.first <= nearest->first && nearest->first < match.first + match.count;
      if (wrote) return text + ", which pen-down " + std::to_string(other + 1) + " wrote";
    }
    return text;
  }

  void tell_rest() {
    for (std::size_t path = 0; path < paths_.size(); ++path) {
      const Match& match = best_.matches[path];
      const DrawnStroke& drawn = result_.drawn[path];
      const std::string pen_down = "pen-down " + std::to_string(path + 1);
      if (match.count == 0) {
        if (drawn.tap) continue;  // the pen bounced
        result_.remarks.push_back({StrokeRemarkKind::extra, static_cast<int>(path), -1, pen_down + extra_reason(path)});
        continue;
      }
      if (match.continues) {
        add(StrokeRemarkKind::broken, path, match.first,
            stroke_label(match.first) + " was written in two pen-downs, " + std::to_string(path) + " and " +
                std::to_string(path + 1));
        continue;
      }
      if (match.count > 1) {
        add(StrokeRemarkKind::joined, path, match.first,
            stroke_label(match.first) + " to " + stroke_label(match.first + match.count - 1) +
                " were written as one: connected writing, no mistake of order");
      }
      if (!drawn.in_turn) add(StrokeRemarkKind::order, path, match.first, order_reason(path));
      if (drawn.direction == WritingDirection::backwards) {
        add(StrokeRemarkKind::direction, path, match.first, stroke_label(match.first) + " was written backwards");
      }
      if (drawn.direction == WritingDirection::neither) {
        add(StrokeRemarkKind::shape, path, match.first,
            pen_down + " runs neither along " + stroke_label(match.first) +
                " nor against it: it was drawn as another shape");
      }
    }
    const std::vector<bool> done = written(best_.matches);
    for (std::size_t stroke = 0; stroke < strokes_.size(); ++stroke) {
      if (done[stroke]) continue;
      result_.remarks.push_back(missing_remark(static_cast<int>(stroke), *strokes_[stroke].type));
    }
  }

  const Character& character_;
  const std::vector<Stroke> strokes_;
  const std::span<const PenPath> paths_;   ///< as they came
  const double same_way_;                  ///< accord from which a stroke runs forwards: of straight lines, the cosine
  const double distinction_;               ///< factor by which another order must fit better
  std::vector<std::vector<Point>> lines_;  ///< of the strokes
  std::vector<double> lengths_;
  std::vector<Outline> outlines_;

  std::vector<PenPath> placed_;              ///< the paths laid on the strokes, as far as is known
  std::vector<double> placed_lengths_;       ///< of those
  std::vector<Outline> drawn_;               ///< of placed_
  std::vector<std::vector<Match>> singles_;  ///< of each path with each stroke
  Reading best_;
  MatchResult result_;
};

void require_valid(const Character& character, std::span<const PenPath> paths) {
  const std::vector<ValidationIssue> problems = validate(character);
  if (!problems.empty()) {
    throw ValueError("the character's stroke " + std::to_string(problems[0].stroke) + ": " + problems[0].what);
  }
  if (paths.size() > max_paths) {
    throw ValueError(std::to_string(paths.size()) + " pen-downs: expected at most " + std::to_string(max_paths));
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const bool finite =
        std::all_of(paths[i].begin(), paths[i].end(), [](const Point& point) { return point.allFinite(); });
    if (!paths[i].empty() && finite) continue;
    throw ValueError("pen-down " + std::to_string(i + 1) +
                     (finite ? " has no point" : " has a point that is not finite"));
  }
}

}  // namespace

const char* to_string(WritingDirection direction) noexcept {
  switch (direction) {
    case WritingDirection::forwards:
      return "forwards";
    case WritingDirection::backwards:
      return "backwards";
    case WritingDirection::neither:
      return "neither";
    case WritingDirection::unknown:
      break;
  }
  return "unknown";
}

const char* to_string(StrokeRemarkKind kind) noexcept {
  constexpr std::array names = {"order", "direction", "shape", "joined", "broken", "missing", "extra"};
  return names[static_cast<std::size_t>(kind)];
}

int MatchResult::count(StrokeRemarkKind kind) const noexcept {
  return static_cast<int>(std::count_if(remarks.begin(), remarks.end(),
                                        [kind](const StrokeRemark& remark) { return remark.kind == kind; }));
}

MatchResult match_strokes(const Character& character, std::span<const PenPath> paths,
                          const StrokeTolerances& tolerances) {
  require_valid(character, paths);
  validate(tolerances);
  std::vector<PenPath> steady;
  for (const PenPath& path : paths) steady.push_back(without_jitter(path, pen_spacing));
  return Judge(character, steady, tolerances).run();
}

}  // namespace calligraphy
