// Layouts: Universal Serial Bus Specification 2.0, sec. 9.6; the HID descriptor: HID 1.11, sec. 6.2.1.
#include "descriptor_text.hpp"

#include <cstdint>
#include <cstdio>

#include "devices/phantom/wire/hexadecimal.hpp"

namespace calligraphy::phantom {
namespace {

class Fields {
 public:
  explicit Fields(std::span<const std::byte> bytes) : bytes_(bytes) {}
  unsigned byte(std::size_t at) const { return at < bytes_.size() ? std::to_integer<unsigned>(bytes_[at]) : 0u; }
  unsigned word(std::size_t at) const { return byte(at) | byte(at + 1) << 8; }

 private:
  std::span<const std::byte> bytes_;
};

std::string hex(unsigned value, int digits) {
  char text[12];
  std::snprintf(text, sizeof text, "%0*x", digits, value);
  return text;
}

std::string decimal_version(unsigned version) { return hex(version >> 8, 1) + "." + hex(version & 0xffu, 2); }

std::string endpoint(const Fields& at) {
  constexpr const char* types[] = {"control", "isochronous", "bulk", "interrupt"};
  return "endpoint " + std::to_string(at.byte(2) & 0x0fu) +
         ((at.byte(2) & 0x80u) != 0 ? " to the host, " : " to the device, ") + types[at.byte(3) & 3u] +
         ", packets of " + std::to_string(at.word(4) & 0x7ffu) + " bytes, interval " + std::to_string(at.byte(6));
}

std::string words(const Fields& at) {
  switch (at.byte(1)) {
    case 1:
      return "device " + hex(at.word(8), 4) + ":" + hex(at.word(10), 4) + ", USB " + decimal_version(at.word(2)) +
             ", release " + decimal_version(at.word(12)) + ", class " + hex(at.byte(4), 2) + ", " +
             std::to_string(at.byte(17)) + " configuration(s)";
    case 2:
      return "configuration " + std::to_string(at.byte(5)) + ", " + std::to_string(at.byte(4)) + " interface(s), " +
             std::to_string(at.word(2)) + " bytes in total, " + std::to_string(2 * at.byte(8)) + " mA";
    case 4:
      return "interface " + std::to_string(at.byte(2)) + ", setting " + std::to_string(at.byte(3)) + ", class " +
             hex(at.byte(5), 2) + ", subclass " + hex(at.byte(6), 2) + ", protocol " + hex(at.byte(7), 2) + ", " +
             std::to_string(at.byte(4)) + " endpoint(s)";
    case 5:
      return endpoint(at);
    case 0x21:
      return "HID " + decimal_version(at.word(2)) + ", report descriptor of " + std::to_string(at.word(7)) + " bytes";
    case 0x24:
      return "class-specific interface descriptor";
    default:
      return "type " + hex(at.byte(1), 2);
  }
}

}  // namespace

std::string descriptor_text(std::span<const std::byte> descriptors) {
  std::string text;
  while (!descriptors.empty()) {
    const auto length = std::to_integer<std::size_t>(descriptors[0]);
    if (length < 2 || length > descriptors.size()) {
      return text + "truncated: " + hexadecimal(descriptors) + "\n";
    }
    const std::span<const std::byte> descriptor = descriptors.first(length);
    text += words(Fields(descriptor)) + "\n  " + hexadecimal(descriptor) + "\n";
    descriptors = descriptors.subspan(length);
  }
  return text;
}

}  // namespace calligraphy::phantom
