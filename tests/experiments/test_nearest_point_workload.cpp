#include <algorithm>
#include <cmath>
#include <limits>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/bezier.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../catch.hpp"
#include "experiments/nearest_point_workload.hpp"
#include "hard_cases.hpp"
#include "reference_curve.hpp"

using namespace calligraphy;
using calligraphy_test::ReferenceCurve;
using calligraphy_test::size_of;

namespace {

const std::vector<std::vector<Point>>& real_curves() {
  static const auto curves = curve_control_points(built_in_characters().characters);
  return curves;
}

const std::vector<NearestPointWorkload>& workloads() {
  static const auto all = nearest_point_workloads(real_curves());
  return all;
}

const NearestPointWorkload& workload(const std::string& name) {
  const auto found =
      std::find_if(workloads().begin(), workloads().end(), [&](const auto& w) { return w.name == name; });
  REQUIRE(found != workloads().end());
  return *found;
}

Bezier<3> cubic(const CurveQueries& asked) {
  const auto& p = asked.control_points;
  return {{p[0], p[1], p[2], p[3]}};
}

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

double sine(const Point& a, const Point& b) { return cross(a, b) / (a.norm() * b.norm()); }

/// Share of all queries for which `holds(curve, query)` is true.
template <typename Predicate>
double share(const NearestPointWorkload& of, Predicate holds, std::size_t stride = 1) {
  double asked = 0.0, held = 0.0;
  for (const CurveQueries& curve : of.curves) {
    for (std::size_t i = 0; i < curve.queries.size(); i += stride) {
      asked += 1.0;
      held += holds(curve, curve.queries[i]) ? 1.0 : 0.0;
    }
  }
  return held / asked;
}

template <typename Predicate>
long curves_that(const NearestPointWorkload& of, Predicate holds) {
  return std::count_if(of.curves.begin(), of.curves.end(), holds);
}

double reference_distance(const CurveQueries& curve, const Point& query) {
  return static_cast<double>(ReferenceCurve(curve.control_points).nearest(query).distance);
}

bool in_widened_box(const CurveQueries& curve, const Point& query) {
  Point low = curve.control_points[0], high = low;
  for (const Point& point : curve.control_points) low = low.cwiseMin(point), high = high.cwiseMax(point);
  const double size = (high - low).norm();
  const Point margin = Point::Constant(0.25 * (size > 0.0 ? size : 1.0) + 1e-12 * size);
  return (query.array() >= (low - margin).array()).all() && (query.array() <= (high + margin).array()).all();
}

}  // namespace

TEST_CASE("there are 19 workloads of 16,000 finite queries to 64 cubics", "[practice]") {
  std::vector<std::string> names;
  for (const NearestPointWorkload& each : workloads()) {
    INFO(each.name);
    names.push_back(each.name);
    std::size_t queries = 0;
    bool finite = true;
    for (const CurveQueries& curve : each.curves) {
      queries += curve.queries.size();
      REQUIRE(curve.control_points.size() == 4);
      for (const Point& point : curve.control_points) finite = finite && point.allFinite();
      for (const Point& point : curve.queries) finite = finite && point.allFinite();
    }
    CHECK(each.curves.size() == 64);
    CHECK(queries == 16000);
    CHECK(finite);
    CHECK(each.allowed_error == (each.name == "offset 1e8" ? 1e-6 : 1e-9));
  }
  CHECK(names == std::vector<std::string>{"random box", "random near", "real strokes near", "real strokes box", "hook",
                                          "loop", "cusp", "collinear", "degenerate", "near straight", "symmetric",
                                          "symmetric S", "centre of curvature", "arc centre", "coordinates x 1e8",
                                          "offset 1e8", "size 1e-12", "far", "on the curve"});
}

