#include <cmath>
#include <limits>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/collision/stroke_element.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/judge/remark_text.hpp>
#include <calligraphy/practice/score.hpp>

#include "../catch.hpp"
#include "pages.hpp"
#include "practice/pen_down.hpp"

using namespace calligraphy;
using calligraphy_test::page_of;
using calligraphy_test::session;

namespace {

/// A pen moved directly through a renderer: no device, no writer, so that the ground truth is known.
class Pen {
 public:
  /// @param spacing between the ticks of a stroke [m]
  explicit Pen(const PracticePage& page, double spacing = 1e-4)
      : page_(page),
        spacing_(spacing),
        mapping_(upright_page(page.width, page.height)),
        renderer_(page.characters, mapping_, device_profile("ideal")) {
    rest();
  }

  /// Draws a stroke of a character of the page, shifted, then lifts the pen.
  void draw(int character, int stroke, const Point& shift = Point::Zero(), bool backwards = false) {
    const PlacedCharacter& placed = page_.characters[static_cast<std::size_t>(character)];
    const Stroke truth = strokes(placed.character)[static_cast<std::size_t>(stroke)];
    std::vector<Point> path;
    for (const StrokeElement& element : place_elements(truth, placed.placement)) {
      const int steps = std::max(2, static_cast<int>(element.length() / spacing_));
      for (int s = 0; s <= steps; ++s) {
        path.push_back(shift + element.point(element.parameter_at(element.length() * s / steps)));
      }
    }
    if (backwards) std::reverse(path.begin(), path.end());
    draw(path);
  }

  void draw(const std::vector<Point>& path) {
    hover(path.front());
    for (const Point& point : path) step({point.x(), point.y(), -1e-4});
    hover(path.back());
  }

  std::vector<CharacterScore> scores() const { return score_page(page_, recording_); }
  const Recording& recording() const { return recording_; }

 private:
  void rest() { hover({0.5 * page_.width, 0.5 * page_.height}); }
  void hover(const Point& point) {
    for (int i = 0; i < 100; ++i) step({point.x(), point.y(), 0.005});
  }
  void step(const Eigen::Vector3d& point) {
    DeviceState state;
    state.time = static_cast<double>(recording_.samples.size()) * 1e-3 * 100;  // slow enough for any motion in the air
    state.position = mapping_.to_device(point);
    const HapticTick& tick = renderer_.update(state);
    recording_.samples.push_back({tick.time, tick.device_point, tick.pen_tip, tick.page_force, tick.state, tick.events,
                                  tick.status, tick.character, tick.stroke, 0.0F});
  }

  PracticePage page_;
  double spacing_;
  MotionMapping mapping_;
  HapticRenderer renderer_;
  Recording recording_;
};

/// A straight path in steps of at most 0.1 mm.
std::vector<Point> straight(const Point& from, const Point& to) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / 1e-4)));
  std::vector<Point> path;
  for (int i = 0; i <= steps; ++i) path.push_back(from + (to - from) * i / steps);
  return path;
}

/// First and last point of a stroke [m].
std::pair<Point, Point> ends_of(const PracticePage& page, int character, int stroke) {
  const PlacedCharacter& placed = page.characters[static_cast<std::size_t>(character)];
  const auto points = strokes(placed.character)[static_cast<std::size_t>(stroke)].control_points;
  return {placed.placement.to_page(points.front()), placed.placement.to_page(points.back())};
}

}  // namespace

TEST_CASE("a perfect copy has no error, no mistake and full fidelity", "[practice]") {
  Pen pen(page_of("永"));
  for (int stroke = 0; stroke < 5; ++stroke) pen.draw(0, stroke);
  const CharacterScore result = pen.scores().front();
  CHECK(result.strokes_completed == 5);
  CHECK(result.strokes_written == 5);
  CHECK(result.match.remarks.empty());
  CHECK(result.rms_error < 1e-7);
  CHECK(result.overall_error < 1e-7);
  CHECK(result.coverage == 1.0);
  CHECK(result.lost_samples == 0);
  CHECK(result.fidelity == Approx(1.0).epsilon(1e-4));
}

TEST_CASE("a heng drawn 1 mm too high has a lateral error of 1 mm", "[practice]") {
  const PracticePage page = page_of("一");
  const Point along = strokes(page.characters[0].character)[0].control_points[1] -
                      strokes(page.characters[0].character)[0].control_points[0];
  const Point across = 1e-3 * Point(-along.y(), along.x()).normalized();
  Pen pen(page);
  pen.draw(0, 0, across);
  const CharacterScore result = pen.scores().front();
  CHECK(result.strokes_completed == 1);
  CHECK(result.rms_error == Approx(1e-3).epsilon(1e-9));
  CHECK(result.max_error == Approx(1e-3).epsilon(1e-9));
  CHECK(result.overall_error == Approx(1e-3).epsilon(1e-9));
  CHECK(result.contour == Approx(std::exp(-0.5)).epsilon(1e-6));  // 1 mm of an em of 40 mm, against 5 %
}

