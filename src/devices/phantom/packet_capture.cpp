// A listener that stores every transfer; unlike a servo loop it may allocate while it listens.
#include <calligraphy/devices/phantom/packet_capture.hpp>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <iomanip>
#include <mutex>
#include <ostream>

#include "base/monotonic_clock.hpp"
#include "base/require.hpp"
#include "devices/phantom/link/make_link.hpp"
#include "devices/phantom/wire/hexadecimal.hpp"

namespace calligraphy {
namespace {

constexpr double poll_interval = 0.1;  // [s]

class Recorder final : public phantom::LinkListener {
 public:
  explicit Recorder(std::size_t limit) : limit_(limit) {}

  void received(std::span<const std::byte> bytes) noexcept override {
    const std::lock_guard<std::mutex> alone(mutex_);
    if (transfers_.size() >= limit_) return;
    transfers_.push_back({monotonic_seconds() - start_, {bytes.begin(), bytes.end()}});
    if (transfers_.size() >= limit_) full_.notify_one();
  }
  void changed(DeviceFault) noexcept override {}

  std::vector<CapturedTransfer> wait(const CaptureOptions& options) {
    std::unique_lock<std::mutex> lock(mutex_);
    for (double left = options.seconds; transfers_.size() < limit_ && left > 0.0 && !(options.stop && options.stop());
         left = start_ + options.seconds - monotonic_seconds()) {
      full_.wait_for(lock, std::chrono::duration<double>(std::min(left, poll_interval)));
    }
    return transfers_;
  }

 private:
  const std::size_t limit_;
  const double start_ = monotonic_seconds();
  std::mutex mutex_;
  std::condition_variable full_;
  std::vector<CapturedTransfer> transfers_;
};

}  // namespace

PacketCapture capture_packets(const PluggedDevice& device, const CaptureOptions& options) {
  require(options.transfers > 0, "capture: transfers", 0, "", "at least 1");
  require_above_zero("capture: seconds", options.seconds, "s");
  Recorder recorder(options.transfers);
  const std::unique_ptr<phantom::Link> link = phantom::make_link(device);
  link->open(recorder);
  return {device, recorder.wait(options)};
}

void write_packet_capture(std::ostream& out, const PacketCapture& capture) {
  out << "# calligraphy capture 1\n# " << describe_device(capture.device) << "\n# " << capture.device.model
      << "\n# link " << to_string(capture.device.link) << "\n# time [s], bytes\n";
  for (const CapturedTransfer& transfer : capture.transfers) {
    out << std::fixed << std::setprecision(6) << transfer.time << ' '
        << (transfer.bytes.empty() ? "-" : phantom::hexadecimal(transfer.bytes)) << '\n';
  }
}

}  // namespace calligraphy
