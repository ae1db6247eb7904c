// What the guidance does to a pen, and what it takes for the due stroke: a few of the cases of guidance_judge, which
// runs thousands.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <calligraphy/base/text.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_set.hpp>

#include "catch.hpp"
#include "package_data.hpp"
#include "pairs.hpp"
#include "pens_of_tests.hpp"
#include "people.hpp"
#include "releases.hpp"
#include "sequence.hpp"
#include "stages.hpp"
#include "stroke_line.hpp"
#include "wrong_end.hpp"

namespace calligraphy_test {
namespace {

using namespace calligraphy;

constexpr std::size_t most_characters = 1000;
constexpr int pair_count = 160, release_count = 400;
const std::vector<double> sizes = {0.01, 0.02, 0.04};

std::vector<Character> characters() {
  std::vector<Character> all = built_in_characters().characters;
  all.resize(std::min(all.size(), most_characters));
  return all;
}

SequenceOptions on(const std::string& device, double em) {
  SequenceOptions options;
  options.device = device_profile(device);
  options.renderer = RendererOptions::for_device(options.device);
  options.em = em;
  return options;
}

std::string list(const SequenceResult& result) {
  std::string text = std::to_string(result.taken.count) + " of " + std::to_string(result.taken.of) + " taken; ";
  for (std::size_t i = 0; i < std::min<std::size_t>(8, result.findings.size()); ++i) {
    const Finding& finding = result.findings[i];
    text += encode_utf8(finding.character) + " stroke " + std::to_string(finding.stroke + 1) +
            (finding.attempt >= 0 ? " attempt " + std::to_string(finding.attempt + 1) : "") + ", ";
  }
  return text;
}

struct Waves {
  double lowest = 0.0, highest = 0.0;  ///< [m]
  int downward = 0;                    ///< passages through the line, where the pen goes to the right of it
};

/// Of a line about the x axis.
Waves waves_of(const StrokeLine& line) {
  Waves waves;
  double last = 0.0;
  for (const Point& point : line.points()) {
    waves.lowest = std::min(waves.lowest, point.y());
    waves.highest = std::max(waves.highest, point.y());
    if (std::abs(point.y()) < 1e-6) continue;
    waves.downward += last > 0.0 && point.y() < 0.0;
    last = point.y();
  }
  return waves;
}

/// At most a share [%] of the attempts is taken for a due stroke, and each due stroke itself is.
void check_hardly_taken(double em, const Attempts& attempts, double most) {
  const SequenceResult result = judge_attempts(characters(), on("desktop", em), attempts);
  INFO("em " << 1e3 * em << " mm: " << list(result));
  CHECK(result.taken.of > 0);
  CHECK(result.tries.percent() <= most);
  CHECK(result.not_finished_exactly == 0);
}

double quarter_circle_error(double x, double y) {
  // 4/3 (sqrt 2 - 1): the cubic is within 3e-4 of the circle.
  constexpr double k = 0.5522847498;
  StrokeInput input{7, {}, {}};
  for (const TypicalStroke& type : typical_strokes()) {
    if (type.elements == "C") input.id = type.id;
  }
  input.control_points = {{0.0, 1.0}, {k, 1.0}, {1.0, k}, {1.0, 0.0}};
  const PlacedCharacter placed{make_character(U'一', std::span(&input, 1)), {Point::Zero(), 1.0}};
  return stroke_lines(placed).front().distance(Point(x, y));
}

}  // namespace

TEST_CASE("the judge: the distance from a quarter of a circle is that of geometry, beyond its ends too", "[guidance]") {
  CHECK(quarter_circle_error(0.0, 0.0) == Approx(1.0).epsilon(1e-3));
  CHECK(quarter_circle_error(0.9, 1.2) == Approx(0.5).epsilon(1e-3));
  CHECK(quarter_circle_error(1.3, -0.4) == Approx(0.5).epsilon(1e-3));
  CHECK(quarter_circle_error(-0.4, 1.3) == Approx(0.5).epsilon(1e-3));
}

TEST_CASE("the judge: parts and zigzags of a line are where they should be", "[guidance]") {
  const StrokeLine line({{0.0, 0.0}, {0.03, 0.0}, {0.03, 0.01}});
  CHECK(line.part(0.5, 1.0).length() == Approx(0.02));
  CHECK(line.part(0.25, 0.75).at(0.0).x() == Approx(0.01));
  CHECK(mean_distance(line, line.moved([](const Point& point, double) { return Point(point + Point(3e-3, 4e-3)); })) ==
        Approx(0.005));
  const StrokeLine straight(std::vector<Point>{{0.0, 0.0}, {0.03, 0.0}});
  for (const bool sine : {false, true}) {
    const StrokeLine zigzag = zigzag_about(straight, {0.1, 0.2, sine, true}, 0.04);
    const Waves waves = waves_of(zigzag);
    CHECK(zigzag.at(0.0).y() == Approx(0.004));
    CHECK(waves.lowest == Approx(-0.004).epsilon(0.01));
    CHECK(waves.highest == Approx(0.004).epsilon(0.01));
  }
}

TEST_CASE("the judge: tremors and loops go as far aside, and as often, as they should", "[guidance]") {
  constexpr double em = 0.04;
  Random random(1);
  const StrokeLine dot(std::vector<Point>{{0.0, 0.0}, {0.15 * em, 0.0}});
  const StrokeLine line(std::vector<Point>{{0.0, 0.0}, {0.5 * em, 0.0}});
  const std::vector<Attempt> drawn = tremors(em)({dot}, 0, random);
  REQUIRE(drawn.size() == 6);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Waves waves = waves_of(drawn[i].line);
    const double amplitude = (0.02 + 0.01 * static_cast<double>(i / 2)) * em;
    CHECK(waves.lowest == Approx(-amplitude).epsilon(0.01));
    CHECK(waves.highest == Approx(amplitude).epsilon(0.01));
    CHECK(waves.downward == (i % 2 == 0 ? 5 : 3));  // 0.15 em over 0.03 and 0.05 em
  }
  for (const bool clockwise : {false, true}) {
    const StrokeLine loops = loops_along(line, 0.05, clockwise, em);
    const Waves waves = waves_of(loops);
    CHECK(waves.lowest == Approx(-0.05 * em).epsilon(0.01));
    CHECK(waves.highest == Approx(0.05 * em).epsilon(0.01));
    CHECK((loops.at(loops.length()) - loops.at(0.0)).isApprox(Point(0.5 * em, 0.0)));
    CHECK(loops.length() > 5 * 0.314 * em);  // five circles, and on the way
    const double first_way = loops.points()[12].y();  // after a quarter of the first loop
    CHECK((clockwise ? first_way < 0.0 : first_way > 0.0));
  }
  CHECK(tremors(em)({line}, 0, random).empty());
  CHECK(circling(em, true)({line}, 0, random).empty());
  CHECK(circling(em, true)({dot}, 0, random).size() == 4);
  CHECK(circling(em, false)({line}, 0, random).size() == 4);
}

