// The node /dev/hidrawN of an emulated device.
#pragma once

#include "emulated_device.hpp"
#include "ioctl_memory.hpp"
#include "node_clients.hpp"
#include "pollable_node.hpp"

namespace calligraphy_test {

/// Works like UsbfsNode: in umockdev's thread, under the device's mutex.
class HidrawNode {
 public:
  HidrawNode(EmulatedDevice& device, TestBed& bed, std::string node);
  ~HidrawNode();
  HidrawNode(const HidrawNode&) = delete;
  HidrawNode& operator=(const HidrawNode&) = delete;

  /// Readable while reports are pending, and when the device is gone, which a read reports. Call with the mutex locked.
  void show_state();
  void unplug();
  bool closed() { return clients_.count() == 0; }

 private:
  static gboolean asked(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  static gboolean reads(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  static gboolean writes(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  static void connected(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);

  EmulatedDevice& device_;
  TestBed& bed_;
  const std::string node_;
  UMockdevIoctlBase* handler_;
  PollableNode pollable_;
  NodeClients clients_;
  bool gone_ = false;
};

}  // namespace calligraphy_test