TEST_CASE("the same seed gives the same workloads, another seed different ones", "[practice]") {
  const auto again = nearest_point_workloads(real_curves()), other = nearest_point_workloads(real_curves(), 16000, 2);
  for (std::size_t i = 0; i < again.size(); ++i) {
    INFO(again[i].name);
    std::size_t other_queries = 0;
    for (std::size_t k = 0; k < again[i].curves.size(); ++k) {
      REQUIRE(again[i].curves[k].control_points == workloads()[i].curves[k].control_points);
      REQUIRE(again[i].curves[k].queries == workloads()[i].curves[k].queries);
      other_queries += other[i].curves[k].queries != workloads()[i].curves[k].queries ? 1 : 0;
    }
    CHECK(other_queries == 64);
  }
  // The first two numbers of splitmix64, seeded by its first number for seed 1: no standard library distribution.
  CHECK(again[0].curves[0].control_points[0] == Point(0.36818951565166946, 0.9435642308648544));
}

TEST_CASE("few queries give few curves, and an invalid workload is rejected", "[practice]") {
  const auto few = nearest_point_workloads(real_curves(), 5);
  CHECK(few[0].curves.size() == 5);
  const auto uneven = nearest_point_workloads(real_curves(), 100);
  std::size_t queries = 0;
  for (const CurveQueries& curve : uneven[0].curves) queries += curve.queries.size();
  CHECK(queries == 100);
  CHECK_THROWS_AS(nearest_point_workloads(real_curves(), 0), ValueError);
  CHECK_THROWS_AS(nearest_point_workloads({}), ValueError);
  const std::vector<std::vector<Point>> line = {{Point(0, 0), Point(1, 0)}};
  CHECK_THROWS_AS(nearest_point_workloads(line), ValueError);
}

TEST_CASE("real strokes are the cubics of the characters on squares of 40 mm", "[practice]") {
  std::size_t curves = 0;
  for (const Character& character : built_in_characters().characters) {
    for (const Stroke& stroke : strokes(character)) {
      curves += static_cast<std::size_t>(std::count(stroke.elements.begin(), stroke.elements.end(), 'C'));
    }
  }
  REQUIRE(real_curves().size() == curves);
  const Stroke fourth = strokes(*built_in_characters().find(U'北'))[3];
  CHECK(std::any_of(real_curves().begin(), real_curves().end(), [&](const std::vector<Point>& curve) {
    return curve[0] == 0.04 * fourth.control_points[0] && curve[3] == 0.04 * fourth.control_points[3];
  }));
  CHECK(curve_control_points(std::vector<Character>{with_quartic_curves(*built_in_characters().find(U'北'))}).empty());
  for (const std::string name : {"real strokes near", "real strokes box"}) {
    CHECK(curves_that(workload(name), [](const CurveQueries& asked) {
            return std::find(real_curves().begin(), real_curves().end(), asked.control_points) != real_curves().end();
          }) == 64);
  }
}

TEST_CASE("queries lie where the name of their workload says", "[practice]") {
  CHECK(share(workload("random box"), in_widened_box) == 1.0);
  CHECK(share(workload("real strokes box"), in_widened_box) == 1.0);
  const auto within = [](double sizes) {
    return [sizes](const CurveQueries& curve, const Point& query) {
      return reference_distance(curve, query) <= sizes * size_of(curve.control_points);
    };
  };
  CHECK(share(workload("random near"), within(0.1), 50) == 1.0);
  CHECK(share(workload("random near"), within(0.01), 50) < 0.5);
  CHECK(share(workload("on the curve"), within(1e-15), 50) == 1.0);
  CHECK(share(workload("on the curve"), [](const auto& curve, const Point& query) {
          return query == curve.control_points[0] || query == curve.control_points[3];
        }) > 0.04);
  // The curve may come closer than the point from which the query was displaced.
  CHECK(share(
            workload("real strokes near"),
            [](const auto& curve, const Point& query) { return reference_distance(curve, query) <= 0.005; },
            50) == 1.0);
  CHECK(share(
            workload("real strokes near"),
            [](const auto& curve, const Point& query) { return reference_distance(curve, query) >= 0.0005; },
            50) > 0.85);
  double nearest = std::numeric_limits<double>::infinity(), furthest = 0.0;
  for (const CurveQueries& curve : workload("far").curves) {
    for (const Point& query : curve.queries) {
      const double sizes = (query - cubic(curve).point(0.5)).norm() / size_of(curve.control_points);
      nearest = std::min(nearest, sizes);
      furthest = std::max(furthest, sizes);
    }
  }
  CHECK(nearest >= 0.999);
  CHECK(nearest < 2.0);
  CHECK(furthest <= 1.001e6);
  CHECK(furthest > 5e5);
}

