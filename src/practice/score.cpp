#include <calligraphy/practice/score.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <calligraphy/collision/nearest_stroke_point.hpp>
#include <calligraphy/judge/dtw_distance.hpp>
#include <calligraphy/judge/pen_path.hpp>

#include "judge/judge_constants.hpp"
#include "judge/pens/resemblance.hpp"
#include "judge/pens/stroke_alignment.hpp"
#include "judge/unfinished_character.hpp"
#include "pen_down.hpp"
#include "recorded_page.hpp"

namespace calligraphy {
namespace {

constexpr double contour_tolerance = 0.05;  // error at which the contour score has fallen to 1/e [em]
constexpr double sensor_noise = 1e-4;       // points of a resting pen are closer together than this [m]
constexpr std::size_t line_points = 101;    // per stroke: resolves its coverage to 1 %

/// Error accumulated along a path.
struct PathError {
  double length = 0.0, square = 0.0, largest = 0.0;

  /// Adds a step with these errors at its two ends.
  void add(double from, double to, double step) {
    length += step;
    square += 0.5 * (from * from + to * to) * step;
    largest = std::max({largest, from, to});
  }
  void add(const PathError& other) {
    length += other.length;
    square += other.square;
    largest = std::max(largest, other.largest);
  }
  double rms() const { return length > 0.0 ? std::sqrt(square / length) : largest; }
};

double distance_to_segment(const Point& point, const Point& from, const Point& to) {
  const Point way = to - from;
  const double square = way.squaredNorm();
  const double share = square > 0.0 ? std::clamp((point - from).dot(way) / square, 0.0, 1.0) : 0.0;
  return (from + share * way - point).norm();
}

double distance_to_path(const Point& point, const std::vector<Point>& path) {
  double nearest = (path.front() - point).norm();
  for (std::size_t i = 1; i < path.size(); ++i) {
    nearest = std::min(nearest, distance_to_segment(point, path[i - 1], path[i]));
  }
  return nearest;
}

/// A stroke of the page, prepared for measuring.
struct Template {
  std::vector<StrokeElement> elements;
  std::vector<Point> fine;  ///< middle line, corners included [m]
  double length;            ///< [m]
  std::vector<Point> line;  ///< the same at even steps [m]

  Template(const Stroke& stroke, const Placement& placement)
      : elements(place_elements(stroke, placement)),
        fine(middle_line(stroke, placement)),
        length(path_length(fine)),
        line(points_along(fine, length, line_points)) {}

  std::vector<StrokePoint> nearest_to(std::span<const Point> tips) const {
    std::vector<StrokePoint> nearest(tips.size());
    nearest_points(elements, tips, nearest);
    return nearest;
  }
};

/// Part of a joined line that is one stroke, between these shares of the line's length.
struct LinePart {
  std::size_t stroke;
  double from, to;
};

struct JoinedLine {
  std::vector<Point> points;
  std::vector<LinePart> parts;
};

/// Part of a stroke, between these shares of its length.
struct Interval {
  double from, to;
};

/// Share of [0, 1] that intervals cover together.
double covered(std::vector<Interval> parts) {
  std::sort(parts.begin(), parts.end(), [](const auto& one, const auto& other) { return one.from < other.from; });
  double sum = 0.0, reached = 0.0;
  for (const Interval& part : parts) {
    sum += std::max(0.0, part.to - std::max(part.from, reached));
    reached = std::max(reached, part.to);
  }
  return sum;
}

/// What was written of a stroke.
struct Written {
  std::vector<std::size_t> paths;  ///< the pen-downs
  std::vector<Interval> parts;     ///< parts of the stroke that they follow
  std::vector<Point> points;       ///< points of the pen along it [m]
  bool backwards = false;
  PathError error;  ///< error of these points
};

double mean_pressure(std::span<const PenDown> downs) {
  double sum = 0.0, count = 0.0;
  for (const PenDown& down : downs) {
    sum += down.pressed;
    count += static_cast<double>(down.samples.size());
  }
  return sum > 0.0 ? sum / count : not_measured;
}

class CharacterScorer {
 public:
  CharacterScorer(const PlacedCharacter& placed, std::vector<PenDown> downs, const JudgeTolerances& tolerances)
      : placement_(placed.placement), downs_(std::move(downs)) {
    for (const Stroke& stroke : strokes(placed.character)) templates_.emplace_back(stroke, placement_);
    result_.character = placed.character.code;
    result_.stroke_count = placed.character.stroke_count();
    result_.strokes.resize(templates_.size());
    std::vector<PenPath> paths;
    const double least = detail::judge_constants.pen_spacing;
    const double spacing = std::max(least, std::min(sensor_noise / placement_.em, 4.0 * least)) * placement_.em;
    for (const PenDown& down : downs_) {
      std::vector<Point> all;
      for (const TimedPoint& sample : down.samples) all.push_back(sample.point);
      paths_.push_back(without_jitter(all, spacing));
      PenPath& path = paths.emplace_back();
      for (const Point& point : paths_.back()) path.push_back((point - placement_.origin) / placement_.em);
      result_.pen_downs.push_back({pen_kinematics(down.samples), mean_pressure({&down, 1})});
    }
    const bool is_finished = paths.empty() || (downs_.back().lifted && paths.size() >= templates_.size());
    result_.match = is_finished ? match_strokes(placed.character, paths, tolerances)
                                : match_unfinished(placed.character, paths, tolerances);
  }

