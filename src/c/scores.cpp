#include "conversions.hpp"
#include "objects.hpp"
#include "structs.hpp"

namespace calligraphy::c {
namespace {

const CharacterScore& score_of(const calligraphy_score* score, std::int32_t character) {
  return item("character", object<ScoreObject>(score).characters, character);
}

calligraphy_character_score in_c(const CharacterScore& from) {
  return {.size = 0,
          .code = from.character,
          .stroke_count = from.stroke_count,
          .strokes_written = from.strokes_written,
          .strokes_completed = from.strokes_completed,
          .pen_down_count = static_cast<std::int32_t>(from.pen_downs.size()),
          .order_mistakes = from.order_mistakes(),
          .direction_mistakes = from.direction_mistakes(),
          .lost_samples = from.lost_samples,
          .pen_ups = from.motion.pen_ups,
          .velocity_peaks = from.motion.velocity_peaks,
          .time = from.time,
          .rms_error = from.rms_error,
          .max_error = from.max_error,
          .overall_error = from.overall_error,
          .coverage = from.coverage,
          .dtw_distance = from.dtw_distance,
          .contour = from.contour,
          .external_sequence = from.external_sequence,
          .internal_sequence = from.internal_sequence,
          .fidelity = from.fidelity,
          .mean_pressure = from.mean_pressure,
          .peak_force = from.peak_force,
          .max_force_step = from.max_force_step,
          .duration = from.motion.duration,
          .time_on_paper = from.motion.time_on_paper,
          .time_in_air = from.motion.time_in_air,
          .path_length = from.motion.path_length,
          .mean_speed = from.motion.mean_speed,
          .peak_speed = from.motion.peak_speed,
          .smoothness = from.motion.smoothness};
}

calligraphy_stroke_score in_c(const StrokeScore& from) {
  return {.size = 0,
          .pen_down = from.pen_down,
          .completed = from.completed,
          .coverage = from.coverage,
          .rms_error = from.rms_error,
          .max_error = from.max_error,
          .overall_error = from.overall_error,
          .dtw_distance = from.dtw_distance};
}

calligraphy_pen_down_score in_c(const PenDownScore& from) {
  return {.size = 0,
          .velocity_peaks = from.motion.velocity_peaks,
          .begin = from.motion.begin,
          .end = from.motion.begin + from.motion.duration,
          .path_length = from.motion.path_length,
          .mean_speed = from.motion.mean_speed,
          .peak_speed = from.motion.peak_speed,
          .smoothness = from.motion.smoothness,
          .mean_pressure = from.mean_pressure};
}

}  // namespace
}  // namespace calligraphy::c

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_score_recording(const calligraphy_recording* recording, int32_t tolerance,
                                               calligraphy_score** score) {
  return guarded([&] {
    const auto& [page, written] = object<RecordingObject>(recording);
    const auto tolerances = tolerances_of<JudgeTolerances>(tolerance);
    target(score, "score");
    auto made = std::make_shared<ScoreObject>();
    made->characters = score_page(*page, written, tolerances);
    hand_out(score, std::move(made));
  });
}

calligraphy_status calligraphy_score_character(const calligraphy_score* score, int32_t character,
                                               calligraphy_character_score* result) {
  return guarded([&] { write_struct(result, "calligraphy_character_score", in_c(score_of(score, character))); });
}

calligraphy_status calligraphy_score_stroke(const calligraphy_score* score, int32_t character, int32_t stroke,
                                            calligraphy_stroke_score* result) {
  return guarded([&] {
    const StrokeScore& found = item("stroke", score_of(score, character).strokes, stroke);
    write_struct(result, "calligraphy_stroke_score", in_c(found));
  });
}

calligraphy_status calligraphy_score_pen_down(const calligraphy_score* score, int32_t character, int32_t path,
                                              calligraphy_pen_down_score* result) {
  return guarded([&] {
    const PenDownScore& found = item("path", score_of(score, character).pen_downs, path);
    write_struct(result, "calligraphy_pen_down_score", in_c(found));
  });
}

calligraphy_status calligraphy_score_match(const calligraphy_score* score, int32_t character,
                                           calligraphy_match** match) {
  return guarded([&] {
    const MatchResult& found = score_of(score, character).match;
    target(match, "match");
    hand_out(match, std::make_shared<MatchObject>(found));
  });
}
