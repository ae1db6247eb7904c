#include "source_files.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>

namespace calligraphy {
namespace {

namespace fs = std::filesystem;

constexpr int deepest = 16;  // levels of directories

/// Reads a directory recursively.
class Directory {
 public:
  Directory(const fs::path& path, const SourceLimits& limits) : path_(path), limits_(limits) {}

  SourceFiles read(const SkipReason& skip_reason) {
    list();
    SourceFiles found;
    std::size_t total = 0;
    for (const std::string& path : regular_) {
      if (std::string reason = skip_reason(path); !reason.empty()) {
        skipped_.push_back({path, std::move(reason)});
        continue;
      }
      found.files.push_back({path, read_file(path_ / path, limits_.entry_bytes)});
      total += found.files.back().text.size();
      if (total > limits_.total_bytes) {
        throw FormatError(path_.string() + ": more than " + std::to_string(limits_.total_bytes) + " bytes to read");
      }
    }
    std::sort(skipped_.begin(), skipped_.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
    found.skipped = std::move(skipped_);
    return found;
  }

 private:
  void list() {
    std::size_t entries = 0;
    for (fs::recursive_directory_iterator at(path_), end; at != end; ++at) {
      if (++entries > limits_.entries) {
        throw FormatError(path_.string() + ": more than " + std::to_string(limits_.entries) + " entries");
      }
      add(at);
    }
    std::sort(regular_.begin(), regular_.end());
  }

  void add(fs::recursive_directory_iterator& at) {
    const std::string path = at->path().lexically_relative(path_).string();
    const fs::file_status status = at->symlink_status();
    if (fs::is_directory(status)) {
      if (at.depth() + 1 < deepest) return;
      at.disable_recursion_pending();
      skipped_.push_back({path, "nested more than " + std::to_string(deepest) + " levels deep"});
    } else if (fs::is_regular_file(status)) {
      regular_.push_back(path);
    } else {
      skipped_.push_back({path, fs::is_symlink(status) ? "a link" : "not a regular file"});
    }
  }

  fs::path path_;
  SourceLimits limits_;
  std::vector<std::string> regular_;
  std::vector<SkippedFile> skipped_;
};

}  // namespace

std::string with_plain_line_ends(std::string_view text, const std::string& place) {
  try {
    decode_utf8(text);
  } catch (const FormatError& error) {
    throw FormatError(place + ": " + error.what());
  }
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
    plain += text[i] == '\r' ? '\n' : text[i];
  }
  return plain;
}

SourceFiles read_source(const fs::path& source, const SkipReason& skip_reason, const SourceLimits& limits) {
  try {
    const fs::file_status status = fs::status(source);
    if (fs::is_directory(status)) return Directory(source, limits).read(skip_reason);
    if (fs::is_regular_file(status)) return read_tarball(source, skip_reason, limits);
    if (!fs::exists(status)) throw FileError(source.string(), "no such file or directory", ENOENT);
    throw FileError(source.string(), "neither a directory nor a regular file");
  } catch (const fs::filesystem_error& error) {
    throw FileError(source.string(), "cannot be read: " + error.code().message() + ": " + error.path1().string(),
                    error.code().value());
  }
}

}  // namespace calligraphy
