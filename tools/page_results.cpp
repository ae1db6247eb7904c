#include "page_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/typical_stroke.hpp>
#include <calligraphy/pictures/chinese_font.hpp>
#include <calligraphy/pictures/error_plot.hpp>
#include <calligraphy/pictures/picture.hpp>
#include <calligraphy/pictures/plot.hpp>
#include <calligraphy/practice/recording_file.hpp>
#include <calligraphy/practice/score.hpp>

#include "no_font.hpp"
#include "options.hpp"

namespace calligraphy::tools {
namespace {

constexpr double millimetres = 1e3;
constexpr char32_t first_of_cjk = 0x2e80;  ///< what comes before, most fonts have

/// A cell of a table, empty for what was not measured.
std::string cell(double value, int decimals) { return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : ""; }

/// "永", or the number and the names of a typical stroke that is written alone: "6 捺 nà".
std::string name_in_title(const Character& character) {
  const bool is_stroke = typical_stroke_characters().find(character.code) != nullptr;
  if (!is_stroke || character.stroke_count() != 1) return encode_utf8(character.code);
  const TypicalStroke& stroke = typical_stroke(character.sequence.stroke_ids[0]);
  return fmt::format("{} {} {}", stroke.id, stroke.name, stroke.pinyin);
}

/// The names after each other, those of strokes apart: "永北, 6 捺 nà".
std::string names_in_title(const PracticePage& page) {
  std::string names;
  bool stands_apart = false;
  for (const PlacedCharacter& placed : page.characters) {
    const std::string name = name_in_title(placed.character);
    const bool is_stroke = name != encode_utf8(placed.character.code);
    if (!names.empty() && (is_stroke || stands_apart)) names += ", ";
    names += name;
    stands_apart = is_stroke;
  }
  return names;
}

}  // namespace

void warn_of_missing_font(const std::vector<Character>& characters, const Language& language) {
  std::string words = language.text("picture.written");
  for (const Character& character : characters) words += name_in_title(character);
  std::string chinese;
  for (const char32_t code : decode_utf8(words)) {
    if (code >= first_of_cjk) chinese += encode_utf8(code);
  }
  if (chinese.empty() || !fonts_can_be_found() || !chinese_font(chinese).empty()) return;
  spdlog::warn("{}", no_font_has("all the Chinese in the pictures, where boxes may stand instead"));
}

std::vector<Result> results_of(const Recording& recording, const PageInRun& where, const JudgeTolerances& tolerances) {
  const RecordingSetup& setup = *recording.setup;
  const double begin = recording.samples.empty() ? 0.0 : recording.samples.front().time;
  std::vector<Result> results;
  for (CharacterScore& score : score_page(setup.page, recording, tolerances)) {
    Result result;
    const auto index = static_cast<int>(results.size());
    score.mean_pressure *= setup.mapping.scale;
    score.peak_force *= setup.mapping.scale;
    score.max_force_step *= setup.mapping.scale;
    for (PenDownScore& pen_down : score.pen_downs) {
      pen_down.mean_pressure *= setup.mapping.scale;
      pen_down.motion.begin -= begin;
    }
    std::vector<float> ticks;
    for (const RecordedSample& sample : recording.samples) {
      if (sample.character == index) ticks.push_back(sample.tick_ns);
    }
    const bool is_measured = std::any_of(ticks.begin(), ticks.end(), [](float tick) { return tick > 0.0F; });
    result.tick_p50 = is_measured ? percentile(ticks, 0.5) : std::numeric_limits<double>::quiet_NaN();
    result.tick_p999 = is_measured ? percentile(ticks, 0.999) : result.tick_p50;
    result.score = std::move(score);
    result.position = where.first_position + index;
    result.mode = setup.mode;
    result.repetition = where.repetition;
    result.seed = where.seed;
    results.push_back(std::move(result));
  }
  return results;
}

void try_to_write(const std::string& name, const std::function<std::string()>& make, OutputDirectory& out,
                  std::vector<std::string>& warnings) {
  try {
    out.write(name, make());
  } catch (const Error& error) {
    warnings.push_back(fmt::format("{} is missing: {}", name, error.what()));
    spdlog::warn("{}", warnings.back());
  }
}

void draw_page(const Recording& recording, const PageInRun& where, const PictureOptions& options, OutputDirectory& out,
               std::vector<std::string>& warnings) {
  const RecordingSetup& setup = *recording.setup;
  const std::vector<CharacterScore> scores = score_page(setup.page, recording, options.tolerances);
  const char* const mode = setup.mode == FeedbackMode::vision ? "mode.vision_only" : "mode.vision_and_force";
  const auto title = [&](const std::string& text) {
    return fmt::format("{}, {}, {}", text, options.language.text(mode), setup.device.model);
  };
  const auto draw = [&](const std::string& name, const auto& picture) {
    if (!options.is_stopped()) try_to_write(name, picture, out, warnings);
  };
  for (std::size_t i = 0; i < setup.page.characters.size(); ++i) {
    const char32_t code = setup.page.characters[i].character.code;
    const auto index = static_cast<int>(i);
    const std::string stem =
        fmt::format("{:02}-{}-{}", where.first_position + index, name_in_file(code), to_string(setup.mode));
    const std::string heading = title(name_in_title(setup.page.characters[i].character));
    draw(stem + "-writing.svg", [&] {
      return character_picture(setup.page, recording, scores, index, heading, options.style, options.language);
    });
    const bool was_reached = std::any_of(recording.samples.begin(), recording.samples.end(),
                                         [index](const RecordedSample& sample) { return sample.character == index; });
    const bool has_force = was_reached && setup.mode == FeedbackMode::force;  // otherwise the page was aborted before
    if (!options.has_plots || !has_force) continue;
    draw(stem + "-plot.svg", [&] { return force_plot(recording, index, heading, options.language); });
  }
  if (setup.page.characters.size() < 2) return;
  draw(fmt::format("page-{}-{}-writing.svg", where.page, to_string(setup.mode)), [&] {
    const std::string heading = title(names_in_title(setup.page));
    return page_picture(setup.page, recording, scores, heading, options.style, options.language);
  });
}

void draw_errors(const std::vector<Result>& results, const std::string& device, const PictureOptions& options,
                 OutputDirectory& out, std::vector<std::string>& warnings) {
  if (!options.has_plots || options.is_stopped()) return;
  const ErrorsByCharacter errors = errors_by_character(results);
  if (errors.all.reduction.draws < least_runs) return;
  const std::string title = options.language.text("write.error", {{"device", device}});
  try_to_write("error-by-character.svg", [&] { return error_plot(errors, title, options.language); }, out, warnings);
}

bool can_plot(std::vector<std::string>& warnings) {
  const bool can = gnuplot_available();
  if (can) return true;
  warnings.push_back("gnuplot is not available: forces are not plotted");
  spdlog::warn("{}", warnings.back());
  return false;
}

std::string strokes_table(const std::vector<Result>& results) {
  std::string text =
      "position,character,mode,repetition,seed,stroke,completed,begin_s,end_s,coverage,rms_error_mm,max_error_mm,"
      "overall_error_mm,dtw_distance_mm,path_length_mm,mean_speed_mm_per_s,peak_speed_mm_per_s,velocity_peaks,smoothness,"
      "mean_pressure_N\n";
  for (const Result& result : results) {
    const CharacterScore& score = result.score;
    for (std::size_t i = 0; i < score.strokes.size(); ++i) {
      const StrokeScore& stroke = score.strokes[i];
      text += fmt::format("{},{},{},{},{},{},{}", result.position, encode_utf8(score.character), to_string(result.mode),
                          result.repetition, result.seed ? std::to_string(*result.seed) : "", i + 1, stroke.completed ? 1 : 0);
      const PenDownScore none;
      const bool is_written = stroke.pen_down >= 0;
      const PenDownScore& pen = is_written ? score.pen_downs[static_cast<std::size_t>(stroke.pen_down)] : none;
      text += "," + (is_written ? cell(pen.motion.begin, 3) : "") + "," + (is_written ? cell(pen.motion.begin + pen.motion.duration, 3) : "");
      text += "," + cell(stroke.coverage, 4);
      for (const double error : {stroke.rms_error, stroke.max_error, stroke.overall_error, stroke.dtw_distance}) {
        text += "," + cell(error * millimetres, 4);
      }
      text += "," + (is_written ? cell(pen.motion.path_length * millimetres, 3) : "");
      text += "," + (is_written ? cell(pen.motion.mean_speed * millimetres, 2) : "");
      text += "," + (is_written ? cell(pen.motion.peak_speed * millimetres, 2) : "");
      text += "," + (is_written ? std::to_string(pen.motion.velocity_peaks) : "");
      text += "," + (is_written ? cell(pen.motion.smoothness, 3) : "");
      text += "," + (is_written ? cell(pen.mean_pressure, 4) : "") + "\n";
    }
  }
  return text;
}

std::string ticks_table(const Recording& recording) {
  std::ostringstream out;
  write_ticks(out, recording);
  return out.str();
}

}  // namespace calligraphy::tools
