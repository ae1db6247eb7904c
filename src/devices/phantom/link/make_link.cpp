// A device is selected by its serial number, not by its node, because nodes change whenever it is plugged in.
#include "make_link.hpp"

#include <algorithm>
#include <vector>

#include <calligraphy/base/error.hpp>

#include "hid_link.hpp"
#include "usb_device.hpp"
#include "usb_link.hpp"

namespace calligraphy::phantom {
namespace {

std::string listed(const std::vector<PluggedDevice>& devices) {
  std::string text;
  for (const PluggedDevice& device : devices) text += (text.empty() ? "" : "; ") + describe_device(device);
  return text;
}

PluggedDevice chosen(const std::string& serial) {
  const std::vector<PluggedDevice> devices = plugged_devices();
  if (devices.empty()) {
    throw DeviceError("no Phantom is plugged in" + (serial.empty() ? "" : " (serial " + serial + " was requested)") +
                      ": check the cable and the power, then run \"calligraphy devices\"");
  }
  std::vector<PluggedDevice> matching;
  std::copy_if(devices.begin(), devices.end(), std::back_inserter(matching),
               [&](const PluggedDevice& device) { return serial.empty() || device.serial == serial; });
  if (matching.empty()) {
    throw DeviceError("no Phantom has the serial number " + serial + "; plugged in: " + listed(devices));
  }
  if (matching.size() > 1) {
    throw DeviceError(std::to_string(matching.size()) + " devices" +
                      (serial.empty() ? "; select one by its serial number: " : " have that serial number: ") +
                      listed(matching));
  }
  return matching.front();
}

}  // namespace

std::unique_ptr<Link> make_link(const PluggedDevice& device, const LinkOptions& options) {
  if (device.link == LinkKind::hid) return std::make_unique<HidLink>(device, options);
  return std::make_unique<UsbLink>(device, options);
}

std::unique_ptr<Link> make_link(const std::string& serial, const LinkOptions& options) {
  const PluggedDevice device = chosen(serial);
  if (!device.may_open) refuse(device, device.advice);
  return make_link(device, options);
}

}  // namespace calligraphy::phantom
