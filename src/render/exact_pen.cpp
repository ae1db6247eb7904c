#include "exact_pen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"
#include "stroke_sequencer.hpp"

namespace calligraphy {
namespace {

/// Maximum distance between samples [em].
constexpr double max_spacing = 0.005;

bool is_preset(const StrokeTolerances& tolerances) {
  const std::array presets = {StrokeTolerances::lenient(), StrokeTolerances::normal(), StrokeTolerances::strict()};
  return std::find(presets.begin(), presets.end(), tolerances) != presets.end();
}

TickEvent draw(StrokeSequencer& sequencer, const Stroke& stroke, const Placement& placement) {
  TickEvent events = TickEvent::none;
  PenState pen;
  const auto move = [&](const Point& tip, bool contact) {
    pen.tip.head<2>() = tip;
    pen.contact = pen.on_paper = contact;
    events |= sequencer.update(pen).events;
  };
  Point tip = placement.to_page(stroke.control_points.front());
  move(tip, true);
  for (const StrokeElement& element : place_elements(stroke, placement)) {
    const int count = static_cast<int>(std::ceil(element.length() / (max_spacing * placement.em)));
    for (int i = 1; i <= count; ++i) {
      tip = element.point(element.parameter_at(element.length() * i / count));
      move(tip, true);
    }
  }
  for (int i = 0; i < ShapeFit::max_steps + 2; ++i) move(tip, false);
  return events;
}

}  // namespace

void require_exact_pen_accepted(const std::vector<PlacedCharacter>& page, const RendererOptions& options,
                                const Capabilities& capabilities, const MotionMapping& mapping) {
  const StrokeTolerances& tolerances = options.tolerances;
  if (is_preset(tolerances) || tolerances.coverage == 0.0) return;
  for (std::size_t i = 0; i < page.size(); ++i) {
    StrokeSequencer sequencer({page[i]}, options, capabilities, mapping, true);
    int number = 0;
    for (const Stroke& stroke : strokes(page[i].character)) {
      ++number;
      const TickEvent events = draw(sequencer, stroke, page[i].placement);
      if (has_event(events, TickEvent::stroke_finished)) continue;
      Message message;
      message << "character " << i + 1 << " of the page: stroke " << number << ": drawn exactly, it would not be ";
      if (has_event(events, TickEvent::stroke_started)) {
        message << "finished with tolerances.first_stretch = " << tolerances.first_stretch
                << " em, tolerances.corridor = " << tolerances.corridor << " em, tolerances.coverage = "
                << tolerances.coverage << " and tolerances.slack = " << tolerances.slack << " em";
      } else {
        message << "begun with tolerances.start_distance = " << tolerances.start_distance
                << " em, tolerances.direction = " << tolerances.direction << " rad, tolerances.first_stretch = "
                << tolerances.first_stretch << " em and tolerances.distinction = " << tolerances.distinction;
      }
      throw ValueError(message.str());
    }
  }
}

}  // namespace calligraphy
