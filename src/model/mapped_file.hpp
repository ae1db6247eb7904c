// The bytes of a file, memory-mapped if the system supports it.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace calligraphy {

/// A file as bytes, read-only. Only pages that are accessed take memory.
///
/// If a mapped file is truncated, access beyond its new end terminates the program (SIGBUS). To replace a set file,
/// write a new one and rename it, as write_file() does; the old one then stays unchanged as long as it is open.
class MappedFile {
 public:
  /// @throws FileError naming the path if it is not a regular file or cannot be read
  explicit MappedFile(const std::string& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  std::span<const std::byte> bytes() const noexcept { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace calligraphy
