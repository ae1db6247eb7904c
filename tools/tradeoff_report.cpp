#include "tradeoff_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>

#include "import_report.hpp"
#include "importers/check/import_report_json.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr double in_millimetres = 1e3;
constexpr double in_percent = 100.0;

std::string utf8(const std::u32string& text) {
  std::string result;
  for (const char32_t code : text) result += encode_utf8(code);
  return result;
}

using Cost = NearestPointCost NearestPointTradeoff::*;

std::string cost_table(const TradeoffReport& report, const std::string& heading, Cost cost) {
  constexpr const char* head = "{:<18}{:>9}{:>9}{:>10}{:>11}{:>11}{:>11}{:>10}\n";
  std::string text = heading + "; errors relative to the size of the curve\n";
  text += fmt::format(fmt::runtime(head), "", "median", "p90", "batched", "median", "p99", "max", "wrong");
  text += fmt::format(fmt::runtime(head), "method", "[ns]", "[ns]", "[ns]", "error", "error", "error", "[%]");
  for (const NearestPointTradeoff& entry : report.nearest_point) {
    const NearestPointCost& own = entry.*cost;
    text +=
        fmt::format("{:<18}{:>9.1f}{:>9.1f}{:>10.1f}{:>11.1e}{:>11.1e}{:>11.1e}{:>10.3f}\n", entry.setting.name, own.ns,
                    own.ns_p90, own.batch_ns, own.error, own.error_p99, own.error_worst, own.wrong * in_percent);
  }
  return text + "\n";
}

std::string hand_table(const TradeoffReport& report) {
  const NearestPointTradeoffOptions& options = report.nearest_options;
  constexpr const char* head = "{:<18}{:>9}{:>9}{:>9}{:>13}{:>9}{:>13}{:>9}\n";
  std::string text =
      fmt::format("Nearest point from tick to tick, and the resulting force steps: K = {:g} N/m, {:g} mm/s, {:g} Hz\n",
                  options.stiffness, options.speed * in_millimetres, options.rate);
  text += fmt::format("{:<18}{:>27}{:>22}{:>22}\n", "", "pen along whole strokes", "curves of strokes", "gentle arcs");
  text += fmt::format(fmt::runtime(head), "", "tick", "p90", "wrong", "force step", "wrong", "force step", "wrong");
  text += fmt::format(fmt::runtime(head), "method", "[ns]", "[ns]", "[%]", "[N/tick]", "[%]", "[N/tick]", "[%]");
  for (const NearestPointTradeoff& entry : report.nearest_point) {
    text += fmt::format("{:<18}{:>9.1f}{:>9.1f}{:>9.3f}{:>13.4f}{:>9.3f}{:>13.4f}{:>9.3f}\n", entry.setting.name,
                        entry.ticks.ns, entry.ticks.ns_p90, entry.ticks.wrong * in_percent, entry.strokes.max_step,
                        entry.strokes.wrong * in_percent, entry.arcs.max_step, entry.arcs.wrong * in_percent);
  }
  return text + "even the exact closest point steps the force, because the pen moves: see the rows of exact\n\n";
}

std::string rate_table(const TradeoffReport& report) {
  const auto& rows = report.servo_rate;
  std::string text =
      fmt::format("Servo rate: the novice writes {}, {} seed{}, on a simulated {}; default paper stiffness {:g} N/m\n",
                  utf8(report.written), report.servo_options.seeds, report.servo_options.seeds == 1 ? "" : "s",
                  report.servo_options.device, rows.empty() ? 0.0 : rows.front().stiffness);
  text += fmt::format("{:>7}  {:<42}  {:<36}  {}\n", "", "default paper", "maximum stable stiffness [N/m]",
                      "hardest paper");
  text += fmt::format("{:>7}{:>8}{:>9}{:>9}{:>9}{:>9}{:>11}{:>9}{:>9}{:>9}{:>11}{:>9}{:>9}\n", "rate", "", "depth",
                      "path", "force", "strokes", "", "no rate", "theory,", "theory,", "", "depth", "force");
  text +=
      fmt::format("{:>7}{:>8}{:>9}{:>9}{:>9}{:>9}{:>11}{:>9}{:>9}{:>9}{:>11}{:>9}{:>9}\n", "[Hz]", "stable", "[mm]",
                  "[mm RMS]", "step [N]", "done [%]", "default", "limit", "held", "free", "[N/m]", "[mm]", "step [N]");
  for (const ServoRateTradeoff& entry : rows) {
    text += fmt::format(
        "{:>7g}{:>8}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.0f}{:>11.0f}{:>9.0f}{:>9.0f}{:>9.0f}{:>11.0f}{:>9.3f}{:>9.3f}\n",
        entry.rate, entry.stable ? "yes" : "no", entry.penetration * in_millimetres, entry.path_error * in_millimetres,
        entry.force_step, entry.written * in_percent, entry.loop_stiffness, entry.unlimited_stiffness,
        entry.held_stiffness, entry.free_stiffness, entry.hard_stiffness, entry.hard_penetration * in_millimetres,
        entry.hard_force_step);
  }
  return text +
         "depth: maximum penetration; no rate limit: normal force without rate limit; hardest paper: half the maximum "
         "stable stiffness without it\n\n";
}

