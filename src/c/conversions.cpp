#include "conversions.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <string>

#include "base/stylus_fields.hpp"
#include "guidance.hpp"
#include "structs.hpp"

namespace calligraphy::c {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Calls `exchange(name, option of C, option of C++)` for every option of a renderer.
template <class C, class Options, class Exchange>
void each_option(C& c, Options& o, const Exchange& exchange) {
  const auto choice = [&](const char* name, auto& here, auto& there, auto last) { exchange(name, here, there, last); };
  choice("rules", c.rules, o.rules, Rules::wang2006);
  choice("stiffness_check", c.stiffness_check, o.stiffness_check, StiffnessCheck::off);
  choice("nearest_method", c.nearest_method, o.nearest.method, NearestPointMethod::wang2006);
  exchange("guidance_law", c.guidance_law, c.guidance_functions, o.guidance.force);

  exchange(c.nearest_tolerance, o.nearest.tolerance);
  exchange(c.nearest_samples, o.nearest.samples);
  exchange(c.nearest_refinements, o.nearest.refinements);
  exchange(c.servo_rate, o.servo_rate);
  exchange(c.velocity_cutoff, o.velocity_cutoff);
  exchange(c.grip_stiffness, o.grip_stiffness);

  exchange(c.paper_stiffness, o.paper.stiffness);
  exchange(c.paper_damping, o.paper.damping);
  exchange(c.paper_onset, o.paper.onset);
  exchange(c.paper_friction_coefficient, o.paper.friction.coefficient);
  exchange(c.paper_friction_stiffness, o.paper.friction.stiffness);
  exchange(c.paper_friction_damping, o.paper.friction.damping);

  exchange(c.guidance_to_start, o.guidance.to_start);
  exchange(c.guidance_stiffness, o.guidance.stiffness);
  exchange(c.guidance_damping, o.guidance.damping);
  exchange(c.guidance_limit, o.guidance.limit);
  exchange(c.guidance_radius, o.guidance.space.radius);
  exchange(c.guidance_fade_width, o.guidance.space.fade_width);
  exchange(c.guidance_fade_in, o.guidance.fade_in);
  exchange(c.guidance_fade_out, o.guidance.fade_out);
  exchange(c.guidance_wrong_way_stiffness, o.guidance.wrong_way_stiffness);
  exchange(c.guidance_wrong_way_limit, o.guidance.wrong_way_limit);
  exchange(c.guidance_wrong_way_slack, o.guidance.wrong_way_slack);
  exchange(c.assist_enabled, o.guidance.assist.enabled);
  exchange(c.assist_retention, o.guidance.assist.retention);
  exchange(c.assist_full_error, o.guidance.assist.full_assistance_error);
  exchange(c.assist_min, o.guidance.assist.min_assistance);

  exchange(c.contact_lift_time, o.contact.lift_time);
  exchange(c.contact_lift_clearance, o.contact.lift_clearance);
  exchange(c.contact_lift_between_strokes, o.contact.lift_between_strokes);
  exchange(c.contact_box_margin, o.contact.box_margin);

  exchange(c.tolerance_start_distance, o.tolerances.start_distance);
  exchange(c.tolerance_direction, o.tolerances.direction);
  exchange(c.tolerance_first_stretch, o.tolerances.first_stretch);
  exchange(c.tolerance_distinction, o.tolerances.distinction);
  exchange(c.tolerance_corridor, o.tolerances.corridor);
  exchange(c.tolerance_coverage, o.tolerances.coverage);
  exchange(c.tolerance_slack, o.tolerances.slack);
  exchange(c.tolerance_next_decides, o.tolerances.next_decides);

  exchange(c.limit_in_plane_rate, o.limits.in_plane_rate);
  exchange(c.limit_normal_rate, o.limits.normal_rate);
  exchange(c.limit_thermal_time_constant, o.limits.thermal_time_constant);
  exchange(c.limit_max_speed, o.limits.max_speed);
  exchange(c.limit_max_acceleration, o.limits.max_acceleration);
  exchange(c.limit_max_standstill, o.limits.max_standstill);
  exchange(c.energy_budget, o.energy.budget);
  exchange(c.energy_max_gap, o.energy.max_gap);
}

/// The built-in laws, in the order of calligraphy_guidance_law.
constexpr GuidanceFactory::Make* guidance_laws[] = {linear_guidance, saturating_guidance, printed_guidance};

struct FromC {
  void operator()(double here, double& there) const { there = here; }
  void operator()(std::int32_t here, int& there) const { there = here; }
  void operator()(std::int32_t here, bool& there) const { there = here != 0; }
  void operator()(const char* name, std::int32_t here, const calligraphy_guidance_functions* functions,
                  GuidanceFactory& there) const {
    if (enumeration(name, here, CALLIGRAPHY_GUIDANCE_OWN) == CALLIGRAPHY_GUIDANCE_OWN) {
      there = guidance_of(functions);
    } else if (functions) {
      throw Refusal(CALLIGRAPHY_INVALID_VALUE, std::string("guidance_functions are set, but ") + name + " = " +
                                                   std::to_string(here) + " is not CALLIGRAPHY_GUIDANCE_OWN");
    } else {
      there = guidance_laws[here];
    }
  }
  template <class Choice>
  void operator()(const char* name, std::int32_t here, Choice& there, Choice last) const {
    there = enumeration(name, here, last);
  }
};

struct ToC {
  void operator()(double& here, double there) const { here = there; }
  template <class Value>
  void operator()(std::int32_t& here, Value there) const {
    here = static_cast<std::int32_t>(there);
  }
  void operator()(const char*, std::int32_t& here, const calligraphy_guidance_functions*& functions,
                  const GuidanceFactory& there) const {
    functions = nullptr;
    const auto is_this = [&](auto law) { return there.is(law); };
    here = static_cast<std::int32_t>(
        std::find_if(std::begin(guidance_laws), std::end(guidance_laws), is_this) - guidance_laws);
  }
  template <class Choice>
  void operator()(const char*, std::int32_t& here, Choice there, Choice) const {
    here = static_cast<std::int32_t>(there);
  }
};

Eigen::Vector3d known(std::int32_t is_known, const double (&from)[3]) noexcept {
  return is_known ? Eigen::Vector3d(from[0], from[1], from[2]) : Eigen::Vector3d::Constant(unknown);
}

using State = calligraphy_device_state;
using Stylus = calligraphy_stylus;

// In the order of stylus_fields and of the bits of calligraphy_stylus_quantity.
constexpr double Stylus::*stylus_members[] = {&Stylus::pressure, &Stylus::force, &Stylus::altitude,
                                              &Stylus::azimuth,  &Stylus::twist, &Stylus::height};
constexpr double State::*state_members[] = {&State::stylus_pressure, &State::stylus_force, &State::stylus_altitude,
                                            &State::stylus_azimuth,  &State::stylus_twist, &State::stylus_height};
static_assert(std::size(stylus_members) == stylus_fields.size() && std::size(state_members) == stylus_fields.size());

template <class Struct>
StylusState sensed(std::uint32_t is_known, const Struct& from, double Struct::*const (&members)[6]) noexcept {
  StylusState result;
  for (std::size_t i = 0; i < stylus_fields.size(); ++i) {
    if (is_known >> i & 1u) result.*stylus_fields[i].member = from.*members[i];
  }
  return result;
}

}  // namespace

