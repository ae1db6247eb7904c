// The result of one servo tick, for recorders, displays and tests.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/render/interaction_state.hpp>

namespace calligraphy {

/// What happened in a tick; bit flags.
enum class TickEvent : std::uint16_t {
  none = 0,                     ///< nothing but the passing of time
  contact = 1 << 0,             ///< the pen touched the paper
  lift = 1 << 1,                ///< the pen left the paper
  stroke_started = 1 << 2,      ///< the first stretch of the active stroke was written: guidance begins
  feature_passed = 1 << 3,      ///< a feature point of the active stroke was passed
  /// A stroke was written; `stroke` of this tick is already the next. At its end; within 50 ms of where the pen left
  /// the paper; or, if it was in doubt, together with the next stroke_started, with the contact at the next character,
  /// or after 1 s in the air at the end of a page.
  stroke_finished = 1 << 4,
  /// A stroke was left before its end, and its trace is to be cleared: within 50 ms of where the pen left it, or, if it
  /// was in doubt, together with the next stroke_started, which writes it anew.
  stroke_abandoned = 1 << 5,
  character_finished = 1 << 6,  ///< the last stroke of a character was finished
  page_finished = 1 << 7        ///< the last character of the page was finished
};

/// The events of `a` and of `b`.
constexpr TickEvent operator|(TickEvent a, TickEvent b) noexcept {
  return static_cast<TickEvent>(static_cast<std::uint16_t>(a) | static_cast<std::uint16_t>(b));
}
/// Adds the events of `b` to `a`.
constexpr TickEvent& operator|=(TickEvent& a, TickEvent b) noexcept { return a = a | b; }
/// Whether `event`, or any of several, is among the events.
constexpr bool has_event(TickEvent events, TickEvent event) noexcept {
  return (static_cast<std::uint16_t>(events) & static_cast<std::uint16_t>(event)) != 0;
}

/// Whether the sample of this tick was usable.
enum class TickStatus : std::uint8_t {
  ok,           ///< a fresh sample
  stale,        ///< the device reports no new sample: the force is held for 4 ms, then ramps down to zero
  /// A position that is not finite, that no hand can have reached (a jump: ForceLimits::max_acceleration, max_speed),
  /// or from a sensor that stands still (max_standstill): the force ramps down to zero.
  bad_sample,
  device_fault,  ///< reported by the device: the force ramps down to zero
  /// 50 samples in a row, each 300 periods of the servo rate later than the last: the times are not in seconds, or the
  /// loop does not run at its rate. Dampers then have no velocity to go by: the force ramps down to zero.
  bad_clock,
  bad_law  ///< the guidance law threw, or its force is not finite: the force ramps down, and returns with the law
};

/// Whether the sample says where the pen is, which a failing guidance law does not affect.
constexpr bool has_position(TickStatus status) noexcept {
  return status == TickStatus::ok || status == TickStatus::bad_law;
}

/// "ok", "stale", "bad_sample", "device_fault", "bad_clock", "bad_law".
const char* to_string(TickStatus status) noexcept;

/// Why a pen on the paper is not guided, or less than it should be, and what a lifted one left in doubt, for a display
/// to show.
enum class WritingHint : std::uint8_t {
  none,             ///< guided, not on the paper, or back on it once everything is written
  write,            ///< at the start of the stroke that is due: write on
  too_far,          ///< too far from the start: `to_start` says where it is
  at_end,           ///< at the stroke's end
  in_middle,        ///< in the middle of the stroke
  wrong_direction,  ///< at the start, but moving another way
  another_stroke,   ///< moving as if to begin another stroke
  off_stroke,       ///< writing, but too far from the stroke or pulled aside: `contact.closest` is where to return
  lift_first,       ///< lift the pen first: the previous stroke has just been finished
  warm_motors,      ///< guided, but the warm motors permit less force than that takes: let them rest
  lifted_early      ///< in the air, after a stroke that is perhaps too short: begin the next one, or write it again
};

/// "none", "write", "too_far", "at_end", "in_middle", "wrong_direction", "another_stroke", "off_stroke", "lift_first",
/// "warm_motors", "lifted_early"; for people hint_text() of `practice` puts it into words.
const char* to_string(WritingHint hint) noexcept;

/// Result of one servo tick.
struct HapticTick {
  double time = 0.0;                                      ///< sample time [s]
  TickStatus status = TickStatus::ok;                     ///< whether the sample was usable
  InteractionState state = InteractionState::separation;  ///< after this sample
  TickEvent events = TickEvent::none;                     ///< what happened with this sample
  int character = 0;  ///< index of the active character; the number of characters once all are written
  int stroke = 0;     ///< index of the active stroke; the number of strokes from the end of the last one until the lift
  Eigen::Vector3d device_point = Eigen::Vector3d::Zero();  ///< haptic interface point, page frame [m]
  Eigen::Vector3d pen_tip = Eigen::Vector3d::Zero();       ///< virtual pen tip, page frame [m]
  double penetration = 0.0;                                ///< depth of the device point in the paper [m]
  StrokeContact contact;  ///< valid in the writing state, in the tick that leaves it, and for hints on the stroke
  double covered = 0.0;   ///< share of the stroke written last that was covered in order [1]
  WritingHint hint = WritingHint::none;  ///< why a pen on the paper is not guided, or what it left in doubt
  Point to_start = Point::Zero();        ///< from the pen tip to the start of the active, or last, stroke [m, page]
  Point attraction = Point::Zero();      ///< force term, including assistance, before fade-in and limits [N, page]
  Point wrong_way = Point::Zero();       ///< force term, before fade-in and limits [N, page]
  Point friction = Point::Zero();        ///< force term, before limits [N, page]
  double normal = 0.0;                   ///< force term, damping included, before limits [N, out of the paper]
  /// Damping by guidance, before fade-in, by friction and by the paper, before limits [N, page].
  Eigen::Vector3d viscous = Eigen::Vector3d::Zero();
  double assistance = 1.0;    ///< factor on the guidance, from the assist policy [1]
  double energy_given = 0.0;  ///< net energy delivered to the hand, as observed; 0 without a budget [J]
  double heat = 0.0;  ///< heat of the motors; 1: in equilibrium at the continuous force; 0 without thermal budget [1]
  Eigen::Vector3d page_force = Eigen::Vector3d::Zero();  ///< the force as sent, on the pen, page axes [N]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< the force as sent, to be written to the device, device axes [N]
};

static_assert(std::is_trivially_destructible_v<HapticTick>);

}  // namespace calligraphy
