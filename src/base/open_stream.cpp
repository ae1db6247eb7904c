#include "open_stream.hpp"

#if __has_include(<fcntl.h>) && __has_include(<unistd.h>)

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

namespace calligraphy {

std::FILE* open_stream(const std::string& path) noexcept {
  int descriptor = -1;
  for (int attempt = 0; attempt < 100; ++attempt) {
    descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    if (descriptor >= 0 || errno != ENXIO) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    errno = ENXIO;
  }
  if (descriptor < 0) return nullptr;
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);  // waits while the pipe is full
  std::FILE* const file = fdopen(descriptor, "wb");
  if (file == nullptr) close(descriptor);
  return file;
}

}  // namespace calligraphy

#else

namespace calligraphy {

std::FILE* open_stream(const std::string& path) noexcept { return std::fopen(path.c_str(), "wb"); }

}  // namespace calligraphy

#endif