std::string width_table(const TradeoffReport& report) {
  constexpr const char* head = "{:>6}{:>12}{:>16}{:>12}{:>14}\n";
  std::string text = fmt::format("Width of stored coordinates: {} characters\n", report.text.size());
  text += fmt::format(fmt::runtime(head), "", "grid step", "max error", "RMS error", "bytes per");
  text += fmt::format(fmt::runtime(head), "bits", "[% em]", "[% em]", "[% em]", "character");
  for (const CoordinateWidthTradeoff& entry : report.coordinate_width) {
    text += fmt::format("{:>6}{:>12.4f}{:>16.4f}{:>12.4f}{:>14.1f}\n", entry.bits, entry.step * in_percent,
                        entry.max_error * in_percent, entry.rms_error * in_percent, entry.bytes);
  }
  return text;
}

Json json_of(const NearestPointCost& cost) {
  return {{"queries", cost.queries},       {"ns_p50", cost.ns},           {"ns_p90", cost.ns_p90},
          {"batch_ns_p50", cost.batch_ns}, {"error_p50", cost.error},     {"error_p99", cost.error_p99},
          {"error_max", cost.error_worst}, {"wrong_branches", cost.wrong}};
}

Json json_of(const PenFeel& feel) { return {{"max_force_step_N", feel.max_step}, {"wrong_ticks", feel.wrong}}; }

Json json_of(const NearestPointTradeoff& entry) {
  Json workloads = Json::array();
  for (const NearestPointCost& cost : entry.workloads) workloads.push_back(json_of(cost));
  const NearestPointOptions& options = entry.setting.options;
  Json object = {{"setting", entry.setting.name}, {"method", to_string(options.method)}};
  if (options.method == NearestPointMethod::sampled) {
    object["samples"] = options.samples;
    object["refinements"] = options.refinements;
  } else {
    object["tolerance"] = options.tolerance;
  }
  object["real_strokes"] = json_of(entry.real);
  object["hard"] = json_of(entry.hard);
  object["workloads"] = std::move(workloads);
  object["ticks"] = json_of(entry.ticks);
  object["along_strokes"] = json_of(entry.strokes);
  object["along_arcs"] = json_of(entry.arcs);
  return object;
}

Json json_of(const ServoRateTradeoff& entry) {
  return {{"rate_Hz", entry.rate},
          {"paper_stiffness_N_m", entry.stiffness},
          {"stable", entry.stable},
          {"max_penetration_mm", entry.penetration * in_millimetres},
          {"path_error_rms_mm", entry.path_error * in_millimetres},
          {"max_force_step_N", entry.force_step},
          {"strokes_written", entry.written},
          {"max_stable_stiffness_N_m", entry.loop_stiffness},
          {"max_stable_stiffness_without_force_rate_limit_N_m", entry.unlimited_stiffness},
          {"critical_stiffness_held_N_m", entry.held_stiffness},
          {"critical_stiffness_free_N_m", entry.free_stiffness},
          {"hard_paper",
           {{"stiffness_N_m", entry.hard_stiffness},
            {"max_penetration_mm", entry.hard_penetration * in_millimetres},
            {"max_force_step_N", entry.hard_force_step}}}};
}

Json json_of(const CoordinateWidthTradeoff& entry) {
  return {{"bits", entry.bits},
          {"step_em", entry.step},
          {"max_error_em", entry.max_error},
          {"rms_error_em", entry.rms_error},
          {"bytes_per_character", entry.bytes}};
}

template <typename Entry>
Json list_of(const std::vector<Entry>& entries) {
  Json list = Json::array();
  for (const Entry& entry : entries) list.push_back(json_of(entry));
  return list;
}

}  // namespace

std::string tables(const TradeoffReport& report) {
  const int queries = report.nearest_options.queries;
  return cost_table(report, fmt::format("Nearest point on real strokes, {} queries", 2 * queries),
                    &NearestPointTradeoff::real) +
         cost_table(report, fmt::format("Nearest point on the hard workloads, {} queries", 17 * queries),
                    &NearestPointTradeoff::hard) +
         hand_table(report) + rate_table(report) + width_table(report) + (report.ink ? ink_table(*report.ink) : "");
}

nlohmann::ordered_json json(const TradeoffReport& report) {
  const NearestPointTradeoffOptions& options = report.nearest_options;
  Json object = {
      {"characters", utf8(report.text)},
      {"written_characters", utf8(report.written)},
      {"seed", report.seed},
      {"queries_per_workload", options.queries},
      {"rounds", options.rounds},
      {"hand", {{"stiffness_N_m", options.stiffness}, {"speed_m_s", options.speed}, {"rate_Hz", options.rate}}},
      {"servo_rate_seeds", report.servo_options.seeds},
      {"device", report.servo_options.device},
      {"nearest_point", list_of(report.nearest_point)},
      {"servo_rate", list_of(report.servo_rate)},
      {"coordinate_width", list_of(report.coordinate_width)}};
  if (report.ink) object["ink"] = ink_json(*report.ink);
  return object;
}

}  // namespace calligraphy::tools
