#include <calligraphy/base/file.hpp>

#if __has_include(<fcntl.h>) && __has_include(<unistd.h>)
#include <fcntl.h>
#include <unistd.h>
#endif

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <calligraphy/base/error.hpp>

namespace calligraphy {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw FileError(path.string(), "cannot be written: " + reason);
}

[[noreturn]] void fail_as_too_large(const fs::path& path, std::uintmax_t max_bytes) {
  throw FormatError(path.string() + ": larger than the limit of " + std::to_string(max_bytes) + " bytes");
}

std::string reason_of(int error) { return std::generic_category().message(error); }

[[noreturn]] void fail(const fs::path& path, int error) {
  throw FileError(path.string(), "cannot be written: " + reason_of(error), error);
}

[[noreturn]] void fail_to_open(const fs::path& path, int error) {
  throw FileError(path.string(), "cannot be opened: " + reason_of(error), error);
}

struct CloseFile {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

void write_and_close(File file, const fs::path& path, std::string_view content) {
  errno = 0;
  const bool written = std::fwrite(content.data(), 1, content.size(), file.get()) == content.size();
  if (!written || std::fflush(file.get()) != 0) fail(path, errno);
  if (std::fclose(file.release()) != 0) fail(path, errno);
}

/// A new, empty file beside the target, removed unless it is renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    std::random_device random;
    constexpr int attempts = 16;
    for (int i = 0; i < attempts && !file_; ++i) {
      const std::uint64_t number = (std::uint64_t{random()} << 32) | random();
      path_ = target;
      path_ += "." + std::to_string(number) + ".tmp";
      errno = 0;
      file_.reset(std::fopen(path_.string().c_str(), "wbx"));
      if (!file_ && errno != EEXIST) break;
    }
    if (!file_) fail(target_, errno);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    file_.reset();
    std::error_code ignored;
    if (!renamed_) fs::remove(path_, ignored);
  }

  void write(std::string_view content) { write_and_close(std::move(file_), target_, content); }

  void take_permissions(fs::perms permissions) {
    std::error_code error;
    fs::permissions(path_, permissions, error);
    if (error) fail(target_, error.message());
  }

  void rename() {
    std::error_code error;
    fs::rename(path_, target_, error);
    if (error) fail(target_, error.message());
    renamed_ = true;
  }

 private:
  fs::path target_;
  fs::path path_;
  File file_;
  bool renamed_ = false;
};

/// A pipe or a character device, even behind a link whose target is no path, such as /dev/fd/63 of >(command).
bool is_stream(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::is_fifo(status) || fs::is_character_file(status);
}

/// Opens a pipe or a character device for writing, without waiting forever. Returns null, with the reason in `errno`,
/// on failure: ENXIO for a pipe that no program reads, after waiting a second for a reader to start.
#ifdef O_NONBLOCK
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
#else
std::FILE* open_stream(const std::string& path) noexcept { return std::fopen(path.c_str(), "wb"); }
#endif

void write_to_stream(const fs::path& path, std::string_view content) {
  errno = 0;
  File file(open_stream(path.string()));
  const int error = errno;
  std::error_code ignored;
  if (!file && error == ENXIO && fs::is_fifo(path, ignored)) fail(path, "no program reads this pipe");
  if (!file) fail(path, error);
  write_and_close(std::move(file), path, content);
}

/// Rejects anything but a regular file, and a file that is too large.
void check_can_read(const fs::path& path, std::uintmax_t max_bytes) {
  std::error_code failure;
  if (fs::exists(path, failure) && !fs::is_regular_file(path, failure)) {
    throw FileError(path.string(), "is not a regular file");
  }
  const std::uintmax_t size = fs::file_size(path, failure);
  if (!failure && size > max_bytes) fail_as_too_large(path, max_bytes);
}

/// The file to write for this path: the target of a link, because renaming onto the link would replace it.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  const fs::path target = fs::is_symlink(path, error) ? fs::canonical(path, error) : path;
  if (target.empty()) fail(path, "the link is dangling");
  const fs::file_status before = fs::status(target, error);
  if (fs::exists(before) && !fs::is_regular_file(before)) fail(path, "it exists and is not a regular file");
  return target;
}

}  // namespace

void write_file(const fs::path& path, std::string_view content) {
  if (is_stream(path)) return write_to_stream(path, content);
  const fs::path target = target_of(path);
  std::error_code error;
  const fs::file_status before = fs::status(target, error);
  TemporaryFile file(target);
  file.write(content);
  if (fs::exists(before)) file.take_permissions(before.permissions());
  file.rename();
}

void check_can_write(const fs::path& path) {
  if (!is_stream(path)) TemporaryFile(target_of(path)).write("");
}

std::ifstream open_file(const fs::path& path, std::uintmax_t max_bytes) {
  check_can_read(path, max_bytes);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) fail_to_open(path, errno);
  return in;
}

// Avoids streams: their locales make up a fifth of a WebAssembly module.
std::string read_file(const fs::path& path, std::size_t max_bytes) {
  check_can_read(path, max_bytes);
  errno = 0;
  const File in(std::fopen(path.string().c_str(), "rb"));
  if (!in) fail_to_open(path, errno);
  std::string text;
  constexpr std::size_t chunk = 1 << 16;  // most files are small, so memory grows as needed
  while (!std::feof(in.get()) && text.size() <= max_bytes) {
    const std::size_t before = text.size();
    text.resize(before + chunk);
    text.resize(before + std::fread(text.data() + before, 1, chunk, in.get()));
    if (std::ferror(in.get())) throw FileError(path.string(), "cannot be read", errno);
  }
  if (text.size() > max_bytes) fail_as_too_large(path, max_bytes);  // it has grown in the meantime
  return text;
}

}  // namespace calligraphy
