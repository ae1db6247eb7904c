// The instruments of stroke_judge, which do not know match_strokes(): which pens are right, and what is done to them;
// and the marks that match_strokes() keeps by them.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/model/character_list.hpp>

#include "cases.hpp"
#include "catch.hpp"
#include "guidance/statistics.hpp"
#include "judge/judge_constants.hpp"
#include "judge/pen_traces.hpp"
#include "named_constants.hpp"
#include "other_characters.hpp"
#include "pens_of_tests.hpp"
#include "polyline.hpp"

namespace calligraphy_test {
namespace {

using namespace calligraphy;

constexpr std::uint64_t seeds = 3;

std::vector<RightPen> copies() {
  std::vector<RightPen> pens;
  for (const Character& character : built_in_characters().characters) {
    pens.push_back({"copy", character, copy_of(character)});
  }
  return pens;
}

double length_of(const std::vector<PenPath>& paths) {
  double sum = 0.0;
  for (const PenPath& path : paths) sum += path_length(path);
  return sum;
}

/// Calls check(pen, corrupted) for each copy of a built-in character that can have the fault, with several seeds.
template <typename Check>
void check_each(const std::string& row, const Check& check, StrokeClass stroke_class = StrokeClass::any) {
  int count = 0;
  for (const RightPen& pen : copies()) {
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const auto corrupted = corrupt(pen, corruption_named(row), seed, stroke_class);
      if (!corrupted) continue;
      CAPTURE(encode_utf8(pen.character.code), row, seed, describe(corrupted->truths.front()));
      check(pen, *corrupted);
      ++count;
    }
  }
  CHECK(count > 0);
}

/// The first pen-down that is not as the pen drew it.
std::size_t first_change(const RightPen& pen, const Corrupted& corrupted) {
  const auto [was, is] =
      std::mismatch(pen.paths.begin(), pen.paths.end(), corrupted.paths.begin(), corrupted.paths.end());
  return static_cast<std::size_t>(was - pen.paths.begin());
}

MatchResult result_of(const Truth& truth) {
  MatchResult match;
  for (const Written& each : truth.written) {
    match.drawn.push_back({each.stroke, each.stroke_count, each.continues});
    match.drawn.back().also = each.also;
  }
  for (const Due& due : truth.due()) {
    const bool extra = due.kind == StrokeRemarkKind::extra;
    match.remarks.push_back({.kind = due.kind, .path = extra ? due.of : -1, .stroke = extra ? -1 : due.of});
  }
  if (truth.is_moved()) match.remarks.push_back({.path = 0, .stroke = truth.first_moved});
  return match;
}

}  // namespace

TEST_CASE("a path is cut and sampled at shares of its length", "[judge]") {
  const PenPath path = {{0.0, 0.0}, {0.3, 0.0}, {0.3, 0.1}};
  CHECK(point_at(path, 0.5).x() == Approx(0.2));
  CHECK(point_at(path, 0.875).y() == Approx(0.05));
  CHECK(point_at(path, 0.0) == path.front());
  CHECK(point_at(path, 1.0) == path.back());
  const auto [first, second] = cut(path, 0.25);
  CHECK(path_length(first) == Approx(0.1));
  CHECK(path_length(second) == Approx(0.3));
  CHECK(first.back() == second.front());
}

TEST_CASE("the copy of every built-in character is a right pen, also elsewhere and of another size", "[judge]") {
  for (const RightPen& pen : copies()) {
    CAPTURE(encode_utf8(pen.character.code));
    CHECK(is_right(pen.character, pen.paths));
    std::vector<PenPath> paths = pen.paths;
    for (PenPath& path : paths) {
      for (Point& point : path) point = Point(0.3, -0.2) + 0.5 * point;
    }
    CHECK(is_right(pen.character, paths));
  }
}

