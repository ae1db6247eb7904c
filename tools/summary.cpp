#include "summary.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>
#include <calligraphy/practice/mean_interval.hpp>

#include "score_json.hpp"
#include "table_head.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;
using Quantity = std::function<double(const Result&)>;

constexpr double millimetres = 1e3;

/// Of the results in which the quantity was measured; NaN if it was in none.
double mean(const std::vector<Result>& results, std::size_t begin, std::size_t end, const Quantity& quantity) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const double value = quantity(results[i]);
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
  }
  return sum / count;
}

/// More are not printed.
constexpr std::size_t most_remarks = 20;

/// A character written without and with force, with the beliefs of one seed.
struct Pair {
  const Result* vision;
  const Result* force;
};

bool is_complete(const Result& result) {
  return result.score.strokes_completed >= result.score.stroke_count && result.score.strokes_written > 0;
}

/// One pair per character and repetition that has both modes.
std::vector<Pair> pairs(const std::vector<Result>& results) {
  std::map<std::pair<int, int>, const Result*> vision;
  for (const Result& result : results) {
    if (result.mode == FeedbackMode::vision) vision[{result.position, result.repetition}] = &result;
  }
  std::vector<Pair> both;
  for (const Result& result : results) {
    const auto found = vision.find({result.position, result.repetition});
    if (result.mode == FeedbackMode::force && found != vision.end()) both.push_back({found->second, &result});
  }
  return both;
}

/// An aborted character has no meaningful error or time.
bool is_complete(const Pair& pair) { return is_complete(*pair.vision) && is_complete(*pair.force); }

/// What was drawn independently: the beliefs of a simulated writer, or a person's repetition.
std::uint64_t run_of(const Pair& pair) {
  return pair.vision->seed.value_or(static_cast<std::uint64_t>(pair.vision->repetition));
}

MeanInterval interval_of(const std::vector<Pair>& both, const std::function<double(const Pair&)>& quantity) {
  std::vector<DrawnValue> values;
  for (const Pair& pair : both) values.push_back({quantity(pair), run_of(pair)});
  return mean_interval(values);
}

double rms_error(const Result& result) { return result.score.rms_error; }

PairedErrors paired_errors(char32_t character, const std::vector<Pair>& both) {
  return {character, interval_of(both, [](const Pair& pair) { return rms_error(*pair.vision); }),
          interval_of(both, [](const Pair& pair) { return rms_error(*pair.force); }),
          interval_of(both, [](const Pair& pair) { return rms_error(*pair.vision) - rms_error(*pair.force); })};
}

std::string name_of(FeedbackMode mode, const Language& language) {
  return language.text(std::string("mode.") + to_string(mode));
}

std::string reduction(const std::string& what, const char* unit, const std::vector<Pair>& both,
                      const Quantity& quantity, const Language& language) {
  const double vision = interval_of(both, [&](const Pair& pair) { return quantity(*pair.vision); }).mean;
  const MeanInterval interval =
      interval_of(both, [&](const Pair& pair) { return quantity(*pair.vision) - quantity(*pair.force); });
  const std::string relative = vision > 0.0 ? fmt::format(" ({:.1f} %)", 100.0 * interval.mean / vision) : "";
  return fmt::format("{:<10} {}\n", what,
                     language.text("write.reduced", {{"value", fixed(interval.mean, 3)},
                                                     {"unit", unit},
                                                     {"relative", relative},
                                                     {"low", fixed(interval.mean - interval.half_width, 3)},
                                                     {"high", fixed(interval.mean + interval.half_width, 3)}}));
}

Json errors_json(const PairedErrors& errors) {
  const auto interval = [](const MeanInterval& value) {  // null: not known
    return Json{{"mean_mm", value.mean * millimetres}, {"half_width_mm", value.half_width * millimetres}};
  };
  return {{"character", errors.character == 0 ? Json() : Json(encode_utf8(errors.character))},
          {"pairs", errors.reduction.values},
          {"runs", errors.reduction.draws},
          {"vision", interval(errors.vision)},
          {"force", interval(errors.force)},
          {"reduction", interval(errors.reduction)}};
}

