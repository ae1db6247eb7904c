// The bytes of a file, mapped where the system can.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace calligraphy {

/// A file as bytes, read-only. Only the pages that are looked at take memory.
///
/// A file that someone makes shorter meanwhile cannot be read beyond its new end: the system stops the program
/// (SIGBUS). Whoever writes set files writes a new one and renames it, as write_file() does; the old one then stays as
/// it was for as long as it is open.
class MappedFile {
 public:
  /// @throws FileError naming the path when it is not a regular file or cannot be read
  explicit MappedFile(const std::string& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  std::span<const std::byte> bytes() const noexcept { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace calligraphy