TEST_CASE("a pen with two strokes swapped, one reversed, missing, broken or extra is not right", "[judge]") {
  for (const std::string row : {"swap", "adjacent", "drop", "split", "join", "extra", "block"}) {
    check_each(row, [](const RightPen& pen, const Corrupted& corrupted) {
      CHECK_FALSE(is_right(pen.character, corrupted.paths));
    });
  }
  check_each("reverse", [](const RightPen& pen, const Corrupted& corrupted) {
    const PenPath& line = pen.paths[first_change(pen, corrupted)];
    if (chord(line) < 0.6 * path_length(line)) return;  // copies differ from strokes by less
    CHECK_FALSE(is_right(pen.character, corrupted.paths));
  });
}

TEST_CASE("the simulated writer writes most characters right", "[judge]") {
  std::vector<Character> some = spread_over(CharacterSet(built_in_characters()), 12);
  REQUIRE(some.size() == 12);
  CHECK(std::set<char32_t>{some.front().code, some.back().code}.size() == 2);
  const std::vector<RightPen> pens = written_pens(some, 1, 0);
  CHECK(pens.size() >= 8);
  for (const RightPen& pen : pens) CHECK(is_right(pen.character, pen.paths));
}

TEST_CASE("every corruption is the same with the same seed, and its truth has one entry for each pen-down", "[judge]") {
  for (const Corruption& row : corruptions()) {
    check_each(row.name, [&](const RightPen& pen, const Corrupted& corrupted) {
      for (const Truth& truth : corrupted.truths) {
        CHECK(truth.written.size() == corrupted.paths.size());
        CHECK((row.is_clean() == (truth.due().empty() && !truth.is_moved())));
        std::vector<int> times(pen.paths.size());
        for (const int stroke : truth.missing) ++times[static_cast<std::size_t>(stroke)];
        for (const Written& each : truth.written) {
          for (int i = 0; i < each.stroke_count && !each.continues; ++i) {
            ++times[static_cast<std::size_t>(each.stroke + i)];
          }
          if (each.also >= 0) ++times[static_cast<std::size_t>(each.also)];
        }
        CHECK(std::all_of(times.begin(), times.end(), [](int count) { return count == 1; }));
      }
    });
    const Character& country = built_in_characters().at(U'国');
    const RightPen pen{"copy", country, copy_of(country)};
    const auto one = corrupt(pen, row, 7), other = corrupt(pen, row, 7), another = corrupt(pen, row, 8);
    REQUIRE(one.has_value());
    CHECK(one->paths == other->paths);
    if (row.deviation.is_random()) CHECK(one->paths != another->paths);
  }
}

TEST_CASE("a dropped stroke is gone, a split one is whole together, a reversed one has changed its ends", "[judge]") {
  check_each("drop", [](const RightPen& pen, const Corrupted& corrupted) {
    CHECK(corrupted.paths.size() + 1 == pen.paths.size());
    const std::size_t gone = first_change(pen, corrupted);
    CHECK(corrupted.truths.front().missing == std::vector<int>{static_cast<int>(gone)});
  });
  check_each("split", [](const RightPen& pen, const Corrupted& corrupted) {
    CHECK(corrupted.paths.size() == pen.paths.size() + 1);
    CHECK(length_of(corrupted.paths) == Approx(length_of(pen.paths)));
    const std::size_t at = first_change(pen, corrupted);
    const double whole = path_length(pen.paths[at]), first = path_length(corrupted.paths[at]);
    CHECK(whole >= 0.2);
    CHECK(first / whole >= 0.35);
    CHECK(first / whole <= 0.65);
    CHECK(corrupted.truths.front().written[at + 1].continues);
  });
  check_each("split-3", [](const RightPen& pen, const Corrupted& corrupted) {
    CHECK(corrupted.paths.size() == pen.paths.size() + 2);
    CHECK(length_of(corrupted.paths) == Approx(length_of(pen.paths)));
    const std::size_t at = first_change(pen, corrupted);
    const double whole = path_length(pen.paths[at]);
    CHECK(whole >= 0.3);
    for (std::size_t part = at; part < at + 3; ++part) CHECK(path_length(corrupted.paths[part]) >= 0.24 * whole);
    CHECK(corrupted.truths.front().written[at + 2].continues);
  });
  check_each("reverse", [](const RightPen& pen, const Corrupted& corrupted) {
    const std::size_t at = first_change(pen, corrupted);
    CHECK(corrupted.paths[at].front() == pen.paths[at].back());
    CHECK(corrupted.paths[at].back() == pen.paths[at].front());
    CHECK(corrupted.truths.front().written[at].backwards);
  });
}

