// Claims about parallel_for.
#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "../catch.hpp"
#include "practice/parallel.hpp"

using namespace calligraphy;

TEST_CASE("every index is worked on once, whatever the number of threads", "[practice]") {
  for (const int threads : {0, 1, 2, 7, 100}) {
    std::vector<std::atomic<int>> calls(50);
    parallel_for(calls.size(), threads, {}, [&](std::size_t i) { ++calls[i]; });
    for (const auto& count : calls) CHECK(count == 1);
  }
  parallel_for(0, 4, {}, [](std::size_t) { throw std::logic_error("no work"); });
}

TEST_CASE("of several failures the one of the lowest index is thrown", "[practice]") {
  for (int round = 0; round < 50; ++round) {
    std::string message;
    try {
      parallel_for(1000, 8, {}, [](std::size_t i) {
        if (i >= 20) throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    REQUIRE(message == "20");
  }
}

TEST_CASE("progress rises, from the calling thread alone, and one thread reports to the end", "[practice]") {
  std::vector<double> shares;
  parallel_for(
      10, 1, [&](double share) { shares.push_back(share); }, [](std::size_t) {});
  REQUIRE(shares.size() == 10);
  for (std::size_t i = 0; i < shares.size(); ++i) CHECK(shares[i] == Approx(static_cast<double>(i + 1) / 10.0));
}
