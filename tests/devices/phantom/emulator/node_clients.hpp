// Tracks the programs that have a node of a test bed open.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include <umockdev.h>

namespace calligraphy_test {

/// umockdev 0.17.16 reports when one opens a node, but not when it closes it, which must be polled.
class NodeClients {
 public:
  void add(UMockdevIoctlClient* client) {
    forget_closed();
    open_.emplace_back(static_cast<UMockdevIoctlClient*>(g_object_ref(client)));
  }

  int count() {
    forget_closed();
    return static_cast<int>(open_.size());
  }

  bool has(const UMockdevIoctlClient* client) const {
    return std::any_of(open_.begin(), open_.end(), [client](const Client& open) { return open.get() == client; });
  }

 private:
  struct Release {
    void operator()(UMockdevIoctlClient* client) const noexcept { g_object_unref(client); }
  };
  using Client = std::unique_ptr<UMockdevIoctlClient, Release>;

  void forget_closed() {
    std::erase_if(open_,
                  [](const Client& client) { return umockdev_ioctl_client_get_connected(client.get()) == FALSE; });
  }

  std::vector<Client> open_;
};

}  // namespace calligraphy_test
