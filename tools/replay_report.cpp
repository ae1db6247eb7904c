#include "replay_report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr RemarkKind remark_kinds[] = {RemarkKind::order,  RemarkKind::direction, RemarkKind::shape, RemarkKind::joined,
                                RemarkKind::broken, RemarkKind::missing,   RemarkKind::extra};

/// Pen-downs that were not a mere bounce.
int strokes_drawn(const StrokeVerdict& verdict) {
  return static_cast<int>(std::count_if(verdict.drawn.begin(), verdict.drawn.end(),
                                        [](const DrawnStroke& drawn) { return drawn.stroke >= 0 || !drawn.tap; }));
}

bool none_recognised(const StrokeVerdict& verdict) {
  return std::none_of(verdict.drawn.begin(), verdict.drawn.end(),
                      [](const DrawnStroke& drawn) { return drawn.stroke >= 0; });
}

std::string order_of(const StrokeVerdict& verdict) {
  if (none_recognised(verdict)) return "not told";
  const int wrong = verdict.count(RemarkKind::order);
  return wrong == 0 ? "right" : fmt::format("{} out of turn", wrong);
}

std::string direction_of(const StrokeVerdict& verdict) {
  if (none_recognised(verdict)) return "not told";
  const int wrong = verdict.count(RemarkKind::direction), unclear = verdict.count(RemarkKind::shape);
  if (wrong > 0) return fmt::format("{} backwards", wrong);
  return unclear == 0 ? "right" : fmt::format("{} not told", unclear);
}

/// "1 joined, 2 missing"
std::string others(const StrokeVerdict& verdict) {
  std::string text;
  for (const RemarkKind kind : remark_kinds) {
    const int count = verdict.count(kind);
    if (count == 0 || kind == RemarkKind::order || kind == RemarkKind::direction) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name_of(kind));
  }
  return text;
}

const char* course_name(Course course) {
  switch (course) {
    case Course::forwards:
      return "forwards";
    case Course::backwards:
      return "backwards";
    case Course::neither:
      return "neither";
    case Course::unknown:
      break;
  }
  return "unknown";
}

Json json_of(const Replayed& trace) {
  Json drawn = Json::array();
  for (const DrawnStroke& each : trace.verdict.drawn) {
    Json strokes = Json::array();
    for (int i = 0; i < each.stroke_count; ++i) strokes.push_back(each.stroke + i + 1);
    drawn.push_back({{"strokes", strokes},
                     {"in_turn", each.in_turn},
                     {"course", course_name(each.course)},
                     {"continues", each.continues},
                     {"tap", each.tap},
                     {"distance_em", each.stroke_count > 0 ? Json(each.distance) : Json()}});
  }
  Json remarks = Json::array();
  for (const Remark& remark : trace.verdict.remarks) {
    remarks.push_back({{"kind", calligraphy::name_of(remark.kind)},
                       {"pen_down", remark.path >= 0 ? Json(remark.path + 1) : Json()},
                       {"stroke", remark.stroke >= 0 ? Json(remark.stroke + 1) : Json()},
                       {"reason", remark.reason}});
  }
  return {{"character", encode_utf8(trace.guided.character)},
          {"position", trace.position},
          {"set", trace.set},
          {"strokes_drawn", strokes_drawn(trace.verdict)},
          {"strokes", trace.guided.stroke_count},
          {"order_mistakes", trace.verdict.count(RemarkKind::order)},
          {"direction_mistakes", trace.verdict.count(RemarkKind::direction)},
          {"drawn", drawn},
          {"remarks", remarks},
          {"strokes_completed", trace.guided.strokes_completed},
          {"faults", trace.faults},
          {"peak_force_N", trace.guided.peak_force},
          {"max_force_step_N", trace.guided.max_force_step}};
}

}  // namespace

std::string table(const ReplayReport& report) {
  constexpr const char* head = "{:<8}{:>10}  {:<16}{:<14}{:<22}{:>11}{:>8}{:>8}{:>11}\n";
  std::string text = fmt::format(fmt::runtime(head), "", "strokes", "", "", "", "completed", "", "peak F", "max step");
  text +=
      fmt::format(fmt::runtime(head), "", "drawn", "order", "direction", "else", "guided", "faults", "[N]", "[N/tick]");
  std::string remarks;
  for (const Replayed& trace : report.traces) {
    const StrokeVerdict& verdict = trace.verdict;
    const std::string character = encode_utf8(trace.guided.character);
    text += fmt::format("{:>3} {}  {:>10}  {:<16}{:<14}{:<22}{:>11}{:>8}{:>8.2f}{:>11.3f}\n", trace.position, character,
                        fmt::format("{}/{}", strokes_drawn(verdict), trace.guided.stroke_count), order_of(verdict),
                        direction_of(verdict), others(verdict),
                        fmt::format("{}/{}", trace.guided.strokes_completed, trace.guided.stroke_count), trace.faults,
                        trace.guided.peak_force, trace.guided.max_force_step);
    for (const Remark& remark : verdict.remarks) {
      remarks += fmt::format("{:>3} {}  {}: {}\n", trace.position, character, calligraphy::name_of(remark.kind),
                             remark.reason);
    }
  }
  text += fmt::format("limits of {}: force {:.2f} N, force step {:.3f} N/tick\n", report.device, report.peak_force,
                      report.max_force_step);
  if (!remarks.empty()) text += "\n" + remarks;
  const auto right = [&report](std::string (*judged)(const StrokeVerdict&)) {
    return std::count_if(report.traces.begin(), report.traces.end(),
                         [judged](const Replayed& trace) { return judged(trace.verdict) == "right"; });
  };
  text += fmt::format("\n{} of {} in the right order, {} in the right direction\n", right(order_of),
                      report.traces.size(), right(direction_of));
  if (!report.without_template.empty()) {
    text += fmt::format("{} without a template:", report.without_template.size());
    for (const char32_t code : report.without_template) text += " " + encode_utf8(code);
    text += "\n";
  }
  return text;
}

std::string json(const ReplayReport& report) {
  Json traces = Json::array();
  for (const Replayed& trace : report.traces) traces.push_back(json_of(trace));
  Json missing = Json::array();
  for (const char32_t code : report.without_template) missing.push_back(encode_utf8(code));
  const Json all = {{"device", report.device},
                    {"renderer", report.renderer},
                    {"peak_force_limit_N", report.peak_force},  // null: none
                    {"force_step_limit_N", report.max_force_step},
                    {"traces", traces},
                    {"without_template", missing}};
  return all.dump(2) + "\n";
}

}  // namespace calligraphy::tools
