#include "prepared_page.hpp"

#include <utility>

namespace calligraphy {
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
      next.follower.load(next.geometry, placed.placement.em, options.tolerances, options.servo_rate);
      next.shape = shape_of(next.geometry, placed.placement.em);
    }
    prepared_.push_back({placed.placement.em, std::move(prepared), stroke_starts(placed, options.tolerances), box});
  }
}

}  // namespace calligraphy