TEST_CASE("the score of a stroke begins where the pen is put down, before the stroke is recognised", "[practice]") {
  const PracticePage page = page_of("一");
  const PlacedCharacter& placed = page.characters[0];
  const std::vector<Stroke> drawn = strokes(placed.character);
  const auto points = drawn[0].control_points;
  const Point start = placed.placement.to_page(points[0]), end = placed.placement.to_page(points[1]);
  const Point along = (end - start).normalized(), left(-along.y(), along.x());
  Pen pen(page);
  std::vector<Point> path;
  for (double way = 0.0; way < 0.003; way += 1e-4) path.push_back(start + (0.003 - way) * left);  // down to the start
  for (double way = 0.0; way <= (end - start).norm(); way += 1e-4) path.push_back(start + way * along);
  pen.draw(path);
  const CharacterScore result = pen.scores().front();
  CHECK(result.strokes_completed == 1);
  CHECK(result.max_error == Approx(0.003).epsilon(1e-6));
}

TEST_CASE("half a stroke is half covered, and the other half counts as far as it is from the ink", "[practice]") {
  const PracticePage page = page_of("一");
  const auto [start, end] = ends_of(page, 0, 0);
  const double length = (end - start).norm();
  Pen pen(page);
  pen.draw(straight(start, 0.5 * (start + end)));
  const CharacterScore result = pen.scores().front();
  CHECK(result.strokes_written == 1);
  CHECK(result.strokes_completed == 0);
  CHECK(result.coverage == Approx(0.5).margin(0.011));
  CHECK(result.rms_error < 1e-7);
  CHECK(result.overall_error == Approx(length / std::sqrt(24.0)).epsilon(0.003));  // of x^2 over half of the length
  CHECK(std::isnan(result.time));
  CHECK(result.contour < 0.1);
}

TEST_CASE("half a stroke written backwards leaves out the other half too", "[practice]") {
  const PracticePage page = page_of("一");
  const auto [start, end] = ends_of(page, 0, 0);
  Pen forwards(page), backwards(page);
  forwards.draw(straight(start, 0.5 * (start + end)));
  backwards.draw(straight(0.5 * (start + end), start));
  const CharacterScore one = forwards.scores().front(), other = backwards.scores().front();
  CHECK(other.direction_mistakes() == 1);
  CHECK(other.coverage == 0.0);
  CHECK(other.overall_error == Approx(one.overall_error).epsilon(1e-3));
}

TEST_CASE("a stroke that was not written is as far off as it is from the ink of the others", "[practice]") {
  const PracticePage page = page_of("二");
  const auto [start, end] = ends_of(page, 0, 0);
  Pen pen(page);
  pen.draw(0, 0);
  const CharacterScore result = pen.scores().front();
  CHECK(result.strokes_written == 1);
  CHECK(result.rms_error < 1e-7);
  CHECK(std::isnan(result.strokes[1].rms_error));
  double least = 1.0, most = 0.0;  // from the ends of the second stroke to the first
  const auto [left, right] = ends_of(page, 0, 1);
  for (const Point& point : straight(left, right)) {
    double nearest = 1.0;
    for (const Point& ink : straight(start, end)) nearest = std::min(nearest, (ink - point).norm());
    least = std::min(least, nearest);
    most = std::max(most, nearest);
  }
  CHECK(result.strokes[1].overall_error > least);
  CHECK(result.strokes[1].overall_error < most);
  CHECK(result.overall_error < result.strokes[1].overall_error);
  CHECK(result.overall_error > 0.5 * result.strokes[1].overall_error);
}

TEST_CASE("a stroke begun late is covered from there on", "[practice]") {
  const PracticePage page = page_of("一");
  const auto [start, end] = ends_of(page, 0, 0);
  Pen pen(page);
  pen.draw(straight(start + 0.3 * (end - start), end));
  CHECK(pen.scores().front().coverage == Approx(0.7).margin(0.011));
}

TEST_CASE("the middle of a stroke is covered where it was written", "[practice]") {
  const PracticePage page = page_of("一");
  const auto [start, end] = ends_of(page, 0, 0);
  Pen pen(page);
  pen.draw(straight(start + 0.3 * (end - start), start + 0.9 * (end - start)));
  const CharacterScore result = pen.scores().front();
  CHECK(result.coverage == Approx(0.6).margin(0.011));
  const double length = (end - start).norm();  // left out: 0.3 of it on one side, 0.1 on the other
  CHECK(result.overall_error == Approx(length * std::sqrt((0.027 + 0.001) / 3.0)).epsilon(0.02));
}

TEST_CASE("a stroke beside its place is covered whole", "[practice]") {
  const PracticePage page = page_of("一");
  Pen pen(page);
  pen.draw(0, 0, {0.0, 0.004});
  const CharacterScore result = pen.scores().front();
  CHECK(result.coverage == Approx(1.0).margin(0.011));
  CHECK(result.rms_error == Approx(0.004).epsilon(0.01));
}

TEST_CASE("a displaced stroke is no shorter, whatever its shape and wherever it was moved", "[practice]") {
  for (const Character& character : built_in_characters().characters) {
    if (character.stroke_count() < 2) continue;
    const PracticePage page = lay_out(std::span(&character, 1)).front();
    for (const Point& shift : {Point(0.003, 0.0), Point(-0.003, 0.0), Point(0.002, 0.002), Point(0.0, -0.003)}) {
      CAPTURE(encode_utf8(character.code), shift.x(), shift.y());
      Pen pen(page, 1e-3);
      for (int i = 0; i < character.stroke_count(); ++i) pen.draw(0, i, shift);
      const CharacterScore result = pen.scores().front();
      CHECK(result.strokes_written == character.stroke_count());
      CHECK(result.coverage > 0.97);
      for (const StrokeScore& stroke : result.strokes) CHECK(stroke.coverage > 0.93);
    }
  }
}

