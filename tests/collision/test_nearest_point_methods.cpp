// What each method of finding the nearest point promises: its tolerance, its status, its work.
#include "../catch.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/collision/stroke_tracker.hpp>

#include "../allocation_counter.hpp"
#include "../hard_cases.hpp"
#include "../nearest_point_oracle.hpp"
#include "../special_values.hpp"

using namespace calligraphy;
using calligraphy_test::hard_curves;
using calligraphy_test::hard_queries;
using calligraphy_test::HardCurve;
using calligraphy_test::NearestPointOracle;
using calligraphy_test::Sequence;

namespace {

using calligraphy_test::all_methods;
using calligraphy_test::certified_methods;
using calligraphy_test::infinity;

/// No point of the curve moves faster than this with its parameter.
double fastest(const std::vector<Point>& points) {
  double longest = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) longest = std::max(longest, (points[i + 1] - points[i]).norm());
  return static_cast<double>(points.size() - 1) * longest;
}

}  // namespace

TEST_CASE("options out of range are rejected by name and value", "[collision]") {
  const auto complaint = [](const NearestPointOptions& options) -> std::string {
    try {
      validate(options);
    } catch (const ValueError& error) {
      return error.what();
    }
    return {};
  };
  NearestPointOptions options;
  for (const double good : {std::numeric_limits<double>::denorm_min(), 1.0}) {
    options.tolerance = good;
    CHECK(complaint(options).empty());
  }
  for (const double bad : {0.0, -1.0, 1.5, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    options.tolerance = bad;
    CHECK(complaint(options).starts_with("tolerance = "));
  }
  options = {};
  const auto judge = [&](int& option, const std::string& name, int least, int most) {
    const int usual = option;
    for (const auto& [value, is_good] : {std::pair{least, true}, {most, true}, {least - 1, false}, {most + 1, false}}) {
      option = value;
      CHECK(complaint(options) == (is_good ? ""
                                           : name + " = " + std::to_string(value) + ", must be from " +
                                                 std::to_string(least) + " to " + std::to_string(most)));
    }
    option = usual;
  };
  judge(options.samples, "samples", 2, 64);
  judge(options.refinements, "refinements", 0, 8);
}

TEST_CASE("the error of a certified nearest point is at most its tolerance", "[collision]") {
  for (const HardCurve& curve : hard_curves()) {
    const NearestPointOracle oracle(curve.control_points);
    const StrokeElement element = prepare_element(curve.control_points);
    // What the coordinates themselves cannot resolve is not an error of the method.
    const double steps = 1e-9 * oracle.allowance(Point::Zero(), 0.0) + (curve.tolerance > 1e-9 ? 1e-7 : 0.0);
    for (const double tolerance : {1e-3, 1e-6, 1e-12}) {
      double worst = 0.0;
      int uncertified = 0;
      for (const Point& query : hard_queries(curve)) {
        for (const NearestPointMethod method : certified_methods) {
          for (const double start : {0.0, 0.4, 1.0}) {
            const NearestPoint found = nearest_point(element, query, {method, tolerance}, {}, start);
            const auto bounds = oracle.nearest(query, found.parameter);
            const long double error = oracle.distance(query, found.parameter) - bounds.least;
            const double rounding = steps + 1e-15 * (found.distance + query.cwiseAbs().maxCoeff());
            const double allowed = tolerance * oracle.size() + rounding;
            worst = std::max(worst, static_cast<double>(error) / allowed);
            uncertified += !found.certified();
          }
        }
      }
      INFO(curve.name << ", tolerance " << tolerance);
      CHECK(worst <= 1.0);
      CHECK(uncertified == 0);
    }
  }
}

TEST_CASE("every method rejects a query that is not finite or too far, with a point and a status", "[collision]") {
  std::vector<Point> lost = {{1e120, 0.0}, {-1e200, 1e200}, {0.0, std::numeric_limits<double>::max()}};
  for (const double value : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    lost.insert(lost.end(), {{value, 0.5}, {0.5, value}, {value, value}, {value, 1e300}});
  }
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    int wrong = 0;
    for (const NearestPointMethod method : all_methods) {
      for (const Point& query : lost) {
        for (const ParameterRange& range : {ParameterRange{}, ParameterRange{0.25, 0.5}}) {
          const NearestPoint found = nearest_point(element, query, {method}, range, 0.75);
          const bool usable = found.point.allFinite() && found.tangent.allFinite() && !std::isnan(found.distance);
          // A point has a distance to every finite query.
          const bool told = found.status == NearestPointStatus::not_finite && std::isinf(found.distance) &&
                            found.parameter == range.begin && found.point == element.point(range.begin);
          wrong += !usable || !(told || (!(element.size() > 0.0) && query.allFinite()));
        }
      }
      for (const Point& query : hard_queries(curve, 4)) {
        wrong += nearest_point(element, query, {method}).status == NearestPointStatus::not_finite;
      }
    }
    INFO(curve.name);
    CHECK(wrong == 0);
  }
}

