// Names of alternate stroke orders.
#pragma once

#include <string_view>

namespace calligraphy {

/// A valid name is 1 to 255 bytes of UTF-8 without control characters and '#', and neither begins nor ends with a
/// blank, so that it fits in a line of the text format.
bool is_order_name(std::string_view name) noexcept;

/// @throws ValueError quoting the name if it is invalid
void check_order_name(std::string_view name);

}  // namespace calligraphy
