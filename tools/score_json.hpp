// What summary.json and replay.json tell in the same way: remarks on pen-downs and the motion of a pen.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>
#include <calligraphy/judge/remark_text.hpp>
#include <calligraphy/judge/writing_motion.hpp>

namespace calligraphy::tools {

/// Pen-downs and strokes from 1; null for none.
inline nlohmann::ordered_json remark_json(const StrokeRemark& remark, const Character& character) {
  using Json = nlohmann::ordered_json;
  const auto number = [](int index) { return index >= 0 ? Json(index + 1) : Json(); };
  Json json = {{"kind", calligraphy::to_string(remark.kind)},
               {"pen_down", number(remark.path)},
               {"pen_down_count", remark.path_count},
               {"stroke", number(remark.stroke)},
               {"stroke_count", remark.stroke_count},
               {"other_pen_down", number(remark.other_path)},
               {"other_stroke", number(remark.other_stroke)},
               {"other_character", remark.other_character ? Json(encode_utf8(remark.other_character)) : Json()},
               {"place_em", {remark.place.x(), remark.place.y()}},
               {"evidence", remark.evidence}};  // null: always told
  if (is_of_form(remark.kind)) {
    json["end"] = remark.end == StrokeEnd::none ? Json() : Json(calligraphy::to_string(remark.end));
    json["amount_em"] = remark.amount;  // null: not measured
    json["offset_em"] = {remark.offset.x(), remark.offset.y()};
    json["orientation"] = calligraphy::to_string(remark.orientation);
  }
  json["reason"] = remark_text(remark, character);
  for (const Language& language : languages()) {
    if (language == Language()) continue;
    json["reason_" + std::string(language.code())] = remark_text(remark, character, language);
  }
  return json;
}

/// With the unit of length in the names; null for what was not measured.
inline nlohmann::ordered_json motion_json(const WritingMotion& motion, const std::string& unit) {
  return {{"duration_s", motion.duration},
          {"time_on_paper_s", motion.time_on_paper},
          {"time_in_air_s", motion.time_in_air},
          {"pen_ups", motion.pen_ups},
          {"path_length_" + unit, motion.path_length},
          {"mean_speed_" + unit + "_per_s", motion.mean_speed},
          {"peak_speed_" + unit + "_per_s", motion.peak_speed},
          {"velocity_peaks", motion.velocity_peaks},
          {"smoothness_sparc", motion.smoothness}};
}

/// For tables: "-" for what was not measured.
inline std::string fixed(double value, int decimals) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, decimals);
}

}  // namespace calligraphy::tools
