#include "call.hpp"

#include <cstdarg>
#include <cstdio>
#include <new>
#include <stdexcept>

#include "structs.hpp"

namespace calligraphy::c {
namespace {

thread_local char last_error[1024] = "";

calligraphy_status status_of(const std::exception& error) noexcept {
  if (const auto* refusal = dynamic_cast<const Refusal*>(&error)) return refusal->status();
  if (dynamic_cast<const ValueError*>(&error)) return CALLIGRAPHY_INVALID_VALUE;
  if (dynamic_cast<const FileError*>(&error)) return CALLIGRAPHY_FILE_ERROR;
  if (dynamic_cast<const FormatError*>(&error)) return CALLIGRAPHY_FORMAT_ERROR;
  return CALLIGRAPHY_INTERNAL_ERROR;
}

}  // namespace

calligraphy_status refuse(calligraphy_status status, const char* format, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(last_error, sizeof last_error, format, arguments);
  va_end(arguments);
  return status;
}

calligraphy_status refuse_exception() noexcept {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return refuse(CALLIGRAPHY_OUT_OF_MEMORY, "out of memory, or 65,536 handles are in use");
  } catch (const std::length_error&) {
    return refuse(CALLIGRAPHY_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return refuse(status_of(error), "%s", error.what());
  } catch (...) {
    return refuse(CALLIGRAPHY_INTERNAL_ERROR, "unknown error");
  }
}

void throw_refused(calligraphy_status status) { throw Refusal(status, last_error); }

calligraphy_status refuse_handle(Kind kind, const void* handle) noexcept {
  if (!handle) return refuse(CALLIGRAPHY_INVALID_HANDLE, "%s is null", to_string(kind));
  const Kind other = kind_of_handle(handle);
  if (other != Kind{}) {
    const char* const article = other == Kind::index ? "an " : other == Kind::traces ? "" : "a ";
    return refuse(CALLIGRAPHY_INVALID_HANDLE, "%s = %p: a handle of %s%s", to_string(kind), handle, article,
                  to_string(other));
  }
  return refuse(CALLIGRAPHY_INVALID_HANDLE, "%s = %p: no handle, or it was freed", to_string(kind), handle);
}

calligraphy_status refuse_size(const char* name, std::size_t size, std::size_t least) noexcept {
  return refuse(CALLIGRAPHY_INVALID_VALUE, "%s: size = %zu, must be sizeof(%s), at least %zu", name, size, name, least);
}

void throw_null(const char* name) { throw Refusal(CALLIGRAPHY_INVALID_VALUE, std::string(name) + " is null"); }

void require_index(const char* name, std::int32_t index, std::size_t count) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return;
  throw Refusal(CALLIGRAPHY_INVALID_VALUE, std::string(name) + " = " + std::to_string(index) +
                                               ", must be an index below " + std::to_string(count));
}

void throw_out_of_range(const char* name, std::int32_t value, int last) {
  throw Refusal(CALLIGRAPHY_INVALID_VALUE,
                std::string(name) + " = " + std::to_string(value) + ", must be 0 to " + std::to_string(last));
}

}  // namespace calligraphy::c

const char* calligraphy_version(void) { return CALLIGRAPHY_LIBRARY_VERSION; }

const char* calligraphy_last_error(void) { return calligraphy::c::last_error; }

calligraphy_status calligraphy_free(void* handle) {
  using namespace calligraphy::c;
  if (kind_of_handle(handle) == Kind::stroke) {
    return refuse(CALLIGRAPHY_INVALID_HANDLE, "%p: a stroke is freed with its renderer", handle);
  }
  if (!handle || remove_handle(handle)) return CALLIGRAPHY_OK;
  return refuse(CALLIGRAPHY_INVALID_HANDLE, "%p: no handle, or it was freed already", handle);
}
