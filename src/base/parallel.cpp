#include "parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace calligraphy {
namespace {

/// Hands out indices in ascending order. Every index handed out is processed, so the lowest failing one is always
/// reached.
class Queue {
 public:
  Queue(std::size_t count, const std::function<void(std::size_t)>& work) : count_(count), work_(work) {}

  void run(const std::function<void(double)>& progress) {
    while (!failed_) {
      const std::size_t i = next_++;
      if (i >= count_) return;
      try {
        work_(i);
        const std::size_t done = ++done_;
        if (progress && done < count_) progress(static_cast<double>(done) / static_cast<double>(count_));
      } catch (...) {
        record(i, std::current_exception());
      }
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void record(std::size_t index, std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_ || index < failed_index_) {
      failure_ = std::move(failure);
      failed_index_ = index;
    }
    failed_ = true;
  }

  std::size_t count_;
  const std::function<void(std::size_t)>& work_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<std::size_t> done_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::size_t failed_index_ = 0;
};

/// std::jthread, which libc++ 14 lacks.
class Threads {
 public:
  ~Threads() { join(); }

  /// Returns false if the system has no more threads, or none at all (WebAssembly).
  template <typename Work>
  bool start(const Work& work) {
    try {
      threads_.emplace_back(work);
      return true;
    } catch (const std::system_error&) {
      return false;
    }
  }
  void join() {
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }

 private:
  std::vector<std::thread> threads_;
};

}  // namespace

void parallel_for(std::size_t count, int threads, const std::function<void(double)>& progress,
                  const std::function<void(std::size_t)>& work) {
  Queue queue(count, work);
  const std::size_t wanted =
      threads > 0 ? static_cast<std::size_t>(threads) : std::max<std::size_t>(std::thread::hardware_concurrency(), 1);
  Threads others;
  for (std::size_t i = 1; i < std::min(wanted, count); ++i) {
    if (!others.start([&queue] { queue.run({}); })) break;
  }
  queue.run(progress);
  others.join();
  queue.rethrow();
  if (progress && count > 0) progress(1.0);  // whichever thread processed the last index
}

}  // namespace calligraphy
