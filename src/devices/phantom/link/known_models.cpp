// Sources: the drivers page of jhu-saw/sawSensablePhantom; Geomagic_Touch_ROS_Drivers, issues 2, 17 and 18.
#include "known_models.hpp"

#include <algorithm>
#include <array>

namespace calligraphy::phantom {
namespace {

constexpr std::array<KnownModel, 3> models{{
    {0x2988, 0x0302, LinkKind::usb, "Touch (USB serial)"},
    {0x0301, 0x2988, LinkKind::usb, "Touch (USB serial, early unit with swapped ids)"},
    {0x2988, 0x0304, LinkKind::hid, "Touch or Touch X (USB HID)"},
}};

}  // namespace

std::span<const KnownModel> known_models() noexcept { return models; }

const KnownModel* known_model(std::uint16_t vendor, std::uint16_t product) noexcept {
  const auto found = std::find_if(models.begin(), models.end(), [&](const KnownModel& model) {
    return model.vendor == vendor && model.product == product;
  });
  return found == models.end() ? nullptr : &*found;
}

}  // namespace calligraphy::phantom
