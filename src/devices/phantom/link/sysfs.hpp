// What the system provides about a USB device without opening it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace calligraphy::phantom {

/// Bus and port in the notation of sysfs: "1-2.4".
std::string usb_place(int bus, const std::string& port);

/// Serial number of the device at this bus and port; empty if there is none or it is not provided.
std::string serial_at(const std::string& place);

/// Raw descriptors: that of the device, then those of each configuration; empty if not provided.
std::vector<std::byte> descriptors_at(const std::string& place);

/// Nodes of the device other than the bus node: /dev/hidraw0.
std::vector<std::string> hidraw_nodes_at(const std::string& place);

/// Report descriptor of the first HID interface; empty if the system has not bound a driver to it.
std::vector<std::byte> report_descriptor_at(const std::string& place);

/// Whether this user may read and write the node.
bool may_open(const std::string& node);

}  // namespace calligraphy::phantom
