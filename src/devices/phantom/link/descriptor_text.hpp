// Decodes the descriptors of a USB device into text.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace calligraphy::phantom {

/// One paragraph per descriptor: its decoded fields, then its bytes in hexadecimal. A descriptor of an unknown class is
/// shown as bytes only; a truncated one or an impossible length ends the text with a note.
std::string descriptor_text(std::span<const std::byte> descriptors);

}  // namespace calligraphy::phantom
