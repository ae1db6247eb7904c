// Conversions between the structs of the C interface and those of C++.
#pragma once

#include <cmath>
#include <cstdint>

#include <calligraphy/c/calligraphy.h>
#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

#include "base/require.hpp"
#include "call.hpp"

namespace calligraphy::c {

/// Copies a vector to an array of its size.
template <class Vector, std::size_t size>
void to_array(const Vector& from, double (&to)[size]) noexcept {
  static_assert(Vector::RowsAtCompileTime == size);
  for (std::size_t i = 0; i < size; ++i) to[i] = from[static_cast<Eigen::Index>(i)];
}

/// Sets an option unless zero is given, for the default. @throws ValueError if it is below zero or not finite
inline void set_if_given(double& option, double given, const char* name, const char* unit) {
  require_not_negative(name, given, unit);
  if (given > 0.0) option = given;
}

/// Three numbers. @throws ValueError naming them if one is not finite, Refusal if they are null
inline Eigen::Vector3d vector_of(const double* from, const char* name, const char* unit) {
  target(from, name);
  const Eigen::Vector3d result(from[0], from[1], from[2]);
  for (const double value : result) require(std::isfinite(value), name, value, unit, "finite");
  return result;
}

/// @throws Refusal if a pointer is null or the struct's size is wrong
MotionMapping mapping_of(const calligraphy_mapping* from);
calligraphy_mapping to_c(const MotionMapping& from) noexcept;

/// @throws Refusal as mapping_of()
Capabilities capabilities_of(const calligraphy_capabilities* from);
calligraphy_capabilities to_c(const Capabilities& from) noexcept;

/// @throws Refusal as mapping_of(), and if an enumeration has no such value
RendererOptions options_of(const calligraphy_renderer_options* from);
calligraphy_renderer_options to_c(const RendererOptions& from) noexcept;

/// The StrokeTolerances or JudgeTolerances of a calligraphy_tolerance. @throws Refusal if there is no such value
template <class Tolerances>
Tolerances tolerances_of(std::int32_t tolerance) {
  switch (enumeration("tolerance", tolerance, CALLIGRAPHY_TOLERANCE_STRICT)) {
    case CALLIGRAPHY_TOLERANCE_LENIENT:
      return Tolerances::lenient();
    case CALLIGRAPHY_TOLERANCE_STRICT:
      return Tolerances::strict();
    default:
      return Tolerances::normal();
  }
}

/// Converts a sample whose size check_size() has accepted. Unknown values are NaN; an invalid status counts as a fault.
DeviceState state_of(const calligraphy_device_state* from) noexcept;
calligraphy_device_state to_c(const DeviceState& from) noexcept;

/// Converts what a pen senses; null: nothing. Refuses a struct of the wrong size, and bits that this version does not
/// know. Does not allocate.
calligraphy_status read_stylus(const calligraphy_stylus* from, StylusState& to) noexcept;

}  // namespace calligraphy::c
