// The node of an emulated device, made pollable.
#pragma once

#include <string>

namespace calligraphy_test {

/// umockdev's nodes are plain files, always ready, on which libusb would spin. This is a FIFO that holds one byte at
/// most in the node's place: with the byte it can be read and not written, without it the other way round.
class PollableNode {
 public:
  /// `path` is the real one, inside the test bed's directory.
  explicit PollableNode(std::string path);
  /// Removes it. A node that vanishes while a program opens it counts as open for ever with umockdev 0.17.16: the node
  /// of a device that was unplugged stays a while, and whoever opens it hears that there is no device.
  ~PollableNode();
  PollableNode(const PollableNode&) = delete;
  PollableNode& operator=(const PollableNode&) = delete;

  /// Called by test bed and test: goes round umockdev's own read() and write(), which take a lock that a thread that
  /// waits for the test bed may hold.
  void set_filled(bool filled) noexcept;

 private:
  const std::string path_;
  int descriptor_;
  bool filled_ = false;
};

}  // namespace calligraphy_test