TEST_CASE("swapped strokes and a block are where the truth says, and nothing else has moved", "[judge]") {
  for (const std::string row : {"swap", "adjacent", "block"}) {
    check_each(row, [&](const RightPen& pen, const Corrupted& corrupted) {
      const Truth& truth = corrupted.truths.front();
      int moved = 0;
      for (std::size_t i = 0; i < corrupted.paths.size(); ++i) {
        const int stroke = truth.written[i].stroke;
        CHECK(corrupted.paths[i] == pen.paths[static_cast<std::size_t>(stroke)]);
        if (stroke == static_cast<int>(i)) continue;
        ++moved;
        CHECK(stroke >= truth.first_moved);
        CHECK(stroke <= truth.last_moved);
      }
      CHECK(moved >= (row == "block" ? 3 : 2));
      if (row != "block") CHECK(moved == 2);
      if (row == "adjacent") CHECK(truth.last_moved == truth.first_moved + 1);
    });
  }
}

TEST_CASE("a joined stroke goes on to the next one, an extra one is straight and within the square", "[judge]") {
  check_each("join", [](const RightPen& pen, const Corrupted& corrupted) {
    const std::size_t at = first_change(pen, corrupted);
    CHECK(corrupted.paths[at].front() == pen.paths[at].front());
    CHECK(corrupted.paths[at].back() == pen.paths[at + 1].back());
    const double between = (pen.paths[at + 1].front() - pen.paths[at].back()).norm();
    CHECK(length_of(corrupted.paths) == Approx(length_of(pen.paths) + between));
  });
  check_each("join-apart", [](const RightPen& pen, const Corrupted& corrupted) {
    const auto& written = corrupted.truths.front().written;
    const auto joins = [](const Written& each) { return each.also >= 0; };
    const auto at = std::find_if(written.begin(), written.end(), joins);
    REQUIRE(at != written.end());
    const PenPath& joined = corrupted.paths[static_cast<std::size_t>(at - written.begin())];
    const PenPath &one = pen.paths[static_cast<std::size_t>(at->stroke)],
                  &other = pen.paths[static_cast<std::size_t>(at->also)];
    CHECK(at->also != at->stroke + 1);
    CHECK((joined.front() == one.front() && joined.back() == other.back()));
    CHECK(path_length(joined) <= path_length(one) + path_length(other) + 0.1);
  });
  check_each("extra", [](const RightPen& pen, const Corrupted& corrupted) {
    const PenPath& extra = corrupted.paths[first_change(pen, corrupted)];
    CHECK(path_length(extra) == Approx(chord(extra)));
    CHECK(chord(extra) >= 0.2);
    CHECK(chord(extra) <= 0.5);
    CHECK(Box(Point(0.0, 0.0), Point(1.0, 1.0)).contains(box_of(extra)));
  });
  check_each("twice", [](const RightPen& pen, const Corrupted& corrupted) {
    const std::size_t second = first_change(pen, corrupted);
    const PenPath& first = pen.paths[second - 1];
    CHECK((corrupted.paths[second].front() - first.front()).norm() == Approx(0.03));
    CHECK((corrupted.paths[second].back() - first.back()).norm() == Approx(0.03));
    CHECK(corrupted.truths.size() == 2);
  });
}