TEST_CASE("the judge: a person's pen is laid on a character by one translation and one scale", "[guidance]") {
  const PracticePage page = page_of(built_in_characters().at(U'永'), 0.04);
  const std::vector<StrokeLine> strokes = stroke_lines(page.characters.front());
  const auto pen = [&](double scale_x, double scale_y) {
    std::vector<PenPath> paths;
    for (const StrokeLine& stroke : strokes) {
      const auto path = stroke.moved([&](const Point& point, double) {
        return Point(scale_x * point.x() - 3.0, scale_y * point.y() + 0.5);
      });
      paths.push_back(path.points());
    }
    return laid_on(strokes, paths);
  };
  const std::vector<StrokeLine> copied = pen(12.0, 12.0), wide = pen(24.0, 12.0);
  double off = 0.0;
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    CHECK(mean_distance(copied[k], strokes[k]) < 1e-12);
    const Point way = strokes[k].at(strokes[k].length()) - strokes[k].at(0.0);
    const Point laid = wide[k].at(wide[k].length()) - wide[k].at(0.0);
    CHECK(laid.x() * way.y() == Approx(2.0 * laid.y() * way.x()));
    off = std::max(off, mean_distance(wide[k], strokes[k]));
  }
  CHECK(off > 1e-3);
}

TEST_CASE("force hardly ever takes a pen more than 2 mm farther from the stroke that is meant than vision, never 4 mm",
          "[guidance]") {
  for (const std::string device : {"desktop", "omni"}) {
    PairOptions options;
    options.device = device_profile(device);
    options.renderer = RendererOptions::for_device(options.device);
    int failed = 0, count = 0;
    for (const CharacterPair& character : write_pairs(characters(), 1, pair_count, options)) {
      for (const StrokePair& pair : character.strokes()) {
        INFO(device << ": " << encode_utf8(pair.character) << " seed " << pair.seed << " stroke " << pair.stroke + 1
                    << ": " << 1e3 * pair.force.largest_error << " mm, with vision "
                    << 1e3 * pair.vision.largest_error);
        CHECK(pair.force.largest_error - pair.vision.largest_error < 0.004);
        failed += pair.fails();
        ++count;
      }
    }
    CAPTURE(device, count);
    CHECK(failed <= 2);  // of 719 pairs; 1 to 7 of 5,000 in the program's run
  }
}

