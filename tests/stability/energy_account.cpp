// Hands that try to get energy out of the guidance, over devices, delays and faults of timing: what they got, by the
// work of the force at work, against the budget.
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <unistd.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/render/detail/energy_observer.hpp>

#include "arguments.hpp"
#include "base/parallel.hpp"
#include "energy.hpp"

namespace {

using namespace calligraphy_test;

constexpr const char* usage =
    "usage: energy_account [--ticks N] [--seed S] [--threads T] [--budget J] [--gap TICKS] [--gap-share P] [--list]\n"
    "                      [--profile NAME] [--delay D] [--hand NAME] [--timing NAME] [--alone | --servo] [--draw N]\n"
    "--draw: only N cases of each profile at each delay, drawn by the seed\n"
    "exit code 1 if any run gives more than the budget\n";

template <std::size_t size>
bool chosen(const std::string& wanted, const std::array<const char*, size>& names, std::size_t i) {
  return wanted.empty() || wanted == names[i];
}

struct Group {
  int runs = 0, over = 0;
  double given = 0.0, excess = -1.0, rise = 0.0, claimed = 0.0, peak = 0.0, mean_force = 0.0;
  int writing = 0;

  void add(const EnergyResult& result) {
    ++runs;
    over += result.over();
    given = std::max(given, result.most_given);
    excess = std::max(excess, result.most_excess);
    rise = std::max(rise, result.most_rise);
    claimed = std::max(claimed, result.most_claimed);
    peak = std::max(peak, result.peak_force);
    mean_force += result.mean_force;
    writing += result.writing > 0;
  }
  void print(const std::string& name) const {
    std::printf("%-40s %5d %5d %9.3f %9.3f %9.3f %9.3f %8.2f %8.2f\n", name.c_str(), runs, over, given, excess, rise,
                claimed, peak, writing > 0 ? mean_force / writing : 0.0);
  }
};

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments(argc, argv);
  EnergyRun base;
  base.ticks = static_cast<std::int64_t>(arguments.number("--ticks", 100000));
  base.seed = static_cast<std::uint64_t>(arguments.number("--seed", 1));
  base.budget = arguments.number("--budget", 0.1);
  const int gap = static_cast<int>(arguments.number("--gap", 0));
  if (gap > 0) base.shortest_gap = base.longest_gap = gap;
  base.gap_share = arguments.number("--gap-share", base.gap_share);
  const int threads = static_cast<int>(arguments.number("--threads", 0));
  const auto draw = static_cast<std::size_t>(arguments.number("--draw", 0));
  const int delay = static_cast<int>(arguments.number("--delay", -1));
  const std::string profile = arguments.text("--profile"), hand = arguments.text("--hand"),
                    timing = arguments.text("--timing");
  const bool alone = arguments.flag("--alone"), servo = arguments.flag("--servo"), list = arguments.flag("--list");
  if (!arguments.understood()) {
    std::fputs(usage, stderr);
    return 2;
  }
  std::vector<EnergyRun> runs;
  calligraphy::Random random(base.seed);
  for (const auto& device : calligraphy::device_profiles()) {
    if (!profile.empty() && profile != device.name) continue;
    for (int late = 0; late <= calligraphy::detail::EnergyObserver::max_delay; ++late) {
      std::vector<EnergyRun> cases;
      for (std::size_t t = 0; t < timing_names.size(); ++t) {
        for (std::size_t h = 0; h < energy_hand_names.size(); ++h) {
          for (const bool behind : {false, true}) {
            if (!chosen(timing, timing_names, t) || !chosen(hand, energy_hand_names, h)) continue;
            if ((delay >= 0 && late != delay) || (behind ? alone : servo)) continue;
            if (!behind && needs_servo(static_cast<Timing>(t))) continue;
            EnergyRun run = base;
            run.device = device;
            run.device.sample_delay = late;
            run.hand = static_cast<EnergyHand>(h);
            run.timing = static_cast<Timing>(t);
            run.servo = behind;
            cases.push_back(run);
          }
        }
      }
      if (draw > 0) {
        calligraphy::shuffle(cases, random);
        cases.resize(std::min(draw, cases.size()));
      }
      runs.insert(runs.end(), cases.begin(), cases.end());
    }
  }
  std::vector<EnergyResult> results(runs.size());
  const bool watched = isatty(STDERR_FILENO) != 0;
  calligraphy::parallel_for(
      runs.size(), threads,
      [watched](double share) {
        if (watched) std::fprintf(stderr, "\r%3.0f %%", 100.0 * share);
      },
      [&](std::size_t i) { results[i] = run_energy(runs[i]); });
  if (watched) std::fprintf(stderr, "\r     \r");

  std::map<std::string, Group> profiles, delays, hands;
  Group all;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const EnergyRun& run = runs[i];
    const EnergyResult& result = results[i];
    const std::string at = run.servo ? ", servo" : ", alone";
    const char* named_hand = energy_hand_names[static_cast<std::size_t>(run.hand)];
    const char* named_timing = timing_names[static_cast<std::size_t>(run.timing)];
    profiles[run.device.name + ", " + named_timing + at].add(result);
    char late[24];
    std::snprintf(late, sizeof late, "delay %2d", run.device.sample_delay);
    delays[late + at].add(result);
    hands[std::string(named_hand) + at].add(result);
    all.add(result);
    if (list || result.over()) {
      std::printf(
          "%s --profile %s --delay %d --hand '%s' --timing '%s' --%s: given %.4f J (end %.4f), excess %.4f, rise "
          "%.4f, claimed %.4f, peak %.2f N, %d strokes %s\n",
          result.over() ? "over " : "", run.device.name.c_str(), run.device.sample_delay, named_hand, named_timing,
          run.servo ? "servo" : "alone", result.most_given, result.given_at_end, result.most_excess, result.most_rise,
          result.most_claimed, result.peak_force, result.strokes, result.refusal.c_str());
    }
  }
  std::printf("\n%lld ticks each, budget %.3f J\n%-40s %5s %5s %9s %9s %9s %9s %8s %8s\n",
              static_cast<long long>(base.ticks), base.budget, "", "runs", "over", "given J", "excess J", "rise J",
              "claimed J", "peak N", "mean N");
  for (const auto& [name, group] : profiles) group.print(name);
  for (const auto& [name, group] : delays) group.print(name);
  for (const auto& [name, group] : hands) group.print(name);
  all.print("all");
  std::printf(
      "given: maximum over time of the net work of the force at work; excess: of that beyond the budget and what "
      "gaps longer\nthan max_gap allow; rise: above the least ever given; claimed: by the renderer's own account; "
      "mean: of the force while writing\n");
  return all.over > 0 ? 1 : 0;
}
