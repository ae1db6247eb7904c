// std::bit_cast, which Emscripten 3.1.6 lacks.
#pragma once

#include <cstring>
#include <type_traits>

namespace calligraphy {

template <typename To, typename From>
To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
  To to;
  std::memcpy(&to, &from, sizeof to);
  return to;
}

}  // namespace calligraphy