TEST_CASE("guidance that lets go of a pen gives it no speed that its twin, still held, has not", "[guidance]") {
  std::size_t released = 0;
  const auto events = run_releases(1, release_count, 0);
  for (std::size_t i = 0; i < events.size(); ++i) {
    for (const ReleaseEvent& event : events[i]) {
      INFO(describe(draw_release(1, static_cast<int>(i))) << ": " << release_names[static_cast<std::size_t>(event.kind)]
                                                          << " at " << event.force << " N: " << event.excess << " m/s");
      CHECK_FALSE(event.fails());
      ++released;
    }
  }
  CHECK(released > static_cast<std::size_t>(release_count) / 5);
}

TEST_CASE("a later stroke is not taken for the due one where they differ", "[guidance]") {
  for (const double em : sizes) {
    const SequenceResult result = judge_attempts(characters(), on("desktop", em), later_strokes(em));
    INFO("em " << 1e3 * em << " mm: " << list(result));
    CHECK(result.taken.of > 0);
    CHECK(result.taken.percent() <= 0.5);
    CHECK(result.not_finished_exactly == 0);
  }
}

TEST_CASE("half a stroke does not finish it, whichever half", "[guidance]") {
  for (const double em : sizes) {
    check_hardly_taken(em, part_of_stroke(0.0, 0.5), 0.0);
    check_hardly_taken(em, part_of_stroke(0.5, 1.0), 0.0);
    check_hardly_taken(em, part_of_stroke(0.25, 0.75), 0.0);
  }
}

TEST_CASE("a zigzag of 10 % of the em about a stroke hardly ever finishes it, its chord never", "[guidance]") {
  for (const double em : sizes) {
    for (const bool sine : {false, true}) check_hardly_taken(em, zigzags(em, 0.1, sine), 0.5);
    if (em > 0.01) check_hardly_taken(em, chord(em), 0.0);  // on 10 mm friction hides a hook
  }
}

TEST_CASE("strokes as people draw them finish at the first touch on every device, with force and without",
          "[guidance]") {
  const PeopleDraw people{0.05, Noise::displacement, 0.02, 0.0};
  for (const Capabilities& device : device_profiles()) {
    for (const double em : sizes) {
      for (const bool feels : {true, false}) {
        SequenceOptions options = on(device.name, em);
        options.held = true;
        options.feels = feels;
        const SequenceResult result = judge_people(characters(), options, people);
        CAPTURE(device.name, em, feels, result.taken.count, result.taken.of);
        CHECK(result.taken.percent() >= (feels ? 99.0 : 98.0));
      }
    }
  }
}

TEST_CASE("strokes that people distort by 2 and 3 % of the em finish at the first touch", "[guidance]") {
  for (const std::string device : {"ideal", "desktop", "omni"}) {
    for (const double em : {0.02, 0.04}) {
      SequenceOptions options = on(device, em);
      for (const double noise : {0.02, 0.03}) {
        CAPTURE(device, em, noise);
        const PeopleDraw people{0.05, Noise::distortion, noise};
        const double least = noise > 0.02 ? 95.0 : 98.0;
        CHECK(judge_people(characters(), options, people).taken.percent() >= least);
        if (device == "ideal") continue;
        options.held = true;
        CHECK(judge_people(characters(), options, people).taken.percent() >= least);
        options.held = false;
      }
    }
  }
}