TEST_CASE("the sampled nearest point is near the nearest sample, better with refinement, and never certified",
          "[collision]") {
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    if (!element.curve() || curve.tolerance > 1e-9) continue;
    const NearestPointOracle oracle(curve.control_points);
    int certified = 0, inconsistent = 0;
    double worst = 0.0;
    std::vector<double> sum(9, 0.0);
    for (const Point& query : hard_queries(curve)) {
      if ((query - element.origin()).norm() > 100.0 * element.size()) continue;  // single precision ranks the samples
      const auto bounds = oracle.nearest(query, 0.5L);
      for (const int samples : {4, 16, 64}) {
        // Some sample is at most half a parameter step from the nearest point.
        const double reach = 0.5 * fastest(curve.control_points) / (samples - 1);
        const NearestPointOptions options{NearestPointMethod::sampled, 1e-9, samples, 0};
        const NearestPoint found = nearest_point(element, query, options);
        certified += found.certified();
        inconsistent += !oracle.judge(found, query, bounds).consistent;
        const double error = found.distance - static_cast<double>(bounds.found);
        worst = std::max(worst, (error - 1e-4 * found.distance) / reach);
      }
      for (int refinements = 0; refinements <= 8; ++refinements) {
        const NearestPointOptions options{NearestPointMethod::sampled, 1e-9, 64, refinements};
        sum[static_cast<std::size_t>(refinements)] += nearest_point(element, query, options).distance;
      }
    }
    INFO(curve.name);
    CHECK(certified == 0);
    CHECK(inconsistent == 0);
    CHECK(worst <= 1.0);
    CHECK(sum[2] <= sum[0] + 1e-9 * element.size());
    CHECK(sum[8] <= sum[0] + 1e-9 * element.size());
  }
}

TEST_CASE("no method allocates", "[collision]") {
  const std::vector<HardCurve> curves = hard_curves();
  std::vector<std::vector<Point>> queries;
  for (const HardCurve& curve : curves) queries.push_back(hard_queries(curve));
  std::vector<NearestPoint> results(queries[0].size());
  double sum = 0.0;
  const std::size_t before = calligraphy_test::allocations();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const StrokeElement elements[] = {prepare_element(curves[i].control_points),
                                      prepare_element(curves[(i + 1) % curves.size()].control_points)};
    StrokeTracker tracker(elements);
    for (const NearestPointMethod method : all_methods) {
      for (const Point& query : queries[i]) sum += nearest_point(elements[0], query, {method}, {}, 0.3).distance;
      const std::size_t count = std::min(results.size(), queries[i].size());
      nearest_points(elements[0], std::span(queries[i]).first(count), std::span(results).first(count), {method});
    }
    for (const Point& query : queries[i]) sum += tracker.update(query).closest.distance;
  }
  CHECK(calligraphy_test::allocations() == before);
  CHECK(sum > 0.0);
}
