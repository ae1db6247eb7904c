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

#include "counted.hpp"
#include "score_json.hpp"

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

/// Fewer independent pairs of runs vary too much to show an effect of force.
constexpr std::size_t least_runs = 10;

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

std::string reduction(const char* what, const char* unit, const std::vector<Pair>& both, const Quantity& quantity) {
  double vision = 0.0;
  std::vector<DrawnValue> reduced;
  for (const Pair& pair : both) {
    vision += quantity(*pair.vision) / static_cast<double>(both.size());
    reduced.push_back({quantity(*pair.vision) - quantity(*pair.force), pair.vision->seed});
  }
  const MeanInterval interval = mean_interval(reduced);
  const std::string relative = vision > 0.0 ? fmt::format(" ({:.1f} %)", 100.0 * interval.mean / vision) : "";
  return fmt::format("{:<10} {:.3f} {}{} less with force, 95 % interval {:.3f} to {:.3f} {}\n", what, interval.mean,
                     unit, relative, interval.mean - interval.half_width, interval.mean + interval.half_width, unit);
}

/// The results from `begin` on that differ only in their repetition end here.
std::size_t end_of_repetitions(const std::vector<Result>& results, std::size_t begin) {
  const Result& first = results[begin];
  std::size_t end = begin;
  while (end < results.size() && results[end].position == first.position && results[end].mode == first.mode) ++end;
  return end;
}

/// "interrupted: means over 3 to 100 of 100 repetitions"; empty where there is nothing to average.
std::string repetitions(const Summary& summary) {
  if (summary.repetitions == 1) return "";
  if (!summary.interrupted) return fmt::format("means over {} repetitions\n", summary.repetitions);
  std::size_t least = summary.results.size(), most = 0;
  for (std::size_t begin = 0, end = 0; begin < summary.results.size(); begin = end) {
    end = end_of_repetitions(summary.results, begin);
    least = std::min(least, end - begin);
    most = std::max(most, end - begin);
  }
  const std::string range = least < most ? fmt::format("{} to {}", least, most) : fmt::format("{}", most);
  return fmt::format("interrupted: means over {} of {} repetitions\n", range, summary.repetitions);
}

constexpr const char* writing_columns = "{:<10}{:<8}{:>8}{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>7}{:>7}{:>7}{:>9}\n";

std::string writing_head() {
  const auto line = fmt::runtime(writing_columns);
  return fmt::format(line, "", "", "time", "RMS err", "max err", "overall", "written", "written", "order", "back-",
                     "extra", "miss-", "comple-") +
         fmt::format(line, "character", "mode", "[s]", "[mm]", "[mm]", "[mm]", "[%]", "strokes", "", "wards", "", "ing",
                     "ted");
}

