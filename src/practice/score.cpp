#include <calligraphy/practice/score.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/practice/pen_path.hpp>

#include "resemblance.hpp"
#include "stroke_name.hpp"

namespace calligraphy {
namespace {

constexpr double contour_tolerance = 0.05;   // RMS error at which the contour score has fallen to 1/e [em]
constexpr double min_attempt = 0.1;          // a path on the paper that is shorter says nothing of a stroke [em]
constexpr double min_time = 0.15;            // a pen that is down for less has bounced [s]
constexpr double doubt = 0.05;               // another stroke must be resembled more than the due one by this [em]
constexpr double backward_tolerance = 0.15;  // going back by more within a stroke is a mistake [em]

/// A stroke of the template, all elements prepared.
struct Template {
  std::vector<StrokeElement> elements;
  std::vector<Point> line;
  const TypicalStroke* type;
};

double distance_from(const Template& stroke, const Point& tip) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const StrokeElement& element : stroke.elements) {
    nearest = std::min(nearest, nearest_point(element, tip).distance);
  }
  return nearest;
}

std::vector<Template> templates(const PlacedCharacter& placed) {
  std::vector<Template> result;
  for (const Stroke& stroke : strokes(placed.character)) {
    result.push_back({place_elements(stroke, placed.placement), middle_line(stroke, placed.placement), stroke.type});
  }
  return result;
}

/// Sums an error along a path.
struct PathError {
  double length = 0.0, square = 0.0, largest = 0.0;

  void add(double error, double step) {
    length += step;
    square += error * error * step;
    largest = std::max(largest, error);
  }
  double rms() const { return length > 0.0 ? std::sqrt(square / length) : largest; }
};

PathError lateral_error(const Template& stroke, std::span<const RecordedSample> path) {
  PathError error;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Point tip = path[i].pen_tip.head<2>();
    const double step = i > 0 ? (tip - path[i - 1].pen_tip.head<2>()).norm() : 0.0;
    error.add(distance_from(stroke, tip), step);
  }
  return error;
}

std::vector<Point> points_of(std::span<const RecordedSample> path) {
  std::vector<Point> points;
  for (const RecordedSample& sample : path) points.push_back(sample.pen_tip.head<2>());
  return points;
}

/// How far the pen went back within a stroke, at most [m].
double backwards(const PlacedCharacter& placed, std::size_t stroke, std::span<const RecordedSample> path) {
  ActiveStroke active;
  active.load(strokes(placed.character)[stroke], placed.placement);
  double most = 0.0;
  for (const RecordedSample& sample : path)
    most = std::max(most, active.update(sample.pen_tip.head<2>(), {}).backwards);
  return most;
}

/// How little a path on the paper resembles a stroke [m], and in which direction it runs along it.
struct Resemblance {
  double cost = std::numeric_limits<double>::infinity();
  bool backwards = false;
};

/// A pen that was lifted early is compared with as much of the stroke as it wrote.
Resemblance compare(const Template& stroke, const std::vector<Point>& path) {
  const double length = std::min(path_length(path), path_length(stroke.line));
  const std::vector<Point> from_its_end(stroke.line.rbegin(), stroke.line.rend());
  const Outline drawn = outline(path);
  const double forwards = mean_distance(drawn, outline(stroke.line, length));
  const double backwards = mean_distance(drawn, outline(from_its_end, length));
  return {std::min(forwards, backwards), backwards < forwards};
}

std::string stroke_label(const std::vector<Template>& strokes, std::size_t index) {
  return stroke_name(index, *strokes[index].type);
}

class CharacterScorer {
 public:
  CharacterScorer(const PlacedCharacter& placed, std::span<const RecordedSample> samples)
      : placed_(placed), strokes_(templates(placed)), samples_(samples) {
    result_.character = placed.character.code;
    result_.stroke_count = placed.character.stroke_count();
  }

  CharacterScore run() {
    for (std::size_t i = 0; i < samples_.size(); ++i) visit(i);
    judge_time_and_force();
    if (whole_.length > 0.0) result_.rms_error = whole_.rms();
    result_.max_error = whole_.largest;
    combine();
    return std::move(result_);
  }

 private:
  void visit(std::size_t i) {
    const RecordedSample& sample = samples_[i];
    if (has_event(sample.events, TickEvent::contact)) {
      down_ = i;
      due_ = static_cast<std::size_t>(sample.stroke);
      finished_while_down_ = false;
    }
    if (has_event(sample.events, TickEvent::stroke_finished) && down_ != none) {
      finish(samples_.subspan(down_, i + 1 - down_));
      finished_while_down_ = true;
      last_finish_ = i;
    }
    const bool lifted = has_event(sample.events, TickEvent::lift) && down_ != none;
    if (lifted) {
      if (!finished_while_down_ && due_ < strokes_.size()) judge_attempt(samples_.subspan(down_, i - down_));
      down_ = none;
    }
  }

