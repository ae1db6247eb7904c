// Structs of the C interface, which carry their size so that they can grow at their end.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>

#include "call.hpp"

namespace calligraphy::c {

/// Size of a struct in the first version of this interface that had it, which every later one accepts. When a struct
/// grows, its first size is stated here: `template <> inline constexpr std::size_t first_size<calligraphy_grip> = 32;`
template <class Struct>
inline constexpr std::size_t first_size = sizeof(Struct);
template <>
inline constexpr std::size_t first_size<calligraphy_device_state> = 112;
template <>
inline constexpr std::size_t first_size<calligraphy_drawn_stroke> = 48;
template <>
inline constexpr std::size_t first_size<calligraphy_remark> = 72;
template <>
inline constexpr std::size_t first_size<calligraphy_renderer_options> =
    offsetof(calligraphy_renderer_options, tolerance_next_decides);

/// No struct of any version is larger: a size above this was never set.
inline constexpr std::size_t max_size = 4096;

/// Refuses a struct's size. Does not allocate.
calligraphy_status refuse_size(const char* name, std::size_t size, std::size_t least) noexcept;

/// Checks that a struct of this size can be read or written. Does not allocate.
template <class Struct>
calligraphy_status check_size(const Struct* to, const char* name) noexcept {
  if (!to) return refuse(CALLIGRAPHY_INVALID_VALUE, "%s is null", name);
  const bool is_size = to->size >= first_size<Struct> && to->size <= max_size;
  return is_size ? CALLIGRAPHY_OK : refuse_size(name, to->size, first_size<Struct>);
}

/// Copies a struct of any size, with zeros for the members that it lacks. Returns the copy.
template <class Struct>
Struct* copy_struct(const Struct* from, Struct* to) noexcept {
  static_assert(std::is_trivially_copyable_v<Struct>);
  *to = {};
  std::memcpy(to, from, std::min<std::size_t>(from->size, sizeof(Struct)));
  return to;
}

/// Checks that a caller's struct sets only members that this version has. Does not allocate.
template <class Struct>
calligraphy_status check_given(const Struct* from, const char* name) noexcept {
  if (const calligraphy_status status = check_size(from, name)) return status;
  if (from->size <= sizeof(Struct)) return CALLIGRAPHY_OK;
  const char* const bytes = reinterpret_cast<const char*>(from);
  const bool is_known = std::all_of(bytes + sizeof(Struct), bytes + from->size, [](char byte) { return byte == 0; });
  return is_known ? CALLIGRAPHY_OK
                  : refuse(CALLIGRAPHY_INVALID_VALUE, "%s: it sets members that version %s does not have", name,
                           calligraphy_version());
}

/// Reads a caller's struct of any size, with zeros for the members that it lacks.
/// @throws Refusal naming the struct if it is null or too small, or sets members that this version does not have
template <class Struct>
Struct read_struct(const Struct* from, const char* name) {
  if (const calligraphy_status status = check_given(from, name)) throw_refused(status);
  Struct result;
  return *copy_struct(from, &result);
}

/// Clears the members that a larger struct has beyond this version's.
template <class Struct>
void clear_rest(Struct* to) noexcept {
  if (to->size == sizeof(Struct)) return;
  std::memset(reinterpret_cast<char*>(to) + sizeof(Struct), 0, to->size - sizeof(Struct));
}

/// Writes a result to a struct that check_size() has accepted: as much as fits, and zero beyond. Its size is unchanged.
template <class Struct>
void put_struct(Struct* to, Struct result) noexcept {
  result.size = to->size;
  if (result.size >= sizeof(Struct)) {
    *to = result;
    clear_rest(to);
  } else {
    std::memcpy(to, &result, result.size);
  }
}

/// As put_struct(), for set-up. @throws Refusal naming the struct if it is null or too small
template <class Struct>
void write_struct(Struct* to, const char* name, const Struct& result) {
  if (const calligraphy_status status = check_size(to, name)) throw_refused(status);
  put_struct(to, result);
}

}  // namespace calligraphy::c