TEST_CASE("a slanted stroke is no shorter, but for one in fifty with a hook", "[practice]") {
  int strokes_in_all = 0, shorter = 0;
  for (const Character& character : built_in_characters().characters) {
    const PracticePage page = lay_out(std::span(&character, 1)).front();
    for (const double angle : {-0.15, 0.15}) {  // 9 degrees
      CAPTURE(encode_utf8(character.code), angle);
      Pen pen(page, 1e-3);
      for (const Stroke& stroke : strokes(character)) {
        std::vector<Point> path;
        Point middle = Point::Zero();
        for (const StrokeElement& element : place_elements(stroke, page.characters[0].placement)) {
          for (int i = 0; i <= 20; ++i) path.push_back(element.point(element.parameter_at(element.length() * i / 20)));
        }
        for (const Point& point : path) middle += point / static_cast<double>(path.size());
        for (Point& point : path) point = middle + Eigen::Rotation2Dd(angle) * Point(point - middle);
        pen.draw(path);
      }
      const CharacterScore result = pen.scores().front();
      CHECK(result.coverage > 0.9);
      for (const StrokeScore& stroke : result.strokes) {
        ++strokes_in_all;
        if (stroke.coverage < 0.95) ++shorter;
      }
    }
  }
  CHECK(50 * shorter <= strokes_in_all);
}

TEST_CASE("the first strokes of a character are matched where they lie", "[practice]") {
  for (const Character& character : built_in_characters().characters) {
    const PracticePage page = lay_out(std::span(&character, 1)).front();
    const int count = character.stroke_count();
    for (int written = 1; written < count; ++written) {
      CAPTURE(encode_utf8(character.code), written);
      Pen pen(page, 1e-3);
      for (int i = 0; i < written; ++i) pen.draw(0, i, {0.001, -0.001});
      const CharacterScore result = pen.scores().front();
      CHECK(result.strokes_written == written);
      CHECK(result.match.count(StrokeRemarkKind::missing) == count - written);
      CHECK(result.match.remarks.size() == static_cast<std::size_t>(count - written));
      CHECK(result.max_error < 0.0015);
    }
  }
}

TEST_CASE("what was left out is never nearer than what was written", "[practice]") {
  const PracticePage page = page_of("十");
  const auto [start, end] = ends_of(page, 0, 0);
  const Point aside(0.0, 0.003);
  Pen pen(page);  // the first stroke comes nearer and lacks the end, the second crosses it
  pen.draw(straight(start + 2.0 * aside, end - 0.1 * (end - start)));
  const CharacterScore result = pen.scores().front();
  CHECK(result.strokes_written == 1);
  CHECK(result.strokes[0].overall_error >= (1.0 - 1e-9) * result.strokes[0].rms_error);
  CHECK(result.strokes[1].overall_error >= (1.0 - 1e-9) * result.rms_error);
  CHECK(result.overall_error >= (1.0 - 1e-9) * result.rms_error);
}

TEST_CASE("ink that is no stroke is near none that was left out", "[practice]") {
  const PracticePage page = page_of("国");
  const Placement& placement = page.characters[0].placement;
  std::vector<Point> scribble;
  for (int i = 0; i < 40; ++i) {
    for (const int j : {0, 1}) {
      const auto next = straight(scribble.empty() ? placement.origin : scribble.back(),
                                 placement.to_page(Point((i + j) % 2, i / 39.0)));
      scribble.insert(scribble.end(), next.begin(), next.end());
    }
  }
  Pen nothing(page), scribbled(page), clean(page);
  nothing.draw(scribble);
  clean.draw(0, 0);
  scribbled.draw(0, 0);
  scribbled.draw(scribble);
  CHECK(nothing.scores().front().strokes_written == 0);
  CHECK(std::isnan(nothing.scores().front().overall_error));
  CHECK(scribbled.scores().front().overall_error == Approx(clean.scores().front().overall_error).epsilon(0.01));
}

TEST_CASE("a pen that rests adds no error, however its sensor flickers", "[practice]") {
  for (const double em : {0.04, 0.01}) {
    CAPTURE(em);
    const PracticePage page = lay_out(std::span(&built_in_characters().at(U'十'), 1), {0.16, 0.12, em, 0.008}).front();
    Pen steady(page), flickering(page);
    for (int stroke = 0; stroke < 2; ++stroke) {
      const auto [start, end] = ends_of(page, 0, stroke);
      std::vector<Point> path = straight(start + 0.025 * em * Point(1.0, 1.0), end + 0.025 * em * Point(1.0, 0.0));
      steady.draw(path);
      for (int i = 0; i < 3000; ++i) {  // 160 mm of flicker
        path.push_back(path.back() + Point(i % 2 == 0 ? 55e-6 : -55e-6, 0.0));
      }
      flickering.draw(path);
    }
    const CharacterScore expected = steady.scores().front(), result = flickering.scores().front();
    CHECK(expected.strokes_written == 2);
    CHECK(result.match.remarks.empty());
    CHECK(result.coverage == Approx(expected.coverage).margin(0.011));
    CHECK(result.rms_error == Approx(expected.rms_error).epsilon(0.02));
    CHECK(result.overall_error == Approx(expected.overall_error).epsilon(0.02));
    CHECK(result.dtw_distance == Approx(expected.dtw_distance).epsilon(0.05));
  }
}

