// What a simulated writer draws: independent beliefs for every character, the same ones in both modes.
#include <calligraphy/practice/writer.hpp>

#include <cmath>
#include <vector>

#include "../catch.hpp"
#include "pages.hpp"

using namespace calligraphy;

namespace {

constexpr const char* twenty = "北京航空天大学永和年中国书法一木美家我女";

/// Where a writer first puts the pen down, from the start of the stroke [em].
Point first_miss(const PracticePage& page, const WriterSkill& skill, std::uint64_t seed) {
  SimulatedWriter writer(page, skill, seed);
  Intention pen = writer.update({}, 0.002);
  while (pen.position.z() >= 0.0) pen = writer.update({}, 0.002);
  const PlacedCharacter& first = page.characters.front();
  const Point start = place_elements(strokes(first.character).front(), first.placement).front().point(0.0);
  return (pen.position.head<2>() - start) / first.placement.em;
}

/// A writer who misses only by the part that `spread` draws.
WriterSkill misses_by(double WriterSkill::*spread) {
  WriterSkill skill;
  skill.*spread = 0.04;
  return skill;
}

}  // namespace

TEST_CASE("characters alone on their pages draw their own beliefs from one seed", "[practice]") {
  // Sums of squares of normal deviates: within four standard deviations of chi-square. Were the beliefs of a seed
  // shared, the squares of the means would be 20 times as large.
  constexpr int seeds = 50;
  for (double WriterSkill::*spread : {&WriterSkill::offset, &WriterSkill::shape, &WriterSkill::aim}) {
    double of_each = 0.0, of_means = 0.0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Point sum = Point::Zero();
      int characters = 0;
      for (const Character& character : calligraphy_test::characters(twenty)) {
        const PracticePage page = lay_out(std::span(&character, 1)).front();
        const Point miss = first_miss(page, misses_by(spread), seed) / 0.04;
        of_each += miss.squaredNorm();
        sum += miss;
        ++characters;
        ++count;
      }
      of_means += sum.squaredNorm() / characters;
    }
    const auto within = [](double degrees) { return 4.0 * std::sqrt(2.0 * degrees); };
    CHECK(of_each == Approx(2.0 * count).margin(within(2.0 * count)));
    CHECK(of_means == Approx(2.0 * seeds).margin(within(2.0 * seeds)));
  }
}

TEST_CASE("the same character, index and seed is the same draw, another index or seed is another one", "[practice]") {
  const WriterSkill skill = misses_by(&WriterSkill::offset);
  const PracticePage alone = calligraphy_test::page_of("永");
  const PracticePage with_another = calligraphy_test::page_of("永北");
  const Point miss = first_miss(alone, skill, 3);
  CHECK(miss == first_miss(alone, skill, 3));
  CHECK((miss - first_miss(with_another, skill, 3)).norm() < 1e-5);  // at another place on the page
  CHECK((miss - first_miss(alone, skill, 4)).norm() > 1e-3);
}

TEST_CASE("a writer who is shown only in the pause that a stroke was finished goes on with the next", "[practice]") {
  WriterSkill skill;
  skill.pause = 0.35;
  SimulatedWriter writer(calligraphy_test::page_of("十"), skill, 1);
  VisualFeedback sight;
  double lifted = 0.0;  // for how long [s]
  bool has_written = false;
  for (double time = 0.0; time < 10.0; time += 0.002) {
    const Intention pen = writer.update(sight, 0.002);
    const bool on_paper = pen.position.z() < 0.0;
    if (on_paper && lifted > 0.0) break;
    has_written = has_written || on_paper;
    if (has_written && !on_paper) lifted += 0.002;
    sight = {pen.position, 0, lifted > 0.15 ? 1 : 0, on_paper};
  }
  CHECK(lifted > 0.5);
  CHECK(writer.intended_stroke() == 1);
}