TEST_CASE("a turned stroke is turned by a right angle about its centre", "[judge]") {
  check_each("turned", [](const RightPen& pen, const Corrupted& corrupted) {
    const std::size_t at = first_change(pen, corrupted);
    const PenPath &before = pen.paths[at], &after = corrupted.paths[at];
    const Point was = before.back() - before.front(), is = after.back() - after.front();
    CHECK(std::abs(was.dot(is)) < 1e-12);
    CHECK(is.norm() == Approx(was.norm()));
    CHECK((box_of(before).center() - box_of(after).center()).norm() < 1e-12);
  });
}

TEST_CASE("points and pen-downs are displaced with the standard deviation of the row", "[judge]") {
  const auto spread = [](const std::string& row, bool each_point) {
    double square = 0.0;
    int count = 0;
    check_each(row, [&](const RightPen& pen, const Corrupted& corrupted) {
      for (std::size_t i = 0; i < pen.paths.size(); ++i) {
        const std::size_t points = each_point ? pen.paths[i].size() : 1;
        for (std::size_t k = 0; k < points; ++k) {
          square += (corrupted.paths[i][k] - pen.paths[i][k]).squaredNorm();
          count += 2;
        }
      }
    });
    return std::sqrt(square / count);
  };
  CHECK(spread("jitter-1", true) == Approx(0.01).epsilon(0.02));
  CHECK(spread("jitter-2", true) == Approx(0.02).epsilon(0.02));
  CHECK(spread("displaced-5", false) == Approx(0.05).epsilon(0.1));
  CHECK(spread("displaced-8", false) == Approx(0.08).epsilon(0.1));
}

TEST_CASE("a shift, a scale, a rotation and a shear are what their rows say", "[judge]") {
  const RightPen pen = copies().front();
  const auto line = [&](const std::string& row) {
    RightPen across = pen;
    across.paths = {{{0.5, 0.5}, {0.5, 1.0}}};
    const PenPath path = corrupt(across, corruption_named(row), 1)->paths.front();
    return std::pair(path.front(), Point(path.back() - path.front()));
  };
  CHECK((line("shift-15").first - Point(0.5, 0.5)).norm() == Approx(0.15));
  CHECK(line("scale-0.6").second.y() == Approx(0.3));
  CHECK(line("rotation+25").second.norm() == Approx(0.5));
  CHECK(line("rotation+25").second.x() == Approx(-0.5 * 0.4226182617));
  CHECK(line("rotation-25").second.x() == Approx(0.5 * 0.4226182617));
  CHECK(line("shear+25").second.x() == Approx(0.5 * 0.4663076582));
  CHECK(line("shear-25").second.y() == Approx(0.5));
}

TEST_CASE("a class run chooses strokes of that class alone", "[judge]") {
  for (const StrokeClass stroke_class : {StrokeClass::dots, StrokeClass::hooks, StrokeClass::parallel}) {
    const auto is_member = [&](const RightPen& pen, int stroke) {
      return static_cast<bool>(members(pen.character, stroke_class)[static_cast<std::size_t>(stroke)]);
    };
    check_each(
        "drop",
        [&](const RightPen& pen, const Corrupted& corrupted) {
          CHECK(is_member(pen, corrupted.truths.front().missing.front()));
        },
        stroke_class);
    check_each(
        "adjacent",
        [&](const RightPen& pen, const Corrupted& corrupted) {
          const Truth& truth = corrupted.truths.front();
          CHECK((is_member(pen, truth.first_moved) || is_member(pen, truth.last_moved)));
        },
        stroke_class);
  }
}

TEST_CASE("hengs are parallel where one lies within a quarter of the em beside another", "[judge]") {
  const auto with_other = [](const Point& from, const Point& to) {
    const std::vector<StrokeInput> two = {{1, {{0.1, 0.5}, {0.5, 0.5}}}, {1, {from, to}}};
    return members(make_character(U'二', two), StrokeClass::parallel);
  };
  CHECK(with_other({0.2, 0.7}, {0.4, 0.7}) == std::vector<bool>{true, true});
  CHECK(with_other({0.1, 0.8}, {0.5, 0.8}) == std::vector<bool>{false, false});
  CHECK(with_other({0.6, 0.5}, {0.9, 0.5}) == std::vector<bool>{false, false});
}

