// What the system tells of a USB device that nobody has opened.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace calligraphy::phantom {

/// "1-2.4": bus and port as the system writes them.
std::string usb_place(int bus, const std::string& port);

/// The serial number of the device at a place; empty when there is none or it is not told.
std::string serial_at(const std::string& place);

/// Descriptors as they came over the bus: the device's, then those of each configuration; empty when not told.
std::vector<std::byte> descriptors_at(const std::string& place);

/// Nodes of the device beyond the one of the bus: /dev/hidraw0.
std::vector<std::string> hidraw_nodes_at(const std::string& place);

/// The report descriptor of the first HID interface; empty when the system has not bound it.
std::vector<std::byte> report_descriptor_at(const std::string& place);

/// Whether this user may read and write a node.
bool may_open(const std::string& node);

}  // namespace calligraphy::phantom
