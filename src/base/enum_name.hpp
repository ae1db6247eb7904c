// Names of enumerators.
#pragma once

#include <cstddef>

namespace calligraphy {

/// The name of an enumerator from a table in their order, first to `last`; `otherwise` for any other value.
template <auto last, std::size_t count>
const char* name_of(decltype(last) value, const char* const (&names)[count], const char* otherwise) noexcept {
  static_assert(count == static_cast<std::size_t>(last) + 1, "one name for each enumerator");
  const auto index = static_cast<std::size_t>(value);
  return index < count ? names[index] : otherwise;
}

}  // namespace calligraphy
