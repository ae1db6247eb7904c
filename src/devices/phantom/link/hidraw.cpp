// Linux: linux/hidraw.h. The system answers without asking the device.
#include "hidraw.hpp"

#include <linux/hidraw.h>
#include <sys/ioctl.h>

namespace calligraphy::phantom {

bool hidraw_answers(int descriptor, const PluggedDevice& device) noexcept {
  hidraw_devinfo info = {};
  return descriptor >= 0 && ioctl(descriptor, HIDIOCGRAWINFO, &info) >= 0 &&
         static_cast<std::uint16_t>(info.vendor) == device.vendor_id &&
         static_cast<std::uint16_t>(info.product) == device.product_id;
}

}  // namespace calligraphy::phantom
