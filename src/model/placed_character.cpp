#include <calligraphy/model/placed_character.hpp>

#include <algorithm>
#include <cstddef>
#include <string>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"

namespace calligraphy {
namespace {

void require_valid(const PlacedCharacter& placed, std::size_t index) {
  const std::string place = "character " + std::to_string(index + 1) + " of the page: ";
  const std::vector<ValidationIssue> problems = validate(placed.character);
  if (!problems.empty()) {
    throw ValueError(place + "stroke " + std::to_string(problems[0].stroke) + ": " + problems[0].what);
  }
  require_within(place + "em", placed.placement.em, "m", Placement::min_em, Placement::max_em);
  if (!placed.placement.origin.allFinite()) throw ValueError(place + "its origin is not finite");
  const Eigen::AlignedBox2d box = bounding_box(placed);
  constexpr double most = Placement::max_coordinate;
  if (!(std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()) <= most)) {
    throw ValueError(place + "it reaches further than " + number_text(most) + " m from the page's origin");
  }
}

}  // namespace

Eigen::AlignedBox2d bounding_box(const PlacedCharacter& placed) {
  Eigen::AlignedBox2d box;
  for (const Point& point : placed.character.structure.control_points) box.extend(placed.placement.to_page(point));
  return box;
}

void validate(std::span<const PlacedCharacter> page) {
  if (page.empty()) throw ValueError("the page has no character");
  for (std::size_t i = 0; i < page.size(); ++i) require_valid(page[i], i);
}

}  // namespace calligraphy
