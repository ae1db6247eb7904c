#include "emulated_device.hpp"

#include <chrono>
#include <cstdio>

#include "hidraw_node.hpp"
#include "usbfs_node.hpp"

namespace calligraphy_test {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t max_waiting = 16;
constexpr std::size_t kept_plugs = 4;
constexpr auto max_wait = 60s;

std::string formatted(const char* format, int first, int second) {
  char text[64];
  std::snprintf(text, sizeof text, format, first, second);
  return text;
}

struct Place {
  std::string path;  ///< of the device under /sys
  std::string name;  ///< 1-2
};

/// The root of the bus, the hubs on the path and the device itself: 1-1.4 is below 1-1.
std::vector<Place> way_to(int bus, const std::string& port) {
  const std::string number = std::to_string(bus);
  std::vector<Place> way{{"/devices/pci0000:00/0000:00:14.0/usb" + number, "usb" + number}};
  for (std::size_t dot = port.find('.');; dot = port.find('.', dot + 1)) {
    const std::string name = number + "-" + port.substr(0, dot);
    way.push_back({way.back().path + "/" + name, name});
    if (dot == std::string::npos) return way;
  }
}

std::string hub_text(const Place& place, int bus, int address) {
  const Octets descriptors{18, 1, 0,  2, 9, 0, 0, 64,   0x6b, 0x1d, 2, 0, 0, 1, 0, 0, 0, 1,  // device, of class 9
                           9,  2, 25, 0, 1, 1, 0, 0xe0, 0,    9,    4, 0, 0, 1, 9, 0, 0, 0, 7, 5, 0x81, 3, 4, 0, 12};
  return "P: " + place.path +
         "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: PRODUCT=1d6b/2/100\nE: BUSNUM=" + formatted("%03d", bus, 0) +
         "\nE: DEVNUM=" + formatted("%03d", address, 0) + "\nA: busnum=" + std::to_string(bus) +
         "\\n\nA: devnum=" + std::to_string(address) +
         "\\n\nA: speed=480\\n\nA: idVendor=1d6b\\n\nA: idProduct=0002\\n\nA: bConfigurationValue=1\\n\nH: "
         "descriptors=" +
         packed_hexadecimal(descriptors) + "\n\n";
}

std::string device_text(const UsbIdentity& identity, const Place& place, int bus, int address,
                        const std::string& port) {
  Octets descriptors = device_descriptor(identity);
  const Octets configuration = configuration_descriptor(identity);
  descriptors.insert(descriptors.end(), configuration.begin(), configuration.end());
  char product[32];
  std::snprintf(product, sizeof product, "%x/%x/100", identity.vendor, identity.product);
  std::string text =
      "P: " + place.path + "\nE: DEVNAME=/dev/bus/usb/" + formatted("%03d/%03d", bus, address) +
      "\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: PRODUCT=" + product + "\nE: BUSNUM=" + formatted("%03d", bus, 0) +
      "\nE: DEVNUM=" + formatted("%03d", address, 0) + "\nE: SUBSYSTEM=usb\nA: busnum=" + std::to_string(bus) +
      "\\n\nA: devnum=" + std::to_string(address) + "\\n\nA: devpath=" + port +
      "\\n\nA: speed=12\\n\nA: idVendor=" + formatted("%04x", identity.vendor, 0) +
      "\\n\nA: idProduct=" + formatted("%04x", identity.product, 0) + "\\n\nA: bConfigurationValue=1\\n\n" +
      "A: manufacturer=calligraphy\\n\nA: product=emulated Phantom\\n\n";
  if (!identity.serial.empty()) text += "A: serial=" + identity.serial + "\\n\n";
  return text + "H: descriptors=" + packed_hexadecimal(descriptors) + "\n\n";
}

std::string interface_text(const UsbIdentity& identity, const Place& place, int interface) {
  const bool serial = identity.link == calligraphy::LinkKind::usb;
  const int code = serial ? (interface == 0 ? 2 : 10) : 3;
  return "P: " + place.path + "/" + place.name + ":1." + std::to_string(interface) +
         "\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\nE: DRIVER=" + (serial ? "cdc_acm" : "usbhid") +
         "\nA: bInterfaceNumber=" + formatted("%02d", interface, 0) +
         "\\n\nA: bInterfaceClass=" + formatted("%02x", code, 0) + "\\n\n\n";
}

}  // namespace

EmulatedDevice::EmulatedDevice(TestBed& bed, UsbIdentity identity) : bed_(bed), identity_(std::move(identity)) {}

EmulatedDevice::~EmulatedDevice() {
  if (plugged()) unplug(UnplugOrder::gone_first);
}

