// Text without an end, and files of any size that take no room.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <istream>
#include <streambuf>
#include <string>
#include <utility>

namespace calligraphy_test {

/// Begins with some text and goes on with one letter for ever; counts what was read of it.
class EndlessText : private std::streambuf {
 public:
  EndlessText(std::string beginning, char letter) : text_(std::move(beginning)), letters_(1 << 16, letter) {
    setg(text_.data(), text_.data(), text_.data() + text_.size());
  }

  std::istream in{this};
  std::size_t bytes_read = 0;  ///< without the beginning

 private:
  int_type underflow() override {
    bytes_read += letters_.size();
    setg(letters_.data(), letters_.data(), letters_.data() + letters_.size());
    return traits_type::to_int_type(letters_.front());
  }

  std::string text_, letters_;
};

inline void make_sparse_file(const std::filesystem::path& path, std::uintmax_t size) {
  std::ofstream(path).close();
  std::filesystem::resize_file(path, size);
}

/// Bytes that this process has read from files so far; 0 where the system does not tell.
inline std::size_t bytes_read_so_far() {
  std::ifstream in("/proc/self/io");
  std::string name;
  std::size_t bytes = 0;
  return in >> name >> bytes && name == "rchar:" ? bytes : 0;
}

}  // namespace calligraphy_test