MotionMapping mapping_of(const calligraphy_mapping* from) {
  const calligraphy_mapping mapping = read_struct(from, "calligraphy_mapping");
  MotionMapping result;
  for (int i = 0; i < 9; ++i) result.rotation(i / 3, i % 3) = mapping.rotation[i];
  result.offset = {mapping.offset[0], mapping.offset[1], mapping.offset[2]};
  result.scale = mapping.scale;
  validate(result);
  return result;
}

calligraphy_mapping to_c(const MotionMapping& from) noexcept {
  calligraphy_mapping result = {};
  for (int i = 0; i < 9; ++i) result.rotation[i] = from.rotation(i / 3, i % 3);
  to_array(from.offset, result.offset);
  result.scale = from.scale;
  return result;
}

Capabilities capabilities_of(const calligraphy_capabilities* given) {
  const calligraphy_capabilities from = read_struct(given, "calligraphy_capabilities");
  Capabilities result;
  result.name.assign(from.name, strnlen(from.name, sizeof from.name));
  result.model = result.name;
  result.simulated = from.simulated != 0;
  // Zero, which means unknown in C++, is what a program has forgotten to set.
  require(from.peak_force > 0.0, "peak_force", from.peak_force, "N", "above 0, or infinite");
  result.workspace = {from.workspace[0], from.workspace[1], from.workspace[2]};
  result.peak_force = from.peak_force;
  result.continuous_force = from.continuous_force;
  result.usable_stiffness = from.usable_stiffness;
  result.force_step = from.force_step;
  result.encoder_step = from.encoder_step;
  result.velocity = from.velocity_measured ? VelocitySource::measured : VelocitySource::estimated;
  result.velocity_cutoff = from.velocity_cutoff;
  result.update_rate = from.update_rate;
  result.apparent_mass = from.apparent_mass;
  result.viscous_friction = from.viscous_friction;
  result.coulomb_friction = from.coulomb_friction;
  result.sample_delay = from.sample_delay;
  validate(result);
  return result;
}

