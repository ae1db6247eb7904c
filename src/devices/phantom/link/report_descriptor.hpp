// The report descriptor of a human interface device: what its reports hold.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace calligraphy::phantom {

/// Whether each report begins with its number.
bool has_numbered_reports(std::span<const std::byte> descriptor) noexcept;

/// One line for each item: its bytes and what they mean, indented by collection.
std::string report_descriptor_text(std::span<const std::byte> descriptor);

}  // namespace calligraphy::phantom
