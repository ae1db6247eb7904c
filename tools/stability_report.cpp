#include "stability_report.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr double per_millimetre = 1e3, per_micrometre = 1e6;

std::string row(const char* name, const StiffnessBound& bound) {
  return fmt::format("{:<12}{:>12.1f}  {}\n{:<26}{}\n", name, bound.value, bound.formula, "", bound.validity);
}

std::string description(const SampledLoop& loop) {
  std::string text =
      fmt::format("{:g} Hz, {:g} kg, b = {:g} N s/m, f_c = {:g} N, encoder step D = {:g} um, delay d = {}", loop.rate,
                  loop.device.apparent_mass, loop.device.viscous_friction, loop.device.coulomb_friction,
                  loop.device.encoder_step * per_micrometre, loop.device.sample_delay);
  text += fmt::format("{}, wall damping B = {:g} N s/m", loop.device.sample_delay == 1 ? " tick" : " ticks",
                      loop.wall_damping);
  const GripImpedance& grip = loop.grip;
  if (grip.mass == 0.0 && grip.damping == 0.0 && grip.stiffness == 0.0) return text + ", no grip";
  return text + fmt::format(", grip {:g} kg, {:g} N s/m, {:g} N/m", grip.mass, grip.damping, grip.stiffness);
}

Json json_of(const SampledLoop& loop) {
  return {{"rate_Hz", loop.rate},
          {"mass_kg", loop.device.apparent_mass},
          {"damping_N_s_per_m", loop.device.viscous_friction},
          {"coulomb_friction_N", loop.device.coulomb_friction},
          {"encoder_step_m", loop.device.encoder_step},
          {"delay_ticks", loop.device.sample_delay},
          {"wall_damping_N_s_per_m", loop.wall_damping},
          {"grip",
           {{"mass_kg", loop.grip.mass},
            {"damping_N_s_per_m", loop.grip.damping},
            {"stiffness_N_per_m", loop.grip.stiffness}}}};
}

Json json_of(const StiffnessBound& bound) {
  return {{"stiffness_N_per_m", bound.value}, {"formula", bound.formula}, {"validity", bound.validity}};
}

Json json_of(const StabilityLine& line) {
  return {{"loop", json_of(line.loop)},
          {"critical_stiffness_N_per_m", line.stable},
          {"passive_stiffness_N_per_m", line.passive},
          {"quantised_stiffness_N_per_m", line.quantised},
          {"approximate_stiffness_N_per_m", line.approximate},
          {"max_stable_N_per_m", line.max_stable},
          {"controlled_max_stable_N_per_m", line.controlled_max_stable},
          {"controlled_max_stable_below_peak_force_N_per_m", line.controlled_max_stable_below_peak},
          {"stable_at", line.stable_at},
          {"controlled_stable_at", line.controlled_stable_at}};
}

Json json_of(const StabilitySweep& sweep) {
  Json lines = Json::array();
  for (std::size_t i = 0; i < sweep.lines.size(); ++i) {
    Json line = {{"value", sweep.values[i]}};
    line.update(json_of(sweep.lines[i]));
    lines.push_back(std::move(line));
  }
  return {{"name", sweep.name}, {"label", sweep.label}, {"lines", std::move(lines)}};
}

std::string sweep_table(const StabilitySweep& sweep) {
  std::string text = fmt::format("{}\n{:>10}{:>10}{:>10}{:>10}{:>14}{:>10}{:>14}{:>10}\n", sweep.label, "", "passive",
                                 "quantised", "stable", "Gil et al.", "simulated", "controlled", "< peak");
  for (std::size_t i = 0; i < sweep.lines.size(); ++i) {
    const StabilityLine& line = sweep.lines[i];
    text += fmt::format("{:>10}{:>10.0f}{:>10.0f}{:>10.0f}{:>14.0f}{:>10.0f}{:>14.0f}{:>10.0f}\n", sweep.values[i],
                        line.passive, line.quantised, line.stable, line.approximate, line.max_stable,
                        line.controlled_max_stable, line.controlled_max_stable_below_peak);
  }
  return text + "\n";
}