/// The results from `begin` on that differ only in their repetition end here.
std::size_t end_of_repetitions(const std::vector<Result>& results, std::size_t begin) {
  const Result& first = results[begin];
  std::size_t end = begin;
  while (end < results.size() && results[end].position == first.position && results[end].mode == first.mode) ++end;
  return end;
}

/// "interrupted: means over 3 to 100 of 100 repetitions"; empty where there is nothing to average.
std::string repetitions(const Summary& summary, const Language& language) {
  if (summary.repetitions == 1) return "";
  const std::string asked = std::to_string(summary.repetitions);
  if (!summary.interrupted) return language.text("write.repetitions", {{"repetitions", asked}}) + "\n";
  std::size_t least = summary.results.size(), most = 0;
  for (std::size_t begin = 0, end = 0; begin < summary.results.size(); begin = end) {
    end = end_of_repetitions(summary.results, begin);
    least = std::min(least, end - begin);
    most = std::max(most, end - begin);
  }
  const std::string last = std::to_string(most);
  const std::string done =
      least < most ? language.text("write.range", {{"first", std::to_string(least)}, {"last", last}}) : last;
  return language.text("write.interrupted", {{"done", done}, {"repetitions", asked}}) + "\n";
}

constexpr const char* writing_columns = "{:<10}{:<8}{:>8}{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>7}{:>7}{:>7}{:>9}\n";

std::string writing_head(const Language& language) {
  return table_head(writing_columns, language,
                    {"column.character", "column.mode", "column.time", "column.rms_error", "column.max_error",
                     "column.overall_error", "column.coverage", "column.strokes", "column.order_mistakes",
                     "column.backwards", "column.extra", "column.missing", "column.completed"});
}

std::string writing_line(const std::vector<Result>& results, std::size_t begin, std::size_t end,
                         const Language& language) {
  const int decimals = end - begin > 1 ? 2 : 0;
  const auto error = [&](double CharacterScore::*which) {
    return fixed(mean(results, begin, end, [which](const Result& r) { return r.score.*which * millimetres; }), 3);
  };
  const auto remarks = [&](StrokeRemarkKind kind) {
    return fixed(mean(results, begin, end, [kind](const Result& r) { return r.score.match.count(kind); }), decimals);
  };
  const auto strokes = [&](int CharacterScore::*which) {
    return fixed(mean(results, begin, end, [which](const Result& r) { return r.score.*which; }), decimals);
  };
  const auto of = [&](const Quantity& quantity, int places) {
    return fixed(mean(results, begin, end, quantity), places);
  };
  const CharacterScore& first = results[begin].score;
  return fmt::format(fmt::runtime(writing_columns), encode_utf8(first.character),
                     name_of(results[begin].mode, language),
                     of([](const Result& r) { return r.score.time; }, 2), error(&CharacterScore::rms_error),
                     error(&CharacterScore::max_error), error(&CharacterScore::overall_error),
                     of([](const Result& r) { return 100.0 * r.score.coverage; }, 0),
                     fmt::format("{}/{}", strokes(&CharacterScore::strokes_written), first.stroke_count),
                     remarks(StrokeRemarkKind::order), remarks(StrokeRemarkKind::direction),
                     remarks(StrokeRemarkKind::extra), remarks(StrokeRemarkKind::missing),
                     strokes(&CharacterScore::strokes_completed));
}

constexpr const char* motion_columns =
    "{:<10}{:<8}{:>8}{:>8}{:>6}{:>8}{:>8}{:>8}{:>7}{:>8}{:>7}{:>9}{:>8}{:>10}{:>7}{:>7}\n";

std::string motion_head(const Language& language) {
  return table_head(motion_columns, language,
                    {"column.character", "column.mode", "column.paper", "column.air", "column.pen_ups.narrow",
                     "column.path", "column.mean_speed", "column.peak_speed", "column.peaks", "column.smoothness",
                     "column.dtw", "column.pressure", "column.peak_force", "column.max_step", "column.p50",
                     "column.p99_9"});
}

