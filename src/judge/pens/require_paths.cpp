#include "require_paths.hpp"

#include <cstddef>
#include <string>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t max_paths = 1000;
constexpr double max_coordinate = 1e9;  // [em]

}  // namespace

void require_paths(std::span<const PenPath> paths) {
  if (paths.size() > max_paths) {
    throw ValueError(std::to_string(paths.size()) + " pen-downs: expected at most " + std::to_string(max_paths));
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string pen_down = "pen-down " + std::to_string(i + 1);
    if (paths[i].empty()) throw ValueError(pen_down + " has no point");
    for (const Point& point : paths[i]) {
      if (!point.allFinite()) throw ValueError(pen_down + " has a point that is not finite");
      if (point.cwiseAbs().maxCoeff() > max_coordinate) {
        throw ValueError(pen_down + " has a point " + number_text(point.cwiseAbs().maxCoeff()) +
                         " em away, expected at most " + number_text(max_coordinate));
      }
    }
  }
}

}  // namespace calligraphy