namespace {

/// The recording up to this share of the last time on the paper.
Recording cut_off(const Pen& pen, double share) {
  Recording recording = pen.recording();
  std::vector<RecordedSample>& samples = recording.samples;
  const auto on_paper = [](const RecordedSample& each) { return each.state != InteractionState::separation; };
  const auto last = std::find_if(samples.rbegin(), samples.rend(), on_paper);
  const auto length = static_cast<double>(std::find_if_not(last, samples.rend(), on_paper) - last);
  samples.erase(last.base() - static_cast<std::ptrdiff_t>((1.0 - share) * length), samples.end());
  return recording;
}

}  // namespace

TEST_CASE("a recording that ends with the pen on the paper has begun the stroke that comes next", "[practice]") {
  const Point near(0.0015, -0.001), up(0.0, 0.004), down(0.0, -0.004), right(0.004, 0.0);
  for (const char* text : {"十", "三", "永"}) {
    const PracticePage page = page_of(text);
    const int count = page.characters[0].character.stroke_count();
    for (const Point& shift : {near, up, down, right}) {
      for (int stroke = shift == near ? 0 : count - 1; stroke < count; ++stroke) {
        for (const double share : {0.2, 0.4, 0.6, 0.9}) {
          CAPTURE(text, stroke, share, shift.x(), shift.y());
          Pen pen(page, 3e-4);
          for (int i = 0; i <= stroke; ++i) pen.draw(0, i, shift);
          const CharacterScore result = score_page(page, cut_off(pen, share)).front();
          CHECK(result.strokes_written == stroke + 1);
          CHECK(result.match.remarks.size() == static_cast<std::size_t>(count - stroke - 1));
          CHECK(result.strokes[static_cast<std::size_t>(stroke)].pen_down == stroke);
          CHECK(result.strokes[static_cast<std::size_t>(stroke)].coverage == Approx(share).margin(0.06));
          CHECK(result.max_error < 0.009);
        }
      }
    }
  }
}

TEST_CASE("a stroke that is cut off may be backwards or out of order or the rest of a broken one", "[practice]") {
  const PracticePage ten = page_of("十"), three = page_of("三");
  const auto [start, end] = ends_of(ten, 0, 0);
  const auto scored = [](const Pen& pen, const PracticePage& page, double share) {
    return score_page(page, cut_off(pen, share)).front();
  };
  Pen backwards(ten);
  backwards.draw(straight(end, start));
  CHECK(scored(backwards, ten, 0.3).direction_mistakes() == 1);

  Pen out_of_order(three);
  for (const int stroke : {0, 2}) out_of_order.draw(0, stroke);
  CHECK(scored(out_of_order, three, 0.3).strokes[2].pen_down == 1);

  Pen broken(ten);
  broken.draw(straight(start, start + 0.45 * (end - start)));
  broken.draw(straight(start + 0.5 * (end - start), end));
  CHECK(scored(broken, ten, 0.9).match.count(StrokeRemarkKind::broken) == 1);

  const PracticePage eternal = page_of("永");
  const auto [top, bottom] = ends_of(eternal, 0, 4);
  Pen begun(eternal), again(eternal);
  for (int stroke = 0; stroke < 3; ++stroke) begun.draw(0, stroke);
  begun.draw(straight(top, top + 0.2 * (bottom - top)));
  CHECK(begun.scores().front().strokes[4].pen_down == 3);  // lifted or not
  CHECK(scored(begun, eternal, 1.0).strokes[4].pen_down == 3);
  CHECK(scored(begun, eternal, 0.1).strokes[4].pen_down == -1);  // a tap
  for (int stroke = 0; stroke < 5; ++stroke) again.draw(0, stroke, {0.0, 0.001});
  again.draw(straight(top, top + 0.2 * (bottom - top)));
  CHECK(scored(again, eternal, 1.0).match.drawn.back().stroke == -1);
  CHECK(scored(again, eternal, 1.0).strokes_written == 5);
}

TEST_CASE("an attempt that was repeated is extra, in a character that was broken off too", "[practice]") {
  for (const char* text : {"之", "山", "天"}) {
    CAPTURE(text);
    const PracticePage page = page_of(text);
    const auto [start, end] = ends_of(page, 0, 0);
    Pen half(page), backwards(page);
    half.draw(straight(start, start + 0.5 * (end - start)));
    backwards.draw(0, 0, Point::Zero(), true);
    for (Pen* pen : {&half, &backwards}) {
      pen->draw(0, 0);
      const CharacterScore result = pen->scores().front();
      CHECK(result.strokes[0].pen_down == 1);
      CHECK(result.match.count(StrokeRemarkKind::extra) == 1);
      CHECK(result.strokes_written == 1);
    }
  }
}

TEST_CASE("strokes that were joined backwards each count in the sequence, by one remark", "[practice]") {
  const PracticePage page = page_of("二");
  const auto [left, right] = ends_of(page, 0, 0);
  const auto [below, beside] = ends_of(page, 0, 1);
  std::vector<Point> path;
  for (const std::vector<Point>& next : {straight(beside, below), straight(below, right), straight(right, left)}) {
    path.insert(path.end(), next.begin(), next.end());
  }
  Pen pen(page);
  pen.draw(path);
  const CharacterScore result = pen.scores().front();
  CHECK(result.strokes_written == 2);
  CHECK(result.direction_mistakes() == 1);
  CHECK(result.internal_sequence == 0.0);
}

TEST_CASE("a step of the force from one character to the next is of neither", "[practice]") {
  const PracticePage page = page_of("一二");
  Recording recording;
  for (int i = 0; i < 40; ++i) {
    RecordedSample sample;
    sample.time = 1e-3 * i;
    sample.character = i / 20;
    sample.force = {0.0, 0.0, i < 20 ? 0.5 : 2.0 + 0.1 * (i % 2)};
    recording.samples.push_back(sample);
  }
  const std::vector<CharacterScore> scores = score_page(page, recording);
  CHECK(scores[0].max_force_step == 0.0);
  CHECK(scores[1].max_force_step == Approx(0.1));
}

