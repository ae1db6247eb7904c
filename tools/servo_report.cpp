#include "servo_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace calligraphy::tools {
namespace {

std::string line(const char* name, const DurationSummary& summary) {
  return fmt::format("{:<12} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f}\n", name, 1e6 * summary.p50, 1e6 * summary.p99,
                     1e6 * summary.p99_9, 1e6 * summary.worst);
}

nlohmann::ordered_json object(const DurationSummary& summary) {
  return {{"p50_s", summary.p50}, {"p99_s", summary.p99}, {"p99_9_s", summary.p99_9}, {"worst_s", summary.worst}};
}

/// Calls `each` with the name and the count of every fault that occurred.
template <class Each>
void for_each_fault(const ServoStatistics& statistics, Each each) {
  for (std::size_t i = 0; i < statistics.faults.size(); ++i) {
    if (statistics.faults[i] > 0) each(to_string(static_cast<DeviceFault>(i)), statistics.faults[i]);
  }
}

}  // namespace

std::string lines(const ServoStatistics& statistics) {
  std::string text = fmt::format("{:<12} {:>9} {:>9} {:>9} {:>9}\n", "servo [us]", "p50", "p99", "p99.9", "worst");
  text += line("period", statistics.period) + line("work", statistics.work);
  text += fmt::format("{} ticks, {} missed deadlines, {} without a fresh sample", statistics.ticks,
                      statistics.missed_deadlines, statistics.stale_samples);
  for_each_fault(statistics,
                 [&text](const char* name, std::uint64_t count) { text += fmt::format("; {}: {}", name, count); });
  return text + "\n";
}

std::string json(const std::vector<ServoStatistics>& runs) {
  auto list = nlohmann::ordered_json::array();
  for (const ServoStatistics& run : runs) {
    nlohmann::ordered_json faults = nlohmann::ordered_json::object();
    for_each_fault(run, [&faults](const char* name, std::uint64_t count) { faults[name] = count; });
    list.push_back({{"ticks", run.ticks},
                    {"period", object(run.period)},
                    {"work", object(run.work)},
                    {"missed_deadlines", run.missed_deadlines},
                    {"stale_samples", run.stale_samples},
                    {"watchdog_takeovers", run.watchdog_takeovers},
                    {"faults", faults}});
  }
  return list.dump(2) + "\n";
}

}  // namespace calligraphy::tools
