// Draws cases of guided hands that are disturbed, and counts those in which the guidance drives the pen.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include <unistd.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>

#include "arguments.hpp"
#include "issue_cases.hpp"
#include "sweep.hpp"

namespace {

using namespace calligraphy_test;

constexpr const char* usage =
    "usage: guidance_sweep [--cases N] [--seed S] [--threads T] [--json FILE]   a sweep; exit code 1 if any case "
    "fails\n"
    "       guidance_sweep --seed S --case K > FILE                             one case, its motion as CSV\n"
    "       guidance_sweep --laws [--cases N] [--seed S] [--threads T]          laws of which nothing is known\n"
    "       guidance_sweep --issue                                              named cases that were once unstable\n";

struct Group {
  int cases = 0, refused = 0, failed = 0, later = 0, failed_by_letter = 0;
  int quick = 0, soft = 0;  ///< with delay <= 1 and rate >= 1 kHz: all, and those refused or clipped below 150 N/m
  double motion_excess = 0.0, force = 0.0;

  void add(const SweepCase& drawn, const SweepResult& result) {
    ++cases;
    refused += result.refused;
    failed += result.fails();
    later += result.fails_later;
    failed_by_letter += result.fails_by_letter();
    if (drawn.device.sample_delay <= 1 && drawn.device.update_rate >= 1000.0) {
      ++quick;
      soft += result.refused || result.clipped_soft();
    }
    motion_excess = std::max(motion_excess, result.motion_excess);
    force = std::max(force, result.force);
  }
};

void print_row(const std::string& name, const Group& group) {
  std::printf("%-26s %6d %7d %6d %6d %10d %6d %6d %9.2f %7.2f\n", name.c_str(), group.cases, group.refused,
              group.failed, group.later, group.failed_by_letter, group.quick, group.soft, 1e3 * group.motion_excess,
              group.force);
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

void write_json(const std::string& path, std::uint64_t seed, const std::map<std::string, Group>& groups,
                const std::vector<SweepResult>& results) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) throw calligraphy::ValueError(path + ": cannot be written");
  std::fprintf(file, "{\"seed\": %llu, \"cases\": %zu, \"groups\": {", static_cast<unsigned long long>(seed),
               results.size());
  const char* comma = "";
  for (const auto& [name, group] : groups) {
    std::fprintf(file,
                 "%s\n  %s: {\"cases\": %d, \"refused\": %d, \"failed\": %d, \"failed_later\": %d, "
                 "\"failed_by_letter\": %d, \"quick\": %d, "
                 "\"soft\": %d, \"motion_excess\": %.6g, \"force\": %.6g}",
                 comma, quoted(name).c_str(), group.cases, group.refused, group.failed, group.later,
                 group.failed_by_letter, group.quick, group.soft, group.motion_excess, group.force);
    comma = ",";
  }
  std::fprintf(file, "\n},\n\"failures\": [");
  comma = "";
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].fails_by_letter() && !results[i].refused) continue;
    std::fprintf(file, "%s\n  {\"case\": %zu, \"fails\": %s, \"drawn\": %s, \"result\": %s}", comma, i,
                 results[i].fails() ? "true" : "false", quoted(describe(draw_case(seed, static_cast<int>(i)))).c_str(),
                 quoted(describe(results[i])).c_str());
    comma = ",";
  }
  std::fprintf(file, "\n]}\n");
  std::fclose(file);
}

int replay(std::uint64_t seed, int index) {
  const SweepCase drawn = draw_case(seed, index);
  std::fprintf(stderr, "%s\n", describe(drawn).c_str());
  std::printf("time_s,state,x_mm,y_mm,z_mm,twin_x_mm,twin_y_mm,twin_z_mm,force_x_N,force_y_N,force_z_N\n");
  const SweepResult result = run_case(drawn, [](const SweepSample& sample) {
    const Vector3d pen = 1e3 * sample.pen, twin = 1e3 * sample.twin;
    std::printf("%.6f,%s,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f\n", sample.time, to_string(sample.state), pen.x(),
                pen.y(), pen.z(), twin.x(), twin.y(), twin.z(), sample.force.x(), sample.force.y(), sample.force.z());
  });
  std::fprintf(stderr, "%s\n", describe(result).c_str());
  return result.fails() ? 1 : 0;
}

