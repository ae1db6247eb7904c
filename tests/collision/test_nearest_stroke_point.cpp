// Batches on strokes and characters against every element queried individually.
#include "../catch.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <calligraphy/collision/nearest_stroke_point.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../allocation_counter.hpp"
#include "../hard_cases.hpp"

using namespace calligraphy;
using calligraphy_test::Sequence;

namespace {

using PlacedElements = std::vector<StrokeElement>;

constexpr double infinite = std::numeric_limits<double>::infinity();
const std::vector<Point> lost_queries = {Point(std::nan(""), 0.0), Point(0.0, infinite), Point(-infinite, 0.0)};

bool identical(const NearestPoint& one, const NearestPoint& other) {
  const auto same = [](const auto& a, const auto& b) { return std::memcmp(&a, &b, sizeof a) == 0; };
  return same(one.parameter, other.parameter) && same(one.point, other.point) && same(one.distance, other.distance) &&
         same(one.tangent, other.tangent) && one.status == other.status;
}

/// One after the other; the first with an element wins unless another is nearer by more than rounding.
CharacterPoint nearest_of_all(const std::vector<PlacedElements>& strokes, const Point& query,
                           const NearestPointOptions& options) {
  CharacterPoint best{0, 0, {.distance = infinite, .status = NearestPointStatus::not_finite}};
  bool is_first = true;
  double size = 0.0;  // of the largest so far
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    for (std::size_t i = 0; i < strokes[k].size(); ++i) {
      const NearestPoint found = nearest_point(strokes[k][i], query, options);
      size = std::max(size, strokes[k][i].size());
      const double tie = 1e-14 * size + 0x1p-51 * found.distance;
      if (is_first || best.closest.distance - found.distance > tie) {
        best = {static_cast<int>(k), static_cast<int>(i), found};
      }
      is_first = false;
    }
  }
  return best;
}

/// Queries with another result in a batch on the character, or on one of its strokes.
int differences(const std::vector<PlacedElements>& strokes, const std::vector<Point>& queries,
                const NearestPointOptions& options) {
  int different = 0;
  std::vector<CharacterPoint> on_character(queries.size());
  nearest_points(strokes, queries, on_character, options);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const CharacterPoint best = nearest_of_all(strokes, queries[i], options), &found = on_character[i];
    different +=
        best.stroke != found.stroke || best.element != found.element || !identical(best.closest, found.closest);
  }
  for (const PlacedElements& stroke : strokes) {
    std::vector<StrokePoint> on_stroke(queries.size());
    nearest_points(stroke, queries, on_stroke, options);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const CharacterPoint best = nearest_of_all({stroke}, queries[i], options);
      different += best.element != on_stroke[i].element || !identical(best.closest, on_stroke[i].closest);
    }
  }
  return different;
}

}  // namespace

TEST_CASE("a batch on strokes equals the best of single queries, whatever their elements", "[collision]") {
  const auto curves = calligraphy_test::hard_curves();
  Sequence random(7);
  const auto any = [&] { return static_cast<std::size_t>(random.next() * static_cast<double>(curves.size())); };
  for (int round = 0; round < 60; ++round) {
    std::vector<PlacedElements> strokes(5);  // some of them without elements
    std::vector<Point> queries = lost_queries;
    for (std::size_t i = 0; i < 8; ++i) {
      const calligraphy_test::HardCurve& curve = curves[any()];
      const std::vector<Point> asked = calligraphy_test::hard_queries(curve, 12);
      queries.insert(queries.end(), asked.begin(), asked.end());
      // Twice, so that distances are equal.
      for (int k = 0; k < 2; ++k) strokes[any() % 5].push_back(prepare_element(curve.control_points));
    }
    strokes[any() % 5].push_back(prepare_element({}));  // every query to it is refused
    for (const NearestPointMethod method : {NearestPointMethod::exact, NearestPointMethod::tracked,
                                            NearestPointMethod::sampled, NearestPointMethod::wang2006}) {
      CAPTURE(round, to_string(method));
      CHECK(differences(strokes, queries, {.method = method}) == 0);
    }
  }
}

TEST_CASE("a batch on every built-in character equals the best of single queries", "[collision]") {
  Sequence random(8);
  for (const Character& character : built_in_characters().characters) {
    const auto strokes = place_elements(PlacedCharacter{character, {{0.01, -0.02}, 0.04}});
    std::vector<Point> queries = lost_queries;
    for (int i = 0; i < 150; ++i) queries.push_back(random.point(-0.03, 0.06));
    for (const PlacedElements& stroke : strokes) {
      for (const StrokeElement& element : stroke) queries.push_back(element.point(1.0));  // often that of the next, too
    }
    CHECK(strokes.size() == static_cast<std::size_t>(character.stroke_count()));
    CHECK(differences(strokes, queries, {}) == 0);
  }
}

TEST_CASE("a query that is not finite gives the start of a stroke, and no elements give the origin", "[collision]") {
  const std::vector<PlacedElements> strokes = {
      {}, {prepare_element(std::vector<Point>{{1.0, 2.0}, {3.0, 2.0}}), prepare_element({})}};
  std::vector<CharacterPoint> nearest(3), nowhere(3);
  const std::size_t before = calligraphy_test::allocations();
  nearest_points(strokes, lost_queries, nearest);
  nearest_points(std::span(strokes).first(1), lost_queries, nowhere);
  CHECK(calligraphy_test::allocations() == before);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(nearest[i].stroke == 1);
    CHECK(nearest[i].closest.point == Point(1.0, 2.0));
    CHECK(nowhere[i].closest.point == Point::Zero());
    for (const NearestPoint& closest : {nearest[i].closest, nowhere[i].closest}) {
      CHECK(closest.distance == infinite);
      CHECK(closest.status == NearestPointStatus::not_finite);
    }
  }
  nearest[1].stroke = -1;
  nearest_points(strokes, lost_queries, std::span(nearest).first(1));
  CHECK(nearest[1].stroke == -1);  // beyond the span
}
