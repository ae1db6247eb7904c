// A Phantom found on the bus: the one place where device and bus meet.
#include <calligraphy/devices/phantom/phantom_device.hpp>

#include "devices/phantom/link/link.hpp"
#include "devices/phantom/link/make_link.hpp"

namespace calligraphy {

namespace {

/// What is wrong with the options is told whether or not the device is there.
std::unique_ptr<phantom::Link> link_for(const PhantomOptions& options) {
  validate(options);
  phantom::LinkOptions link;
  link.priority = options.priority;
  return phantom::make_link(options.serial, link);
}

}  // namespace

PhantomDevice::PhantomDevice(const PhantomOptions& options) : PhantomDevice(link_for(options), options) {}

}  // namespace calligraphy
