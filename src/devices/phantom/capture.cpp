// A listener that keeps everything: unlike a servo loop it may take memory while it listens.
#include <calligraphy/devices/phantom/capture.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <iomanip>
#include <mutex>
#include <ostream>

#include <calligraphy/base/error.hpp>

#include "devices/phantom/link/make_link.hpp"
#include "devices/phantom/wire/hexadecimal.hpp"

namespace calligraphy {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds glance(100);

class Recorder final : public phantom::LinkListener {
 public:
  explicit Recorder(std::size_t limit) : limit_(limit) {}

  void received(std::span<const std::byte> bytes) noexcept override {
    const std::lock_guard<std::mutex> alone(mutex_);
    if (transfers_.size() >= limit_) return;
    const double time = std::chrono::duration<double>(Clock::now() - start_).count();
    transfers_.push_back({time, {bytes.begin(), bytes.end()}});
    if (transfers_.size() >= limit_) full_.notify_one();
  }
  void changed(DeviceFault) noexcept override {}

  std::vector<CapturedTransfer> wait(const CaptureOptions& options) {
    const Clock::time_point end =
        start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.seconds));
    std::unique_lock<std::mutex> lock(mutex_);
    while (transfers_.size() < limit_ && Clock::now() < end && !(options.stop && options.stop())) {
      full_.wait_until(lock, std::min(end, Clock::now() + glance));
    }
    return transfers_;
  }

 private:
  const std::size_t limit_;
  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  std::condition_variable full_;
  std::vector<CapturedTransfer> transfers_;
};

}  // namespace

Capture capture(const PluggedDevice& device, const CaptureOptions& options) {
  if (options.transfers == 0) throw ValueError("a capture of 0 transfers: ask for one at least");
  if (!(std::isfinite(options.seconds) && options.seconds > 0.0)) {
    throw ValueError("a capture of " + std::to_string(options.seconds) + " s: must be finite and above 0");
  }
  Recorder recorder(options.transfers);
  const std::unique_ptr<phantom::Link> link = phantom::make_link(device);
  link->open(recorder);
  return {device, recorder.wait(options)};
}

void write_capture(std::ostream& out, const Capture& capture) {
  out << "# calligraphy capture 1\n# " << describe(capture.device) << "\n# " << capture.device.model << "\n# link "
      << link_name(capture.device.link) << "\n# time [s], bytes\n";
  for (const CapturedTransfer& transfer : capture.transfers) {
    out << std::fixed << std::setprecision(6) << transfer.time << ' '
        << (transfer.bytes.empty() ? "-" : phantom::hexadecimal(transfer.bytes)) << '\n';
  }
}

}  // namespace calligraphy
