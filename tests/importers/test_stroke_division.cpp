// The division of a path among the elements of a typical stroke. Expected values are those of plain least squares.
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

#include <calligraphy/base/random.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "../catch.hpp"
#include "importers/fit/control_points.hpp"
#include "importers/fit/piece_residuals.hpp"
#include "importers/fit/polyline.hpp"
#include "importers/fit/stroke_division.hpp"

namespace stroke_division_tests {

using namespace calligraphy;
using namespace calligraphy::recognition;

namespace {

/// Sum of squared residuals by QR of the polynomials' Vandermonde matrix [em^2].
double plain_residual(const Path& path, std::size_t first, std::size_t last, int degree) {
  const auto rows = static_cast<Eigen::Index>(last - first + 1);
  Eigen::MatrixXd powers(rows, degree + 1);
  Eigen::MatrixXd points(rows, 2);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const double position = rows > 1 ? 2.0 * static_cast<double>(row) / static_cast<double>(rows - 1) - 1.0 : 0.0;
    for (Eigen::Index k = 0; k <= degree; ++k) powers(row, k) = std::pow(position, static_cast<double>(k));
    points.row(row) = path[first + static_cast<std::size_t>(row)].transpose();
  }
  const Eigen::MatrixXd fitted = powers * powers.colPivHouseholderQr().solve(points);
  return (points - fitted).squaredNorm();
}

Path steps_along(const std::vector<Point>& corners, int count) {
  return resampled(corners, count, 0.0, path_length(corners));
}

}  // namespace

TEST_CASE("residuals of pieces from prefix sums are those of plain least squares", "[model]") {
  Random random(32);
  Path path{{0.3, 0.7}};
  for (int i = 1; i < 140; ++i) {
    path.push_back(path.back() + 0.008 * Point(std::cos(0.05 * i), std::sin(0.03 * i * i / 140.0)));
    path.back() += 0.001 * Point(random.normal(), random.normal());
  }
  for (const std::size_t first : {0, 1, 40, 100, 135}) {
    for (const std::size_t count : {2, 3, 4, 5, 6, 20, 140}) {
      const std::size_t last = first + count - 1;
      if (last >= path.size()) continue;
      CAPTURE(first, count);
      const PieceResiduals pieces(path);
      CHECK(std::abs(pieces.residual(first, last, 1) - plain_residual(path, first, last, 1)) < 1e-10);
      if (count < 5) continue;  // a cubic passes through four points
      CHECK(std::abs(pieces.residual(first, last, 3) - plain_residual(path, first, last, 3)) < 1e-10);
    }
  }
}

TEST_CASE("a piece that runs back over itself is no line, although all of it lies on one", "[model]") {
  const Path there_and_back = steps_along({{0.2, 0.5}, {0.8, 0.5}, {0.2, 0.5}}, 101);
  const PieceResiduals pieces(there_and_back);
  CHECK(pieces.residual(0, 50, 1) < 1e-10);
  // The mean square of a triangle wave between 0 and 0.6 em about its mean: 0.6^2 / 12.
  CHECK(std::abs(pieces.residual(0, 100, 1) / 101.0 - 0.36 / 12.0) < 1e-3);
}

TEST_CASE("the elements of a stroke begin at the corners of a path of its shape", "[model]") {
  const Path path = steps_along({{0.1, 0.9}, {0.7, 0.9}, {0.7, 0.2}, {0.6, 0.3}}, 140);  // heng zhe gou
  const double step = path_length(path) / 139.0;
  StrokeDivider divider(path);
  const Division division = divider.divide(typical_stroke(18), typical_stroke(18).elements);
  REQUIRE(division.ends.size() == 4);
  CHECK(division.ends.front() == 0);
  CHECK(division.ends.back() == 139);
  CHECK(std::abs(static_cast<double>(division.ends[1]) * step - 0.6) < 0.03);
  CHECK(std::abs(static_cast<double>(division.ends[2]) * step - 1.3) < 0.03);
  CHECK(division.cost < 1e-4);

  SECTION("and the costs tell the stroke from those with other elements or directions") {
    CHECK(divider.divide(typical_stroke(16), typical_stroke(16).elements).cost > 2.0 * division.cost);  // heng zhe
    CHECK(divider.divide(typical_stroke(12), typical_stroke(12).elements).cost > 2.0 * division.cost);  // shu gou
    CHECK(divider.divide(typical_stroke(36), typical_stroke(36).elements).cost > 2.0 * division.cost);  // pie zhe
  }
}

TEST_CASE("a path of fewer places than elements has no division", "[model]") {
  const Path path = steps_along({{0.1, 0.9}, {0.7, 0.9}}, 3);
  StrokeDivider divider(path);
  CHECK(divider.divide(typical_stroke(18), typical_stroke(18).elements).ends.empty());
}

TEST_CASE("control points of corners lie where the limbs meet, those of a curve on that curve", "[model]") {
  const std::vector<Point> corners{{0.1, 0.9}, {0.7, 0.9}, {0.7, 0.2}};
  const Path bend = steps_along(corners, 100);
  const std::vector<Point> zhe =
      fit_control_points(typical_stroke(16), "LL", bend, std::vector<std::size_t>{0, 46, 99});
  REQUIRE(zhe.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK((zhe[i] - corners[i]).norm() < 0.5 * 0.013);  // half a step of the path

  Path arc;  // a quarter of a circle: a cubic is within 0.03 % of its radius
  for (int i = 0; i <= 90; ++i) {
    const double angle = i * std::numbers::pi / 180.0;
    arc.push_back({0.2 + 0.5 * std::cos(angle), 0.8 - 0.5 * std::sin(angle)});
  }
  const std::vector<Point> pie = fit_control_points(typical_stroke(4), "C", arc, std::vector<std::size_t>{0, 90});
  REQUIRE(pie.size() == 4);
  CHECK((pie.front() - arc.front()).norm() < 2e-3);
  CHECK((pie.back() - arc.back()).norm() < 2e-3);
  for (int i = 0; i <= 20; ++i) {
    const double t = i / 20.0, s = 1.0 - t;
    const Point point = s * s * s * pie[0] + 3 * s * s * t * pie[1] + 3 * s * t * t * pie[2] + t * t * t * pie[3];
    CHECK(std::abs((point - Point(0.2, 0.8)).norm() - 0.5) < 2e-3);
  }
}

}  // namespace stroke_division_tests