std::string motion_line(const std::vector<Result>& results, std::size_t begin, std::size_t end,
                        const Language& language) {
  const auto of = [&](const Quantity& quantity, int decimals) {
    return fixed(mean(results, begin, end, quantity), decimals);
  };
  const auto motion = [&](auto WritingMotion::*which, double unit, int decimals) {
    return of([which, unit](const Result& r) { return r.score.motion.*which * unit; }, decimals);
  };
  const auto score = [&](double CharacterScore::*which, double unit, int decimals) {
    return of([which, unit](const Result& r) { return r.score.*which * unit; }, decimals);
  };
  const int decimals = end - begin > 1 ? 1 : 0;
  return fmt::format(
      fmt::runtime(motion_columns), encode_utf8(results[begin].score.character), name_of(results[begin].mode, language),
      motion(&WritingMotion::time_on_paper, 1.0, 2), motion(&WritingMotion::time_in_air, 1.0, 2),
      motion(&WritingMotion::pen_ups, 1.0, decimals), motion(&WritingMotion::path_length, millimetres, 1),
      motion(&WritingMotion::mean_speed, millimetres, 1), motion(&WritingMotion::peak_speed, millimetres, 1),
      motion(&WritingMotion::velocity_peaks, 1.0, decimals), motion(&WritingMotion::smoothness, 1.0, 2),
      score(&CharacterScore::dtw_distance, millimetres, 3), score(&CharacterScore::mean_pressure, 1.0, 2),
      score(&CharacterScore::peak_force, 1.0, 2), score(&CharacterScore::max_force_step, 1.0, 3),
      of([](const Result& r) { return r.tick_p50; }, 0), of([](const Result& r) { return r.tick_p999; }, 0));
}

/// A line for each mode: over how many of how many strokes its errors are.
std::string means(const std::vector<Result>& results, const Language& language) {
  std::string text;
  for (const FeedbackMode mode : {FeedbackMode::vision, FeedbackMode::force}) {
    std::vector<CharacterScore> scores;
    for (const Result& result : results) {
      if (result.mode == mode) scores.push_back(result.score);
    }
    if (scores.empty()) continue;
    const MeanScore all = mean_score(scores);
    text += fmt::format("{:<7} {}\n", name_of(mode, language),
                        language.text("write.means", {{"error", fixed(all.rms_error * millimetres, 3)},
                                                      {"written", std::to_string(all.strokes_written)},
                                                      {"strokes", std::to_string(all.stroke_count)},
                                                      {"overall", fixed(all.overall_error * millimetres, 3)}}));
  }
  return text;
}

}  // namespace

