#include <calligraphy/render/detail/prepared_page.hpp>

#include <algorithm>
#include <string>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/render/detail/pen_sensor.hpp>

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
  constexpr double most = PenSensor::max_coordinate;
  if (!(std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()) <= most)) {
    throw ValueError(place + "it reaches further than " + number_text(most) + " m from the page's origin");
  }
}

}  // namespace

void validate(const std::vector<PlacedCharacter>& page) {
  if (page.empty()) throw ValueError("the page has no character");
  for (std::size_t i = 0; i < page.size(); ++i) require_valid(page[i], i);
}

PreparedPage::PreparedPage(std::vector<PlacedCharacter> characters, const RendererOptions& options)
    : characters_(std::move(characters)) {
  for (const PlacedCharacter& placed : characters_) {
    Eigen::AlignedBox2d box = bounding_box(placed);
    box.min().array() -= options.contact.box_margin * placed.placement.em;
    box.max().array() += options.contact.box_margin * placed.placement.em;
    std::vector<PreparedStroke> prepared;
    prepared.reserve(static_cast<std::size_t>(placed.character.stroke_count()));
    for (const Stroke& stroke : strokes(placed.character)) {
      PreparedStroke& next = prepared.emplace_back();
      next.geometry.load(stroke, placed.placement);
      next.follower.load(next.geometry, placed.placement.em, options.tolerances);
    }
    prepared_.push_back({placed.placement.em, std::move(prepared), stroke_starts(placed, options.tolerances), box});
  }
}

}  // namespace calligraphy
