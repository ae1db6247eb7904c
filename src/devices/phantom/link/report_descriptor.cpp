// Items: Device Class Definition for HID 1.11, sec. 6.2.2.
#include "report_descriptor.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "devices/phantom/wire/hexadecimal.hpp"

namespace calligraphy::phantom {
namespace {

struct Item {
  std::span<const std::byte> bytes;
  std::uint8_t tag = 0;  ///< tag and type, the size bits cleared
  std::uint32_t value = 0;
  std::int32_t signed_value = 0;
};

constexpr std::uint8_t long_item = 0xfe;
constexpr std::uint8_t report_number = 0x84;
constexpr std::uint8_t collection = 0xa0;
constexpr std::uint8_t end_collection = 0xc0;

/// Size of the first item of a descriptor that is not empty; it may be truncated.
std::size_t item_size(std::span<const std::byte> descriptor) noexcept {
  const auto prefix = std::to_integer<std::uint8_t>(descriptor[0]);
  if (prefix == long_item && descriptor.size() > 1) return 3 + std::to_integer<std::size_t>(descriptor[1]);
  return 1 + (prefix & 3u) + ((prefix & 3u) == 3u ? 1 : 0);
}

/// A truncated item ends the list.
std::vector<Item> items_of(std::span<const std::byte> descriptor) {
  std::vector<Item> items;
  while (!descriptor.empty()) {
    const auto prefix = std::to_integer<std::uint8_t>(descriptor[0]);
    const std::size_t size = item_size(descriptor);
    if (size > descriptor.size()) break;
    Item item;
    item.bytes = descriptor.first(size);
    item.tag = static_cast<std::uint8_t>(prefix & 0xfcu);
    if (prefix != long_item) {
      for (std::size_t i = 1; i < size; ++i) {
        item.value |= std::to_integer<std::uint32_t>(item.bytes[i]) << (8 * (i - 1));
      }
      const unsigned unused = static_cast<unsigned>(8 * (5 - size));
      item.signed_value = size == 1 ? 0 : static_cast<std::int32_t>(item.value << unused) >> unused;
    }
    items.push_back(item);
    descriptor = descriptor.subspan(size);
  }
  return items;
}

struct ItemName {
  std::uint8_t tag;
  const char* name;
  bool is_signed = false;
};

constexpr std::array<ItemName, 22> item_names{{
    {0x80, "input"},
    {0x90, "output"},
    {0xb0, "feature"},
    {collection, "collection"},
    {0xc0, "end collection"},
    {0x04, "usage page"},
    {0x14, "logical minimum", true},
    {0x24, "logical maximum", true},
    {0x34, "physical minimum", true},
    {0x44, "physical maximum", true},
    {0x54, "unit exponent"},
    {0x64, "unit"},
    {0x74, "report size"},
    {report_number, "report number"},
    {0x94, "report count"},
    {0xa4, "push"},
    {0xb4, "pop"},
    {0x08, "usage"},
    {0x18, "usage minimum"},
    {0x28, "usage maximum"},
    {0x38, "designator index"},
    {0x78, "string index"},
}};

/// Flags of an input, output or feature item.
std::string kind(std::uint32_t bits) {
  std::string text = (bits & 1u) != 0 ? "constant" : "data";
  text += (bits & 2u) != 0 ? ", variable" : ", array";
  text += (bits & 4u) != 0 ? ", relative" : ", absolute";
  return text;
}

std::string words(const Item& item) {
  for (const ItemName& name : item_names) {
    if (name.tag != item.tag) continue;
    if (item.tag == 0x80 || item.tag == 0x90 || item.tag == 0xb0) return name.name + (" (" + kind(item.value) + ")");
    if (item.bytes.size() == 1) return name.name;
    const auto value = name.is_signed ? std::int64_t{item.signed_value} : std::int64_t{item.value};
    return name.name + (" " + std::to_string(value));
  }
  return "unknown item";
}

}  // namespace

bool has_numbered_reports(std::span<const std::byte> descriptor) noexcept {
  while (!descriptor.empty()) {
    const auto prefix = std::to_integer<std::uint8_t>(descriptor[0]);
    if ((prefix & 0xfcu) == report_number) return true;
    const std::size_t size = item_size(descriptor);
    if (size > descriptor.size()) break;
    descriptor = descriptor.subspan(size);
  }
  return false;
}

std::string report_descriptor_text(std::span<const std::byte> descriptor) {
  std::string text;
  std::size_t depth = 0;
  for (const Item& item : items_of(descriptor)) {
    if (item.tag == end_collection && depth > 0) --depth;
    std::string bytes = hexadecimal(item.bytes);
    bytes.resize(std::max<std::size_t>(bytes.size(), 16), ' ');
    text += "  " + bytes + std::string(2 * depth, ' ') + words(item) + "\n";
    if (item.tag == collection) ++depth;
  }
  return text;
}

}  // namespace calligraphy::phantom
