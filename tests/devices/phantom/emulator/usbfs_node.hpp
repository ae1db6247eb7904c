// The node under /dev/bus/usb of an emulated device: answers libusb's requests to the kernel.
#pragma once

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>

#include <deque>
#include <map>

#include "emulated_device.hpp"
#include "ioctl_memory.hpp"
#include "node_clients.hpp"
#include "pollable_node.hpp"

namespace calligraphy_test {

/// Runs in umockdev's own thread, on the queues of its device and under its mutex. It outlives the unplugging
/// until the last program has closed it.
class UsbfsNode {
 public:
  /// The node is there from now on: to be made before its device is added to the test bed.
  UsbfsNode(EmulatedDevice& device, TestBed& bed, std::string node);
  ~UsbfsNode();
  UsbfsNode(const UsbfsNode&) = delete;
  UsbfsNode& operator=(const UsbfsNode&) = delete;

  /// Matches waiting packets with waiting transfers. Call this and the following with the device's mutex locked.
  void deliver();
  void take_held();
  void unplug(UnplugOrder order);
  bool closed() { return clients_.count() == 0; }

 private:
  /// What counts of a usbdevfs_urb, which cannot be a member: it ends in an array without a size.
  struct Request {
    unsigned char type = 0;
    unsigned char endpoint = 0;
    int buffer_length = 0;
  };
  struct Transfer {
    UMockdevIoctlClient* client = nullptr;
    IoctlMemory urb, buffer;
    std::uint64_t address = 0;  ///< in the program
    Request request;
    int status = 0;
    Octets answer;
    int length = 0;  ///< transferred
  };
  struct Reply {
    long result = 0;
    int error = 0;
  };

  static gboolean asked(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  static void connected(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);

  Reply answer(UMockdevIoctlClient* client);
  Reply submit(UMockdevIoctlClient* client);
  Reply reap(UMockdevIoctlClient* client);
  Reply discard(UMockdevIoctlClient* client);
  Reply claim(UMockdevIoctlClient* client, int interface, bool take_from_driver);
  Reply release(UMockdevIoctlClient* client, int interface);
  Reply drive(const usbdevfs_ioctl& request);
  Reply transfer(UMockdevIoctlData* data);
  void control(Transfer& transfer);
  bool device_request(Transfer& transfer, const Octets& setup);
  bool takes(Transfer& transfer);
  void finish(Transfer&& transfer, int status);
  void show_state();
  void note_interfaces();
  void forget_closed();

  EmulatedDevice& device_;
  TestBed& bed_;
  const std::string node_;
  UMockdevIoctlBase* handler_;
  PollableNode pollable_;
  std::deque<Transfer> flying_, done_;
  std::map<int, UMockdevIoctlClient*> claimed_;
  std::set<int> with_driver_;
  NodeClients clients_;
  bool gone_ = false;
  std::vector<Octets> taken_;  ///< packets to report once the mutex is unlocked
};

}  // namespace calligraphy_test
