#include "mapped_file.hpp"

#include <cerrno>
#include <cstdint>
#include <limits>
#include <system_error>

#include <calligraphy/base/error.hpp>

#if __has_include(<sys/mman.h>)

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace calligraphy {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) { throw FileError(path, what); }

/// Adds the system's reason.
[[noreturn]] void fail(const std::string& path, const std::string& what, int code) {
  throw FileError(path, what + ": " + std::generic_category().message(code), code);
}

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
};

}  // namespace

MappedFile::MappedFile(const std::string& path) {
  // Opening a pipe without a writer must not block.
  const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.number < 0) fail(path, "cannot be opened", errno);
  struct stat status {};
  if (fstat(file.number, &status) != 0) fail(path, "cannot be read", errno);
  if (!S_ISREG(status.st_mode)) fail(path, "is not a regular file");
  const auto size = static_cast<std::uintmax_t>(status.st_size);
  if (size == 0) return;  // an empty file cannot be mapped
  if (size > std::numeric_limits<std::size_t>::max()) fail(path, std::to_string(size) + " bytes are too many to map");
  void* const start = mmap(nullptr, static_cast<std::size_t>(size), PROT_READ, MAP_PRIVATE, file.number, 0);
  if (start == MAP_FAILED) fail(path, "cannot be mapped", errno);
  madvise(start, static_cast<std::size_t>(size), MADV_RANDOM);  // no read-ahead
  bytes_ = {static_cast<const std::byte*>(start), static_cast<std::size_t>(size)};
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace calligraphy

#else

#include <filesystem>
#include <fstream>

namespace calligraphy {

// Reads the whole file, for systems without memory mapping.
MappedFile::MappedFile(const std::string& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) {
    throw FileError(path + ": is not a regular file");
  }
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw FileError(path + ": cannot be opened");
  const auto size = static_cast<std::size_t>(in.tellg());
  if (size == 0) return;
  auto* const start = new char[size];
  bytes_ = {reinterpret_cast<const std::byte*>(start), size};
  if (!in.seekg(0).read(start, static_cast<std::streamsize>(size))) {
    delete[] start;
    throw FileError(path + ": cannot be read");
  }
}

MappedFile::~MappedFile() { delete[] reinterpret_cast<const char*>(bytes_.data()); }

}  // namespace calligraphy

#endif