TEST_CASE("strokes of people, as they wrote them, begin at the first touch, and finish there or with the next", "[guidance]") {
  const auto written = people();
  if (!written) return;
  Share begun, finished, with_next;
  for (const FirstTouch& touch : draw_people(written->pens, on("ideal", 0.04))) {
    begun.add(touch.begun);
    finished.add(touch.at_lift);
    with_next.add(touch.with_next);
  }
  CAPTURE(begun.count, finished.count, with_next.count, begun.of);
  CHECK(begun.of > 500);
  CHECK(begun.percent() >= 99.0);
  CHECK(finished.percent() >= 90.0);
  CHECK(with_next.percent() >= 94.0);
}

TEST_CASE("every stroke of every imported character is finished by a pen that draws it exactly, with every preset",
          "[guidance]") {
  const auto file = package_data("CALLIGRAPHY_CHARACTER_FILE");
  if (file.empty()) return;
  const std::vector<Character> imported = CharacterSet::open(file.string()).list().characters;
  const auto nothing_else = [](const std::vector<StrokeLine>&, std::size_t, Random&) { return std::vector<Attempt>(); };
  CHECK(imported.size() == 9574);
  for (const StrokeTolerances& tolerances :
       {StrokeTolerances::normal(), StrokeTolerances::lenient(), StrokeTolerances::strict()}) {
    SequenceOptions options = on("desktop", 0.04);
    options.renderer.tolerances = tolerances;
    std::vector<Character> some;  // of the other presets an eighth: all take half a minute each
    const std::size_t apart = tolerances == StrokeTolerances::normal() ? 1 : 8;
    for (std::size_t i = 0; i < imported.size(); i += apart) some.push_back(imported[i]);
    const SequenceResult result = judge_attempts(some, options, nothing_else);
    INFO(list(result));
    CHECK(result.not_finished_exactly == 0);
  }
}

TEST_CASE("everything() finishes as many characters as vision and reduces the error as much as the default",
          "[guidance]") {
  for (const std::string name : {"desktop", "omni"}) {
    for (const double em : {0.04}) {
      int vision = 0, everything = 0;
      ClusteredMean more_error;  // than the default, as a share of the error with vision
      for (const StagesRun& run : write_with_stages(characters(), 3, device_profile(name), em, 0)) {
        vision += run.vision.finished();
        everything += run.everything.finished();
        const double difference = run.everything.score.rms_error - run.standard.score.rms_error;
        more_error.add(run.seed, difference / run.vision.score.rms_error);
      }
      CAPTURE(name, em, vision, everything);
      CHECK(everything >= vision);
      CHECK(more_error.mean() < 0.01);
      CHECK(more_error.mean() - more_error.half_width() <= 0.0);
    }
  }
}

TEST_CASE("everything() hardly ever takes a pen farther from the stroke that is meant either", "[guidance]") {
  for (const std::string device : {"desktop", "omni"}) {
    PairOptions options;
    options.device = device_profile(device);
    options.renderer = RendererOptions::everything(options.device);
    int failed = 0;
    for (const CharacterPair& character : write_pairs(characters(), 1, pair_count, options)) {
      for (const StrokePair& pair : character.strokes()) {
        INFO(device << ": " << encode_utf8(pair.character) << " seed " << pair.seed << " stroke " << pair.stroke + 1);
        CHECK(pair.excess() < 0.004);
        failed += pair.fails();
      }
    }
    CAPTURE(device);
    CHECK(failed <= 2);
  }
}

TEST_CASE("a stroke that is written from its end is resisted, by default and with everything()", "[guidance]") {
  const std::vector<Character> first = with_strokes(characters(), 65);
  for (const std::string device : {"desktop", "omni"}) {
    for (const bool everything : {false, true}) {
      SequenceOptions options = on(device, 0.04);
      if (everything) options.renderer = RendererOptions::everything(options.device);
      std::string others;
      Share resisted;
      for (const WrongEnd& stroke : draw_from_wrong_end(first, options)) {
        resisted.add(stroke.resisted());
        CHECK_FALSE(stroke.taken);
        if (!stroke.resisted()) others += encode_utf8(stroke.character) + " " + std::to_string(stroke.stroke + 1) + " ";
      }
      CAPTURE(device, everything, others);
      CHECK(resisted.of == 65);
      CHECK(resisted.count >= 60);
    }
  }
}

}  // namespace calligraphy_test
