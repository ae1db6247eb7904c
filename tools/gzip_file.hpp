// Text files compressed by gzip: written so that a reader finds everything up to the last flush, whatever happens then.
#pragma once

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <streambuf>

namespace calligraphy::tools {

/// Writes a compressed file. A call of flush() ends a block that can be read even if the rest never comes.
class GzipWriter : public std::ostream {
 public:
  /// @throws FileError if the file cannot be created
  explicit GzipWriter(const std::filesystem::path& path);
  ~GzipWriter() override;

  /// Writes the end of the file. @throws FileError as check()
  void finish();
  /// @throws FileError with the reason if something could not be written
  void check() const;

 private:
  class Buffer;
  std::unique_ptr<Buffer> buffer_;
};

/// Reads a file, compressed or plain. One that was cut off ends where its last whole block does.
class GzipReader : public std::istream {
 public:
  /// @throws FileError if the file cannot be opened
  explicit GzipReader(const std::filesystem::path& path);
  ~GzipReader() override;

  /// Whether what was read has no end.
  bool was_cut_off() const noexcept;

 private:
  class Buffer;
  std::unique_ptr<Buffer> buffer_;
};

/// The content of a file, compressed or plain. @throws FileError if it cannot be opened, FormatError if it was cut off or
/// has more than 64 MiB
std::string unpacked(const std::string& path);

}  // namespace calligraphy::tools
