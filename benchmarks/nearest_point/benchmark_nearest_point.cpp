// Times the nearest point by every method of this library and by its peers in one run, alternating in every round.
// benchmarks/nearest_point/run.sh fetches the peers and runs it.
#include <cstdio>

#include <benchmark/benchmark.h>
#include <CLI/CLI.hpp>

#include <calligraphy/base/error.hpp>

#include "table.hpp"

using namespace nearest_point_benchmark;

namespace {

/// One short line per run; the tables contain the counters.
class BriefReporter : public benchmark::ConsoleReporter {
 public:
  BriefReporter() : ConsoleReporter(OO_None) {}
  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> brief = runs;
    for (Run& run : brief) run.counters.clear();
    ConsoleReporter::ReportRuns(brief);
  }
};

void say_who_is_missing(const RunOptions& options) {
  if (kurbo_methods().empty())
    std::puts("omitted: kurbo (needs a cargo that can build it, and CALLIGRAPHY_BENCHMARK_PEERS=ON)");
  if (lib2geom_methods().empty())
    std::puts("omitted: lib2geom (needs lib2geom-dev, and CALLIGRAPHY_BENCHMARK_PEERS=ON)");
  if (options.bezier_js.empty()) std::puts("omitted: bezier.js (needs node, and --bezier_js with its package)");
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  CLI::App app("Times methods for the nearest point on a curve; --help for Google Benchmark's own options");
  RunOptions options;
  bool details = false;
  app.add_option("--queries", options.queries, "Queries per workload")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--rounds", options.rounds, "Rounds; each times every method once")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--characters", options.characters, "Characters whose strokes are written whole; 0: all")
      ->capture_default_str();
  app.add_option("--elements", options.swept_elements, "Elements of the cold-cache runs")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--bezier_js", options.bezier_js, "Directory of the unpacked npm package bezier-js")
      ->check(CLI::ExistingDirectory);
  app.add_flag("--details", details, "Print every workload separately");
  CLI11_PARSE(app, argc, argv);

  auto methods = workload_methods();
  std::vector<Measurement> workloads, strokes, swept;
  std::vector<CallTimes> calls;
  std::vector<ElementCost> elements;
  register_workloads(methods, options, workloads);
  register_strokes(options, strokes);
  register_calls(methods, options, calls);
  register_swept(methods, options, swept);
  register_elements(options, elements);
  try {
    BriefReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
  } catch (const calligraphy::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  if (!workloads.empty()) print_workloads(stdout, workloads);
  if (details) print_details(stdout, workloads);
  if (!strokes.empty()) print_strokes(stdout, strokes);
  if (!calls.empty()) print_calls(stdout, calls);
  if (!swept.empty()) print_swept(stdout, swept);
  if (!elements.empty()) print_elements(stdout, elements);
  say_who_is_missing(options);
  return 0;
}