void EmulatedDevice::plug_in(int bus, const std::string& port) {
  retire_closed();
  const std::vector<Place> way = way_to(bus, port);
  const Place& place = way.back();
  for (auto hub = way.begin(); hub + 1 != way.end(); ++hub) {
    if (bed_.is_new(hub->path)) bed_.add(hub_text(*hub, bus, bed_.next_address(bus)));
  }
  const int address = bed_.next_address(bus);
  usb_node_ = "/dev/bus/usb/" + formatted("%03d/%03d", bus, address);
  auto usbfs = std::make_unique<UsbfsNode>(*this, bed_, usb_node_);
  std::string text = device_text(identity_, place, bus, address, port);
  std::vector<std::string> paths{place.path};
  const int interfaces = identity_.link == calligraphy::LinkKind::usb ? 2 : 1;
  for (int i = 0; i < interfaces; ++i) {
    text += interface_text(identity_, place, i);
    paths.push_back(place.path + "/" + place.name + ":1." + std::to_string(i));
  }
  std::unique_ptr<HidrawNode> hidraw;
  if (identity_.link == calligraphy::LinkKind::hid) {
    const int number = bed_.next_hidraw();
    hid_node_ = "/dev/hidraw" + std::to_string(number);
    hidraw = std::make_unique<HidrawNode>(*this, bed_, hid_node_);
    char id[64];
    std::snprintf(id, sizeof id, "0003:%04X:%04X.%04X", identity_.vendor, identity_.product, number + 1);
    char long_id[64];
    std::snprintf(long_id, sizeof long_id, "0003:%08X:%08X", identity_.vendor, identity_.product);
    paths.push_back(paths.back() + "/" + id);
    text += "P: " + paths.back() + "\nE: SUBSYSTEM=hid\nE: DRIVER=hid-generic\nE: HID_ID=" + long_id +
            "\nE: HID_NAME=calligraphy emulated Phantom\nE: HID_PHYS=usb-" + place.name +
            "/input0\nE: HID_UNIQ=" + identity_.serial +
            "\nH: report_descriptor=" + packed_hexadecimal(report_descriptor()) + "\n\n";
    paths.push_back(paths.back() + "/hidraw/hidraw" + std::to_string(number));
    text += "P: " + paths.back() + "\nE: SUBSYSTEM=hidraw\nE: DEVNAME=" + hid_node_ +
            "\nE: MAJOR=240\nE: MINOR=" + std::to_string(number) + "\nL: device=../../../" + id + "\n\n";
  }
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    waiting_.clear();
    in_halted_ = out_halted_ = false;
    host_ = {};
    for (int i = 0; i < interfaces; ++i) host_.with_driver.insert(i);
    usbfs_ = std::move(usbfs);
    hidraw_ = std::move(hidraw);
    system_paths_ = {paths.rbegin(), paths.rend()};
  }
  bed_.add(text);  // this makes umockdev announce it, so everything else must be in place
}

/// A node that a program has open, or is about to, still answers it: that the device is gone.
void EmulatedDevice::retire_closed() {
  const auto retire = [this](auto& retired) {
    const std::lock_guard<std::mutex> alone(mutex_);
    for (std::size_t i = 0; i + kept_plugs < retired.size();) {
      if (retired[i]->closed()) {
        retired.erase(retired.begin() + static_cast<long>(i));
      } else {
        ++i;
      }
    }
  };
  retire(retired_usbfs_);
  retire(retired_hidraw_);
}

void EmulatedDevice::unplug(UnplugOrder order) {
  std::vector<std::string> paths;
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    usbfs_->unplug(order);
    if (hidraw_) hidraw_->unplug();
    waiting_.clear();
    retired_usbfs_.push_back(std::move(usbfs_));
    if (hidraw_) retired_hidraw_.push_back(std::move(hidraw_));
    paths.swap(system_paths_);
  }
  for (const std::string& path : paths) bed_.announce("/sys" + path, "remove");
  for (const std::string& path : paths) bed_.remove("/sys" + path);
}

void EmulatedDevice::let_go() {
  const std::lock_guard<std::mutex> alone(mutex_);
  hidraw_->unplug();
}

void EmulatedDevice::on_packet(std::function<void(std::span<const std::byte>)> listener) {
  const std::lock_guard<std::mutex> alone(mutex_);
  listener_ = std::move(listener);
}

void EmulatedDevice::took(std::span<const std::byte> packet) {
  std::function<void(std::span<const std::byte>)> listener;
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    listener = listener_;
  }
  if (listener) listener(packet);
  const std::lock_guard<std::mutex> alone(mutex_);
  ++taken_;
  happened_.notify_all();
}

void EmulatedDevice::queue(Waiting packet) {
  const std::lock_guard<std::mutex> alone(mutex_);
  if (!usbfs_) return;
  waiting_.push_back(std::move(packet));
  if (waiting_.size() > max_waiting) waiting_.pop_front();
  usbfs_->deliver();
  if (hidraw_) hidraw_->show_state();
}

void EmulatedDevice::push(const Octets& packet) { queue({packet, 0}); }

void EmulatedDevice::fail_next(int error) { queue({{}, error}); }

void EmulatedDevice::set_taking(Taking taking) {
  const std::lock_guard<std::mutex> alone(mutex_);
  taking_ = taking;
  if (usbfs_) usbfs_->take_held();
}

HostActions EmulatedDevice::host() const {
  const std::lock_guard<std::mutex> alone(mutex_);
  return host_;
}

std::uint64_t EmulatedDevice::packets_taken() const {
  const std::lock_guard<std::mutex> alone(mutex_);
  return taken_;
}

bool EmulatedDevice::wait(const std::function<bool(const HostActions&)>& reached) const {
  std::unique_lock<std::mutex> lock(mutex_);
  return happened_.wait_for(lock, max_wait, [&] { return reached(host_); });
}

bool EmulatedDevice::wait_for_packets(std::uint64_t count) const {
  std::unique_lock<std::mutex> lock(mutex_);
  return happened_.wait_for(lock, max_wait, [&] { return taken_ >= count; });
}

std::vector<std::string> EmulatedDevice::node_files() const {
  std::vector<std::string> files{bed_.real_path(usb_node_)};
  if (!hid_node_.empty()) files.push_back(bed_.real_path(hid_node_));
  return files;
}

}  // namespace calligraphy_test
