// A human interface device over hidapi: one thread reads and tells, one writes; the newest packet wins.
#pragma once

#include <atomic>
#include <future>
#include <mutex>
#include <thread>

#include <calligraphy/devices/phantom/device_list.hpp>

#include "device_lock.hpp"
#include "threaded_link.hpp"
#include "usb_events.hpp"
#include "wake_up.hpp"

struct hid_device_;

namespace calligraphy::phantom {

/// Packets are reports as they are on the bus: those of a device with several kinds of report begin with the report's
/// number, those of others do not.
///
/// hidapi hides much: it swallows stalls of the device's reports, keeps about 30 of them and drops the oldest, and says
/// of a failure only that it was one. So this link tells `unplugged` when the device cannot be opened again at once,
/// and `link_error` otherwise; what was lost shows in the device's own sequence numbers.
class HidLink final : public ThreadedLink {
 public:
  /// @throws DeviceError when libusb, by which the device is found, cannot start
  HidLink(const PluggedDevice& device, const LinkOptions& options);
  /// A packet that still waits is sent first.
  ~HidLink() override;

  void open(LinkListener& listener) override;
  void command(std::span<const std::byte> packet) override;

 private:
  void run(std::promise<void> opened) noexcept override;
  void wake() noexcept override { bell_.ring(); }
  void read_reports() noexcept;
  void reopen() noexcept;
  void write_packets() noexcept;
  bool write_report(std::span<const std::byte> packet) noexcept;
  void connect();
  void start() noexcept;
  void disconnect() noexcept;

  /// Watches the bus as long as the link lives: to start and end that with every search costs a thread and a socket.
  UsbEvents bus_;
  std::thread writer_;  ///< beside the link's own thread, which reads
  std::atomic<bool> writer_stops_{false};

  /// The reader opens and closes the device and reads without this; the writer holds it while it writes.
  std::mutex device_mutex_;
  DeviceLock lock_;  ///< while the device is open: hidraw itself would give it to several programs at once
  hid_device_* device_ = nullptr;
  bool through_hidraw_ = false;            ///< this program's hidapi is the one over hidraw
  bool numbered_ = false;                  ///< reports begin with their number
  std::atomic<bool> write_failed_{false};  ///< nothing more is written until the reader has dealt with it
  WakeUp bell_;
  double opened_at_ = 0.0;  ///< by monotonic_seconds()
};

/// The device's node as hidapi names it, which depends on the hidapi that the program links; empty when hidapi does not
/// see it.
std::string hid_path(const PluggedDevice& device);

}  // namespace calligraphy::phantom
