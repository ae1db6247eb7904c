#include "output_directory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include <spdlog/spdlog.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>

#include "run_record.hpp"

namespace calligraphy::tools {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

/// Why there is no directory at `at`, where mkdir() has just failed.
std::string reason(const fs::path& at, int error) {
  std::error_code failure;
  if (error == EEXIST && fs::is_symlink(at, failure)) {
    return at.string() + " is a link to " + fs::read_symlink(at, failure).string() + ", which is not a directory";
  }
  if (error == EEXIST) return at.string() + " is a file and not a directory";
  return std::generic_category().message(error);
}

/// The record of an earlier run; null if it cannot be read.
Json record_at(const fs::path& at) {
  constexpr std::size_t most = 1 << 30;
  try {
    return Json::parse(read_file(at, most));
  } catch (const std::exception&) {
    return {};
  }
}

/// A name in the directory itself.
bool is_plain(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos &&
         name.find('\0') == std::string::npos;
}

}  // namespace

OutputDirectory::OutputDirectory(const fs::path& path, std::string record, bool force)
    : path_(fs::absolute(path)), name_(std::move(record)), record_(run_facts()) {
  record_["finished"] = false;
  try {
    create(path);
    lock(path);
    check_writable(path);
    for (const char* const any : {summary_file, replay_file, stability_file, tradeoff_file}) make_room(path, any, force);
    refuse_strangers(path);
    write_record();
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

void OutputDirectory::make_room(const fs::path& path, const char* record, bool force) const {
  const fs::path at = path_ / record;
  if (!fs::exists(fs::symlink_status(at))) return;
  const Json old = record_at(at);
  const std::string told = (path / record).string();
  if (!force) {
    throw FileError(told,
                    "already there, from " + run_of(old) + "; choose another directory, or replace it with --force");
  }
  if (old.is_object() && old.contains("files") && old["files"].is_array()) {
    for (const Json& name : old["files"]) {
      if (!name.is_string() || !is_plain(name.get<std::string>())) continue;
      const fs::path file = path_ / name.get<std::string>();
      if (fs::is_regular_file(fs::symlink_status(file))) fs::remove(file);
    }
  } else {
    spdlog::warn("{}: lists no files, as that of an earlier version: it alone is replaced, and other files stay", told);
  }
  fs::remove(at);
}

void OutputDirectory::explain(const Json& facts) {
  record_.insert(facts.begin(), facts.end());
  write_record();
}

void OutputDirectory::write(const std::string& name, std::string_view content) { write_file(reserve(name), content); }

fs::path OutputDirectory::reserve(const std::string& name) {
  if (std::find(files_.begin(), files_.end(), name) == files_.end()) {
    files_.push_back(name);
    write_record();
  }
  return path_ / name;
}

void OutputDirectory::rename(const std::string& from, const std::string& to) {
  std::error_code error;
  fs::rename(path_ / from, reserve(to), error);
  if (error) throw FileError((path_ / from).string(), "cannot be renamed to " + to + ": " + error.message());
  std::erase(files_, from);
  write_record();
}

void OutputDirectory::remove(const std::string& name) {
  std::error_code error;
  fs::remove(path_ / name, error);
  if (error) throw FileError((path_ / name).string(), "cannot be removed: " + error.message());
  std::erase(files_, name);
  write_record();
}

void OutputDirectory::keep(const Json& results) {
  has_results_ = true;
  record_.update(results);
  write_record();
}

void OutputDirectory::finish() {
  record_["finished"] = true;
  write_record();
}

std::string OutputDirectory::text() const {
  Json all = record_;
  all["files"] = files_;
  return json_text(all);
}

void OutputDirectory::write_record() {
  write_file(path_ / name_, text());
  has_record_ = true;
}

void OutputDirectory::refuse_strangers(const fs::path& path) const {
  for (const auto& entry : fs::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    if (name.find(recording_suffix) == std::string::npos) continue;
    throw FileError((path / name).string(), "is there, a recording of no run: choose another directory, or move it away");
  }
}

/// rmdir() removes no link, no file and no directory with something in it.
void OutputDirectory::release() noexcept {
  if (has_record_ && !has_results_ && files_.empty()) unlink((path_ / name_).c_str());
  has_record_ = false;
  while (!created_.empty() && rmdir(created_.back().c_str()) == 0) created_.pop_back();
  created_.clear();
  if (lock_ >= 0) close(lock_);
  lock_ = -1;
}

}  // namespace calligraphy::tools