TEST_CASE("the truth is told exactly by a result that says it, and by no other", "[judge]") {
  for (const Corruption& row : corruptions()) {
    check_each(row.name, [](const RightPen&, const Corrupted& corrupted) {
      for (const Truth& truth : corrupted.truths) {
        const MatchResult match = result_of(truth);
        CHECK(tells(match, truth));
        MatchResult more = match;
        more.remarks.push_back({.kind = StrokeRemarkKind::missing, .stroke = 0});
        CHECK_FALSE(tells(more, truth));
        if (!match.remarks.empty()) {
          MatchResult less = match;
          less.remarks.pop_back();
          CHECK_FALSE(tells(less, truth));
        }
        MatchResult misread = match;
        misread.drawn.back().stroke = misread.drawn.back().stroke < 0 ? 0 : -1;
        CHECK_FALSE(tells(misread, truth));
      }
    });
  }
}

TEST_CASE("a remark of order on a stroke that has not moved does not tell the truth", "[judge]") {
  check_each("adjacent", [](const RightPen&, const Corrupted& corrupted) {
    const Truth& truth = corrupted.truths.front();
    MatchResult match = result_of(truth);
    CHECK(tells(match, truth));
    match.remarks.back() = {.path = 0, .stroke = truth.last_moved + 1};
    CHECK_FALSE(tells(match, truth));
    match.remarks.back() = {.path = 0, .stroke = truth.last_moved};
    CHECK(tells(match, truth));
    match.remarks.push_back(match.remarks.back());  // a second remark on the same fault
    CHECK_FALSE(tells(match, truth));
  });
}

TEST_CASE("the copy of a character is told where another one was asked for, and not where it was itself", "[judge]") {
  const CharacterSet set(built_in_characters());
  const CharacterIndex index(set);
  const std::vector<std::vector<RightPen>> sources = {copies()};
  const std::vector<OtherCase> cases = cases_of_another(sources, set, 40, 1);
  CHECK(cases.size() == 40);
  const std::vector<OtherOutcome> outcomes = judge_others(cases, {}, index, 0);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Character& written = cases[i].pen->character;
    CAPTURE(encode_utf8(written.code), encode_utf8(cases[i].asked_for.code), outcomes[i].text);
    CHECK(written.code != cases[i].asked_for.code);
    CHECK(strokes(written).size() == strokes(cases[i].asked_for).size());
    CHECK(outcomes[i].exact);
    CHECK(outcomes[i].named == written.code);
  }
  std::vector<OtherCase> right;
  for (const RightPen& pen : sources.front()) right.push_back({&pen, pen.character});
  for (const OtherOutcome& outcome : judge_others(right, {}, index, 0)) {
    CHECK_FALSE(outcome.exact);
    CHECK(outcome.named == 0);
  }
}

TEST_CASE("another character is drawn anew with another seed", "[judge]") {
  const CharacterSet set(built_in_characters());
  const std::vector<std::vector<RightPen>> sources = {copies()};
  const auto asked_for = [&](std::uint64_t seed) {
    std::u32string codes;
    for (const OtherCase& each : cases_of_another(sources, set, 40, seed)) codes += each.asked_for.code;
    return codes;
  };
  CHECK(asked_for(1) == asked_for(1));
  CHECK(asked_for(1) != asked_for(2));
}

namespace {

/// 土 and 士: a cross on a base line, `upper` is the width of the cross [em].
Character cross_on_a_line(char32_t code, double upper) {
  const auto heng = [](double width, double y) {
    return StrokeInput{1, {Point(0.5 - width / 2.0, y), Point(0.5 + width / 2.0, y)}};
  };
  const std::vector<StrokeInput> strokes = {
      heng(upper, 0.6), {2, {Point(0.5, 0.95), Point(0.5, 0.1)}}, heng(1.2 - upper, 0.1)};
  return make_character(code, strokes);
}

}  // namespace

