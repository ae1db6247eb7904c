#include "assistance.hpp"

#include <algorithm>
#include <cmath>

namespace calligraphy {

void Assistance::update(const Point& tip, const WriterState& writer) noexcept {
  if (!policy_.enabled) return;
  const bool abandoned = has_event(writer.events, TickEvent::stroke_abandoned);
  if (abandoned || has_event(writer.events, TickEvent::stroke_finished)) {
    const double error = way_ > 0.0 ? std::sqrt(square_ / way_) / em_ : 0.0;
    factor_ = policy_.next(factor_, abandoned ? std::max(error, policy_.full_assistance_error) : error);
  }
  if (writer.state == InteractionState::writing) measure(tip, writer);
}

void Assistance::measure(const Point& tip, const WriterState& writer) noexcept {
  if (has_event(writer.events, TickEvent::stroke_started)) {
    square_ = way_ = 0.0;
    tip_ = tip;
    em_ = writer.em;
  }
  const double way = (tip - tip_).norm();
  square_ += way * writer.contact.closest.distance * writer.contact.closest.distance;
  way_ += way;
  tip_ = tip;
}

}  // namespace calligraphy