TEST_CASE("nothing written has no error and no time, and is counted", "[practice]") {
  const PracticePage page = page_of("永");
  Pen pen(page);
  for (const CharacterScore& result : {score_page(page, Recording()).front(), pen.scores().front()}) {
    CHECK(result.strokes_written == 0);
    CHECK(result.match.count(StrokeRemarkKind::missing) == 5);
    for (const double error : {result.rms_error, result.max_error, result.overall_error, result.time}) {
      CHECK(std::isnan(error));
    }
    for (const double share :
         {result.coverage, result.contour, result.external_sequence, result.internal_sequence, result.fidelity}) {
      CHECK(share == 0.0);
    }
    const MeanScore mean = mean_score(std::span(&result, 1));
    CHECK(std::isnan(mean.rms_error));
    CHECK(mean.characters_written == 0);
    CHECK(mean.characters == 1);
  }
}

TEST_CASE("a mean says over how many of how many strokes it is", "[practice]") {
  const PracticePage page = page_of("一");
  std::vector<CharacterScore> scores;
  for (const double shift : {0.001, 0.003}) {
    Pen pen(page);
    pen.draw(0, 0, {0.0, shift});
    scores.push_back(pen.scores().front());
  }
  scores.push_back(Pen(page).scores().front());
  const MeanScore mean = mean_score(scores);
  CHECK(mean.characters == 3);
  CHECK(mean.characters_written == 2);
  CHECK(mean.stroke_count == 3);
  CHECK(mean.strokes_written == 2);
  CHECK(mean.rms_error == Approx(0.5 * (scores[0].rms_error + scores[1].rms_error)));
  CHECK(mean.overall_error == Approx(0.5 * (scores[0].overall_error + scores[1].overall_error)));
  CHECK(mean.coverage == Approx(2.0 / 3.0).margin(0.011));
}

TEST_CASE("two strokes written in each other's place are one order mistake, and both are measured", "[practice]") {
  Pen pen(page_of("永"));
  for (const int stroke : {0, 1, 2, 4, 3}) pen.draw(0, stroke);
  const CharacterScore result = pen.scores().front();
  REQUIRE(result.order_mistakes() == 1);
  CHECK(result.match.remarks.size() == 1);
  CHECK(remark_text(result.match.remarks[0], result.match.character) ==
        "Stroke 5 (nà) came too early: write stroke 4 (piě) first.");
  CHECK(result.strokes_written == 5);
  CHECK(result.strokes_completed < 5);  // the session waited for stroke 4, and then for 5
  CHECK(std::isnan(result.time));
  CHECK(result.rms_error < 1e-7);
  CHECK(result.coverage == Approx(1.0));
  CHECK(result.external_sequence == Approx(4.0 / 5.0));
  CHECK(result.internal_sequence == 1.0);
}

TEST_CASE("a stroke written too early and once more in its place is an extra pen-down", "[practice]") {
  Pen pen(page_of("永"));
  for (const int stroke : {4, 0, 1, 2, 3, 4}) pen.draw(0, stroke);
  const CharacterScore result = pen.scores().front();
  CHECK(result.order_mistakes() == 0);
  CHECK(result.match.count(StrokeRemarkKind::extra) == 1);
  CHECK(result.strokes_completed == 5);
  CHECK(result.external_sequence == Approx(5.0 / 6.0));
}

TEST_CASE("every stroke of every built-in character, written backwards, is one direction mistake and not covered",
          "[practice]") {
  for (const Character& character : built_in_characters().characters) {
    const PracticePage page = lay_out(std::span(&character, 1)).front();
    for (int stroke = 0; stroke < character.stroke_count(); ++stroke) {
      const auto [start, end] = ends_of(page, 0, stroke);
      if ((start - end).norm() < 0.004) continue;  // a ring ends where it begins
      CAPTURE(encode_utf8(character.code), stroke);
      Pen pen(page, 1e-3);
      for (int i = 0; i < character.stroke_count(); ++i) pen.draw(0, i, Point::Zero(), i == stroke);
      const CharacterScore result = pen.scores().front();
      CHECK(result.direction_mistakes() == 1);
      CHECK(result.match.remarks.size() == 1);
      CHECK(result.strokes_written == character.stroke_count());
      CHECK(result.rms_error < 1e-6);
      CHECK(result.strokes[static_cast<std::size_t>(stroke)].coverage == 0.0);
      CHECK(result.internal_sequence == Approx(1.0 - 1.0 / character.stroke_count()));
    }
  }
}

