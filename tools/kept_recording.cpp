#include "kept_recording.hpp"

#include <algorithm>
#include <cstdio>
#include <tuple>

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
  if (!file_) return;
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

PlaceInRun place_in_run(const std::filesystem::path& recording) {
  PlaceInRun place;
  char mode[8];
  const std::string name = recording.filename().string();
  if (std::sscanf(name.c_str(), "page-%d-%7[a-z]-%d", &place.page, mode, &place.repetition) != 3) return {};
  return place;
}

std::vector<std::filesystem::path> recordings_in(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    const bool is_one = name.ends_with(recording_suffix) ||
                        name.ends_with(std::string(recording_suffix) + partial_suffix);
    if (is_one && entry.file_size() > 0) found.push_back(entry.path());  // empty: stopped before anything was written
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    const PlaceInRun of_a = place_in_run(a), of_b = place_in_run(b);
    return std::tie(of_a.page, of_a.repetition, a) < std::tie(of_b.page, of_b.repetition, b);
  });
  if (found.empty()) throw FileError(directory.string() + ": there is no recording in this directory");
  return found;
}

}  // namespace calligraphy::tools
