// How functions of the C interface report errors.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/c/calligraphy.h>
#include <calligraphy/base/error.hpp>

#include "handles.hpp"

namespace calligraphy::c {

/// Error of a function during set-up, with its status.
class Refusal : public Error {
 public:
  Refusal(calligraphy_status status, const std::string& text) : Error(text), status_(status) {}
  calligraphy_status status() const noexcept { return status_; }

 private:
  calligraphy_status status_;
};

/// Sets the text of the last error, printf style, and returns the status. Does not allocate.
[[gnu::format(printf, 2, 3)]] calligraphy_status refuse(calligraphy_status status, const char* format, ...) noexcept;

/// The status of the exception that is being handled, and its text as the last error.
calligraphy_status refuse_exception() noexcept;

/// Calls a function that may throw. Returns its status.
template <class Function>
calligraphy_status guarded(Function&& function) noexcept {
  try {
    function();
    return CALLIGRAPHY_OK;
  } catch (...) {
    return refuse_exception();
  }
}

/// Refuses a handle that is not of this kind. Does not allocate.
calligraphy_status refuse_handle(Kind kind, const void* handle) noexcept;

/// @throws Refusal with this status and the last error
[[noreturn]] void throw_refused(calligraphy_status status);
/// @throws Refusal
[[noreturn]] void throw_null(const char* name);

/// The object of a handle. @throws Refusal if there is none
template <class Object>
Object& object(const void* handle) {
  if (Object* const found = find<Object>(handle)) return *found;
  throw_refused(refuse_handle(kind_of<Object>, handle));
}

/// Shared ownership of the object of a handle. @throws Refusal if there is none
template <class Object>
std::shared_ptr<Object> shared_object(const void* handle) {
  const std::shared_ptr<void>* const found = find_handle(kind_of<Object>, handle);
  if (!found) throw_refused(refuse_handle(kind_of<Object>, handle));
  return std::static_pointer_cast<Object>(*found);
}

/// What a pointer points to. @throws Refusal if it is null
template <class Value>
Value& target(Value* pointer, const char* name) {
  if (!pointer) throw_null(name);
  return *pointer;
}

/// Sets a handle of the C interface to a new object.
template <class Handle, class Object>
void hand_out(Handle** handle, std::shared_ptr<Object> object) {
  *handle = static_cast<Handle*>(add_handle(kind_of<Object>, std::move(object)));
}

/// Checks that an index is in [0, count). @throws Refusal naming it
void require_index(const char* name, std::int32_t index, std::size_t count);

/// The item with this index. @throws Refusal naming the index
template <class Item>
const Item& item(const char* name, const std::vector<Item>& items, std::int32_t index) {
  require_index(name, index, items.size());
  return items[static_cast<std::size_t>(index)];
}

/// @throws Refusal naming the value
[[noreturn]] void throw_out_of_range(const char* name, std::int32_t value, int last);

/// The value of an enumeration, 0 to `last`. @throws Refusal naming it
template <class Enumeration>
Enumeration enumeration(const char* name, std::int32_t value, Enumeration last) {
  if (value < 0 || value > static_cast<int>(last)) throw_out_of_range(name, value, static_cast<int>(last));
  return static_cast<Enumeration>(value);
}

}  // namespace calligraphy::c