TEST_CASE("a stroke broken in two is covered but for its gap, two joined are each measured by themselves",
          "[practice]") {
  const PracticePage page = page_of("十");
  const auto [start, end] = ends_of(page, 0, 0);
  const Point along = end - start;
  Pen broken(page);
  broken.draw(straight(start, start + 0.5 * along));
  broken.draw(straight(start + 0.6 * along, end));
  broken.draw(0, 1);
  const CharacterScore in_two = broken.scores().front();
  CHECK(in_two.match.count(StrokeRemarkKind::broken) == 1);
  CHECK(in_two.strokes[0].coverage == Approx(0.9).margin(0.015));
  CHECK(in_two.strokes[0].pen_down == 0);
  CHECK(in_two.strokes[1].coverage == Approx(1.0));

  const auto [down, up] = ends_of(page, 0, 1);
  std::vector<Point> path = straight(start, end);
  for (const std::vector<Point>& next : {straight(end, down), straight(down, up)}) {
    path.insert(path.end(), next.begin(), next.end());
  }
  Pen joined(page);
  joined.draw(path);
  const CharacterScore as_one = joined.scores().front();
  REQUIRE(as_one.match.count(StrokeRemarkKind::joined) == 1);
  CHECK(as_one.strokes_written == 2);
  for (const StrokeScore& stroke : as_one.strokes) {
    CHECK(stroke.pen_down == 0);
    CHECK(stroke.coverage == Approx(1.0).margin(0.015));
    CHECK(stroke.rms_error < 0.0003);
  }
}

TEST_CASE("the motion of a character is that of its pen-downs, in metres and seconds", "[practice]") {
  const PracticePage page = page_of("十");
  Pen pen(page);
  std::vector<double> lengths;
  for (int stroke = 0; stroke < 2; ++stroke) {
    const auto [start, end] = ends_of(page, 0, stroke);
    pen.draw(straight(start, end));
    lengths.push_back((end - start).norm());
  }
  const CharacterScore result = pen.scores().front();
  REQUIRE(result.pen_downs.size() == 2);
  const WritingMotion& motion = result.motion;
  CHECK(motion.path_length == Approx(lengths[0] + lengths[1]).epsilon(1e-6));
  CHECK(motion.mean_speed == Approx(1e-3).epsilon(0.02));  // 0.1 mm in a tick of 0.1 s
  CHECK(motion.pen_ups == 1);
  CHECK(motion.time_in_air == Approx(20.0).epsilon(0.02));  // 200 ticks
  CHECK(motion.duration == Approx(motion.time_on_paper + motion.time_in_air));
  CHECK(motion.velocity_peaks == 2);
  CHECK(result.dtw_distance < 1e-4);
  CHECK(result.mean_pressure > 0.0);
  double sum = 0.0;
  int count = 0;
  for (const RecordedSample& sample : pen.recording().samples) {
    if (sample.state == InteractionState::separation) continue;
    sum += sample.force.z();
    ++count;
  }
  CHECK(result.mean_pressure == Approx(sum / count));

  Recording unfelt = pen.recording();
  for (RecordedSample& sample : unfelt.samples) sample.force.setZero();
  CHECK(std::isnan(score_page(page, unfelt).front().mean_pressure));
}

TEST_CASE("the error is over the way of the pen, however far apart its samples are", "[practice]") {
  const PracticePage page = page_of("一");
  const auto [start, end] = ends_of(page, 0, 0);
  const Point across = 0.002 * Point(start.y() - end.y(), end.x() - start.x()).normalized();
  for (const double steps : {10.0, 1000.0}) {
    std::vector<Point> away;  // from 0 to 2 mm beside the stroke: on average 2 mm / sqrt(3)
    for (int i = 0; i <= static_cast<int>(steps); ++i) away.push_back(start + (end - start + across) * i / steps);
    std::vector<Point> back(away.rbegin(), away.rend());
    for (const std::vector<Point>& path : {away, back}) {
      Pen pen(page);
      pen.draw(path);
      CHECK(pen.scores().front().rms_error == Approx(0.002 / std::sqrt(3.0)).epsilon(0.005));
      CHECK(pen.scores().front().max_error == Approx(0.002).epsilon(1e-3));
    }
  }
}

TEST_CASE("the largest error of a character is that of its worst stroke", "[practice]") {
  Pen pen(page_of("十"));
  pen.draw(0, 0, {0.0, 0.002});
  pen.draw(0, 1);
  const CharacterScore result = pen.scores().front();
  CHECK(result.max_error == result.strokes[0].max_error);
  CHECK(result.max_error == Approx(0.002).epsilon(0.02));
}

TEST_CASE("the DTW distance of a stroke is from the stroke as it is to be written", "[practice]") {
  const PracticePage page = page_of("一");
  const auto [start, end] = ends_of(page, 0, 0);
  Pen shifted(page), backwards(page);
  const Point across = 0.002 * Point(start.y() - end.y(), end.x() - start.x()).normalized();
  shifted.draw(straight(start + across, end + across));
  CHECK(shifted.scores().front().dtw_distance == Approx(0.002).epsilon(1e-3));
  CHECK(shifted.scores().front().strokes[0].dtw_distance == Approx(0.002).epsilon(1e-3));
  backwards.draw(straight(end, start));
  CHECK(backwards.scores().front().dtw_distance > 0.25 * (end - start).norm());
}

TEST_CASE("lost samples are left out and counted", "[practice]") {
  const PracticePage page = page_of("永");
  Pen pen(page);
  for (int stroke = 0; stroke < 5; ++stroke) pen.draw(0, stroke, {0.0005, 0.0005});
  const CharacterScore whole = pen.scores().front();
  Recording recording = pen.recording();
  for (const double wrong : {not_measured, std::numeric_limits<double>::infinity()}) {
    for (std::size_t i = 0; i < recording.samples.size(); ++i) {
      if (recording.samples[i].state == InteractionState::separation) continue;
      Recording damaged = recording;
      damaged.samples[i + 10].pen_tip.setConstant(wrong);
      damaged.samples[i + 11].time = wrong;
      const CharacterScore result = score_page(page, damaged).front();
      CHECK(result.lost_samples == 2);
      CHECK(result.rms_error == Approx(whole.rms_error).epsilon(0.01));
      CHECK(result.overall_error == Approx(whole.overall_error).epsilon(0.01));
      CHECK(result.strokes_written == 5);
      break;
    }
  }
}

