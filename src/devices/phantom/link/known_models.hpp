// Publicly known USB ids of Phantom and Touch devices.
#pragma once

#include <cstdint>
#include <span>

#include <calligraphy/devices/phantom/device_list.hpp>

namespace calligraphy::phantom {

struct KnownModel {
  std::uint16_t vendor;
  std::uint16_t product;
  LinkKind link;
  const char* name;
};

std::span<const KnownModel> known_models() noexcept;

/// Null if these are not the ids of a Phantom.
const KnownModel* known_model(std::uint16_t vendor, std::uint16_t product) noexcept;

}  // namespace calligraphy::phantom