TEST_CASE("every pen of a twin meets every form of the other, and a note of a lookalike is exact", "[judge]") {
  const Twins twins(U'土', U'士');
  const Character earth = cross_on_a_line(twins.first, 0.45);
  const std::vector<RightPen> pens(2, {"copy", earth, copy_of(earth)});
  for (const auto& [upper, told] : {std::pair{0.75, "proportion 土"}, {0.5, "lookalike 土"}}) {
    const CharacterSet scholar(CharacterList{{}, {cross_on_a_line(twins.second, upper)}});
    const CharacterSet layers[] = {CharacterSet(CharacterList{{}, {earth}}), scholar, scholar};
    const CharacterSet set = CharacterSet::layered(layers);
    const CharacterIndex index(set);
    CHECK(forms_of_twins(set, 2).size() == 6);
    const std::vector<OtherCase> cases = cases_of_twins(pens, set, twins);
    CHECK(cases.size() == 4);
    for (const OtherOutcome& outcome : judge_others(cases, {}, index, 0)) {
      CAPTURE(outcome.text);
      CHECK(outcome.exact);
      CHECK(outcome.named == twins.first);
      CHECK(outcome.text.ends_with(told));
    }
    const Pairs pairs = count_pairs(index, 0);
    CHECK(pairs.all == 1);
    CHECK(pairs.lookalikes == (upper == 0.5 ? 1 : 0));
  }
}

namespace {

/// Of a row: at most so many [%] with any remark, or at least so many told exactly.
struct Mark {
  std::string row;
  double percent;
  StrokeClass stroke_class = StrokeClass::any;
};

void check_mark(const std::vector<RightPen>& pens, const Mark& mark, std::size_t count,
                const JudgeTolerances& tolerances) {
  const Corruption& corruption = corruption_named(mark.row);
  const auto row = static_cast<std::size_t>(&corruption - corruptions().data());
  const std::vector<std::vector<RightPen>> sources = {pens};
  const std::vector<Case> cases = cases_of(sources, row, mark.stroke_class, count, 1);
  const std::vector<Outcome> outcomes = judge_cases(cases, tolerances, nullptr, 0);
  Share share;
  std::vector<double> comparisons;
  std::string failed;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const bool counted = corruption.is_clean() ? !outcomes[i].silent : outcomes[i].told;
    share.add(counted);
    comparisons.push_back(outcomes[i].comparisons);
    if (counted == corruption.is_clean()) {
      failed += encode_utf8(cases[i].pen->character.code) + ": " + describe(cases[i].corrupted.truths.front()) +
                "; told " + outcomes[i].text + "\n";
    }
  }
  INFO(mark.row << ", " << to_string(mark.stroke_class) << ": " << share.percent() << " % of " << share.of << "\n"
                << failed);
  CHECK(share.of > 0);
  CHECK((corruption.is_clean() ? share.percent() <= mark.percent : share.percent() >= mark.percent));
  CHECK(quantile(comparisons, 0.5) <= (corruption.is_clean() ? 20.0 : 52.0));
}

void check_marks(const std::vector<RightPen>& pens, const std::vector<Mark>& marks, std::size_t count,
                 const JudgeTolerances& tolerances = {}) {
  for (const Mark& mark : marks) check_mark(pens, mark, count, tolerances);
}

}  // namespace

TEST_CASE("a constant of the judge is set by its name, and by no other name or value", "[judge]") {
  using detail::judge_constants;
  set_constant("left_over_cost=0.25");
  CHECK(judge_constants.left_over_cost == 0.25);
  judge_constants = {};
  for (const char* wrong : {"left_over=0.25", "left_over_cost", "left_over_cost=", "left_over_cost=0.25em", "=1"}) {
    CHECK_THROWS_AS(set_constant(wrong), ValueError);
  }
  CHECK(judge_constants.left_over_cost == 0.2);
}