std::string writing_line(const std::vector<Result>& results, std::size_t begin, std::size_t end) {
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
  return fmt::format(fmt::runtime(writing_columns), encode_utf8(first.character), to_string(results[begin].mode),
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

std::string motion_head() {
  const auto line = fmt::runtime(motion_columns);
  return fmt::format(line, "", "", "paper", "air", "pen-", "path", "mean v", "peak v", "peaks", "smooth", "DTW",
                     "pressure", "peak F", "max step", "p50", "p99.9") +
         fmt::format(line, "character", "mode", "[s]", "[s]", "ups", "[mm]", "[mm/s]", "[mm/s]", "of v", "SPARC",
                     "[mm]", "[N]", "[N]", "[N/tick]", "[ns]", "[ns]");
}

std::string motion_line(const std::vector<Result>& results, std::size_t begin, std::size_t end) {
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
      fmt::runtime(motion_columns), encode_utf8(results[begin].score.character), to_string(results[begin].mode),
      motion(&WritingMotion::time_on_paper, 1.0, 2), motion(&WritingMotion::time_in_air, 1.0, 2),
      motion(&WritingMotion::pen_ups, 1.0, decimals), motion(&WritingMotion::path_length, millimetres, 1),
      motion(&WritingMotion::mean_speed, millimetres, 1), motion(&WritingMotion::peak_speed, millimetres, 1),
      motion(&WritingMotion::velocity_peaks, 1.0, decimals), motion(&WritingMotion::smoothness, 1.0, 2),
      score(&CharacterScore::dtw_distance, millimetres, 3), score(&CharacterScore::mean_pressure, 1.0, 2),
      score(&CharacterScore::peak_force, 1.0, 2), score(&CharacterScore::max_force_step, 1.0, 3),
      of([](const Result& r) { return r.tick_p50; }, 0), of([](const Result& r) { return r.tick_p999; }, 0));
}

/// A line for each mode: over how many of how many strokes its errors are.
std::string means(const std::vector<Result>& results) {
  std::string text;
  for (const FeedbackMode mode : {FeedbackMode::vision, FeedbackMode::force}) {
    std::vector<CharacterScore> scores;
    for (const Result& result : results) {
      if (result.mode == mode) scores.push_back(result.score);
    }
    if (scores.empty()) continue;
    const MeanScore all = mean_score(scores);
    text += fmt::format("{:<7} RMS error {} mm over {} of {} strokes; {} mm with what was left out\n", to_string(mode),
                        fixed(all.rms_error * millimetres, 3), all.strokes_written, all.stroke_count,
                        fixed(all.overall_error * millimetres, 3));
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

std::string table(const Summary& summary) {
  const std::vector<Result>& results = summary.results;
  std::string text = repetitions(summary);
  for (const bool second : {false, true}) {
    if (second) text += "\n";
    text += second ? motion_head() : writing_head();
    for (std::size_t begin = 0, end = 0; begin < results.size(); begin = end) {
      end = end_of_repetitions(results, begin);
      text += second ? motion_line(results, begin, end) : writing_line(results, begin, end);
    }
  }
  return text + "\n" + means(results);
}

std::string json(const Summary& summary) {
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
                    {"seed", result.seed},
                    {"time_s", score.time},
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
  const Json all = {{"repetitions_requested", summary.repetitions},
                    {"interrupted", summary.interrupted},
                    {"warnings", summary.warnings},
                    {"results", list}};
  return all.dump(2) + "\n";
}

std::string reductions(const std::vector<Result>& results) {
  std::vector<Pair> both = pairs(results);
  if (both.empty()) return "";
  const std::size_t all = both.size();
  // An aborted character has no meaningful error or time.
  std::erase_if(both, [](const Pair& pair) { return !is_complete(*pair.vision) || !is_complete(*pair.force); });
  std::set<std::uint64_t> runs;
  for (const Pair& pair : both) runs.insert(pair.vision->seed);
  std::string text;
  if (both.empty()) {
    text = "no character was completed in both modes: no effect of force to show\n";
  } else if (runs.size() < least_runs) {
    text = fmt::format("n = {} of runs: too few to show an effect of force; try --repeat 20\n",
                       counted(runs.size(), "pair"));
  } else {
    text = reduction("RMS error", "mm", both, [](const Result& r) { return r.score.rms_error * millimetres; }) +
           reduction("time", "s", both, [](const Result& r) { return r.score.time; }) +
           fmt::format(
               "{} in n = {} pairs of runs, by which they are clustered; mean +/- t(0.975, n - 1) "
               "standard errors\n",
               counted(both.size(), "character"), runs.size());
  }
  if (const std::size_t omitted = all - both.size(); omitted > 0) {
    text += counted(omitted, "pair") + " omitted: not every stroke was completed\n";
  }
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
                          to_string(result.mode), of, remark_text(remark, result.score.match.character, language));
    }
  }
  if (count == 0) return "";
  return "\n" + (count <= most_remarks ? text : counted(count, "remark") + ": see summary.json\n");
}

}  // namespace calligraphy::tools