TEST_CASE("a loop crosses itself, a cusp has zero velocity, a hook has two close branches", "[practice]") {
  for (const CurveQueries& curve : workload("loop").curves) {
    // A loop approaches its crossing from the lower left and leaves it to the lower right.
    const auto& p = curve.control_points;
    const auto crosses = [](const Point& a, const Point& b, const Point& c, const Point& d) {
      return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
    };
    bool crossed = false;
    for (int i = 0; i < 200; ++i) {
      for (int k = i + 2; k < 200; ++k) {
        const Bezier<3> of = cubic(curve);
        crossed = crossed || crosses(of.point(i / 200.0), of.point((i + 1) / 200.0), of.point(k / 200.0),
                                     of.point((k + 1) / 200.0));
      }
    }
    INFO(p[0].transpose() << ", " << p[1].transpose() << ", " << p[2].transpose() << ", " << p[3].transpose());
    CHECK(crossed);
  }
  for (const CurveQueries& curve : workload("cusp").curves) {
    double slowest = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 100000; ++i) slowest = std::min(slowest, cubic(curve).derivative(i * 1e-5).norm());
    CHECK(slowest < 1e-4 * size_of(curve.control_points));
  }
  for (const CurveQueries& curve : workload("hook").curves) {
    const Bezier<3> of = cubic(curve);
    CHECK(of.derivative(0.0).dot(of.derivative(1.0)) < 0.0);
  }
}

TEST_CASE("collinear curves lie on a line and some fold back, degenerate ones have equal control points",
          "[practice]") {
  int folded = 0, exact = 0;
  for (const CurveQueries& curve : workload("collinear").curves) {
    const auto& p = curve.control_points;
    for (const Point& point : p) CHECK(std::abs(cross(p[3] - p[0], point - p[0])) < 1e-14);
    folded += (p[1] - p[0]).dot(p[2] - p[1]) < 0.0 || (p[2] - p[1]).dot(p[3] - p[2]) < 0.0 ? 1 : 0;
    exact += p[0].y() == p[1].y() && p[0].y() == p[2].y() && p[0].y() == p[3].y() ? 1 : 0;
  }
  CHECK(folded > 15);
  CHECK(folded < 33);
  CHECK(exact == 22);
  const auto& degenerate = workload("degenerate");
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) {
      CHECK(curves_that(degenerate, [&](const CurveQueries& curve) {
              const auto& p = curve.control_points;
              int pairs = 0;
              for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t k = i + 1; k < 4; ++k) pairs += p[i] == p[k] ? 1 : 0;
              }
              return p[a] == p[b] && pairs == 1;
            }) > 3);
    }
  }
  CHECK(curves_that(degenerate, [](const auto& curve) { return size_of(curve.control_points) == 0.0; }) == 6);
}

TEST_CASE("nearly straight curves are bowed by 1e-2 to 1e-14", "[practice]") {
  double least = 1.0, most = 0.0;
  for (const CurveQueries& curve : workload("near straight").curves) {
    const auto& p = curve.control_points;
    const double bow = std::abs(sine(p[2] - p[0], p[3] - p[0])) * (p[2] - p[0]).norm() / (p[3] - p[0]).norm();
    least = std::min(least, bow);
    most = std::max(most, bow);
  }
  CHECK(most < 1.1e-2);
  CHECK(most > 0.9e-2);
  CHECK(least < 1e-13);
}