/// The same cases with laws that the renderer knows nothing of, or that lie.
int sweep_laws(std::uint64_t seed, int count, int threads) {
  std::printf("%-18s %7s %6s %6s %14s %7s\n", "law", "refused", "failed", "later", "most energy J", "worst N");
  for (const char* const name : strange_laws) {
    Group group;
    double energy = 0.0, peak = 0.0;
    const auto results = run_sweep(seed, count, threads, nullptr, [name](SweepCase& drawn) {
      drawn.options.guidance.force = strange_law(name);
    });
    for (const SweepResult& result : results) {
      group.refused += result.refused;
      group.failed += result.fails();
      group.later += result.fails_later;
      energy = std::max(energy, result.energy);
      peak = std::max(peak, result.peak_force);
    }
    std::printf("%-18s %7d %6d %6d %14.4f %7.2f\n", name, group.refused, group.failed, group.later, energy, peak);
    std::fflush(stdout);
  }
  return 0;
}

int sweep(std::uint64_t seed, int count, int threads, const std::string& json) {
  const bool watched = isatty(STDERR_FILENO) != 0;
  const auto results = run_sweep(seed, count, threads, [watched](double share) {
    if (watched) std::fprintf(stderr, "\r%3.0f %%", 100.0 * share);
  });
  if (watched) std::fprintf(stderr, "\r     \r");

  std::map<std::string, Group> groups, disturbances, hands;
  Group all;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const SweepCase drawn = draw_case(seed, static_cast<int>(i));
    groups[drawn.device.name + ", " + composition_names[static_cast<std::size_t>(drawn.composition)]].add(drawn,
                                                                                                          results[i]);
    disturbances[disturbance_names[static_cast<std::size_t>(drawn.disturbance)]].add(drawn, results[i]);
    hands[drawn.bare ? "bare pen" : "grip"].add(drawn, results[i]);
    all.add(drawn, results[i]);
    if (results[i].fails_by_letter() || results[i].refused) {
      std::printf("%s%s\n    %s\n", results[i].fails() || results[i].refused ? "" : "(forgiven) ",
                  describe(drawn).c_str(), describe(results[i]).c_str());
    }
  }
  std::printf("\n%-26s %6s %7s %6s %6s %10s %6s %6s %9s %7s\n", "", "cases", "refused", "failed", "later", "by letter",
              "quick", "soft", "worst mm", "worst N");
  for (const auto& [name, group] : groups) print_row(name, group);
  for (const auto& [name, group] : disturbances) print_row(name, group);
  for (const auto& [name, group] : hands) print_row(name, group);
  print_row("all", all);
  std::printf(
      "by letter: beyond the twin by 0.5 mm or 0.2 N peak to peak, 1.5 to 2.5 s after the disturbance, or much faster; "
      "failed:\nthe force beyond the stiffness times the twin's motion, and motion only where any force acts; later: "
      "of these, 5 to 6 s after too; quick: "
      "delay "
      "at most 1 and\nrate at least 1 kHz; soft: of these, refused or clipped below 150 N/m\n");
  if (!json.empty()) write_json(json, seed, groups, results);
  return all.failed + all.refused > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments(argc, argv);
  const bool issue = arguments.flag("--issue"), laws = arguments.flag("--laws");
  const auto seed = static_cast<std::uint64_t>(arguments.number("--seed", 1));
  const int one = static_cast<int>(arguments.number("--case", -1));
  const int count = static_cast<int>(arguments.number("--cases", 10000));
  const int threads = static_cast<int>(arguments.number("--threads", 0));
  const std::string json = arguments.text("--json");
  if (!arguments.understood()) {
    std::fputs(usage, stderr);
    return 2;
  }
  try {
    if (issue) return print_issue_cases(threads) ? 0 : 1;
    if (laws) return sweep_laws(seed, count, threads);
    if (one >= 0) return replay(seed, one);
    return sweep(seed, count, threads, json);
  } catch (const calligraphy::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