/// Simulation relative to theory over the grid.
std::string summary(const StabilityMap& map) {
  if (map.grid.empty()) return "";
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double least = infinity, most = 0.0, min_passive = infinity;
  int helped = 0, harmed = 0;
  for (const StabilityLine& line : map.grid) {
    helped += line.controlled_max_stable > line.max_stable ? 1 : 0;
    harmed += line.controlled_max_stable < line.max_stable ? 1 : 0;
    if (line.quantised > map.stiffnesses[1]) {  // otherwise it lies below the range tried
      min_passive = std::min(min_passive, line.max_stable / line.quantised);
    }
    if (line.loop.device.coulomb_friction > 0.0 || line.stable <= map.stiffnesses[1]) continue;
    least = std::min(least, line.max_stable / line.stable);
    most = std::max(most, line.max_stable / line.stable);
  }
  return fmt::format("Grid: {} loops, each with control off and on\n", map.grid.size()) +
         fmt::format(
             "  maximum stable stiffness relative to the stable bound, without Coulomb friction: {:.3f} to {:.3f}\n",
             least, most) +
         fmt::format("  relative to the quantised bound, with and without Coulomb friction: at least {:.3f}\n",
                     min_passive) +
         fmt::format("  control allows more stiffness in {} loops, less in {}\n", helped, harmed);
}

}  // namespace

std::string table(const SampledLoop& loop, const StiffnessAdvice& advice) {
  return description(loop) + fmt::format("\n\n{:<12}{:>12}\n", "bound", "K [N/m]") + row("passive", advice.passive) +
         row("quantised", advice.quantised) + row("stable", advice.stable) + row("approximate", advice.approximate);
}

std::string json(const SampledLoop& loop, const StiffnessAdvice& advice) {
  const Json object = {{"critical_stiffness_N_per_m", advice.stable.value},
                       {"passive_stiffness_N_per_m", advice.passive.value},
                       {"quantised_stiffness_N_per_m", advice.quantised.value},
                       {"loop", json_of(loop)},
                       {"bounds",
                        {{"stable", json_of(advice.stable)},
                         {"passive", json_of(advice.passive)},
                         {"quantised", json_of(advice.quantised)},
                         {"approximate", json_of(advice.approximate)}}}};
  return object.dump(2) + "\n";
}

std::string tables(const StabilityMap& map) {
  const WallContact& contact = map.contact;
  std::string text = fmt::format(
      "Maximum stable stiffness [N/m] of a virtual wall. A pen is released {:g} mm above it and pushed down by {:g} N, "
      "for {:g} s; peak force {:g} N\nsimulated: up to here the pen comes to rest; controlled: with the passivity "
      "controller; < peak: and without reaching the peak force\n\n",
      contact.height * per_millimetre, contact.push, contact.seconds, map.device.peak_force);
  for (const StabilitySweep& sweep : map.sweeps) text += sweep_table(sweep);
  return text + summary(map);
}

nlohmann::ordered_json json(const StabilityMap& map) {
  Json sweeps = Json::array(), grid = Json::array();
  for (const StabilitySweep& sweep : map.sweeps) sweeps.push_back(json_of(sweep));
  for (const StabilityLine& line : map.grid) grid.push_back(json_of(line));
  const Json object = {{"contact",
                        {{"push_N", map.contact.push},
                         {"height_m", map.contact.height},
                         {"seconds", map.contact.seconds},
                         {"peak_force_N", map.device.peak_force}}},
                       {"stiffnesses_N_per_m", map.stiffnesses},
                       {"sweeps", std::move(sweeps)},
                       {"grid", std::move(grid)}};
  return object;
}

}  // namespace calligraphy::tools
