// Descriptors of a USB device in words.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace calligraphy::phantom {

/// A descriptor a paragraph: its bytes in hexadecimal, then what its fields say. One of a class that is not known here
/// is given by its bytes; a cut or impossible length ends the text, saying so.
std::string descriptor_text(std::span<const std::byte> descriptors);

}  // namespace calligraphy::phantom
