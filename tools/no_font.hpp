// What is said where no font has the Chinese of a picture.
#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace calligraphy::tools {

/// "no installed font has the Chinese names: install one, such as ..."
inline std::string no_font_has(std::string_view what) {
  return fmt::format("no installed font has {}: install one, such as the package fonts-noto-cjk or fonts-wqy-microhei",
                     what);
}

}  // namespace calligraphy::tools