TEST_CASE("symmetric curves are exact to the last bit, with queries on or slightly beside the axis or centre",
          "[practice]") {
  for (const CurveQueries& curve : workload("symmetric").curves) {
    const auto& p = curve.control_points;
    CHECK(p[0] == Point(-p[3].x(), p[3].y()));
    CHECK(p[1] == Point(-p[2].x(), p[2].y()));
  }
  for (const CurveQueries& curve : workload("symmetric S").curves) {
    CHECK(curve.control_points[0] == -curve.control_points[3]);
    CHECK(curve.control_points[1] == -curve.control_points[2]);
  }
  const auto on_axis = [](const CurveQueries&, const Point& query) { return query.x() == 0.0; };
  const auto at_origin = [](const CurveQueries&, const Point& query) { return query == Point(0, 0); };
  const auto beside = [](double distance) { return distance > 0.0 && distance < 1e-9; };
  const auto beside_axis = [&](const CurveQueries&, const Point& query) { return beside(std::abs(query.x())); };
  const auto beside_origin = [&](const CurveQueries&, const Point& query) { return beside(query.norm()); };
  CHECK(share(workload("symmetric"), on_axis) > 0.15);
  CHECK(share(workload("symmetric"), beside_axis) > 0.2);
  for (const std::string name : {"symmetric S", "arc centre"}) {
    CHECK(share(workload(name), at_origin) > 0.15);
    CHECK(share(workload(name), beside_origin) > 0.2);
  }
}

TEST_CASE("arcs keep a constant radius within the known error of the cubic", "[practice]") {
  double shortest = 4.0, longest = 0.0;
  for (const CurveQueries& curve : workload("arc centre").curves) {
    const double radius = curve.control_points[0].norm();
    double error = 0.0;
    for (int i = 0; i <= 100; ++i) {
      error = std::max(error, std::abs(cubic(curve).point(i * 0.01).norm() / radius - 1.0));
    }
    CHECK(error < 0.02);
    const double cosine = curve.control_points[0].dot(curve.control_points[3]) / (radius * radius);
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    shortest = std::min(shortest, angle);
    longest = std::max(longest, angle);
  }
  CHECK(shortest < 0.6);
  CHECK(longest > 2.8);
}

TEST_CASE("queries at a centre of curvature lie where the second derivative of the distance vanishes", "[practice]") {
  const auto at_centre = [](const CurveQueries& curve, const Point& query) {
    const Bezier<3> of = cubic(curve);
    const Bezier<2> first = of.hodograph();
    const Bezier<1> second = first.hodograph();
    const double size = size_of(curve.control_points);
    for (int i = 0; i < 20000; ++i) {
      const double t = i / 20000.0;
      const Point slope = first.point(t);
      const Point centre =
          of.point(t) + Point(-slope.y(), slope.x()) * slope.squaredNorm() / cross(slope, second.point(t));
      if ((query - centre).norm() < 0.011 * size) return true;
    }
    return false;
  };
  CHECK(share(workload("centre of curvature"), at_centre, 100) > 0.95);
  CHECK(share(workload("random box"), at_centre, 100) < 0.2);
}

TEST_CASE("extreme coordinates are as extreme as their workload says", "[practice]") {
  for (const CurveQueries& curve : workload("coordinates x 1e8").curves) {
    CHECK(size_of(curve.control_points) > 1e7);
    CHECK(size_of(curve.control_points) < 1.5e8);
  }
  for (const CurveQueries& curve : workload("offset 1e8").curves) {
    CHECK(size_of(curve.control_points) < 1.5);
    for (const Point& query : curve.queries) REQUIRE((query - Point(1e8, -1e8)).norm() < 4.0);
  }
  for (const CurveQueries& curve : workload("size 1e-12").curves) {
    CHECK(size_of(curve.control_points) > 1e-13);
    CHECK(size_of(curve.control_points) < 1.5e-12);
    for (const Point& query : curve.queries) REQUIRE(query.norm() < 4e-12);
  }
}
