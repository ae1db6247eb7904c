// parallel_for: every index, errors and progress.
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "../catch.hpp"
#include "base/parallel.hpp"

using namespace calligraphy;

TEST_CASE("every index is processed once, whatever the number of threads", "[practice]") {
  for (const int threads : {0, 1, 2, 7, 100}) {
    std::vector<std::atomic<int>> calls(50);
    parallel_for(calls.size(), threads, {}, [&](std::size_t i) { ++calls[i]; });
    for (const auto& count : calls) CHECK(count == 1);
  }
  parallel_for(0, 4, {}, [](std::size_t) { throw std::logic_error("no work"); });
}

TEST_CASE("of several exceptions the one of the lowest index is thrown", "[practice]") {
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

TEST_CASE("an exception from progress is rethrown and stops every thread", "[practice]") {
  std::atomic<int> calls = 0;
  std::atomic<bool> given_up = false;
  const auto give_up = [&](double) {
    given_up = true;
    throw std::runtime_error("given up");
  };
  const std::thread::id caller = std::this_thread::get_id();
  CHECK_THROWS_WITH(parallel_for(1'000'000, 4, give_up,
                                 [&](std::size_t) {
                                   // No thread gets far before the caller has had its turn.
                                   while (!given_up && std::this_thread::get_id() != caller) std::this_thread::yield();
                                   ++calls;
                                 }),
                    "given up");
  CHECK(calls < 1'000'000);
}

TEST_CASE("progress increases, comes only from the calling thread, and reaches the end with one thread", "[practice]") {
  std::vector<double> shares;
  parallel_for(
      10, 1, [&](double share) { shares.push_back(share); }, [](std::size_t) {});
  REQUIRE(shares.size() == 10);
  for (std::size_t i = 0; i < shares.size(); ++i) CHECK(shares[i] == Approx(static_cast<double>(i + 1) / 10.0));
}
