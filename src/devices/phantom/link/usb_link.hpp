// Link to a serial device over libusb: asynchronous bulk transfers, newest packet first, automatic reconnection.
#pragma once

#include <array>
#include <atomic>
#include <future>
#include <mutex>
#include <thread>

#include "threaded_link.hpp"
#include "usb_device.hpp"
#include "usb_events.hpp"

namespace calligraphy::phantom {

/// Four transfers are always pending, so the host never misses a packet from the device. libusb is called only from the
/// link's own thread (if that thread does not answer in an emergency stop, its descriptor is used directly); its
/// callbacks record what happened, and the thread acts on it between callbacks.
class UsbLink final : public ThreadedLink {
 public:
  /// @throws DeviceError when libusb cannot be initialised
  UsbLink(const PluggedDevice& device, const LinkOptions& options);
  /// Sends a pending packet first, for at most 0.1 s.
  ~UsbLink() override;

  void command(std::span<const std::byte> packet) override;

 private:
  /// A transfer from the device.
  struct Inward {
    UsbLink* link = nullptr;
    libusb_transfer* transfer = nullptr;
    bool pending = false;
    bool kept = false;  ///< its packet is held back until the listener has been notified of a change
    std::array<unsigned char, max_packet_bytes> buffer = {};
  };
  /// The transfer to the device.
  struct Outward {
    libusb_transfer* transfer = nullptr;
    bool pending = false;
    libusb_transfer_status ended = LIBUSB_TRANSFER_COMPLETED;
    const Packet* packet = nullptr;  ///< from next_packet(); null for a command
    std::size_t size = 0;
    double filled = 0.0;   ///< when its packet was taken from the queue [s]
    bool refused = false;  ///< its packet has not been transferred yet
    std::array<unsigned char, max_packet_bytes> buffer = {};
  };
  /// A packet from command() in another thread.
  struct Request {
    Packet packet;
    std::promise<void> done;
  };

  void run(std::promise<void> opened) noexcept override;
  void wake() noexcept override { events_.ring(); }
  void write_directly(std::span<const std::byte> packet) noexcept override;
  void serve() noexcept;
  void connect();
  void disconnect() noexcept;
  void recover() noexcept;
  void clear_halt(unsigned char endpoint) noexcept;
  void send_newest() noexcept;
  void run_request() noexcept;
  void transmit(std::span<const std::byte> packet);
  void flush() noexcept;

  void notify_listener(DeviceFault fault) noexcept;
  void notify_of_state() noexcept;
  void deliver(const Inward& inward) noexcept;
  void submit(Inward& inward) noexcept;
  void submit_outward() noexcept;
  void inward_failed(DeviceFault fault) noexcept;
  void cancel_inward() noexcept;

  bool inward_idle() const noexcept;
  bool outward_idle() const noexcept { return !outward_.pending; }
  void pump_until(bool (UsbLink::*reached)() const noexcept, double seconds) noexcept;
  double max_wait() const noexcept;

  static void LIBUSB_CALL inward_done(libusb_transfer* transfer) noexcept;
  static void LIBUSB_CALL outward_done(libusb_transfer* transfer) noexcept;
  static int LIBUSB_CALL plugged(libusb_context*, libusb_device* device, libusb_hotplug_event event,
                                 void* self) noexcept;

  UsbEvents events_;
  std::thread::id thread_id_ = {};

  UsbDevice device_;
  std::atomic<int> raw_node_{-1};  ///< the device's descriptor, for write_directly(); -1: none
  std::atomic<unsigned> raw_endpoint_{0};
  std::array<Inward, 4> inward_;
  std::array<Inward*, 4> kept_ = {};  ///< in order of arrival
  std::size_t kept_count_ = 0;
  Outward outward_;

  // Recorded by the callbacks, and the state of both directions.
  bool gone_ = false;
  bool holding_ = false;    ///< nothing is resubmitted
  bool notifying_ = false;  ///< the listener is being notified, and may be sending a command
  bool in_stalled_ = false;
  bool out_stalled_ = false;
  bool in_resumed_ = false;  ///< a packet has arrived since the fault
  DeviceFault in_fault_ = DeviceFault::none;
  DeviceFault out_fault_ = DeviceFault::none;
  double retry_in_ = 0.0;  ///< this and the next two by monotonic_seconds()
  double retry_out_ = 0.0;
  double search_again_ = 0.0;

  std::mutex command_mutex_;  ///< allows one command at a time
  std::atomic<Request*> request_{nullptr};
};

}  // namespace calligraphy::phantom
