#include <calligraphy/render/haptic_tick.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace calligraphy {
namespace {

/// "12 mm to the upper left", by the nearest of eight directions.
std::string way_text(const Point& way) {
  constexpr std::array directions = {"to the right", "to the upper right", "straight up",   "to the upper left",
                                     "to the left",  "to the lower left",  "straight down", "to the lower right"};
  const double eighths = std::atan2(way.y(), way.x()) / (0.25 * std::numbers::pi);
  const auto direction = static_cast<std::size_t>(std::lround(eighths) + 8) % directions.size();
  const long millimetres = std::max(1L, std::lround(std::min(1000.0 * way.norm(), 1e9)));
  return std::to_string(millimetres) + " mm " + directions[direction];
}

}  // namespace

const char* to_string(TickStatus status) noexcept {
  switch (status) {
    case TickStatus::ok:
      return "ok";
    case TickStatus::stale:
      return "stale";
    case TickStatus::bad_sample:
      return "bad_sample";
    case TickStatus::device_fault:
      return "device_fault";
    case TickStatus::bad_clock:
      return "bad_clock";
    case TickStatus::bad_law:
      return "bad_law";
  }
  return "";
}

const char* to_string(WritingHint hint) noexcept {
  switch (hint) {
    case WritingHint::none:
      return "";
    case WritingHint::write:
      return "write on";
    case WritingHint::too_far:
      return "too far from the start";
    case WritingHint::at_end:
      return "at the stroke's end";
    case WritingHint::in_middle:
      return "in the middle of the stroke";
    case WritingHint::wrong_direction:
      return "wrong direction";
    case WritingHint::another_stroke:
      return "another stroke's start";
    case WritingHint::off_stroke:
      return "too far from the stroke";
    case WritingHint::lift_first:
      return "lift the pen first";
    case WritingHint::warm_motors:
      return "the motors are warm: less force";
  }
  return "";
}

std::string hint_text(WritingHint hint, const Point& to_start) {
  const std::string words = to_string(hint);
  if (!to_start.allFinite()) return words;
  switch (hint) {
    case WritingHint::too_far:
      return words + ": " + way_text(to_start);
    case WritingHint::another_stroke:
      return words + ": that of the one due is " + way_text(to_start);
    case WritingHint::at_end:
    case WritingHint::in_middle:
      return words + ": the start is " + way_text(to_start);
    case WritingHint::none:
    case WritingHint::write:
    case WritingHint::wrong_direction:
    case WritingHint::off_stroke:
    case WritingHint::lift_first:
    case WritingHint::warm_motors:
      break;
  }
  return words;
}

}  // namespace calligraphy
