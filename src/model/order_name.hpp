// Names of alternate stroke orders.
#pragma once

#include <string_view>

namespace calligraphy {

/// A name is 1 to 255 bytes of UTF-8 without control characters and '#', and neither begins nor ends with a blank: so
/// it fits in a line of the text format. @throws ValueError that quotes it
void check_order_name(std::string_view name);

}  // namespace calligraphy
