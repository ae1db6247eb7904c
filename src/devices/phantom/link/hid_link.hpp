// Link to a human interface device over hidapi: one thread reads and calls the listener, one writes the newest packet.
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

/// Packets are reports as transferred on the bus: they begin with a report number only if the device has several kinds
/// of report.
///
/// hidapi hides details: it ignores stalls of incoming reports, buffers about 30 reports and drops the oldest, and does
/// not give the cause of a failure. This link therefore reports `link_error` if the hidraw node still answers or the
/// device can be reopened immediately, otherwise `unplugged`; lost reports show in the device's own sequence numbers.
class HidLink final : public ThreadedLink {
 public:
  /// @throws DeviceError when libusb, used to find the device, cannot be initialised
  HidLink(const PluggedDevice& device, const LinkOptions& options);
  /// Sends a pending packet first.
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
  void write_directly(std::span<const std::byte> packet) noexcept override;
  bool answers(const std::string& node, double seconds) noexcept;
  void connect();
  void start() noexcept;
  void disconnect() noexcept;

  /// Lives as long as the link: creating it for every search would cost a thread and a socket.
  UsbEvents bus_;
  std::thread writer_;  ///< in addition to the link's own thread, which reads
  std::atomic<bool> writer_stops_{false};

  /// Held by the reader to exchange `device_`, but not to read, and by the writer while it writes.
  std::mutex device_mutex_;
  DeviceLock lock_;  ///< held while the device is open: hidraw itself would let several programs open it
  hid_device_* device_ = nullptr;
  /// A second descriptor of the hidraw node, for write_directly(); -1: not open, or hidapi-libusb, which hides it.
  std::atomic<int> raw_node_{-1};
  bool through_hidraw_ = false;            ///< this program is linked with hidapi-hidraw
  std::atomic<bool> numbered_{false};      ///< reports begin with a report number
  std::atomic<bool> write_failed_{false};  ///< nothing is written until the reader permits it again
  WakeUp bell_;
  double opened_at_ = 0.0;  ///< time of opening, or of resuming after a failed write, by monotonic_seconds()
};

/// The device path as given by hidapi, which depends on the variant that the program links; empty if hidapi does not
/// find the device.
std::string hid_path(const PluggedDevice& device);

}  // namespace calligraphy::phantom