  void finish(std::span<const RecordedSample> path) {
    const auto stroke = static_cast<std::size_t>(result_.strokes_completed++);
    if (stroke >= strokes_.size()) return;
    const PathError error = lateral_error(strokes_[stroke], path);
    whole_.length += error.length;
    whole_.square += error.square;
    whole_.largest = std::max(whole_.largest, error.largest);
    contour_ += std::exp(-error.rms() / (contour_tolerance * placed_.placement.em));
    const double back = backwards(placed_, stroke, path);
    if (back > backward_tolerance * placed_.placement.em) {
      add(WritingMistakeKind::direction, stroke, path.front().time,
          stroke_label(strokes_, stroke) + " was written backwards over " + std::to_string(std::lround(back * 1e3)) +
              " mm");
    }
  }

  /// A pen-down that completed nothing. In doubt the writer meant the stroke that was due.
  void judge_attempt(std::span<const RecordedSample> path) {
    const double em = placed_.placement.em;
    if (path.size() < 2 || path.back().time - path.front().time < min_time) return;
    const std::vector<Point> points = points_of(path);
    if (path_length(points) < min_attempt * em) return;
    std::size_t meant = due_;
    Resemblance best = compare(strokes_[due_], points);
    const double of_due = best.cost;
    for (std::size_t j = 0; j < strokes_.size(); ++j) {
      const Resemblance other = compare(strokes_[j], points);
      if (other.cost >= best.cost || other.cost + doubt * em >= of_due) continue;
      best = other;
      meant = j;
    }
    if (meant != due_) {
      const std::string was = meant < due_ ? " was written again where " : " was written where ";
      add(WritingMistakeKind::order, due_, path.front().time,
          stroke_label(strokes_, meant) + was + stroke_label(strokes_, due_) + " was due");
    } else if (best.backwards) {
      add(WritingMistakeKind::direction, due_, path.front().time,
          stroke_label(strokes_, due_) + " was written backwards");
    }
  }

  void add(WritingMistakeKind kind, std::size_t stroke, double time, std::string reason) {
    result_.mistakes.push_back({kind, static_cast<int>(stroke), time, std::move(reason)});
  }

  void judge_time_and_force() {
    const auto first = std::find_if(samples_.begin(), samples_.end(), [](const RecordedSample& sample) {
      return has_event(sample.events, TickEvent::contact);
    });
    if (first != samples_.end()) {
      const bool complete = result_.strokes_completed == result_.stroke_count;
      const double end = complete && last_finish_ != none ? samples_[last_finish_].time : samples_.back().time;
      result_.time = end - first->time;
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      result_.peak_force = std::max(result_.peak_force, samples_[i].force.norm());
      if (i == 0) continue;
      result_.max_force_step = std::max(result_.max_force_step, (samples_[i].force - samples_[i - 1].force).norm());
    }
  }

  void combine() {
    const double completed = result_.strokes_completed;
    if (completed == 0.0) return;
    result_.contour = contour_ / result_.stroke_count;
    result_.external_sequence = completed / (completed + result_.order_mistakes());
    result_.internal_sequence = completed / (completed + result_.direction_mistakes());
    result_.fidelity = std::cbrt(result_.contour * result_.external_sequence * result_.internal_sequence);
  }

  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  const PlacedCharacter& placed_;
  const std::vector<Template> strokes_;
  const std::span<const RecordedSample> samples_;
  CharacterScore result_;
  PathError whole_;
  double contour_ = 0.0;
  std::size_t down_ = none;
  std::size_t due_ = 0;
  std::size_t last_finish_ = none;
  bool finished_while_down_ = false;
};

int count(const std::vector<WritingMistake>& mistakes, WritingMistakeKind kind) {
  return static_cast<int>(std::count_if(mistakes.begin(), mistakes.end(),
                                        [kind](const WritingMistake& mistake) { return mistake.kind == kind; }));
}

}  // namespace

int CharacterScore::order_mistakes() const noexcept { return count(mistakes, WritingMistakeKind::order); }
int CharacterScore::direction_mistakes() const noexcept { return count(mistakes, WritingMistakeKind::direction); }

std::vector<CharacterScore> score_page(const PracticePage& page, const Recording& recording) {
  std::vector<CharacterScore> scores;
  const std::span<const RecordedSample> samples(recording.samples);
  std::size_t begin = 0;
  for (std::size_t index = 0; index < page.characters.size(); ++index) {
    std::size_t end = begin;
    while (end < samples.size() && samples[end].character <= static_cast<int>(index)) ++end;
    // The tick that finishes a character, or lifts the pen from it, already names the next one.
    if (end < samples.size()) ++end;
    scores.push_back(CharacterScorer(page.characters[index], samples.subspan(begin, end - begin)).run());
    begin = end;
  }
  return scores;
}

}  // namespace calligraphy
