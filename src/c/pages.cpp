#include <algorithm>
#include <cmath>
#include <string_view>

#include <calligraphy/model/character_text.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/stroke_polyline.hpp>
#include <calligraphy/model/typical_ink.hpp>

#include "conversions.hpp"
#include "model/code_point_name.hpp"
#include "objects.hpp"
#include "structs.hpp"

namespace calligraphy::c {
namespace {

PageLayout layout_of(const calligraphy_layout* given) {
  PageLayout result;
  if (!given) return result;
  const calligraphy_layout layout = read_struct(given, "calligraphy_layout");
  set_if_given(result.width, layout.width, "layout.width", "m");
  set_if_given(result.height, layout.height, "layout.height", "m");
  const double usual = result.em;
  set_if_given(result.em, layout.em, "layout.em", "m");
  result.gap *= result.em / usual;
  set_if_given(result.gap, layout.gap, "layout.gap", "m");
  return result;
}

const PlacedCharacter& character_of(const calligraphy_page* page, std::int32_t index) {
  const PracticePage& found = object<PracticePage>(page);
  require_index("character", index, found.characters.size());
  return found.characters[static_cast<std::size_t>(index)];
}

Stroke stroke_of(const Character& character, std::int32_t index) {
  const std::vector<Stroke> all = strokes(character);
  require_index("stroke", index, all.size());
  return all[static_cast<std::size_t>(index)];
}

/// The polyline or the outline of a stroke [em].
std::vector<Point> shape_of(const Character& character, std::int32_t index, std::int32_t shape, double tolerance) {
  if (enumeration("shape", shape, CALLIGRAPHY_OUTLINE) == CALLIGRAPHY_PATH) {
    return stroke_polyline(stroke_of(character, index), tolerance);
  }
  if (!character.physics.ink.empty()) return ink_outline(stroke_of(character, index), tolerance);
  const Character inked = with_typical_ink(character);
  return ink_outline(stroke_of(inked, index), tolerance);
}

}  // namespace

Character find_character(const CharacterSet& set, char32_t code) {
  const std::optional<StoredCharacter> found = set.find(code);
  if (!found) throw Refusal(CALLIGRAPHY_NOT_FOUND, "the set has no character " + code_point_name(code));
  return found->character();
}

Beginning start_of(const Stroke& stroke, const Placement& placement) {
  const std::vector<StrokeElement> elements = place_elements(stroke, placement);
  return {elements.front().origin(), elements.front().tangent(0.0)};
}

}  // namespace calligraphy::c

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_page_lay_out(const calligraphy_set* set, const char* text,
                                            const calligraphy_layout* layout, int32_t* placed,
                                            calligraphy_page** page) {
  return guarded([&] {
    const CharacterSet& from = object<CharacterSet>(set);
    target(page, "page");
    std::vector<Character> characters;
    for (const TextCharacter& each : text_characters(&target(text, "text"))) {
      characters.push_back(find_character(from, each.code_in(from)));
    }
    if (characters.empty()) throw Refusal(CALLIGRAPHY_INVALID_VALUE, "text is empty");
    PracticePage first = std::move(lay_out(characters, layout_of(layout)).front());
    const auto count = static_cast<std::int32_t>(first.characters.size());
    if (!placed && first.characters.size() < characters.size()) {
      throw Refusal(CALLIGRAPHY_INVALID_VALUE, "text: " + std::to_string(count) + " of " +
                                                   std::to_string(characters.size()) +
                                                   " characters fit on the page, and placed is null");
    }
    hand_out(page, std::make_shared<PracticePage>(std::move(first)));
    if (placed) *placed = count;
  });
}

calligraphy_status calligraphy_page_read_info(const calligraphy_page* page, calligraphy_page_info* info) {
  return guarded([&] {
    const PracticePage& found = object<PracticePage>(page);
    write_struct(info, "calligraphy_page_info",
                 {.size = 0,
                  .character_count = static_cast<std::int32_t>(found.characters.size()),
                  .width = found.width,
                  .height = found.height});
  });
}

calligraphy_status calligraphy_page_character(const calligraphy_page* page, int32_t character,
                                              calligraphy_placed_character* result) {
  return guarded([&] {
    const PlacedCharacter& placed = character_of(page, character);
    const Point& origin = placed.placement.origin;
    write_struct(result, "calligraphy_placed_character",
                 {.size = 0,
                  .code = placed.character.code,
                  .stroke_count = placed.character.stroke_count(),
                  .has_ink = !placed.character.physics.ink.empty(),
                  .origin = {origin.x(), origin.y()},
                  .em = placed.placement.em});
  });
}

calligraphy_status calligraphy_page_stroke(const calligraphy_page* page, int32_t character, int32_t stroke,
                                           calligraphy_stroke* result) {
  return guarded([&] {
    const PlacedCharacter& placed = character_of(page, character);
    const Stroke found = stroke_of(placed.character, stroke);
    calligraphy_stroke filled = {};
    filled.id = found.type->id;
    filled.element_count = static_cast<std::int32_t>(found.elements.size());
    for (const StrokeElement& element : place_elements(found, placed.placement)) filled.length += element.length();
    const Beginning start = start_of(found, placed.placement);
    to_array(start.start, filled.start);
    to_array(start.direction, filled.direction);
    to_array(placed.placement.to_page(found.control_points.back()), filled.end);
    write_struct(result, "calligraphy_stroke", filled);
  });
}

calligraphy_status calligraphy_page_polyline(const calligraphy_page* page, int32_t character, int32_t stroke,
                                             int32_t shape, double tolerance, double* points, size_t capacity,
                                             size_t* count) {
  return guarded([&] {
    const PlacedCharacter& placed = character_of(page, character);
    target(count, "count");
    const Placement& placement = placed.placement;
    const double in_em = tolerance == 0.0 ? 1e-4 : tolerance / placement.em;
    if (!(in_em > 0.0 && std::isfinite(in_em))) {
      throw Refusal(CALLIGRAPHY_INVALID_VALUE,
                    "tolerance = " + number_text(tolerance) + " m, must be finite and 0 or above");
    }
    const std::vector<Point> polyline = shape_of(placed.character, stroke, shape, in_em);
    *count = polyline.size();
    if (!points) return;
    if (capacity < polyline.size()) {
      throw Refusal(CALLIGRAPHY_TOO_SMALL, "capacity = " + std::to_string(capacity) + ", but the stroke has " +
                                               std::to_string(polyline.size()) + " points");
    }
    for (const Point& point : polyline) {
      const Point on_page = placement.to_page(point);
      *points++ = on_page.x();
      *points++ = on_page.y();
    }
  });
}

calligraphy_status calligraphy_page_mapping(const calligraphy_page* page, int32_t pose, double scale,
                                            calligraphy_mapping* mapping) {
  return guarded([&] {
    const PracticePage& found = object<PracticePage>(page);
    const bool upright = enumeration("pose", pose, CALLIGRAPHY_DESK) == CALLIGRAPHY_UPRIGHT;
    const MotionMapping result =
        upright ? upright_page(found.width, found.height, scale) : desk_page(found.width, found.height, scale);
    validate(result);
    write_struct(mapping, "calligraphy_mapping", to_c(result));
  });
}

calligraphy_status calligraphy_mapping_to_device(const calligraphy_mapping* mapping, const double* page,
                                                 double* device) {
  return guarded([&] {
    target(device, "device");
    const Eigen::Vector3d position = mapping_of(mapping).to_device(vector_of(page, "page", "m"));
    std::copy_n(position.data(), 3, device);
  });
}
