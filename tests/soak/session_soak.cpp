// session_soak: days of writing in virtual time, with random faults, while every guarantee of the loop is checked.
// Exit codes: 0 all kept, 1 one broken, 2 usage.
#include <cstdio>
#include <exception>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <calligraphy/devices/device_profiles.hpp>

#include "soak.hpp"
#include "tools/options.hpp"
#include "tools/progress.hpp"

namespace calligraphy_test {
namespace {

namespace tools = calligraphy::tools;

int report(const SoakOptions& options, const Watched& watched) {
  const double rate = calligraphy::device_profile(options.device).update_rate;
  fmt::print("{} ticks ({:.1f} h at {} Hz), composition {}, device {}, seed {}\n", options.ticks,
             static_cast<double>(options.ticks) / rate / 3600.0, rate, options.composition, options.device,
             options.seed);
  fmt::print("  {} strokes written, {} faults in {} ticks\n", watched.strokes, watched.faults, watched.bad_ticks);
  fmt::print("  maximum force {:.3f} N, maximum step {:.3f} N\n", watched.max_force, watched.max_step);
  fmt::print("  net energy delivered to the hand: {:.4f} J at the end, {:.4f} J at most\n", watched.given,
             watched.max_given);
  bool all = true;
  for (const Guarantee& guarantee : guarantees(options, watched)) {
    fmt::print("  {:<60} {}\n", guarantee.text, guarantee.kept ? "kept" : "BROKEN");
    all &= guarantee.kept;
  }
  return all ? 0 : 1;
}

int parse_and_run(int argc, char** argv) {
  SoakOptions options;
  CLI::App program("Days of writing in virtual time, with random faults.", "session_soak");
  program.add_option("--ticks", options.ticks, "Number of ticks; 86400000 are 24 h at 1 kHz")
      ->check(tools::integer(1, 10'000'000'000ull));
  program.add_option("--seed", options.seed, "Seed of the hand and of the faults");
  program.add_option("--composition", options.composition, "Renderer options: default or everything")
      ->check(CLI::IsMember({"default", "everything"}));
  program.add_option("--device", options.device, "Profile of the simulated device");
  program.add_flag("!--no-faults", options.faults, "Inject no faults");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }
  tools::Progress progress;
  return report(options, soak(options, [&](double share) { progress.show(share); }));
}

}  // namespace
}  // namespace calligraphy_test

int main(int argc, char** argv) {
  try {
    return calligraphy_test::parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "session_soak: %s\n", error.what());
    return 1;
  }
}
