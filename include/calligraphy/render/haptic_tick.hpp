// All that one servo tick found and did, for recorders, displays and tests.
#pragma once

#include <cstdint>
#include <type_traits>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/render/interaction_state.hpp>

namespace calligraphy {

/// What happened in a tick; a set of bits.
enum class TickEvent : std::uint16_t {
  none = 0,
  contact = 1 << 0,  ///< the pen touched the paper
  lift = 1 << 1,     ///< the pen left the paper
  stroke_started = 1 << 2,
  feature_passed = 1 << 3,
  stroke_finished = 1 << 4,
  stroke_abandoned = 1 << 5,  ///< given up before its end; its trace is to be cleared
  character_finished = 1 << 6,
  page_finished = 1 << 7
};

constexpr TickEvent operator|(TickEvent a, TickEvent b) noexcept {
  return static_cast<TickEvent>(static_cast<std::uint16_t>(a) | static_cast<std::uint16_t>(b));
}
constexpr TickEvent& operator|=(TickEvent& a, TickEvent b) noexcept { return a = a | b; }
constexpr bool has_event(TickEvent events, TickEvent event) noexcept {
  return (static_cast<std::uint16_t>(events) & static_cast<std::uint16_t>(event)) != 0;
}

/// Whether the sample of this tick could be used.
enum class TickStatus : std::uint8_t {
  ok,
  bad_sample,   ///< not finite, or further away than a pen can have moved: the force goes to zero
  device_fault  ///< the device said so itself: the force goes to zero
};

/// "ok", "bad_sample", "device_fault".
const char* to_string(TickStatus status) noexcept;

struct HapticTick {
  double time = 0.0;  ///< of the sample [s]
  TickStatus status = TickStatus::ok;
  InteractionState state = InteractionState::separation;
  TickEvent events = TickEvent::none;
  int character = 0;  ///< index of the active character; their number once all are written
  int stroke = 0;     ///< index of the active stroke within it; their number from the end of the last until the lift
  Eigen::Vector3d device_point = Eigen::Vector3d::Zero();  ///< haptic interface point, page frame [m]
  Eigen::Vector3d pen_tip = Eigen::Vector3d::Zero();       ///< virtual pen tip, page frame [m]
  double penetration = 0.0;                                ///< of the device point into the paper [m]
  StrokeContact contact;             ///< meaningful in the writing state and on the tick that leaves it
  Point attraction = Point::Zero();  ///< force term, assistance included, before fade-in and limits [N, page]
  Point wrong_way = Point::Zero();   ///< force term, before fade-in and limits [N, page]
  Point friction = Point::Zero();    ///< force term, before limits [N, page]
  double normal = 0.0;               ///< force term, before limits [N, out of the paper]
  Eigen::Vector3d damping = Eigen::Vector3d::Zero();  ///< of the passivity controller, before limits [N, page]
  double assistance = 1.0;                            ///< share of the guidance that the assist policy gives
  double energy_given = 0.0;  ///< net, to the hand, as the passivity observer has it; 0 without one [J]
  double heat = 0.0;          ///< of the motors; 1: that of the continuous force; 0 without a thermal budget
  Eigen::Vector3d page_force = Eigen::Vector3d::Zero();  ///< sent, page axes [N]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();       ///< sent, device axes [N]
};

static_assert(std::is_trivially_destructible_v<HapticTick>);

}  // namespace calligraphy
