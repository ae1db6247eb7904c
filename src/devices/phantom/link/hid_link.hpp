// A human interface device over hidapi: one thread reads and tells, one writes; the newest packet wins.
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

/// Packets are reports as they are on the bus: those of a device with several kinds of report begin with the report's
/// number, those of others do not.
///
/// hidapi hides much: it swallows stalls of the device's reports, keeps about 30 of them and drops the oldest, and says
/// of a failure only that it was one. So this link tells `unplugged` when the device cannot be opened again at once,
/// and `link_error` otherwise; what was lost shows in the device's own sequence numbers.
class HidLink final : public Link {
 public:
  /// @throws DeviceError when libusb, by which the device is found, cannot start
  HidLink(const PluggedDevice& device, const LinkOptions& options);
  /// A packet that still waits is sent first.
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

  /// Watches the bus as long as the link lives: to start and end that with every search costs a thread and a socket.
  UsbEvents bus_;
  PluggedDevice wanted_;
  LinkOptions options_;
  LinkListener* listener_ = nullptr;
  std::vector<std::string> warnings_;
  std::thread reader_;
  std::thread writer_;
  std::atomic<bool> writer_stops_{false};
  std::atomic<bool> stopping_{false};

  /// The reader opens and closes the device and reads without this; the writer holds it while it writes.
  std::mutex device_mutex_;
  DeviceLock lock_;  ///< while the device is open: hidraw itself would give it to several programs at once
  hid_device_* device_ = nullptr;
  bool through_hidraw_ = false;            ///< this program's hidapi is the one over hidraw
  bool numbered_ = false;                  ///< reports begin with their number
  std::atomic<bool> write_failed_{false};  ///< nothing more is written until the reader has dealt with it
  NewestPacket newest_;
  WakeUp bell_;
  DeviceFault told_ = DeviceFault::none;
  Clock::time_point told_at_ = {};
  Clock::time_point last_received_ = {};
  Clock::time_point opened_at_ = {};

  std::list<std::string> descriptions_;  ///< of every place it was found at, kept for those who hold one
  std::atomic<const std::string*> description_{nullptr};
  std::atomic<std::uint64_t> received_{0}, sent_{0}, replaced_{0}, failed_{0}, opened_{0};
};

/// The device's node as hidapi names it, which depends on the hidapi that the program links; empty when hidapi does not
/// see it.
std::string hid_path(const PluggedDevice& device);

}  // namespace calligraphy::phantom
