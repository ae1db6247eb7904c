// The objects behind the handles of the C interface. A handle is a number in the form of a pointer that is never
// dereferenced, so one that is freed or invalid can be refused.
#pragma once

#include <cstdint>
#include <memory>

namespace calligraphy::c {

/// Kind of an object: the lowest bits of its handle, never all zero.
enum class Kind : std::uintptr_t {
  set = 1,
  page,
  device,
  renderer,
  servo,
  match,
  recording,
  score,
  stroke,
  index,
  traces,
  lesson
};

/// "set", "page" ...
const char* to_string(Kind kind) noexcept;

/// The kind of a type; specialised where the type is known.
template <class Object>
inline constexpr Kind kind_of = Kind{};

/// Keeps an object until its handle is removed. Thread-safe. @throws std::bad_alloc if there are too many
void* add_handle(Kind kind, std::shared_ptr<void> object);
/// Returns the object that the handle had, or null if there is no such handle. Thread-safe.
std::shared_ptr<void> remove_handle(const void* handle) noexcept;
/// The object of a handle, or null if there is none of this kind. Wait-free; the caller must ensure that the handle
/// is not removed meanwhile.
const std::shared_ptr<void>* find_handle(Kind kind, const void* handle) noexcept;

/// The kind of a handle; Kind{} if there is no such handle.
Kind kind_of_handle(const void* handle) noexcept;

/// The object of a handle, or null.
template <class Object>
Object* find(const void* handle) noexcept {
  const std::shared_ptr<void>* found = find_handle(kind_of<Object>, handle);
  return found ? static_cast<Object*>(found->get()) : nullptr;
}

}  // namespace calligraphy::c
