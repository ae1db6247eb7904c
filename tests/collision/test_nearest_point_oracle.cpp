// The nearest-point oracle itself: it accepts the truth, and nothing farther off than it permits.
#include "../catch.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "../hard_cases.hpp"
#include "../nearest_point_oracle.hpp"
#include "../reference_curve.hpp"

using namespace calligraphy;
using calligraphy_test::hard_curves;
using calligraphy_test::hard_queries;
using calligraphy_test::HardCurve;
using calligraphy_test::NearestPointOracle;
using calligraphy_test::ReferenceCurve;
using calligraphy_test::Verdict;

namespace {

/// The result that a method would return at this parameter.
NearestPoint answer_at(const std::vector<Point>& points, const Point& query, double t) {
  const StrokeElement element = prepare_element(points);
  NearestPoint answer;
  answer.parameter = t;
  answer.point = element.point(t);
  answer.distance = (query - answer.point).norm();
  answer.tangent = element.tangent(t);
  return answer;
}

Verdict judged(const std::vector<Point>& points, const Point& query, const NearestPoint& answer,
               const ParameterRange& range = {}) {
  const NearestPointOracle oracle(points);
  return oracle.judge(answer, query, oracle.nearest(query, answer.parameter, range), range);
}

/// The parameter on the far side of `from` at which the distance is larger by `excess`.
long double further_by(const NearestPointOracle& oracle, const Point& query, long double from, long double excess) {
  const long double aim = oracle.distance(query, from) + excess;
  long double low = from, high = from > 0.5L ? 0.0L : 1.0L;
  for (int i = 0; i < 200; ++i) {
    const long double middle = 0.5L * (low + high);
    (oracle.distance(query, middle) < aim ? low : high) = middle;
  }
  return high;
}

struct Vector {
  const char* name;
  std::vector<Point> points;
  Point query;
  double parameter;       ///< of the nearest point
  double distance;        ///< of the nearest point
  double wrong_distance;  ///< the result of the printed rule: on the wrong branch, or stopped early
};

/// F1 to F8 of the project's nearest-point reference.
const Vector vectors[] = {
    {"F1", {{0, 0}, {0, 1}, {1, 1}, {1, 0}}, {0.5, 1.0}, 0.5, 0.25, 0.4375},
    {"F4", {{0, 0}, {1, 2}, {3, 3}, {4, 0}}, {1.7890625, 3.046875}, 0.498169, 1.190654, 1.65413},
    {"F5", {{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {1.71, 0.3}, 0.57, 0.3, 0.366197},
    {"F6", {{0, 0}, {1.2, 0}, {1.3, 0.1}, {0.9, 0.15}}, {0.88, 0.085}, 0.352775, 0.0545434, 0.0680074},
    {"F8", {{0.4, 0.9}, {0.7, 0.05}, {0.75, 0.35}, {0.7, 0.65}}, {0.5, 0.7}, 0.093316, 0.0241071, 0.2061553},
};

}  // namespace

TEST_CASE("the oracle recognises the reference's test vectors, right and wrong", "[collision]") {
  for (const Vector& vector : vectors) {
    INFO(vector.name);
    const ReferenceCurve reference(vector.points);
    const NearestPointOracle oracle(vector.points);
    const auto nearest = reference.nearest(vector.query);
    CHECK(static_cast<double>(nearest.parameter) == Approx(vector.parameter).epsilon(1e-5));
    CHECK(static_cast<double>(nearest.distance) == Approx(vector.distance).epsilon(1e-5));
    const auto bounds = oracle.nearest(vector.query, nearest.parameter);
    CHECK(bounds.least <= nearest.distance);
    CHECK(bounds.least >= nearest.distance - 2e-14L * oracle.size());

    const NearestPoint right = answer_at(vector.points, vector.query, static_cast<double>(nearest.parameter));
    CHECK(judged(vector.points, vector.query, right).right);
    CHECK(judged(vector.points, vector.query, right).error <= 2e-14);

    // Every parameter, however found, is judged by how much farther its point is.
    int misjudged = 0;
    for (int i = 0; i <= 1000; ++i) {
      const double t = i / 1000.0;
      const long double excess = (oracle.distance(vector.query, t) - nearest.distance) / oracle.size();
      const Verdict verdict = judged(vector.points, vector.query, answer_at(vector.points, vector.query, t));
      misjudged += verdict.right != (excess <= 1e-9L) || verdict.wrong_branch != (excess > 1e-3L);
    }
    CHECK(misjudged == 0);
  }
}

TEST_CASE("the oracle rejects the results of the printed rule on its test vectors", "[collision]") {
  for (const Vector& vector : vectors) {
    INFO(vector.name);
    const NearestPoint printed =
        nearest_point(prepare_element(vector.points), vector.query, {NearestPointMethod::wang2006, 1e-6});
    const Verdict verdict = judged(vector.points, vector.query, printed);
    CHECK_FALSE(verdict.right);
    // F1 and F4 stop at the right parameter by chance, with a point that is not on the curve; on F5 the tie to the
    // nearer midpoint saves the branch.
    CHECK(verdict.wrong_branch == (vector.name == std::string("F6") || vector.name == std::string("F8")));
  }
}

TEST_CASE("the oracle accepts an error just below its tolerance and rejects one just above", "[collision]") {
  for (const Vector& vector : vectors) {
    const NearestPointOracle oracle(vector.points);
    const auto nearest = ReferenceCurve(vector.points).nearest(vector.query);
    const long double allowed = oracle.allowance(vector.query, vector.distance);
    CHECK(static_cast<double>(allowed) == Approx(1e-9 * oracle.size()).epsilon(1e-5));
    const auto off_by = [&](long double excess) {
      const auto t = static_cast<double>(further_by(oracle, vector.query, nearest.parameter, excess));
      return judged(vector.points, vector.query, answer_at(vector.points, vector.query, t));
    };
    INFO(vector.name);
    CHECK(off_by(0.99L * allowed).right);
    CHECK_FALSE(off_by(1.01L * allowed).right);
    CHECK_FALSE(off_by(1.01L * allowed).wrong_branch);
    CHECK_FALSE(off_by(0.99e-3L * oracle.size()).wrong_branch);
    CHECK(off_by(1.01e-3L * oracle.size()).wrong_branch);
    CHECK(off_by(1e-6L * oracle.size()).error == Approx(1e-6).epsilon(1e-6));
  }
}

TEST_CASE("the oracle rejects a point, a distance or a tangent that does not match the parameter", "[collision]") {
  const std::vector<Point> points = vectors[1].points;
  const Point query = vectors[1].query;
  const NearestPoint right =
      answer_at(points, query, static_cast<double>(ReferenceCurve(points).nearest(query).parameter));
  const double size = NearestPointOracle(points).size();
  CHECK(judged(points, query, right).right);
  for (const double beside : {0.5e-9, 2e-9}) {
    NearestPoint moved = right, longer = right, shorter = right;
    moved.point += Point(0.0, beside * size);
    longer.distance += beside * size;
    shorter.distance -= beside * size;
    for (const NearestPoint& answer : {moved, longer, shorter}) {
      CHECK(judged(points, query, answer).right == (beside < 1e-9));
      CHECK(judged(points, query, answer).consistent == (beside < 1e-9));
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<NearestPoint> broken(7, right);
  broken[0].tangent *= 1.001;
  broken[1].tangent = Point::Zero();
  broken[2].parameter = -1e-17;
  broken[3].parameter = nan;
  broken[4].point.x() = nan;
  broken[5].distance = std::numeric_limits<double>::infinity();
  broken[6].tangent.y() = nan;
  for (const NearestPoint& answer : broken) CHECK_FALSE(judged(points, query, answer).right);
}

TEST_CASE("the oracle proves a bound on every hard curve that brute force cannot beat", "[collision]") {
  constexpr ParameterRange ranges[] = {{0.0, 1.0}, {0.2, 0.7}, {0.0, 1e-6}, {0.4, 0.4}};
  for (const HardCurve& curve : hard_curves()) {
    const NearestPointOracle oracle(curve.control_points);
    double loosest = 0.0;
    int beaten = 0, queries = 0;
    for (const Point& query : hard_queries(curve, 8)) {
      for (const ParameterRange& range : ranges) {
        if (++queries % 7 != 0 && range.begin != 0.0) continue;
        // The hint may be anything: the proof does not depend on it.
        const auto bounds = oracle.nearest(query, 0.37L, range);
        long double sampled = std::numeric_limits<long double>::infinity();
        for (int i = 0; i <= 400; ++i) {
          const long double t = range.begin + (static_cast<long double>(range.end) - range.begin) * i / 400.0L;
          sampled = std::min(sampled, oracle.distance(query, t));
        }
        const long double slack = oracle.allowance(query, static_cast<double>(bounds.found));
        beaten += sampled < bounds.least || bounds.found > sampled * (1.0L + 1e-18L) + 1e-2L * slack;
        if (slack > 0.0L) {
          loosest = std::max(loosest, static_cast<double>((bounds.found - bounds.least) / slack));
        }
      }
    }
    INFO(curve.name);
    CHECK(beaten == 0);
    CHECK(loosest <= 0.1);
  }
}

TEST_CASE("the oracle proves the same in quadruple precision, more tightly", "[collision]") {
  double loosest = 0.0;
  int contradictions = 0, loose = 0;
  for (const HardCurve& curve : hard_curves()) {
    const NearestPointOracle oracle(curve.control_points);
    if (!(oracle.size() > 0.0)) continue;
    for (const Point& query : hard_queries(curve, 2)) {
      const auto plain = oracle.nearest(query, 0.37L), fine = oracle.nearest(query, 0.37L, {}, true);
      const long double last_bits = 1e-18L * (fine.found + oracle.size());
      contradictions += plain.least > fine.found + last_bits || fine.least > plain.found + last_bits;
      loosest = std::max(loosest, static_cast<double>((fine.found - fine.least) / oracle.size()));
      loose += plain.found - plain.least > 2e-14L * oracle.size() + 1e-16L * plain.found;
    }
  }
  CHECK(contradictions == 0);
  CHECK(loosest <= 2e-14);
  CHECK(loose == 0);
}

TEST_CASE("the oracle proves that a second curve is clearly farther without finding its nearest point", "[collision]") {
  const std::vector<Point> arch = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  const NearestPointOracle oracle(arch);
  CHECK(oracle.nearest_within({0.5, 2.0}, 1.0L).least == Approx(1.0).margin(1e-12));
  CHECK(oracle.nearest_within({0.5, 2.0}, 1.25L).least == Approx(1.25).margin(1e-12));
  CHECK(oracle.nearest_within({0.5, 2.0}, 7.0L).least == Approx(1.25).margin(1e-12));
  CHECK(oracle.box_distance({0.5, 2.0}) == Approx(1.0));
  CHECK(oracle.box_distance({-3.0, 5.0}) == Approx(5.0));
  CHECK(oracle.box_distance({0.5, 0.5}) == 0.0);
}
