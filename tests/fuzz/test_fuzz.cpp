// A short run of nearest_point_fuzz, whose long run is: nearest_point_fuzz --queries 50000000 --ticks 50000000
#include "catch.hpp"
#include "query_fuzz.hpp"
#include "tick_fuzz.hpp"

using namespace calligraphy_test;

namespace {

template <typename Fuzz>
void check_fuzz(std::uint64_t count) {
  const Fuzz fuzz;
  Tally tally(fuzz.families().size());
  for (std::uint64_t block = 0; block * Fuzz::block_size < count; ++block) fuzz.run(1, block, Fuzz::block_size, tally);
  for (const Failure& failure : tally.failures()) FAIL_CHECK("block " << failure.block << ": " << failure.text);
  CHECK(tally.total().failures() == 0);
  CHECK(tally.total().answers >= count);
}

}  // namespace

TEST_CASE("the nearest point is correct for 300000 hostile queries", "[fuzz]") { check_fuzz<QueryFuzz>(300'000); }

TEST_CASE("the nearest point is correct for 300000 warm ticks", "[fuzz]") { check_fuzz<TickFuzz>(300'000); }
