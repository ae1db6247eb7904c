#include "resident.hpp"

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
