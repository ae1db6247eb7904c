#include "source_files.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>

#include "base/archive_format.hpp"

namespace calligraphy {
namespace {

namespace fs = std::filesystem;

constexpr int deepest = 16;  // levels of directories

std::string archive_format_of(const fs::path& file) {
  std::ifstream in = open_file(file);
  std::string start(archive_start, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  return std::string(archive_format(start));
}

std::size_t most_bytes(const FilePlan& plan, const SourceLimits& limits) {
  return plan.is_list ? limits.list_bytes : limits.entry_bytes;
}

/// Reads a directory recursively.
class Directory {
 public:
  Directory(const fs::path& path, const SourceLimits& limits) : path_(path), limits_(limits) {}

  SourceFiles read(const FilePlanner& plan) {
    list();
    SourceFiles found;
    std::size_t total = 0;
    for (const std::string& path : regular_) {
      FilePlan file = plan(path);
      if (file.skip_reason.empty() && file.is_optional) {
        const fs::path full = path_ / path;
        file.skip_reason = size_reason(fs::file_size(full), file, limits_, full.string());
      }
      if (!file.skip_reason.empty()) {
        skipped_.push_back({path, std::move(file.skip_reason)});
        continue;
      }
      found.files.push_back({path, read_file(path_ / path, most_bytes(file, limits_))});
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

std::string size_reason(std::uintmax_t bytes, const FilePlan& plan, const SourceLimits& limits,
                        const std::string& name) {
  const std::size_t most = most_bytes(plan, limits);
  if (bytes <= most) return {};
  const std::string reason = "larger than the limit of " + std::to_string(most) + " bytes";
  if (!plan.is_optional) throw FormatError(name + ": " + std::to_string(bytes) + " bytes, " + reason);
  return reason;
}

SourceFiles read_source(const fs::path& source, const FilePlanner& plan, const SourceLimits& limits) {
  try {
    const fs::file_status status = fs::status(source);
    if (fs::is_directory(status)) return Directory(source, limits).read(plan);
    if (fs::is_regular_file(status)) {
      const std::string format = archive_format_of(source);
      if (!format.empty()) return read_archive(source, format, plan, limits);
      return {{{source.filename().string(), read_file(source, limits.list_bytes)}}, {}};
    }
    if (!fs::exists(status)) throw FileError(source.string(), "no such file or directory", ENOENT);
    throw FileError(source.string(), "neither a directory nor a regular file");
  } catch (const fs::filesystem_error& error) {
    throw FileError(source.string(), "cannot be read: " + error.code().message() + ": " + error.path1().string(),
                    error.code().value());
  }
}

}  // namespace calligraphy
