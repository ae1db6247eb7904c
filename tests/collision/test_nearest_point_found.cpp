// Regression tests for what nearest_point_fuzz found.
#include "../catch.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <calligraphy/collision/stroke_tracker.hpp>

#include "../nearest_point_oracle.hpp"

using namespace calligraphy;
using calligraphy_test::NearestPointOracle;

namespace {

struct Found {
  std::string what;
  std::vector<Point> points;
  Point query;
  ParameterRange range = {};
};

const Found found[] = {
    {"control points and query crowd within 1e-8 of the size",
     {{0x1.d224c557be7cep-1, 0x1.a7936656e4317p-2},
      {0x1.e5137dcfef56ap-27, 0x1.67ec5d6a8d23ep-27},
      {0x1.fbdaff1b9e2b8p-28, -0x1.5f31db50206ccp-27},
      {-0x1.e7c8b9ed034f5p-28, 0x1.49e9770f4e75ap-28},
      {-0x1.93cd3e26cefdap-27, -0x1.c37a20c2e02f8p-28}},
     {0x1.fbdaff1b9e2b8p-28, -0x1.5f31db50206ccp-27}},
    {"a handle 10,000 times longer than the rest",
     {{0x1.8cfcd31541639p-1, 0x1.482671ef7a701p-1},
      {-0x1.851460fb5460dp+13, -0x1.2a0bf8114f29bp+13},
      {0x1.3870059626a59p-1, 0x1.8dbc9525a7b1p-3},
      {0x1.6a2c17a1c1538p-1, 0x1.8d54c3485394ap-1},
      {0x1.8ee59ac92f963p-1, 0x1.c192f558dcd8p-6}},
     {0x1.8c7f1543a3dffp-1, 0x1.2f11418c9f5f8p-5}},
    {"the slope nearly vanishes before it does",
     {{-0x1.2157ce1651e0ep-18, -0x1.d0ed362108b4ep-18},
      {-0x1.70f4e31bb8f4p-17, -0x1.a7ba157d81895p-15},
      {0x1.24c4fdef256f7p-15, 0x1.09412aa5ec57cp-15},
      {-0x1.01b780385f629p-14, 0x1.ee2f57fae0621p-16},
      {-0x1.9f1641ae2ea06p-1, -0x1.2bbe9ee62b8f3p-1}},
     {0x1.ac3423646e8ecp+4, -0x1.28f5354ff6ae8p+5}},
    {"two uncertain signs between a negative and a positive one hide a second minimum",
     {{-0x1.fdcc60d35921bp-1, -0x1.7b7164ff651b7p-4},
      {-0x1.f94d2dd8dff11p-11, -0x1.09aec04a955e6p-11},
      {0x1.b7bf3beafb592p-11, -0x1.f63e9e362065ap-11},
      {0x1.0d6072cbaae17p-12, 0x1.4f7165697af88p-11},
      {-0x1.1f4506daf5ca4p-11, -0x1.101c708494611p-10}},
     {-0x1.cc9e2669d964p-12, -0x1.35d447ef91e8dp-11}},
    {"the same, a million from the origin",
     {{-0x1.084de5ea95d03p+23, 0x1.76604ac3b456dp+23},
      {-0x1.084de66366bd5p+23, 0x1.76604cb5f6ebp+23},
      {-0x1.084de663954cap+23, 0x1.76604cb5c080ap+23},
      {-0x1.084de66340dfcp+23, 0x1.76604cb5f6f9p+23},
      {-0x1.084de663185fcp+23, 0x1.76604cb4fccffp+23}},
     {-0x1.084de66328077p+23, 0x1.76604cb543fd8p+23}},
    {"so far away that all of the curve is as near up to rounding",
     {{0x1.4c6805875eab8p-60, -0x1.67104d5b6bed4p-58},
      {0x1.a148e771f1fcap-28, 0x1.824e1637a4e27p-30},
      {0x1.a148e77133118p-27, 0x1.824e1644888dap-29},
      {0x1.38f6ad951c40dp-26, 0x1.21ba90afc1f4dp-28},
      {0x1.a148e772050ecp-26, 0x1.824e16365b482p-28}},
     {-0x1.043c8703a11dcp-2, 0x1.191b2a23c1d51p+0},
     {0x1.43300814ee53p-4, 1.0}},
};

}  // namespace

TEST_CASE("the nearest point is right where the fuzzer found it wrong", "[collision]") {
  for (const Found& found_case : found) {
    const StrokeElement element = prepare_element(found_case.points);
    const NearestPointOracle oracle(found_case.points);
    for (const NearestPointMethod method : {NearestPointMethod::exact, NearestPointMethod::tracked}) {
      for (const double start : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const NearestPoint answer = nearest_point(element, found_case.query, {method}, found_case.range, start);
        const auto bounds = oracle.nearest(found_case.query, answer.parameter, found_case.range);
        const auto verdict = oracle.judge(answer, found_case.query, bounds, found_case.range);
        INFO(found_case.what << ": " << verdict.error << " of the size");
        CHECK(verdict.right);
        CHECK(answer.certified());
      }
    }
  }
}

TEST_CASE("a pen that returns from very far is on the nearest element at once", "[collision]") {
  // The margin within which two distances count as equal follows from them, not from those of the last tick.
  const std::vector<Point> spot = {{0x1.49p+6, -0x1.48p+6}, {0x1.49p+6, -0x1.48p+6}},
                           bend = {{0x1.49p+6, -0x1.48p+6},
                                   {0x1.4ad990e8a0d09p+6, -0x1.481ae3cadd062p+6},
                                   {0x1.4cb4cc605ca68p+6, -0x1.48499fb0ede7ep+6},
                                   {0x1.4e2dce61a3d5fp+6, -0x1.47dc7b9e7586ap+6},
                                   {0x1.4e300e111315p+6, -0x1.4651afc386f17p+6}};
  const StrokeElement elements[] = {prepare_element(spot), prepare_element(bend)};
  StrokeTracker tracker(elements);
  tracker.update({0x1.4d6d1768b19dp+6, -0x1.46478757b93d8p+6});
  tracker.update({-0x1.2342019b69a86p+23, 0x1.3582f30a0eb2p+26});
  const Point back(0x1.4900005c57961p+6, -0x1.4800006a5551p+6);
  CHECK(tracker.update(back).element == 1);
  CHECK(tracker.update(back).closest.distance == Approx(nearest_point(elements[1], back).distance).margin(1e-12));
}
