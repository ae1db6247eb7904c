// A serial device over libusb: asynchronous bulk transfers, the newest packet wins, and it comes back when replugged.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <list>
#include <mutex>
#include <thread>

#include "link.hpp"
#include "link_options.hpp"
#include "newest_packet.hpp"
#include "usb_device.hpp"
#include "usb_events.hpp"

namespace calligraphy::phantom {

/// Four transfers wait for the device at any time, so that none of its packets finds the host busy. All of libusb is
/// called from the link's own thread, its callbacks note what happened, and the thread acts on it between callbacks.
class UsbLink final : public Link {
 public:
  /// @throws DeviceError when libusb cannot start
  UsbLink(const PluggedDevice& device, const LinkOptions& options);
  /// A packet that still waits is sent first, for at most a tenth of a second.
  ~UsbLink() override;

  void open(LinkListener& listener) override;
  bool send(std::span<const std::byte> packet) noexcept override;
  void command(std::span<const std::byte> packet) override;
  LinkCounts counts() const noexcept override;
  const std::vector<std::string>& warnings() const noexcept override { return warnings_; }
  const std::string& description() const noexcept override { return *description_.load(); }
  const std::string& serial() const noexcept override { return wanted_.serial; }

 private:
  using Clock = std::chrono::steady_clock;

  /// A transfer from the device.
  struct Inward {
    UsbLink* link = nullptr;
    libusb_transfer* transfer = nullptr;
    bool flying = false;
    bool kept = false;  ///< its packet waits until the listener has heard of a change
    std::array<unsigned char, longest_packet> buffer = {};
  };
  /// The transfer to the device.
  struct Outward {
    libusb_transfer* transfer = nullptr;
    bool flying = false;
    libusb_transfer_status ended = LIBUSB_TRANSFER_COMPLETED;
    std::size_t size = 0;
    Clock::time_point filled = {};  ///< when its packet was taken
    bool refused = false;           ///< its packet has not gone through yet
    std::array<unsigned char, longest_packet> buffer = {};
  };
  /// A packet of command() from another thread.
  struct Request {
    Packet packet;
    std::promise<void> done;
  };

  void run(std::promise<void> opened) noexcept;
  void serve() noexcept;
  void connect();
  void disconnect() noexcept;
  void recover() noexcept;
  void clear_halt(unsigned char endpoint) noexcept;
  void send_newest() noexcept;
  void run_request() noexcept;
  void transmit(std::span<const std::byte> packet);
  void flush() noexcept;

  void tell(DeviceFault fault) noexcept;
  void tell_where_it_stands() noexcept;
  void hand_on(const Inward& inward) noexcept;
  void submit(Inward& inward) noexcept;
  void submit_outward() noexcept;
  void inward_failed(DeviceFault fault) noexcept;
  void cancel_inward() noexcept;

  bool inward_idle() const noexcept;
  bool outward_idle() const noexcept { return !outward_.flying; }
  void pump_until(bool (UsbLink::*reached)() const noexcept, double seconds) noexcept;
  double longest_wait() const noexcept;

  static void LIBUSB_CALL inward_done(libusb_transfer* transfer) noexcept;
  static void LIBUSB_CALL outward_done(libusb_transfer* transfer) noexcept;
  static int LIBUSB_CALL plugged(libusb_context*, libusb_device* device, libusb_hotplug_event event,
                                 void* self) noexcept;

  PluggedDevice wanted_;
  LinkOptions options_;
  UsbEvents events_;
  LinkListener* listener_ = nullptr;
  std::vector<std::string> warnings_;
  std::thread thread_;
  std::thread::id thread_id_ = {};
  std::atomic<bool> stopping_{false};

  UsbDevice device_;
  std::array<Inward, 4> inward_;
  std::array<Inward*, 4> kept_ = {};  ///< in the order that they came
  std::size_t kept_count_ = 0;
  Outward outward_;
  NewestPacket newest_;

  // What the callbacks noted, and how the two directions stand.
  bool gone_ = false;
  bool holding_ = false;  ///< nothing is submitted again
  bool telling_ = false;  ///< the listener hears of a change, perhaps sending a command
  bool in_stalled_ = false;
  bool out_stalled_ = false;
  bool in_flows_ = false;  ///< a packet came since the fault
  DeviceFault in_fault_ = DeviceFault::none;
  DeviceFault out_fault_ = DeviceFault::none;
  DeviceFault told_ = DeviceFault::none;
  Clock::time_point told_at_ = {};
  Clock::time_point last_received_ = {};
  Clock::time_point retry_in_ = {};
  Clock::time_point retry_out_ = {};
  Clock::time_point look_again_ = {};

  std::mutex command_mutex_;  ///< one command at a time
  std::atomic<Request*> request_{nullptr};

  std::list<std::string> descriptions_;  ///< of every place it was found at, kept for those who hold one
  std::atomic<const std::string*> description_{nullptr};
  std::atomic<std::uint64_t> received_{0}, sent_{0}, replaced_{0}, failed_{0}, opened_{0};
};

}  // namespace calligraphy::phantom
