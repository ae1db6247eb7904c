// Link to a human interface device over hidapi: one thread reads and calls the listener, one writes the newest packet.
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <list>
#include <mutex>
#include <thread>

#include <calligraphy/devices/phantom/device_list.hpp>

#include "device_lock.hpp"
#include "link.hpp"
#include "link_options.hpp"
#include "newest_packet.hpp"
#include "usb_events.hpp"
#include "wake_up.hpp"

struct hid_device_;

namespace calligraphy::phantom {

/// Packets are reports as transferred on the bus: they begin with a report number only if the device has several kinds
/// of report.
///
/// hidapi hides details: it ignores stalls of incoming reports, buffers about 30 reports and drops the oldest, and does
/// not give the cause of a failure. This link therefore reports `unplugged` if the device cannot be reopened
/// immediately, otherwise `link_error`; lost reports show in the device's own sequence numbers.
class HidLink final : public Link {
 public:
  /// @throws DeviceError when libusb, used to find the device, cannot be initialised
  HidLink(const PluggedDevice& device, const LinkOptions& options);
  /// Sends a pending packet first.
  ~HidLink() override;

  void open(LinkListener& listener) override;
  bool send(std::span<const std::byte> packet) noexcept override;
  void command(std::span<const std::byte> packet) override;
  LinkCounts counts() const noexcept override;
  const std::vector<std::string>& warnings() const noexcept override { return warnings_; }
  const std::string& description() const noexcept override { return *description_.load(); }
  const std::string& serial() const noexcept override { return wanted_.serial; }

 private:
  using Clock = std::chrono::steady_clock;

  void read_and_tell(std::promise<void> opened) noexcept;
  void read_reports() noexcept;
  void reopen() noexcept;
  void write_packets() noexcept;
  bool write_report(std::span<const std::byte> packet) noexcept;
  void connect();
  void start() noexcept;
  void disconnect() noexcept;
  void tell(DeviceFault fault) noexcept;

  /// Lives as long as the link: creating it for every search would cost a thread and a socket.
  UsbEvents bus_;
  PluggedDevice wanted_;
  LinkOptions options_;
  LinkListener* listener_ = nullptr;
  std::vector<std::string> warnings_;
  std::thread reader_;
  std::thread writer_;
  std::atomic<bool> writer_stops_{false};
  std::atomic<bool> stopping_{false};

  /// The reader holds it to exchange `device_`, not to read; the writer holds it while it writes.
  std::mutex device_mutex_;
  DeviceLock lock_;  ///< held while the device is open: hidraw itself would let several programs open it
  hid_device_* device_ = nullptr;
  bool through_hidraw_ = false;            ///< this program is linked to hidapi-hidraw
  bool numbered_ = false;                  ///< reports begin with a report number
  std::atomic<bool> write_failed_{false};  ///< nothing more is written until the reader has reopened the device
  NewestPacket newest_;
  WakeUp bell_;
  DeviceFault told_ = DeviceFault::none;
  Clock::time_point told_at_ = {};
  Clock::time_point last_received_ = {};
  Clock::time_point opened_at_ = {};

  std::list<std::string> descriptions_;  ///< one per port at which it was found, kept for holders of references
  std::atomic<const std::string*> description_{nullptr};
  std::atomic<std::uint64_t> received_{0}, sent_{0}, replaced_{0}, failed_{0}, opened_{0};
};

/// The device path as given by hidapi, which depends on the variant that the program links; empty if hidapi does not
/// find the device.
std::string hid_path(const PluggedDevice& device);

}  // namespace calligraphy::phantom
