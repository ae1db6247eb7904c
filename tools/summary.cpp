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

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;
using Quantity = std::function<double(const Result&)>;

constexpr double millimetres = 1e3;

double mean(const std::vector<Result>& results, std::size_t begin, std::size_t end, const Quantity& quantity) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) sum += quantity(results[i]);
  return sum / static_cast<double>(end - begin);
}

/// Fewer independent pairs of runs vary too much to show an effect of force.
constexpr std::size_t least_runs = 10;

/// A character written without and with force, with the beliefs of one seed.
struct Pair {
  const Result* vision;
  const Result* force;
};

/// "3.142"; "-" where no repetition completed a stroke, so that there is no error. [mm]
std::string mean_error(const std::vector<Result>& results, std::size_t begin, std::size_t end,
                       double CharacterScore::*error) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (results[i].score.strokes_completed == 0) continue;
    sum += results[i].score.*error * millimetres;
    ++count;
  }
  return count > 0 ? fmt::format("{:.3f}", sum / count) : "-";
}

bool is_complete(const Result& result) { return result.score.strokes_completed >= result.score.stroke_count; }

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
  constexpr const char* head = "{:<10}{:<8}{:>8}{:>10}{:>10}{:>7}{:>11}{:>9}{:>10}{:>10}{:>10}{:>12}\n";
  std::string text = repetitions(summary);
  text += fmt::format(fmt::runtime(head), "", "", "time", "RMS err", "max err", "order", "direction",
                      "strokes", "peak F", "max step", "tick p50", "tick p99.9");
  text += fmt::format(fmt::runtime(head), "character", "mode", "[s]", "[mm]", "[mm]", "errors", "errors", "written",
                      "[N]", "[N/tick]", "[ns]", "[ns]");
  for (std::size_t begin = 0; begin < results.size();) {
    const Result& first = results[begin];
    const std::size_t end = end_of_repetitions(results, begin);
    const auto of = [&](const Quantity& quantity) { return mean(results, begin, end, quantity); };
    const int decimals = end - begin > 1 ? 2 : 0;
    const double written = of([](const Result& r) { return r.score.strokes_completed; });
    text += fmt::format(
        "{:<10}{:<8}{:>8.2f}{:>10}{:>10}{:>7.{}f}{:>11.{}f}{:>9}{:>10.2f}{:>10.3f}{:>10.0f}{:>12.0f}\n",
        encode_utf8(first.score.character), to_string(first.mode), of([](const Result& r) { return r.score.time; }),
        mean_error(results, begin, end, &CharacterScore::rms_error),
        mean_error(results, begin, end, &CharacterScore::max_error),
        of([](const Result& r) { return r.score.order_mistakes(); }), decimals,
        of([](const Result& r) { return r.score.direction_mistakes(); }), decimals,
        fmt::format("{:.{}f}/{}", written, decimals, first.score.stroke_count),
        of([](const Result& r) { return r.score.peak_force; }),
        of([](const Result& r) { return r.score.max_force_step; }), of([](const Result& r) { return r.tick_p50; }),
        of([](const Result& r) { return r.tick_p999; }));
    begin = end;
  }
  return text;
}

std::string json(const Summary& summary) {
  Json list = Json::array();
  for (const Result& result : summary.results) {
    const CharacterScore& score = result.score;
    const auto error = [&score](double metres) {  // null: no stroke was completed, so there is no error
      return score.strokes_completed > 0 ? Json(metres * millimetres) : Json();
    };
    Json mistakes = Json::array();
    for (const WritingMistake& mistake : score.mistakes) {
      mistakes.push_back({{"kind", mistake.kind == WritingMistakeKind::order ? "order" : "direction"},
                          {"stroke", mistake.stroke + 1},
                          {"time_s", mistake.time},
                          {"reason", mistake.reason}});
    }
    list.push_back({{"character", encode_utf8(score.character)},
                    {"position", result.position},
                    {"mode", to_string(result.mode)},
                    {"repetition", result.repetition},
                    {"seed", result.seed},
                    {"time_s", score.time},
                    {"rms_error_mm", error(score.rms_error)},
                    {"max_error_mm", error(score.max_error)},
                    {"order_mistakes", score.order_mistakes()},
                    {"direction_mistakes", score.direction_mistakes()},
                    {"strokes", score.stroke_count},
                    {"strokes_completed", score.strokes_completed},
                    {"peak_force_N", score.peak_force},
                    {"max_force_step_N", score.max_force_step},
                    {"tick_ns_p50", result.tick_p50},
                    {"tick_ns_p999", result.tick_p999},
                    {"contour", score.contour},
                    {"external_sequence", score.external_sequence},
                    {"internal_sequence", score.internal_sequence},
                    {"fidelity", score.fidelity},
                    {"mistakes", mistakes}});
  }
  const Json all = {{"repetitions_requested", summary.repetitions}, {"interrupted", summary.interrupted}, {"results", list}};
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

}  // namespace calligraphy::tools
