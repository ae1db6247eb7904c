// nearest_point_fuzz: endless queries and warm ticks, with every result verified by proof.
// Exit codes: 0 no failures, 1 failures, 2 usage.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "query_fuzz.hpp"
#include "tally.hpp"
#include "tick_fuzz.hpp"
#include "tools/options.hpp"
#include "tools/progress.hpp"

namespace calligraphy_test {
namespace {

struct Options {
  std::uint64_t queries = 1'000'000;
  std::uint64_t ticks = 1'000'000;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> block;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  bool json = false;
};

using RunBlock = std::function<void(std::uint64_t block, std::uint64_t limit, Tally& tally)>;

/// One part of the fuzz test and its result.
struct Part {
  const char* name;
  const char* unit;  ///< what is counted
  std::vector<std::string> families;
  std::uint64_t asked;
  std::uint64_t block_size;
  RunBlock run_block;
  std::optional<Tally> tally;
  double seconds = 0.0;
};

/// All blocks of all threads; the sums do not depend on which thread took which block.
void run(Part& part, const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t count = (part.asked + part.block_size - 1) / part.block_size;
  const std::uint64_t first = options.block.value_or(0);
  const std::uint64_t end = options.block ? first + 1 : count;
  std::atomic<std::uint64_t> next = first, done = first;
  std::vector<Tally> tallies(options.threads, Tally(part.families.size()));
  std::vector<std::jthread> workers;
  for (Tally& tally : tallies) {
    workers.emplace_back([&] {
      for (std::uint64_t block = next++; block < end; block = next++, ++done) {
        const std::uint64_t before = block * part.block_size;
        part.run_block(block, options.block ? part.block_size : std::min(part.block_size, part.asked - before), tally);
      }
    });
  }
  {
    calligraphy::tools::Progress progress;
    while (done < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      progress.show(static_cast<double>(done - first) / static_cast<double>(end - first));
    }
  }
  workers.clear();  // joins
  part.tally.emplace(part.families.size());
  for (const Tally& tally : tallies) part.tally->add(tally);
  part.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Empty where nothing was measured.
std::string figure(double value, const char* format) {
  return value > 0.0 ? fmt::format(fmt::runtime(format), value) : "";
}

std::string row(const std::string& name, const Count& count) {
  return fmt::format("{:36} {:>11} {:>7} {:>9} {:>8} {:>8} {:>7} {:>7}  {:>8} {:>9}  {:>6}\n", name, count.answers,
                     count.wrong_branches, count.above_allowance, count.inconsistent, count.uncertified,
                     count.not_finite, count.different, figure(count.worst_error, "{:.1e}"),
                     figure(count.worst_share, "{:.1e}"), figure(count.times.median(), "{:.0f}"));
}

void print(const Part& part) {
  fmt::print("{}: {} {} in {:.0f} s\n", part.name, part.asked, part.unit, part.seconds);
  fmt::print("{:36} {:>11} {:>7} {:>9} {:>8} {:>8} {:>7} {:>7}  {:>8} {:>9}  {:>6}\n", "", "answers", "wrong", "above",
             "incon-", "uncer-", "not", "differ-", "max", "of the", "ns");
  fmt::print("{:36} {:>11} {:>7} {:>9} {:>8} {:>8} {:>7} {:>7}  {:>8} {:>9}  {:>6}\n", "", "", "branch", "tolerance",
             "sistent", "tified", "finite", "ent", "error", "tolerance", "each");
  for (std::size_t i = 0; i < part.families.size(); ++i) fmt::print("{}", row(part.families[i], (*part.tally)[i]));
  fmt::print("{}", row("all", part.tally->total()));
  for (const Failure& failure : part.tally->failures()) fmt::print("block {}: {}\n", failure.block, failure.text);
  fmt::print("\n");
}

nlohmann::ordered_json as_json(const Count& count) {
  nlohmann::ordered_json result = {{"answers", count.answers},
                                   {"wrong_branches", count.wrong_branches},
                                   {"above_allowance", count.above_allowance},
                                   {"inconsistent", count.inconsistent},
                                   {"uncertified", count.uncertified},
                                   {"not_finite", count.not_finite},
                                   {"different", count.different},
                                   {"worst_error", count.worst_error},
                                   {"no_error_above", count.proven_error},
                                   {"worst_share_of_allowance", count.worst_share}};
  if (count.times.median() > 0.0) result["nanoseconds_each"] = count.times.median();
  return result;
}

nlohmann::ordered_json as_json(const Part& part) {
  nlohmann::ordered_json families = nlohmann::ordered_json::object(), failures = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < part.families.size(); ++i) families[part.families[i]] = as_json((*part.tally)[i]);
  for (const Failure& failure : part.tally->failures())
    failures.push_back({{"block", failure.block}, {"case", failure.text}});
  return {{part.unit, part.asked},
          {"seconds", part.seconds},
          {"all", as_json(part.tally->total())},
          {"families", families},
          {"failures", failures}};
}

int run(int argc, char** argv) {
  Options options;
  CLI::App program("Verify nearest points: random queries and warm ticks, with every result verified by proof.",
                   "nearest_point_fuzz");
  using calligraphy::tools::integer;
  constexpr unsigned long long most = 1'000'000'000'000;
  program.add_option("--queries", options.queries, "Number of queries to single curves")
      ->check(integer(0, most))
      ->capture_default_str();
  program.add_option("--ticks", options.ticks, "Number of warm ticks over whole strokes")
      ->check(integer(0, most))
      ->capture_default_str();
  program.add_option("--seed", options.seed, "Seed of the random queries")
      ->check(integer(0, most))
      ->capture_default_str();
  program.add_option("--threads", options.threads, "Number of threads; does not affect the result")
      ->check(integer(1, 1024));
  program.add_option("--block", options.block, "Run only this block, as named by a failure")->check(integer(0, most));
  program.add_flag("--json", options.json, "Print a JSON document");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }

  const QueryFuzz queries;
  const TickFuzz ticks;
  const auto run_queries = [&](std::uint64_t block, std::uint64_t limit, Tally& tally) {
    queries.run(options.seed, block, limit, tally);
  };
  const auto run_ticks = [&](std::uint64_t block, std::uint64_t limit, Tally& tally) {
    ticks.run(options.seed, block, limit, tally);
  };
  Part parts[] = {
      {"single curves", "queries", queries.families(), options.queries, QueryFuzz::block_size, run_queries, {}},
      {"whole strokes", "ticks", ticks.families(), options.ticks, TickFuzz::block_size, run_ticks, {}},
  };
  std::uint64_t failures = 0;
  nlohmann::ordered_json document = {{"seed", options.seed}};
  for (Part& part : parts) {
    if (part.asked == 0) continue;
    run(part, options);
    failures += part.tally->total().failures();
    if (options.json) {
      document[part.name] = as_json(part);
    } else {
      print(part);
    }
  }
  document["failures"] = failures;
  if (options.json) {
    fmt::print("{}\n", document.dump(2));
  } else {
    fmt::print("{} failures\n", failures);
  }
  return failures > 0 ? 1 : 0;
}

}  // namespace
}  // namespace calligraphy_test

int main(int argc, char** argv) {
  try {
    return calligraphy_test::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nearest_point_fuzz: %s\n", error.what());
    return 1;
  }
}
