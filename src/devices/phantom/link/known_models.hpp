// The USB ids of Phantoms and Touches that are public.
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

/// Null when these ids are none of a Phantom.
const KnownModel* known_model(std::uint16_t vendor, std::uint16_t product) noexcept;

}  // namespace calligraphy::phantom
