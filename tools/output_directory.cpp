#include "output_directory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>

namespace calligraphy::tools {
namespace fs = std::filesystem;
namespace {

/// Why there is no directory at `at`, where mkdir() has just failed.
std::string reason(const fs::path& at, int error) {
  std::error_code failure;
  if (error == EEXIST && fs::is_symlink(at, failure)) {
    return at.string() + " is a link to " + fs::read_symlink(at, failure).string() + ", which is not a directory";
  }
  if (error == EEXIST) return at.string() + " is a file and not a directory";
  return std::generic_category().message(error);
}

}  // namespace

OutputDirectory::OutputDirectory(const fs::path& path) : path_(fs::absolute(path)) {
  try {
    create(path);
    lock(path);
    check_writable(path);
  } catch (const fs::filesystem_error& error) {
    release();
    throw FileError(path.string() + ": " + error.code().message());
  } catch (const std::exception&) {
    release();
    throw;
  }
}

OutputDirectory::~OutputDirectory() { release(); }

void OutputDirectory::create(const fs::path& path) {
  constexpr mode_t for_all = 0777;  // less what the process masks
  fs::path at;
  for (const fs::path& part : path_) {
    at /= part;
    if (part.empty() || fs::is_directory(at)) continue;  // empty: after a trailing slash
    if (mkdir(at.c_str(), for_all) == 0) {
      created_.push_back(at);
    } else if (const int error = errno; !fs::is_directory(at)) {  // otherwise another run has just created it
      throw FileError(path.string() + ": cannot create directory: " + reason(at, error));
    }
  }
}

void OutputDirectory::lock(const fs::path& path) {
  lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0 || flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  created_.clear();  // the other run's to remove
  throw FileError(path.string() + ": another run is writing there: wait for its end, or choose another directory");
}

void OutputDirectory::check_writable(const fs::path& path) const {
  std::string name = (path_ / "new-XXXXXX").string();
  const int file = mkstemp(name.data());
  if (file < 0) {
    throw FileError(path.string() + ": the directory is not writable: " + std::generic_category().message(errno));
  }
  close(file);
  unlink(name.c_str());
}

void OutputDirectory::write(const fs::path& name, std::string_view content) const { write_file(path_ / name, content); }

/// rmdir() removes no link, no file and no directory with something in it.
void OutputDirectory::release() noexcept {
  while (!created_.empty() && rmdir(created_.back().c_str()) == 0) created_.pop_back();
  created_.clear();
  if (lock_ >= 0) close(lock_);
  lock_ = -1;
}

}  // namespace calligraphy::tools
