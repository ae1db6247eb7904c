#include <cmath>
#include <ostream>
#include <string>

#include <calligraphy/practice/recording_file.hpp>

#include "base/charconv.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t max_text = 1 << 16;  ///< bytes given to the stream at a time

constexpr std::string_view columns =
    "time_s,device_x_m,device_y_m,device_z_m,tip_x_m,tip_y_m,tip_z_m,force_x_N,force_y_N,force_z_N,state,events,status,"
    "character,stroke,tick_ns";
constexpr std::string_view pen_columns =
    ",buttons,pressure,tip_force_N,altitude_rad,azimuth_rad,twist_rad,height_m";

/// Appends a comma and the number, rounded; nothing for one that is not finite.
void append_cell(std::string& text, double value, int places) {
  text += ',';
  if (std::isfinite(value)) append_rounded(text, value, places);
}

}  // namespace

void write_ticks(std::ostream& out, const Recording& recording) {
  const bool has_inputs = recording.inputs.size() == recording.samples.size();
  std::string text(columns);
  text.append(has_inputs ? pen_columns : "").append("\n");
  for (std::size_t i = 0; i < recording.samples.size(); ++i) {
    const RecordedSample& sample = recording.samples[i];
    const std::size_t begin = text.size();
    append_cell(text, sample.time - recording.samples.front().time, 6);
    text.erase(begin, 1);
    for (const double coordinate : sample.device_point) append_cell(text, coordinate, 7);
    for (const double coordinate : sample.pen_tip) append_cell(text, coordinate, 7);
    for (const double component : sample.force) append_cell(text, component, 4);
    text.append(",").append(to_string(sample.state));
    append_cell(text, static_cast<int>(sample.events), 0);
    text.append(",").append(to_string(sample.status));
    append_cell(text, sample.character, 0);
    append_cell(text, sample.stroke, 0);
    append_cell(text, sample.tick_ns, 0);
    if (has_inputs) {
      const StylusState& stylus = recording.inputs[i].stylus;
      append_cell(text, recording.inputs[i].buttons, 0);
      append_cell(text, stylus.pressure, 5);
      for (const double each : {stylus.force, stylus.altitude, stylus.azimuth, stylus.twist}) append_cell(text, each, 4);
      append_cell(text, stylus.height, 5);
    }
    text += '\n';
    if (text.size() < max_text) continue;
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  }
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

}  // namespace calligraphy
