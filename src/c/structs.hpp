// Structs of the C interface, which carry their size so that they can grow at their end.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>

#include "call.hpp"

namespace calligraphy::c {

/// Refuses a struct that is smaller than in the first version of this interface. Does not allocate.
calligraphy_status refuse_size(const char* name, std::size_t size, std::size_t least) noexcept;

/// What a caller's struct says, whatever its size. What is beyond the caller's size is as in `rest`.
/// @throws Refusal naming the struct if it is null or too small, or says what this version does not know
template <class Struct>
Struct read_struct(const Struct* from, const char* name, const Struct& rest = {}) {
  static_assert(std::is_trivially_copyable_v<Struct>);
  const std::size_t size = target(from, name).size;
  if (size < sizeof(Struct)) throw_refused(refuse_size(name, size, sizeof(Struct)));
  const char* const bytes = reinterpret_cast<const char*>(from);
  if (std::any_of(bytes + sizeof(Struct), bytes + size, [](char byte) { return byte != 0; })) {
    throw Refusal(CALLIGRAPHY_INVALID_VALUE,
                  std::string(name) + ": it sets members that version " + calligraphy_version() + " does not have");
  }
  Struct result = rest;
  std::memcpy(&result, from, sizeof(Struct));
  return result;
}

/// Whether a result of this size fits; in the words of the error. Does not allocate.
template <class Struct>
calligraphy_status check_result(const Struct* to, const char* name) noexcept {
  if (!to) return refuse(CALLIGRAPHY_INVALID_VALUE, "%s is null", name);
  return to->size < sizeof(Struct) ? refuse_size(name, to->size, sizeof(Struct)) : CALLIGRAPHY_OK;
}

/// Clears what a larger struct has beyond this version's.
template <class Struct>
void clear_rest(Struct* to) noexcept {
  if (to->size > sizeof(Struct))
    std::memset(reinterpret_cast<char*>(to) + sizeof(Struct), 0, to->size - sizeof(Struct));
}

/// Writes a result; its size stays the caller's. @throws Refusal naming the struct if it is null or too small
template <class Struct>
void write_struct(Struct* to, const char* name, Struct result) {
  if (const calligraphy_status status = check_result(to, name)) throw_refused(status);
  result.size = to->size;
  *to = result;
  clear_rest(to);
}

}  // namespace calligraphy::c
