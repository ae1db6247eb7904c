// Finds a device and makes the link that its bus needs.
#pragma once

#include <memory>
#include <string>

#include <calligraphy/devices/phantom/device_list.hpp>

#include "link.hpp"
#include "link_options.hpp"

namespace calligraphy::phantom {

/// Not open yet. @throws DeviceError when libusb cannot start
std::unique_ptr<Link> make_link(const PluggedDevice& device, const LinkOptions& options = {});

/// The device of this serial number, or for an empty one the only device there is. @throws DeviceError when there is no
/// such device or, without a serial number, several (all are listed), or it may not be opened (the udev rule is named)
std::unique_ptr<Link> make_link(const std::string& serial, const LinkOptions& options = {});

}  // namespace calligraphy::phantom
