// Linux: files under /sys/bus/usb/devices, which are readable by all users.
#include "sysfs.hpp"

#include <dirent.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>

namespace calligraphy::phantom {
namespace {

const std::string root = "/sys/bus/usb/devices/";

std::vector<std::string> entries(const std::string& directory) {
  const std::unique_ptr<DIR, int (*)(DIR*)> open(opendir(directory.c_str()), closedir);
  std::vector<std::string> names;
  if (!open) return names;
  while (const dirent* entry = readdir(open.get())) {
    if (entry->d_name[0] != '.') names.emplace_back(entry->d_name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::byte> bytes_of(const std::string& text) {
  std::vector<std::byte> bytes(text.size());
  std::transform(text.begin(), text.end(), bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
  return bytes;
}

/// Directories of HID devices: 1-2/1-2:1.0/0003:2988:0304.0001.
std::vector<std::string> hid_directories(const std::string& place) {
  std::vector<std::string> found;
  for (const std::string& interface : entries(root + place)) {
    if (interface.rfind(place + ":", 0) != 0) continue;
    for (const std::string& entry : entries(root + place + "/" + interface)) {
      if (std::count(entry.begin(), entry.end(), ':') == 2)
        found.push_back(root + place + "/" + interface + "/" + entry);
    }
  }
  return found;
}

}  // namespace

std::string usb_place(int bus, const std::string& port) { return std::to_string(bus) + "-" + port; }

std::string serial_at(const std::string& place) {
  std::string serial = content(root + place + "/serial");
  while (!serial.empty() && (serial.back() == '\n' || serial.back() == ' ')) serial.pop_back();
  return serial;
}

std::vector<std::byte> descriptors_at(const std::string& place) {
  return bytes_of(content(root + place + "/descriptors"));
}

std::vector<std::string> hidraw_nodes_at(const std::string& place) {
  std::vector<std::string> nodes;
  for (const std::string& directory : hid_directories(place)) {
    for (const std::string& name : entries(directory + "/hidraw")) nodes.push_back("/dev/" + name);
  }
  return nodes;
}

std::vector<std::byte> report_descriptor_at(const std::string& place) {
  for (const std::string& directory : hid_directories(place)) {
    const std::string descriptor = content(directory + "/report_descriptor");
    if (!descriptor.empty()) return bytes_of(descriptor);
  }
  return {};
}

bool may_open(const std::string& node) { return access(node.c_str(), R_OK | W_OK) == 0; }

}  // namespace calligraphy::phantom