  CharacterScore run() {
    std::vector<PenKinematics> motions;
    for (const PenDownScore& down : result_.pen_downs) motions.push_back(down.motion);
    result_.motion = writing_motion(motions);
    result_.mean_pressure = mean_pressure(downs_);
    written_.resize(templates_.size());
    for (std::size_t path = 0; path < downs_.size(); ++path) read(path);
    combine();
    return std::move(result_);
  }

 private:
  /// Measures what a pen-down wrote.
  void read(std::size_t path) {
    const DrawnStroke& drawn = result_.match.drawn[path];
    if (drawn.stroke < 0) return;
    const std::vector<Point>& points = paths_[path];
    const bool backwards = drawn.direction == WritingDirection::backwards;
    const JoinedLine line = join(drawn, backwards);
    const Alignment whole = align(points, points_along(line.points, path_length(line.points), line.points.size()));
    for (const LinePart& part : line.parts) {
      Written& written = written_[part.stroke];
      if (!add_points(points, whole, part, written)) continue;
      written.paths.push_back(path);
      written.backwards = backwards;
      const double share = part.to - part.from;
      const double from = std::clamp((whole.begin - part.from) / share, 0.0, 1.0);
      const double to = std::clamp((whole.end - part.from) / share, 0.0, 1.0);
      written.parts.push_back(backwards ? Interval{1.0 - to, 1.0 - from} : Interval{from, to});
    }
  }

  /// The strokes that a pen-down wrote, joined by straight lines.
  JoinedLine join(const DrawnStroke& drawn, bool from_the_end) const {
    std::vector<int> strokes;
    for (int k = 0; k < drawn.stroke_count; ++k) strokes.push_back(drawn.stroke + k);
    if (drawn.also >= 0) strokes.push_back(drawn.also);
    if (from_the_end) std::reverse(strokes.begin(), strokes.end());
    JoinedLine line;
    double length = 0.0;
    for (const int next : strokes) {
      const auto stroke = static_cast<std::size_t>(next);
      std::vector<Point> points = templates_[stroke].line;
      if (from_the_end) std::reverse(points.begin(), points.end());
      if (!line.points.empty()) length += (points.front() - line.points.back()).norm();
      line.points.insert(line.points.end(), points.begin(), points.end());
      line.parts.push_back({stroke, length, length + path_length(points)});
      length = line.parts.back().to;
    }
    for (LinePart& part : line.parts) {
      part.from = length > 0.0 ? part.from / length : 0.0;
      part.to = length > 0.0 ? part.to / length : 1.0;
    }
    return line;
  }

