// Decodes the report descriptor of a human interface device, which describes its reports.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace calligraphy::phantom {

/// Whether each report begins with a report number.
bool has_numbered_reports(std::span<const std::byte> descriptor) noexcept;

/// One line per item: its bytes and their meaning, indented by collection.
std::string report_descriptor_text(std::span<const std::byte> descriptor);

}  // namespace calligraphy::phantom
