#include "output_directory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>

namespace calligraphy::tools {
namespace fs = std::filesystem;
namespace {

/// Absolute path without a trailing slash: "out/" becomes "out".
fs::path plain(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

fs::path first_missing(const fs::path& path) {
  fs::path missing;
  std::error_code failure;
  for (fs::path at = path; at.has_relative_path() && !fs::exists(at, failure); at = at.parent_path()) missing = at;
  return missing;
}

}  // namespace

OutputDirectory::OutputDirectory(const fs::path& path) : path_(plain(path)), first_created_(first_missing(path_)) {
  try {
    std::error_code failure;
    fs::create_directories(path_, failure);
    if (!fs::is_directory(path_)) {
      throw FileError(path.string() + ": cannot create directory" + (failure ? ": " + failure.message() : ""));
    }
    lock(path);
    const fs::path probe = path_ / ".calligraphy-probe";
    write_file(probe, "");
    fs::remove(probe);
  } catch (const fs::filesystem_error& error) {
    release();
    throw FileError(path.string() + ": " + error.code().message());
  } catch (const std::exception&) {
    release();
    throw;
  }
}

OutputDirectory::~OutputDirectory() { release(); }

void OutputDirectory::lock(const fs::path& path) {
  lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0 || flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  first_created_.clear();  // it is the other run's
  throw FileError(path.string() + ": another run is writing there: wait for its end, or choose another directory");
}

void OutputDirectory::write(const fs::path& name, std::string_view content) const { write_file(path_ / name, content); }

void OutputDirectory::release() noexcept {
  remove_empty();
  if (lock_ >= 0) close(lock_);
  lock_ = -1;
}

void OutputDirectory::remove_empty() noexcept {
  if (first_created_.empty()) return;
  std::error_code failure;
  for (fs::path at = path_; at.native().size() >= first_created_.native().size(); at = at.parent_path()) {
    fs::remove(at, failure);  // fails, as intended, on a directory that is not empty
  }
}

}  // namespace calligraphy::tools