  /// Adds the points that lie along a part of the line. Returns whether there are any.
  bool add_points(const std::vector<Point>& points, const Alignment& whole, const LinePart& part, Written& written) {
    std::vector<std::size_t> along;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (part.from <= whole.places[i] && whole.places[i] <= part.to) along.push_back(i);
    }
    for (const std::size_t i : along) written.points.push_back(points[i]);
    const auto nearest = templates_[part.stroke].nearest_to(std::span(written.points).last(along.size()));
    for (std::size_t k = 0; k < along.size(); ++k) {
      const bool continues = k > 0 && along[k] == along[k - 1] + 1;
      const double step = continues ? (points[along[k]] - points[along[k - 1]]).norm() : 0.0;
      written.error.add(nearest[continues ? k - 1 : k].closest.distance, nearest[k].closest.distance, step);
    }
    return !along.empty();
  }

  void measure(std::size_t stroke) {
    const Written& written = written_[stroke];
    if (written.paths.empty()) return;
    StrokeScore& score = result_.strokes[stroke];
    score.pen_down = static_cast<int>(written.paths.front());
    score.coverage = written.backwards ? 0.0 : covered(written.parts);
    score.rms_error = written.error.rms();
    score.max_error = written.error.largest;
    score.dtw_distance = dtw_distance(written.points, templates_[stroke].fine);
  }

  /// Adds the unwritten part of a stroke to the error, with its distance from the ink, or `least` where that is more.
  void add_rest(std::size_t stroke, double least, PathError& error) const {
    const Written& written = written_[stroke];
    const std::vector<Point>& line = templates_[stroke].line;
    const auto pieces = static_cast<double>(line.size() - 1);
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const double place = (static_cast<double>(k) + 0.5) / pieces;
      const bool done = std::any_of(written.parts.begin(), written.parts.end(),
                                    [place](const Interval& part) { return part.from <= place && place <= part.to; });
      const Point middle = 0.5 * (line[k] + line[k + 1]);
      if (done) continue;
      const double distance = std::max(least, distance_to_ink(middle, written));
      error.add(distance, distance, templates_[stroke].length / pieces);
    }
  }

  /// Distance to the ink of the stroke, or to that of all strokes if it was not written.
  double distance_to_ink(const Point& point, const Written& written) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t path = 0; path < paths_.size(); ++path) {
      const auto& own = written.paths;
      const bool counts =
          own.empty() ? result_.match.drawn[path].stroke >= 0 : std::find(own.begin(), own.end(), path) != own.end();
      if (counts) nearest = std::min(nearest, distance_to_path(point, paths_[path]));
    }
    return nearest;
  }

  /// Number of strokes written wrongly; a pen-down that joined several counts for each of them.
  template <typename Wrong>
  int count_strokes(Wrong wrong) const {
    int count = 0;
    for (const DrawnStroke& drawn : result_.match.drawn) {
      if (drawn.stroke < 0 || drawn.continues || !wrong(drawn)) continue;
      count += drawn.stroke_count + (drawn.also >= 0 ? 1 : 0);
    }
    return count;
  }

  void combine() {
    PathError written, overall;
    double length = 0.0, contour = 0.0, covered_length = 0.0, dtw = 0.0;
    for (std::size_t i = 0; i < templates_.size(); ++i) {
      measure(i);
      const StrokeScore& score = result_.strokes[i];
      length += templates_[i].length;
      covered_length += score.coverage * templates_[i].length;
      if (score.pen_down < 0) continue;
      ++result_.strokes_written;
      written.add(written_[i].error);
      dtw += score.dtw_distance;
    }
    result_.coverage = length > 0.0 ? covered_length / length : 0.0;
    if (result_.strokes_written == 0) return;
    for (std::size_t i = 0; i < templates_.size(); ++i) {
      StrokeScore& score = result_.strokes[i];
      const bool is_written = score.pen_down >= 0;
      PathError of_stroke = written_[i].error;
      add_rest(i, is_written ? score.rms_error : written.rms(), of_stroke);
      score.overall_error = of_stroke.rms();
      overall.add(of_stroke);
      if (is_written) contour += std::exp(-score.overall_error / (contour_tolerance * placement_.em));
    }
    result_.overall_error = overall.rms();
    result_.rms_error = written.rms();
    result_.max_error = written.largest;
    result_.dtw_distance = dtw / result_.strokes_written;
    const double strokes = result_.stroke_count, right = result_.strokes_written;
    result_.contour = contour / strokes;
    const int out_of_turn = count_strokes([](const DrawnStroke& drawn) { return !drawn.in_turn; });
    const int backwards =
        count_strokes([](const DrawnStroke& drawn) { return drawn.direction == WritingDirection::backwards; });
    result_.external_sequence =
        std::max(0.0, right - out_of_turn) / (strokes + result_.match.count(StrokeRemarkKind::extra));
    result_.internal_sequence = std::max(0.0, right - backwards) / strokes;
    result_.fidelity = std::cbrt(result_.contour * result_.external_sequence * result_.internal_sequence);
  }

  const Placement placement_;
  const std::vector<PenDown> downs_;
  std::vector<Template> templates_;
  std::vector<std::vector<Point>> paths_;  ///< points of the pen-downs [m]
  CharacterScore result_;
  std::vector<Written> written_;  ///< of each stroke
};

