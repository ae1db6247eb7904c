// Opens a Phantom found on the bus: the only place where device and bus are connected.
#include <calligraphy/devices/phantom/phantom_device.hpp>

#include "devices/phantom/link/link.hpp"
#include "devices/phantom/link/make_link.hpp"

namespace calligraphy {

namespace {

/// Validates the options first, so that their errors are reported even without a device.
std::unique_ptr<phantom::Link> link_for(const PhantomOptions& options) {
  validate(options);
  phantom::LinkOptions link;
  link.priority = options.priority;
  return phantom::make_link(options.serial, link);
}

}  // namespace

PhantomDevice::PhantomDevice(const PhantomOptions& options) : PhantomDevice(link_for(options), options) {}

}  // namespace calligraphy
