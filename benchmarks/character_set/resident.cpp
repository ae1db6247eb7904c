#include "resident.hpp"

#if __has_include(<fcntl.h>) && __has_include(<unistd.h>)
#include <fcntl.h>
#include <unistd.h>
#endif

#include <fstream>
#include <sstream>

std::optional<std::size_t> resident_bytes(const std::string& path) {
  std::ifstream in("/proc/self/smaps");
  if (!in) return std::nullopt;
  std::size_t sum = 0;
  bool is_ours = false;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (!first.ends_with(':')) {
      is_ours = line.ends_with(path);
    } else if (is_ours && first == "Rss:") {
      std::size_t kilobytes = 0;
      words >> kilobytes;
      sum += 1024 * kilobytes;
    }
  }
  return sum;
}

void forget_content(const std::string& path) {
#ifdef POSIX_FADV_DONTNEED
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  fsync(file);
  posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
  close(file);
#else
  static_cast<void>(path);
#endif
}