/// Adds what the session recorded of each character: strokes finished, time and force.
void add_session(const Recording& recording, const PracticePage& page, std::vector<CharacterScore>& scores) {
  const RecordedSample* before = nullptr;
  double written = not_measured;  // when the pen finished or left the stroke that it wrote last
  for (const RecordedSample& sample : recording.samples) {
    const bool was_writing = before != nullptr && before->state == InteractionState::writing;
    if (was_writing && sample.state != InteractionState::writing) written = sample.time;
    const auto active = static_cast<std::size_t>(sample.character);
    if (has_event(sample.events, TickEvent::stroke_finished)) {
      const StrokeIndex finished = finished_stroke(page, sample);
      CharacterScore& score = scores[finished.character];
      score.strokes[finished.stroke].completed = true;
      const bool is_last = has_event(sample.events, TickEvent::character_finished);
      if (is_last && !score.pen_downs.empty()) score.time = written - score.pen_downs.front().motion.begin;
    }
    if (active < scores.size()) {
      CharacterScore& score = scores[active];
      score.lost_samples += is_usable(sample) ? 0 : 1;
      score.peak_force = std::max(score.peak_force, sample.force.norm());
      if (before != nullptr && before->character == sample.character) {
        score.max_force_step = std::max(score.max_force_step, (sample.force - before->force).norm());
      }
    }
    before = &sample;
  }
  for (CharacterScore& score : scores) {
    score.strokes_completed = static_cast<int>(
        std::count_if(score.strokes.begin(), score.strokes.end(), [](const auto& stroke) { return stroke.completed; }));
    if (score.strokes_completed < score.stroke_count) score.time = not_measured;  // a stroke was skipped
  }
}

}  // namespace

std::vector<CharacterScore> score_page(const PracticePage& page, const Recording& recording,
                                       const JudgeTolerances& tolerances) {
  if (page.characters.empty()) return {};
  validate(page.characters);
  require_same_page(page, recording);
  std::vector<std::vector<PenDown>> own = pen_downs_by_character(page, recording);
  std::vector<CharacterScore> scores;
  for (std::size_t i = 0; i < own.size(); ++i) {
    scores.push_back(CharacterScorer(page.characters[i], std::move(own[i]), tolerances).run());
  }
  add_session(recording, page, scores);
  return scores;
}

MeanScore mean_score(std::span<const CharacterScore> scores) {
  MeanScore mean;
  double error = 0.0, overall = 0.0, coverage = 0.0;
  for (const CharacterScore& score : scores) {
    ++mean.characters;
    mean.stroke_count += score.stroke_count;
    mean.strokes_written += score.strokes_written;
    coverage += score.coverage;
    if (score.strokes_written == 0) continue;
    ++mean.characters_written;
    error += score.rms_error;
    overall += score.overall_error;
  }
  if (mean.characters > 0) mean.coverage = coverage / mean.characters;
  if (mean.characters_written == 0) return mean;
  mean.rms_error = error / mean.characters_written;
  mean.overall_error = overall / mean.characters_written;
  return mean;
}

}  // namespace calligraphy
