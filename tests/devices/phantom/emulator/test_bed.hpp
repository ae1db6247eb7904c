// umockdev's test bed: its own /sys, /dev and uevents.
#pragma once

#include <map>
#include <set>
#include <string>

#include <umockdev.h>

namespace calligraphy_test {

/// Whether this program runs under umockdev-wrapper, without which there is no test bed.
bool in_test_bed();

/// Only one at a time per program.
class TestBed {
 public:
  TestBed();
  ~TestBed();
  TestBed(const TestBed&) = delete;
  TestBed& operator=(const TestBed&) = delete;

  /// Handles the requests of programs on a node that is added afterwards.
  void attach(const std::string& node, UMockdevIoctlBase* handler);
  void detach(const std::string& node);

  /// A description of devices in umockdev's format, parents before children. @throws std::runtime_error
  void add(const std::string& description);
  void announce(const std::string& system_path, const char* action);
  void remove(const std::string& system_path);

  /// Real path of a path in the test bed.
  std::string real_path(const std::string& path) const;

  /// The number that the next device on a bus gets: 1 for its root, then 2 to 127 and round again, as the kernel does.
  int next_address(int bus) {
    const int before = addresses_[bus]++;
    return before == 0 ? 1 : 2 + (before - 1) % 126;
  }
  /// True on the first call for a path: bus roots and hubs stay once they exist.
  bool is_new(const std::string& path) { return known_.insert(path).second; }
  int next_hidraw() { return next_hidraw_++; }

 private:
  UMockdevTestbed* bed_;
  std::map<int, int> addresses_;
  std::set<std::string> known_;
  int next_hidraw_ = 0;
};

}  // namespace calligraphy_test