calligraphy_capabilities to_c(const Capabilities& from) noexcept {
  calligraphy_capabilities result = {};
  std::strncpy(result.name, device_label(from).c_str(), sizeof result.name - 1);
  result.simulated = from.simulated;
  to_array(from.workspace, result.workspace);
  result.peak_force = from.peak_force > 0.0 ? from.peak_force : std::numeric_limits<double>::infinity();
  result.continuous_force = from.continuous_force;
  result.usable_stiffness = from.usable_stiffness;
  result.force_step = from.force_step;
  result.encoder_step = from.encoder_step;
  result.velocity_measured = from.velocity == VelocitySource::measured;
  result.velocity_cutoff = from.velocity_cutoff;
  result.update_rate = from.update_rate;
  result.apparent_mass = from.apparent_mass;
  result.viscous_friction = from.viscous_friction;
  result.coulomb_friction = from.coulomb_friction;
  result.sample_delay = from.sample_delay;
  return result;
}

RendererOptions options_of(const calligraphy_renderer_options* given) {
  const calligraphy_renderer_options from = read_struct(given, "calligraphy_renderer_options");
  RendererOptions result;
  each_option(from, result, FromC());
  return result;
}

calligraphy_renderer_options to_c(const RendererOptions& from) noexcept {
  calligraphy_renderer_options result = {};
  each_option(result, from, ToC());
  return result;
}

DeviceState state_of(const calligraphy_device_state* given) noexcept {
  calligraphy_device_state whole;
  if (given->size < sizeof whole) given = copy_struct(given, &whole);
  const calligraphy_device_state& from = *given;
  DeviceState result;
  result.time = from.time;
  result.position = {from.position[0], from.position[1], from.position[2]};
  result.velocity = known(from.has_velocity, from.velocity);
  result.force = known(from.has_force, from.force);
  result.force_settling = from.force_settling;
  result.buttons = from.buttons;
  const bool is_status = from.status >= 0 && from.status <= CALLIGRAPHY_DEVICE_FAULT;
  result.status = is_status ? static_cast<DeviceStatus>(from.status) : DeviceStatus::fault;
  if (from.stylus_known != 0) result.stylus = sensed(from.stylus_known, from, state_members);
  return result;
}

calligraphy_device_state to_c(const DeviceState& from) noexcept {
  calligraphy_device_state result = {};
  result.status = static_cast<std::int32_t>(from.status);
  result.buttons = from.buttons;
  result.has_velocity = !from.velocity.array().isNaN().any();
  result.has_force = !from.force.array().isNaN().any();
  result.time = from.time;
  to_array(from.position, result.position);
  if (result.has_velocity) to_array(from.velocity, result.velocity);
  if (result.has_force) to_array(from.force, result.force);
  result.force_settling = from.force_settling;
  for (std::size_t i = 0; i < stylus_fields.size(); ++i) {
    const double value = from.stylus.*stylus_fields[i].member;
    result.*state_members[i] = value;
    if (!std::isnan(value)) result.stylus_known |= 1u << i;
  }
  return result;
}

calligraphy_status read_stylus(const calligraphy_stylus* from, StylusState& to) noexcept {
  to = {};
  if (!from) return CALLIGRAPHY_OK;
  if (const calligraphy_status status = check_given(from, "calligraphy_stylus")) return status;
  constexpr std::uint32_t all = (1u << stylus_fields.size()) - 1;
  if (from->known > all) {
    return refuse(CALLIGRAPHY_INVALID_VALUE, "calligraphy_stylus: known = %u, must be a sum of bits, at most %u",
                  static_cast<unsigned>(from->known), static_cast<unsigned>(all));
  }
  to = sensed(from->known, *from, stylus_members);
  return CALLIGRAPHY_OK;
}

}  // namespace calligraphy::c
