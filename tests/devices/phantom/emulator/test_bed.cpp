#include "test_bed.hpp"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace calligraphy_test {
namespace {

constexpr auto everybody = static_cast<std::filesystem::perms>(0777);

void require(bool done, GError* error, const std::string& what) {
  if (done && error == nullptr) return;
  const std::string reason = error == nullptr ? "refused" : error->message;
  g_clear_error(&error);
  throw std::runtime_error("umockdev: " + what + ": " + reason);
}

}  // namespace

bool in_test_bed() {
  const char* const preloaded = std::getenv("LD_PRELOAD");
  return preloaded != nullptr && std::strstr(preloaded, "libumockdev-preload") != nullptr;
}

TestBed::TestBed() : bed_(umockdev_testbed_new()) {
  // Its directory is for its maker alone; the tests use it as another user too, who binds
  // sockets for uevents there.
  std::filesystem::permissions(real_path(""), everybody);
}

TestBed::~TestBed() { g_object_unref(bed_); }

void TestBed::attach(const std::string& node, UMockdevIoctlBase* handler) {
  GError* error = nullptr;
  const bool done = umockdev_testbed_attach_ioctl(bed_, node.c_str(), handler, &error);
  require(done, error, "attach to " + node);
  // umockdev connects even when the node could not be opened, and ends the program where it may not.
  std::filesystem::permissions(real_path("/ioctl" + node), everybody);
}

void TestBed::detach(const std::string& node) {
  GError* error = nullptr;
  umockdev_testbed_detach_ioctl(bed_, node.c_str(), &error);
  g_clear_error(&error);
}

void TestBed::add(const std::string& description) {
  GError* error = nullptr;
  const bool done = umockdev_testbed_add_from_string(bed_, description.c_str(), &error);
  require(done, error, "add " + description);
}

void TestBed::announce(const std::string& system_path, const char* action) {
  umockdev_testbed_uevent(bed_, system_path.c_str(), action);
}

void TestBed::remove(const std::string& system_path) { umockdev_testbed_remove_device(bed_, system_path.c_str()); }

std::string TestBed::real_path(const std::string& path) const {
  gchar* root = umockdev_testbed_get_root_dir(bed_);
  std::string real = root + path;
  g_free(root);
  return real;
}

}  // namespace calligraphy_test
