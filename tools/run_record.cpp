#include "run_record.hpp"

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <calligraphy/render/option_values.hpp>

#include "source_commit.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string>& command_words() {
  static std::vector<std::string> words;
  return words;
}

/// Now, in local time: "2026-11-28T10:15:00+01:00".
std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm local = {};
  localtime_r(&now, &local);
  const long minutes = local.tm_gmtoff / 60, ahead = std::abs(minutes);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}{}{:02}:{:02}", local.tm_year + 1900, local.tm_mon + 1,
                     local.tm_mday, local.tm_hour, local.tm_min, local.tm_sec, minutes < 0 ? '-' : '+', ahead / 60,
                     ahead % 60);
}

/// A word as a shell takes it.
std::string quoted(const std::string& word) {
  const auto is_plain = [](char c) {
    return static_cast<unsigned char>(c) >= 0x80 || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ||
           (c >= 'a' && c <= 'z') || std::string_view("-_./:=,+@").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

Json json_of(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

}  // namespace

void remember_command(std::span<const char* const> words) { command_words().assign(words.begin(), words.end()); }

Json run_facts() {
  return {{"version", CALLIGRAPHY_VERSION},
          {"commit", source_commit()},
          {"command", command_words()},
          {"date", date()}};
}

Json device_json(const Capabilities& device) {
  return {{"name", device.name},
          {"model", device.model},
          {"simulated", device.simulated},
          {"sensed_axes", axes_text(device.sensed)},
          {"driven_axes", axes_text(device.driven)},
          {"workspace_m", json_of(device.workspace)},
          {"peak_force_N", device.peak_force},
          {"continuous_force_N", device.continuous_force},
          {"usable_stiffness_N_per_m", device.usable_stiffness},
          {"force_step_N", device.force_step},
          {"encoder_step_m", device.encoder_step},
          {"velocity", calligraphy::to_string(device.velocity)},
          {"velocity_cutoff_Hz", device.velocity_cutoff},
          {"update_rate_Hz", device.update_rate},
          {"apparent_mass_kg", device.apparent_mass},
          {"viscous_friction_N_s_per_m", device.viscous_friction},
          {"coulomb_friction_N", device.coulomb_friction},
          {"sample_delay_ticks", device.sample_delay}};
}

Json options_json(const RendererOptions& options) {
  Json json = Json::object();
  for (const auto& [name, value] : option_values(options)) json[name] = value;
  return json;
}

Json mapping_json(const MotionMapping& mapping) {
  Json rotation = Json::array();
  for (int row = 0; row < 3; ++row) rotation.push_back(json_of(mapping.rotation.row(row).transpose()));
  return {{"rotation", rotation}, {"offset_m", json_of(mapping.offset)}, {"scale", mapping.scale}};
}

Json page_json(const PageChoice& choice, const PageLayout& layout) {
  return {{"pose", choice.plane}, {"width_m", layout.width}, {"height_m", layout.height},
          {"em_m", layout.em},    {"gap_m", layout.gap},     {"motion_scale", choice.scale}};
}

Json writer_json(std::string_view name, const WriterSkill& skill) {
  return {{"name", name},
          {"grip_mass_kg", skill.grip.mass},
          {"grip_damping_N_s_per_m", skill.grip.damping},
          {"grip_stiffness_N_per_m", skill.grip.stiffness},
          {"offset_em", skill.offset},
          {"bias_em", skill.bias},
          {"scale", skill.scale},
          {"tilt_rad", skill.tilt},
          {"shape_em", skill.shape},
          {"drift_em_per_sqrt_s", skill.drift},
          {"tremor_m", skill.tremor},
          {"aim_em", skill.aim},
          {"wrong_order", skill.wrong_order},
          {"wrong_direction", skill.wrong_direction},
          {"speed_em_per_s", skill.speed},
          {"pause_s", skill.pause},
          {"visual_delay_s", skill.visual_delay},
          {"correction_per_s", skill.correction},
          {"caution_em", skill.caution}};
}

std::string json_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string run_of(const Json& record) {
  if (!record.is_object()) return "a run";
  std::string text = "a run";
  if (record.contains("finished") && record["finished"] == false) text = "an unfinished run";
  if (record.contains("date") && record["date"].is_string()) text += " of " + record["date"].get<std::string>();
  if (record.contains("command") && record["command"].is_array()) {
    text += ": calligraphy";
    for (const Json& word : record["command"]) {
      if (word.is_string()) text += " " + quoted(word.get<std::string>());
    }
  }
  return text;
}

}  // namespace calligraphy::tools
