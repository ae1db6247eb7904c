#include "kept_recording.hpp"

#include <algorithm>

#include <calligraphy/base/error.hpp>

#include "base/monotonic_clock.hpp"

namespace calligraphy::tools {
namespace {

constexpr double longest_in_memory = 0.1;  ///< [s]

}  // namespace

void KeptRecording::take(const Recording& recording) {
  if (!file_) {
    file_.emplace(out_.reserve(name_ + partial_suffix));
    writer_.emplace(*file_, recording);
  }
  writer_->add(recording);
  if (const double now = monotonic_seconds(); now - flushed_ > longest_in_memory) {
    file_->flush();
    flushed_ = now;
  }
  file_->check();
}

void KeptRecording::finish() {
  writer_->finish();
  file_->finish();
  out_.rename(name_ + partial_suffix, name_);
}

void KeptRecording::discard() {
  file_.reset();
  out_.remove(name_ + partial_suffix);
}

bool is_recording(const std::filesystem::path& path) {
  constexpr std::string_view beginning = "calligraphy recording ";
  GzipReader in(path);
  std::string text(beginning.size(), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text == beginning;
}

StoredRecording open_recording(const std::filesystem::path& path) {
  GzipReader in(path);
  return read_recording(in, path.string());
}

std::vector<std::filesystem::path> recordings_in(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> finished, partial;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(recording_suffix)) finished.push_back(entry.path());
    if (name.ends_with(std::string(recording_suffix) + partial_suffix)) partial.push_back(entry.path());
  }
  std::sort(finished.begin(), finished.end());
  std::sort(partial.begin(), partial.end());
  finished.insert(finished.end(), partial.begin(), partial.end());
  if (finished.empty()) throw FileError(directory.string() + ": there is no recording in this directory");
  return finished;
}

}  // namespace calligraphy::tools
