// Ticks of the C interface.
#pragma once

#include <algorithm>

#include "conversions.hpp"
#include "objects.hpp"
#include "structs.hpp"

namespace calligraphy::c {

/// Checks that a tick can be written.
inline calligraphy_status check_tick(const calligraphy_tick* tick) noexcept {
  return check_size(tick, "calligraphy_tick");
}

/// Clears the force and the events of a tick, unless it is null, for callers who do not look at the status. Returns
/// the status.
inline calligraphy_status without_force(calligraphy_tick* tick, calligraphy_status failure) noexcept {
  if (!tick) return failure;
  std::fill_n(tick->force, 3, 0.0);
  std::fill_n(tick->page_force, 3, 0.0);
  tick->events = 0;
  return failure;
}

/// Fills all members of a tick except its size. `next`: where the stroke that is due begins.
inline void fill_tick(const HapticTick& from, const Beginning& next, calligraphy_tick* to) noexcept {
  to->status = static_cast<std::int32_t>(from.status);
  to->state = static_cast<std::int32_t>(from.state);
  to->events = static_cast<std::uint32_t>(from.events);
  to->hint = static_cast<std::int32_t>(from.hint);
  to->character = from.character;
  to->stroke = from.stroke;
  to->element = from.contact.element;
  to->time = from.time;
  to_array(from.force, to->force);
  to_array(from.page_force, to->page_force);
  to_array(from.device_point, to->device_point);
  to_array(from.pen_tip, to->pen_tip);
  to->penetration = from.penetration;
  to_array(next.start, to->next_start);
  to_array(next.direction, to->next_direction);
  to_array(from.to_start, to->to_start);
  to->covered = from.covered;
  to_array(from.contact.closest.point, to->closest);
  to_array(from.contact.closest.tangent, to->tangent);
  to->distance = from.contact.closest.distance;
  to->arc = from.contact.arc;
  to->backwards = from.contact.backwards;
  to_array(from.attraction, to->attraction);
  to_array(from.wrong_way, to->wrong_way);
  to_array(from.friction, to->friction);
  to_array(from.viscous, to->viscous);
  to->normal = from.normal;
  to->assistance = from.assistance;
  to->energy_given = from.energy_given;
  to->heat = from.heat;
}

/// Writes the renderer's last tick to a struct that check_size() has accepted. Does not allocate.
inline void write_tick(const RendererObject& renderer, calligraphy_tick* to) noexcept {
  const HapticTick& from = renderer.renderer.last();
  if (to->size >= sizeof(calligraphy_tick)) {  // in place: a copy would be half the cost of the call
    fill_tick(from, renderer.next(from), to);
    clear_rest(to);
  } else {
    calligraphy_tick tick;
    fill_tick(from, renderer.next(from), &tick);
    put_struct(to, tick);
  }
}

}  // namespace calligraphy::c
