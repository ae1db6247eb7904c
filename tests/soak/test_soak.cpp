#include "soak.hpp"

#include "catch.hpp"

using namespace calligraphy_test;

namespace {

void check_soak(const char* composition) {
  SoakOptions options;
  options.ticks = 2'000'000;
  options.composition = composition;
  for (const Guarantee& guarantee : guarantees(options, soak(options))) {
    CAPTURE(guarantee.text);
    CHECK(guarantee.kept);
  }
}

}  // namespace

// A longer run: session_soak --ticks 86400000
TEST_CASE("2000000 ticks with faults violate no guarantee, composition default", "[soak]") { check_soak("default"); }

TEST_CASE("2000000 ticks with faults violate no guarantee, composition everything", "[soak]") {
  check_soak("everything");
}