double percentile(std::vector<float>& values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::string table(const Summary& summary, const Language& language) {
  const std::vector<Result>& results = summary.results;
  std::string text = repetitions(summary, language);
  for (const bool second : {false, true}) {
    if (second) text += "\n";
    text += second ? motion_head(language) : writing_head(language);
    for (std::size_t begin = 0, end = 0; begin < results.size(); begin = end) {
      end = end_of_repetitions(results, begin);
      text += second ? motion_line(results, begin, end, language) : writing_line(results, begin, end, language);
    }
  }
  return text + "\n" + means(results, language);
}

nlohmann::ordered_json json(const Summary& summary) {
  Json list = Json::array();
  for (const Result& result : summary.results) {
    const CharacterScore& score = result.score;
    Json remarks = Json::array();
    for (const StrokeRemark& remark : score.match.remarks) {
      Json each = remark_json(remark, score.match.character);
      const bool has_time = remark.path >= 0;
      each["time_s"] = has_time ? Json(score.pen_downs[static_cast<std::size_t>(remark.path)].motion.begin) : Json();
      remarks.push_back(each);
    }
    list.push_back({{"character", encode_utf8(score.character)},
                    {"position", result.position},
                    {"mode", to_string(result.mode)},
                    {"repetition", result.repetition},
                    {"seed", result.seed ? Json(*result.seed) : Json()},
                    {"writing_time_s", score.time},
                    {"rms_error_mm", score.rms_error * millimetres},  // null: nothing was written
                    {"max_error_mm", score.max_error * millimetres},
                    {"overall_error_mm", score.overall_error * millimetres},
                    {"coverage", score.coverage},
                    {"order_mistakes", score.order_mistakes()},
                    {"direction_mistakes", score.direction_mistakes()},
                    {"extra_pen_downs", score.match.count(StrokeRemarkKind::extra)},
                    {"missing_strokes", score.match.count(StrokeRemarkKind::missing)},
                    {"strokes", score.stroke_count},
                    {"strokes_written", score.strokes_written},
                    {"strokes_completed", score.strokes_completed},
                    {"lost_samples", score.lost_samples},
                    {"motion", motion_json(score.motion, "m")},
                    {"dtw_distance_mm", score.dtw_distance * millimetres},
                    {"mean_pressure_N", score.mean_pressure},
                    {"peak_force_N", score.peak_force},
                    {"max_force_step_N", score.max_force_step},
                    {"tick_ns_p50", result.tick_p50},
                    {"tick_ns_p999", result.tick_p999},
                    {"contour", score.contour},
                    {"external_sequence", score.external_sequence},
                    {"internal_sequence", score.internal_sequence},
                    {"fidelity", score.fidelity},
                    {"remarks", remarks}});
  }
  Json all = {{"repetitions_requested", summary.repetitions},
                    {"interrupted", summary.interrupted},
                    {"warnings", summary.warnings},
                    {"results", list}};
  const ErrorsByCharacter errors = errors_by_character(summary.results);
  if (errors.characters.empty()) return all;
  Json& by_character = all["error_by_character"] = Json::array();
  for (const PairedErrors& each : errors.characters) by_character.push_back(errors_json(each));
  by_character.push_back(errors_json(errors.all));  // last, of which the character is null
  return all;
}

ErrorsByCharacter errors_by_character(const std::vector<Result>& results) {
  ErrorsByCharacter errors;
  std::vector<Pair> complete;
  std::map<char32_t, std::vector<Pair>> of;
  std::vector<char32_t> characters;  // as they stand in the text
  for (const Pair& pair : pairs(results)) {
    const char32_t character = pair.vision->score.character;
    if (!of.contains(character)) characters.push_back(character);
    std::vector<Pair>& own = of[character];
    if (!is_complete(pair)) continue;
    own.push_back(pair);
    complete.push_back(pair);
  }
  for (const char32_t character : characters) errors.characters.push_back(paired_errors(character, of[character]));
  errors.all = paired_errors(0, complete);
  return errors;
}

std::string reductions(const std::vector<Result>& results, const Language& language) {
  std::vector<Pair> both = pairs(results);
  if (both.empty()) return "";
  const std::size_t all = both.size();
  std::erase_if(both, [](const Pair& pair) { return !is_complete(pair); });
  std::set<std::uint64_t> runs;
  for (const Pair& pair : both) runs.insert(run_of(pair));
  const auto of_pairs = [&language](std::size_t count, std::string_view key) {
    return language.text_for(static_cast<long long>(count), key, {{"pairs", std::to_string(count)}}) + "\n";
  };
  std::string text;
  if (both.empty()) {
    text = language.text("write.no_pair") + "\n";
  } else if (runs.size() < least_runs) {
    text = of_pairs(runs.size(), "write.few_pairs");
  } else {
    const auto error = [](const Result& r) { return rms_error(r) * millimetres; };
    const auto time = [](const Result& r) { return r.score.time; };
    text = reduction(language.text("write.rms_error"), "mm", both, error, language) +
           reduction(language.text("write.time"), "s", both, time, language) +
           language.text("write.paired", {{"characters", std::to_string(both.size())},
                                          {"pairs", std::to_string(runs.size())}}) +
           "\n";
  }
  if (const std::size_t omitted = all - both.size(); omitted > 0) text += of_pairs(omitted, "write.omitted");
  return text;
}

std::string remarks(const Summary& summary, const Language& language) {
  std::string text;
  std::size_t count = 0;
  for (const Result& result : summary.results) {
    const std::string of = summary.repetitions > 1 ? fmt::format(" {}", result.repetition) : "";
    for (const StrokeRemark& remark : result.score.match.remarks) {
      ++count;
      text += fmt::format("{:>3} {}  {}{}  {}\n", result.position, encode_utf8(result.score.character),
                          name_of(result.mode, language), of,
                          remark_text(remark, result.score.match.character, language));
    }
  }
  if (count == 0) return "";
  if (count <= most_remarks) return "\n" + text;
  return "\n" + language.text("write.many_remarks", {{"count", std::to_string(count)}}) + "\n";
}

}  // namespace calligraphy::tools