TEST_CASE("a pen-down is the character's in whose square it lies, whichever the session waited for", "[practice]") {
  Pen pen(page_of("永北"));
  for (const int stroke : {0, 1, 2, 4, 3}) pen.draw(0, stroke);
  pen.draw(1, 0);
  const auto results = pen.scores();
  REQUIRE(results.size() == 2);
  CHECK(results[0].strokes_written == 5);
  CHECK(results[0].match.count(StrokeRemarkKind::extra) == 0);
  CHECK(results[1].strokes_written == 1);
  CHECK(results[1].contour == Approx(0.2).epsilon(1e-3));
  CHECK(results[1].pen_downs.size() == 1);
}

TEST_CASE("pages whose strokes share points but not elements have different numbers", "[practice]") {
  const std::vector<Point> points = {{0.1, 0.5}, {0.3, 0.95}, {0.6, 0.1}, {0.75, 0.9}, {0.9, 0.2}};
  std::vector<std::uint32_t> ids;
  for (const char* elements : {"LC", "CL"}) {
    const StrokeInput input{11, points, {}, ElementList(elements)};
    ids.push_back(page_id({0.1, 0.1, {{make_character(U'\u4e00', std::span(&input, 1)), {{0.01, 0.01}, 0.04}}}}));
  }
  CHECK(ids[0] != ids[1]);
}

TEST_CASE("the number of a page tells what is on it, to a micrometre", "[practice]") {
  const PracticePage page = page_of("永");
  std::vector<PracticePage> others(4, page);
  others[0].characters[0].character.code = U'北';
  others[1].characters[0].character.sequence.stroke_ids[1] += 1;
  others[2].characters[0].character.structure.control_points[3].x() += 5e-5;
  others[3].characters[0].character.structure.control_points[3].y() += 5e-5;
  for (const PracticePage& other : others) CHECK(page_id(other) != page_id(page));
  PracticePage rounded = page;
  for (Point& point : rounded.characters[0].character.structure.control_points) point *= 1.0 + 1e-9;
  CHECK(page_id(rounded) == page_id(page));
}

TEST_CASE("ink on a character that is finished is still that character's", "[practice]") {
  Pen pen(page_of("一二"));
  for (int i = 0; i < 2; ++i) pen.draw(0, 0);
  const auto results = pen.scores();
  CHECK(results[0].match.count(StrokeRemarkKind::extra) == 1);
  CHECK(results[1].pen_downs.empty());
}

TEST_CASE("of characters in the same square, a pen-down belongs to the one that was active", "[practice]") {
  PracticePage page = page_of("一");
  page.characters.push_back(page.characters.front());
  Pen pen(page);
  for (int i = 0; i < 2; ++i) pen.draw(i, 0);
  for (const CharacterScore& score : pen.scores()) CHECK(score.pen_downs.size() == 1);
}

TEST_CASE("a dot that was tapped is as far off as the tap", "[practice]") {
  const PracticePage page = page_of("永");
  const auto [start, end] = ends_of(page, 0, 0);
  Pen pen(page);
  const Point tap = 0.5 * (start + end) + Point(0.0, 0.002);
  pen.draw(straight(tap, tap));
  for (int stroke = 1; stroke < 5; ++stroke) pen.draw(0, stroke);
  const StrokeScore dot = pen.scores().front().strokes[0];
  REQUIRE(dot.pen_down == 0);
  CHECK(dot.rms_error == dot.max_error);
  CHECK(dot.rms_error > 0.001);
  CHECK(dot.coverage < 0.1);
}

TEST_CASE("parts of a stroke that overlap are covered once", "[practice]") {
  const PracticePage page = page_of("十");
  const auto [start, end] = ends_of(page, 0, 0);
  Pen pen(page);
  pen.draw(straight(start, start + 0.6 * (end - start)));
  pen.draw(straight(start + 0.5 * (end - start), start + 0.95 * (end - start)));
  pen.draw(0, 1);
  const CharacterScore result = pen.scores().front();
  REQUIRE(result.match.count(StrokeRemarkKind::broken) == 1);
  CHECK(result.strokes[0].coverage == Approx(0.95).margin(0.02));
}

