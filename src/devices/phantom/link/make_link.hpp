// Finds a device and creates the link for its bus.
#pragma once

#include <memory>
#include <string>

#include <calligraphy/devices/phantom/device_list.hpp>

#include "link.hpp"

namespace calligraphy::phantom {

/// Returns a link that is not yet open. @throws DeviceError when libusb cannot be initialised
std::unique_ptr<Link> make_link(const PluggedDevice& device, const LinkOptions& options = {});

/// For the device with this serial number, or the only device if it is empty. @throws DeviceError when there is no such
/// device, when there are several without a serial number to select one (all are listed), or when it may not be opened
/// (the udev rule is named)
std::unique_ptr<Link> make_link(const std::string& serial, const LinkOptions& options = {});

}  // namespace calligraphy::phantom