TEST_CASE("exact pens with faults and deviations are told exactly", "[judge]") {
  check_marks(copies(),
              {{"as-they-are", 0.0},
               {"shift-15", 0.0},
               {"scale-0.6", 0.0},
               {"rotation+25", 0.0},
               {"rotation-25", 0.0},
               {"shear+25", 0.0},
               {"shear-25", 0.0},
               {"jitter-1", 1.0},
               {"jitter-2", 2.0},
               {"displaced-5", 2.0},
               {"displaced-8", 9.0},
               {"swap", 99.0},
               {"adjacent", 99.0},
               {"reverse", 99.0},
               {"drop", 98.0},
               {"split", 98.0},
               {"join", 98.0},
               {"extra", 97.0},
               {"twice", 98.0},
               {"turned", 98.0},
               {"block", 99.0},
               {"swap,jitter-1", 98.0},
               {"swap,displaced-5", 89.0},
               {"reverse,displaced-5", 97.0},
               {"turned-short", 80.0},
               {"split-3", 98.0}},
              300);
}

TEST_CASE("of people's pens that wrote a character right, what is told is right", "[judge][corpus]") {
  const auto corpus = people();
  if (!corpus) return;
  const std::vector<RightPen> pens = printed_half(corpus->pens);
  CHECK(pens.size() >= 20);
  check_marks(pens,
              {{"as-they-are", 1.5},
               {"rotation+25", 1.5},
               {"rotation-25", 1.5},
               {"shear+25", 1.5},
               {"shear-25", 1.5},
               {"jitter-1", 3.0},
               {"jitter-2", 5.0},
               {"displaced-5", 4.0},
               {"displaced-8", 9.0},
               {"swap", 98.5},
               {"adjacent", 98.5},
               {"reverse", 98.5},
               {"drop", 96.5},
               {"split", 96.5},
               {"join", 96.5},
               {"extra", 96.5},
               {"swap,jitter-1", 97.0},
               {"swap,displaced-5", 89.0},
               {"reverse,displaced-5", 96.0}},
              300);
  check_marks(pens, {{"as-they-are", 4.0}}, 300, JudgeTolerances::strict());
  check_marks(pens, {{"as-they-are", 0.8}}, 300, JudgeTolerances::lenient());
}

TEST_CASE("of people's pens another character is told, and seldom where there is none", "[judge][corpus]") {
  const auto corpus = people();
  if (!corpus) return;
  const CharacterSet set = CharacterSet::layered(corpus->sets);
  const CharacterIndex index(set);
  const std::vector<std::vector<RightPen>> sources = {printed_half(corpus->pens)};
  Share told;
  for (const OtherOutcome& each : judge_others(cases_of_another(sources, set, 300, 1), {}, index, 0)) {
    told.add(each.exact);
  }
  CAPTURE(told.count, told.of);
  CHECK(told.percent() >= 97.0);
  for (const auto& [name, most] : {std::pair{"as-they-are", 0.5},
                                   {"rotation+25", 0.5},
                                   {"rotation-25", 0.5},
                                   {"swap", 0.5},
                                   {"reverse", 0.5},
                                   {"displaced-8", 3.0}}) {
    const auto row = static_cast<std::size_t>(&corruption_named(name) - corruptions().data());
    Share wrong;
    for (const Outcome& each : judge_cases(cases_of(sources, row, StrokeClass::any, 300, 1), {}, &index, 0)) {
      wrong.add(each.other != 0);
    }
    CAPTURE(name, wrong.count, wrong.of);
    CHECK(wrong.of > 0);
    CHECK(wrong.percent() <= most);
  }
  const std::vector<RightPen> written = written_pens(forms_of_twins(set, 3), 1, 0);
  int most = 0;
  for (const Twins& each : all_twins) {
    Share noticed;
    for (const OtherOutcome& outcome : judge_others(cases_of_twins(written, set, each), {}, index, 0)) {
      noticed.add(outcome.named != 0);
    }
    most += noticed.percent() > 50.0;
  }
  CHECK(most >= 13);
}

}  // namespace calligraphy_test