TEST_CASE("the recording of another page is refused", "[practice]") {
  const PracticePage page = page_of("永");
  Recording recording = write_page(page, session(WriterSkill::skilled(), FeedbackMode::force));
  CHECK(score_page(page, recording).front().strokes_completed == 5);
  CHECK(recording.page == page_id(page));

  PracticePage moved = page, in_millimetres = page;
  moved.characters[0].placement.origin.x() += 1e-6;
  in_millimetres.characters[0].placement = {1e3 * page.characters[0].placement.origin, 40.0};
  PracticePage elsewhere = page;
  elsewhere.characters[0].placement.origin.x() += 0.06;
  const PracticePage other = page_of("水"), shorter = page_of("一"), longer = page_of("永北");
  using Pages = std::vector<const PracticePage*>;
  for (const PracticePage* wrong : Pages{&moved, &in_millimetres, &elsewhere, &other, &shorter, &longer}) {
    CHECK(page_id(*wrong) != page_id(page));
    CHECK_THROWS_AS(score_page(*wrong, recording), ValueError);
  }
  recording.page = 0;  // made by hand, or by an earlier version
  CHECK(score_page(page, recording).front().strokes_completed == 5);
  for (const PracticePage* wrong : Pages{&in_millimetres, &elsewhere, &shorter}) {
    CHECK_THROWS_AS(score_page(*wrong, recording), ValueError);
  }
  Recording back_in_time = recording;
  back_in_time.samples[9].time = 0.001;
  CHECK_THROWS_WITH(score_page(page, back_in_time),
                    "the recording's sample 9: time 0.001 s is before that of a sample before it, 0.008 s");
  Recording wrong = recording;
  wrong.samples[7].stroke = -1;
  CHECK_THROWS_WITH(score_page(page, wrong), "the recording is of another page: sample 7: stroke -1, expected 0 to 5");
  wrong = recording;
  wrong.samples[7].character = 2;
  CHECK_THROWS_WITH(score_page(page, wrong),
                    "the recording is of another page: sample 7: character 2, expected 0 to 1");
  wrong = recording;
  wrong.samples[7].events = wrong.samples[7].events | TickEvent::stroke_finished;
  CHECK_THROWS_WITH(score_page(page, wrong),
                    "the recording is of another page: sample 7: finished stroke -1, expected 0 to 5");
}

TEST_CASE("a recording is of the page on which half of its strokes were finished", "[practice]") {
  const PracticePage page = page_of("永");
  for (const int elsewhere : {2, 3}) {
    Recording recording = write_page(page, session(WriterSkill::skilled(), FeedbackMode::force));
    recording.page = 0;
    int moved = 0;
    for (RecordedSample& sample : recording.samples) {
      if (moved < elsewhere) sample.pen_tip.x() += 0.04;
      moved += has_event(sample.events, TickEvent::stroke_finished) ? 1 : 0;
    }
    CAPTURE(elsewhere);
    if (elsewhere == 2) {
      CHECK(score_page(page, recording).size() == 1);
    } else {
      CHECK_THROWS_AS(score_page(page, recording), ValueError);
    }
  }
}

TEST_CASE("a stroke that the next one decides was finished by the pen-down that wrote it", "[practice]") {
  const PracticePage page = page_of("十");
  const auto [start, end] = ends_of(page, 0, 0);
  const auto [next_start, next_end] = ends_of(page, 0, 1);
  Pen pen(page);
  pen.draw(straight(start, start + 0.8 * (end - start)));
  pen.draw(straight(next_start, next_start + 0.4 * (next_end - next_start)));
  const TickEvent both = TickEvent::stroke_finished | TickEvent::stroke_started;
  const auto& samples = pen.recording().samples;
  REQUIRE(std::any_of(samples.begin(), samples.end(), [&](const auto& sample) { return sample.events == both; }));
  const std::vector<PenDown> downs = pen_downs(pen.recording());
  REQUIRE(downs.size() == 2);
  CHECK(downs[0].finished_stroke);
  CHECK(downs[0].stroke == 0);
  CHECK_FALSE(downs[1].finished_stroke);
  CHECK(downs[1].stroke == 1);
  CHECK(downs[1].captured > 0);
}

TEST_CASE("the time of a character ends where the pen left its last stroke, however late that counts", "[practice]") {
  for (const char* const text : {"十", "十一"}) {
    const PracticePage page = page_of(text);
    const auto [start, end] = ends_of(page, 0, 1);
    Pen pen(page);
    pen.draw(0, 0);
    pen.draw(straight(start, start + 0.8 * (end - start)));
    if (page.characters.size() > 1) pen.draw(1, 0);
    const CharacterScore score = pen.scores().front();
    CAPTURE(text);
    REQUIRE(score.strokes_completed == 2);
    REQUIRE(score.pen_downs.size() == 2);
    const PenKinematics &first = score.pen_downs[0].motion, &last = score.pen_downs[1].motion;
    CHECK(score.time == Approx(last.begin + last.duration - first.begin + 0.1));  // the lift is one tick later
  }
}

TEST_CASE("a recording is of its page wherever the pen was in the air when a stroke was taken for finished",
          "[practice]") {
  const PracticePage page = page_of("一");
  const auto [start, end] = ends_of(page, 0, 0);
  Pen pen(page);
  pen.draw(straight(start, start + 0.8 * (end - start)));
  Recording recording = pen.recording();
  for (RecordedSample& sample : recording.samples) {
    if (sample.state == InteractionState::separation) sample.pen_tip.x() += 0.04;
  }
  CHECK(score_page(page, recording).front().strokes_completed == 1);
}

TEST_CASE("a force that pulls the pen into the paper is no pressure", "[practice]") {
  const PracticePage page = page_of("一");
  const auto [start, end] = ends_of(page, 0, 0);
  Recording recording;
  for (int i = 0; i < 100; ++i) {
    RecordedSample sample;
    sample.time = 1e-3 * i;
    const Point tip = start + (end - start) * i / 99.0;
    sample.pen_tip = {tip.x(), tip.y(), 0.0};
    sample.state = InteractionState::writing;
    sample.force = {0.0, 0.0, i % 2 == 0 ? 1.0 : -1.0};
    recording.samples.push_back(sample);
  }
  CHECK(score_page(page, recording).front().mean_pressure == Approx(0.5));
}

TEST_CASE("a page that the renderer would refuse is refused by its score", "[practice]") {
  PracticePage page = page_of("永");
  page.characters[0].placement.em = 0.0;
  CHECK_THROWS_AS(score_page(page, Recording()), ValueError);
  CHECK(score_page(PracticePage(), Recording()).empty());
}
